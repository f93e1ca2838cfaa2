"""The core on an emulated chip drives the simulated robot exactly as the core in this process: same rows, same verdict.

usage: closed_loop.py ROOT WHISKER
"""

import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from whisker import RANGE_TRUST

# (argument of --chip, scenario, planner with its options)
TRAP = "host/worlds/scenarios/figure8_u_trap.toml"
SHORT = "host/worlds/scenarios/two_discs.toml"
BY_DAY = (
    ("cortex-m3 companion --serial", TRAP, "skirt"),
    ("cortex-m3", SHORT, "thesis"),
    ("rv32imac companion --serial", SHORT, "skirt"),
    ("wasm32", TRAP, "skirt"),
    ("cortex-m0plus", SHORT, "map"),
    ("cortex-m3", TRAP, "map --map-bytes 16384"),
)
# With WHISKER_LONG.
AT_NIGHT = (
    ("cortex-m0plus", TRAP, "skirt"),
    ("rv32imac", TRAP, "skirt"),
    ("cortex-m0plus companion --serial", SHORT, "skirt"),
)
DRIVES = BY_DAY + (AT_NIGHT if "WHISKER_LONG" in os.environ else ())
NOT_SENT = ("guide", "way_x_m", "way_y_m")
# Planners that a chip has no room for, and the error message.
REFUSALS = (
    ("cortex-m0plus", "map --map-bytes 16384", "has room for 8192 bytes of map, not 16384"),
)


def drive(whisker, scenario, planner, trace, chip=None):
    command = [whisker, "run", scenario, "--planner", *planner.split(), "--trace", trace, "--json"]
    done = subprocess.run(command + (["--chip", chip] if chip else []), capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"exit status {done.returncode}: {done.stderr}{done.stdout}")
    result = json.loads(done.stdout)
    for key in RANGE_TRUST:  # a chip does not send what it noticed of its rangefinders
        del result[key]
    return result, told(pathlib.Path(trace).read_text().splitlines())


def told(lines):
    """The trace without the columns that a chip does not send."""
    rows = [line.split(",") for line in lines]
    kept = [column for column, name in enumerate(rows[0]) if name not in NOT_SENT]
    if len(kept) != len(rows[0]) - len(NOT_SENT):
        raise RuntimeError(f"the trace lacks a column of {', '.join(NOT_SENT)}")
    return [",".join(row[column] for column in kept) for row in rows]


def first_difference(here, there):
    for number, (a, b) in enumerate(zip(here, there), 1):
        if a != b:
            return f"line {number}:\n  here  {a}\n  there {b}"
    return "one is longer"


def judge(root, whisker, folder, number):
    """(the problem of this drive or None, its verdict)."""
    chip, scenario, planner = DRIVES[number]
    trace, path = str(pathlib.Path(folder, f"{number}.csv")), str(pathlib.Path(root, scenario))
    try:
        here = drive(whisker, path, planner, trace)
        there = drive(whisker, path, planner, trace, f"{root}/scripts/chip {chip}")
    except RuntimeError as error:
        return str(error), None
    return None if here == there else first_difference(here[1], there[1]), here[0]


def refuses(root, whisker, folder, chip, planner, words):
    """None if the command prints only this message and writes no file."""
    trace = pathlib.Path(folder, "refused.csv")
    try:
        drive(whisker, str(pathlib.Path(root, SHORT)), planner, str(trace), f"{root}/scripts/chip {chip}")
    except RuntimeError as error:
        said = str(error)
        well = said.startswith("exit status 2: ") and said.endswith(words + "\n")
        return None if well and not trace.exists() else said
    return "it drove"


def main(root, whisker):
    wrong = 0
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = pool.map(lambda number: judge(root, whisker, folder, number), range(len(DRIVES)))
        for (chip, scenario, planner), (problem, verdict) in zip(DRIVES, found):
            wrong += problem is not None
            print(f"{chip}, {planner}, {pathlib.Path(scenario).stem}: {problem or verdict}", flush=True)
        for chip, planner, words in REFUSALS:
            problem = refuses(root, whisker, folder, chip, planner, words)
            wrong += problem is not None
            print(f"{chip}, {planner}: {problem or words}")
    print(f"closed loop: {len(DRIVES)} drives, {len(REFUSALS)} refusals, {wrong} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
