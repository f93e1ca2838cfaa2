"""The committed forms of the protocol match the message table, and an independent DBC reader decodes them.

usage: dbc_test.py WHISKER ROOT
"""

import decimal
import importlib.util
import io
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
from contextlib import redirect_stderr, redirect_stdout

SYSTEM_PYTHON = "/usr/bin/python3"  # finds Debian's Python packages


def printed(*arguments):
    return subprocess.run([WHISKER, *arguments], check=True, capture_output=True).stdout


def load_dbc(data):
    with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
        import canmatrix.formats

        return canmatrix.formats.loads_flat(data.decode(), import_type="dbc")


class Committed(unittest.TestCase):
    def test_the_dbc_file_is_that_of_robot_1(self):
        self.assertEqual(printed("protocol", "--dbc"), (ROOT / "whisker.dbc").read_bytes(), "whisker protocol --dbc > whisker.dbc")

    def test_the_page_is_the_tables(self):
        self.assertEqual(printed("protocol"), (ROOT / "docs/protocol.md").read_bytes(), "whisker protocol > docs/protocol.md")


class Canmatrix(unittest.TestCase):
    def test_golden_frames_have_their_physical_values(self):
        matrix = load_dbc((ROOT / "whisker.dbc").read_bytes())
        seen = set()
        for line in (ROOT / "tests/can/golden_frames.txt").read_text().splitlines():
            frame_text, name, *values = line.split()
            identifier, data = frame_text.split("#")
            frame = matrix.frame_by_name(name)
            self.assertEqual(frame.arbitration_id.id, int(identifier, 16), line)
            self.assertEqual(frame.size, len(data) // 2, line)
            decoded = frame.decode(bytes.fromhex(data))
            for value in values:
                signal, _, number = value.partition("=")
                # The frame rounds to its resolution.
                step = abs(decoded[signal].signal.factor)
                self.assertLessEqual(abs(decoded[signal].phys_value - decimal.Decimal(number)), step / 2, line)
            self.assertEqual({s for s in decoded} - {"Crc"}, {v.partition("=")[0] for v in values}, line)
            seen.add(name)
        messages, everything = ({re.sub("(Controller|Base|All)$", "", name) for name in names} for names in (seen, (f.name for f in matrix.frames)))
        self.assertEqual(everything - messages, {"InfoRequest"})

    def test_every_frame_of_a_run_decodes_and_keeps_its_ranges(self):
        self.assertTrue(self.frames_of_a_run("").isdisjoint({"Gyro", "Fix", "FixReply", "PoseSigma"}))

    def test_every_frame_of_a_run_with_gyro_and_fixes_too(self):
        more = "[robot]\ngyro = true\nwheel_scale_sigma = 0.01\n[noise]\nfix_every_m = 0.1\nfix_sigma_m = 0.01\n"
        self.assertLessEqual({"Gyro", "Fix", "FixReply", "PoseSigma"}, self.frames_of_a_run(more))

    def test_every_frame_of_a_run_with_other_rules_too(self):
        straight = ROOT / "host/lab/rules/laws/straight.toml"
        self.assertLessEqual({"RulesPart", "RulesOrder", "RulesReply"}, self.frames_of_a_run("", "--rules", straight))

    def frames_of_a_run(self, more, *options):
        """Their names."""
        frames = {f.arbitration_id.id: f for f in load_dbc((ROOT / "whisker.dbc").read_bytes()).frames}
        with tempfile.TemporaryDirectory(prefix="whisker-dbc-") as folder:
            world, log = pathlib.Path(folder, "world.toml"), pathlib.Path(folder, "run.log")
            world.write_text("time_limit_s = 5.0\n[start]\nx_m = 0.0\ny_m = 0.0\n[goal]\nx_m = 9.0\ny_m = 0.0\n" + more)
            subprocess.run([WHISKER, "hil", world, "--record", log, *options], capture_output=True, timeout=60, check=False)
            lines = log.read_text("ascii").splitlines()
        speeds, names = [], set()
        for line in lines:
            identifier, _, data = line.split()[2].partition("#")
            frame = frames[int(identifier, 16)]
            self.assertEqual(frame.size, len(data) // 2, line)
            names.add(frame.name)
            values = {name: decoded.phys_value for name, decoded in frame.decode(bytes.fromhex(data)).items()}
            for name, value in values.items():
                signal = frame.signal_by_name(name)
                self.assertTrue(signal.min <= value <= signal.max, f"{line}: {name} {value}")
            if frame.name == "WheelCommand":
                speeds.append(values["Left"])
        self.assertGreater(len(speeds), 200)
        self.assertTrue(0.1 < max(speeds) <= decimal.Decimal("0.3"), max(speeds))
        return names

    def test_names_of_values_are_there(self):
        frame = load_dbc((ROOT / "whisker.dbc").read_bytes()).frame_by_name("NavStatus")
        self.assertEqual(frame.signal_by_name("Outcome").values[2], "reached")
        self.assertEqual(frame.attributes.get("GenMsgCycleTime"), "10")

    def test_every_robot_has_its_own_identifiers(self):
        seen = set()
        for robot in range(1, 8):
            frames = load_dbc(printed("protocol", "--dbc", "--robot", str(robot))).frames
            own = {f.arbitration_id.id for f in frames} - {0x010}
            self.assertEqual(len(own), len(frames) - 1)
            self.assertFalse(own & seen)
            seen |= own


if __name__ == "__main__":
    if importlib.util.find_spec("canmatrix") is None and sys.executable != SYSTEM_PYTHON:
        os.execv(SYSTEM_PYTHON, [SYSTEM_PYTHON, "-B", *sys.argv])
    WHISKER, ROOT = sys.argv[1], pathlib.Path(sys.argv[2])
    unittest.main(argv=sys.argv[:1])
