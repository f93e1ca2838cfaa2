"""The committed figures are those that the command draws."""

import pathlib
import tempfile

import whisker
from whisker import Case

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


class Figures(Case):
    def test_every_figure_of_the_docs_is_drawn_the_same_again(self):
        with tempfile.TemporaryDirectory() as folder:
            done = whisker.whisker("figures", folder, "--scenarios", ROOT / "host/worlds/scenarios")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            fresh = {path.name: path.read_bytes() for path in pathlib.Path(folder).iterdir()}
        committed = {path.name: path.read_bytes() for path in (ROOT / "docs/figures").iterdir()}
        self.assertEqual(sorted(fresh), sorted(committed))
        for name, picture in fresh.items():
            self.assertTrue(picture == committed[name], f"{name}: build/host/whisker figures docs/figures")


if __name__ == "__main__":
    whisker.main()
