"""The tables of scripts/measure: their worlds, robots, planners and columns. A seed gives the same world in every cell."""

import collections
import csv
import functools
import json
import math
import re
import statistics
import subprocess
import tempfile
import pathlib

from campaigns import CLASSES, ROBOTS, ROOT, Many, Section, campaign, cell, example, fail, file_of, grid, heading, line
from campaigns import missions_of, summary, table, whisker

PLANNERS = {
    **{name: ("--planner", name) for name in ("skirt", "map")},
    "map, 16 KB": ("--planner", "map", "--map-bytes", "16384"),
    **{name: ("--planner", name) for name in ("fan", "repulsion", "distbug", "bug2", "wall-follower", "thesis")},
}


# ---- The planners, in every class of worlds

OUTCOMES = ("truly_there", "reached", "unreachable", "gave_up", "contact", "fault")


@table(unit="worlds a class", missions=100, planner={"nargs": "?", "default": "thesis"})
def outcomes(o):
    """The outcomes of one planner. Exit status 1 if a run ends in a fault: sensors and wheels are healthy here."""
    faults = 0
    yield heading("world", "truly there", "says reached", "unreachable", "gave up", "contact", "fault", "s/m where reached, p50")
    for name, arguments in {**CLASSES, "30 discs, noise": "discs --noise"}.items():
        s = campaign(arguments, o, "--planner", o.planner)
        faults += missions_of(s, "fault")
        pace = s["s_per_m"]["p50"]
        yield line(name, *(f"{100 * s[outcome]['value']:.1f} %" for outcome in OUTCOMES), f"{pace['value']:.1f}" if pace else "-")
    o.failed = faults and f"{faults} runs ended in a fault"


SCANNER = "scanner"
# Title: (figure of a summary, factor, digits, whether the scanner provides it).
MEASURES = {
    "Success, %": (lambda s: s["success"], 100, 0, False),
    "Wrong verdict *unreachable*, %": (lambda s: s["false_unreachable"], 100, 1, False),
    "Contact, %": (lambda s: s["contact"], 100, 1, False),
    "Path driven / shortest path, p50": (lambda s: s["ratio"]["p50"], 1, 2, True),
    "Path driven / shortest path, p95": (lambda s: s["ratio"]["p95"], 1, 2, True),
    "Seconds per metre of the shortest path, p50": (lambda s: s["s_per_m"]["p50"], 1, 1, False),
    "Turn sign flips per metre driven": (lambda s: s["flips_per_m"]["all"], 1, 1, False),
    "Stops per metre driven": (lambda s: s["stops_per_m"]["all"], 1, 1, False),
}


@table(unit="worlds a class", missions=100, note=" 95 % bounds in brackets.")
def compare(o):
    """Every planner, one table per measure. The last column of the path tables is the omniscient scanner, a reference.
    Exit status 1 if a run ends in a fault, or a robot falsely reports that it is at the goal: sensors and wheels are ideal here."""
    summaries = {(world, column): campaign(world, o, *planner) for world in CLASSES for column, planner in PLANNERS.items()}
    wrong = {what: sum(missions_of(s, key) for s in summaries.values()) for key, what in (
        ("fault", "runs ended in a fault"), ("off_goal", "robots are not at the goal where they say they are"))}  # fmt: skip
    summaries |= {(world, SCANNER): summary("scanner", arguments, o) for world, arguments in CLASSES.items()}
    for title, (figure, scale, digits, of_scanner) in MEASURES.items():
        columns = {name: name for name in (*PLANNERS, *((SCANNER,) if of_scanner else ()))}
        yield f"\n### {title}\n"
        yield from grid(("world",), {w: w for w in CLASSES}, columns, lambda w, c: cell(figure(summaries[w, c]), scale, digits))
    o.failed = next((f"{count} {what}" for what, count in wrong.items() if count), None)


# ---- Robots and sensors

EASY = [world for world in CLASSES if world not in ("75 discs in a box", "enclosed")]
OTHERS = sorted(path.stem for path in ROBOTS.glob("*.toml") if path.stem != "reference")


