"""`whisker rules` from outside: headers that compile and keep the printed bound, errors in one line.

usage: cli_test.py WHISKER [unittest options]
"""

import json
import os
import pathlib
import random
import re
import struct
import subprocess
import sys
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import whisker  # noqa: E402
from slcan_bridge import Bridge  # noqa: E402
from whisker import Case, with_time_limit  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "host/rules/examples"
STRAIGHT = ROOT / "host/lab/rules/laws/straight.toml"
NAMES = ("thesis.toml", "tip.fis", "pendulum.fll", "fan.fcl", "follower.fis")

# Prints every output at every representable input, in raw units, row by row.
DRIVER = """
#include "law.h"
#include <stdio.h>
int main(void) {{
  int i, j;
  for (i = {low0}; i <= {high0}; ++i)
    for (j = {low1}; j <= {high1}; ++j) {{
      const law_outputs out = law_look_up((int16_t)i, (int16_t)j);
{prints}
    }}
  return 0;
}}
"""


def compile_rules(*arguments):
    return whisker.whisker("rules", "compile", *arguments)


class Drives(Case):
    """--rules: the core drives with the table of a file."""

    def setUp(self):
        super().setUp()
        self.world = self.folder / "world.toml"
        whisker.whisker("world", "u-trap", "--seed", "3", "--out", self.world)
        self.short = self.file("short.toml", with_time_limit(whisker.whisker("world", "discs", "--seed", "3").stdout, 5) + "[robot]\nbend_course = true\n")

    def run_json(self, *arguments, world=None):
        return json.loads(whisker.whisker("run", world or self.world, "--json", *arguments).stdout)

    def test_the_thesis_drives_as_the_built_in_table(self):
        own, same = (self.run_json("--rules", rules) for rules in ("default", EXAMPLES / "thesis.toml"))
        self.assertEqual(own, same)
        self.assertEqual(own["rules_digest"], self.run_json()["rules_digest"])

    def test_the_table_bends_the_course_unless_asked_not_to(self):
        bent, straight = (self.file(f"{word}.toml", f"bend_course = {word}\n") for word in ("true", "false"))
        for planner in ("map", "skirt"):
            plain, chosen, asked, not_asked = (
                self.run_json("--planner", planner, *options)["hash"]
                for options in ((), ("--rules", "default"), ("--robot", bent), ("--robot", straight))
            )
            self.assertEqual((plain, plain), (chosen, asked))
            self.assertNotEqual(plain, not_asked)
            without_turns = self.run_json("--planner", planner, "--rules", STRAIGHT)["hash"]
            self.assertEqual(not_asked, without_turns)
        thesis = {self.run_json("--planner", "thesis", "--robot", robot)["hash"] for robot in (bent, straight)}
        self.assertEqual(len(thesis), 1)

    def test_a_table_of_zeros_is_slower_where_the_sensors_lose_walls(self):
        robot = ROOT / "host/robots/hc-sr04.toml"
        options = ("--worlds", "discs", "--discs", "15", "--count", "6", "--seed", "31", "--robot", robot, "--json")
        compared = json.loads(whisker.whisker("rules", "compare", STRAIGHT.with_name("zeros.toml"), "default", *options).stdout)
        self.assertLess(compared["time_ratio"]["value"], 0.95)
        self.assertEqual((compared["a"]["contacts"], compared["b"]["contacts"]), (0, 0))

    def test_other_rules_drive_otherwise_also_on_a_bus(self):
        text = (EXAMPLES / "thesis.toml").read_text().replace('["TLVB", 1.5]', '["TLVB", 0.2]').replace('["TRVB", -1.5]', '["TRVB", -0.2]')
        law = self.file("law.toml", text.replace('name = "SA"', 'name = "steer"'))
        options = ("--rules", law, "--map", "SA=steer", "--planner", "skirt")
        own, other = self.run_json("--planner", "skirt", "--rules", "default"), self.run_json(*options)
        self.assertNotEqual(own["rules_digest"], other["rules_digest"])
        self.assertNotEqual(own["hash"], other["hash"])
        bus = json.loads(whisker.whisker("hil", self.world, "--json", *options).stdout)
        self.assertEqual(bus["hash"], other["hash"])
        self.assertEqual(bus["rules_digest"], other["rules_digest"])

    def on_a_bus(self, controller, plant):
        """Runs a plant and a controller with these options; returns the plant's end and what the controller said."""
        ends = [self.folder / f"{len(list(self.folder.iterdir()))}-{end}" for end in ("controller", "plant")]
        bridge = Bridge(*ends)
        self.addCleanup(bridge.close)
        command = [whisker.binary, "controller", "--can", f"slcan:{ends[0]}", *map(str, controller)]
        with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
            self.addCleanup(process.kill)
            done = whisker.whisker("plant", self.short, "--can", f"slcan:{ends[1]}", *plant, "--json")
            process.terminate()
            return done, process.communicate()[1]

    def test_a_plant_sends_its_rules_to_a_controller_with_others(self):
        for built_in, wanted in ((STRAIGHT, STRAIGHT), (STRAIGHT, "default"), ("default", STRAIGHT)):
            for drop in ((), ("--drop", 3)):
                with self.subTest(f"{built_in}, {wanted}, {drop}"):
                    direct = self.run_json("--planner", "skirt", "--rules", wanted, world=self.short)
                    done, said = self.on_a_bus(("--planner", "skirt", "--rules", built_in), ("--rules", wanted, *drop))
                    self.assertEqual(json.loads(done.stdout or "{}").get("hash"), direct["hash"], done.stderr)
                    self.assertEqual(f"response table {direct['rules_digest']}" in said, built_in != wanted)

    def test_a_controller_keeps_the_rules_in_a_file(self):
        kept = self.folder / "kept"
        direct = self.run_json("--planner", "skirt", "--rules", STRAIGHT, world=self.short)
        self.on_a_bus(("--planner", "skirt", "--keep", kept), ("--rules", STRAIGHT))
        done, said = self.on_a_bus(("--planner", "skirt", "--keep", kept), ())
        self.assertEqual(json.loads(done.stdout)["hash"], direct["hash"])
        self.assertIn(f"response table {direct['rules_digest']}", said)
        done, _ = self.on_a_bus(("--planner", "skirt"), ())
        self.assertNotEqual(json.loads(done.stdout)["hash"], direct["hash"])

    def test_a_controller_without_a_table_is_refused(self):
        done, _ = self.on_a_bus(("--planner", "fan"), ("--rules", STRAIGHT))
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertEqual(done.stderr.splitlines()[-1], "whisker: the controller has no response table, and takes none")

    def test_what_is_no_file_to_keep_rules_in_is_refused(self):
        world = self.world.read_bytes()
        for arguments, said in (
            (("--keep", self.world), "world.toml: not a storage of whisker controller: name another file"),
            (("--keep", self.folder / "none" / "kept"), "No such file or directory"),
            (("--keep", self.folder / "kept", "--planner", "fan"), "--keep: planner fan takes no table"),
        ):
            done = whisker.whisker("controller", "--can", f"slcan:{self.folder / 'nobody'}", *arguments)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertRegex(done.stderr, r"\A[^\n]+\n\Z")
            self.assertIn(said, done.stderr)
        self.assertEqual(self.world.read_bytes(), world)
        self.assertFalse((self.folder / "kept").exists())

    def test_compare_drives_both_in_the_same_worlds(self):
        straight = ROOT / "host/lab/rules/laws/straight.toml"
        arguments = ("rules", "compare", "default", straight, "--worlds", "u-trap", "--count", 3, "--seed", 11, "--planner", "skirt", "--json")
        told = json.loads(whisker.whisker(*arguments).stdout)
        self.assertEqual(told, json.loads(whisker.whisker(*arguments, "--jobs", 1).stdout))
        self.assertEqual((told["worlds"], told["both_reach"]), (3, 3))
        product = 1.0
        for seed in (11, 12, 13):
            times = []
            for rules in ("default", straight):
                done = whisker.whisker("campaign", "u-trap", "--replay", seed, "--planner", "skirt", "--rules", rules, "--json")
                times.append(json.loads(done.stdout)["time_s"])
            product *= times[1] / times[0]
        self.assertAlmostEqual(told["time_ratio"]["value"], product ** (1 / 3), places=5)
        same = json.loads(whisker.whisker("rules", "compare", "default", EXAMPLES / "thesis.toml", *arguments[4:]).stdout)
        self.assertEqual(same["time_ratio"], {"value": 1.0, "low": 1.0, "high": 1.0})
        words = whisker.whisker(*arguments[:-1]).stdout
        self.assertIn("time, B / A", words)

    def test_compare_refuses_what_has_no_table(self):
        for arguments, said in (
            ((), "rules compare: --worlds is required"),
            (("--worlds", "maze", "--planner", "fan"), "rules compare: planner fan has no table"),
            (("--worlds", "maze", "--count", "0"), "--count 0: nothing to do"),
        ):
            done = whisker.whisker("rules", "compare", "default", "default", *arguments)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn(said, done.stderr)

    def test_errors_are_one_line(self):
        thesis = EXAMPLES / "thesis.toml"
        for arguments, said in (
            (("--rules", EXAMPLES / "tip.fis"), "tip.fis:1:1: no input 'D' to drive with; the file has service, food"),
            (("--rules", self.folder / "none.toml"), "none.toml:1:1: "),
            (("--rules", thesis, "--map", "SA=steer"), "thesis.toml:1:1: no output 'steer'"),
            (("--rules", thesis, "--map", "XY=steer"), "--map: 'XY=steer' must be D=NAME, R=NAME, SA=NAME or SD=NAME"),
            (("--rules", thesis, "--planner", "fan"), "--rules: planner fan has no table"),
            (("--map", "SA=steer"), "--map needs --rules"),
        ):
            with self.subTest(said):
                done = whisker.whisker("run", self.world, *arguments)
                self.assertEqual((done.returncode, done.stdout), (2, ""))
                self.assertIn(said, done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1)


