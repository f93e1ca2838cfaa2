#!/usr/bin/env python3
"""Is the companion of a Whisker robot in another process, and gives it a mission.

usage: link_plant.py SCENARIO.toml [--gyro] [--speed-mm-per-s N] [--limit-s S] [--patience-s S] -- COMMAND [ARGUMENT...]

COMMAND speaks docs/link.md on its standard input and output: build/host/firmware/apps/replay, or a chip in an emulator.
With --gyro the robot has a gyro. Prints what became of the mission as JSON. Exit status 0: the goal is reached without a contact; 1: it is not; 2: the
robot is silent or speaks another version.
"""

import argparse
import json
import os
import select
import struct
import subprocess
import sys
import time

from document import Link, Protocol
from plant import PERIOD_S, Robot, Run, World, binary_angle, micrometres

SKIRT = 0
FIRST_TICK = 1


class Silence(Exception):
    """The robot does not answer as it must."""


class Companion:
    def __init__(self, command, patience_s):
        """patience_s: for an answer."""
        self.link, self.patience_s = Link(), patience_s
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0)
        os.set_blocking(self.process.stdin.fileno(), False)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.stdin.close()
        try:
            self.process.wait(5)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()

    def wait(self, reads, writes, end):
        if not any(select.select(reads, writes, [], max(0, end - time.monotonic()))):
            raise Silence(f"the robot is silent for {self.patience_s:g} s")

    def say(self, letter, body=b""):
        data, pipe, end = letter + body, self.process.stdin, time.monotonic() + self.patience_s
        while data:
            self.wait([], [pipe], end)
            try:
                data = data[os.write(pipe.fileno(), data) :]
            except BrokenPipeError:
                raise Silence("the robot has ended") from None

    def hear(self, name):
        """The fields of an answer."""
        form, pipe, data, end = self.link.formats[name], self.process.stdout, b"", time.monotonic() + self.patience_s
        while len(data) < struct.calcsize(form):
            self.wait([pipe], [], end)
            came = os.read(pipe.fileno(), struct.calcsize(form) - len(data))
            if not came:
                raise Silence("the robot has ended")
            data += came
        return dict(zip(self.link.fields[name], struct.unpack(form, data)))

    def body(self, name, *values):
        return struct.pack(self.link.formats[name], *values)


def parameters(speed_mm_per_s, gyro):
    """All of them, raw, in the order of their indices."""
    known = Protocol().parameters
    values = {name: parameter.default for name, parameter in known.items()}
    if speed_mm_per_s:
        values["wheel_speed_max_mps"] = speed_mm_per_s * 1000
    values["gyro"] = 1 if gyro else 0
    return b"".join(struct.pack("<I", values[name] & 0xFFFFFFFF) for name in sorted(known, key=lambda n: known[n].index))


def begin(companion, world, speed_mm_per_s, gyro):
    companion.say(b"H")
    greeting = companion.hear("Greeting")
    if greeting["version"] != companion.link.version:
        raise Silence(f"the robot speaks version {greeting['version']}")
    if speed_mm_per_s or gyro:
        companion.say(b"P", parameters(speed_mm_per_s, gyro))
    x, y, heading = world.start
    companion.say(b"B", companion.body("Begin", SKIRT, 0, micrometres(x), micrometres(y), binary_angle(heading)))
    companion.say(b"G", companion.body("Target", *map(micrometres, world.goal)))


def drive(companion, world, limit_s, has_gyro):
    robot, run = Robot(world), Run()
    while not run.over() and not robot.touched() and robot.tick * PERIOD_S < limit_s:
        now_ms = round((robot.tick + FIRST_TICK) * PERIOD_S * 1000)
        beams = [v for r in robot.ranges() for v in (r.mm, r.status, r.age_ms, r.sequence)]
        if has_gyro:
            total, samples = robot.gyro()
            companion.say(b"Y", companion.body("GyroSums", total % 2**32, samples % 65536, 0))
        companion.say(b"T", companion.body("Tick", now_ms, 1, 1, 1, *beams, *robot.counts(), 1, 0))
        answer = companion.hear("Answer")
        left, right = answer["command_left"], answer["command_right"]
        run.add(answer["outcome"], answer["fault"], left, right)
        robot.command(left, right)
        robot.advance()
    companion.say(b"E")
    total = companion.hear("Total")
    return run.report(robot) | {"total_ticks": total["ticks"], "total_hash": f"{total['hash']:016x}"}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenario")
    parser.add_argument("--gyro", action="store_true")
    parser.add_argument("--speed-mm-per-s", type=int)
    parser.add_argument("--limit-s", type=float, default=120, help="of simulated time")
    parser.add_argument("--patience-s", type=float, default=30, help="for an answer")
    parser.add_argument("command", nargs="+")
    options = parser.parse_args()
    world = World.load(options.scenario)
    try:
        with Companion(options.command, options.patience_s) as companion:
            begin(companion, world, options.speed_mm_per_s, options.gyro)
            report = drive(companion, world, options.limit_s, options.gyro)
    except Silence as trouble:
        print(f"link_plant: {trouble}", file=sys.stderr)
        return 2
    print(json.dumps(report))
    return 0 if report["outcome"] == "reached" and not report["touched"] else 1


if __name__ == "__main__":
    sys.exit(main())
