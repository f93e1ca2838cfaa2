"""`whisker campaign`: rows, summary, shards, interruption, and that each row's command repeats its run."""

import csv
import io
import json
import os
import pty
import re
import resource
import select
import shlex
import signal
import subprocess
import time

import whisker
from whisker import HERE, ORIGIN, SCENARIOS, STATUS, Case, with_time_limit

COUNT = 12
KIND = ("discs", "--discs", 10)
PROGRESS = re.compile(rb"\r\x1b\[K\[#*\.*\] \d+ of 1000000, \d+\.\d a second, \d+:\d\d to go")
SHARES = ("truly_there", "success", "reached", "off_goal", "at_goal", "unreachable", "false_unreachable", "gave_up", "contact", "fault")


def rows_of(text):
    return list(csv.DictReader(io.StringIO(text)))


class Driven(Case):
    def campaign(self, *arguments, **options):
        done = whisker.whisker("campaign", *arguments, cwd=self.folder, **options)
        self.assertEqual((done.returncode, done.stderr), (0, ""), arguments)
        return done.stdout

    def rows(self, *arguments):
        """The bytes of the CSV file."""
        self.campaign(*arguments, "--csv", "rows.csv", "--overwrite")
        return (self.folder / "rows.csv").read_text()


class Campaigns(Driven):
    def test_are_in_order_of_seed_and_the_same_however_they_are_driven(self):
        alone = self.rows(*KIND, "--count", COUNT, "--seed", 5, "--jobs", 1)
        self.assertEqual([int(row["seed"]) for row in rows_of(alone)], list(range(5, 5 + COUNT)))
        for jobs in (2, 7, 40):
            self.assertEqual(self.rows(*KIND, "--count", COUNT, "--seed", 5, "--jobs", jobs), alone)
        self.assertEqual(self.rows(*KIND, "--count", COUNT, "--seed", 5), alone)
        later = self.rows(*KIND, "--count", 3, "--seed", 9)
        def without_number(row):
            return {key: value for key, value in row.items() if key not in ("mission", "missions")}

        self.assertEqual([*map(without_number, rows_of(later))], [*map(without_number, rows_of(alone)[4:7])])
        self.assertEqual([(row["mission"], row["missions"]) for row in rows_of(later)], [("1", "3"), ("2", "3"), ("3", "3")])

    def test_are_what_world_and_run_give(self):
        for kind, seed in ((("discs", "--discs", 12, "--box", "--noise"), 3), (("u-trap",), 8), (("maze", "--noise", "--wheel-scale-sigma", "0.01"), 2), (("rooms", "--discs", 0), 2)):
            (row,) = rows_of(self.rows(*kind, "--seed", seed, "--count", 1))
            world = whisker.whisker("world", *kind, "--seed", seed).stdout
            result = json.loads(whisker.whisker("run", self.file("w.toml", world), "--json").stdout)
            for key, value in result.items():
                if key in (*ORIGIN, "bumps", *whisker.RANGE_TRUST, *whisker.BOUND):  # rows do not have them
                    continue
                same = str(value) == row[key] if isinstance(value, (str, int)) else float(row[key]) == value
                self.assertTrue(same, f"{kind}: {key}: {value} and {row[key]}")
            self.assertEqual(row["world"], " ".join(map(str, kind)))

    def test_hold_figures_that_fit_each_other(self):
        for row in rows_of(self.rows(*KIND, "--count", COUNT)):
            path, time_s = float(row["path_m"]), float(row["time_s"])
            self.assertAlmostEqual(float(row["ratio"]), path / float(row["shortest_m"]), places=5)
            self.assertAlmostEqual(float(row["s_per_m"]), time_s / float(row["shortest_m"]), places=5)
            self.assertGreaterEqual(float(row["shortest_m"]), 8 * 2**0.5 - 1e-6)
            self.assertEqual(int(row["ticks"]), round(time_s * 100) + 1)
            self.assertEqual(row["at_goal"], str(int(float(row["final_distance_m"]) <= 0.1)))
            self.assertLess(float(row["estimate_error_m"]), 0.01)
            if row["outcome"] == "reached":
                self.assertLess(float(row["final_distance_m"]), 0.1)
                self.assertGreater(float(row["ratio"]), 1 - 0.1 / float(row["shortest_m"]) - 1e-6)

    def test_of_an_enclosed_goal_have_no_way(self):
        for row in rows_of(self.rows("enclosed", "--count", 2, "--discs", 3)):
            self.assertEqual((row["shortest_m"], row["ratio"]), ("", ""))

    def test_the_planner_may_be_chosen(self):
        for planner in (*sum(whisker.planners(), []), "map-16384"):
            rows = rows_of(self.rows(*KIND, "--count", 2, "--seed", 2, "--planner", planner))
            self.assertEqual({row["planner"] for row in rows}, {planner})
            world = self.file("w.toml", whisker.whisker("world", *KIND, "--seed", 3).stdout)
            run = json.loads(whisker.whisker("run", world, "--planner", planner, "--json").stdout)
            self.assertEqual(rows[1]["hash"], run["hash"])

    def test_a_robot_file_counts_for_every_mission(self):
        self.file("slow.toml", "wheel_speed_max_mps = 0.1\n")
        usual, slow = (rows_of(self.rows(*KIND, "--count", 3, *robot)) for robot in ((), ("--robot", "slow.toml")))
        for a, b in zip(usual, slow):
            self.assertLess(float(a["time_s"]), float(b["time_s"]))
            self.assertEqual((a["robot"], b["robot"]), ("", "slow.toml"))


