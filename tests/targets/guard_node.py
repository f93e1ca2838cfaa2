"""The guard as a node on an emulated chip, behind its UART: `whisker bench drive` drives the simulated robot through it, and it stops
before the wall. The stack stays within the memories of an STM32F103.

usage: guard_node.py ROOT WHISKER
"""

import json
import pathlib
import socket
import subprocess
import sys
import tempfile
import time

SECONDS = 4  # of the drive
PATIENCE_S = 800  # all of it is in real time: a loaded computer takes many times the drive
NODE = "guard-node-stm32f103"
WORLD = """
time_limit_s = 30
[start]
x_m = 0.0
y_m = 0.0
[goal]
x_m = 3.0
y_m = 0.0
[[wall]]
points = [[0.7, -1.0], [0.7, 1.0]]
"""


def connected(path):
    end = time.monotonic() + PATIENCE_S
    while True:
        line = socket.socket(socket.AF_UNIX)
        try:
            line.connect(str(path))
            return line
        except OSError:
            line.close()
            if time.monotonic() > end:
                raise
            time.sleep(0.05)


def wait_for_guard(whisker, path):
    """The chip starts with the first byte that it gets."""
    end = time.monotonic() + PATIENCE_S
    command = [whisker, "bench", "nodes", "--socket", path, "--for", "0.5", "--json"]
    while time.monotonic() < end:
        done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE_S, check=False)
        if "guard" in [node["role"] for node in json.loads(done.stdout)["nodes"]]:
            return
    raise RuntimeError("no guard node on the bus")


def main(root, whisker):
    sys.path[:0] = [str(pathlib.Path(root, "scripts/lib")), str(pathlib.Path(root, "tests/cli"))]
    import can_node
    import chips
    from slcan_bridge import Bridge

    with tempfile.TemporaryDirectory(prefix="whisker-guard-node-") as name:
        folder = pathlib.Path(name)
        (folder / "world.toml").write_text(WORLD)
        rows = "".join(f"{i / 10},0.3,0\n" for i in range(10 * SECONDS))
        (folder / "ahead.csv").write_text("t_s,v_mps,omega_radps\n" + rows)
        with can_node.Chip(chips, "cortex-m3", NODE, folder) as chip:
            bridge = Bridge(folder / "base", folder / "operator")
            bridge.join(connected(chip.socket))
            plant = subprocess.Popen([whisker, "plant", folder / "world.toml", "--can", f"slcan:{folder / 'base'}", "--json"],
                                     stdout=subprocess.PIPE, text=True)
            wait_for_guard(whisker, folder / "operator")
            drive = subprocess.run([whisker, "bench", "drive", "--socket", folder / "operator", "--commands", folder / "ahead.csv",
                                    "--vouch", "0.3", "--json"], capture_output=True, text=True, timeout=PATIENCE_S, check=False)
            result = json.loads(plant.communicate(timeout=PATIENCE_S)[0])
            used = chip.deepest_stack()
            symbols = can_node.symbols_of(chip.image)
            room = symbols["__stack_top"] - symbols["__stack_bottom"]
            bridge.close()
    print(f"{NODE}: drive {drive.returncode} {drive.stdout.strip()}{drive.stderr}; {result['path_m']:.2f} m, "
          f"at least {result['min_clearance_m']:.3f} m from the wall; stack {used} of {room} bytes")
    kept_off = 0 < result["min_clearance_m"] < 0.1 and result["outcome"] != "contact"
    return 0 if drive.returncode == 0 and kept_off and 0 < used < room else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
