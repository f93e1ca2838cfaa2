"""`whisker bench` on a Linux CAN interface.

usage: bench_test.py WHISKER
"""

import json
import sys
import time
import unittest

from bus import PATIENCE_S, BusCase

BUS = "vbench0"
GOAL = "time_limit_s = 60.0\n[start]\nx_m = 0.0\ny_m = 0.0\n[goal]\nx_m = 1.0\ny_m = 0.0\n"


class OnTheBus(BusCase):
    bus = BUS

    def bench(self, command, *arguments):
        done = self.once("bench", command, "--can", BUS, *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        return done.stdout

    def test_parameters_of_two_robots(self):
        for node in (1, 2):
            self.start("controller", "--can", BUS, "--node", node).wait_for("waits for the base")
        nodes = json.loads(self.bench("nodes", "--json"))["nodes"]
        self.assertEqual([(n["node"], n["state"], n["same_table"]) for n in nodes], [(1, "waiting", True), (2, "waiting", True)])
        kept = self.folder / "kept.toml"
        self.bench("set", "wheel_speed_max_mps=0.25", "gyro=true", "--node", 2)
        self.bench("save", kept, "--node", 2)
        written = json.loads(self.bench("restore", kept, "--json"))["written"]
        self.assertEqual([w["name"] for w in written], ["wheel_speed_max_mps", "gyro"])
        values = [json.loads(self.bench("get", "--all", "--json", "--node", n))["parameters"] for n in (1, 2)]
        self.assertEqual(*values)

    def test_a_record_replays_and_a_stop_stops(self):
        scenario, log = self.folder / "empty.toml", self.folder / "run.log"
        scenario.write_text(GOAL)
        recorder = self.start("bench", "record", log, "--can", BUS, "--for", PATIENCE_S)
        while not log.exists():
            time.sleep(0.01)
        self.start("controller", "--can", BUS)
        result = json.loads(self.once("plant", scenario, "--can", BUS, "--json").stdout)
        self.assertEqual(recorder.end(), 0)
        replay = json.loads(self.once("replay", log, "--json").stdout)
        self.assertEqual((replay["same"], replay["hash"]), (True, result["hash"]))
        plant = self.start("plant", scenario, "--can", BUS, "--realtime", "--json")
        end = time.monotonic() + PATIENCE_S
        while '"running"' not in self.once("bench", "watch", "--can", BUS, "--for", 0.5, "--json").stdout and time.monotonic() < end:
            pass
        self.bench("stop")
        self.assertEqual(plant.result()["detail"], "e_stop")
        self.bench("reset")

    def test_an_interface_that_is_down(self):
        self.interface.down()
        done = self.once("bench", "get", "--all", "--can", BUS, "--timeout", 0.3)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertRegex(done.stderr, r"\A[^\n]*vbench0: not on the bus after 0.3 s: waits for [^\n]+\n\Z")


if __name__ == "__main__":
    BusCase.whisker = sys.argv.pop(1)
    unittest.main(verbosity=2)