class Tables(Case):
    """`whisker rules table`: the core's response table as JSON."""

    def table(self, *arguments):
        done = whisker.whisker("rules", "table", *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return json.loads(done.stdout)

    def test_the_default_rules_give_the_committed_table(self):
        table = self.table(EXAMPLES / "thesis.toml")
        committed = (ROOT / "firmware/fuzzy/response_table.hpp").read_text()
        nodes = [int(raw) for node in re.findall(r"\{ *(-?\d+), *(-?\d+)\}", committed) for raw in node]
        self.assertEqual(table["nodes"], nodes)
        self.assertEqual((table["whisker_table"], table["name"], table["symmetric"]), (1, "thesis", True))
        self.assertEqual((table["rows"], table["columns"]), (33, 57))
        world = self.file("world.toml", with_time_limit(whisker.whisker("world", "discs", "--seed", "3").stdout, 1))
        run = json.loads(whisker.whisker("run", world, "--rules", EXAMPLES / "thesis.toml", "--json").stdout)
        self.assertEqual(table["hash"], run["rules_digest"])
        self.assertEqual(table["hash"], "%08x" % zlib.crc32(struct.pack(f"<{len(nodes)}h", *nodes)))

    def test_errors_are_those_of_the_compiled_table(self):
        table = self.table(EXAMPLES / "thesis.toml")
        compiled = json.loads(compile_rules(EXAMPLES / "thesis.toml", "--nodes", "33x57", "--json").stdout)
        for word, output in zip(("turn_error", "step_error"), compiled["outputs"]):
            self.assertAlmostEqual(table[word], output["max_error"])

    def test_a_file_holds_the_same(self):
        law = self.file("my law.toml", (EXAMPLES / "thesis.toml").read_text().replace('name = "thesis"', "").replace('name = "SA"', 'name = "steer"').replace("1.5]", "1.2]", 1))
        out = self.folder / "law.json"
        done = whisker.whisker("rules", "table", law, "--map", "SA=steer", "--out", out)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, f"table: {out}\n", ""))
        table = self.table(law, "--map", "SA=steer")
        self.assertEqual(json.loads(out.read_text()), table)
        self.assertEqual(table["name"], "my law.toml")
        self.assertEqual(whisker.whisker("rules", "table", law, "--map", "SA=steer", "--out", "-").stdout, out.read_text())

    def test_what_is_no_table_is_refused(self):
        thesis = (EXAMPLES / "thesis.toml").read_text()
        self.file("thesis.toml", thesis)
        self.file("tip.fis", (EXAMPLES / "tip.fis").read_text())
        self.file("cut.toml", thesis[:-40])
        self.file("far.toml", thesis.replace('["VB", 1.7]', '["VB", 2.1]'))
        for arguments, says in (
            (("tip.fis",), "tip.fis:1:1: no input 'D' to drive with; the file has service, food"),
            (("cut.toml",), "cut.toml:"),
            (("far.toml",), "far.toml:30:1: 'SD' reaches 2.0"),
            (("none.toml",), "none.toml:1:1: "),
            (("thesis.toml", "--map", "SA=SD"), "--map: thesis.toml: one variable stands for two of the core's"),
            (("thesis.toml", "--map", "XY=steer"), "--map: 'XY=steer' must be D=NAME, R=NAME, SA=NAME or SD=NAME"),
            (("thesis.toml", "--out", "thesis.toml"), "would overwrite"),
            (("thesis.toml", "--out", "nowhere/x.json"), "no such folder"),
        ):
            self.refused("rules", "table", *arguments, *(() if "--out" in arguments else ("--out", "x.json")), says=says)


