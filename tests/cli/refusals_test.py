"""Every error is one line on standard error, before any file is written."""

import os
import pathlib
import random
import re
import subprocess

import whisker
from whisker import SCENARIOS, Case

SCENE = (SCENARIOS / "no_time.toml").read_text()


ROOT = pathlib.Path(__file__).resolve().parents[2]
# Words that mean nothing, or too much, wherever they stand.
WORDS = """nan -nan inf -1 0 1 2 1e999 1e-320 99999999999999999999 0x10 abc 3.5 -0 1,5 vcan9 ../x %s%n rooms map true - . nofile /dev/null
bad.toml bytes.dat""".split()  # fmt: skip
WORDS += ["", " ", "\u0661", "\x1b[31m", "a" * 300, *map(str, (SCENARIOS / "nothing.toml", ROOT / "host/robots/hc-sr04.toml", ROOT / "host/rules/examples/tip.fis"))]
# They drive for minutes if nothing is wrong.
LONG = {("operators",), ("movers",), ("hunt",)}


def commands(*names):
    """Every command that does something, with its options."""
    text = whisker.whisker(*names, "--help").stdout
    below = re.search(r"^(?:Subcommands|SUBCOMMANDS):\n((?:  .*\n)+)", text, re.MULTILINE)
    found = [line.split()[0] for line in below[1].splitlines() if re.match("  [a-z]", line)] if below else []
    if not found:
        yield names, sorted({*re.findall("--[a-z][a-z0-9-]*", text)} - {"--help", "--view-stay", "--figures"})
    for name in found:
        yield from commands(*names, name)


class Drawn(Case):
    def test_no_line_crashes_hangs_or_speaks_of_the_library(self):
        seed = int(os.environ.get("SEED", "1"))
        print("SEED", seed, flush=True)
        rng = random.Random(seed)
        self.file("bad.toml", "[start\nx=nan")
        (self.folder / "bytes.dat").write_bytes(rng.randbytes(4000))
        known = [(names, options) for names, options in commands() if names not in LONG]
        self.assertGreater(len(known), 25)
        for _ in range(2000 if "WHISKER_LONG" in os.environ else 400):
            names, options = rng.choice(known)
            line = [*names, *rng.choices(WORDS, k=rng.randrange(3))]
            for option in rng.choices(options, k=rng.randrange(4)) if options else ():
                line += [option] + rng.choices(WORDS, k=rng.random() < 0.75)
            done = subprocess.run([whisker.binary, *line], stdin=subprocess.DEVNULL, capture_output=True, timeout=60, cwd=self.folder)
            error = done.stderr.decode(errors="replace")
            with self.subTest(line):
                self.assertIn(done.returncode, range(8), error)
                self.assertNotRegex(error, r"terminate|what\(\)|std::|Assertion|logic_error|bad_alloc|basic_string|stoi|stod|\x1b")
                self.assertTrue(error.strip() or done.returncode in (0, 3, 4, 5, 6, 7), "a failure without a word")


