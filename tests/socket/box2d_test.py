"""The core drives a robot in Box2D (docs/integration/socket/box2d) as in Whisker's own simulator."""

import json
import pathlib
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SOURCE = ROOT / "docs/integration/socket/box2d"
WORLDS = (("discs", 1), ("discs", 2), ("maze", 1), ("u-trap", 2), ("rooms", 1))

whisker, folder, cmake = "", pathlib.Path(), ""


def run(*command):
    return subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=240, check=False)


class Box2d(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        for step in (("-S", SOURCE, "-B", folder, "-D", "CMAKE_BUILD_TYPE=Release", "-D", "CMAKE_CXX_FLAGS=-Wall -Wextra -Werror"),
                     ("--build", folder)):
            done = run(cmake, *step)
            assert done.returncode == 0, done.stdout + done.stderr

    def world(self, kind, seed):
        file = folder / f"{kind}-{seed}.toml"
        self.assertEqual(run(whisker, "world", kind, "--seed", seed, "--out", file).returncode, 0)
        return file

    def simulated(self, file, *arguments):
        done = run(folder / "box2d_simulator", whisker, file, *arguments)
        self.assertNotEqual(done.stdout, "", done.stderr)
        return json.loads(done.stdout)

    def test_both_simulators_give_the_same_verdict(self):
        for kind, seed in WORLDS:
            with self.subTest(kind, seed=seed):
                file = self.world(kind, seed)
                own = json.loads(run(whisker, "run", file, "--json").stdout)
                result = self.simulated(file)
                self.assertEqual(result["outcome"], own["outcome"])
                self.assertEqual(result["touches"], 0)
                self.assertLess(result["true_distance_m"], 0.1)
                self.assertLess(abs(result["time_s"] - own["time_s"]), 0.5 * own["time_s"])

    def test_boxes_that_could_be_pushed_are_not_touched(self):
        for seed in (1, 2, 3):
            result = self.simulated(self.world("discs", seed), 20, seed)
            self.assertEqual((result["outcome"], result["touches"], result["largest_impulse_Ns"]), ("reached", 0, 0))

    def test_tyres_that_slip_cost_truth(self):
        result = self.simulated(self.world("u-trap", 1), 0, 1, 0.09)
        self.assertGreater(result["slipped_m"], 0.005)
        self.assertEqual(result["touches"], 0)


if __name__ == "__main__":
    whisker, folder, cmake = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
    unittest.main(argv=sys.argv[:1], verbosity=2)
