"""`whisker run`: what its options do, its exit statuses, and what goes where."""

import json
import os
import pty
import re
import select
import subprocess
import time

import whisker
from whisker import SCENARIOS, STATUS, Case, with_time_limit

NOISY = SCENARIOS / "all_noise.toml"
KEYS = {"outcome", "time_s", "path_m", "final_distance_m", "believed_distance_m", "min_clearance_m", "ticks", "hash"}
PROGRESS = re.compile(rb"\r\x1b\[K\d+ s of at most 1000000 s simulated, \d+\.\d\d m from the goal")


def run(*arguments):
    return whisker.whisker("run", *arguments)


def result(*arguments):
    """The object that --json prints, without the name of the robot's file."""
    told = json.loads(run(*arguments, "--json").stdout)
    del told["robot_name"]
    return told


class Run(Case):
    def setUp(self):
        super().setUp()
        self.noisy = self.file("noisy.toml", with_time_limit(NOISY.read_text(), 10))

    def test_the_exit_status_tells_the_outcome(self):
        for name, outcome in (
            ("nothing", "reached"),
            ("bad_wheels", "off_goal"),
            ("no_time", "gave_up"),
            ("run_over", "contact"),
            ("blind", "fault"),
        ):
            done = run(SCENARIOS / f"{name}.toml", "--json")
            self.assertEqual(json.loads(done.stdout)["outcome"], outcome)
            self.assertEqual((done.returncode, done.stderr), (STATUS[outcome], ""))

    def test_json_is_one_object_and_nothing_else(self):
        files = ("--trace", self.folder / "t.csv", "--svg", self.folder / "t.svg")
        for options in ((), files):
            done = run(self.noisy, "--json", *options)
            self.assertLessEqual(KEYS, json.loads(done.stdout).keys())
            self.assertEqual((done.stdout.count("\n"), done.stdout[-1], done.stderr), (1, "\n", ""))
            self.assertRegex(json.loads(done.stdout)["hash"], "^[0-9a-f]{16}$")

    def test_without_json_the_words_name_outcome_and_files(self):
        trace, svg = self.folder / "t.csv", self.folder / "t.svg"
        done = run(SCENARIOS / "nothing.toml", "--trace", trace, "--svg", svg)
        self.assertRegex(done.stdout, r"^reached in \d")
        self.assertIn(str(trace), done.stdout)
        self.assertIn(str(svg), done.stdout)
        self.assertEqual(done.stderr, "")

    def test_a_robot_that_only_believes_to_be_there_has_not_reached_its_goal(self):
        scenario, svg = SCENARIOS / "bad_wheels.toml", self.folder / "off.svg"
        told = result(scenario)
        self.assertEqual(told["outcome"], "off_goal")
        self.assertGreater(told["final_distance_m"], 0.1)
        self.assertLessEqual(told["believed_distance_m"], 0.1)
        done = run(scenario, "--svg", svg)
        self.assertEqual(done.returncode, 7)
        words = f"believes it is there; is {told['final_distance_m']:.2f} m off, after "
        self.assertTrue(done.stdout.startswith(words), done.stdout)
        self.assertIn(words, svg.read_text())
        wide = self.file("wide.toml", scenario.read_text().replace("[noise]", f"tolerance_m = {told['final_distance_m'] * 1.5}\n[noise]"))
        self.assertEqual(run(wide).returncode, 0, "the same wheels, a tolerance that fits them")

    def test_the_same_seed_gives_the_same_bytes(self):
        written = []
        for name in ("a", "b"):
            paths = self.folder / f"{name}.csv", self.folder / f"{name}.svg"
            done = run(self.noisy, "--trace", paths[0], "--svg", paths[1], "--json", "--seed", 3)
            written.append([done.stdout, *(path.read_bytes() for path in paths)])
        self.assertEqual(*written)
        self.assertTrue(written[0][2].startswith(b"<svg"))

    def test_seed_overrides_the_scenarios(self):
        self.assertEqual(result(self.noisy), result(self.noisy, "--seed", 5))
        self.assertNotEqual(result(self.noisy)["hash"], result(self.noisy, "--seed", 6)["hash"])
        six = self.file("six.toml", self.noisy.read_text().replace("seed = 5", "seed = 6"))
        self.assertEqual(result(six), result(self.noisy, "--seed", 6))
        self.assertEqual(result(six), result(self.noisy, "--seed", "006"))

    def test_the_largest_seed_of_a_scenario_is_taken(self):
        self.assertIn("hash", result(self.noisy, "--seed", 2**63 - 1))

    def test_robot_overrides_what_the_scenario_says(self):
        slow = "wheel_speed_max_mps = 0.1\n"
        scene = SCENARIOS / "nothing.toml"
        within = self.file("within.toml", scene.read_text() + "\n[robot]\n" + slow)
        fast = self.file("fast.toml", scene.read_text() + "\n[robot]\nwheel_speed_max_mps = 0.2\n")
        self.assertNotEqual(result(scene), result(within))
        for robot in (self.file("flat.toml", slow), self.file("table.toml", "[robot]\n" + slow)):
            self.assertEqual(result(scene, "--robot", robot), result(within))
            self.assertEqual(result(fast, "--robot", robot), result(within))

    def test_the_planner_may_be_named(self):
        self.assertIn("hash", result(self.noisy, "--planner", "thesis"))

    def test_options_may_come_before_the_scenario(self):
        self.assertEqual(result("--seed", 3, self.noisy), result(self.noisy, "--seed=3"))

    def test_a_device_takes_two_outputs(self):
        self.assertEqual(run(self.noisy, "--trace", "/dev/null", "--svg", "/dev/null").stderr, "")


