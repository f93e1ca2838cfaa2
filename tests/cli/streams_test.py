"""The use of standard output, the provenance in JSON objects, and the suggestions after a misspelling."""

import json
import pathlib
import re
import resource
import signal
import subprocess

import whisker
from whisker import ORIGIN, SCENARIOS, Case

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
NOTHING = SCENARIOS / "nothing.toml"


def run(*arguments, **options):
    return whisker.whisker(*arguments, **options)


class StandardOutput(Case):
    def test_takes_each_output_alone(self):
        """Standard output gets the same bytes as a file; messages go to standard error."""
        for option in ("--trace", "--svg", "--html"):
            path = self.folder / "file"
            run("run", NOTHING, option, path)
            done = run("run", NOTHING, option, "-", cwd=self.folder)
            self.assertEqual(done.stdout, path.read_text(), option)
            self.assertRegex(done.stderr, r"\Areached in ")
        path = self.folder / "rows.csv"
        run("campaign", "discs", "--count", 2, "--csv", path)
        done = run("campaign", "discs", "--count", 2, "--csv", "-", cwd=self.folder)
        self.assertEqual([line.split(",")[:6] for line in done.stdout.splitlines()], [line.split(",")[:6] for line in path.read_text().splitlines()])
        self.assertIn("2 missions", done.stderr)
        self.assertEqual(run("world", "discs", "--seed", 1, "--out", "-").stdout, run("world", "discs", "--seed", 1).stdout)
        self.assertTrue(run("table", "--svg", "-").stdout.startswith("<svg"))
        log = run("hil", NOTHING, "--record", "-").stdout
        self.assertRegex(log, r"\A\(\d+\.\d+\) private [0-9A-F]+#")
        self.file("hil.log", log)
        done = run("replay", self.folder / "hil.log", "--trace", "-")
        self.assertTrue(done.stdout.startswith("t_s,x_m,"))
        self.assertIn("the core gives the recorded commands", done.stderr)
        self.assertIn("constexpr whisker::Params my_robot()", run("robot", "check", self.file("r.toml", ""), "--header", "-").stdout)
        self.assertFalse((self.folder / "-").exists())

    def test_takes_one_output_only(self):
        self.file("r.toml", "")
        self.file("hil.log", "")
        for arguments in (
            ("run", NOTHING, "--trace", "-", "--svg", "-"),
            ("run", NOTHING, "--trace", "-", "--json"),
            ("hil", NOTHING, "--record", "-", "--json"),
            ("hil", NOTHING, "--record", "-", "--trace", "-"),
            ("campaign", "discs", "--csv", "-", "--json"),
            ("table", "--svg", "-", "--csv"),
            ("replay", "hil.log", "--trace", "-", "--json"),
            ("robot", "check", "r.toml", "--header", "-", "--json"),
        ):
            self.refused(*arguments, says="-: standard output")


