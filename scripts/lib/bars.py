"""The bars of the planners, and the campaigns that are compared with them."""

import csv
import math
import shutil
import statistics
import subprocess

from campaigns import CLASSES, ROOT, WHISKER, Many, campaign, fail, file_of, heading, line, table

# Column heading: (figure of a summary, digits).
FIGURES = {
    "ratio p50": (lambda s: s["ratio"]["p50"], 3),
    "ratio p95": (lambda s: s["ratio"]["p95"], 2),
    "s/m p50": (lambda s: s["s_per_m"]["p50"], 2),
    "stops/m": (lambda s: s["stops_per_m"]["all"], 2),
    "flips/m": (lambda s: s["flips_per_m"]["all"], 2),
    "looks/m": (lambda s: s["looks_per_m"]["all"], 2),
    "m driven p50": (lambda s: s["path_m"]["p50"], 2),
}
COLUMNS = {"skirt": tuple(FIGURES)[:5], "map": (*tuple(FIGURES)[:3], *tuple(FIGURES)[5:])}
NONE = (None, None)
# Class: minimum success %, one bar per column, minimum success % with noise.
SKIRT = {
    "15 discs": (99.9, 1.02, 1.2, 4.0, 0.5, 5, 99),
    "30 discs": (99.9, 1.06, 1.65, 5.6, 1.4, 5, 99),
    "50 discs": (99.9, 1.35, 3.1, 11, 3, 6, 99),
    "75 discs in a box": (99.5, 1.40, 7, 12, 3, 6, 95),
    "U-traps": (99.9, 1.45, 2.2, 10.5, 3, 5, 99),
    "spirals": (99.9, 1.35, 2.4, 11, 3, 5, 99),
    "mazes": (99.9, 1.55, 4.5, 12.5, 3, 5, 99),
    "rooms": (99.5, 2.7, 10, 25, 3, 5, 95),
    "poles": (99.9, 1.04, 1.25, 5.0, 3, 5, 99),
    "enclosed": (99.9, None, None, None, 3, 5, 97),
}
# Class: minimum success %, ratio p50 and p95 with a map of 2048 bytes, with one of 16384, m driven, minimum success % with noise.
# Verdict "unreachable": 2.5 times the 11.31 m between start and goal.
MAP = {
    "15 discs": (99.9, NONE, NONE, None, 0),
    "30 discs": (99.9, (1.06, 1.5), (1.05, 1.4), None, 0),
    "50 discs": (99.9, (1.25, 2.3), (1.18, 2.0), None, 0),
    "75 discs in a box": (99.5, (1.4, 5.5), (1.3, 4), None, 97),
    "U-traps": (99.9, (1.2, 2.5), (1.1, 1.9), None, 0),
    "spirals": (99.9, (1.1, 2.4), (1.05, 1.9), None, 0),
    "mazes": (99.9, (1.08, 2.3), (1.05, 2.0), None, 0),
    "rooms": (99.5, (1.35, 5), (1.25, 3.5), None, 97),
    "poles": (99.9, NONE, NONE, None, 0),
    "enclosed": (99.9, NONE, NONE, 28.28, 0),
}
LOOKS = 8
BYTES = (2048, 16384)


def bars_of(name, planner, size, many):
    """(minimum success %, one bar per column, minimum success % with noise)"""
    if planner == "skirt":
        least, *bars, noisy_least = SKIRT[name]
        return least, bars, noisy_least
    least, *ratios, driven, noisy_least = MAP[name]
    # Fewer seconds per metre than the boundary planner in the same worlds.
    skirt = campaign(name, many, "--planner", "skirt")["s_per_m"]["p50"] if many.count else None
    pace = skirt and min(round(skirt["value"] - 0.01, 2), 15 if name == "rooms" else math.inf)
    return least, [*ratios[BYTES.index(size)], pace, LOOKS, driven], noisy_least


def share(estimate):
    percent = [100 * estimate[k] for k in ("value", "low", "high")]
    return percent[0], "{:.2f} % ({:.2f}-{:.2f})".format(*percent)


def row(name, s, least, bars, columns):
    """(the line, how many of its figures miss their bar)"""
    missed = []

    def shown(text, met):
        missed.extend([] if met else [text])
        return text if met else f"**{text}**"

    def figure(column, bar):
        (of, digits), estimate = FIGURES[column], FIGURES[column][0](s)
        if estimate is None or bar is None:
            return "-"
        return shown(f"{estimate['value']:.{digits}f} / {bar}", round(estimate["value"], digits) <= bar)

    (percent, success), (contact, touched) = share(s["success"]), share(s["contact"])
    there = "-" if s["no_way"] else share(s["truly_there"])[1]
    cells = [shown(success, percent >= least), shown(touched, contact == 0), *map(figure, columns, bars)]
    return line(name, s["missions"], there, *cells), len(missed)