@table("docs/robots.md", "missions a class", 100, " Cells: success %, contact %, s/m p50.", names={"nargs": "*", "help": "only these robots"})
def robots(o):
    """Other robots and worse sensors, beside the reference robot. A robot is a file of host/robots. s/m is the ratio of the medians to
    those of the reference robot with ideal sensors in the same worlds; the last column is its geometric mean over the classes."""
    if unknown := {*o.names} - {*OTHERS}:
        fail(f"{ROBOTS} has no {', '.join(sorted(unknown))}")
    yield heading("robot", *EASY, "s/m, ratio")
    reference = {}
    for name in ("reference", *(o.names or OTHERS)):
        cells, ratio = [], 1.0
        for world in EASY:
            s = campaign(world, o, "--robot", ROBOTS / f"{name}.toml", *(("--noise",) if name in ("hc-sr04", "vl53l1x") else ()))
            median = s["s_per_m"]["p50"] and s["s_per_m"]["p50"]["value"]
            ratio *= (median or math.nan) / reference.setdefault(world, median)
            cells.append(f"{100 * s['success']['value']:.1f}, {100 * s['contact']['value']:.1f}, {median or 0:.1f}")
        yield line(name, *cells, f"{ratio ** (1 / len(EASY)):.2f}")


LIMITS, CONE = (60, 50, 45, 40, 35), 25
LAYOUTS = ((30, 0.3), (37.5, 0.3), (42.5, 0.3), (42.5, 0.2), (47.5, 0.3))  # side angle, speed


@table("docs/safety.md", "missions a class", 100)
def incidence(o):
    """Layouts of three rangefinders with sensors that lose walls seen at an angle: a row is a layout and a speed, a column an incidence
    limit L. The robot believes the true limit. Cells: missions with contact of COUNT in 30 discs / COUNT in rooms, and the success in
    both; "refused" where A + cone / 2 + L < 90."""

    def drive(layout, limit):
        side, speed = layout
        if side + CONE / 2 + limit < 90:
            return "refused"
        file = file_of(f"range_side_angle_deg = {side}\nwheel_speed_max_mps = {speed}\nrange_incidence_deg = {limit}\n"
                       f"[sensor]\nincidence_deg = {limit}\n")  # fmt: skip
        both = [campaign(world, o, "--robot", file) for world in ("30 discs", "rooms")]
        success = 100 * statistics.fmean(s["success"]["value"] for s in both)
        return f"{' / '.join(str(missions_of(s, 'contact')) for s in both)}, {success:.1f} %"

    rows = {f"{side} deg, {speed} m/s": (side, speed) for side, speed in LAYOUTS}
    return grid(("side angle, speed",), rows, {f"L {limit}": limit for limit in LIMITS}, drive)


DIAMETER, FACTORS = 0.18, (1.1, 1.15, 1.2, 1.25, 1.3, 1.35, 1.45, 1.6)


@table("docs/navigation.md", "missions a cell", 100, " Cells: passed / contacts / *unreachable*.",
       factor={"type": float, "choices": FACTORS, "action": "append", "help": "only this width, in diameters; may be repeated"})  # fmt: skip
def gaps(o):
    """The reference robot, 0.18 m across, at gaps between walls and between discs of radius 0.2 m. A row is a width. Cells: missions
    that reached the goal behind the gap / with contact / that falsely reported *unreachable*. Sensors and wheels are ideal."""

    def passed(width, column):
        s = campaign(f"{column[0]} --width {width:.4g}", o, "--planner", column[1])
        return " / ".join(str(missions_of(s, key)) for key in ("success", "contact", "unreachable"))

    rows = {(f"{DIAMETER * factor:.3f} m", f"{factor:g}"): DIAMETER * factor for factor in o.factor or FACTORS}
    kinds = (("walls", "gap"), ("discs", "disc-gap"))
    columns = {f"{title}, {planner}": (kind, planner) for title, kind in kinds for planner in ("boundary", "map")}
    return grid(("width", "in diameters"), rows, columns, passed)


# Name: the line of [sensor] or [noise], or the option of `whisker world`.
SENSORS = {
    "reference noise": "--noise",
    **{f"walls lost beyond {limit} deg": f"[sensor]\nincidence_deg = {limit}" for limit in (60, 50, 40)},
    "side beams skewed by 5 deg": "[sensor]\nskew_deg = 5",
    "cone 0.7 of the believed": "[sensor]\ncone_deg = 17.5",
    "30 % phantoms": "[sensor]\nphantom = 0.3",
    "30 % false clears": "[noise]\nrange_false_clear = 0.3",
    "side beams skewed by 25 deg": "[sensor]\nskew_deg = 25",
    "distances doubled": "[sensor]\nscale = 2",
    "80 % phantoms": "[sensor]\nphantom = 0.8",
    "70 % false clears": "[noise]\nrange_false_clear = 0.7",
}
RAN = (0, 3, 4, 5, 6, 7)  # exit statuses of a run with a verdict


