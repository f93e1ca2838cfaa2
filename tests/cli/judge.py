"""Checks the trace and the JSON result of a run against its scenario, without the product's code.

usage: judge.py SCENARIO TRACE RESULT.json [ROBOT.toml]
ROBOT.toml: the file given to --robot. Prints one line per complaint; exit status 0 if there is none.
"""

import itertools
import json
import sys

from judging import claims, motion, scenario, sensors, trace
from judging.world import World

SHOWN = 3  # complaints per check; a fault in one row often repeats in the next


def judge(scene, track, result):
    """The complaints; empty for a consistent run."""
    complaints = list(claims.check_shape(result))
    if complaints:
        return complaints
    world, outcome = World(scene), result["outcome"]
    for check in (
        motion.check_start(scene, track),
        motion.check_wheels(scene, track, outcome),
        motion.check_rolling(scene, track, outcome),
        sensors.check_ranges(scene, world, track),
        claims.check_contact(world, track, result),
        claims.check_times(scene, track, result),
        claims.check_hash(track, result),
        claims.check_lengths(scene, track, result),
        claims.check_clearance(world, track, result),
        claims.check_stop(track, result),
    ):
        complaints += itertools.islice(check, SHOWN)
    return complaints


def main(arguments):
    if len(arguments) not in (3, 4):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    scenario_path, trace_path, result_path, *robot = arguments
    try:
        with open(result_path, encoding="utf-8") as file:
            result = json.load(file)
        complaints = judge(scenario.load(scenario_path, *robot), trace.load(trace_path), result)
    except (OSError, ValueError, KeyError, trace.TraceError) as error:
        print(f"cannot judge: {error!r}")
        return 1
    for line in complaints:
        print(line)
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