class Headers(Case):
    def built(self, result, compiler, *flags):
        ids = {o["name"]: re.sub(r"[^a-z0-9]+", "_", o["name"].lower()) for o in result["outputs"]}
        prints = "\n".join(f'      printf("%d ", out.raw_{ids[o["name"]]});' for o in result["outputs"]) + '\n      printf("\\n");'
        low = [i["raw_low"] for i in result["inputs"]]
        high = [i["raw_high"] for i in result["inputs"]]
        suffix = ".c" if "-std=c99" in flags else ".cpp"
        source = self.file("use" + suffix, DRIVER.format(low0=low[0], high0=high[0], low1=low[1], high1=high[1], prints=prints))
        done = subprocess.run(
            [compiler, *flags, "-O2", "-Wall", "-Wextra", "-Wconversion", "-pedantic", "-Werror", source, "-o", self.folder / "use"],
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return subprocess.run([self.folder / "use"], capture_output=True, text=True, check=True).stdout

    def test_every_example_in_c_and_cpp_gives_the_same(self):
        for name in NAMES:
            with self.subTest(name):
                # Fewer inputs: the program prints all of them.
                rules = self.file(name, (EXAMPLES / name).read_text().replace("raw_per_unit = 128", "raw_per_unit = 8"))
                done = compile_rules(rules, "--header", self.folder / "law.h", "--json", "--steps", "100")
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                result = json.loads(done.stdout)
                in_c = self.built(result, "gcc", "-std=c99")
                self.assertEqual(in_c, self.built(result, "g++", "-std=c++17"))
                self.bound_is_kept(rules, result, in_c)

    def bound_is_kept(self, rules, result, raw):
        """The header against a much finer table of the same rules: no error above both bounds, and the printed place is close to its bound."""
        rows = [[int(x) for x in line.split()] for line in raw.splitlines()]
        size = [i["raw_high"] - i["raw_low"] + 1 for i in result["inputs"]]
        self.assertEqual(len(rows), size[0] * size[1])
        whole = compile_rules(rules, "--header", self.folder / "whole.h", "--json", "--steps", "100", "--tolerance", "0.02%")
        finer = json.loads(whole.stdout)
        text = (self.folder / "whole.h").read_text().replace("whole", "law").replace("WHOLE", "LAW")
        (self.folder / "law.h").write_text(text)
        exact = [[int(x) for x in line.split()] for line in self.built(finer, "gcc", "-std=c99").splitlines()]
        for o, (coarse_output, fine_output) in enumerate(zip(result["outputs"], finer["outputs"])):
            unit = lambda out, n: out["origin"] + n / out["raw_per_unit"]  # noqa: E731
            errors = [abs(unit(coarse_output, a[o]) - unit(fine_output, b[o])) for a, b in zip(rows, exact)]
            slack = fine_output["max_error"] + 1e-9
            self.assertLessEqual(max(errors), coarse_output["max_error"] + slack)
            at = coarse_output["max_error_raw_at"]
            index = (at[0] - result["inputs"][0]["raw_low"]) * size[1] + at[1] - result["inputs"][1]["raw_low"]
            self.assertGreaterEqual(errors[index], coarse_output["max_error"] - slack)

    def test_one_input(self):
        law = self.file("line.fll", "Engine: line\nInputVariable: a b\n  range: -1 1\n  term: n Ramp 1 -1\n  term: p Ramp -1 1\n"
                        "OutputVariable: int\n  range: 0 1\n  defuzzifier: WeightedAverage\n  term: z Constant 0\n  term: o Constant 1\n"
                        "RuleBlock:\n")  # fmt: skip
        self.refused("rules", "compile", "line.fll", says="line.fll:1:1: the file has no rule")
        law.write_text(law.read_text().replace("a b", "ab") + "  rule: if ab is n then int is z\n  rule: if ab is p then int is o\n")
        header = self.folder / "law.h"
        self.assertEqual(compile_rules(law, "--header", header).returncode, 0)
        use = self.file("one.c", '#include "law.h"\nint main(void) { return law_look_up(law_ab_raw(0.0)).raw_int == (int)(LAW_INT_PER_UNIT / 2) ? 0 : 1; }\n')
        subprocess.run(["gcc", "-std=c99", "-Wall", "-Wextra", "-Wconversion", "-pedantic", "-Werror", use, "-o", self.folder / "one"], check=True)
        self.assertEqual(subprocess.run([self.folder / "one"], check=False).returncode, 0)


class Command(Case):
    def test_text_and_json_say_the_same(self):
        done = compile_rules(EXAMPLES / "tip.fis")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        result = json.loads(compile_rules(EXAMPLES / "tip.fis", "--json").stdout)
        self.assertIn(f"{result['bytes']} bytes", done.stdout)
        self.assertIn(f"error at most {result['outputs'][0]['max_error_percent']:.4g} % of the span", done.stdout)
        self.assertLessEqual(result["outputs"][0]["max_error_percent"], 1)

    def test_tolerance_and_size(self):
        sizes = [json.loads(compile_rules(EXAMPLES / "tip.fis", "--json", "--tolerance", t).stdout)["bytes"] for t in ("10%", "2%", "1")]
        self.assertEqual(sizes, sorted(sizes))
        best = json.loads(compile_rules(EXAMPLES / "tip.fis", "--json", "--max-bytes", sizes[1]).stdout)
        self.assertLessEqual(best["bytes"], sizes[1])
        self.assertLessEqual(best["outputs"][0]["max_error_percent"], 2)

    def test_pictures(self):
        for name in NAMES:
            svg = self.folder / "law.svg"
            done = whisker.whisker("rules", "show", EXAMPLES / name, "--svg", svg)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn("input ", done.stdout)
            self.assertEqual("output SD, 0.3 to 1.7: " in done.stdout, name == "thesis.toml", "as written, not as rounded")
            self.assertTrue(svg.read_text().rstrip().endswith("</svg>"))

    def test_a_page(self):
        page = self.folder / "law.html"
        text = (EXAMPLES / "tip.fis").read_text().replace("'service'", "'<b>service'")
        file = self.folder / "marked.fis"
        file.write_text(text)
        done = whisker.whisker("rules", "show", file, "--html", page)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn(f"page: {page}", done.stdout)
        html = page.read_text()
        self.assertTrue("if &lt;b&gt;service is poor or food is not delicious then tip is small with 0.5" in html)
        self.assertFalse("<b>" in html or "<!--" in html)

    def test_no_page_of_what_cannot_be_compiled(self):
        page = self.folder / "law.html"
        file = self.folder / "silent.fll"
        text = (EXAMPLES / "pendulum.fll").read_text()
        file.write_text(text[: text.rindex("  rule: ")].replace("default: 0", "default: nan"))
        done = whisker.whisker("rules", "show", file, "--html", page)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1)
        self.assertFalse(page.exists())

    def test_evaluate_prints_the_exact_answers(self):
        # At 2 m, `near` is 0 and `far` is 1; bearing has no terms.
        follower = whisker.whisker("rules", "evaluate", EXAMPLES / "follower.fis", "distance=2", "bearing=30")
        self.assertEqual((follower.returncode, follower.stderr), (0, ""))
        speed, turn = (line.split(" = ") for line in follower.stdout.splitlines())
        self.assertEqual((speed[0], turn[0]), ("speed", "turn"))
        right = 1 / (1 + ((2 - 0.8) / 0.3) ** 4)
        self.assertAlmostEqual(float(speed[1]), (right * (0.5 * 2 - 0.2) + 0.5) / (right + 1), places=9)
        self.assertAlmostEqual(float(turn[1]), (right * 45 + 45 + 0.25 * 22.5) / (right + 1.25), places=9)
        self.assertEqual(whisker.whisker("rules", "evaluate", EXAMPLES / "fan.fcl", "trend=0", "error=-3").stdout, "duty = 0\n")

    def test_evaluate_says_where_no_rule_fires(self):
        rules = self.file("tip.fis", re.sub(r"(?s)\[Rules\].*", "[Rules]\n3 2, 3 (1) : 1\n", (EXAMPLES / "tip.fis").read_text()).replace("NumRules=4", "NumRules=1"))
        self.assertEqual(whisker.whisker("rules", "evaluate", rules, "service=1", "food=1").stdout, "tip = 15 (no rule fires)\n")

    def test_what_is_read_otherwise_than_written_is_said(self):
        rules = self.file("tip.fis", (EXAMPLES / "tip.fis").read_text().replace("NumRules=4", "NumRules=7"))
        says = f"whisker: {rules}:8:10: NumRules is 7, but the file has 4, and all are read\n"
        for command, *arguments in (["compile", "--json"], ["show"], ["evaluate", "service=1", "food=1"]):
            done = whisker.whisker("rules", command, rules, *arguments)
            same = whisker.whisker("rules", command, EXAMPLES / "tip.fis", *arguments)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, same.stdout, says))

    def test_evaluate_refuses_wrong_inputs(self):
        self.file("tip.fis", (EXAMPLES / "tip.fis").read_text())
        for at, says in (("servce=1", "no input 'servce'; did you mean 'service'?"), ("service=11", "'service' must be from 0 to 10"),
                         ("service=x", "'service=x' must be INPUT=VALUE"), ("service=1", "input 'food' needs a value")):  # fmt: skip
            self.refused("rules", "evaluate", "tip.fis", at, says=f"evaluate: {says}")
        self.refused("rules", "evaluate", "tip.fis", "food=1", "food=2", says="evaluate: 'food' is given twice")

    def test_wrong_usage(self):
        self.file("tip.fis", (EXAMPLES / "tip.fis").read_text())
        self.refused("rules", says="rules needs a command")
        self.refused("rules", "compile", says="FILE")
        self.refused("rules", "compile", "missing.fis", says="missing.fis:1:1: ")
        for tolerance in ("0", "-1%", "x", "101%", "1%%"):
            self.refused("rules", "compile", "tip.fis", "--tolerance", tolerance, says="--tolerance")
        for size in ("-1", "x", "1.5"):
            self.refused("rules", "compile", "tip.fis", "--max-bytes", size, says="--max-bytes")
        self.refused("rules", "compile", "tip.fis", "--max-bytes", "4", says="no table fits in 4 bytes")
        self.refused("rules", "compile", "tip.fis", "--nodes", "3y3", says="--nodes")
        self.refused("rules", "compile", "tip.fis", "--nodes", "7x9", says="no spacing that is a power of two")
        for fix in ("x", "servce=1", "service=11", "service=x", "=1"):
            self.refused("rules", "compile", "tip.fis", "--fix", fix, says="--fix")
        self.refused("rules", "compile", "tip.fis", "--header", "tip.fis", says="would overwrite")
        self.refused("rules", "show", "tip.fis", "--svg", "nowhere/x.svg", says="no such folder")