class Shards(Driven):
    def test_put_together_are_the_whole(self):
        whole = self.rows(*KIND, "--count", COUNT)
        words = self.campaign("--merge", "rows.csv")
        self.assertIn(words, self.campaign(*KIND, "--count", COUNT))
        for shards in (1, 5, COUNT):
            names = [f"shard{i}of{shards}.csv" for i in range(1, shards + 1)]
            for i, name in enumerate(names, 1):
                self.campaign(*KIND, "--count", COUNT, "--shard", f"{i}/{shards}", "--csv", name)
            parts = [(self.folder / name).read_text() for name in names]
            header = whole.partition("\n")[0] + "\n"
            self.assertEqual(header + "".join(part.removeprefix(header) for part in parts), whole)
            self.assertEqual(self.campaign("--merge", *names), words)
            self.assertEqual(self.campaign("--merge", *reversed(names)), words)
            self.file("all.csv", "".join(parts))
            self.assertEqual(self.campaign("--merge", "all.csv"), words)

    def test_rows_that_a_spreadsheet_has_saved_are_merged(self):
        self.rows(*KIND, "--count", 3)
        words = self.campaign("--merge", "rows.csv")
        rows = list(csv.reader((self.folder / "rows.csv").read_text().splitlines()))
        for separator, point, end in ((";", ",", "\r\n"), (",", ".", "\n")):
            short = [[re.sub(r"^(-?\d+)\.(\d*?)0+$", lambda m: m[1] + (point + m[2] if m[2] else ""), field) for field in row] for row in rows]
            with (self.folder / "saved.csv").open("w", encoding="utf-8-sig", newline="") as file:
                csv.writer(file, delimiter=separator, lineterminator=end).writerows(short)
            self.assertEqual(self.campaign("--merge", "saved.csv"), words)

    def test_what_cannot_be_merged_is_refused_with_its_place(self):
        text = self.rows(*KIND, "--count", 2)
        self.refused("campaign", "--merge", "rows.csv", "rows.csv", says="rows.csv:2:1: ")
        self.refused("campaign", "--merge", "none.csv", says="none.csv:1:1: ")
        self.file("cut.csv", text[:-2])
        self.refused("campaign", "--merge", "cut.csv", says="cut.csv:3:1: ")
        self.file("odd.csv", text.replace(",reached,", ",arrived,").replace(",gave_up,", ",tired,"))
        self.refused("campaign", "--merge", "odd.csv", says="odd.csv:2:1: ")
        self.refused("campaign", "--merge", "rows.csv", "--count", 3, says="--count")
        self.refused("campaign", "discs", "--merge", "rows.csv", says="KIND|DIR")
        self.refused("campaign", "--merge", says="--merge")

    def test_a_missing_shard_is_noticed(self):
        for i in (1, 2, 3):
            self.campaign(*KIND, "--count", 6, "--shard", f"{i}/3", "--csv", f"{i}.csv")
        for some, first in ((("1.csv", "3.csv"), 3), (("1.csv", "2.csv"), 5), (("3.csv", "2.csv"), 1)):
            self.refused("campaign", "--merge", *some, says=f"2 of 6 missions of discs --discs 10 are missing, the first is number {first}: --incomplete")
            self.assertEqual(json.loads(self.campaign("--merge", *some, "--incomplete", "--json"))["missions"], 4)
        # Two campaigns are whole each.
        self.campaign("maze", "--count", 1, "--csv", "maze.csv")
        self.campaign(*KIND, "--count", 1, "--seed", 7, "--csv", "later.csv")
        self.campaign("--merge", "1.csv", "2.csv", "3.csv", "maze.csv", "later.csv")
        (self.folder / "worlds").mkdir()
        for name in ("a", "b"):
            (self.folder / "worlds" / f"{name}.toml").write_text(with_time_limit((SCENARIOS / "nothing.toml").read_text(), 1))
        self.campaign("worlds", "--shard", "2/2", "--csv", "b.csv")
        self.refused("campaign", "--merge", "b.csv", says="1 of 2 missions of worlds/ are missing, the first is number 1")


