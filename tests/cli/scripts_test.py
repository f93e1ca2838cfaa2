"""The tables bars, compare, outcomes and odometry of scripts/measure: their shape, and what makes them fail;
and the figures that bus-figures computes from a log.

WHISKER names a stand-in that records its arguments and prints one summary, which the real command made.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import whisker
from whisker import KINDS, Case

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

    def calls(self):
        return [line.split() for line in (self.folder / "whisker.calls").read_text().splitlines()]


class Tables(Scripts):
    def test_have_a_row_for_each_class_and_as_many_cells_as_the_heading(self):
        for name, arguments, rows in (
            ("bars", ("--count", 1, "--noisy", 1, "--seed", 1, "--gate"), 20),
            ("bars", ("--planner", "map", "--count", 1, "--noisy", 1, "--seed", 1, "--gate"), 20),
            ("compare", (1,), 8 * 10),
            ("outcomes", (1,), 11),
            ("odometry", (1, "--only", "wheels"), 4),
            ("odometry", (1, "--only", "classes"), 10),
        ):
            (self.folder / "whisker.calls").unlink(missing_ok=True)
            table = self.rows(self.run_script(name, *arguments))
            headings = [row for row in table if row[0] in ("world", "wheels' scale error")]
            self.assertEqual(len(table) - len(headings), rows, name)
            width = 0
            for row in table:
                width = len(row) if row in headings else width
                self.assertEqual(len(row), width, (name, row))
            for call in self.calls():
                self.assertIn(call[0], ("campaign", "scanner") if name == "compare" else ("campaign",))
                self.assertEqual(call[call.index("--count") + 1], "1")
            kinds = {call[1] for call in self.calls()}
            self.assertEqual(kinds, {"discs", "maze", "enclosed"} if "wheels" in arguments else set(KINDS), name)


class BusFigures(unittest.TestCase):
    def setUp(self):
        sys.path.insert(0, str(SCRIPTS / "lib"))
        self.addCleanup(sys.path.remove, str(SCRIPTS / "lib"))
        import bus_figures

        self.figures = bus_figures

    def test_a_stop_is_that_after_the_last_command(self):
        with tempfile.TemporaryDirectory() as box:
            log = pathlib.Path(box, "run.log")
            log.write_text(
                "(10.000000) vcan0 101#0010000000000000\n"  # drive command, speed 0
                "(10.055000) vcan0 709#0040000000000000\n"  # safe stop
                "(11.000000) vcan0 709#0030000000000000\n"
                "(12.000000) vcan0 101#0010B80BB80B0000\n"
                "(12.000500) vcan0 101#0000000000000000\n"  # to stop
                "(12.051000) vcan0 709#0040000000000000\n"
                "(12.060000) vcan0 119#0010020000030000\n"
                "(12.300000) vcan0 119#0020030000030000\n"
                "(12.310000) vcan0 119#0030030000030000\n"
                "(12.400000) vcan0 709#0040"  # being written
            )
            stop = self.figures.stop_of(log)
        self.assertEqual({key: round(value, 3) for key, value in stop.items()}, {"speed_mps": 0.3, "latency_ms": 51, "braking_ms": 249})

    def test_what_misses_its_bar_is_bold_and_counted(self):
        lockstep = {"world": "u-trap", "ticks": 7, "ticks_per_s": 500.0, "same": True}
        trip = {"p50": 1, "p99": 2, "max": 3}
        live = {"world": "spiral", "ticks": 101, "deadline_misses": 0, "round_trip_us": trip, "frames": 730, "load_percent": 19.6}
        stop = {"speed_mps": 0.3, "latency_ms": 49.5, "braking_ms": 400.0}
        lines, missed = self.figures.table_of({"lockstep": [lockstep], "real_time": live, "stops": [stop]}, 1)
        self.assertEqual((missed, "\n".join(lines).count("**")), (0, 0))
        bad = {
            "lockstep": [{**lockstep, "ticks_per_s": 499.4}, {**lockstep, "same": False}],
            "real_time": {**live, "ticks": 100, "deadline_misses": 1},
            "stops": [stop, {**stop, "latency_ms": 50.2}],
        }
        lines, missed = self.figures.table_of(bad, 1)
        text = "\n".join(lines)
        self.assertEqual((missed, text.count("**")), (5, 10))
        self.assertIn("**500 ticks/s, another trajectory**", text)
        self.assertIn("| **49.5 to 50.2 ms** | 50 ms |", text)


class Places(unittest.TestCase):
    def test_the_pages_have_a_place_for_each_table(self):
        for name, marks in (("docs/odometry.md", ("realistic", "wheels")), ("docs/can.md", ("bus",))):
            for mark in marks:
                self.assertEqual((SCRIPTS.parent / name).read_text().count(f"<!-- {mark}:begin -->\n"), 1, (name, mark))


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

    def test_a_campaign_that_fails_is_named(self):
        self.file("whisker.status", "7")
        for name, *arguments in (("bars", "--seed", 1), ("compare",), ("outcomes",), ("odometry",)):
            done = self.run_script(name, *arguments, status=1)
            self.assertRegex(done.stderr, rf"\A{name}: whisker campaign discs [^\n]*: exit status 7\n\Z")


if __name__ == "__main__":
    whisker.main()
