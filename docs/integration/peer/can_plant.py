#!/usr/bin/env python3
"""Puts a simulated robot on a CAN bus for a Whisker controller, and gives it a mission.

usage: can_plant.py SCENARIO.toml LINE [--pty] [--realtime] [--gyro] [--speed-mm-per-s N] [--limit-s S] [--patience-s S]

LINE is a name that is made: a Unix socket, or with --pty a pseudo terminal. Start there:
    whisker controller --can slcan:LINE
Prints what became of the mission as JSON. Exit status 0: the goal is reached without a contact; 1: it is not; 2: the
controller is silent or refuses something. With --gyro the robot has a gyro. With --realtime a tick comes every period, and a safe stop is followed by an order to resume.
"""

import argparse
import json
import secrets
import sys
import time

from base import CANCEL, READ, RESUME, SAFE_STOP, START, WRITE, Base, Refused
from plant import PERIOD_S, Robot, Run, World, binary_angle, micrometres
from slcan import PtyAdapter, Silence, SocketAdapter
from wheels import Wheels

FIRST_TICK = 1
PERIOD_MS = round(PERIOD_S * 1000)


def mission_of(world):
    x, y, heading = world.start
    values = [micrometres(x), micrometres(y), binary_angle(heading)]
    return values + [micrometres(length) for length in world.goal]


def try_parameters(base, speed_mm_per_s):
    """Sets the speed, and checks what the document says of parameters on the way."""
    speed = base.protocol.parameters["wheel_speed_max_mps"]
    if base.ask(READ, 255)[0] != 1:
        raise Refused("parameter 255 exists")
    if base.ask(WRITE, speed.index, speed.most + 1)[0] != 2:
        raise Refused("a value out of range is no error")
    if base.ask(READ, speed.index) != (0, speed.default):
        raise Refused("the default is another")
    base.set_parameters({"wheel_speed_max_mps": speed_mm_per_s * 1000})


def drive(base, world, limit_s, has_gyro):
    robot, run = Robot(world), Run()
    mission = mission_of(world)
    base.give(START, mission)
    while not run.over() and not robot.touched() and robot.tick * PERIOD_S < limit_s:
        gyro = robot.gyro() if has_gyro else None
        tick = robot.tick + FIRST_TICK
        left, right, outcome, fault = base.step(tick, robot.ranges(), robot.counts(), PERIOD_MS, gyro)
        run.add(outcome, fault, left, right)
        robot.command(left, right)
        robot.advance()
    base.give(CANCEL, mission)
    return run.report(robot) | {"not_obeyed": base.trouble}


def drive_in_time(base, world, limit_s, has_gyro):
    robot, run, wheels, resumed = Robot(world), Run(), Wheels(base, PERIOD_MS), 0
    base.lockstep = False
    mission = mission_of(world)
    base.give(START, mission)
    wheels.begin()
    due = time.monotonic()
    while not run.over() and not robot.touched() and robot.tick * PERIOD_S < limit_s:
        tick = robot.tick + FIRST_TICK
        base.send_set(tick, robot.ranges(), robot.counts(), PERIOD_MS, robot.gyro() if has_gyro else None)
        due = max(due, time.monotonic() - PERIOD_S) + PERIOD_S
        while time.monotonic() < due:
            base.poll(due - time.monotonic())
            wheels.hear(tick)
        left, right = wheels.speeds()
        robot.command(left, right)
        robot.advance()
        status = base.heard.pop("NavStatus", None)
        if status:
            run.add(status["Outcome"], status["Fault"], left, right)
        if base.state == SAFE_STOP and wheels.at_rest():
            base.until(lambda: True if base.matched() else None, "handshake")
            base.give(RESUME, mission)
            wheels.begin()
            resumed += 1
    base.give(CANCEL, mission)
    return run.report(robot) | {"resumed": resumed, "not_obeyed": base.trouble}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenario")
    parser.add_argument("line")
    parser.add_argument("--pty", action="store_true")
    parser.add_argument("--realtime", action="store_true")
    parser.add_argument("--gyro", action="store_true")
    parser.add_argument("--speed-mm-per-s", type=int)
    parser.add_argument("--limit-s", type=float, default=120, help="of simulated time")
    parser.add_argument("--patience-s", type=float, default=30, help="for anything that is waited for")
    options = parser.parse_args()
    world = World.load(options.scenario)
    adapter = (PtyAdapter if options.pty else SocketAdapter)(options.line)
    base = Base(adapter, secrets.randbelow(65536), options.patience_s)
    try:
        adapter.open(options.patience_s)
        base.shake_hands()
        if options.speed_mm_per_s:
            try_parameters(base, options.speed_mm_per_s)
        if options.gyro:
            base.set_parameters({"gyro": 1})
        report = (drive_in_time if options.realtime else drive)(base, world, options.limit_s, options.gyro)
    except (Silence, Refused) as trouble:
        print(f"can_plant: {trouble}", file=sys.stderr)
        return 2
    finally:
        adapter.path.unlink(missing_ok=True)
    print(json.dumps(report))
    return 0 if report["outcome"] == "reached" and not report["touched"] else 1


if __name__ == "__main__":
    sys.exit(main())