class Documentation(Case):
    def test_the_page_shows_what_the_command_prints(self):
        page = (ROOT / "docs/rules.md").read_text()
        told = {name: whisker.whisker("rules", "compile", f"host/rules/examples/{name}", cwd=ROOT).stdout for name in NAMES}
        self.assertIn(f"$ whisker rules compile host/rules/examples/tip.fis --header tip.h\n{told['tip.fis']}header: tip.h\n```\n", page)
        self.assertRegex(told["thesis.toml"], r"\noutput SA: .*\n  antisymmetric in R\noutput SD: .*\n  symmetric in R\n\Z")
        warned = r"\nwarning: 'force' rises with 'angle', but falls by up to 1.66 % of the span, at angle = 15, rate = 24.1406\n"
        self.assertRegex(told["pendulum.fll"], warned)


class Malformed(Case):
    COUNT = 2000 if os.environ.get("WHISKER_LONG") else 50
    SEED = 20260701

    def mutated(self, text, rng):
        lines = text.splitlines(keepends=True)
        for _ in range(rng.randint(1, 3)):
            i = rng.randrange(len(lines))
            line = lines[i]
            at = rng.randrange(len(line) + 1)
            kind = rng.randrange(7)
            if kind == 0:
                lines[i] = line[:at] + line[at + rng.randint(1, 5):]
            elif kind == 1:
                lines[i] = line[:at] + rng.choice(["\x00", "é", "[", "]", "(", "'", '"', ",", ":", "nan", "1e999", "-", "%", "\n"]) + line[at:]
            elif kind == 2:
                lines.insert(i, rng.choice(lines))
            elif kind == 3 and len(lines) > 1:
                del lines[i]
            elif kind == 4:
                lines[i] = re.sub(r"-?\d+(\.\d+)?", lambda m: rng.choice([m.group(), "inf", "1e300", "0", "-7", "x"]), line)
            elif kind == 5:
                lines = lines[:i + 1]
            else:
                words = line.split()
                rng.shuffle(words)
                lines[i] = " ".join(words) + "\n"
        return "".join(lines)

    def test_every_mutant_is_compiled_or_refused_in_one_line(self):
        rng = random.Random(self.SEED)
        refused = tries = 0
        while refused < self.COUNT:
            tries += 1
            name = rng.choice(NAMES)
            path = self.folder / name
            path.write_bytes(self.mutated((EXAMPLES / name).read_text(), rng).encode())
            done = compile_rules(path, "--steps", "16", "--header", self.folder / "out.h", "--svg", self.folder / "out.svg")
            with self.subTest(seed=self.SEED, tries=tries, name=name):
                if done.returncode == 0:
                    (self.folder / "out.h").unlink()
                    (self.folder / "out.svg").unlink()
                    path.unlink()
                    continue
                refused += 1
                self.assertEqual((done.returncode, done.stdout), (2, ""), path.read_text())
                self.assertRegex(done.stderr, r"\A\S+" + re.escape(name) + r":\d+:\d+: [^\n]+\n\Z")
                self.assertEqual([p.name for p in self.folder.iterdir()], [name], "nothing written")
            path.unlink()
        print(f"{refused} malformed files of {tries}, seed {self.SEED}")


if __name__ == "__main__":
    whisker.main()
