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


if __name__ == "__main__":
    whisker.main()
