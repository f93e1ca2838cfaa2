"""`whisker scanner`: its figures, as text and as JSON, and its errors."""

import json

import whisker
from whisker import SCENARIOS, Case


class Scanner(Case):
    def scanner(self, *arguments):
        done = whisker.whisker("scanner", *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""), arguments)
        return done.stdout

    def figures(self, *arguments):
        text = self.scanner(*arguments, "--json")
        self.assertEqual(text.count("\n"), 1)
        return json.loads(text)

    def test_drives_the_worlds_of_a_campaign(self):
        worlds = ("u-trap", "--count", 6, "--seed", 3)
        figures = self.figures(*worlds)
        self.assertEqual((figures["missions"], figures["least_seed"], figures["greatest_seed"]), (6, 3, 8))
        self.assertEqual(figures["worlds"], ["u-trap"])
        self.assertEqual(figures["reached"]["value"], 1)
        done = whisker.whisker("campaign", *worlds, "--json")
        ratio = figures["ratio"]["p50"]["value"]
        self.assertTrue(0.999 <= ratio <= json.loads(done.stdout)["ratio"]["p50"]["value"], ratio)
        self.assertEqual(figures, self.figures(*worlds, "--jobs", 1))
        self.assertEqual(self.figures("discs", "--discs", 0, "--count", 2)["ratio"]["p95"]["value"], 1)
        self.assertNotIn("contact", figures)

    def test_words_say_the_same(self):
        words = self.scanner("enclosed", "--count", 2, "--box", "--discs", 5)
        self.assertIn("2 worlds, enclosed --discs 5 --box, a scanner all round, seeds 1 to 2;", words)
        self.assertRegex(words, r"(?m)^unreachable +100\.00 %")
        self.assertRegex(words, r"(?m)^ratio +mean +-$")

    def test_takes_scenario_files(self):
        files = list(SCENARIOS.glob("*.toml"))
        self.assertEqual(self.figures(SCENARIOS)["missions"], len(files))

    def test_refuses_what_it_cannot_do(self):
        for arguments, says in (
            ((), "KIND|DIR"),
            (("cubes",), "cubes"),
            (("discs", "--count", 0), "--count 0"),
            (("maze", "--discs", 3), "maze"),
            (("discs", "--planner", "skirt"), "--planner"),
            (("discs", "--noise"), "--noise"),
        ):
            self.refused("scanner", *arguments, says=says)


if __name__ == "__main__":
    whisker.main()
