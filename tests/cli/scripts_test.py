"""What makes the tables bars, compare, outcomes, odometry and owned of scripts/measure fail.

WHISKER names a stand-in that records its arguments and prints one summary, which the real command made.
"""

import json
import os
import pathlib
import subprocess

import whisker
from whisker import Case

SCRIPTS = pathlib.Path(__file__).resolve().parent.parent.parent / "scripts"
STAND_IN = '#!/bin/sh\necho "$*" >>"$0.calls"\ncat "$0.json"\nexit "$(cat "$0.status")"\n'


class Scripts(Case):
    def setUp(self):
        super().setUp()
        self.command = self.file("whisker", STAND_IN)
        self.command.chmod(0o755)
        self.file("whisker.status", "0")
        done = whisker.whisker("campaign", "discs", "--discs", 0, "--count", 1, "--json")
        self.summary = json.loads(done.stdout)
        self.answer()

    def answer(self, **changes):
        self.file("whisker.json", json.dumps({**self.summary, **changes}))

    def run_script(self, name, *arguments, status=0):
        done = subprocess.run(
            [SCRIPTS / "measure", name, *map(str, arguments)],
            env={**os.environ, "WHISKER": str(self.command)},
            capture_output=True, text=True, timeout=60, check=False,
        )  # fmt: skip
        self.assertEqual(done.returncode, status, done.stderr)
        return done

    def rows(self, done):
        """The cells of all table rows except the separators."""
        lines = [line for line in done.stdout.splitlines() if line.startswith("| ")]
        return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


class Status(Scripts):
    def test_bars_that_are_missed_are_counted(self):
        slow = {"value": 99, "low": 99, "high": 99}
        self.answer(s_per_m={"p50": slow, "p95": slow}, ratio=dict.fromkeys(("mean", "p50", "p95"), None))
        done = self.run_script("bars", "--count", 1, "--noisy", 0, "--seed", 1, status=1)
        self.assertIn("bars: 9 figures miss their bar", done.stderr)
        self.assertEqual(done.stdout.count("**99.00 / "), 9)

    def test_bars_count_belief_and_show_the_truth_beside_it(self):
        share = lambda value: {"value": value, "low": value, "high": value}
        self.answer(success=share(1), truly_there=share(0.02))
        table = self.rows(self.run_script("bars", "--count", 1, "--noisy", 1, "--seed", 1, "--gate"))
        self.assertEqual(table[0][:4], ["world", "missions", "truly there", "success"])
        self.assertEqual(table[1][:4], ["15 discs", "1", "2.00 % (2.00-2.00)", "100.00 % (100.00-100.00)"])
        self.answer(no_way=1)
        self.assertEqual(self.rows(self.run_script("bars", "--count", 1, "--noisy", 0, "--seed", 1, "--gate"))[-1][2], "-")

    def test_the_gate_asks_for_no_contact_and_for_success(self):
        share = lambda value: {"value": value, "low": 0, "high": 1}
        gate = ("bars", "--count", 1, "--noisy", 1, "--seed", 1, "--gate")
        self.run_script(*gate)
        self.answer(contact=share(0.01))
        self.assertIn("20 classes fail the gate", self.run_script(*gate, status=1).stderr)
        self.answer(success=share(0.84))
        self.assertIn("10 classes fail the gate", self.run_script(*gate, status=1).stderr)

    def test_a_fault_is_a_failure(self):
        self.answer(missions=4, fault={"value": 0.25, "low": 0, "high": 1})
        self.assertIn("outcomes: 11 runs ended in a fault", self.run_script("outcomes", 4, status=1).stderr)
        self.assertIn("compare: 90 runs ended in a fault", self.run_script("compare", 4, status=1).stderr)

    def test_a_comparison_of_robots_that_are_not_where_they_say_is_a_failure(self):
        self.answer(missions=4, off_goal={"value": 0.25, "low": 0, "high": 1})
        self.assertIn("compare: 90 robots are not at the goal", self.run_script("compare", 4, status=1).stderr)

    def test_a_contact_of_a_robot_that_people_own_is_a_failure(self):
        share = lambda value: {"value": value, "low": 0, "high": 1}
        self.answer(missions=4, contact=share(0.25), truly_there=share(0.5), off_goal=share(0.25))
        done = self.run_script("owned", 4, 1, "romi", "zumo", status=1)
        self.assertIn("owned: 24 missions ended in contact", done.stderr)
        self.assertEqual([row[0] for row in self.rows(done) if "gyro" not in row[0]], ["romi", "zumo"] * 3)
        self.assertEqual({row[1].rsplit(", ", 1)[0] for row in self.rows(done) if row[0] == "romi"}, {"50, 25, 25"})
        calls = self.folder.joinpath("whisker.calls").read_text().splitlines()
        self.assertTrue(all(" --noise --to-size --robot " in call for call in calls), calls)

    def test_a_campaign_that_fails_is_named(self):
        self.file("whisker.status", "7")
        for name, *arguments in (("bars", "--seed", 1), ("compare",), ("outcomes",), ("odometry",)):
            done = self.run_script(name, *arguments, status=1)
            self.assertRegex(done.stderr, rf"\A{name}: whisker campaign discs [^\n]*: exit status 7\n\Z")


if __name__ == "__main__":
    whisker.main()
