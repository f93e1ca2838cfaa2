"""The core on an emulated chip, as a CAN node behind its UART, drives the simulated robot into a U-trap: the commands
equal those of the core in the simulator's process. With WHISKER_LONG in the environment it also drives out again. A Cortex-M3,
also one with the memories of an STM32F103, then drives with a response table that the base sends, and its stack stays within
scripts/budget's bound.

usage: can_node.py ROOT WHISKER
"""

import json
import os
import pathlib
import re
import socket
import struct
import subprocess
import sys
import tempfile
import time

SECONDS = 10  # of the drive, without WHISKER_LONG
PATIENCE_S = 300
LONG_PATIENCE_S = 800
ROOT = pathlib.Path(__file__).resolve().parents[2]
TRAP = "host/worlds/scenarios/figure8_u_trap.toml"
NODES = (("cortex-m3", "can-node"), ("cortex-m3", "can-node-stm32f103"), ("rv32imac", "can-node"))
PLANNER = "map"
RULES = ("host/lab/rules/laws/straight.toml", "host/lab/rules/laws/sides.toml")
PAINT = 0xC0DEC0DE  # hal/runtime/stack.hpp


def hash_of(command, patience_s):
    done = subprocess.run([*map(str, command), "--json"], capture_output=True, text=True, timeout=patience_s, check=False)
    if not done.stdout:
        raise RuntimeError(f"exit status {done.returncode}: {done.stderr}")
    result = json.loads(done.stdout)
    return result["ticks"], result["hash"]


def symbols_of(image):
    text = subprocess.run(["arm-none-eabi-nm", image], capture_output=True, text=True, check=True).stdout
    return {name: int(address, 16) for address, _, name in (line.split() for line in text.splitlines() if line[0] != " ")}


class Chip:
    """Runs the node in QEMU until the end of the block."""

    def __init__(self, chips, preset, node, folder):
        target = chips.TARGETS[preset]
        self.image = chips.image(preset, target, node)
        self.socket, self.monitor = (pathlib.Path(folder, f"{preset}-{node}.{end}") for end in ("sock", "qmp"))
        uart = f"unix:{self.socket},server=on,wait=off"
        self.command = [*target.command_in_time(self.image, uart), "-qmp", f"unix:{self.monitor},server=on,wait=off"]

    def __enter__(self):
        self.process = subprocess.Popen(self.command)
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(PATIENCE_S)

    def memory(self, address, size):
        path = self.monitor.with_suffix(".memory")
        save = {"val": address, "size": size, "filename": str(path)}
        with socket.socket(socket.AF_UNIX) as line:
            line.settimeout(PATIENCE_S)
            line.connect(str(self.monitor))
            words = line.makefile("rw")
            words.readline()
            for command in ({"execute": "qmp_capabilities"}, {"execute": "memsave", "arguments": save}):
                words.write(json.dumps(command) + "\n")
                words.flush()
                answer = json.loads(words.readline())
                if "return" not in answer:
                    raise RuntimeError(f"the emulator says {answer}")
        return path.read_bytes()

    def deepest_stack(self):
        """The deepest stack, measured as in hal/runtime/stack.hpp."""
        symbols = symbols_of(self.image)
        bottom, top = symbols["__stack_bottom"], symbols["__stack_top"]
        words = struct.unpack(f"<{(top - bottom) // 4}I", self.memory(bottom, top - bottom))
        return 4 * len(words) - 4 * next(i for i, word in enumerate(words) if word != PAINT)


def drive(chips, whisker, folder, preset, node, patience_s):
    """Whether the node's commands equal those of the core in this process, and the Cortex-M3 does the rest."""
    import image_facts

    scenario = pathlib.Path(folder, "trap.toml")
    with Chip(chips, preset, node, folder) as chip:
        here = hash_of([whisker, "run", scenario, "--planner", PLANNER], patience_s)
        began = time.monotonic()
        there = hash_of([whisker, "plant", scenario, "--can", f"slcan:{chip.socket}"], patience_s)
        took_s = time.monotonic() - began
        well = here == there
        print(f"{preset} {node}: here {here}, there {there}, {there[0] / took_s:.0f} ticks a second")
        if preset == "cortex-m3":
            well = with_rules(whisker, folder, chip, patience_s) and well
            used, (bound, _) = chip.deepest_stack(), image_facts.node_stack(preset, node)
            print(f"stack {used} of {bound} bytes")
            well = well and 0 < used <= bound
    return well


def with_rules(whisker, folder, chip, patience_s):
    """The same in open ground, with the table that the base sends; then a second one, and the built-in one again."""
    world = pathlib.Path(folder, "discs.toml")
    subprocess.run([whisker, "world", "discs", "--seed", "3", "--out", world], check=True)
    world.write_text(re.sub(r"(?m)^time_limit_s *=.*$", "time_limit_s = 5", world.read_text()))
    hashes = []
    for rules in (*(pathlib.Path(ROOT, law) for law in RULES), "default"):
        here = hash_of([whisker, "run", world, "--planner", PLANNER, "--rules", rules], patience_s)
        began = time.monotonic()
        there = hash_of([whisker, "plant", world, "--can", f"slcan:{chip.socket}", "--rules", rules], patience_s)
        print(f"{rules}: here {here}, there {there}, {time.monotonic() - began:.1f} s")
        hashes.append((here, there))
    return len(set(hashes)) == len(hashes) and all(here == there for here, there in hashes)


def main(root, whisker):
    sys.path.insert(0, str(pathlib.Path(root, "scripts/lib")))
    import chips

    whole = "WHISKER_LONG" in os.environ
    limit, patience_s = ("", LONG_PATIENCE_S) if whole else (f"time_limit_s = {SECONDS}\n", PATIENCE_S)
    with tempfile.TemporaryDirectory(prefix="whisker-node-") as folder:
        pathlib.Path(folder, "trap.toml").write_text(limit + pathlib.Path(root, TRAP).read_text())
        well = [drive(chips, whisker, folder, preset, node, patience_s) for preset, node in NODES]
    return 0 if all(well) else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
