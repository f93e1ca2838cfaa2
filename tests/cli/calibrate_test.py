"""`whisker robot calibrate`: simulated spins, logs, a spin over CAN, and what it refuses."""

import json
import pathlib
import signal
import subprocess

import whisker
from slcan_bridge import Bridge
from whisker import Case

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
NOISE = ("--sigma", "0.01", "--dropout", "0.1", "--phantom", "0.3")
ROBOT = "range_offset_m = 0.05\nrange_incidence_deg = 60\n[sensor]\nincidence_deg = 47\nskew_deg = 4\n"
WALL = "[start]\nx_m = 0.0\ny_m = 0.0\nheading_deg = 0\n[goal]\nx_m = 0.0\ny_m = 0.0\n[[wall]]\npoints = [[0.3, -20], [0.3, 20]]\n"


def calibrate(*arguments, **options):
    return whisker.whisker("robot", "calibrate", *arguments, **options)


class Calibrate(Case):
    def measured(self, *arguments):
        done = calibrate(*arguments, "--json")
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        result = json.loads(done.stdout)
        self.assertTrue(result["measured"])
        self.assertLessEqual(set(whisker.ORIGIN), set(result))
        return result

    def near_truth(self, result, axis=0.8, edge=0.8):
        for beam in result["beams"]:
            with self.subTest(beam["beam"]):
                self.assertAlmostEqual(beam["axis_deg"], beam["true_axis_deg"], delta=axis)
                self.assertAlmostEqual(beam["edge_deg"], beam["true_edge_deg"], delta=edge)

    def test_a_simulated_spin_measures_what_is_true(self):
        robot = self.file("robot.toml", ROBOT)
        for noise in ((), NOISE):
            result = self.measured(robot, *noise)
            self.near_truth(result)
            self.assertEqual([round(b["skew_deg"]) for b in result["beams"]], [4, 0, -4])
            self.assertEqual([b["true_incidence_deg"] for b in result["beams"]], [47] * 3)
            value = float(dict(line.split(" = ") for line in result["lines"])["range_incidence_deg"])
            self.assertLessEqual(value, 47, "to the safe side")
            self.assertGreaterEqual(value, 44)
        self.assertEqual(calibrate(robot, *NOISE, "--json").stdout, calibrate(robot, *NOISE, "--json").stdout)
        other = self.measured(robot, *NOISE, "--seed", 2)
        self.assertNotEqual(other["beams"], self.measured(robot, *NOISE)["beams"])

    def test_the_lines_make_the_robot_right(self):
        robot = self.file("robot.toml", ROBOT)
        words = calibrate(robot, *NOISE)
        self.assertEqual((words.returncode, words.stderr), (0, ""))
        self.assertIn(f"Write into {robot}:\n", words.stdout)
        lines = self.measured(robot, *NOISE)["lines"]
        self.assertEqual([line.split(" = ")[0] for line in lines],
                         ["range_left_angle_deg", "range_right_angle_deg", "range_incidence_deg"])  # fmt: skip
        for line in lines:
            self.assertIn(f"\n{line}\n", words.stdout)
        right = self.file("right.toml", "range_offset_m = 0.05\n" + "\n".join(lines) + "\n")
        again = self.measured(right, "--true", robot, *NOISE, "--seed", 3)
        self.near_truth(again)
        self.assertEqual([line for line in again["lines"] if "angle" in line], [])

    def test_warns_of_walls_that_are_invisible(self):
        result = self.measured(self.file("robot.toml", ROBOT))
        self.assertTrue(result["fits"])
        self.assertTrue(any(note.startswith("walls ahead may be invisible") for note in result["notes"]), result["notes"])
        self.assertIn("note: walls ahead may be invisible", calibrate(self.folder / "robot.toml").stdout)
        wide = self.measured(ROOT / "host/robots/layout-45.toml")
        self.assertEqual([n for n in wide["notes"] if "invisible" in n and "echo up to 44" not in n], [])

    def test_a_trace_of_the_spin_says_the_same(self):
        robot = self.file("robot.toml", ROBOT)
        direct = self.measured(robot, *NOISE, "--trace", self.folder / "spin.csv")
        log = self.measured(robot, "--log", self.folder / "spin.csv")
        for a, b in zip(direct["beams"], log["beams"]):
            self.assertAlmostEqual(a["axis_deg"], b["axis_deg"], delta=0.5)
            self.assertAlmostEqual(a["edge_deg"], b["edge_deg"], delta=0.6)
            self.assertNotIn("true_axis_deg", b)
        turned = self.measured(robot, "--log", self.folder / "spin.csv", "--wall-heading", 10)
        # Not exactly: the apexes are off the centre.
        self.assertAlmostEqual(turned["beams"][1]["axis_deg"], log["beams"][1]["axis_deg"] + 10, delta=2)

    def test_refuses_to_measure(self):
        robot = self.file("robot.toml", ROBOT)
        done = calibrate(robot, "--distance", "3")
        self.assertEqual(done.returncode, 6)
        self.assertEqual(done.stderr.count("beam was not measured: "), 3, done.stderr)
        self.assertIn("hardly an echo", done.stderr)
        result = json.loads(calibrate(robot, "--distance", "3", "--json").stdout)
        self.assertFalse(result["measured"])
        self.assertEqual({b["trouble"] for b in result["beams"]}, {"nothing_seen"})
        self.assertEqual(result["lines"], [])
        self.measured(robot, "--trace", self.folder / "spin.csv")
        rows = (self.folder / "spin.csv").read_text().splitlines(keepends=True)
        half = self.file("half.csv", "".join(rows[:600]))
        done = calibrate(robot, "--log", half)
        self.assertEqual(done.returncode, 6)
        self.assertIn("it must turn once around", done.stderr)

    def test_a_second_turn_measures_whether_the_body_stood_square(self):
        robot = self.file("robot.toml", ROBOT)
        off = self.measured(robot, *NOISE, "--turned", 4)
        self.assertIsNone(off["off_square_deg"])
        self.assertAlmostEqual(off["beams"][1]["axis_deg"], 4, delta=1.5)
        for turned in (4, -3):
            result = self.measured(robot, *NOISE, "--turned", turned, "--along", "0.2", "--trace", self.folder / "two.csv")
            self.near_truth(result, axis=1)
            self.assertAlmostEqual(result["off_square_deg"], turned, delta=0.8)
            self.assertIn("degrees off square", calibrate(robot, "--turned", turned, "--along", "0.2").stdout)
            log = self.measured(robot, "--log", self.folder / "two.csv", "--wall-heading", 0)
            self.assertAlmostEqual(log["off_square_deg"], turned, delta=0.8)

    def test_many_trials(self):
        robot = self.file("robot.toml", "")
        done = calibrate(robot, *NOISE, "--count", 4, "--seed", 5)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("4 random robots, seeds 5 to 8: noise 10 mm, dropouts 10 %, phantoms 30 %", done.stdout)
        result = json.loads(calibrate(robot, *NOISE, "--count", 4, "--seed", 5, "--jobs", 1, "--json").stdout)
        self.assertEqual((result["trials"], result["refused"], result["seed"]), (4, 0, 5))
        self.assertEqual(result["axis"]["beams"], 12)
        self.assertLess(result["axis"]["p95_deg"], 1)
        self.assertEqual(result["written"]["above"], 0)

    def test_wrong_use(self):
        robot = self.file("robot.toml", ROBOT)
        self.refused("robot", "calibrate", says="ROBOT")
        self.refused("robot", "calibrate", "none.toml", says="none.toml:1:1: ")
        self.refused("robot", "calibrate", robot, "--log", "none.csv", says="none.csv:1:1: cannot open")
        self.file("empty.csv", "")
        self.refused("robot", "calibrate", robot, "--log", "empty.csv", says="empty.csv:1:1: the file is empty")
        self.file("bad.csv", "t_s,heading_rad,left_m,front_m,right_m\n0,0,1,1,1\n0.1,0,x,1,1\n")
        self.refused("robot", "calibrate", robot, "--log", "bad.csv", says="bad.csv:3:3: 'x' is no number")
        self.file("bad.log", "(1.000000) can0 123#\n(2.000000) can0\n(3.000000) can0 123#\n")
        self.refused("robot", "calibrate", robot, "--log", "bad.log", "--json", says="bad.log:2:1: not a frame")
        self.refused("robot", "calibrate", robot, "--log", "bad.csv", "--can", "vcan0", says="choose one")
        self.refused("robot", "calibrate", robot, "--log", "bad.csv", "--sigma", "0.1", says="of a simulated spin")
        self.refused("robot", "calibrate", robot, "--log", "bad.csv", "--count", "3", says="of a simulated spin")
        self.refused("robot", "calibrate", robot, "--wall-heading", "3", says="only with --log")
        self.refused("robot", "calibrate", robot, "--record", "r.log", says="only with --can")
        self.refused("robot", "calibrate", robot, "--realtime", says="only with --can")
        self.refused("robot", "calibrate", robot, "--count", "3", "--distance", "1", says="--count makes random robots")
        self.refused("robot", "calibrate", robot, "--distance", "0.05", says="the body needs more than")
        self.refused("robot", "calibrate", robot, "--along", "0.05", says="--along 0.05")
        self.refused("robot", "calibrate", robot, "--log", "bad.csv", "--along", "0.2", says="not with --log")
        self.refused("robot", "calibrate", robot, "--true", "none.toml", says="none.toml:1:1: ")
        self.refused("robot", "calibrate", robot, "--trace", robot, says="would overwrite")
        self.refused("robot", "calibrate", robot, "--dropout", "1.5", says="--dropout")


