"""A guard node on a Linux CAN interface, driven by `whisker bench drive` and by an operator that is written from docs/protocol.md.

usage: guard_test.py WHISKER ROOT
"""

import json
import random
import socket
import struct
import sys
import threading
import time
import unittest

from bus import PATIENCE_S, BusCase, Candump, wait_until

BUS = "vguard0"
ROBOT = 1
WALL = "[[wall]]\npoints = [[{x}, -1.0], [{x}, 1.0]]\n"
FRAME = struct.Struct("<IB3x8s")
RUNNING = 3
FULL_AHEAD = "B80BB80B"  # both wheels of a WheelCommand, 0.3 m/s
TIME_OUT_S, PERIOD_S, BRAKING_S = 0.05, 0.01, 0.3
ATTEMPTS = 10
LATE_TICKS = 5  # the processor may be busy


class Operator:
    """Sends its wish every 20 ms, and hears what the robot says."""

    def __init__(self):
        self.protocol = Protocol()
        self.counters = Counters()
        self.bus = socket.socket(socket.PF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
        self.bus.bind((BUS,))
        self.bus.settimeout(0.002)
        self.heard = {}
        self.wish, self.vouched_mm = (0, 0), 0
        self.over = threading.Event()
        self.thread = threading.Thread(target=self.run)
        self.thread.start()

    def say(self, name, **values):
        message = self.protocol.messages[name]
        identifier, data = encode(message, ROBOT, self.counters.next(message.function << 4 | ROBOT), values)
        self.bus.send(FRAME.pack(identifier, len(data), data))

    def run(self):
        due = time.monotonic()
        while not self.over.is_set():
            self.hear()
            if time.monotonic() < due:
                continue
            due = time.monotonic() + 0.02
            if self.wish is not None:
                forward, turning = self.wish if self.value("GuardStatus", "Armed") else (0, 0)
                self.say("Velocity", Forward=forward, Turning=turning)
            if self.vouched_mm and not self.value("GuardStatus", "Vouched"):
                self.say("Vouch", Number=7, Radius=self.vouched_mm)

    def hear(self):
        try:
            identifier, size, data = FRAME.unpack(self.bus.recv(FRAME.size))
        except TimeoutError:
            return
        message = self.protocol.by_function.get(identifier >> 4)
        if message is not None and identifier & 0x0F == ROBOT and len(data[:size]) == message.size:
            self.heard[message.name] = decode(message, identifier, data[:size])[1]

    def value(self, name, signal):
        return self.heard.get(name, {}).get(signal, 0)

    def until(self, name, signal, wanted):
        wait_until(lambda: self.value(name, signal) == wanted, lambda: f"no {name}.{signal} of {wanted}: {self.heard}")

    def end(self):
        self.over.set()
        self.thread.join(PATIENCE_S)
        self.bus.close()


class OnTheBus(BusCase):
    bus = BUS

    def guard_node(self, *arguments):
        self.start("controller", "--guard", "--can", BUS, *arguments).wait_for("waits for the base")

    def plant(self, seconds, wall_x, *arguments):
        world = self.folder / "world.toml"
        world.write_text(f"time_limit_s = {seconds}\n[start]\nx_m = 0.0\ny_m = 0.0\n[goal]\nx_m = 9.0\ny_m = 0.0\n" + WALL.format(x=wall_x))
        return self.start("plant", world, "--can", BUS, "--json", *arguments)

    def operator(self, vouched_mm):
        operator = Operator()
        self.addCleanup(operator.end)
        operator.until("Heartbeat", "State", RUNNING)
        operator.vouched_mm = vouched_mm
        operator.until("GuardStatus", "Armed", 1)
        operator.until("GuardStatus", "Vouched", 1 if vouched_mm else 0)
        return operator

    def test_the_wheels_stand_after_the_last_velocity(self):
        self.guard_node("--realtime")
        self.plant(60, 20, "--realtime")
        operator = self.operator(350)
        for attempt in range(ATTEMPTS):
            frames = self.drive_and_fall_silent(operator, self.folder / f"log{attempt}")
            last = max(i for i, (_, identifier, _) in enumerate(frames) if identifier == "0C1")
            stands = next(i for i in range(last, len(frames)) if frames[i][1] == "101" and frames[i][2][4:12] == "00000000")
            # A busy processor may cause a safe stop, which is sooner, or come late with the last Velocity, when it brakes already.
            runs = all(data[2] == str(RUNNING) for _, identifier, data in frames if identifier in ("701", "709"))
            before = next(data[4:12] for _, identifier, data in reversed(frames[:last]) if identifier == "101")
            if runs and before == FULL_AHEAD:
                break
        else:
            self.fail("it stops for other reasons")
        print(f"from the last Velocity to the command to stand: {1000 * (frames[stands][0] - frames[last][0]):.1f} ms")
        ticks = sum(identifier == "089" for _, identifier, _ in frames[last:stands])
        self.assertLessEqual(ticks, round((TIME_OUT_S + PERIOD_S + BRAKING_S) / PERIOD_S) + LATE_TICKS)
        self.assertGreater(ticks, round((TIME_OUT_S + BRAKING_S) / PERIOD_S) - LATE_TICKS)

    def drive_and_fall_silent(self, operator, log):
        """The frames: seconds, identifier and data."""
        dump = Candump(log, BUS)
        operator.wish = (3000, 0)
        wait_until(lambda: operator.value("WheelCommand", "Left") == 3000, lambda: f"it does not drive: {operator.heard}")
        operator.wish = None
        operator.until("WheelCommand", "Left", 0)
        operator.heard.pop("Heartbeat", None)
        wait_until(lambda: "Heartbeat" in operator.heard, lambda: "it is silent")  # and says whether that was a safe stop
        lines = [line.split() for line in dump.end()]
        return [(float(line[0].strip("()")), *line[2].split("#")) for line in lines]

    def test_a_hostile_operator_touches_nothing(self):
        self.guard_node("--realtime")
        # On a slow computer, the operator comes late, and most of its commands time out.
        for seconds in (12, 24, 48):
            result = self.drive_with_hostility(seconds)
            self.assertNotEqual(result["outcome"], "contact")
            self.assertGreater(result["min_clearance_m"], 0)
            if result["path_m"] > 0.02:
                return
        self.fail("it never drives")

    def drive_with_hostility(self, seconds):
        plant = self.plant(seconds, 0.5, "--realtime")
        operator = self.operator(0)
        chance = random.Random(7)
        while plant.process.poll() is None:
            operator.wish = (chance.choice((3000, -3000, 32767, -32767, 0)), chance.randint(-4000, 4000))
            time.sleep(chance.uniform(0.001, 0.3))
        operator.end()
        return plant.result()

    def test_bench_drives_by_hand(self):
        # In lockstep, a busy processor stops nothing.
        self.guard_node("--command-timeout", 2)
        plant = self.plant(60, 1)
        commands = self.folder / "ahead.csv"
        commands.write_text("t_s,v_mps,omega_radps\n" + "".join(f"{i / 10},0.3,0\n" for i in range(50)))
        done = self.once("bench", "drive", "--can", BUS, "--commands", commands, "--vouch", 0.3, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout)["outcome"], "ended")
        result = plant.result()
        self.assertGreater(result["path_m"], 0.3)
        self.assertGreater(result["min_clearance_m"], 0)


if __name__ == "__main__":
    BusCase.whisker, ROOT = sys.argv.pop(1), sys.argv.pop(1)
    sys.path.insert(0, f"{ROOT}/docs/integration/peer")
    from document import Protocol  # noqa: E402
    from frames import Counters, decode, encode  # noqa: E402

    unittest.main(verbosity=2)
