"""`whisker world` and `whisker table`, help and version."""

import csv
import io
import os
import re
import tomllib
import xml.etree.ElementTree

import whisker
from whisker import KINDS, Case, with_time_limit

WIDEST = 100
OPTIONS = {
    (): ("--help", "--version"),
    ("run",): ("SCENARIO", "--planner", "--map-bytes", "--rules", "--map", "--robot", "--seed", "--trace", "--svg", "--html", "--json"),
    ("campaign",): (
        "KIND|DIR", "--count", "--seed", "--discs", "--box", "--noise", "--wheel-scale-sigma", "--planner", "--map-bytes", "--rules", "--map",
        "--robot", "--robots", "--jobs", "--shard", "--csv", "--save-failures", "--json", "--merge", "--replay", "--svg", "--trace", "--html",
    ),
    ("plant",): (
        "SCENARIO", "--rules", "--map", "--can", "--node", "--calibrate", "--realtime", "--robot", "--seed", "--trace", "--svg", "--html", "--json", "--record",
        "--drop",
    ),
    ("controller",): ("--can", "--node", "--guard", "--command-timeout", "--planner", "--map-bytes", "--rules", "--map", "--keep", "--calibration", "--record", "--drop"),
    ("hil",): (
        "SCENARIO", "--can", "--node", "--realtime", "--planner", "--map-bytes", "--rules", "--map", "--robot", "--seed", "--trace", "--svg", "--html",
        "--json", "--record", "--drop",
    ),
    ("bench", "nodes"): ("--for", "--json", "--can", "--tty", "--socket", "--timeout", "--drop"),
    ("bench", "get"): ("NAME", "--all", "--json", "--can", "--tty", "--socket", "--node", "--timeout", "--drop"),
    ("bench", "set"): ("NAME=VALUE", "--json", "--can", "--tty", "--socket", "--node", "--timeout", "--drop"),
    ("bench", "save"): ("FILE", "--can", "--tty", "--socket", "--node", "--timeout", "--drop"),
    ("bench", "restore"): ("FILE", "--json", "--can", "--tty", "--socket", "--node", "--timeout", "--drop"),
    ("bench", "rules"): ("FILE", "--map", "--restore", "--json", "--can", "--tty", "--socket", "--node", "--timeout", "--drop"),
    ("bench", "watch"): ("--for", "--every", "--robot", "--view", "--view-address", "--view-stay", "--json", "--can", "--tty", "--socket", "--node", "--timeout", "--drop"),
    ("bench", "record"): ("FILE", "--for", "--can", "--tty", "--socket", "--node", "--timeout", "--drop"),
    ("bench", "stop"): ("--can", "--tty", "--socket", "--node", "--timeout", "--drop"),
    ("bench", "reset"): ("--can", "--tty", "--socket", "--node", "--timeout", "--drop"),
    ("bench", "cancel"): ("--can", "--tty", "--socket", "--node", "--timeout", "--drop"),
    ("bench", "calibrate"): ("MISSION", "--length", "--for", "--json", "--can", "--tty", "--socket", "--node", "--timeout", "--drop"),
    ("bench", "goal"): (
        "X", "Y", "--tolerance", "--for", "--planner", "--map-bytes", "--rules", "--map", "--view", "--view-address", "--view-stay", "--json",
        "--can", "--tty", "--socket", "--node", "--timeout", "--drop",
    ),
    ("bench", "drive"): ("--keys", "--commands", "--speed", "--turn", "--vouch", "--for", "--json", "--can", "--tty", "--socket", "--node", "--timeout", "--drop"),
    ("replay",): ("LOG", "--node", "--planner", "--map-bytes", "--rules", "--map", "--json"),
    ("dbc",): ("--robot",),
    ("protocol",): ("--parameters",),
    ("world",): ("KIND", "--seed", "--discs", "--box", "--noise", "--wheel-scale-sigma", "--out", *KINDS),
    ("scanner",): ("--count", "--seed", "--discs", "--box", "--jobs", "--json"),
    ("movers",): ("--count", "--seed", "--planner", "--map-bytes", "--rules", "--map", "--contacts"),
    ("guard",): ("SCENARIO", "--robot", "--commands", "--keys", "--operator", "--seed", "--vouch", "--time", "--bare", "--rules", "--map", "--trace", "--html", "--json"),
    ("hunt",): ("--count", "--time", "--seed", "--jobs", "--shard", "--out", "--again", "--case", "--summary"),
    ("operators",): ("--count", "--seed", "--operator", "--hostile", "--noise", "--robot", "--rules", "--map"),
    ("table",): ("--csv", "--svg"),
    ("robot", "check"): ("ROBOT", "--header", "--planner", "--json"),
    ("robot", "calibrate-drive"): (
        "ROBOT", "--tape", "--square-ends", "--side", "--true", "--scene", "--noise", "--straight", "--squares", "--seed", "--count",
        "--jobs", "--can", "--node", "--record", "--drop", "--realtime", "--mission", "--svg", "--json",
    ),
    ("robot", "layout"): (
        "--sensor", "--body", "--clear", "--robot", "--angles", "--count", "--seed", "--planner", "--map-bytes", "--rules", "--map", "--jobs", "--svg",
        "--json", "--out",
    ),
    ("figures",): ("FOLDER", "--scenarios"),
    ("rules", "compile"): (
        "FILE", "--tolerance", "--max-bytes", "--fix", "--nodes", "--steps", "--header", "--svg", "--json",
    ),
    ("rules", "show"): ("FILE", "--svg"),
    ("rules", "search"): (
        "--base", "--worlds", "--count", "--seed", "--generations", "--children", "--validate", "--assist", "--discs", "--width", "--box", "--noise",
        "--planner", "--map-bytes", "--robot", "--jobs", "--out", "--json",
    ),
    ("socket",): ("--tcp", "--udp", "--stdio", "--address", "--robot", "--planner", "--timeout", "--json"),
}


