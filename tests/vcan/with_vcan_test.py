"""scripts/with-vcan. usage: with_vcan_test.py ROOT Bus|Usage"""

import pathlib
import subprocess
import sys
import unittest

SCRIPT = pathlib.Path(sys.argv.pop(1)) / "scripts" / "with-vcan"


def run(*arguments):
    done = subprocess.run([SCRIPT, *map(str, arguments)], capture_output=True, text=True, timeout=60, check=False)
    return done.returncode, done.stdout, done.stderr


class Bus(unittest.TestCase):
    """Under scripts/with-vcan: where its caller made a bus, it can make another."""

    def test_passes_status_and_output_and_arguments(self):
        self.assertEqual(run("sh", "-c", 'echo "$@"; echo err >&2; exit 7', "sh", "a  b", "*"), (7, "a  b *\n", "err\n"))

    def test_makes_as_many_interfaces_as_asked_for(self):
        links = "ip -br link | sed -n 's/^\\(vcan[0-9]*\\) .*UP.*/\\1/p'"
        self.assertEqual(run("--count", 3, "sh", "-c", links)[1].split(), ["vcan0", "vcan1", "vcan2"])

    def test_carries_frames_and_keeps_them_to_itself(self):
        dump = 'candump -L -n 1 vcan0 & sleep 1; "$0" cansend vcan0 111#; cansend vcan0 123#AA; wait'
        status, out, _ = run("sh", "-c", dump, SCRIPT)
        self.assertEqual(status, 0)
        self.assertRegex(out, r"\A\(\S+\) vcan0 123#AA\n\Z")

    def test_says_which_way_and_ends_a_command_that_does_not_end(self):
        status, out, err = run("--which", "--timeout", 1, "sleep", 50)
        self.assertEqual((status, out), (124, ""))
        self.assertRegex(err, r"\Awith-vcan: (user-namespace|network-namespace)\n\Z")


class Usage(unittest.TestCase):
    """Anywhere."""

    def test_refuses_what_it_does_not_know(self):
        for wrong in ((), ("--count",), ("--count", 0, "true"), ("--count", 17, "true"), ("--timeout", "x", "true"), ("--nonsense", "true")):
            status, out, err = run(*wrong)
            self.assertEqual((status, out), (2, ""), wrong)
            self.assertRegex(err, r"\Awith-vcan: [^\n]*\n\Z", wrong)

    def test_names_its_options(self):
        status, out, _ = run("--help")
        self.assertEqual(status, 0)
        for option in ("--count", "--timeout", "--vm", "--which"):
            self.assertIn(option, out)


if __name__ == "__main__":
    unittest.main()
