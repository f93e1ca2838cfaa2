"""scripts/budget rejects larger figures, broken bars and pages with other figures. usage: budget_test.py ROOT"""

import importlib.machinery
import importlib.util
import json
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv[1])
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "scripts/lib"))


def load():
    loader = importlib.machinery.SourceFileLoader("budget", str(ROOT / "scripts/budget"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("budget", loader))
    loader.exec_module(module)
    return module


class Budget(unittest.TestCase):
    def setUp(self):
        self.budget = load()
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def worse(self, old, new):
        return self.budget.compare(old, new)[1]

    def test_growth_is_refused_above_two_per_cent(self):
        self.assertEqual(self.worse({"a": 1000, "b": 50}, {"a": 1020, "b": 50}), 0)
        self.assertEqual(self.worse({"a": 1000, "b": 50}, {"a": 1021, "b": 50}), 1)
        self.assertEqual(self.worse({"a": 1000}, {"a": 10}), 0)

    def test_a_figure_that_comes_or_goes_is_refused(self):
        self.assertEqual(self.worse({"a": 1}, {}), 1)
        self.assertEqual(self.worse({}, {"a": 1}), 1)

    def test_what_changed_is_named_with_both_values(self):
        (line,), _ = self.budget.compare({"flash": 1000}, {"flash": 1100})
        self.assertIn("flash: 1000 -> 1100 (+10.0%)", line)

    def broken(self, bar, figures):
        self.budget.BARS = self.folder / "bars.json"
        self.budget.BARS.write_text(json.dumps([bar]))
        return self.budget.check_bars(figures)[1]

    def test_only_a_bar_that_held_can_break(self):
        held = {"figure": "a", "at_most": 55, "holds": True}
        missed = {**held, "holds": False, "why": "it is new"}
        self.assertEqual(self.broken(held, {"a": 55}), 0)
        self.assertEqual(self.broken(held, {"a": 56}), 1)
        self.assertEqual(self.broken(held, {}), 1)
        self.assertEqual(self.broken(missed, {"a": 56}), 0)

    def test_every_bar_says_why_it_is_missed(self):
        for bar in json.loads((ROOT / "tests/budget/bars.json").read_text()):
            self.assertTrue(bar["holds"] or bar["why"], bar)

    def test_the_page_shows_the_tables_of_the_baseline(self):
        figures = json.loads(self.budget.BASELINE.read_text())
        tick, robot = (f"{figures[name]:,}" for name in ("cortex-m3, tick, map: worst", "stm32f405, flash: the robot"))
        committed = self.budget.PAGE.read_text()
        self.budget.PAGE = self.folder / "page.md"
        self.budget.PAGE.write_text(committed)
        self.assertEqual(self.budget.main(["--check"]), 0)
        for shown in (tick, robot):
            self.budget.PAGE.write_text(committed.replace(shown, "1"))
            with self.assertRaises(SystemExit):
                self.budget.main(["--check"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