class Interruption(Case):
    """Every command that may take long says that it was interrupted, and replaces no complete file by less."""

    def setUp(self):
        super().setUp()
        self.file("world.toml", run("world", "rooms", "--seed", 5).stdout)
        self.file("robot.toml", "gyro = true\n")

    def interrupted(self, number, arguments):
        with subprocess.Popen([whisker.binary, *map(str, arguments)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=self.folder) as process:
            status = f"/proc/{process.pid}/status"
            # Those that keep what they have note also SIGHUP while they work.
            noted = number if arguments[0] in ("run", "guard", "socket") else signal.SIGHUP
            while not int(re.search(r"SigCgt:\s+(\w+)", pathlib.Path(status).read_text())[1], 16) >> (noted - 1) & 1:
                self.assertIsNone(process.poll())
            process.send_signal(number)
            out, error = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 130, (arguments, error))
        self.assertRegex(error.splitlines()[-1], r"\Awhisker: interrupted", arguments)
        return out

    def test_is_said_and_destroys_nothing(self):
        many = 100000
        for arguments, output in (
            (("run", "world.toml", "--planner", "thesis"), "--trace"),
            (("guard", "world.toml", "--time", 3600, "--operator", "hostile"), "--html"),
            (("hil", "world.toml", "--realtime"), "--record"),
            (("hil", "world.toml", "--realtime"), "--trace"),
            (("campaign", "rooms", "--count", many), "--html"),
            (("scanner", "rooms", "--count", many), None),
            (("movers", "--count", many), None),
            (("operators", "--count", many), None),
            (("operators", "--hostile", many), None),
            (("rules", "compare", "default", "default", "--worlds", "rooms", "--count", many), None),
            (("robot", "layout", "--sensor", "vl53l1x", "--count", 1000), "--out"),
            (("robot", "calibrate", "robot.toml", "--count", many), None),
            (("robot", "calibrate-drive", "robot.toml", "--count", many), None),
            (("socket", "--stdio"), None),
        ):
            for number in (signal.SIGINT, signal.SIGTERM):
                with self.subTest(arguments, signal=number):
                    self.file("old", "complete\n")
                    self.interrupted(number, (*arguments, output, "old") if output else arguments)
                    self.assertEqual((self.folder / "old").read_text(), "complete\n")
                    (self.folder / "old.part").unlink(missing_ok=True)
                    self.assertEqual({*self.contents()}, {"old", "robot.toml", "world.toml"})

    def test_of_hil_keeps_the_frames_so_far(self):
        self.file("old.log", "complete\n")
        for log, kept in (("new.log", "new.log"), ("old.log", "old.log.part")):
            with subprocess.Popen([whisker.binary, "hil", "world.toml", "--realtime", "--record", log], stderr=subprocess.PIPE, text=True, cwd=self.folder) as process:
                while not (self.folder / kept).exists() or (self.folder / kept).read_text().count("\n") < 50:
                    self.assertIsNone(process.poll())
                process.send_signal(signal.SIGINT)
                self.assertIn(f"whisker: interrupted; the frames are in {kept}\n", process.communicate(timeout=60)[1])
            self.assertEqual(process.returncode, 130)
            self.assertGreaterEqual((self.folder / kept).read_text().count("\n"), 50)
        self.assertEqual((self.folder / "old.log").read_text(), "complete\n")
        before = self.contents()
        done = run("hil", "world.toml", "--record", "old.log", cwd=self.folder)
        self.assertEqual((done.returncode, self.contents()), (1, before))
        self.assertEqual(done.stderr.splitlines()[-1], "whisker: cannot write old.log: old.log.part is there, of a run that did not end: rename or remove it")

    def test_a_log_that_no_longer_fits_is_said_at_the_end_and_kept(self):
        limit = 20000
        done = run("hil", NOTHING, "--record", "full.log", cwd=self.folder, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.splitlines()[-1], "whisker: cannot write full.log: File too large; full.log keeps what there is")
        log = (self.folder / "full.log").read_text()
        self.assertTrue(limit - 100 < len(log) <= limit and log.endswith("\n"))