def counted(words):
    return ", ".join(f"{word} {times}" for word, times in collections.Counter(words).most_common())


@table("docs/safety.md", "missions in rooms a row", 20)
def trust(o):
    """Rooms with good and bad rangefinders, and what the robot notices of them: medians of the figures at the end of the missions, the
    levels of trust at the end, and the outcomes. A row is a kind of sensor."""
    figures = {"contradictions_per_m": (1, 1), "phantom_share": (100, 0), "false_clear_share": (100, 0), "incidence_seen_deg": (1, 0)}
    yield heading("sensors", "contradictions per metre", "phantoms, %", "false clears, %", "walls seen up to, deg",
                  "trust at the end", "ends")  # fmt: skip
    for name, sensor in SENSORS.items():
        results = []
        for seed in range(o.first, o.first + o.count):
            lines, noise = (sensor, []) if sensor.startswith("[") else ("", [sensor])
            world = file_of("")
            whisker("world", "rooms", "--seed", seed, "--out", world, *noise)
            world.write_text(f"{world.read_text()}\n{lines}\n")
            results.append(json.loads(whisker("run", world, "--json", good=RAN, stderr=subprocess.DEVNULL)))
        cells = []
        for figure, (scale, digits) in figures.items():
            known = [r[figure] for r in results if r[figure] is not None]
            cells.append(f"{scale * statistics.median(known):.{digits}f}" if known else "-")
        ends = counted(r["detail"] if r["outcome"] == "fault" else r["outcome"] for r in results)
        yield line(name, *cells, counted(r["range_trust"] for r in results), ends)


SETTINGS = {
    "ideal sensors": (),
    "HC-SR04, noise": ("--robot", ROBOTS / "hc-sr04.toml", "--noise"),
    "VL53L1X, noise": ("--robot", ROBOTS / "vl53l1x.toml", "--noise"),
}


def bounds(estimate, scale, digits, sign=""):
    """"value (low to high)" of a mean or a ratio."""
    if estimate is None:
        return "-"
    values = (estimate[key] for key in ("value", "low", "high"))
    return "{} ({} to {})".format(*(None if value is None else f"{scale * value:{sign}.{digits}f}" for value in values))


LAWS = ROOT / "host/lab/rules/laws"


@table("docs/rules.md", "worlds a class", 100, planners={"nargs": "+", "default": ["map"], "metavar": "NAME"})
def heart(o):
    """The core's table against one of zeros, which bends no course and sets no pace, and against a straight line in D and R; paired.
    Cells, with 95 % bounds: time, core / zeros; clearance, core - zeros, mm; jerk, core / zeros; time, core / line; contacts of the
    core, zeros, line. Fails where the core's table is slower than zeros beyond the bounds, or touches more often in all."""
    touched, slower = [0, 0, 0], []

    def against(other, arguments, more):
        return summary("rules", f"compare {LAWS / other} default --worlds {arguments}", o, *more)

    def cell(name, arguments, more):
        zeros, ramp = (against(other, arguments, more) for other in ("zeros.toml", "ramp.toml"))
        contacts = [zeros["b"]["contacts"], zeros["a"]["contacts"], ramp["a"]["contacts"]]
        for i, of in enumerate(contacts):
            touched[i] += of
        low = (zeros["time_ratio"] or {}).get("low")
        if low is not None and low > 1:
            slower.append(name)
        figures = (zeros, "time_ratio", 1, 3), (zeros, "clearance_m_difference", 1000, 1, "+"), (zeros, "jerk_ratio", 1, 2), (ramp, "time_ratio", 1, 3)
        return "; ".join((*(bounds(of[key], *how) for of, key, *how in figures), ", ".join(map(str, contacts))))

    columns = {f"{planner}, {s}": ("--planner", planner, *more) for planner in o.planners for s, more in SETTINGS.items()}
    yield heading("world", *columns)
    for name, arguments in CLASSES.items():
        yield line(name, *(cell(f"{name}, {title}", arguments, more) for title, more in columns.items()))
    if slower or touched[0] > touched[1]:
        o.failed = f"the core's table: slower than zeros in {slower or 'none'}; contacts {touched}"


# ---- Odometry

# TAPE goes into [noise]: the scale that both wheels have in common is known to 0.1 %, as from a drive of 5 m along a tape.
GYRO = (ROBOTS / "gyro.toml").read_text(encoding="utf-8")
TAPE = "\nwheel_scale_sigma = 0\nwheel_scale_common_sigma = 0.001\n"
SOME = ("15 discs", "30 discs", "50 discs", "U-traps", "mazes", "rooms")
SIGMAS = (0, 0.0005, 0.005, 0.01)


