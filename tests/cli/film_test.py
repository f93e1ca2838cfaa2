"""The committed animation equals the output of scripts/lib/film.py."""

import os
import pathlib
import subprocess

import whisker
from whisker import Case

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
COMMITTED = ROOT / "docs/film/u_trap.svg"


class Film(Case):
    def test_is_drawn_the_same_again(self):
        file = self.folder / "film.svg"
        environment = {**os.environ, "WHISKER": whisker.binary}
        subprocess.run([ROOT / "scripts/lib/film.py", file], check=True, capture_output=True, env=environment, timeout=120)
        self.assertTrue(file.read_bytes() == COMMITTED.read_bytes(), "scripts/lib/film.py")

    def test_says_which_planner_needs_no_map(self):
        says = [line for line in COMMITTED.read_text(encoding="utf-8").splitlines() if "a map" in line or "no map" in line]
        self.assertEqual(len(says), 1)
        self.assertIn("boundary planner", says[0])


if __name__ == "__main__":
    whisker.main()