class World(Case):
    def made(self, *arguments):
        done = whisker.whisker("world", *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def test_every_kind_loads_again_and_is_the_same_for_the_same_seed(self):
        for kind in KINDS:
            text = self.made(kind, "--seed", 9)
            self.assertEqual(text, self.made(kind, "--seed", 9), kind)
            self.assertNotEqual(text, self.made(kind, "--seed", 10), kind)
            self.assertEqual(tomllib.loads(text).get("noise"), None)
            noisy = self.made(kind, "--seed", 9, "--noise")
            self.assertGreater(tomllib.loads(noisy)["noise"]["range_sigma_m"], 0)
            worn = self.made(kind, "--seed", 9, "--noise", "--wheel-scale-sigma", "0.02")
            self.assertEqual(tomllib.loads(worn), {**tomllib.loads(noisy), "noise": {**tomllib.loads(noisy)["noise"], "wheel_scale_sigma": 0.02}})
            run = whisker.whisker("run", self.file("w.toml", with_time_limit(noisy, 0.5)), "--json")
            self.assertIn(run.returncode, (0, 4), run.stderr)

    def test_discs_and_box_do_what_they_say(self):
        for number in (0, 1, 7, "07"):
            self.assertEqual(len(tomllib.loads(self.made("discs", "--seed", 1, "--discs", number)).get("disc", [])), int(number))
        self.assertEqual(len(tomllib.loads(self.made("discs", "--seed", 1))["disc"]), 30)
        self.assertNotEqual(self.made("poles", "--seed", 1), self.made("poles", "--seed", 1, "--box"))

    def test_the_largest_seed_is_taken(self):
        self.assertEqual(tomllib.loads(self.made("discs", "--seed", 2**63 - 1)), tomllib.loads(self.made("discs", "--seed", 2**63 - 1)))

    def test_out_replaces_a_file_as_a_whole(self):
        path = self.file("w.toml", "old\n")
        os.symlink("w.toml", self.folder / "link.toml")
        with open(path, encoding="utf-8") as old:
            self.assertEqual(self.made("maze", "--seed", 4, "--out", self.folder / "link.toml"), "")
            self.assertEqual(old.read(), "old\n")
        self.assertEqual(path.read_text(), self.made("maze", "--seed", 4))
        self.assertEqual(sorted(os.listdir(self.folder)), ["link.toml", "w.toml"])


class Table(Case):
    def test_csv_covers_both_inputs_and_is_symmetric(self):
        done = whisker.whisker("table", "--csv")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout.partition("\n")[0], "d,r,sa,sd")
        rows = csv.DictReader(io.StringIO(done.stdout))
        table = {(float(row["d"]), float(row["r"])): (float(row["sa"]), float(row["sd"])) for row in rows}
        self.assertEqual(len(table), 41 * 65)
        self.assertEqual(({min(table), max(table)}), {(0.0, -8.0), (10.0, 8.0)})
        for (d, r), (sa, sd) in table.items():
            self.assertEqual(table[d, -r], (-sa if sa else 0.0, sd), f"D {d}, R {r}")
            self.assertTrue(abs(sa) <= 1.5 and 0 <= sd <= 2, f"D {d}, R {r}: {sa}, {sd}")
        self.assertGreater(max(sa for sa, _ in table.values()), 1)

    def test_words_name_all_terms_and_the_picture(self):
        svg = self.folder / "t.svg"
        done = whisker.whisker("table", "--svg", svg)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for word in ("TRVB", "TRB", "TLB", "TLVB", "LVB", "RVB", str(svg)):
            self.assertIn(word, done.stdout)
        self.assertTrue(xml.etree.ElementTree.parse(svg).getroot().tag.endswith("svg"))

    def test_a_picture_besides_csv_leaves_the_csv_alone(self):
        with_picture = whisker.whisker("table", "--csv", "--svg", self.folder / "t.svg")
        self.assertEqual(with_picture.stdout, whisker.whisker("table", "--csv").stdout)