def wheels_off(sigma):
    return "--noise", "--wheel-scale-sigma", str(sigma)


@functools.lru_cache(maxsize=None)
def with_wheels(world, sigma, count, first):
    return campaign(world, Many(count, first), *wheels_off(sigma))


def short(s):
    """The cell of a class."""

    def share(key):
        percent = 100 * s[key]["value"]
        return "0" if percent == 0 else f"{percent:.3g} %"

    if s["no_way"]:
        return f"*unreachable* {share('unreachable')}, contact {share('contact')}"
    off = s["final_distance_m"]["p50"]
    return " / ".join([share("reached"), share("truly_there"), share("contact"), f"{off['value']:.2f} m" if off else "-"])


@table("docs/odometry.md", "missions a class and grade", 100, only={"choices": ("classes", "wheels"), "help": "one of the two tables"})
def odometry(o):
    """How reliable the verdicts are with increasing scale errors of the wheels. First every class of world and wheels of 1 %: without a
    gyro, with one, and with one after a tape measurement (host/robots/gyro.toml). Then more scale errors in three classes."""
    if o.only in (None, "classes"):
        yield Section("docs/odometry.md", "realistic")
        yield heading("world", "gyro, tape", "gyro, wheels 1 %", "no gyro, wheels 1 %")
        taped, bought = file_of(GYRO + TAPE), file_of(GYRO)
        for world in CLASSES:
            with_gyro = campaign(world, o, "--noise", "--robot", taped), campaign(world, o, *wheels_off(0.01), "--robot", bought)
            yield line(world, *map(short, (*with_gyro, with_wheels(world, 0.01, o.count, o.first))))
    if o.only in (None, "wheels"):
        yield Section("docs/odometry.md", "wheels")
        worlds = "30 discs", "mazes", "enclosed"
        yield heading("wheels' scale error", *worlds)
        for sigma in SIGMAS:
            yield line(f"{100 * sigma:g} %", *(short(with_wheels(world, sigma, o.count, o.first)) for world in worlds))


GYRO_SCALE = "gyro_scale_sigma = 0.001\n"
DECLARED = """wheel_scale_common_sigma = 0.001
gyro_scale_sigma = 0.0002
gyro_walk_deg_per_sqrt_h = 0.4
gyro_warm_up_dps = 0.1
"""
UMBMARK = """wheel_scale_sigma = 0.00007
wheel_scale_common_sigma = 0.001
heading_drift_deg_per_sqrt_m = 0.3
"""
WALLS = "straight_walls = true\n"
FIXES = """wheel_scale_sigma = 0.005
heading_drift_deg_per_sqrt_m = 0.3
[noise]
fix_every_m = 2
fix_sigma_m = 0.03
fix_sigma_deg = 1
"""


def scaled(sigma, more=""):
    return GYRO.replace(GYRO_SCALE, f"gyro_scale_sigma = {sigma}\n{more}")


WHEELS, TAPED = (0.005, 0.01), ("tape",)
SPUN = DECLARED + scaled(0.0002, TAPE)
# Row: robot file, scale errors of the wheels.
HEADINGS = {
    "wheels, fixes every 2 m": (FIXES, (0.005,)),
    "gyro, scale 1 % off": (scaled(0.01), WHEELS),
    "gyro, scale 0.1 % off": (scaled(0.001), WHEELS),
    "gyro, scale 0.1 % off, tape": (scaled(0.001, TAPE), TAPED),
    "gyro, spin, tape": (SPUN, TAPED),
    "gyro, spin, tape, straight walls": (WALLS + SPUN, TAPED),
    "wheels, UMBmark, tape": (f"{UMBMARK}[noise]\n{UMBMARK}", TAPED),
    "wheels, UMBmark, tape, straight walls": (f"{WALLS}{UMBMARK}[noise]\n{UMBMARK}", TAPED),
}


ONE_CLASS = {"choices": SOME, "help": "only this class"}

OWNED = {path.stem: path for path in (*sorted((ROBOTS / "owned").glob("*.toml")), ROBOTS / "pico.toml")}
BOUGHT = scaled(0.01, "wheel_scale_sigma = 0.01\n")
# Title: (name of the section, parameters and [noise] that go into the robot's file).
GRADES = {
    "gyro": ("with a gyro, calibrated: the spin, and 5 m along a tape", SPUN),
    "wheels": ("without a gyro, calibrated: squares of 2 m, and 5 m along a tape", f"{UMBMARK}[noise]\n{UMBMARK}"),
    "bought": ("with a gyro, as bought: wheels and gyro known to 1 %", BOUGHT),
}


