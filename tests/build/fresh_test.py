"""scripts/fresh runs the README's commands, rejects wrong options, and cleans up when it is interrupted.
usage: fresh_test.py ROOT

A stand-in for debootstrap makes a folder and waits, because the real one needs the network and an hour.
"""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(sys.argv[1])
FRESH = ROOT / "scripts/fresh"
STAND_IN = '#!/bin/sh\nfor folder; do case $folder in */debian) mkdir "$folder"; esac; done\nmount -t tmpfs x "$folder"\nsleep 300\n'


def may_unshare():
    return os.getuid() == 0 and subprocess.run(["unshare", "--mount", "--pid", "--fork", "true"], check=False).returncode == 0


class Fresh(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.repository = self.folder / "repository"
        (self.repository / "scripts").mkdir(parents=True)
        (self.repository / "scripts/fresh").write_bytes(FRESH.read_bytes())
        (self.repository / "scripts/fresh").chmod(0o755)
        self.git("init", "-q")

    def git(self, *arguments):
        identity = ("-c", "user.name=t", "-c", "user.email=t@example.org")
        subprocess.run(["git", "-C", self.repository, *identity, *arguments], check=True)

    def commit(self, readme):
        (self.repository / "README.md").write_text(readme)
        self.git("add", ".")
        self.git("commit", "-qm", "readme")

    def fresh(self, *arguments):
        command = [self.repository / "scripts/fresh", *arguments]
        return subprocess.run(command, capture_output=True, text=True, timeout=30, check=False)

    def test_runs_the_first_two_blocks_without_a_language(self):
        self.commit("# A\n```\nmake   # all\nmake test\n```\n```cpp\nint x;\n```\n\n```\na && b\n\n```\nmake no\n```\nserve\n```\n")
        done = self.fresh("--list")
        self.assertEqual((done.returncode, done.stdout), (0, "make   # all\nmake test\na && b\n"), done.stderr)
        self.assertEqual(self.fresh("--list", "--run", "one", "--run", "two").stdout, "one\ntwo\n")

    def test_refuses_with_one_line(self):
        self.commit("# A\n")
        for arguments, status, word in (
            (("--bad",), 2, "no option '--bad'"),
            (("--timeout", "0"), 2, "--timeout"),
            (("--run",), 2, "--run needs an argument"),
            (("--commit", "nowhere"), 2, "no commit 'nowhere'"),
            ((), 125, "no code block"),
        ):
            done = self.fresh(*arguments)
            self.assertEqual(done.returncode, status, arguments)
            self.assertIn(word, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    def test_leaves_nothing_behind_when_it_is_interrupted(self):
        if not may_unshare():
            self.assertNotEqual(self.fresh("--run", "true").returncode, 0)
            return
        self.commit("# A\n```\nmake\n```\n")
        tools, work = self.folder / "tools", self.folder / "work"
        tools.mkdir()
        work.mkdir()
        (tools / "debootstrap").write_text(STAND_IN)
        (tools / "debootstrap").chmod(0o755)
        environment = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}", "TMPDIR": str(work)}
        for number in (signal.SIGINT, signal.SIGTERM):
            # A shell that starts this test in the background makes it ignore SIGINT.
            hears = lambda: signal.signal(signal.SIGINT, signal.SIG_DFL)  # noqa: E731
            command = [self.repository / "scripts/fresh"]
            run = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL, preexec_fn=hears)
            deadline = time.monotonic() + 60
            while not list(work.glob("*/debian")) and time.monotonic() < deadline:
                time.sleep(0.05)
            self.assertTrue(list(work.glob("*/debian")))
            run.send_signal(number)
            self.assertEqual(run.wait(timeout=60), 128 + number)
            self.assertEqual(list(work.iterdir()), [])
            self.assertNotIn(str(work), pathlib.Path("/proc/mounts").read_text())
            running = subprocess.run(["pgrep", "-f", str(work)], capture_output=True, check=False)
            self.assertEqual(running.stdout, b"")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
