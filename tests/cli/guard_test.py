"""whisker guard and whisker operators from outside."""

import contextlib
import csv
import fcntl
import json
import os
import pathlib
import pty
import re
import select
import signal
import subprocess
import tempfile
import termios
import unittest

import whisker

STRAIGHT = pathlib.Path(__file__).parents[2] / "host/lab/rules/laws/straight.toml"
HEADER = "t_s,v_mps,omega_radps"


def own(terminal):
    """The process that calls it gets this as the terminal of its own session, and the signals of a shell's job."""
    os.setsid()
    for number in (signal.SIGINT, signal.SIGQUIT, signal.SIGHUP, signal.SIGTERM, signal.SIGTSTP):
        signal.signal(number, signal.SIG_DFL)
    fcntl.ioctl(terminal, termios.TIOCSCTTY, 0)


def until(terminal, enough):
    """What is read from it, from now on, until it is enough; all of a minute."""
    said = b""
    while not enough(said):
        assert select.select([terminal], [], [], 60)[0], said
        said += os.read(terminal, 4096)
    return said


def drain(terminal):
    while select.select([terminal], [], [], 0)[0]:
        os.read(terminal, 4096)


@contextlib.contextmanager
def ended(process):
    """A test that fails does not wait for its process."""
    try:
        yield
    finally:
        process.kill()