def graded(robot, grade):
    """The file of this robot with the parameters and the noise of this grade. The noise of its ranges is that of its [sensor]."""
    parameters, _, noise = grade.partition("[noise]\n")
    text, _, own = robot.read_text(encoding="utf-8").partition("[noise]\n")
    return file_of(f"{parameters}{text}\n[noise]\nrange_sigma_m = 0\n{own}{noise}")


@table("docs/robots.md", "missions a class", 100, " Cells: truly there %, off %, contact %, s/m p50.",
       names={"nargs": "*", "help": "only these robots"}, grade={"choices": GRADES, "help": "only this table"})  # fmt: skip
def owned(o):
    """Robots that people own, in worlds of their size, with the noise of `whisker world --noise`: a table for each grade of calibration.
    Exit status 1 after a contact."""
    if unknown := {*o.names} - {*OWNED}:
        fail(f"{ROBOTS} has no {', '.join(sorted(unknown))}")
    classes, touched = ("30 discs", "U-traps", "mazes", "rooms"), 0
    for name in [o.grade] if o.grade else GRADES:
        title, grade = GRADES[name]
        yield Section("docs/robots.md", f"owned-{name}")
        yield heading(title, *classes)
        for robot in o.names or OWNED:
            all_of = [campaign(world, o, "--noise", "--to-size", "--robot", graded(OWNED[robot], grade)) for world in classes]
            touched += sum(missions_of(s, "contact") for s in all_of)
            shares = [[f"{100 * s[key]['value']:.0f}" for key in ("truly_there", "off_goal", "contact")] for s in all_of]
            paces = [f"{s['s_per_m']['p50']['value']:.1f}" if s["s_per_m"]["p50"] else "-" for s in all_of]
            yield line(robot, *(", ".join([*share, pace]) for share, pace in zip(shares, paces)))
    o.failed = touched and f"{touched} missions ended in contact"


@table("docs/odometry.md", "missions a cell", 60, world=ONE_CLASS, row={"choices": HEADINGS, "action": "append", "help": "only this row; may be repeated"})
def gyro(o):
    """How many missions of the default planner truly end within 0.10 m of the goal, in worlds with the reference robot's noise
    (`--noise`), for scale errors of the wheels and of the gyro.

    In the first row there is no gyro, but a pose from outside every 2 m of way (3 cm, 1 degree). The gyro is that of
    host/robots/gyro.toml. In the rows "tape", the scale that both wheels have in common is known to 0.1 %, as from a drive of 5 m along
    a tape; with a gyro, the wheels then differ by nothing else, and after UMBmark with squares of 2 m by 0.007 % each
    (docs/calibration.md). In the rows "spin" the scale of the gyro is off by 0.02 %, as after a spin of three turns. In both, the robot
    declares its errors. In the rows "straight walls" it takes walls for a compass."""
    if GYRO.count(GYRO_SCALE) != 1:
        fail(f"host/robots/gyro.toml has no line {GYRO_SCALE.strip()}")

    def reached(row, world):
        text, wheels = row
        noise = ("--noise",) if wheels == "tape" else wheels_off(wheels)
        s = campaign(world, o, *noise, "--jobs", "1", "--robot", file_of(text))
        off, touched = s["final_distance_m"]["p50"], missions_of(s, "contact")
        distance = (f"{off['value']:.2f} m" if off else "-") + (f", {touched} touched" if touched else "")
        return f"{100 * s['truly_there']['value']:.0f} ({100 * s['reached']['value']:.0f}, {distance})"

    rows = {(name, "0.1 %, common" if wheels == "tape" else f"{100 * wheels:g} % each"): (text, wheels)
            for name, (text, grades) in HEADINGS.items() if name in (o.row or HEADINGS) for wheels in grades}  # fmt: skip
    return grid(("heading from", "wheels' scale error"), rows, {w: w for w in SOME if o.world in (None, w)}, reached)


