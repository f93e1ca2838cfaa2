"""The plant of docs/integration/peer, written from the documents alone, drives missions with this core: over SLCAN on a
socket and on a pseudo terminal. Both give the same commands.

usage: peer_test.py ROOT WHISKER
"""

import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

PATIENCE_S = 240
PAUSE_S = 0.25  # longer than the command time-out

OPEN = """
name = "discs and walls"
[start]
x_m = 0.0
y_m = 0.0
heading_deg = 30.0
[goal]
x_m = 2.5
y_m = -0.5
[[disc]]
center = [1.0, 0.0]
radius_m = 0.2
[[wall]]
points = [[1.6, -0.9], [1.6, -0.1], [2.0, 0.3]]
"""
SHORT = """
name = "one disc beside the way"
[start]
x_m = 0.0
y_m = 0.0
[goal]
x_m = 1.5
y_m = 0.2
[[disc]]
center = [0.8, 0.5]
radius_m = 0.2
"""
TRAP = """
name = "trap"
[start]
x_m = 0.0
y_m = 0.0
[goal]
x_m = 1.6
y_m = 0.0
[[wall]]
points = [[0.5, 0.4], [0.9, 0.4], [0.9, -0.4], [0.5, -0.4]]
"""


def finished(process):
    """(exit status, standard output, standard error); has a time-out."""
    try:
        out, err = process.communicate(timeout=PATIENCE_S)
    except subprocess.TimeoutExpired:
        process.kill()
        out, err = process.communicate()
        err += f"\nstill running after {PATIENCE_S} s"
    return process.returncode, out, err


