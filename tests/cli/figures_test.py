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
            self.assertTrue(picture == committed[name], f"{name}: build/host/whisker figures docs/figures")


    def test_pictures_of_pages_are_small_and_in_the_docs(self):
        pictures = list((ROOT / "docs/figures").glob("*.png"))
        self.assertGreater(len(pictures), 0)
        for path in pictures:
            self.assertLess(path.stat().st_size, 200000, path.name)
            pages = (ROOT / f"docs/{name}.md" for name in ("guard", "pages"))
            self.assertTrue(any(f"](figures/{path.name})" in page.read_text() for page in pages), path.name)
        others = [path.name for path in (ROOT / "docs/figures").iterdir() if path.suffix not in (".svg", ".png")]
        # Hashes of the sources of the pages' pictures.
        self.assertEqual(others, ["pages.sha256"])


class Drives(Case):
    """One drive of the boundary planner in each class of worlds."""

    def drives(self):
        drives = {path.stem: path for path in (ROOT / "docs/figures").glob("skirt_*.svg")}
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
            if name == "skirt_enclosed":
                self.assertEqual([left for _, left in boundaries], ["closed loop"])
                continue
            best = float("inf")
            for hit, left in ([float(text.removesuffix(" m")) for text in one] for one in boundaries):
                best = min(best, hit)
                # By 30 mm, but both are rounded to 10 mm.
                self.assertGreaterEqual(round(best - left, 2), 0.02, name)
                best = left

    def test_are_small_and_each_is_in_the_docs(self):
        text = (ROOT / "docs/navigation.md").read_text()
        for name, path in self.drives().items():
            self.assertLess(path.stat().st_size, 60000, name)
            self.assertIn(f"](figures/{name}.svg)", text)
            command = re.search(r">(whisker campaign [^<]*)<", path.read_text()).group(1)
            self.assertIn(f"`{command}`", text, name)


class Pairs(Case):
    """The map planner compared with the boundary planner, one world of each class."""

    def test_show_both_in_one_world_with_the_map_of_one(self):
        folder = ROOT / "docs/figures"
        text = (ROOT / "docs/navigation.md").read_text()
        names = {path.stem.removesuffix("_skirt") for path in folder.glob("map_*.svg")}
        self.assertEqual(len(names), 8)
        for name in names:
            skirt, led = (folder / f"{name}{end}.svg" for end in ("_skirt", ""))
            for path in (skirt, led):
                self.assertLess(path.stat().st_size, 60000, path.name)
                self.assertIn(f"](figures/{path.name})", text)
            commands = [re.search(r": (whisker campaign [^<]*)<", path.read_text()).group(1) for path in (skirt, led)]
            self.assertEqual(commands[1].replace(" --planner map ", " --planner boundary "), commands[0])
            self.assertNotIn("class=\"map\"", skirt.read_text())
            self.assertIn("class=\"map\"", led.read_text())


if __name__ == "__main__":
    whisker.main()
