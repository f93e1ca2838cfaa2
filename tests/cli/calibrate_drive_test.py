"""`whisker robot calibrate-drive`: the procedure in the simulator, values measured by hand, and what it refuses."""

import json
import pathlib
import subprocess
import xml.etree.ElementTree
import zlib

import whisker
from slcan_bridge import Bridge
from whisker import Case

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
GYRO = ROOT / "host/robots/gyro.toml"
PLAIN = ROOT / "host/robots/reference.toml"
# Perfect ones.
SQUARES = "side,x_m,y_m\n" + "left,0.0,0.0\nright,0.0,0.0\n" * 2


def calibrate(*arguments, **options):
    return whisker.whisker("robot", "calibrate-drive", *arguments, **options)


class CalibrateDrive(Case):
    def measured(self, *arguments):
        done = calibrate(*arguments, "--json")
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        result = json.loads(done.stdout)
        self.assertTrue(result["measured"])
        self.assertLessEqual(set(whisker.ORIGIN), set(result))
        return result

    def test_finds_the_drawn_values_with_and_without_a_gyro(self):
        for robot, steps in ((GYRO, ["tape", "spin", "straight"]), (PLAIN, ["spin", "squares", "tape"])):
            result = self.measured(robot)
            self.assertEqual([s["step"] for s in result["steps"]], steps)
            keys = [v["key"] for v in result["values"]]
            self.assertEqual(keys, ["gyro_scale"] * (robot == GYRO) + ["wheel_ratio", "encoder_counts_per_m", "wheel_track_m"])
            for value in result["values"]:
                self.assertLess(abs(value["error"]), 5 * value["sigma"], value)
                self.assertLess(abs(value["error"]), 0.003, value)
            self.assertEqual([line.split(" = ")[0] for line in result["lines"]], keys)

    def test_the_lines_make_the_robot_right(self):
        true = self.file("true.toml", "gyro = true\ngyro_scale = 1.02\nwheel_ratio = 0.985\nwheel_track_m = 0.143\nencoder_counts_per_m = 5060\n")
        first = self.measured(GYRO, "--true", true)
        right = self.file("right.toml", "gyro = true\n" + "\n".join(first["lines"] + first["sigma_lines"]) + "\n")
        for value in self.measured(right, "--true", true, "--seed", 2)["values"]:
            self.assertLess(abs(value["value"] / value["before"] - 1), 0.002, value)

    def test_words_say_the_same_and_name_the_file(self):
        words = calibrate(GYRO)
        self.assertEqual((words.returncode, words.stderr), (0, ""))
        self.assertIn(f"Write into {GYRO}:\n", words.stdout)
        for line in self.measured(GYRO)["lines"]:
            self.assertIn(f"\n{line}\n", words.stdout)
        self.assertEqual(words.stdout, calibrate(GYRO).stdout, "the same for the same seed")
        self.assertNotEqual(words.stdout, calibrate(GYRO, "--seed", 2).stdout)

    def test_draws_the_spin(self):
        picture = self.folder / "spin.svg"
        self.measured(GYRO, "--svg", picture)
        root = xml.etree.ElementTree.parse(picture).getroot()
        texts = [t.text for t in root.iter("{http://www.w3.org/2000/svg}text")]
        for word in ("left / m", "front / m", "right / m", "mismatch / mm"):
            self.assertIn(word, texts)

    def test_count_says_how_accurate_it_is(self):
        done = calibrate(GYRO, "--count", 6, "--seed", 3)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("6 robots, seeds 3 to 8", done.stdout)
        result = json.loads(calibrate(GYRO, "--count", 6, "--seed", 3, "--jobs", 1, "--json").stdout)
        self.assertEqual((result["robots"], result["complete"], result["troubles"]), (6, 6, {}))
        self.assertLess(result["values"]["gyro_scale"]["rms"], 0.0005)

    def test_a_robot_without_a_scene_says_so(self):
        blind = self.file("blind.toml", "range_max_m = 0.6\nwheel_speed_max_mps = 0.15\n[sensor]\nmax_range_m = 0.1\n")
        done = calibrate(blind, "--scene", "wall")
        self.assertEqual((done.returncode, done.stderr), (6, "whisker: spin: no result: nothing_in_range\n"))
        self.assertIn("wheel_track_m = ", done.stdout, "the squares measure the track")
        result = json.loads(calibrate(blind, "--scene", "wall", "--json").stdout)
        self.assertFalse(result["measured"])
        self.assertEqual([s["trouble"] for s in result["steps"]], ["nothing_in_range", None, None])

    def test_a_tape_measures_the_common_scale(self):
        result = self.measured(PLAIN, "--tape", "5:5.05")
        self.assertEqual(result["lines"], ["encoder_counts_per_m = 4950", "wheel_track_m = 0.141414"])
        self.assertIsNone(result["seed"])
        self.assertNotIn("true", result["values"][0])

    def test_squares_measure_ratio_and_track(self):
        ends = self.file("ends.csv", SQUARES)
        self.assertEqual(self.measured(PLAIN, "--square-ends", ends)["lines"], ["wheel_ratio = 1.000000", "wheel_track_m = 0.140000"])
        # Each quarter turn is too large by alpha: the ends of Borenstein and Feng's formula, 2 sides x alpha.
        rows = "left,0.002,-0.002\nright,0.002,0.002\n" * 2
        result = self.measured(PLAIN, "--square-ends", self.file("a.csv", "side,x_m,y_m\n" + rows), "--side", 1)
        track = {v["key"]: v["value"] for v in result["values"]}["wheel_track_m"]
        self.assertAlmostEqual(track, 0.14 / (1 + 0.001 / 1.5708), delta=2e-6)
        both = self.measured(PLAIN, "--square-ends", ends, "--tape", "5:5.05")
        self.assertEqual([s["step"] for s in both["steps"]], ["tape", "squares"])

    def test_what_does_not_fit_the_robot_is_refused_with_the_reason(self):
        wide = self.file("wide.toml", "wheel_track_m = 0.178\n")
        done = calibrate(wide, "--tape", "5:5.1")
        self.assertEqual(done.returncode, 6)
        self.assertIn("track_wider_than_body", done.stderr)
        self.assertNotIn("Write into", done.stdout)

    def test_refuses(self):
        ends = self.file("ends.csv", SQUARES)
        self.refused("robot", "calibrate-drive", says="ROBOT")
        self.refused("robot", "calibrate-drive", "none.toml", says="none.toml:1:1: ")
        self.refused("robot", "calibrate-drive", PLAIN, "--tape", "5", says="two lengths in m, as 5:5.034")
        self.refused("robot", "calibrate-drive", PLAIN, "--tape", "5:x", says="two lengths in m")
        self.refused("robot", "calibrate-drive", PLAIN, "--tape", "5:0", says="both lengths are 0.5 to 100 m")
        self.refused("robot", "calibrate-drive", PLAIN, "--tape", "5:7", says="differ by more than 20 %")
        self.refused("robot", "calibrate-drive", PLAIN, "--tape", "5:5.1", "--noise", says="of a real robot")
        self.refused("robot", "calibrate-drive", PLAIN, "--square-ends", ends, "--count", 3, says="of a real robot")
        self.refused("robot", "calibrate-drive", PLAIN, "--square-ends", "none.csv", says="none.csv:1:1: cannot open")
        self.refused("robot", "calibrate-drive", PLAIN, "--square-ends", self.file("e.csv", "side,x_m,y_m\nup,1,2\n"), says="e.csv:2:1: 'up'")
        self.refused("robot", "calibrate-drive", PLAIN, "--count", 3, "--svg", "x.svg", says="--count draws the robots")
        self.refused("robot", "calibrate-drive", PLAIN, "--scene", "rom", says="did you mean 'room'")
        self.refused("robot", "calibrate-drive", PLAIN, "--side", "0.1", says="0.3 m at least")
        few = calibrate(PLAIN, "--square-ends", self.file("few.csv", "side,x_m,y_m\nleft,1,2\n"))
        self.assertEqual(few.returncode, 6)
        self.assertIn("two squares to the left and two to the right are needed", few.stderr)