def robot(each, common=0.0, gyro_scale=None, drift=0.3, walls=False, walk=0.4, warm_up=0.1, chip=""):
    """A robot file: what it declares is what [noise] draws from. `chip`: other lines of the gyro."""
    compass = WALLS if walls else ""
    declared = f"wheel_scale_sigma = {each}\nwheel_scale_common_sigma = {common}\nheading_drift_deg_per_sqrt_m = {drift}\n"
    if gyro_scale is None:
        return f"{compass}{declared}[noise]\n{declared}"
    gyro = f"gyro_scale_sigma = {gyro_scale}\ngyro_walk_deg_per_sqrt_h = {walk}\ngyro_warm_up_dps = {warm_up}\n"
    return f"{compass}{declared}{gyro}gyro = true\n{chip}[noise]\n{declared}{gyro}gyro_bias_dps = 1\n"


COARSE = "gyro_range_radps = 40\n"
ERRORS = {
    "wheels 0.05 %": robot(0.0005),
    "wheels 0.5 %": robot(0.005),
    "wheels 1 %": robot(0.01),
    "wheels 0.01 %, tape 0.1 %": robot(0.0001, 0.001),
    "gyro 1 %, wheels 1 %": robot(0.01, 0, 0.01),
    "gyro 0.1 %, wheels 1 %": robot(0.01, 0, 0.001),
    "gyro 0.1 %, wheels 1 %, 3 % common": robot(0.01, 0.03, 0.001),
    "gyro 0.01 %, tape 0.1 %": robot(0, 0.001, 0.0001),
    "wheels 0.01 %, tape 0.1 %, straight walls": robot(0.0001, 0.001, walls=True),
    "gyro 0.02 %, tape 0.1 %, straight walls": robot(0, 0.001, 0.0002, walls=True),
    "gyro 0.01 %, no walk, 40 rad/s": robot(0, 0.001, 0.0001, walk=0, chip=COARSE),
    "gyro 0.01 %, walk 0.05, 40 rad/s, 20 Hz": robot(0, 0.001, 0.0001, walk=0.05, chip=COARSE + "gyro_rate_hz = 20\n"),
    "gyro 0.01 %, no walk, warm-up 1 dps, 1000 Hz": robot(0, 0.001, 0.0001, walk=0, warm_up=1, chip="gyro_rate_hz = 1000\n"),
    "gyro 0.01 %, walk 10": robot(0, 0.001, 0.0001, walk=10),
    "gyro 0.01 %, walk 10, warm-up 1 dps, 40 rad/s, 20 Hz": robot(0, 0.001, 0.0001, walk=10, warm_up=1, chip=COARSE + "gyro_rate_hz = 20\n"),
}


def within(world, file, seed):
    """Of one mission, at its end: whether the errors of position, along, across and of the heading are within their bounds."""
    scenario, trace = file_of(""), file_of("")
    whisker("world", *CLASSES[world].split(), "--seed", seed, "--noise", "--out", scenario)
    whisker("run", scenario, "--robot", file, "--trace", trace, "--json", good=RAN)
    with trace.open(newline="") as rows:
        *_, last = csv.DictReader(rows)
    r = {key: float(text) if text else math.nan for key, text in last.items() if key not in ("state", "why", "guide")}
    x, y = r["est_x_m"] - r["x_m"], r["est_y_m"] - r["y_m"]
    c, s = math.cos(r["heading_rad"]), math.sin(r["heading_rad"])
    errors = math.hypot(x, y), x * c + y * s, y * c - x * s, math.remainder(r["est_heading_rad"] - r["heading_rad"], 2 * math.pi)
    sigmas = math.hypot(r["sigma_along_m"], r["sigma_across_m"]), r["sigma_along_m"], r["sigma_across_m"], r["sigma_heading_rad"]
    return [abs(error) / (2 * sigma) <= 1 for error, sigma in zip(errors, sigmas)]


@table(None, "missions a cell", 40, world=ONE_CLASS, errors={"choices": ERRORS, "help": "only these errors"})
def bound(o):
    """How often the robot's own bound of its pose holds, with the default planner and the reference robot's noise (`--noise`): in what
    share of the missions the true position is within `bound_m` of the estimate at the end (2 sigma), and in brackets the shares in which
    the errors along and across the heading and of the heading are within two standard deviations. Correct bounds hold in 93 to 99 %.
    The simulated errors are drawn anew for every seed, with the standard deviations that the robot's parameters declare."""

    def shares(text, world):
        held = [within(world, file_of(text), seed) for seed in range(o.first, o.first + o.count)]
        return "{:.0f} ({:.0f}, {:.0f}, {:.0f})".format(*(100 * sum(one) / o.count for one in zip(*held)))

    rows = {name: text for name, text in ERRORS.items() if o.errors in (None, name)}
    return grid(("errors",), rows, {w: w for w in SOME if o.world in (None, w)}, shares)