class Bus(Case):
    def start(self, *arguments):
        process = subprocess.Popen(
            [whisker.binary, *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.PIPE, text=True)  # fmt: skip
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        return process

    def setUp(self):
        super().setUp()
        ends = (self.folder / "a", self.folder / "b")
        bridge = Bridge(*ends)
        self.addCleanup(bridge.close)
        self.ends = [f"slcan:{end}" for end in ends]
        self.robot = self.file("robot.toml", ROBOT)
        self.wall = self.file("wall.toml", WALL)

    def test_spins_the_robot_in_the_controllers_place(self):
        log = self.folder / "spin.log"
        command = self.start("robot", "calibrate", self.robot, "--can", self.ends[0], "--record", log, "--json")
        plant = whisker.whisker("plant", self.wall, "--robot", self.robot, "--can", self.ends[1])
        self.assertEqual(plant.returncode, 0, plant.stderr)
        out, err = command.communicate(timeout=60)
        self.assertEqual(command.returncode, 0, err)
        self.assertIn("turns on the spot, 32 s in all", err)
        result = json.loads(out)
        self.assertEqual([round(b["skew_deg"], 0) for b in result["beams"]], [4, 0, -4])
        for beam in result["beams"]:
            self.assertAlmostEqual(beam["incidence_deg"], 47, delta=0.8)
        again = json.loads(calibrate(self.robot, "--log", log, "--json").stdout)
        self.assertEqual([b["axis_deg"] for b in again["beams"]], [b["axis_deg"] for b in result["beams"]])
        self.assertEqual(calibrate(self.robot, "--log", log, "--node", 2).returncode, 2)

    def test_a_base_that_leaves_ends_the_spin(self):
        command = self.start("robot", "calibrate", self.robot, "--can", self.ends[0])
        plant = self.start("plant", self.wall, "--robot", self.robot, "--can", self.ends[1], "--realtime")
        for line in command.stderr:
            if "turns on the spot" in line:
                break
        plant.send_signal(signal.SIGINT)
        _, err = command.communicate(timeout=60)
        self.assertEqual(command.returncode, 6, err)
        self.assertIn("whisker: the spin ended early: ", err)

    def test_a_signal_ends_the_wait(self):
        command = self.start("robot", "calibrate", self.robot, "--can", self.ends[0])
        for line in command.stderr:
            if "waits for the base" in line:
                break
        command.send_signal(signal.SIGINT)
        out, _ = command.communicate(timeout=60)
        self.assertEqual((command.returncode, out), (130, ""))


if __name__ == "__main__":
    whisker.main()