class Summary(Driven):
    def test_json_agrees_with_the_rows(self):
        text = self.rows("u-trap", "--count", COUNT)
        rows = rows_of(text)
        summary = json.loads(self.campaign("--merge", "rows.csv", "--json"))
        self.assertEqual(self.campaign("u-trap", "--count", COUNT, "--json").count("\n"), 1)
        self.assertEqual(summary["missions"], COUNT)
        reached = [row for row in rows if row["outcome"] == "reached"]
        self.assertGreater(len(reached), 0)
        self.assertAlmostEqual(summary["success"]["value"], len(reached) / COUNT, places=6)
        ratios = sorted(float(row["ratio"]) for row in reached)
        self.assertAlmostEqual(summary["ratio"]["mean"]["value"], sum(ratios) / len(ratios), places=5)
        self.assertAlmostEqual(summary["ratio"]["p50"]["value"], ratios[(len(ratios) + 1) // 2 - 1], places=5)
        metres = sum(float(row["path_m"]) for row in rows)
        for column, key in (("stops", "stops_per_m"), ("flips", "flips_per_m"), ("looks", "looks_per_m")):
            self.assertAlmostEqual(summary[key]["all"]["value"], sum(int(r[column]) for r in rows) / metres, places=5)
        there = [row for row in reached if row["at_goal"] == "1"]
        self.assertAlmostEqual(summary["at_goal"]["value"], len(there) / COUNT, places=6)
        errors = sorted(float(row["estimate_error_m"]) for row in rows)
        self.assertAlmostEqual(summary["estimate_error_m"]["p50"]["value"], errors[(COUNT + 1) // 2 - 1], places=6)
        driven = sorted(float(row["path_m"]) for row in rows)
        self.assertAlmostEqual(summary["path_m"]["p50"]["value"], driven[(COUNT + 1) // 2 - 1], places=6)
        for key in SHARES:
            share = summary[key]
            self.assertTrue(0 <= share["low"] <= share["value"] <= share["high"] <= 1, key)

    def test_an_enclosed_goal_is_a_success_when_found_unreachable_only(self):
        rows = rows_of(self.rows("enclosed", "--count", 3, "--discs", 3))
        summary = json.loads(self.campaign("--merge", "rows.csv", "--json"))
        right = sum(row["outcome"] == "unreachable" for row in rows)
        self.assertAlmostEqual(summary["success"]["value"], right / 3, places=5)
        self.assertEqual((summary["no_way"], summary["false_unreachable"]["value"]), (3, 0))


    def test_what_a_robot_believes_and_where_it_is_are_told_apart(self):
        rows = rows_of(self.rows(*KIND, "--count", COUNT, "--noise"))
        summary = json.loads(self.campaign("--merge", "rows.csv", "--json"))
        there = [row for row in rows if row["outcome"] == "reached"]
        off = [row for row in rows if row["outcome"] == "off_goal"]
        self.assertTrue(there and off, [row["outcome"] for row in rows])
        for row in rows:
            self.assertEqual(row["truly_there"], str(int(row in there)))
            if row in there + off:
                self.assertEqual(row["truly_there"], str(int(float(row["final_distance_m"]) <= 0.1)))
                self.assertLessEqual(float(row["believed_distance_m"]), 0.1)
        for key, some in (("truly_there", there), ("at_goal", there), ("off_goal", off), ("reached", there + off), ("success", there + off)):
            self.assertAlmostEqual(summary[key]["value"], len(some) / COUNT, places=6, msg=key)
        words = self.campaign("--merge", "rows.csv")
        self.assertTrue(words.splitlines()[1].startswith("truly there "), words)
        self.assertRegex(words, rf"\nseed {off[0]['seed']} off_goal \(\d+\.\d\d m off\): whisker campaign ")

    def test_rows_from_before_off_goal_are_merged(self):
        old = HERE.parent / "campaign" / "old_rows.csv"
        summary = json.loads(self.campaign("--merge", old, "--json"))
        self.assertEqual([round(8 * summary[key]["value"]) for key in ("truly_there", "reached", "off_goal", "gave_up")], [2, 7, 5, 1])


class Failures(Driven):
    """The robot is too wide for most doors or has too little time, so that enough runs fail."""

    def replayed(self, line):
        seed, outcome, command = re.fullmatch(r"seed (\d+) (\w+) \([^)]*\): whisker (.+)", line).groups()
        done = whisker.whisker(*shlex.split(command), cwd=self.folder)
        self.assertEqual(done.returncode, STATUS[outcome], done.stderr)
        svg = self.folder / shlex.split(command)[-1]
        self.assertTrue(svg.read_bytes().startswith(b"<svg"))
        (digest,) = re.findall(r"command hash (\w{16})", done.stdout)
        return int(seed), digest

    def check(self, *arguments):
        words = self.campaign(*arguments, "--csv", "rows.csv")
        hashes = {int(row["seed"]): row["hash"] for row in rows_of((self.folder / "rows.csv").read_text())}
        lines = [line for line in words.splitlines() if line.startswith("seed ")]
        for line in lines[:3]:
            seed, digest = self.replayed(line)
            self.assertEqual(digest, hashes[seed], line)
        return words, lines

    def test_are_replayed_by_the_command_given(self):
        self.file("my robot.toml", "body_radius_m = 0.25\n")
        _, lines = self.check("rooms", "--count", 3, "--discs", 0, "--noise", "--seed", 4, "--robot", "my robot.toml")
        self.assertGreater(len(lines), 0)

    def test_of_scenario_files_too_and_are_counted_in_the_end(self):
        worlds = self.folder / "my worlds"
        worlds.mkdir()
        (worlds / "late.toml").write_text(with_time_limit((SCENARIOS / "two_discs_and_a_wall.toml").read_text(), 1))
        words, lines = self.check("my worlds", "--seed", 7, "--count", 23)
        self.assertEqual(len(lines), 20)
        self.assertIn("\nand 3 more that failed\n", words)


class Folders(Driven):
    def setUp(self):
        super().setUp()
        (self.folder / "worlds").mkdir()
        for name in ("nothing", "all_noise"):
            text = with_time_limit((SCENARIOS / f"{name}.toml").read_text(), 10)
            (self.folder / "worlds" / f"{name}.toml").write_text(text)

    def test_every_file_is_driven_once_with_its_own_seed(self):
        rows = rows_of(self.rows("worlds"))
        self.assertEqual([(row["world"], row["seed"]) for row in rows], [("worlds/all_noise.toml", "5"), ("worlds/nothing.toml", "1")])
        for row in rows:
            result = json.loads(whisker.whisker("run", self.folder / row["world"], "--json").stdout)
            self.assertEqual(row["hash"], result["hash"])

    def test_with_a_seed_each_mission_has_its_own(self):
        rows = rows_of(self.rows("worlds", "--seed", 30, "--count", 5))
        self.assertEqual([row["seed"] for row in rows], ["30", "31", "32", "33", "34"])
        noisy = [row for row in rows if "noise" in row["world"]]
        self.assertEqual(len({row["hash"] for row in noisy}), 3)
        result = whisker.whisker("run", self.folder / "worlds/all_noise.toml", "--seed", 32, "--json").stdout
        self.assertEqual(noisy[1]["hash"], json.loads(result)["hash"])

    def test_what_does_not_fit_is_refused(self):
        self.refused("campaign", "worlds", "--count", 3, says="--seed")
        self.refused("campaign", "worlds", "--noise", says="--noise")
        self.refused("campaign", "worlds", "--wheel-scale-sigma", "0.01", says="--wheel-scale-sigma")
        self.refused("campaign", "worlds", "--replay", 3, says="whisker run")
        self.refused("campaign", "worlds", "--robots", "random", says="--robots")
        self.refused("campaign", "elsewhere", says="elsewhere")
        (self.folder / "worlds" / "wrong.toml").write_text("name = 1\n")
        self.refused("campaign", "worlds", "--csv", "rows.csv", says="worlds/wrong.toml:1:")
        (self.folder / "empty").mkdir()
        self.refused("campaign", "empty", says="no scenario files")


class ToSize(Driven):
    def test_the_worlds_are_scaled_to_the_robot(self):
        self.file("twice.toml", "body_radius_m = 0.18\nwheel_track_m = 0.28\n")
        self.file("half.toml", "body_radius_m = 0.045\nwheel_track_m = 0.07\nrange_cone_deg = 30\n")
        plain = rows_of(self.rows("discs", "--discs", 3, "--count", 2))
        for robot, size in (("twice.toml", 2), ("half.toml", 0.5)):
            rows = rows_of(self.rows("discs", "--discs", 3, "--count", 2, "--robot", robot, "--to-size"))
            self.assertEqual({row["world"] for row in rows}, {"discs --discs 3 --to-size"})
            for row, reference in zip(rows, plain):
                self.assertEqual(row["outcome"], "reached")
                self.assertAlmostEqual(float(row["shortest_m"]), size * float(reference["shortest_m"]), delta=0.01 * size)
            again = whisker.whisker("campaign", "discs", "--discs", 3, "--to-size", "--robot", robot, "--replay", 2, "--json", cwd=self.folder)
            self.assertEqual(json.loads(again.stdout)["hash"], rows[1]["hash"])

    def test_needs_the_file_of_a_robot_and_generated_worlds(self):
        self.refused("campaign", "discs", "--to-size", says="--to-size needs --robot")
        self.file("mine.toml", "")
        (self.folder / "worlds").mkdir()
        self.refused("campaign", "worlds", "--to-size", "--robot", "mine.toml", says="--to-size is for generated worlds")


class RandomRobots(Driven):
    RANDOM = ("discs", "--discs", 5, "--robots", "random", "--seed", 2)

    def test_are_the_same_however_they_are_driven(self):
        whole = self.rows(*self.RANDOM, "--count", 4)
        self.assertEqual(self.rows(*self.RANDOM, "--count", 4, "--jobs", 3), whole)
        parts = []
        for i in (1, 2):
            parts.append(f"{i}.csv")
            self.campaign(*self.RANDOM, "--count", 4, "--shard", f"{i}/2", "--csv", parts[-1])
        self.assertEqual({row["world"] for row in rows_of(whole)}, {"discs --discs 5 --robots random"})
        summary = json.loads(self.campaign("--merge", *parts, "--json"))
        self.assertEqual((summary["missions"], summary["robots"]), (4, "random"))
        direct = json.loads(self.campaign(*self.RANDOM, "--count", 4, "--json"))
        self.assertEqual(summary["refused_draws"], direct["refused_draws"])
        self.assertEqual(direct["robot_name"], "random")
        again = json.loads(whisker.whisker("campaign", *self.RANDOM[:5], "--replay", 3, "--json").stdout)
        self.assertEqual(again["hash"], rows_of(whole)[1]["hash"])
        self.assertEqual([row["robot"] for row in rows_of(whole)], [f"random {seed}" for seed in (2, 3, 4, 5)])
        self.assertEqual(again["robot_name"], "random 3")

    def test_are_saved_with_the_failed_missions(self):
        (self.folder / "failed").mkdir()
        # An unknown scale of the wheels leads every robot past its goal.
        noisy = (*self.RANDOM[:5], "--seed", 2, "--count", 3, "--noise", "--wheel-scale-sigma", "0.3")
        rows = rows_of(self.rows(*noisy, "--save-failures", "failed"))
        failed = {f"discs-{row['seed']}.toml": row["hash"] for row in rows if row["outcome"] != "reached"}
        self.assertTrue(failed)
        self.assertEqual({file.name for file in (self.folder / "failed").iterdir()}, set(failed))
        for name, mission in failed.items():
            result = json.loads(whisker.whisker("run", self.folder / "failed" / name, "--json").stdout)
            self.assertEqual(result["hash"], mission)


class Refusals(Driven):
    def test_a_command_line_that_means_nothing(self):
        self.refused("campaign", says="KIND|DIR")
        self.refused("campaign", "cubes", says="cubes")
        self.refused("campaign", "discs", "--count", 0, says="--count")
        self.refused("campaign", "discs", "--count", "1e3", says="--count")
        self.refused("campaign", "discs", "--seed", 2**63 - 1, "--count", 2, says="--seed")
        self.refused("campaign", "maze", "--box", says="maze")
        self.refused("campaign", "maze", "--wheel-scale-sigma", "0.01", says="needs noise")
        self.refused("campaign", "discs", "--robots", "any", says="--robots any: not random")
        self.refused("campaign", "discs", "--robots", "random", "--robot", "a.toml", says="--robot")
        self.refused("campaign", "discs", "--save-failures", "nowhere", says="nowhere")
        self.refused("campaign", "discs", "--svg", "a.svg", says="--replay")
        self.refused("campaign", "discs", "--replay", 3, "--csv", "a.csv", says="--csv")
        self.refused("campaign", "discs", "--csv", "nowhere/a.csv", says="nowhere")
        self.file("old.csv", "old\n")
        self.refused("campaign", "discs", "--csv", "old.csv", says="old.csv: is there already; --overwrite replaces it")
        self.refused("campaign", "discs", "--robot", "none.toml", "--csv", "a.csv", says="none.toml:1:1")
        for shard in ("0/3", "4/3", "1", "1/", "/2", "1/0", "-1/2", "1/2/3", "a/b", "1 /2", "2/2000000"):
            self.refused("campaign", "discs", "--shard", shard, says="--shard")
        self.refused("campaign", "discs", "--count", 2, "--shard", "1/3", says="empty")

    def test_a_full_disk_is_a_failure(self):
        done = whisker.whisker("campaign", *KIND, "--count", 2, "--csv", "/dev/full")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertRegex(done.stderr, r"\Awhisker: cannot write /dev/full: No space left[^\n]*\n\Z")


class Interruption(Driven):
    """The campaign is far too long to end by itself."""

    def begun(self, stderr=subprocess.PIPE, count=10**6):
        arguments = ("campaign", *KIND, "--count", count, "--csv", "rows.csv", "--overwrite")
        return subprocess.Popen(
            [whisker.binary, *map(str, arguments)],
            stdout=subprocess.PIPE, stderr=stderr, text=True, cwd=self.folder,
        )  # fmt: skip

    def wait_for_rows(self, process, count):
        part = self.folder / "rows.csv.part"
        end = time.monotonic() + 60
        while time.monotonic() < end:
            if part.exists() and part.read_text().count("\n") > count:
                return
            self.assertIsNone(process.poll(), "it has ended by itself")
            time.sleep(0.02)
        self.fail("no rows in a minute")

    def test_leaves_the_rows_so_far_and_their_summary(self):
        self.file("rows.csv", "old\n")
        before = 0
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with self.begun() as process:
                self.wait_for_rows(process, before + 3)
                process.send_signal(number)
                process.send_signal(number)
                words, error = process.communicate(timeout=60)
            self.assertEqual(process.returncode, 130)
            *goes_on, last = error.splitlines()
            self.assertEqual(goes_on, [f"whisker: goes on after the {before} missions of rows.csv.part"] if before else [])
            self.assertRegex(last, r"\Awhisker: interrupted after \d+ of 1000000 missions; the same command goes on\Z")
            self.assertEqual((self.folder / "rows.csv").read_text(), "old\n")
            text = (self.folder / "rows.csv.part").read_text()
            seeds = [int(row["seed"]) for row in rows_of(text)]
            self.assertEqual(seeds, list(range(1, len(seeds) + 1)))
            self.assertGreaterEqual(len(seeds), before + 3)
            before = len(seeds)
            self.assertTrue(words.startswith(self.campaign("--merge", "rows.csv.part", "--incomplete")))
            self.assertEqual(sorted(os.listdir(self.folder)), ["rows.csv", "rows.csv.part"])

    def test_goes_on_where_it_was_stopped_or_killed(self):
        whole = self.rows(*KIND, "--count", 9, "--noise")
        arguments = (*KIND, "--count", 9, "--noise", "--csv", "again.csv")
        lines = whole.splitlines(keepends=True)
        for some in ("", lines[0][:30], lines[0], "".join(lines[:2]), "".join(lines[:5]) + lines[5][:40], whole):
            self.file("again.csv.part", some)
            done = whisker.whisker("campaign", *arguments, cwd=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            n = max(some.count("\n") - 1, 0)
            self.assertEqual(done.stderr, f"whisker: goes on after the {n} missions of again.csv.part\n" if n else "")
            self.assertEqual((self.folder / "again.csv").read_text(), whole)
            self.assertEqual(done.stdout, self.campaign("--merge", "rows.csv") + "rows: again.csv\n")
            self.assertFalse((self.folder / "again.csv.part").exists())
            (self.folder / "again.csv").unlink()
        # Of the third shard, with what --html and --json need of all rows.
        shard = ("--shard", "3/3", "--csv", "3.csv", "--html", "3.html", "--json")
        first = self.campaign(*KIND, "--count", 9, "--noise", *shard)
        rows, page = (self.folder / "3.csv").read_text(), (self.folder / "3.html").read_text()
        (self.folder / "3.csv").rename(self.folder / "3.csv.part")
        done = whisker.whisker("campaign", *KIND, "--count", 9, "--noise", *shard, cwd=self.folder)
        self.assertEqual((done.returncode, done.stdout), (0, first))
        self.assertEqual(((self.folder / "3.csv").read_text(), (self.folder / "3.html").read_text()), (rows, page))

    def test_no_rows_of_another_campaign_are_continued_or_lost(self):
        whole = self.rows(*KIND, "--count", 3)
        (self.folder / "rows.csv").rename(self.folder / "rows.csv.part")
        self.file("slow.toml", "wheel_speed_max_mps = 0.1\n")
        for other in (("--planner", "skirt"), ("--seed", 2), ("--robot", "slow.toml"), ("--noise",), ("--box",)):
            self.refused("campaign", *KIND, "--count", 3, *other, "--csv", "rows.csv", says="rows.csv.part:4:1: this command drives that mission otherwise: name another file, or remove this one")
        self.refused("campaign", *KIND, "--count", 4, "--csv", "rows.csv", says="rows.csv.part:4:1: mission 3 of 3 of another campaign")
        self.refused("campaign", *KIND, "--count", 3, "--shard", "2/3", "--csv", "rows.csv", says="rows.csv.part:4:1: mission 3 of 3 of another campaign")
        for text, place in (("precious", 1), (whole.replace("mission,missions", "mission"), 1), (whole.replace("reached", "bored", 1), 2), (whole.partition("\n")[0] + "\n\n", 2)):
            self.file("rows.csv.part", text)
            self.refused("campaign", *KIND, "--count", 3, "--csv", "rows.csv", says=f"rows.csv.part:{place}:1: ")
        (self.folder / "rows.csv.part").unlink()
        self.file("target", "precious\n")
        (self.folder / "rows.csv.part").symlink_to("target")
        self.refused("campaign", *KIND, "--count", 3, "--csv", "rows.csv", status=1, says="rows.csv.part: is a symbolic link")
        (self.folder / "rows.csv.part").unlink()
        (self.folder / "rows.csv.part").hardlink_to(self.folder / "target")
        self.refused("campaign", *KIND, "--count", 3, "--csv", "rows.csv", status=1, says="rows.csv.part is no file of its own")

    def test_a_disk_that_fills_keeps_the_rows(self):
        whole = self.rows(*KIND, "--count", 9)
        lines = whole.splitlines(keepends=True)
        limit = len("".join(lines[:5])) + 10
        done = whisker.whisker("campaign", *KIND, "--count", 9, "--csv", "full.csv", cwd=self.folder, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertEqual(done.stderr, "whisker: cannot write full.csv: File too large; full.csv.part keeps what there is\n")
        self.assertEqual((self.folder / "full.csv.part").read_text(), "".join(lines[:5]))
        done = whisker.whisker("campaign", *KIND, "--count", 9, "--csv", "full.csv", cwd=self.folder)
        self.assertEqual((self.folder / "full.csv").read_text(), whole)

    def test_a_terminal_sees_a_progress_bar_that_is_wiped_in_the_end(self):
        terminal, theirs = pty.openpty()
        seen, end = b"", time.monotonic() + 60
        with self.begun(theirs) as process:
            while time.monotonic() < end and not PROGRESS.search(seen):
                if select.select([terminal], [], [], 0.1)[0]:
                    seen += os.read(terminal, 4096)
            process.send_signal(signal.SIGINT)
            process.wait()
            while select.select([terminal], [], [], 0)[0]:
                seen += os.read(terminal, 4096)
            process.stdout.read()
        os.close(terminal)
        os.close(theirs)
        self.assertRegex(seen, PROGRESS)
        self.assertRegex(seen, rb"to go\r\x1b\[Kwhisker: interrupted after \d+ of 1000000 missions; the same command goes on\r\n\Z")

    def test_two_campaigns_do_not_share_a_file(self):
        with self.begun() as process:
            self.wait_for_rows(process, 2)
            done = whisker.whisker("campaign", *KIND, "--count", 2, "--csv", "rows.csv", cwd=self.folder)
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertRegex(done.stderr, r"\Awhisker: cannot write rows.csv: another process is writing \S*rows.csv.part\n\Z")
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=60)
        seeds = [int(row["seed"]) for row in rows_of((self.folder / "rows.csv.part").read_text())]
        self.assertEqual(seeds, list(range(1, len(seeds) + 1)), "nothing lost, nothing mixed")

    def test_a_killed_campaign_leaves_whole_rows_beside_the_file(self):
        whole = self.rows(*KIND, "--count", 60)
        with self.begun(count=60) as process:
            self.wait_for_rows(process, 2)
            process.kill()
        self.assertEqual((self.folder / "rows.csv").read_text(), whole)
        self.campaign("--merge", "rows.csv.part", "--incomplete")
        done = whisker.whisker("campaign", *KIND, "--count", 60, "--csv", "rows.csv", "--overwrite", cwd=self.folder)
        self.assertEqual((done.returncode, (self.folder / "rows.csv").read_text()), (0, whole))


if __name__ == "__main__":
    whisker.main()
