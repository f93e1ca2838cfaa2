"""Runs the whisker command. The test programs take its path as first argument and pass the others to unittest."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
SCENARIOS = HERE / "scenarios"
KINDS = ("discs", "poles", "u-trap", "spiral", "maze", "rooms", "enclosed")
# The provenance keys of every JSON object.
ORIGIN = ("schema", "version", "seed", "planner", "robot_name", "robot_digest", "rules_digest")
# What the robot noticed of its rangefinders; a bus carries them in coarser steps.
RANGE_TRUST = ("range_trust", "contradictions_per_m", "phantom_share", "false_clear_share", "incidence_seen_deg")
# How far the pose may be off, in whole millimetres on a bus.
BOUND = ("bound_m", "sigma_along_m", "sigma_across_m", "sigma_heading_deg")
STATUS = {"reached": 0, "unreachable": 3, "gave_up": 4, "contact": 5, "fault": 6, "off_goal": 7}

binary = ""


def whisker(*arguments, timeout=120, **options):
    """Runs the command to its end; output as text."""
    return subprocess.run(
        [binary, *map(str, arguments)],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=timeout,
        check=False,
        **options,
    )


def planners():
    """The names of the core's planners and of the baselines in the help text."""
    text = " ".join(whisker("run", "--help").stdout.split())
    core, baselines = re.search(r"Planner: (.+?); baselines: ([-a-z0-9]+(?:, [-a-z0-9]+)*)", text).groups()
    return re.sub(r" \(or \S+\)", "", core).split(", "), baselines.split(", ")


def with_time_limit(text, seconds):
    """The scenario's text with another time limit."""
    changed, count = re.subn(r"(?m)^time_limit_s *=.*$", f"time_limit_s = {seconds}", text)
    assert count == 1, "the scenario has no time limit to change"
    return changed


class Case(unittest.TestCase):
    """Gives each test an empty folder, `self.folder`."""

    def setUp(self):
        box = tempfile.TemporaryDirectory(prefix="whisker-cli-")
        self.addCleanup(box.cleanup)
        self.folder = pathlib.Path(box.name)

    def file(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def contents(self):
        """Name and bytes of every file in the folder."""
        return {
            str(path.relative_to(self.folder)): path.read_bytes() if path.is_file() else None
            for path in self.folder.rglob("*")
        }

    def refused(self, *arguments, status=2, says=""):
        """The command prints one line on standard error, and writes or removes no file."""
        before = self.contents()
        done = whisker(*arguments, cwd=self.folder)
        with self.subTest(arguments):
            self.assertEqual((done.returncode, done.stdout), (status, ""), done.stderr)
            self.assertRegex(done.stderr, r"\A[^\n]+\n\Z")
            self.assertIn(says, done.stderr)
            self.assertEqual(self.contents(), before)


def main():
    global binary
    if len(sys.argv) < 2 or not os.access(sys.argv[1], os.X_OK):
        sys.exit(f"usage: {sys.argv[0]} WHISKER [unittest options]")
    # `import whisker` in the test file is a different module object from __main__.
    binary = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main(module="__main__", verbosity=2)
