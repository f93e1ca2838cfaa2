"""A Webots controller that lets Whisker drive. Untested: nobody has run it yet.

The robot needs: distance sensors "left", "front" and "right" that return metres and whose rays fill the cone of the beam, position
sensors "left wheel sensor" and "right wheel sensor", motors "left wheel motor" and "right wheel motor". Start `whisker socket --tcp 7000`
first. The basic time step must divide 10 ms.
"""

import json
import math
import socket

from controller import Robot  # of Webots

WHEEL_RADIUS_M = 0.03
GOAL = {"x_m": 2.0, "y_m": 0.0}

stream = socket.create_connection(("127.0.0.1", 7000)).makefile("rw", newline="\n")


def ask(line):
    stream.write(json.dumps(line) + "\n")
    stream.flush()
    answer = json.loads(stream.readline())
    if "error" in answer:
        raise SystemExit(answer["error"])
    return answer


robot = Robot()
hello = ask({"whisker": 1, "goal": GOAL})
period_ms = round(hello["period_s"] * 1000)
beams = [robot.getDevice(name) for name in ("left", "front", "right")]
encoders = [robot.getDevice(f"{side} wheel sensor") for side in ("left", "right")]
motors = [robot.getDevice(f"{side} wheel motor") for side in ("left", "right")]
for device in (*beams, *encoders):
    device.enable(period_ms)
for motor in motors:
    motor.setPosition(math.inf)
    motor.setVelocity(0)

while robot.step(period_ms) != -1:
    ranges = [beam.getValue() for beam in beams]
    counts_per_rad = hello["encoder_counts_per_m"] * WHEEL_RADIUS_M
    answer = ask({
        "t_s": robot.getTime(),
        "range_m": [r if r < b["max_m"] else "clear" for r, b in zip(ranges, hello["beams"])],
        "counts": [math.floor(e.getValue() * counts_per_rad) for e in encoders],
    })
    for motor, speed in zip(motors, answer["wheel_mps"]):
        motor.setVelocity(speed / WHEEL_RADIUS_M)