class Peer(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="whisker-peer-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.lines = 0

    def scenario(self, text):
        path = self.folder / "scenario.toml"
        path.write_text(text)
        return path

    def start(self, *command):
        return subprocess.Popen(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def plant(self, program, text, *options):
        return self.start(sys.executable, "-B", PEER / program, self.scenario(text), *options)

    def over_can(self, text, *options, planner="skirt"):
        self.lines += 1
        line = self.folder / f"line{self.lines}"
        controller = self.start(WHISKER, "controller", "--can", f"slcan:{line}", "--planner", planner)
        try:
            return finished(self.plant("can_plant.py", text, line, *options))
        finally:
            controller.terminate()
            finished(controller)

    def reached(self, ended):
        status, out, err = ended
        self.assertEqual(status, 0, out + err)
        report = json.loads(out)
        self.assertEqual(report["outcome"], "reached")
        self.assertFalse(report["touched"])
        self.assertLess(report["distance_to_goal_m"], 0.12)
        return report

    def test_the_goal_is_reached_over_both_ways_with_the_same_commands(self):
        socket = self.reached(self.over_can(OPEN))
        terminal = self.reached(self.over_can(OPEN, "--pty"))
        self.assertLess(socket["seconds"], 60)
        self.assertEqual(socket["not_obeyed"], 0)
        self.assertEqual(socket["hash"], terminal["hash"])

    def test_a_parameter_that_is_written_counts_and_a_trap_is_left(self):
        slow, fast = self.reached(self.over_can(TRAP, "--speed-mm-per-s", "200")), self.reached(self.over_can(TRAP))
        self.assertNotEqual(fast["hash"], slow["hash"])
        self.assertLess(fast["seconds"], slow["seconds"])

    def test_a_gyro_counts(self):
        gyro, without = self.reached(self.over_can(SHORT, "--gyro")), self.reached(self.over_can(SHORT))
        self.assertGreater(gyro["seconds"], without["seconds"] + 1.5, "it stands first to measure the bias")

    def test_in_real_time_a_controller_that_pauses_costs_a_safe_stop_and_is_resumed(self):
        line = self.folder / "line"
        controller = self.start(WHISKER, "controller", "--can", f"slcan:{line}", "--planner", "skirt")
        end = threading.Timer(PATIENCE_S, controller.kill)
        end.start()
        plant = self.plant("can_plant.py", SHORT, line, "--realtime")
        try:
            while (said := controller.stderr.readline()) and not said.endswith(": drives\n"):
                pass
            time.sleep(1)
            controller.send_signal(signal.SIGSTOP)
            time.sleep(PAUSE_S)
            controller.send_signal(signal.SIGCONT)
            report = self.reached(finished(plant))
        finally:
            end.cancel()
            plant.kill()
            controller.kill()
            finished(controller)
        self.assertGreaterEqual(report["resumed"], 1)

    def test_what_does_not_answer_is_named_and_no_wait_is_endless(self):
        short = ("--patience-s", "1")
        for line in (["--pty"], []):
            self.lines += 1
            status, out, err = finished(self.plant("can_plant.py", OPEN, self.folder / f"line{self.lines}", *short, *line))
            self.assertEqual((status, out), (2, ""))
            self.assertEqual(err, f"can_plant: no {'handshake for 1 s' if line else 'computer at the socket'}\n")


class Documents(unittest.TestCase):
    def test_the_examples_are_what_the_codec_of_the_peer_makes_of_the_tables(self):
        """The CRC of each example frame is right, and encoding its values gives its bytes."""
        import document
        import frames

        protocol = document.Protocol()
        self.assertGreater(len(protocol.examples), 15)
        for what, line in protocol.examples:
            line = line.strip("`")
            identifier, data = int(line[1:4], 16), bytes.fromhex(line[5:])
            message = protocol.by_function[identifier >> 4]
            self.assertEqual(what.split()[0], message.name)
            counter, values = frames.decode(message, identifier, data)
            self.assertEqual(frames.encode(message, identifier & 0x0F, counter, values), (identifier, data), what)

    def test_every_committed_frame_is_understood(self):
        import document
        import frames

        protocol = document.Protocol()
        for line in (ROOT / "tests/can/golden_frames.txt").read_text().splitlines():
            frame, name, *_ = line.split()
            identifier, data = int(frame[:3], 16), bytes.fromhex(frame[4:])
            message = protocol.by_function[identifier >> 4]
            self.assertTrue(name.startswith(message.name))
            frames.decode(message, identifier, data)

    def test_a_wrong_bit_anywhere_is_noticed(self):
        import document
        import frames

        protocol = document.Protocol()
        identifier, data = frames.encode(protocol.messages["Sync"], 9, 3, {"Tick": 123456, "Period": 10})
        for bit in range(64):
            wrong = bytearray(data)
            wrong[bit // 8] ^= 1 << bit % 8
            with self.assertRaises(frames.BadFrame):
                frames.decode(protocol.messages["Sync"], identifier, bytes(wrong))


class Plant(unittest.TestCase):
    """The peer's world model matches values computed by hand."""

    def test_a_cone_sees_the_nearest_thing_in_it(self):
        import math

        import plant

        disc = plant.Disc(1.0, 0.0, 0.2)
        self.assertAlmostEqual(disc.seen(0, 0, 0), 0.8)
        self.assertAlmostEqual(disc.seen(0, 0, math.radians(12)), 0.8)
        self.assertEqual(disc.seen(0, 0, math.radians(60)), math.inf)
        edge = math.radians(20) - plant.HALF_CONE
        self.assertAlmostEqual(disc.seen(0, 0, math.radians(20)), math.cos(edge) - math.sqrt(0.04 - math.sin(edge) ** 2))
        wall = plant.Wall(1.0, -5.0, 1.0, 5.0)
        self.assertAlmostEqual(wall.seen(0, 0, 0), 1.0)
        self.assertAlmostEqual(wall.seen(0, 0, math.radians(30)), 1 / math.cos(math.radians(30) - plant.HALF_CONE))
        self.assertEqual(wall.seen(0, 0, math.pi), math.inf)
        self.assertAlmostEqual(plant.Wall(1.0, 0.1, 2.0, 0.1).seen(0, 0, 0), math.hypot(1.0, 0.1))

    def test_equal_wheels_go_straight_and_opposite_ones_turn(self):
        import plant

        world = plant.World((0.0, 0.0, 0.0), (9.0, 0.0, 0.1), [])
        straight, spin = plant.Robot(world), plant.Robot(world)
        straight.command(3000, 3000)
        spin.command(-1000, 1000)
        for _ in range(100):
            straight.advance()
            spin.advance()
        self.assertAlmostEqual(straight.x, 0.3 * (1 - 0.05), 3)
        self.assertEqual(straight.y, 0)
        self.assertEqual(straight.counts()[0], int(straight.ways[0] * 5000))
        self.assertAlmostEqual(spin.heading, 0.2 / plant.TRACK * (1 - 0.05), 2)
        self.assertEqual(spin.counts()[0], (1 << 24) - spin.counts()[1] - 1)


if __name__ == "__main__":
    ROOT, WHISKER = pathlib.Path(sys.argv[1]), sys.argv[2]
    PEER = ROOT / "docs/integration/peer"
    sys.dont_write_bytecode = True
    sys.path.insert(0, str(PEER))
    unittest.main(argv=sys.argv[:1])
