"""The committed figures equal those that the command draws, and show what the docs state."""

import pathlib
import re
import tempfile
import xml.etree.ElementTree

import whisker
from whisker import Case

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


class Figures(Case):
    def test_every_figure_of_the_docs_is_drawn_the_same_again(self):
        with tempfile.TemporaryDirectory() as folder:
            done = whisker.whisker("figures", folder, "--scenarios", ROOT / "host/worlds/scenarios")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            fresh = {path.name: path.read_bytes() for path in pathlib.Path(folder).iterdir()}
        committed = {path.name: path.read_bytes() for path in (ROOT / "docs/figures").glob("*.svg")}
        self.assertEqual(sorted(fresh), sorted(committed))
        for name, picture in fresh.items():
            self.assertTrue(picture == committed[name], f"{name}: build/host/whisker protocol --figures docs/figures")


class Drives(Case):
    """One drive of the boundary planner in each class of worlds."""

    def drives(self):
        drives = {path.stem: path for path in (ROOT / "docs/figures").glob("boundary_*.svg")}
        self.assertEqual(len(drives), 10)
        return drives

    def distances(self, path):
        """(distance at the hit point, distance on leaving) of each boundary in the legend."""
        texts = [element.text for element in xml.etree.ElementTree.parse(path).iter() if element.tag.endswith("text")]
        return [tuple(texts[i + 1 : i + 3]) for i, text in enumerate(texts) if re.fullmatch(r"boundary \d+", text)]

    def test_leave_each_boundary_nearer_to_the_goal_than_ever(self):
        for name, path in self.drives().items():
            boundaries = self.distances(path)
            self.assertGreater(len(boundaries), 0, name)
            if name == "boundary_enclosed":
                # The last one closes around the goal.
                self.assertEqual(boundaries.pop()[1], "closed loop")
            best = float("inf")
            for hit, left in ([float(text.removesuffix(" m")) for text in one] for one in boundaries):
                best = min(best, hit)
                # By 30 mm, but both are rounded to 10 mm.
                self.assertGreaterEqual(round(best - left, 2), 0.02, name)
                best = left


if __name__ == "__main__":
    whisker.main()
