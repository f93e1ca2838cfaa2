"""`whisker world` and `whisker table`, and the version."""

import csv
import io
import os
import tomllib
import xml.etree.ElementTree

import whisker
from whisker import KINDS, Case, with_time_limit


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


class Version(Case):

    def test_is_one_line(self):
        done = whisker.whisker("--version")
        self.assertRegex(done.stdout, r"\Awhisker \d+\.\d+\.\d+ \([-.+A-Za-z0-9]+\)\n\Z")
        self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    whisker.main()
