"""The core on an emulated chip, as a CAN node behind its UART, drives the simulated robot into a U-trap: the
commands are those of the core in the simulator's process. With WHISKER_LONG in the environment it drives out again.

usage: can_node.py ROOT WHISKER
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

SECONDS = 10  # of the drive, if it is not the whole
PATIENCE_S = 300
LONG_PATIENCE_S = 800
TRAP = "host/worlds/scenarios/figure8_u_trap.toml"


def hash_of(command, patience_s):
    done = subprocess.run([*map(str, command), "--json"], capture_output=True, text=True, timeout=patience_s, check=False)
    if not done.stdout:
        raise RuntimeError(f"exit status {done.returncode}: {done.stderr}")
    result = json.loads(done.stdout)
    return result["ticks"], result["hash"]


def main(root, whisker):
    whole = "WHISKER_LONG" in os.environ
    limit, patience_s = ("", LONG_PATIENCE_S) if whole else (f"time_limit_s = {SECONDS}\n", PATIENCE_S)
    with tempfile.TemporaryDirectory(prefix="whisker-node-") as folder:
        scenario, socket = pathlib.Path(folder, "trap.toml"), pathlib.Path(folder, "node.sock")
        scenario.write_text(limit + pathlib.Path(root, TRAP).read_text())
        chip = subprocess.Popen([f"{root}/scripts/chip", "cortex-m3", "can-node", "--socket", socket])
        try:
            here = hash_of([whisker, "run", scenario], patience_s)
            began = time.monotonic()
            there = hash_of([whisker, "plant", scenario, "--can", f"slcan:{socket}"], patience_s)
            took_s = time.monotonic() - began
        finally:
            chip.terminate()
            chip.wait(PATIENCE_S)
    print(f"can-node: here {here}, there {there}, {there[0] / took_s:.0f} ticks a second")
    return 0 if here == there else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
