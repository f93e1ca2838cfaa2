"""Checks that the result agrees with the trace."""

import math

OUTCOMES = ("reached", "off_goal", "unreachable", "gave_up", "contact", "fault")
KEYS = ("outcome", "time_s", "path_m", "final_distance_m", "believed_distance_m", "min_clearance_m", "ticks", "hash")
FAR = 1000.0  # m: the smallest valid clearance of an empty world
CLEARANCE_SLACK = 2e-4  # m: 0.1 mm of the format, and 0.1 mm for the search between two rows


def fnv1a(commands):
    value = 0xCBF29CE484222325
    for pair in commands:
        for speed in pair:
            for byte in speed.to_bytes(2, "little", signed=True):
                value = (value ^ byte) * 0x100000001B3 % 2**64
    return f"{value:016x}"


def check_shape(result):
    yield from (f"result: {key} is missing" for key in KEYS if key not in result)
    if result.get("outcome") not in OUTCOMES:
        yield f"result: outcome {result.get('outcome')!r}"


def check_contact(world, trace, result):
    """No row overlaps an obstacle; a pressed bump switch may touch it; only the last row may be a contact, with the body at the moment of impact."""
    touch = 3 * trace.position_unit
    last = len(trace.rows) - 1
    contact = result["outcome"] == "contact"
    for i, row in enumerate(trace.rows):
        gap = world.gap(row.at, result["time_s"] if contact and i == last else row.t)
        if contact and i == last:
            if abs(gap) > touch:
                yield f"row {i}: a contact is claimed at a gap of {gap:.6f} m"
        elif gap < (-touch if row.pressed else trace.position_unit):
            yield f"row {i}: a gap of {gap:.6f} m to an obstacle, and {'no contact' if not contact else 'it went on'}"


def check_times(scenario, trace, result):
    contact = result["outcome"] == "contact"
    ticks, end = len(trace.rows) - contact, trace.rows[-1].t
    if result["ticks"] != ticks:
        yield f"result: {result['ticks']} ticks, but the trace has {ticks}"
    earliest = trace.rows[-2].t if contact and len(trace.rows) > 1 else end
    if not earliest - 1e-6 <= result["time_s"] <= end + 1e-6:
        yield f"result: {result['time_s']} s, but the trace ends at {end}"
    if end > scenario.time_limit + 1e-9:
        yield f"result: the trace ends at {end} s, after the limit of {scenario.time_limit}"


def check_hash(trace, result):
    commands = [row.command for row in trace.rows[: result["ticks"]]]
    if None in commands:
        yield "the trace has no command columns"
    elif result["hash"] != fnv1a(commands):
        yield f"result: hash {result['hash']}, but the commands give {fnv1a(commands)}"


def check_lengths(scenario, trace, result):
    unit, rows = trace.position_unit, trace.rows
    path = sum(math.dist(a.at, b.at) for a, b in zip(rows, rows[1:]))
    if abs(result["path_m"] - path) > 1e-3 + 1e-3 * path:
        yield f"result: a path of {result['path_m']} m, but the trace has {path:.6f}"
    left = math.dist(rows[-1].at, scenario.goal)
    if abs(result["final_distance_m"] - left) > 2 * unit:
        yield f"result: ends {result['final_distance_m']} m from the goal, but the trace {left:.6f}"
    if result["outcome"] == "reached" and left > scenario.tolerance + unit:
        yield f"result: reached, but {left:.4f} m from the goal; tolerance {scenario.tolerance}"
    if result["outcome"] == "off_goal" and left < scenario.tolerance - unit:
        yield f"result: off the goal, but only {left:.4f} m from it; tolerance {scenario.tolerance}"
    if result["outcome"] == "off_goal" and scenario.odometry_is_exact:
        yield "result: off the goal, but the wheels are exact"
    if result["outcome"] in ("reached", "off_goal") and not result["believed_distance_m"] <= scenario.tolerance:
        yield f"result: it stops {result['believed_distance_m']} m from where it believes the goal to be"


def check_clearance(world, trace, result):
    """Between two rows the gap changes at most at the speed of the body plus that of the fastest mover."""
    claimed = result["min_clearance_m"]
    gaps = [world.gap(row.at, row.t) for row in trace.rows]
    if not math.isfinite(min(gaps)):
        if claimed is not None and claimed < FAR:
            yield f"result: a clearance of {claimed} m in an empty world"
        return
    if result["outcome"] == "contact":
        if not -1e-3 < claimed <= 0:
            yield f"result: a contact with a clearance of {claimed} m"
        return
    lowest = min(gaps)
    for a, b, gap_a, gap_b in zip(trace.rows, trace.rows[1:], gaps, gaps[1:]):
        span = math.dist(a.at, b.at) + world.fastest * (b.t - a.t)
        lowest = min(lowest, (gap_a + gap_b - span) / 2)
    if not lowest - CLEARANCE_SLACK <= claimed <= min(gaps) + CLEARANCE_SLACK:
        yield f"result: a clearance of {claimed} m, but the trace has {min(gaps):.6f}"


def check_stop(trace, result):
    row = trace.rows[-1]
    if result["outcome"] == "fault" and row.command not in (None, (0, 0)):
        yield f"result: a fault is a safe stop, but the last command is {row.command}"