# ---- Calibration

# Noise, m; dropouts; phantoms; scale error of the wheels; drive along the wall, m.
NOISES = ((0, 0, 0, 0, 0), (0.01, 0.1, 0.3, 0, 0), (0.01, 0.1, 0.3, 0.005, 0), (0.01, 0.1, 0.3, 0.005, 0.2))


@table("docs/calibration.md", "random robots a row", 300)
def calibration(o):
    """The errors of `whisker robot calibrate` on random simulated robots. A row is a grade of noise."""
    if o.update:
        yield Section("docs/calibration.md", "example", made=False)
        yield from example("robot calibrate host/robots/hc-sr04.toml --sigma 0.01 --dropout 0.1 --phantom 0.3")

    def sizes(figure):
        return f"{figure['p50_deg']:.2f} / {figure['p95_deg']:.2f} / {max(abs(figure['least_deg']), abs(figure['most_deg'])):.2f}"

    yield Section("docs/calibration.md", "accuracy")
    yield heading(
        "noise, dropouts, phantoms, wheels", "axis", "cone / 2 + L", "L", "L, true cone known", "written L below the true one, mean / least",
        "written L too large", "beams not measured",
    )  # fmt: skip
    for sigma, dropout, phantom, scale, along in NOISES:
        noise = f"--sigma {sigma} --dropout {dropout} --phantom {phantom} --wheel-scale-sigma {scale} --along {along}"
        t = summary("robot", f"calibrate {ROBOTS}/reference.toml {noise}", o)
        known, written = t["L of the believed cone"], t["written"]
        yield line(
            f"{1000 * sigma:g} mm, {100 * dropout:g} %, {100 * phantom:g} %, {100 * scale:g} %" + (f"; `--along {along:g}`" if along else ""),
            sizes(t["axis"]), sizes(t["cone/2 + L"]), sizes(t["L"]), f"{known['least_deg']:+.1f} to {known['most_deg']:+.1f}",
            f"{written['mean_below_deg']:.1f} / {written['least_below_deg']:.1f}", f"{written['above']} of {written['count']}", t["refused"],
        )  # fmt: skip


SPIN = "docs/calibration/spin.svg"


@table("docs/calibration.md", "random robots a row", 1)
def wheels(o):
    """The errors of `whisker robot calibrate-drive` on random simulated robots. A row is a robot file and a scene of the spin; in
    the second table, the side of the squares and their number. All with noise."""
    if o.update:
        command = "robot calibrate-drive host/robots/gyro.toml --seed 1"
        yield Section("docs/calibration.md", "drive-example", made=False)
        yield from example(command)
        yield Section("docs/calibration.md", "tape-example", made=False)
        yield from example("robot calibrate-drive host/robots/reference.toml --tape 5:5.034")
        whisker(*command.split(), "--svg", SPIN, cwd=ROOT)

    def cells(values, names):
        for name in names:
            v = values.get(name)
            yield f"{100 * v['rms']:.4f} / {100 * v['p95']:.4f} ({100 * v['within_two']:.0f})" if v else "-"

    names = ("gyro_scale", "wheel_ratio", "encoder_counts_per_m", "wheel_track_m")
    yield Section("docs/calibration.md", "wheels-accuracy")
    yield heading("robot file", "scene", *(f"`{name}`" for name in names), "without a result")
    for name in ("gyro", "reference", "hc-sr04", "vl53l1x"):
        for scene in ("room", "wall"):
            done = summary("robot", f"calibrate-drive {ROBOTS}/{name}.toml --scene {scene} --noise", o)
            missing = ", ".join(f"{count} {what}" for what, count in done["troubles"].items()) or "0"
            yield line(name, scene, *cells(done["values"], names), missing)
    names = ("wheel_ratio", "wheel_track_m")
    yield Section("docs/calibration.md", "squares-accuracy")
    yield heading("side", "squares to each side", *(f"`{name}`" for name in names))
    for side, number in ((1, 5), (2, 5), (2, 10)):
        done = summary("robot", f"calibrate-drive {ROBOTS}/reference.toml --side {side} --squares {number} --noise", o)
        yield line(f"{side} m", number, *cells(done["values"], names))


# ---- The core