class Origin(Case):
    def told(self, *arguments):
        done = run(*arguments, "--json")
        told = json.loads(done.stdout)
        self.assertEqual(tuple(told)[-len(ORIGIN) :], ORIGIN, arguments)
        self.assertEqual((told["schema"], "whisker " + told["version"]), (1, run("--version").stdout.strip()))
        return [told[key] for key in ORIGIN[2:]]

    def test_is_in_every_object(self):
        reference = self.told("run", NOTHING)
        self.assertEqual(reference[:3], [1, "map", "reference"])
        self.assertRegex(reference[3], r"\A[0-9a-f]{16}\Z")
        self.assertRegex(reference[4], r"\A[0-9a-f]{8}\Z")
        self.assertEqual(self.told("run", NOTHING, "--seed", 7, "--planner", "map", "--map-bytes", 1024), [7, "map-1024", *reference[2:]])
        self.assertEqual(self.told("hil", NOTHING), reference)
        robot = self.file("slow.toml", "wheel_speed_max_mps = 0.2\n")
        slow = self.told("run", NOTHING, "--robot", robot)
        self.assertEqual(slow[2], str(robot))
        self.assertNotEqual(slow[3], reference[3])
        within = self.file("within.toml", NOTHING.read_text() + "\n[robot]\nwheel_speed_max_mps = 0.2\n")
        self.assertEqual(self.told("run", within), [1, "map", str(within), *slow[3:]])
        self.assertEqual(self.told("campaign", "discs", "--count", 1, "--seed", 5), [5, *reference[1:]])
        self.assertEqual(self.told("campaign", "discs", "--count", 1, "--robot", robot), [1, *slow[1:]])
        self.assertEqual(self.told("campaign", "discs", "--replay", 5), [5, *reference[1:]])
        self.assertEqual(self.told("scanner", "discs", "--count", 1, "--seed", 5), [5, None, None, None, None])
        self.assertEqual(self.told("robot", "check", robot), [None, "map", str(robot), *slow[3:]])
        log = self.folder / "hil.log"
        run("hil", NOTHING, "--record", log)
        self.assertEqual(self.told("replay", log), [None, "map", str(log), *reference[3:]])

    def test_the_version_names_a_commit_of_this_repository(self):
        commit = re.fullmatch(r"whisker \d+\.\d+\.\d+ \(([-.+A-Za-z0-9]+)\)\n", run("--version").stdout)[1]
        if (ROOT / ".git").exists():
            known = ["git", "-C", ROOT, "cat-file", "-e", commit.removesuffix("-dirty") + "^{commit}"]
            self.assertEqual(subprocess.run(known, capture_output=True, check=False).returncode, 0, commit)
        else:
            self.assertEqual(commit, "unknown")

    def test_the_commit_is_asked_again_and_unknown_outside_of_a_repository(self):
        script, out = ROOT / "host/cli/commit.cmake", self.folder / "commit.hpp"

        def commit():
            subprocess.run(["cmake", "-D", f"ROOT={self.folder / 'source'}", "-D", f"OUT={out}", "-P", script], check=True, capture_output=True)
            return re.fullmatch(r'#define WHISKER_COMMIT "(.+)"\n', out.read_text())[1]

        def git(*arguments):
            who = ["-c", "user.name=n", "-c", "user.email=e"]
            return subprocess.run(["git", "-C", self.folder / "source", *who, *arguments], check=True, capture_output=True, text=True).stdout.strip()

        (self.folder / "source").mkdir()
        self.assertEqual(commit(), "unknown")
        git("init", "-q")
        seen = []
        for message in ("one", "two"):
            git("commit", "-q", "--allow-empty", "-m", message)
            seen.append(commit())
            self.assertEqual(seen[-1], git("rev-parse", "--short=12", "HEAD"))
        self.assertNotEqual(*seen)
        before = out.stat().st_mtime_ns
        self.assertEqual((commit(), out.stat().st_mtime_ns), (seen[-1], before), "nothing to compile anew")
        (self.folder / "source/inner").mkdir()
        subprocess.run(["cmake", "-D", f"ROOT={self.folder / 'source/inner'}", "-D", f"OUT={out}", "-P", script], check=True)
        self.assertIn('"unknown"', out.read_text(), "sources unpacked within another repository")


class Slips(Case):
    def test_are_answered_with_what_they_resemble(self):
        for arguments, near in (
            (("rnu",), "run"),
            (("campain",), "campaign"),
            (("robot", "chek"), "check"),
            (("run", NOTHING, "--planner", "skrit"), "skirt"),
            (("run", NOTHING, "--planner", "boundry"), "boundary"),
            (("run", NOTHING, "--planner", "wall-folower"), "wall-follower"),
            (("world", "dics", "--seed", "1"), "discs"),
            (("campaign", "u-trp"), "u-trap"),
        ):
            self.refused(*arguments, says=f"did you mean '{near}'?")
        self.refused("xyzzy", says="no command 'xyzzy' (see")

    def test_numbers_that_are_none_are_refused(self):
        for number in ("nan", "-nan", "inf", "-inf", "-1", "100.1", "1e400", "1e-400x", "", " 1", "0x1"):
            self.refused("hil", NOTHING, f"--drop={number}", says="--drop")
        self.assertEqual(run("hil", NOTHING, "--drop", "0.5", "--json").returncode, 0)


if __name__ == "__main__":
    whisker.main()
