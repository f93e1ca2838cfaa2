"""Drives over vcan0 and prints the measurements as one JSON object. scripts/bus-figures runs it under scripts/with-vcan.

usage: bus_runs.py WHISKER SEED SECONDS
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time

INTERFACE = "vcan0"
LOCKSTEP = ("u-trap", "discs", "maze")
LONG = "spiral"  # its missions last longer than a minute
STOPS = 5
PATIENCE_S = 300  # for each run

# Straight ahead: the robot is at full speed when its controller is killed.
AHEAD = "time_limit_s = 10.0\n[start]\nx_m = 0.0\ny_m = 0.0\n[goal]\nx_m = 200.0\ny_m = 0.0\n"
FAST_MPS = 0.29

# Identifiers of robot 1, see docs/protocol.md.
COMMAND, COUNTS, HEARTBEAT = "101", "119", "709"
DRIVE, SAFE_STOP = 1, 4
FRAME = re.compile(r"\((\d+\.\d+)\) \S+ ([0-9A-F]{3})#((?:[0-9A-F]{2})+)\n")


def whisker(*arguments):
    return subprocess.run([WHISKER, *map(str, arguments)], capture_output=True, text=True, timeout=PATIENCE_S, check=False)


def result_of(*arguments):
    done = whisker(*arguments, "--json")
    if not done.stdout:
        sys.exit(f"whisker {arguments[0]}: exit status {done.returncode}: {done.stderr.strip()}")
    return json.loads(done.stdout)


def world(folder, kind, seed):
    path = folder / f"{kind}.toml"
    path.write_text(whisker("world", kind, "--seed", seed, "--noise").stdout)
    return path


def lockstep(folder, seed):
    runs = []
    for kind in LOCKSTEP:
        scenario = world(folder, kind, seed)
        both = result_of("hil", scenario, "--can", INTERFACE)
        same = both["hash"] == result_of("run", scenario)["hash"]
        runs.append({"world": kind, "ticks": both["ticks"], "ticks_per_s": both["bus"]["ticks_per_s"], "same": same})
    return runs


def real_time(folder, seed, seconds):
    scenario = world(folder, LONG, seed)
    text = re.sub(r"(?m)^time_limit_s *=.*\n", "", scenario.read_text())
    scenario.write_text(f"time_limit_s = {seconds}.0\n{text}")
    both = result_of("hil", scenario, "--can", INTERFACE, "--realtime")
    return {"world": LONG, "ticks": both["ticks"], **both["bus"]}


def frames(log):
    """(time in s, identifier, data) of each frame that the plant sent or received."""
    for stamp, identifier, data in FRAME.findall(log.read_text("ascii")):
        yield float(stamp), identifier, bytes.fromhex(data)


def command_of(identifier, data):
    """Speed of the left wheel, if the frame is a drive command."""
    if identifier != COMMAND or data[1] >> 4 != DRIVE:
        return None
    return int.from_bytes(data[2:4], "little", signed=True) * 1e-4


def until_fast(log):
    end = time.monotonic() + PATIENCE_S
    while not log.exists() or not any((command_of(name, data) or 0) > FAST_MPS for _, name, data in frames(log)):
        if time.monotonic() > end:
            sys.exit("the robot does not come to its speed")
        time.sleep(0.2)


def stop_of(log):
    """Speed of the killed controller's last command, and the times from it to the latched stop and to standstill."""
    commanded_s = latched_s = stood_s = None
    speed, counts = 0, None
    for now_s, identifier, data in frames(log):
        commanded = command_of(identifier, data)
        if commanded is not None:
            commanded_s, speed, latched_s = now_s, commanded, None
        if identifier == HEARTBEAT and data[1] >> 4 == SAFE_STOP and latched_s is None:
            latched_s = now_s
        if identifier == COUNTS and data[2:] != counts:
            stood_s, counts = now_s, data[2:]
    if commanded_s is None or latched_s is None:
        sys.exit("the plant did not drive, or did not stop when its controller was killed")
    return {"speed_mps": speed, "latency_ms": 1000 * (latched_s - commanded_s), "braking_ms": 1000 * (stood_s - latched_s)}


def stop(folder):
    scenario, log = folder / "ahead.toml", folder / "stop.log"
    scenario.write_text(AHEAD)
    log.unlink(missing_ok=True)
    bus = ("--can", INTERFACE, "--realtime")
    controller = subprocess.Popen([WHISKER, "controller", *bus], stderr=subprocess.DEVNULL)
    plant = subprocess.Popen([WHISKER, "plant", scenario, *bus, "--record", log], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        until_fast(log)
        controller.kill()
        plant.wait(PATIENCE_S)
    finally:
        for process in (controller, plant):
            process.kill()
            process.wait(PATIENCE_S)
    return stop_of(log)


def main(seed, seconds):
    with tempfile.TemporaryDirectory(prefix="whisker-bus-") as box:
        folder = pathlib.Path(box)
        figures = {"lockstep": lockstep(folder, seed), "real_time": real_time(folder, seed, seconds)}
        figures["stops"] = [stop(folder) for _ in range(STOPS)]
    print(json.dumps(figures))


if __name__ == "__main__":
    WHISKER = sys.argv[1]
    main(*map(int, sys.argv[2:4]))
