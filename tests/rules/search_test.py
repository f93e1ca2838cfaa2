"""`whisker rules search` from outside.

usage: search_test.py WHISKER [unittest options]
"""

import json
import pathlib
import signal
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import whisker  # noqa: E402
from whisker import Case  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
SIDES = ROOT / "host/lab/rules/laws/sides.toml"
STRAIGHT = ROOT / "host/lab/rules/laws/straight.toml"
# One of its children is kept.
SMALL = ("--base", SIDES, "--worlds", "u-trap", "--count", 5, "--seed", 7, "--generations", 2, "--children", 2, "--validate", 3)


class Search(Case):
    def searched(self, *arguments):
        done = whisker.whisker("rules", "search", *arguments, "--out", "found.toml", cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout, (self.folder / "found.toml").read_text()

    def test_the_same_search_finds_the_same_on_any_number_of_threads(self):
        told, file = self.searched(*SMALL, "--json", "--jobs", 1)
        self.assertEqual((told, file), self.searched(*SMALL, "--json", "--jobs", 3))
        told = json.loads(told)
        self.assertEqual([g["kept"] for g in told["generations"]], [True, False])
        self.assertEqual(told["rules_digest"], told["generations"][0]["rules_digest"])
        self.assertNotEqual(told["rules_digest"], told["base_digest"])
        words, same = self.searched(*SMALL)
        self.assertEqual(file, same)
        self.assertRegex(words, rf"\Ageneration 1: {told['rules_digest']}, time over its parent 0\.\d+ \[.*\], kept\ngeneration 2: ")
        self.assertIn("validation: A = ", words)
        self.assertTrue(words.endswith("rules: found.toml\n"))
        self.found_is_a_rule_base(file, told["rules_digest"])
        self.validation_is_a_comparison_in_other_worlds(told)

    def found_is_a_rule_base(self, text, digest):
        self.assertRegex(text, r"(?s)\A# Found by whisker rules search, planner map, in u-trap: seeds 7 to 16,\n")
        self.assertIn(f"this is {digest}.\n", text)
        self.assertEqual(sum(line.startswith("  [") and line.count('"') == 10 for line in text.splitlines()), 10)
        shown = whisker.whisker("rules", "show", "found.toml", "--svg", "found.svg", cwd=self.folder)
        self.assertEqual((shown.returncode, shown.stderr), (0, ""))
        self.assertTrue((self.folder / "found.svg").read_text().rstrip().endswith("</svg>"))
        table = json.loads(whisker.whisker("rules", "compile", self.folder / "found.toml", "--json").stdout)
        turn, step = table["outputs"]
        self.assertEqual([s["kind"] for s in turn["symmetries"] + step["symmetries"]], ["antisymmetric", "symmetric"])

    def validation_is_a_comparison_in_other_worlds(self, told):
        validation = told["validation"]
        self.assertEqual([told["first_seed"], told["last_seed"], validation["first_seed"], validation["last_seed"]], [7, 16, 17, 19])
        done = whisker.whisker("rules", "compare", SIDES, "found.toml", "--worlds", "u-trap", "--seed", 17, "--count", 3, "--json", cwd=self.folder)
        compared = json.loads(done.stdout)
        self.assertEqual(compared["b"]["rules_digest"], told["rules_digest"])
        for key in ("time_ratio", "path_ratio", "clearance_m_difference", "both_reach"):
            self.assertEqual(validation["classes"][0][key], compared[key])
            self.assertEqual(validation["all"][key], compared[key])
        # All succeed, so no failure counts.
        for key, value in compared["time_ratio"].items():
            self.assertAlmostEqual(validation["time_ratio_with_failures"][key], value, places=12)
        self.assertEqual(validation["better"], compared["time_ratio"]["high"] < 1)

    def test_without_a_better_child_the_rules_are_the_bases(self):
        told, file = self.searched("--worlds", "u-trap", "--count", 1, "--generations", 1, "--children", 1, "--json")
        told = json.loads(told)
        self.assertEqual((told["rules_digest"], told["validation"]), (told["base_digest"], None))
        thesis = (ROOT / "host/rules/examples/thesis.toml").read_text()
        rows = [[line.split("#")[0].replace(" ", "") for line in text.splitlines() if line.startswith('  ["')] for text in (file, thesis)]
        self.assertEqual(*rows)

    def test_for_the_assist_an_operator_drives(self):
        arguments = ("--base", STRAIGHT, "--assist", "--worlds", "discs", "--discs", 40, "--count", 2, "--generations", 1, "--children", 2, "--validate", 2, "--json")
        told, file = self.searched(*arguments)
        self.assertEqual((told, file), self.searched(*arguments, "--jobs", 2))
        told = json.loads(told)
        self.assertEqual((told["assist"], told["planner"]), (True, None))
        self.assertIn("# Found by whisker rules search, sloppy operator with assist, in discs --discs 40:", file)

    def begun(self, *arguments):
        command = [whisker.binary, "rules", "search", *map(str, arguments), "--out", "found.toml"]
        return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=self.folder)

    def test_an_interrupted_search_leaves_the_best_so_far(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.begun(*SMALL[:-6], "--children", 2, "--generations", 10000) as process:
                first = process.stdout.readline()
                self.assertTrue(first.endswith(", kept\n"), first)
                process.stdout.readline()
                process.send_signal(number)
                _, error = process.communicate(timeout=100)
            self.assertEqual(process.returncode, 130)
            self.assertRegex(error, r"\Awhisker: interrupted after \d+ of 10000 generations; found.toml: the best rules so far\n\Z")
            self.assertIn("\n# Not validated.\n", (self.folder / "found.toml").read_text())
            text = (self.folder / "found.toml").read_text()
            self.assertIn("# It started from the table ", text)
            self.assertEqual(whisker.whisker("rules", "show", "found.toml", cwd=self.folder).returncode, 0)
            self.assertEqual([p.name for p in self.folder.iterdir()], ["found.toml"])
            (self.folder / "found.toml").unlink()

    def test_wrong_usage(self):
        (self.folder / "base.toml").write_text(SIDES.read_text())
        (self.folder / "skew.toml").write_text(SIDES.read_text().replace('["RB", -4.0]', '["RB", -5.0]'))
        (self.folder / "steep.toml").write_text(SIDES.read_text().replace('["RB", -4.0]', '["RB", -0.25]').replace('["LB", 4.0]', '["LB", 0.25]'))
        (self.folder / "tip.fis").write_text((ROOT / "host/rules/examples/tip.fis").read_text())
        out, worlds = ("--out", "x.toml"), ("--worlds", "maze")
        for arguments, says in (
            ((*out,), "--worlds is required"),
            ((*worlds,), "--out is required"),
            (("--worlds", "rooms,roms", *out), "--worlds: no kind of world 'roms'; did you mean 'rooms'?"),
            (("--worlds", "discs,", *out), "--worlds: no kind of world ''"),
            (("--worlds", "discs,discs", *out), "--worlds: 'discs' is given twice"),
            (("--worlds", "", *out), "--worlds"),
            (("--worlds", "discs,u-trap", "--discs", 75, *out), "u-trap"),
            ((*worlds, *out, "--planner", "fan"), "rules search: planner fan has no table"),
            ((*worlds, *out, "--assist", "--planner", "map"), "--assist"),
            (("--worlds", "enclosed", *out, "--assist"), "--assist: no path for the operator in enclosed"),
            ((*worlds, *out, "--seed", 2**63 - 1), "seeds must be below 2^63"),
            ((*worlds, "--out", "nowhere/x.toml"), "no such folder"),
            ((*worlds, "--out", "base.toml", "--base", "base.toml"), "would overwrite"),
            ((*worlds, "--out", "-", "--json"), "standard output"),
            ((*worlds, *out, "--base", "none.toml"), "none.toml:1:1: "),
            ((*worlds, *out, "--base", "tip.fis"), "tip.fis:1:1: a search starts from a rule file in TOML"),
            ((*worlds, *out, "--base", "skew.toml"), "skew.toml:11:1: a search starts from terms of 'R' that mirror each other about 0"),
            ((*worlds, *out, "--base", "steep.toml"), "steep.toml: the look-up errs by more than 2 % of the span"),
            *(((*worlds, *out, option, 0), f"{option} 0: nothing to do") for option in ("--count", "--generations", "--children", "--validate")),
            *(((*worlds, *out, option, "1.5"), option) for option in ("--count", "--generations", "--children", "--validate", "--seed")),
        ):
            self.refused("rules", "search", *arguments, says=says)


if __name__ == "__main__":
    whisker.main()