class OnATerminal(Case):
    """Progress goes to standard error, and only to a terminal. The run never ends by itself; the tests end it."""

    def endless(self, stderr):
        text = with_time_limit((SCENARIOS / "no_time.toml").read_text(), 1e6)
        shut = text.replace("x_m = 50.0", "x_m = 3.0") + "\n[bounds]\nmin = [-1.0, -1.0]\nmax = [5.0, 1.0]\n"
        shut += "\n[[disc]]\ncenter = [3.0, 0.0]\nradius_m = 0.8\n"
        scene = self.file("shut.toml", shut)
        return subprocess.Popen([whisker.binary, "run", scene, "--planner", "thesis", "--json"], stdout=subprocess.PIPE, stderr=stderr)

    def first_words(self, fd, process, seconds):
        """The output up to the first complete progress line, the end of the process or the time-out."""
        seen, end = b"", time.monotonic() + seconds
        while time.monotonic() < end and not PROGRESS.search(seen) and process.poll() is None:
            if select.select([fd], [], [], 0.1)[0]:
                seen += os.read(fd, 4096)
        return seen

    def test_progress_is_shown_on_a_terminal_and_nowhere_else(self):
        began = time.monotonic()
        terminal, theirs = pty.openpty()
        with self.endless(theirs) as process:
            seen = self.first_words(terminal, process, 60)
            process.kill()
            self.assertRegex(seen, PROGRESS)
            self.assertEqual(process.stdout.read(), b"")
        os.close(terminal)
        os.close(theirs)
        needed = time.monotonic() - began
        with self.endless(subprocess.PIPE) as process:
            silent = self.first_words(process.stderr.fileno(), process, 2 * needed)
            self.assertIsNone(process.poll(), "the run has ended: nothing is proved")
            process.kill()
            self.assertEqual((silent, process.stdout.read()), (b"", b""))

    def test_json_stays_alone_on_standard_output(self):
        terminal, theirs = pty.openpty()
        scene = SCENARIOS / "nothing.toml"
        done = subprocess.run([whisker.binary, "run", scene, "--json"], stdout=subprocess.PIPE, stderr=theirs, check=True)
        os.close(terminal)
        os.close(theirs)
        self.assertEqual(json.loads(done.stdout)["outcome"], "reached")


if __name__ == "__main__":
    whisker.main()
