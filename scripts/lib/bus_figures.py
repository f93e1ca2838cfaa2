"""A plant process and a controller process on vcan0: the table of docs/can.md.

As a program under scripts/with-vcan, it drives and prints the measurements as one JSON object: bus_figures.py SEED SECONDS
"""

import json
import os
import pathlib
import platform
import re
import subprocess
import sys
import tempfile
import time

from campaigns import ROOT, WHISKER, Section, fail, heading, line, table

WAYS = {"vm": "vcan0 in the micro-VM", "user-namespace": "vcan0 of its kernel", "network-namespace": "vcan0 of its kernel"}
LIMIT_S = 900
PATIENCE_S = 300  # for each run
TICKS_PER_S, LATENCY_MS = 500, 50  # the bars
INTERFACE, LONG, STOPS = "vcan0", "spiral", 5  # the missions of LONG last longer than 100 s

# Straight ahead: the robot is at full speed when its controller is killed.
AHEAD = "time_limit_s = 10.0\n[start]\nx_m = 0.0\ny_m = 0.0\n[goal]\nx_m = 200.0\ny_m = 0.0\n"
FAST_MPS = 0.29

# Identifiers of robot 1, see docs/protocol.md.
COMMAND, COUNTS, HEARTBEAT = "101", "119", "709"
DRIVE, SAFE_STOP = 1, 4
FRAME = re.compile(r"\((\d+\.\d+)\) \S+ ([0-9A-F]{3})#((?:[0-9A-F]{2})+)\n")


# ---- On the bus


def whisker(*arguments):
    return subprocess.run([WHISKER, *map(str, arguments)], capture_output=True, text=True, timeout=PATIENCE_S, check=False)


def result_of(*arguments):
    done = whisker(*arguments, "--json")
    if not done.stdout:
        sys.exit(f"whisker {arguments[0]}: exit status {done.returncode}: {done.stderr.strip()}")
    return json.loads(done.stdout)


def world(folder, kind, seed, head=""):
    path = folder / f"{kind}.toml"
    text = whisker("world", kind, "--seed", seed, "--noise").stdout
    path.write_text(head + (re.sub(r"(?m)^time_limit_s *=.*\n", "", text) if head else text))
    return path


def lockstep(folder, seed):
    for kind in ("u-trap", "discs", "maze"):
        scenario = world(folder, kind, seed)
        both = result_of("hil", scenario, "--can", INTERFACE)
        same = both["hash"] == result_of("run", scenario)["hash"]
        yield {"world": kind, "ticks": both["ticks"], "ticks_per_s": both["bus"]["ticks_per_s"], "same": same}


def real_time(folder, seed, seconds):
    both = result_of("hil", world(folder, LONG, seed, f"time_limit_s = {seconds}.0\n"), "--can", INTERFACE, "--realtime")
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
    bus, silent = ("--can", INTERFACE, "--realtime"), {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    controller = subprocess.Popen([WHISKER, "controller", *bus], **silent)
    plant = subprocess.Popen([WHISKER, "plant", scenario, *bus, "--record", log], **silent)
    try:
        until_fast(log)
        controller.kill()
        plant.wait(PATIENCE_S)
    finally:
        for process in (controller, plant):
            process.kill()
            process.wait(PATIENCE_S)
    return stop_of(log)


def drive(seed, seconds):
    with tempfile.TemporaryDirectory(prefix="whisker-bus-") as box:
        folder = pathlib.Path(box)
        figures = {"lockstep": [*lockstep(folder, seed)], "real_time": real_time(folder, seed, seconds)}
        figures["stops"] = [stop(folder) for _ in range(STOPS)]
    print(json.dumps(figures))


# ---- The table


def measured(o):
    """(how the bus is provided, the measurements)"""
    command = [ROOT / "scripts/with-vcan", "--which", "--timeout", LIMIT_S, *(["--vm"] if o.vm else []), "--"]
    command += ["python3", "-B", pathlib.Path(__file__).resolve(), o.seed, o.seconds]
    environment = {**os.environ, "WHISKER": str(WHISKER)}
    done = subprocess.run([str(part) for part in command], cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    way = re.match(r"with-vcan: (\S+)\n", done.stderr)
    if done.returncode != 0 or way is None:
        fail(done.stderr.strip() or f"exit status {done.returncode}")
    return way[1], json.loads(done.stdout)


def rows(figures, seconds):
    """(what, figure, its bar, whether it holds)"""

    def span(values, digits):
        return f"{min(values):.{digits}f} to {max(values):.{digits}f} ms"

    for run in figures["lockstep"]:
        pace = f"{run['ticks_per_s']:.0f} ticks/s" + ("" if run["same"] else ", another trajectory")
        yield f"lockstep, {run['world']}, {run['ticks']} ticks", pace, TICKS_PER_S, run["same"] and run["ticks_per_s"] >= TICKS_PER_S
    live, wanted = figures["real_time"], 100 * seconds + 1
    yield f"real time, {live['world']}: ticks in {seconds} s", live["ticks"], wanted, live["ticks"] == wanted
    yield "- answers after the next tick", live["deadline_misses"], 0, live["deadline_misses"] == 0
    yield "- from a set to its answer: p50, p99, most", "{p50}, {p99}, {max} us".format(**live["round_trip_us"]), "-", True
    yield "- frames, and load at 500 kbit/s", f"{live['frames'] / seconds:.0f} a second, {live['load_percent']:.1f} %", "-", True
    latencies, braking, speeds = ([stop[key] for stop in figures["stops"]] for key in ("latency_ms", "braking_ms", "speed_mps"))
    held = max(latencies) <= LATENCY_MS
    yield f"from the last command to the safe stop, {len(latencies)} times", span(latencies, 1), f"{LATENCY_MS} ms", held
    yield f"from there to the last count, from {max(speeds):.1f} m/s", span(braking, 0), "-", True


def table_of(figures, seconds):
    """(the lines, how many figures miss their bar)"""
    found = list(rows(figures, seconds))
    lines = [line(what, figure if holds else f"**{figure}**", bar) for what, figure, bar, holds in found]
    return [heading("", "measured", "bar"), *lines], sum(not holds for *_, holds in found)


@table("docs/can.md", vm={"action": "store_true"}, seed={"type": int, "default": 4}, seconds={"type": int, "default": 60, "choices": range(1, 101), "metavar": "N"})
def bus_figures(o):
    """A plant process and a controller process on vcan0; a figure that misses its bar is bold.

    In lockstep, the plant waits for each answer; the figure is ticks per second. In real time, the plant ticks every 10 ms
    for --seconds N (default 60); the controller must answer each tick before the next. Then the controller is killed at
    full speed, five times; the figures are the time from its last command to the latched safe stop, and the braking time.
    The worlds are those of --seed N (default 4), with noise. --vm uses the micro-VM of scripts/with-vcan even if this
    kernel has vcan. Exit status 1 if a bar is missed."""
    before = os.getloadavg()[0]
    way, figures = measured(o)
    lines, missed = table_of(figures, o.seconds)
    yield Section("docs/can.md", "bus", made=False)
    loads = f"load average {before:.1f} before, {os.getloadavg()[0]:.1f} after"
    on = f"a {os.cpu_count()}-core {platform.machine()} computer, {WAYS[way]}; {loads}"
    yield f"`scripts/measure bus-figures{' --vm' if o.vm else ''} --seed {o.seed}` on {on}:\n"
    yield from lines
    o.failed = f"{missed} figures miss their bar" if missed else None


if __name__ == "__main__":
    drive(*map(int, sys.argv[1:3]))