class Bus(Case):
    def setUp(self):
        super().setUp()
        ends = (self.folder / "a", self.folder / "b")
        bridge = Bridge(*ends)
        self.addCleanup(bridge.close)
        self.ends = [f"slcan:{end}" for end in ends]
        self.true = self.file("true.toml", "gyro = true\n")
        room = "[[wall]]\npoints = [[0.9, -0.7], [0.9, 0.8], [-1.1, 0.8], [-1.1, -0.7], [0.9, -0.7]]\n"
        self.world = self.file("room.toml", f"[start]\nx_m = 0.0\ny_m = 0.0\nheading_deg = 0\n[goal]\nx_m = 0.5\ny_m = 0.0\n{room}")

    def driven(self, mission, world, status, *more):
        """What the command on the bus prints, while the plant has this world and orders a mission."""
        command = subprocess.Popen(
            [whisker.binary, "robot", "calibrate-drive", self.true, "--can", self.ends[0], "--mission", mission, "--json", *more],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)  # fmt: skip
        self.addCleanup(command.communicate)
        self.addCleanup(command.kill)
        subprocess.run([whisker.binary, "plant", world, "--robot", self.true, "--can", self.ends[1]], capture_output=True, timeout=60, check=False)
        out, err = command.communicate(timeout=60)
        self.assertEqual(command.returncode, status, err)
        return json.loads(out), err

    def test_the_core_spins_on_the_bus(self):
        result, _ = self.driven("spin", self.world, 0)
        values = {v["key"]: v["value"] for v in result["values"]}
        self.assertAlmostEqual(values["gyro_scale"], 1, delta=5e-4)
        self.assertAlmostEqual(values["wheel_track_m"], 0.14, delta=2e-4)

    def test_a_drive_that_is_blocked_says_so(self):
        result, err = self.driven("straight", self.world, 6)
        self.assertEqual(result["steps"][0]["trouble"], "blocked")
        self.assertIn("whisker: straight: no result: blocked", err)

    def controller(self, *arguments):
        process = subprocess.Popen([whisker.binary, "controller", "--can", self.ends[0], *arguments], stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def ordered(self, what, world, status=0, *more):
        """The result that the plant has of the controller's calibration, and its standard error."""
        done = subprocess.run(
            [whisker.binary, "plant", world, "--robot", self.wrong, "--seed", "3", "--can", self.ends[1], "--calibrate", what, "--json", *more],
            capture_output=True, text=True, timeout=60, check=False)  # fmt: skip
        self.assertEqual(done.returncode, status, done.stderr)
        return json.loads(done.stdout)["bus"]["calibration"] if done.stdout else None, done.stderr

    def test_a_controller_calibrates_by_itself_and_keeps_it(self):
        self.wrong = self.file("wrong.toml", "gyro = true\n[noise]\ngyro_scale_sigma = 0.01\nwheel_scale_sigma = 0.01\n")
        long = "[[wall]]\npoints = [[4.5, -0.9], [4.5, 1.1], [-0.6, 1.1], [-0.6, -0.9], [4.5, -0.9]]\n"
        world = self.file("long.toml", f"[start]\nx_m = 0.0\ny_m = 0.0\nheading_deg = 0\n[goal]\nx_m = 3.0\ny_m = 0.0\n{long}")
        kept = self.folder / "kept"
        first = self.controller("--calibration", kept)
        spin, _ = self.ordered("spin", world)
        self.assertEqual((spin["trouble"], spin["stored"], list(spin["values"])), ("none", "ok", ["gyro_scale", "wheel_track_m"]))
        first.kill()
        first.wait()
        self.refused("controller", "--can", self.ends[0], "--keep", kept, says=f"--keep: {kept}: has a calibration: name another file")
        # The same record of another version.
        stored = bytearray(kept.read_bytes())
        for slot in (16, 16 + 8192):
            if stored[slot] == 0xFF:
                continue
            stored[slot] += 1
            stored[slot + 36 : slot + 40] = zlib.crc32(stored[slot : slot + 36]).to_bytes(4, "little")
        newer = self.folder / "newer"
        newer.write_bytes(stored)
        self.refused("controller", "--can", self.ends[0], "--calibration", newer, says=f"--calibration: {newer}: another version of whisker has written it: name another file")
        self.controller("--calibration", kept)
        straight, _ = self.ordered("straight", world)
        self.assertEqual(list(straight["values"]), ["gyro_scale", "wheel_ratio", "wheel_track_m"])
        self.assertEqual(straight["values"]["gyro_scale"], spin["values"]["gyro_scale"], "after the restart")
        tape, _ = self.ordered("tape", world)
        self.assertEqual((tape["trouble"], tape["stored"]), ("none", "ok"))
        self.assertEqual(list(tape["values"]), ["gyro_scale", "wheel_ratio", "encoder_counts_per_m", "wheel_track_m"])
        self.assertNotEqual(tape["values"]["encoder_counts_per_m"]["value"], 5000)
        self.assertAlmostEqual(tape["values"]["encoder_counts_per_m"]["value"] / 5000, 1, delta=0.03)
        self.assertAlmostEqual(tape["values"]["encoder_counts_per_m"]["sigma"], 7.5e-4, delta=1e-4)
        straight = tape
        again, _ = self.ordered("spin", world, 0, "--drop", "1")
        for key, value in again["values"].items():
            self.assertAlmostEqual(value["value"], straight["values"][key]["value"], delta=1e-3)
            self.assertNotEqual(value["value"], {"gyro_scale": 1, "wheel_ratio": 1, "wheel_track_m": 0.14, "encoder_counts_per_m": 5000}[key])

    def test_orders_that_a_controller_refuses_have_a_reason(self):
        self.wrong = self.true
        controller = self.controller()
        _, err = self.ordered("spin", self.world, 2)
        self.assertIn("whisker: the controller does not calibrate; whisker controller does with --calibration\n", err)
        controller.kill()
        controller.wait()
        self.controller("--calibration", self.folder / "kept")
        near = self.file("near.toml", "[start]\nx_m = 0.0\ny_m = 0.0\n[goal]\nx_m = 0.4\ny_m = 0.0\n")
        _, err = self.ordered("straight", near, 2)
        self.assertIn("whisker: a straight calibration is 0.5 m long at least: the goal is too near\n", err)
        nothing, _ = self.ordered("spin", near, 4)
        self.assertEqual(nothing, {"trouble": "nothing_in_range", "stored": "nothing"})
        self.refused("plant", near, "--can", self.ends[1], "--calibrate", "spine", says="--calibrate spine: spin, straight or tape; did you mean 'spin'")
        self.refused("controller", "--can", self.ends[0], "--calibration", near, says="--calibration:")
        self.refused("controller", "--can", self.ends[0], "--calibration", "x", "--keep", "x", says="--keep and --calibration: two files")

    def test_refuses(self):
        self.refused("robot", "calibrate-drive", PLAIN, "--can", "vcan0", says="--can and --mission: both or none")
        self.refused("robot", "calibrate-drive", PLAIN, "--mission", "spin", says="--can and --mission: both or none")
        self.refused("robot", "calibrate-drive", PLAIN, "--can", "vcan0", "--mission", "spine", says="did you mean 'spin'")
        self.refused("robot", "calibrate-drive", PLAIN, "--can", "vcan0", "--mission", "spin", "--count", 2, says="drives a real robot")
        self.refused("robot", "calibrate-drive", PLAIN, "--record", "x.log", says="only with --can")


if __name__ == "__main__":
    whisker.main()