@table(
    planner={"choices": ("skirt", "map"), "default": "skirt"},
    map_bytes={"type": int, "choices": BYTES},
    count={"type": int, "default": 2000, "help": "missions per class without noise (2000; 5 times as many for 30 discs)"},
    noisy={"type": int, "default": 1000, "help": "missions per class with noise (1000)"},
    seed={"type": int, "help": "the first seed; by default from the commit's hash, so that no planner can be tuned to the worlds"},
    gate={"action": "store_true"},
)
def bars(o):
    """A campaign of a planner in every class of world beside the planner's bars; a figure that misses its bar is bold. The map planner
    must need fewer seconds per metre than the boundary planner in the same worlds. The bars apply to the success that the robot
    reports; the table also shows how often the robot is truly at the goal. Exit status 1 if a bar is missed.
    --gate suits campaigns too small to judge the figures: the first seed is 1, and the exit status is 1 only if a mission ends in
    contact or less than 85 % of a class succeed without noise."""
    if o.map_bytes and o.planner != "map":
        o.parser.error(f"argument --map-bytes: planner {o.planner} has no map")
    if o.seed is None:
        head = "1" if o.gate else subprocess.run(["git", "rev-parse", "HEAD"], cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True).stdout
        o.seed = int(head[:8], 16)
    size, columns, missed, failed = o.map_bytes or BYTES[0], COLUMNS[o.planner], 0, 0
    options = ("--planner", "skirt") if o.planner == "skirt" else ("--planner", "map", "--map-bytes", str(size))
    yield f"first seed {o.seed}; figure / bar, success and contact with 95 % bounds\n"
    yield heading("world", "missions", "truly there", "success", "contact", *columns)
    for name in CLASSES:
        many = Many(o.count * (5 if name == "30 discs" and not o.gate else 1), o.seed)
        least, figures, noisy_least = bars_of(name, o.planner, size, many)
        for more, runs in (((), many), (("--noise",), Many(o.noisy, o.seed))):
            if runs.count == 0:
                continue
            s = campaign(name, runs, *more, *options)
            text, misses = row(name, s, least, figures, columns) if not more else row(f"{name}, noise", s, noisy_least, [None] * len(columns), columns)
            yield text
            missed += misses
            failed += s["contact"]["value"] > 0 or (not more and s["success"]["value"] < 0.85)
    o.failed = (f"{failed} classes fail the gate" if failed else None) if o.gate else f"{missed} figures miss their bar" if missed else None


def rows_of(program, world, count, first, *options):
    """Seed to row, of `whisker campaign --csv`."""
    rows = file_of("").with_suffix(".csv")
    command = [program, "campaign", *CLASSES[world].split(), "--count", str(count), "--seed", str(first), *options, "--csv", rows]
    if subprocess.run(command, stdout=subprocess.DEVNULL, check=False).returncode:
        fail(" ".join(map(str, command)))
    with open(rows, encoding="utf-8", newline="") as file:
        return {row["seed"]: row for row in csv.DictReader(file)}


def worse_of_pairs(lost, won):
    """How probable so many lost of the pairs that differ are, or more, if both are as likely."""
    return sum(math.comb(lost + won, k) for k in range(lost, lost + won + 1)) / 2 ** (lost + won)


def longer(logs):
    """(ratio with its 95 % bounds, how probable so long a one is by chance); logs: of the ratios of pairs."""
    if len(logs) < 2:
        return "-", 1
    mean = statistics.fmean(logs)
    error = max(statistics.stdev(logs) / math.sqrt(len(logs)), 1e-9)
    bounds = "{:.3f} ({:.3f} to {:.3f})".format(*(math.exp(mean + k * 1.96 * error) for k in (0, -1, 1)))
    return bounds, statistics.NormalDist().cdf(-mean / error)


def pairs(world, o, noise, planner):
    """(the cells of a line, {figure: how probable it is by chance, if both programs are as good})"""
    options = ("--planner", planner, *(("--noise",) if noise else ()))
    new, old = (rows_of(program, world, o.count, o.first, *options) for program in (WHISKER, o.other))
    both = [(new[seed], old[seed]) for seed in old]
    if any(a["shortest_m"] != b["shortest_m"] for a, b in both):
        fail(f"{world}: the two programs make other worlds")
    good = ("unreachable",) if world == "enclosed" else ("reached", "off_goal")

    def succeeds(row):
        return row["outcome"] in good

    def differ(of):
        return sum(of(a) > of(b) for a, b in both), sum(of(b) > of(a) for a, b in both)

    won, lost = differ(succeeds)
    more, fewer = differ(lambda row: row["outcome"] == "contact")
    chances = {"success": worse_of_pairs(lost, won), "contact": worse_of_pairs(more, fewer)}
    cells = [f"+{won} -{lost}", f"{sum(a['outcome'] == 'contact' for a, _ in both)} ({more - fewer:+d})"]
    ended = [(a, b) for a, b in both if succeeds(a) and succeeds(b)]
    for figure in ("time_s", "path_m"):
        cell, chances[figure] = longer([math.log(float(a[figure]) / float(b[figure])) for a, b in ended])
        cells.append(cell)
    return cells, chances


@table(unit="missions a cell", missions=1000, other={"required": True, "metavar": "WHISKER", "help": "the program to compare with, of another commit"})
def against(o):
    """This program against another one: the reference robot with the boundary and the map planner in every class of world, with ideal
    sensors and with noise, paired by seeds. Cells: missions won and lost, by the robot's own report; contacts, and how many more; time
    and path, geometric mean of the ratios where both succeed, with 95 % bounds. Last, the figures that are worse by Holm's test over all
    of them, at 5 %."""
    if not shutil.which(o.other):
        o.parser.error(f"argument --other: {o.other} is no program")
    yield heading("world", "success", "contacts", "time", "path")
    chances = {}
    for planner in ("skirt", "map"):
        for noise in (False, True):
            for world in CLASSES:
                name = f"{planner}, {world}{', noise' if noise else ''}"
                cells, found = pairs(world, o, noise, planner)
                chances.update({f"{name}: {figure}": chance for figure, chance in found.items()})
                yield line(name, *cells)
    worse = []
    for rank, (name, chance) in enumerate(sorted(chances.items(), key=lambda item: item[1])):
        if chance > 0.05 / (len(chances) - rank):
            break
        worse.append(f"{name} (p = {chance:.1e})")
    yield f"\nWorse, of {len(chances)} figures: {'; '.join(worse) or 'none'}"
