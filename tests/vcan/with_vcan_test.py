"""scripts/with-vcan. usage: with_vcan_test.py ROOT Bus|Usage|Alone"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(sys.argv.pop(1)) / "scripts" / "with-vcan"


def run(*arguments):
    done = subprocess.run([SCRIPT, *map(str, arguments)], capture_output=True, text=True, timeout=110, check=False)
    return done.returncode, done.stdout, done.stderr


# Its first argument is the path of with-vcan: the inner bus is a separate one.
PROGRAM = r"""
ip -br link | sed -n 's/^\(vcan[0-9]*\) .*UP.*/\1/p'
candump -L -n 1 vcan2 &
until grep -q "vcan2 .* raw" /proc/net/can/rcvlist_all; do sleep 0.1; done
"$1" cansend vcan0 111#
cansend vcan2 123#AA
wait
echo "$2|$3|" >&2
exit 7
"""


class Bus(unittest.TestCase):
    """Runs under scripts/with-vcan and makes a second bus. Few runs, because each takes seconds."""

    def test_makes_private_interfaces_and_passes_arguments_output_and_status(self):
        status, out, err = run("--which", "--count", 3, "bash", "-c", PROGRAM, "bash", SCRIPT, "a  b", "*")
        self.assertEqual(status, 7, err)
        self.assertRegex(out, r"\Avcan0\nvcan1\nvcan2\n\(\S+\) vcan2 123#AA\n\Z")
        self.assertRegex(err, r"\Awith-vcan: (user-namespace|network-namespace)\na  b\|\*\|\n\Z")

    def test_ends_a_command_that_does_not_end(self):
        self.assertEqual(run("--timeout", 1, "sleep", 50)[0], 124)


class Usage(unittest.TestCase):
    """Runs anywhere."""

    def test_refuses_what_it_does_not_know(self):
        for wrong in ((), ("--count",), ("--count", 0, "true"), ("--count", 17, "true"), ("--timeout", "x", "true"), ("--tty", "/dev/null", "true"), ("--nonsense", "true")):
            status, out, err = run(*wrong)
            self.assertEqual((status, out), (2, ""), wrong)
            self.assertRegex(err, r"\Awith-vcan: [^\n]*\n\Z", wrong)


class Alone(unittest.TestCase):
    """The one file for others. Runs anywhere."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.file = self.folder / "with-vcan"
        self.assertEqual(run("--alone", self.file), (0, "", ""))

    def run_alone(self, *arguments):
        environment = {**os.environ, "XDG_CACHE_HOME": str(self.folder / "cache")}
        return subprocess.run([self.file, *arguments], cwd=self.folder, env=environment, capture_output=True, text=True, timeout=110, check=False)

    def test_needs_nothing_of_the_repository(self):
        helped = self.run_alone("--help")
        self.assertEqual(helped.returncode, 0, helped.stderr)
        self.assertIn("with-vcan [OPTION...] COMMAND", helped.stdout)
        self.assertEqual(self.run_alone("--count", "0", "true").returncode, 2)
        (unpacked,) = (self.folder / "cache/with-vcan").iterdir()
        self.assertEqual((unpacked / "with-vcan").read_bytes(), SCRIPT.read_bytes())
        for path in (SCRIPT.parent / "vm").iterdir():
            if path.is_file():
                self.assertEqual((unpacked / "vm" / path.name).read_bytes(), path.read_bytes(), path)


if __name__ == "__main__":
    unittest.main()