class Help(Case):
    def test_names_every_option_within_a_hundred_columns(self):
        for command, options in OPTIONS.items():
            for flag in ("--help", "-h"):
                done = whisker.whisker(*command, flag)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                for option in options:
                    self.assertRegex(done.stdout, rf"(?m)(^|[ {{,]){re.escape(option)}\b", command)
                self.assertLessEqual(max(map(len, done.stdout.splitlines())), WIDEST, command)

    def test_tells_the_exit_status_of_a_run_where_it_matters(self):
        for command in OPTIONS:
            text = whisker.whisker(*command, "--help").stdout
            self.assertEqual("5 contact" in text, command in ((), ("run",), ("hil",), ("plant",)), command)
            self.assertEqual("First steps" in text, command == (), command)

    def test_names_every_command_and_no_other(self):
        text = whisker.whisker("--help").stdout.partition("Subcommands:\n")[2].partition("\n\n")[0]
        named = {line.split()[0] for line in text.splitlines()}
        self.assertEqual(named, {command[0] for command in OPTIONS if command})

    def test_names_every_planner_and_which_are_baselines(self):
        for command in ("run", "campaign"):
            text = " ".join(whisker.whisker(command, "--help").stdout.split())
            self.assertIn("Planner: skirt (or boundary), thesis, map", text)
        core, baselines = whisker.planners()
        self.assertLessEqual({"skirt", "thesis", "map"}, {*core})
        self.assertLessEqual({"bug2", "distbug", "wall-follower", "fan", "repulsion"}, {*baselines})

    def test_version_is_one_line(self):
        done = whisker.whisker("--version")
        self.assertRegex(done.stdout, r"\Awhisker \d+\.\d+\.\d+ \([-.+A-Za-z0-9]+\)\n\Z")
        self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    whisker.main()
