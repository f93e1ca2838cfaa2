"""Shared by the scripts: the classes of worlds, and `whisker campaign` in them."""

import argparse
import json
import os
import pathlib
import platform
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
WHISKER = pathlib.Path(os.environ.get("WHISKER", ROOT / "build/host/whisker")).resolve()
PROGRAM = pathlib.Path(sys.argv[0]).name

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
# Robot files. TAPE goes into [noise]: the scale that both wheels have in common is known to 0.1 %, as from a drive of 5 m
# along a tape.
GYRO = (ROOT / "host/robots/gyro.toml").read_text(encoding="utf-8")
TAPE = "\nwheel_scale_sigma = 0\nwheel_scale_common_sigma = 0.001\n"


def need_whisker():
    if not WHISKER.exists():
        sys.exit(f"{PROGRAM}: {WHISKER} is missing: cmake --preset host && cmake --build --preset host")


def summary(command, arguments, count, first_seed, *more):
    """The summary that this whisker command prints. Exits if the command fails."""
    words = [command, *arguments.split(), "--count", str(count), "--seed", str(first_seed), *more]
    done = subprocess.run([WHISKER, *words, "--json"], stdout=subprocess.PIPE, check=False)
    if done.returncode != 0:
        sys.exit(f"{PROGRAM}: whisker {' '.join(words)}: exit status {done.returncode}")
    return json.loads(done.stdout)


def campaign(arguments, count, first_seed, *more):
    """The summary of `whisker campaign --json`; see docs/campaign.md."""
    return summary("campaign", arguments, count, first_seed, *more)


def scan(arguments, count, first_seed):
    """The summary of `whisker scanner --json`, in the same worlds; see docs/campaign.md."""
    return summary("scanner", arguments, count, first_seed)


def cell(estimate, scale=1, digits=0):
    """"value (low-high)" with 95 % bounds; "?" for a bound if the sample is too small."""
    if estimate is None or estimate["value"] is None:
        return "-"
    text = ["?" if estimate[k] is None else f"{scale * estimate[k]:.{digits}f}" for k in ("value", "low", "high")]
    return "{} ({}-{})".format(*text)


def percent(estimate):
    """With one decimal, so that one mission in a thousand is visible."""
    return cell(estimate, 100, 1)


def missions_of(summary, key):
    return round(summary[key]["value"] * summary["missions"])


def faults(summary):
    """Number of missions that ended in a fault."""
    return missions_of(summary, "fault")


def off_goal(summary):
    """Number of missions in which the robot falsely reports that it is at the goal."""
    return missions_of(summary, "off_goal")


def line(*cells):
    return f"| {' | '.join(cells)} |"


def heading_of(*cells):
    return f"{line(*cells)}\n|{'---|' * len(cells)}"


def row(*cells):
    print(line(*cells), flush=True)


def heading(*cells):
    print(heading_of(*cells), flush=True)


def place_in(page, name):
    """The page's text before and after the section between <!-- NAME:begin --> and <!-- NAME:end -->, including the
    marks. Exits if the page has no such section."""
    begin, end = f"<!-- {name}:begin -->\n", f"<!-- {name}:end -->\n"
    text = page.read_text()
    if text.count(begin) != 1 or text.count(end) != 1 or text.index(begin) > text.index(end):
        sys.exit(f"{PROGRAM}: {page.name} has no place for the table ({begin.strip()})")
    return text.partition(begin)[0] + begin, end + text.partition(end)[2]


def put(page, name, text):
    """Replaces the text between the page's marks."""
    before, after = place_in(page, name)
    page.write_text(before + text + after)


def show(made, lines, page, name, update):
    """Prints what made the table, and the table's lines as they come. `update`: writes both into the page."""
    if update:
        place_in(page, name)
    text = f"{made}\n\n"
    print(text, end="")
    for text_line in lines:
        print(text_line, flush=True)
        text += text_line + "\n"
    if update:
        put(page, name, text)


def table_options(description, unit, count):
    """Parser for COUNT, FIRST_SEED and --update of a script that fills a table of a page."""
    parser = argparse.ArgumentParser(prog=f"scripts/{PROGRAM}", description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("count", metavar="COUNT", nargs="?", type=whole_number, default=count, help=f"{unit}; default {count}")
    parser.add_argument("first", metavar="FIRST_SEED", nargs="?", type=whole_number, default=1)
    parser.add_argument("--update", action="store_true", help="write the table into its page of docs/")
    return parser


def made_by(o, unit, more=""):
    """What a table with these options is, for its first line; more: further options."""
    only = more + "".join(f' --{name} "{value}"' for name in ("row", "world", "errors") if (value := getattr(o, name, None)))
    return f"`scripts/{PROGRAM} {o.count} {o.first}{only}`: {o.count} {unit}, seeds {o.first} to {o.first + o.count - 1}, on {machine()}."


def machine():
    """"AMD EPYC, 2 cores, Debian GNU/Linux 12 (bookworm)"."""
    model = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    return f"{model[1] if model else platform.machine()}, {os.cpu_count()} cores, {platform.freedesktop_os_release()['PRETTY_NAME']}"


def whole_number(text):
    """Parses a count or a seed; raises ValueError if it is neither."""
    if not (text.isascii() and text.isdecimal()):
        raise ValueError(text)
    return int(text)


def whole_numbers(texts, usage):
    """Parses counts and seeds. Exits with status 2 if an argument is neither."""
    try:
        return [whole_number(text) for text in texts]
    except ValueError:
        print(usage, file=sys.stderr)
        sys.exit(2)
