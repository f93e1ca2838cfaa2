"""`whisker hunt`: fresh cases, files that repeat them, resuming, summaries, and its errors."""

import csv

import whisker
from whisker import Case

FIRST = ("--seed", 3000)


class Hunt(Case):
    def hunt(self, *arguments):
        done = whisker.whisker("hunt", *arguments, cwd=self.folder)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        return done

    def rows(self):
        with open(self.folder / "rows.csv", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_its_status_says_whether_it_found_something(self):
        done = self.hunt(*FIRST, "--count", 8)
        self.assertEqual(done.returncode == 0, "nothing found" in done.stdout, done.stdout)
        self.assertIn("8 cases", done.stdout)

    def test_goes_on_in_its_folder(self):
        self.hunt(*FIRST, "--count", 4, "--out", ".")
        first = self.rows()
        self.assertEqual(sorted(int(row["seed"]) for row in first), [3000, 3001, 3002, 3003])
        # A kill in the middle of a row.
        with open(self.folder / "rows.csv", "a", encoding="utf-8") as file:
            file.write("3004,,lag,po")
        self.hunt(*FIRST, "--count", 6, "--out", ".")
        whole = [row for row in self.rows() if row["hash"]]
        self.assertEqual(whole[:4], first)
        self.assertEqual(sorted(int(row["seed"]) for row in whole), list(range(3000, 3006)))
        summary = self.hunt("--summary", "rows.csv")
        self.assertIn("6 cases", summary.stdout)
        self.assertEqual(summary.returncode, 0)

    def test_a_case_is_repeated_by_its_file(self):
        commands = set()
        for seed in range(3000, 3012):
            again = self.hunt("--again", seed, "--out", ".")
            name = again.stdout.splitlines()[-1].removeprefix("./")
            told = again.stdout.splitlines()[1:-1]
            self.assertEqual(self.hunt("--case", name).stdout.splitlines(), told)
            first = (self.folder / name).read_text(encoding="utf-8").splitlines()[0].removeprefix("# whisker ")
            done = whisker.whisker(*first.split(), cwd=self.folder)
            self.assertNotIn(done.returncode, (1, 2), done.stderr)
            commands.add(first.split()[0])
            if first.startswith("run"):
                self.assertIn(told[0].split()[-1], done.stdout)
        self.assertLessEqual(commands, {"run", "guard", "hunt"})

    def test_refuses_what_it_cannot_do(self):
        for arguments, says in (
            (("--shard", "3/2"), "--shard 3/2"),
            (("--shard", "0/2"), "--shard 0/2"),
            (("--out", "none"), "no such folder"),
            (("--count", "-1"), "--count"),
            (("--case", "none.toml"), "none.toml"),
            (("--summary", "none.csv"), "none.csv"),
        ):
            self.refused("hunt", *arguments, says=says)


if __name__ == "__main__":
    whisker.main()
