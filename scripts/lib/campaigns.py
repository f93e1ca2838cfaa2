"""Runs of the whisker command in the classes of worlds, and tables in Markdown of what they came to."""

import argparse
import collections
import itertools
import json
import os
import pathlib
import platform
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
WHISKER = pathlib.Path(os.environ.get("WHISKER", ROOT / "build/host/whisker")).resolve()
ROBOTS = ROOT / "host/robots"

# Name: arguments of `whisker world` without the seed.
CLASSES = {
    "15 discs": "discs --discs 15",
    "30 discs": "discs",
    "50 discs": "discs --discs 50",
    "75 discs in a box": "discs --discs 75 --box",
    "U-traps": "u-trap",
    "spirals": "spiral",
    "mazes": "maze",
    "rooms": "rooms",
    "poles": "poles",
    "enclosed": "enclosed",
}

# Name: Table. scripts/measure runs them.
TABLES = {}


class Section:
    """Where a page shows the lines after it: between <!-- MARK:begin --> and <!-- MARK:end -->. made: below what made them."""

    def __init__(self, page, mark, made=True):
        self.page, self.mark, self.made = ROOT / page, mark, made


class Table:
    """A measurement. `lines` gets the options, and yields lines and Sections; it says in o.failed what failed, if anything."""

    program = "measure"  # the name of the table that is made

    def __init__(self, name, lines, page, unit, count, note, needs_whisker, options):
        self.name, self.lines, self.unit, self.count, self.note, self.options = name, lines, unit, count, note, options
        self.page, self.needs_whisker = page, needs_whisker

    def parse(self, argv):
        parser = argparse.ArgumentParser(
            prog=f"scripts/measure {self.name}", description=self.lines.__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
        )
        if self.count:
            parser.add_argument("count", metavar="COUNT", nargs="?", type=whole_number, default=self.count, help=f"{self.unit}; default {self.count}")
            parser.add_argument("first", metavar="FIRST_SEED", nargs="?", type=whole_number, default=1)
        for option, settings in self.options.items():
            parser.add_argument(option, **settings)
        if self.page:
            parser.add_argument("--update", action="store_true", help="write into the page of docs/ that shows it")
        o = parser.parse_args(argv)
        o.failed, o.parser, o.update = None, parser, getattr(o, "update", False)
        return o

    def made(self, o):
        """The first line of the table."""
        words = [str(o.count), str(o.first)]
        for option, settings in self.options.items():
            value = getattr(o, option.strip("-").replace("-", "_"))
            if value and value != settings.get("default"):
                shown = [f"{v:g}" if isinstance(v, float) else f'"{v}"' if " " in str(v) else str(v) for v in (value if isinstance(value, list) else [value])]
                again = settings.get("action") == "append"
                words += [*([option] if option.startswith("-") else []), f" {option} ".join(shown) if again else " ".join(shown)]
        seeds = f"{o.count} {self.unit}, seeds {o.first} to {o.first + o.count - 1}"
        return f"`scripts/measure {self.name} {' '.join(words)}`: {seeds}, on {machine()}.{self.note}\n"

    def run(self, argv):
        """Prints the lines as they come; --update writes them into their pages."""
        Table.program = self.name
        o = self.parse(argv)
        if self.needs_whisker and not WHISKER.exists():
            fail(f"{WHISKER} is missing: cmake --preset host && cmake --build --preset host")
        section, text = None, ""

        def begin(new):
            if o.update:
                place_in(new.page, new.mark)
            made = f"{self.made(o)}\n" if new.made and self.count else ""
            print(made, end="")
            return new, made

        for item in self.lines(o):
            if isinstance(item, Section):
                if o.update and section:
                    put(section.page, section.mark, text)
                print("\n" if section else "", end="")
                section, text = begin(item)
                continue
            if section is None:
                section, text = begin(Section(self.page or "", self.name))
            print(item, flush=True)
            text += f"{item}\n"
        if o.update and section:
            put(section.page, section.mark, text)
        if o.failed:
            fail(o.failed)