# Name: definitions.
IMAGES = {"everything": (), "without the code for a gyro": ("-DWHISKER_GYRO=0",)}
CHIP = (
    "-mcpu=cortex-m3 -mthumb -ffreestanding -fno-exceptions -fno-rtti -fno-threadsafe-statics -fno-use-cxa-atexit"
    " -fno-asynchronous-unwind-tables -ffunction-sections -fdata-sections -Os -DNDEBUG -std=c++17"
).split()
GUARD = ("chassis.cpp", "guard.cpp", "health.cpp", "params.cpp", "planning/motion_controller.cpp", "planning/steering.cpp",
         *(f"{folder}/*.cpp" for folder in ("control", "fuzzy", "localization", "math", "params", "perception", "safety")))  # fmt: skip


def image(definitions, folder, *optimised):
    """(flash, RAM) in bytes, without a stack. optimised: options of compiler and linker."""

    def run(*command):
        return subprocess.run([f"arm-none-eabi-{command[0]}", *map(str, command[1:])], check=True, capture_output=True, text=True).stdout

    sources = [path for pattern in GUARD for path in sorted((ROOT / "firmware").glob(pattern))]
    objects = []
    for source in (ROOT / "hal/runtime/memory.cpp", *sources, ROOT / "tests/guard/footprint.cpp"):
        objects.append(folder / f"{len(objects)}.o")
        # Calls of the functions of memory.cpp appear after link-time optimisation.
        options = () if source.name == "memory.cpp" else optimised
        run("g++", *CHIP, *options, *definitions, f"-I{ROOT}", "-c", source, "-o", objects[-1])
    memory, *core, main = objects
    archive, program = folder / "core.a", folder / "guard.elf"
    archive.unlink(missing_ok=True)
    run("gcc-ar", "rc", archive, *core)
    run("g++", *CHIP, *optimised, "-nostartfiles", "-nostdlib", "-Wl,--gc-sections", "-e", "main", main, memory, archive, "-lgcc", "-o", program)
    text, data, bss = map(int, run("size", program).splitlines()[1].split()[:3])
    return text + data, data + bss


@table(needs_whisker=False)
def guard(_):
    """Flash and RAM of a program with nothing but whisker::Guard on a Cortex-M3 (-Os). Needs arm-none-eabi-g++."""
    yield heading("image", "flash, bytes", "with link-time optimisation", "RAM, bytes")
    with tempfile.TemporaryDirectory() as folder:
        for name, definitions in IMAGES.items():
            flash, ram = image(definitions, pathlib.Path(folder))
            joined, _ = image(definitions, pathlib.Path(folder), "-flto")
            yield line(name, f"{flash:,}", f"{joined:,}", f"{ram:,}")


def git(*words):
    done = subprocess.run(["git", "-C", ROOT, *words], capture_output=True, text=True, check=False)
    return done.stdout if done.returncode == 0 else fail(done.stderr.strip().splitlines()[0])


def room(path):
    """firmware/planning/global/a.cpp -> firmware/planning; firmware/params.hpp -> firmware/params; hal/a.hpp -> hal."""
    parts = path.split("/")
    if len(parts) > 2:
        return "/".join(parts[:2])
    return f"firmware/{parts[1].split('.')[0]}" if parts[0] == "firmware" else parts[0]


@table(needs_whisker=False, revision={"nargs": "*", "metavar": "REV", "help": "default HEAD"})
def house(o):
    """The folders of the core and of the HAL at a commit, lowest layer first, with their sizes and includes."""
    revision = o.revision[0] if o.revision else "HEAD"
    files, lines, included = collections.Counter(), collections.Counter(), collections.defaultdict(collections.Counter)
    for name in git("ls-tree", "-r", "--name-only", revision, "firmware", "hal").split():
        if name.endswith((".cpp", ".hpp")):
            text, here = git("show", f"{revision}:{name}"), room(name)
            files[here] += 1
            lines[here] += text.count("\n")
            included[here].update(room(target) for target in re.findall(r'^#include "([^"]+)"', text, re.MULTILINE) if room(target) != here)
    # Lowest first: a folder stands above those that it includes, unless they include each other.
    order, left = [], {*files}
    while left:
        free = [r for r in left if not (included[r].keys() & left) - {r}]
        order += sorted(free) or [min(left, key=lambda r: (len(included[r].keys() & left), r))]
        left -= {*order}
    both = {(a, b) for a in files for b in included[a] if b in files and a in included[b]}
    yield heading("folder", "files", "lines", "includes")
    for name in order:
        shown = [(f"**{t}**" if (name, t) in both else t).replace("firmware/", "") for t in order if t in included[name]]
        yield line(f"`{name}`", files[name], f"{lines[name]:,}", ", ".join(shown))
    yield f"\n{len(both) // 2} pairs of folders include each other" + (", in bold." if both else ".")
