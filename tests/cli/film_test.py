"""The committed animation equals the output of scripts/lib/film.py, and shows the drive from start to goal."""

import os
import pathlib
import subprocess
import xml.etree.ElementTree

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

    def test_is_small_and_in_the_readme(self):
        self.assertLess(COMMITTED.stat().st_size, 300000)
        self.assertIn("](docs/film/u_trap.svg)", (ROOT / "README.md").read_text())

    def test_moves_all_at_once_and_stands_at_the_end_where_nothing_moves(self):
        picture = xml.etree.ElementTree.parse(COMMITTED)
        moving = [
            (parent, child)
            for parent in picture.iter()
            for child in parent
            if child.tag.split("}")[1] in ("animate", "animateTransform")
        ]
        self.assertGreater(len(moving), 10)
        self.assertEqual(len({child.get("dur") for _, child in moving}), 1)
        for parent, child in moving:
            name, values = child.get("attributeName"), child.get("values").split(";")
            # Elements that start hidden end visible; all others are drawn in their final place.
            if name == "stroke-dashoffset":
                self.assertEqual(values[-1], "0")
                self.assertEqual(float(values[0]), float(parent.get("stroke-dasharray").split()[0]))
            elif name == "transform":
                self.assertEqual(parent.get(name), f"{child.get('type')}({values[-1]})")
            else:
                self.assertEqual(parent.get(name), values[-1])

    def test_ends_at_the_goal(self):
        picture = xml.etree.ElementTree.parse(COMMITTED)
        goal = next(e for e in picture.iter() if e.tag.endswith("circle"))
        robot = next(e for e in picture.iter() if e.get("transform", "").startswith("translate("))
        x, y = map(float, robot.get("transform")[len("translate(") : -1].split(","))
        away = ((x - float(goal.get("cx"))) ** 2 + (y - float(goal.get("cy"))) ** 2) ** 0.5
        self.assertLess(away, float(goal.get("r")))


if __name__ == "__main__":
    whisker.main()