class Refusals(Case):
    def setUp(self):
        super().setUp()
        self.file("a.toml", SCENE)
        self.file("robot.toml", "body_radius_m = 0.08\n")
        (self.folder / "folder").mkdir()

    def test_a_command_line_that_means_nothing(self):
        self.refused()
        self.refused("nonsense", says="nonsense")
        self.refused("--bogus", says="--bogus")
        self.refused("run", says="SCENARIO")
        self.refused("run", "a.toml", "b.toml", says="b.toml")
        self.refused("run", "a.toml", "--bogus", says="--bogus")
        self.refused("run", "a.toml", "--trace", says="--trace")
        self.refused("run", "a.toml", "--json=false", says="json")
        self.refused("run", "a.toml", "--seed", "1", "--seed", "2", says="--seed")
        self.refused("table", "x", says="x")
        self.refused("world", "discs", says="--seed")
        self.refused("world", "--seed", "1", says="KIND")
        self.refused("world", "cubes", "--seed", "1", says="cubes")
        self.refused("figures", says="FOLDER")

    def test_former_names_of_commands_mean_the_present_ones(self):
        fuzzy = ROOT / "host/rules/examples/thesis.toml"
        for former, now in (
            (["dbc", "--robot", "2"], ["protocol", "--dbc", "--robot", "2"]),
            (["rules", "table", fuzzy], ["table", fuzzy, "--json"]),
            (["scanner", "discs", "--count", "1"], ["campaign", "discs", "--scanner", "--count", "1"]),
            (["bench", "save", "--socket", "none", "kept.toml"], ["bench", "get", "--out", "kept.toml", "--socket", "none"]),
        ):
            one, other = whisker.whisker(*former), whisker.whisker(*now)
            self.assertEqual((one.returncode, one.stdout, one.stderr), (other.returncode, other.stdout, other.stderr), former)
        self.assertNotIn("dbc ", whisker.whisker("--help").stdout)

    def test_names_that_would_act_on_a_terminal(self):
        self.refused("run", "\x1b]0;owned\x07.toml", says="?]0;owned?.toml:1:1: ")
        self.refused("run", "a.toml", "--plan\x1b[2J", says="--plan?[2J")
        self.refused("\x9b2J", says="?2J")
        rules = (pathlib.Path(__file__).parents[2] / "host/rules/examples/tip.fis").read_text()
        for name in ("tip", "service"):
            self.file("r.fis", rules.replace(f"'{name}'", f"'{name}\x1b[2J'"))
            self.refused("rules", "show", "r.fis", says=f"'{name}?[2J': a control character in a name")

    def test_planners_that_are_unknown(self):
        for planner in ("nonsense", ""):
            self.refused("run", "a.toml", "--planner", planner, says=planner)

    def test_maps_of_other_sizes_and_of_planners_without_one(self):
        for size in ("2000", "0", "-1", "2 KB", ""):
            self.refused("run", "a.toml", "--planner", "map", "--map-bytes", size, says="--map-bytes")
        self.refused("run", "a.toml", "--planner", "skirt", "--map-bytes", "2048", says="skirt")

    def test_numbers_that_are_none(self):
        wrong = ("-1", "+1", "1e30", "1.5", "0x10", "", " 7", "7 ", "7x", "nan", "9223372036854775808", "9" * 40)
        for number in wrong:
            self.refused("run", "a.toml", "--seed", number, says="--seed")
            self.refused("world", "discs", "--seed", number, says="--seed")
        for number in ("-1", "201", "1e30", "2.5", ""):
            self.refused("world", "discs", "--seed", "1", "--discs", number, says="--discs")

    def test_scenarios_that_cannot_be_read(self):
        for scenario, says in (("missing.toml", "missing.toml:1:1: "), ("folder", "folder:1:1: "), ("", "SCENARIO")):
            self.refused("run", scenario, "--trace", "t.csv", says=says)

    def test_scenarios_that_are_wrong_are_named_with_their_place(self):
        for text, place in (
            ('name = "x\n', "1:10"),
            ("", "1:1"),
            ("name = 1\n" + SCENE.partition("\n")[2], "1:8"),
            ("\x00", "1:1"),
            (SCENE + "\n[[disc]]\ncenter = [0.0, 0.1]\nradius_m = 0.2\n", "4:1"),
            (SCENE + "typo = 1\n", "11:1"),
            (SCENE + '"\\n\\u001b[31m" = 1\n', "11:1"),
        ):
            self.file("wrong.toml", text)
            self.refused("run", "wrong.toml", "--trace", "t.csv", "--svg", "t.svg", says=f"wrong.toml:{place}: ")

    def test_robots_that_are_wrong_are_named_with_their_place(self):
        for text, place in (("body = 1\n", "1:1"), ("\nbody_radius_m = 9.0\n", "2:17"), ("[goal]\n", "1:2")):
            self.file("wrong.toml", text)
            self.refused("run", "a.toml", "--robot", "wrong.toml", "--trace", "t.csv", says=f"wrong.toml:{place}: ")
        self.refused("run", "a.toml", "--robot", "missing.toml", says="missing.toml:1:1: ")
        self.refused("run", "a.toml", "--robot", "folder", says="folder:1:1: ")
        self.refused("run", "a.toml", "--robot", "", says="--robot")

    def test_a_robot_too_large_for_the_start(self):
        self.file("a.toml", SCENE + "\n[[disc]]\ncenter = [0.0, 1.0]\nradius_m = 0.5\n")
        self.file("large.toml", "body_radius_m = 0.5\n")
        self.refused("run", "a.toml", "--robot", "large.toml", says="large.toml:1:1: ")

    def test_every_number_option_refuses_what_is_no_number(self):
        checked = 0
        for command in ("run", "world", "guard", "campaign", "movers", "operators", "robot calibrate", "robot calibrate-drive", "robot layout",
                        "plant", "hil", "bench drive", "bench goal", "socket"):  # fmt: skip
            options = re.findall(r"(?m)^\s+(--[a-z-]+) [A-Z]", whisker.whisker(*command.split(), "--help").stdout)
            for option in options:
                if "is no number" not in whisker.whisker(*command.split(), option, "x").stderr:
                    continue
                checked += 1
                for value in ("nan", "inf", "-inf", "1e400", "0,5"):
                    self.refused(*command.split(), option, value, says=f"'{value}' is no number from ")
        self.assertGreater(checked, 30)

    def test_the_help_that_is_named_lists_the_command_and_its_options(self):
        for command, help_of in (("run a.toml --sed 3", "run"), ("robot check a.toml --jso", "robot check"), ("robot chek", "robot"), ("--versio", ""), ("rnu", "")):
            self.refused(*command.split(), says=f"(see whisker {help_of}".rstrip() + " --help)")
        self.refused("run", "a.toml", "--seed", "x", says="(see whisker run --help)")

    def test_none_of_something_is_nothing_to_do(self):
        for command in ("campaign discs --count", "movers --count", "operators --count", "operators --hostile", "robot calibrate robot.toml --count",
                        "robot calibrate-drive robot.toml --count", "robot layout --sensor hc-sr04 --count", "scanner discs --count"):  # fmt: skip
            self.refused(*command.split(), "0", says=f"whisker: {command.split()[-1]} 0: nothing to do")

    def test_a_file_in_anothers_place_is_called_by_its_kind(self):
        self.refused("run", "robot.toml", says="robot.toml:1:1: this is a robot file, not a scenario; give it with --robot")
        self.file("sensor.toml", '[sensor]\nmodel = "VL53L1X"\n')
        self.refused("guard", "sensor.toml", says="sensor.toml:1:1: this is a robot file")
        self.refused("run", "a.toml", "--robot", "a.toml", says="a.toml:1:1: this is a scenario, not a robot file")
        self.refused("robot", "check", "a.toml", says="a.toml:1:1: this is a scenario, not a robot file")

    def test_outputs_that_cannot_be_written(self):
        for output in ("nowhere/t", "folder", "folder/", "a.toml/t", ""):
            self.refused("run", "a.toml", "--trace", output)
            self.refused("run", "a.toml", "--svg", output)
            self.refused("world", "discs", "--seed", "1", "--out", output)
            self.refused("table", "--svg", output)
        self.refused("figures", "nowhere", says="nowhere")

    def test_an_output_that_is_the_scenario_or_the_robot(self):
        os.symlink("a.toml", self.folder / "link.toml")
        os.link(self.folder / "a.toml", self.folder / "hard.toml")
        for output in ("a.toml", "./a.toml", "folder/../a.toml", self.folder / "a.toml", "link.toml", "hard.toml"):
            for option in ("--trace", "--svg"):
                self.refused("run", "a.toml", option, output, says="a.toml")
        self.refused("run", "a.toml", "--robot", "robot.toml", "--trace", "./robot.toml", says="robot.toml")

    def test_one_file_for_two_outputs(self):
        os.symlink("old.csv", self.folder / "link.csv")
        for a, b in (("t", "t"), ("t", "./t"), ("t", "folder/../t"), (self.folder / "t", "t")):
            self.refused("run", "a.toml", "--trace", a, "--svg", b, says="two outputs")
        self.file("old.csv", "kept\n")
        self.refused("run", "a.toml", "--trace", "old.csv", "--svg", "link.csv", says="two outputs")

    def test_worlds_that_cannot_be(self):
        for kind in ("u-trap", "spiral", "maze"):
            self.refused("world", kind, "--seed", "1", "--discs", "3", says=kind)
            self.refused("world", kind, "--seed", "1", "--box", says=kind)
        self.refused("world", "discs", "--seed", "1", "--wheel-scale-sigma", "0.01", says="needs noise")
        for sigma in ("-0.1", "-0", "1.1", "nan", "inf", "", "0x1", "1 ", "1%"):
            self.refused("world", "discs", "--seed", "1", "--noise", "--wheel-scale-sigma", sigma, says="--wheel-scale-sigma")

    def test_figures_without_their_scenarios_draw_nothing(self):
        self.refused("figures", "folder", "--scenarios", ".", says="figure8_u_trap.toml:1:1: ")

    def test_a_full_disk_is_a_failure(self):
        full = "/dev/full"
        for arguments in (
            ("run", "a.toml", "--trace", full),
            ("run", "a.toml", "--svg", full, "--json"),
            ("world", "discs", "--seed", "1", "--out", full),
            ("table", "--svg", full),
        ):
            self.refused(*arguments, status=1, says="No space left")

    def test_a_full_standard_output_is_a_failure(self):
        for arguments in (
            ("run", "a.toml", "--json"),
            ("run", "a.toml"),
            ("world", "discs", "--seed", "1"),
            ("table",),
            ("table", "--csv"),
            ("--version",),
            ("run", "--help"),
        ):
            with open("/dev/full", "w", encoding="utf-8") as full, self.subTest(arguments):
                done = subprocess.run(
                    [whisker.binary, *arguments],
                    stdout=full, stderr=subprocess.PIPE, text=True, cwd=self.folder, check=False,
                )  # fmt: skip
                self.assertEqual(done.returncode, 1)
                self.assertRegex(done.stderr, r"\Awhisker: cannot write[^\n]*\n\Z")

    def test_a_closed_standard_error_changes_no_exit_status(self):
        for arguments, status in (
            (("run", "missing.toml"), 2),
            (("run", "a.toml", "--bogus"), 2),
            (("run", "a.toml", "--planner", "nonsense"), 2),
            (("table", "--svg", "/dev/full"), 1),
        ):
            with self.subTest(arguments):
                shell = ["sh", "-c", 'exec "$@" 2>&-', "sh", whisker.binary, *arguments]
                done = subprocess.run(shell, stdout=subprocess.PIPE, cwd=self.folder, check=False)
                self.assertEqual((done.returncode, done.stdout), (status, b""))


if __name__ == "__main__":
    whisker.main()
