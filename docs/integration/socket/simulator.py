#!/usr/bin/env python3
"""A robot in a field of discs, simulated in Python alone and driven by `whisker socket --tcp PORT`.

usage: simulator.py PORT [SEED [scan]]      exit status 0: at the goal without a contact
With `scan`, the beams are sectors of a lidar of 360 rays, where the first beam is.
Written from docs/socket.md.
"""

import json
import math
import random
import socket
import sys

from sectors import readings

port, seed = int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 1
scans = sys.argv[3:] == ["scan"]
GOAL, DT = (6.0, 0.0), 0.01
stream = socket.create_connection(("127.0.0.1", port), timeout=10).makefile("rw", newline="\n")


def ask(line):
    stream.write(json.dumps(line) + "\n")
    stream.flush()
    answer = json.loads(stream.readline())
    return answer if "error" not in answer else sys.exit(answer["error"])


def reading(beam, x, y, heading):
    """The nearest point of a disc within the cone."""
    c, s, nearest = math.cos(heading), math.sin(heading), math.inf
    ax, ay = x + c * beam["x_m"] - s * beam["y_m"], y + s * beam["x_m"] + c * beam["y_m"]
    axis, half = heading + math.radians(beam["angle_deg"]), math.radians(beam["cone_deg"] / 2)
    for dx, dy, r in discs:
        far = math.hypot(dx - ax, dy - ay)
        off = abs(math.remainder(math.atan2(dy - ay, dx - ax) - axis, math.tau))
        beside = max(0.0, off - half)  # beyond this edge of the cone
        if beside == 0.0:
            nearest = min(nearest, far - r)
        elif far * math.sin(min(beside, math.pi / 2)) < r and beside < math.pi / 2:
            along = far * math.cos(beside)
            nearest = min(nearest, along - math.sqrt(r * r - (far * math.sin(beside)) ** 2))
    return nearest if nearest < beam["max_m"] else "clear"


def all_readings():
    if not scans:
        return [reading(b, x, y, heading) for b in robot["beams"]]
    lidar = robot["beams"][0]
    rays = [reading({**lidar, "angle_deg": deg, "cone_deg": 0}, x, y, heading) for deg in range(360)]
    return readings([math.inf if r == "clear" else r for r in rays], 0, 1, lidar["min_m"], robot["beams"])


robot = ask({"whisker": 1, "goal": {"x_m": GOAL[0], "y_m": GOAL[1], "tolerance_m": 0.1}})
draw = random.Random(seed)
discs = [(draw.uniform(0.8, 5.2), draw.uniform(-1.5, 1.5), draw.uniform(0.05, 0.3)) for _ in range(12)]
discs = [d for d in discs if math.hypot(d[0] - GOAL[0], d[1] - GOAL[1]) > d[2] + 0.4]
radius, track, per_m = robot["body_radius_m"], robot["wheel_track_m"], robot["encoder_counts_per_m"]
every = round(1 / robot["range_rate_hz"] / DT)
x = y = heading = left = right = 0.0
for tick in range(60000):
    answer = ask({
        "t_s": tick * DT,
        "range_m": all_readings() if tick % every == 0 else [None] * 3,
        "counts": [math.floor(left * per_m), math.floor(right * per_m)],
    })
    if answer["outcome"] != "running":
        break
    v_left, v_right = answer["wheel_mps"]
    left, right = left + v_left * DT, right + v_right * DT
    turn = (v_right - v_left) / track * DT
    x += (v_left + v_right) / 2 * DT * math.cos(heading + turn / 2)
    y += (v_left + v_right) / 2 * DT * math.sin(heading + turn / 2)
    heading += turn
    if any(math.hypot(x - dx, y - dy) < r + radius for dx, dy, r in discs):
        sys.exit(f"contact after {tick * DT:.2f} s")
print(f"{answer['outcome']} after {answer['t_s']:.2f} s, {math.hypot(x - GOAL[0], y - GOAL[1]):.3f} m from the goal")
sys.exit(answer["outcome"] != "reached")