def table(page=None, unit="", missions=0, note="", needs_whisker=True, **options):
    """Declares a table. missions: the default of COUNT; 0: it has neither COUNT nor FIRST_SEED."""
    options = {name if settings.get("nargs") in ("*", "?") else f"--{name.replace('_', '-')}": settings for name, settings in options.items()}

    def declare(lines):
        name = lines.__name__.replace("_", "-")
        TABLES[name] = Table(name, lines, page, unit, missions, note, needs_whisker, options)
        return lines

    return declare


def fail(message):
    sys.exit(f"{Table.program}: {message}")


def whisker(*words, good=(0,), **options):
    """What this whisker command prints. Exits if its exit status is none of the good ones."""
    words = [str(word) for word in words]
    done = subprocess.run([WHISKER, *words], stdout=subprocess.PIPE, text=True, check=False, **options)
    if done.returncode not in good:
        fail(f"whisker {' '.join(words)}: exit status {done.returncode}")
    return done.stdout


# How many runs, and their first seed: what a table's options hold too.
Many = collections.namedtuple("Many", "count first")


def summary(command, arguments, o, *more):
    """The summary of many runs as this command prints it; the first seed and their number are those of the options."""
    return json.loads(whisker(command, *arguments.split(), "--count", o.count, "--seed", o.first, *more, "--json"))


def campaign(world, o, *more):
    """The summary of `whisker campaign --json` in a class of worlds; see docs/campaign.md."""
    return summary("campaign", CLASSES.get(world, world), o, *more)


def example(command):
    """A command of a page and what it prints."""
    yield f"```\n$ whisker {command}\n{whisker(*command.split(), cwd=ROOT)}```"


FOLDER = tempfile.TemporaryDirectory(prefix="whisker-measure-")
NUMBER = itertools.count()


def file_of(text):
    """A file with this text, which stays until the end of the program."""
    path = pathlib.Path(FOLDER.name, f"{next(NUMBER)}.toml")
    path.write_text(text, encoding="utf-8")
    return path


def cell(estimate, scale=1, digits=0):
    """"value (low-high)" with 95 % bounds; "?" for a bound if the sample is too small."""
    if estimate is None or estimate["value"] is None:
        return "-"
    text = ["?" if estimate[k] is None else f"{scale * estimate[k]:.{digits}f}" for k in ("value", "low", "high")]
    return "{} ({}-{})".format(*text)


def missions_of(summary, key):
    return round(summary[key]["value"] * summary["missions"])


def line(*cells):
    return f"| {' | '.join(map(str, cells))} |"


def heading(*cells):
    return f"{line(*cells)}\n|{'---|' * len(cells)}"


def grid(corner, rows, columns, cell):
    """A table of cell(row, column). rows, columns: title: value; a row may have several titles. corner: what stands above them."""
    yield heading(*corner, *columns)
    for title, row in rows.items():
        yield line(*((title,) if isinstance(title, str) else title), *(cell(row, column) for column in columns.values()))


def place_in(page, mark):
    """The page's text before and after a section, including its marks. Exits if the page has no such section."""
    begin, end = f"<!-- {mark}:begin -->\n", f"<!-- {mark}:end -->\n"
    text = page.read_text()
    if text.count(begin) != 1 or text.count(end) != 1 or text.index(begin) > text.index(end):
        fail(f"{page.name} has no place for the table ({begin.strip()})")
    return text.partition(begin)[0] + begin, end + text.partition(end)[2]


def put(page, mark, text):
    """Replaces the text between the page's marks."""
    before, after = place_in(page, mark)
    page.write_text(before + text + after)


def machine():
    """"AMD EPYC, 2 cores, Debian GNU/Linux 12 (bookworm)"."""
    model = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    return f"{model[1] if model else platform.machine()}, {os.cpu_count()} cores, {platform.freedesktop_os_release()['PRETTY_NAME']}"


def whole_number(text):
    """Parses a count or a seed; raises ValueError if it is neither."""
    if not (text.isascii() and text.isdecimal()):
        raise ValueError(text)
    return int(text)
