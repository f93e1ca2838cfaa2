"""`--html`: one self-contained file, the same for the same run; the other output does not change."""

import json
import re

import whisker
from whisker import HERE, ORIGIN, SCENARIOS, Case

U_TRAP = HERE.parent.parent / "host/worlds/scenarios/figure8_u_trap.toml"


def data_of(page):
    return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.S)[1])


def figures_of(text):
    """An object of --json without its provenance, which the page shows elsewhere."""
    return {key: value for key, value in json.loads(text).items() if key not in ORIGIN}


class Page(Case):
    def written(self, *arguments):
        path = self.folder / "page.html"
        done = whisker.whisker(*arguments, "--html", path)
        self.assertEqual(done.stderr, "")
        return done, path.read_text(encoding="ascii")

    def test_of_a_run_has_its_verdict_and_leaves_the_run_as_it_is(self):
        done, page = self.written("run", U_TRAP, "--json")
        self.assertEqual(done.stdout, whisker.whisker("run", U_TRAP, "--json").stdout)
        data = data_of(page)
        self.assertEqual(data["runs"][0]["result"], figures_of(done.stdout))
        self.assertEqual([path.name for path in self.folder.iterdir()], ["page.html"])

    def test_asks_for_nothing_outside_itself(self):
        _, page = self.written("run", U_TRAP)
        self.assertEqual(re.findall(r"""(?:src|href)\s*=\s*["'](?!#|data:)[^"']*""", page), [])
        self.assertEqual(re.findall(r"@import|url\((?!data:)", page), [])
        self.assertEqual(re.findall(r"\b(?:XMLHttpRequest|WebSocket)\b", page), [])
        # Only a live page may connect to its server; the content security policy blocks every other page.
        policy = re.search(r'http-equiv="Content-Security-Policy" content="([^"]*)"', page)[1]
        self.assertIn("default-src 'none'", policy)
        self.assertNotIn("connect-src", policy)

    def test_is_the_same_for_the_same_run(self):
        arguments = ("run", SCENARIOS / "all_noise.toml", "--seed", 3)
        self.assertEqual(self.written(*arguments)[1], self.written(*arguments)[1])

    def test_is_named_in_words(self):
        done, _ = self.written("run", U_TRAP)
        self.assertIn(f"page:    {self.folder / 'page.html'}\n", done.stdout)

    def test_is_written_whatever_the_verdict(self):
        for name, status in (("run_over", 5), ("blind", 6), ("no_time", 4)):
            done, page = self.written("run", SCENARIOS / f"{name}.toml", "--json")
            self.assertEqual(done.returncode, status, name)
            columns = {column[0]: column[3] for column in data_of(page)["runs"][0]["columns"]}
            self.assertGreater(columns["t_s"], 0, name)

    def test_has_the_seed_that_was_given(self):
        _, page = self.written("run", U_TRAP, "--seed", 99)
        self.assertEqual(data_of(page)["runs"][0]["seed"], 99)

    def test_of_a_campaign_has_every_mission_to_replay_the_worst_first(self):
        done, page = self.written("campaign", "u-trap", "--count", 10, "--planner", "bug2", "--json")
        data = data_of(page)
        self.assertEqual(data["campaign"]["summary"], figures_of(done.stdout))
        rows = [dict(zip(data["campaign"]["fields"], row)) for row in data["campaign"]["rows"]]
        self.assertEqual([row["seed"] for row in rows], list(range(1, 11)))
        self.assertEqual([run["row"] for run in data["runs"]], data["campaign"]["order"])
        self.assertEqual(sorted(data["campaign"]["order"]), list(range(10)))
        for run in data["runs"]:
            row = rows[run["row"]]
            self.assertEqual((run["seed"], run["result"]["outcome"]), (row["seed"], row["outcome"]))
            self.assertAlmostEqual(run["result"]["path_m"], row["path_m"], 5)
        successes = [rows[run["row"]]["success"] for run in data["runs"]]
        self.assertEqual(successes, sorted(successes))

    def test_of_a_shard_replays_missions_of_the_shard(self):
        _, page = self.written("campaign", "u-trap", "--count", 6, "--shard", "2/2")
        data = data_of(page)
        self.assertEqual(sorted(run["seed"] for run in data["runs"]), [4, 5, 6])

    def test_of_a_folder_replays_its_files(self):
        worlds = self.folder / "worlds"
        worlds.mkdir()
        for seed in (3, 4):
            whisker.whisker("world", "u-trap", "--seed", seed, "--out", worlds / f"{seed}.toml")
        _, page = self.written("campaign", worlds)
        data = data_of(page)
        self.assertEqual(sorted(run["name"] for run in data["runs"]), ["u-trap, seed 3", "u-trap, seed 4"])
        for run in data["runs"]:
            self.assertIn("whisker run", run["command"])

    def test_of_one_mission_of_a_campaign(self):
        _, page = self.written("campaign", "u-trap", "--replay", 5)
        data = data_of(page)
        self.assertNotIn("campaign", data)
        self.assertEqual(data["runs"][0]["name"], "u-trap, seed 5")

    def test_is_refused_before_any_work_where_it_cannot_go(self):
        html = self.folder / "p.html"
        for arguments, words in (
            (("run", U_TRAP, "--html", html, "--svg", html), "named for two outputs"),
            (("run", U_TRAP, "--html", self.folder / "no" / "p.html"), "no such folder"),
            (("run", U_TRAP, "--html", self.folder), "is a folder"),
            (("campaign", "discs", "--html", html, "--csv", html), "named for two outputs"),
            (("campaign", "--merge", U_TRAP, "--html", html), "--html does not go with --merge"),
        ):
            done = whisker.whisker(*arguments)
            self.assertEqual((done.returncode, done.stdout), (2, ""), arguments)
            self.assertIn(words, done.stderr)
            self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    whisker.main()