class Guard(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.world = str(pathlib.Path(cls.folder.name, "world.toml"))
        assert whisker.whisker("world", "discs", "--seed", "1", "--out", cls.world).returncode == 0

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def commands(self, *rows):
        file = pathlib.Path(self.folder.name, "commands.csv")
        file.write_text("\n".join([HEADER, *rows]) + "\n")
        return str(file)

    def test_a_perfect_operator_arrives(self):
        trace = str(pathlib.Path(self.folder.name, "perfect.csv"))
        done = whisker.whisker("guard", self.world, "--trace", trace)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("arrived", done.stdout)
        with open(trace, newline="") as rows:
            self.assertIn("2.0000", {row["front_m"] for row in csv.DictReader(rows)})  # clear: the maximum range

    def test_a_blind_operator_touches_without_the_guard_only(self):
        self.assertEqual(whisker.whisker("guard", self.world, "--operator", "blind", "--bare").returncode, 5)
        self.assertEqual(whisker.whisker("guard", self.world, "--operator", "blind").returncode, 4)

    def test_commands_of_a_file_time_out_and_the_trace_says_so(self):
        trace = str(pathlib.Path(self.folder.name, "trace.csv"))
        file = self.commands("0.1,0.2,0", "0.3,0.2,0.5")
        done = whisker.whisker("guard", self.world, "--commands", file, "--time", "2", "--vouch", "0.35", "--trace", trace)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("ended after 1.0", done.stdout)
        with open(trace, newline="") as rows:
            reasons = {round(float(r["t_s"]), 2): r["why"] for r in csv.DictReader(rows)}
        self.assertEqual(reasons[0.05], "command_timeout")
        self.assertEqual(reasons[0.55], reasons[0.2])
        self.assertEqual(reasons[0.56], "command_timeout")
        again = whisker.whisker("guard", self.world, "--commands", file, "--time", "2", "--vouch", "0.35")
        self.assertEqual(done.stderr + done.stdout, again.stderr + again.stdout)

    def test_json_is_the_result_and_the_trace_has_every_tick(self):
        trace = str(pathlib.Path(self.folder.name, "json.csv"))
        file = self.commands("0.1,0.2,0", "0.3,0.2,0.5")
        done = whisker.whisker("guard", self.world, "--commands", file, "--vouch", "0.35", "--trace", trace, "--json")
        told = json.loads(done.stdout)
        self.assertEqual((done.returncode, done.stderr, told["outcome"]), (0, "", "ended"))
        self.assertEqual(sum(told["ticks_by_reason"].values()), told["ticks"])
        with open(trace, newline="") as text:
            rows = list(csv.DictReader(text))
        self.assertEqual(len(rows), told["ticks"])
        self.assertEqual(
            list(rows[0])[:11],
            ["t_s", "x_m", "y_m", "heading_rad", "left_m", "front_m", "right_m", "v_left_mps", "v_right_mps", "state", "why"],
        )
        self.assertLess(abs(float(rows[-1]["v_left_mps"])), 0.001)
        blind = whisker.whisker("guard", self.world, "--operator", "blind", "--bare", "--json")
        self.assertEqual((blind.returncode, json.loads(blind.stdout)["outcome"]), (5, "contact"))

    def test_html_is_the_drive_as_a_page_and_changes_nothing(self):
        html = pathlib.Path(self.folder.name, "page.html")
        file = self.commands("0.1,0.2,0", "0.3,0.2,0.5")
        command = ("guard", self.world, "--commands", file, "--vouch", "0.35", "--json")
        done = whisker.whisker(*command, "--html", html)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout, whisker.whisker(*command).stdout)
        page = html.read_text(encoding="ascii")
        run = json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.S)[1])["runs"][0]
        told = json.loads(done.stdout)
        self.assertEqual(run["result"], {key: told[key] for key in run["result"]})
        self.assertEqual(run["guard"]["operator"], f"commands of {file}")
        self.assertEqual((run["guard"]["guarded"], run["guard"]["vouched_m"]), (True, 0.35))
        self.assertEqual(list(told["ticks_by_reason"]), run["guard"]["reasons"])
        columns = {column[0]: column[3] for column in run["columns"]}
        for name in ("t_s", "asked_v_mps", "asked_omega_radps", "granted_v", "granted_omega", "reason"):
            self.assertEqual(columns[name], told["ticks"], name)
        self.assertEqual(re.findall(r"""(?:src|href)\s*=\s*["'](?!#|data:)[^"']*""", page), [])
        bare = whisker.whisker("guard", self.world, "--operator", "blind", "--bare", "--html", html)
        self.assertIn(f"page: {html}\n", bare.stdout)
        self.assertIn('"guarded":false', html.read_text(encoding="ascii"))

    def test_html_is_refused_before_any_drive_where_it_cannot_go(self):
        for html, says in ((self.folder.name, "is a folder"), (f"{self.folder.name}/no/p.html", "no such folder")):
            done = whisker.whisker("guard", self.world, "--html", html)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn(says, done.stderr)
        both = f"{self.folder.name}/both"
        done = whisker.whisker("guard", self.world, "--html", both, "--trace", both)
        self.assertEqual(done.returncode, 2)
        self.assertIn("named for two outputs", done.stderr)
        self.assertFalse(pathlib.Path(both).exists())

    def test_refuses_bad_commands_with_their_line(self):
        for row, says in (("1,2", "2 fields; the header has 3"), ("-1,0,0", "must not be negative"), ("1,2,3,4", "4 fields"), ("nan,0,0", "'nan' is no number")):
            file = self.commands("0,0,0", row)
            done = whisker.whisker("guard", self.world, "--commands", file)
            self.assertEqual(done.returncode, 2)
            self.assertTrue(done.stderr.startswith(f"{file}:3:1: "), done.stderr)
            self.assertIn(says, done.stderr)
        self.assertEqual(whisker.whisker("guard", self.world, "--commands", "none.csv").returncode, 2)

    def test_keys_leave_the_terminal_as_it_was_however_they_end(self):
        """Ctrl-Z gives it back until fg; a signal ends the drive as q does, with its page and trace."""
        for how, status in ((b"q", 0), (b"\x03", 130), (signal.SIGTERM, 130), (signal.SIGHUP, 130), (b"\x1c", 131)):
            with self.subTest(how), tempfile.TemporaryDirectory() as folder:
                page, trace = pathlib.Path(folder, "k.html"), pathlib.Path(folder, "k.csv")
                ours, theirs = pty.openpty()
                before = termios.tcgetattr(theirs)
                command = [whisker.binary, "guard", self.world, "--keys", "--html", str(page), "--trace", str(trace)]
                with subprocess.Popen(command, stdin=theirs, stdout=theirs, stderr=theirs, preexec_fn=lambda theirs=theirs: own(theirs)) as process, ended(process):
                    said = until(ours, lambda said: b"asked" in said)
                    self.assertFalse(termios.tcgetattr(theirs)[3] & termios.ECHO)
                    os.write(ours, b"\x1a")
                    self.assertTrue(os.WIFSTOPPED(os.waitpid(process.pid, os.WUNTRACED)[1]))
                    self.assertEqual(termios.tcgetattr(theirs), before)
                    drain(ours)
                    process.send_signal(signal.SIGCONT)
                    until(ours, lambda said: b"asked" in said)
                    self.assertFalse(termios.tcgetattr(theirs)[3] & termios.ECHO)
                    os.write(ours, how) if isinstance(how, bytes) else process.send_signal(how)
                    process.wait(60)
                    self.assertEqual((process.returncode, termios.tcgetattr(theirs)), (status, before))
                    if status == 131:
                        continue
                    said = until(ours, lambda said: b"page: " in said and (status == 0 or b"interrupted" in said))
                    self.assertIn(b"ended after", said)
                    if status == 130:
                        self.assertRegex(said, rb"whisker: interrupted after \d+\.\d\d s\r\n")
                    self.assertIn("</html>", page.read_text())
                    self.assertGreater(trace.read_text().count("\n"), 1)

    def test_keys_need_a_terminal(self):
        done = whisker.whisker("guard", self.world, "--keys")
        self.assertEqual(done.returncode, 2)
        self.assertIn("no terminal", done.stderr)

    def test_operators_prints_a_row_for_each(self):
        done = whisker.whisker("operators", "--count", "1")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.count("\n"), 2 + 5 * 2 * 5)
        command = ("operators", "--count", "1", "--operator", "sloppy")
        own, other = (whisker.whisker(*command, *rules).stdout.splitlines()[2:] for rules in ((), ("--rules", STRAIGHT)))
        self.assertTrue(all(row.startswith("| sloppy |") for row in own))
        changed = [i for i, rows in enumerate(zip(own, other, strict=True)) if rows[0] != rows[1]]
        self.assertEqual(changed, [4, 9])  # only the assist has a table
        hostile = whisker.whisker("operators", "--hostile", "5", "--noise")
        self.assertIn("5 hostile drives of 20 s with noise, seeds from 1: 0 contacts", hostile.stdout)


if __name__ == "__main__":
    whisker.main()
