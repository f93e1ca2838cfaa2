"""`whisker movers`: its table, and the scenarios that it writes of contacts."""

import re

import whisker
from whisker import Case, with_time_limit

COLUMNS = ("course", "m/s", "missions", "reached", "said so", "contacts", "moving", "shown", "seen in time")


class Movers(Case):
    def table(self, *arguments):
        """{(course, m/s): {column: number}}"""
        done = whisker.whisker("movers", *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        head, rule, *rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in done.stdout.splitlines()]
        self.assertEqual(tuple(head), COLUMNS)
        self.assertEqual(rule, ["---"] * len(head))
        return {tuple(row[:2]): dict(zip(head[2:], map(int, row[2:]))) for row in rows}

    def test_counts_every_course_at_every_speed(self):
        table = self.table("--count", 8)
        self.assertEqual({course for course, _ in table}, {"oncoming", "crossing", "overtaking"})
        self.assertEqual({speed for _, speed in table}, {"0.05", "0.10", "0.20", "0.30"})
        self.assertEqual(len(table), 12)
        for row in table.values():
            self.assertEqual(row["missions"], 8)
            self.assertLessEqual(row["reached"] + row["contacts"], 8)
            self.assertTrue(row["seen in time"] <= row["shown"] <= row["moving"] <= row["contacts"], row)
        self.assertGreater(sum(row["said so"] for row in table.values()), 0)

    def test_is_the_same_for_the_same_seeds(self):
        self.assertEqual(self.table("--count", 4, "--seed", 7), self.table("--count", 4, "--seed", 7))
        first, second = (self.table("--count", 2, "--seed", seed) for seed in (7, 9))
        for key, row in self.table("--count", 4, "--seed", 7).items():
            self.assertEqual(row, {column: first[key][column] + second[key][column] for column in row})

    def test_a_robot_of_ones_own_meets_what_moves(self):
        same = self.file("same.toml", "body_radius_m = 0.09\n")
        self.assertEqual(self.table("--count", 4, "--robot", same), self.table("--count", 4))
        # A robot that sees nothing is touched more often, and never says why.
        blind = self.file("blind.toml", "[noise]\nrange_false_clear = 1.0\n")
        table = self.table("--count", 8, "--robot", blind)
        self.assertEqual(sum(row["said so"] for row in table.values()), 0)
        contacts = [sum(row["contacts"] for row in t.values()) for t in (table, self.table("--count", 8))]
        self.assertGreater(contacts[0], contacts[1])

    def test_a_large_body_starts_and_arrives_clear(self):
        large = self.file("large.toml", "body_radius_m = 0.3\nwheel_track_m = 0.4\n")
        table = self.table("--count", 3, "--robot", large, "--contacts", self.folder)
        self.assertGreater(table["oncoming", "0.05"]["reached"], 0)
        files = sorted(self.folder.glob("*_*.toml"))
        self.assertGreater(len(files), 0)
        for path in files:  # one that begins in contact is refused
            self.assertEqual(whisker.whisker("run", path).returncode, whisker.STATUS["contact"], path.name)

    def test_contacts_can_be_driven_again(self):
        table = self.table("--count", 6, "--contacts", self.folder)
        files = sorted(self.folder.glob("*.toml"))
        self.assertEqual(len(files), sum(row["contacts"] for row in table.values()))
        self.assertGreater(len(files), 0)
        for path in files:
            self.assertRegex(path.name, r"\A(oncoming|crossing|overtaking)_0\.\d\d_\d_(standing|moving|shown|seen)\.toml\Z")
        self.assertEqual(whisker.whisker("run", files[0]).returncode, whisker.STATUS["contact"])
        self.assertEqual(len(re.findall(r"(?m)^\[\[mover\]\]", files[0].read_text())), 1)
        early = self.file("early.toml", with_time_limit(files[0].read_text(), 0.5))
        self.assertEqual(whisker.whisker("run", early).returncode, whisker.STATUS["gave_up"])

    def test_refuses_what_it_cannot_do(self):
        for arguments, says in (
            (("--count", 0), "--count 0"),
            (("--count", 2, "--seed", 2**63 - 1), "2^63"),
            (("--contacts", self.folder / "none"), "none"),
            (("--count", "x"), "x"),
            (("--planner", "nobody"), "nobody"),
            (("--robot", self.folder / "no.toml"), "no.toml"),
        ):
            self.refused("movers", *arguments, says=says)


if __name__ == "__main__":
    whisker.main()
