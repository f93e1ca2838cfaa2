"""`whisker bench` on a Linux CAN interface.

usage: bench_test.py WHISKER
"""

import json
import pathlib
import sys
import time
import unittest

from bus import PATIENCE_S, BusCase

BUS = "vbench0"
LAWS = pathlib.Path(__file__).resolve().parents[2] / "host/rules/laws"
STRAIGHT, SIDES = LAWS / "straight.toml", LAWS / "sides.toml"
FAR = "time_limit_s = 3000.0\n[start]\nx_m = 0.0\ny_m = 0.0\n[goal]\nx_m = 500.0\ny_m = 0.0\n"
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

    def test_a_response_table_is_sent_drives_and_is_kept(self):
        scenario, kept = self.folder / "empty.toml", self.folder / "kept"
        scenario.write_text(GOAL)
        controller = self.start("controller", "--can", BUS, "--keep", kept)
        controller.wait_for("waits for the base")
        built_in = json.loads(self.bench("rules", "--json"))["rules_hash"]
        told = json.loads(self.bench("rules", SIDES, "--drop", 5, "--json"))
        self.assertEqual(told["kept"], True)
        self.assertNotEqual(told["rules_hash"], built_in)
        for rules in (STRAIGHT, SIDES, "default"):
            here = json.loads(self.once("run", scenario, "--rules", rules, "--json").stdout)
            there = json.loads(self.once("plant", scenario, "--can", BUS, "--rules", rules, "--json").stdout)
            self.assertEqual(there["hash"], here["hash"])
            self.assertEqual(json.loads(self.bench("rules", "--json"))["rules_hash"], here["rules_digest"])
        self.bench("rules", SIDES)
        controller.close()
        self.start("controller", "--can", BUS, "--keep", kept).wait_for(f"response table {told['rules_hash']}")
        self.assertEqual(json.loads(self.bench("rules", "--json"))["rules_hash"], told["rules_hash"])

    def test_a_third_party_beside_controller_and_base(self):
        scenario, log = self.folder / "far.toml", self.folder / "run.log"
        scenario.write_text(FAR)
        controller = self.start("controller", "--can", BUS, "--record", log)
        plant = self.start("plant", scenario, "--can", BUS, "--json")
        controller.wait_for("drives")
        busy = self.once("bench", "set", "wheel_speed_max_mps=0.25", "--can", BUS)
        self.assertEqual((busy.returncode, busy.stdout), (1, ""))
        self.assertRegex(busy.stderr, r"\A[^\n]*a mission runs \(busy\): nothing was written[^\n]*\n\Z")
        self.assertEqual(self.bench("cancel"), "robot 1: cancelled\n")
        last = json.loads(self.bench("watch", "--for", 0.5, "--json").splitlines()[-1])
        self.assertEqual((last["outcome"], last["wheel_mps"], last["base"]["state"]), ("none", [0, 0], "running"))
        self.bench("set", "wheel_speed_max_mps=0.25")
        self.assertEqual(json.loads(self.bench("get", "wheel_speed_max_mps", "--json"))["parameters"][0]["value"], 0.25)
        kept = self.folder / "kept.toml"
        self.bench("save", kept)
        self.bench("set", "wheel_speed_max_mps=0.2")
        self.assertEqual([w["name"] for w in json.loads(self.bench("restore", kept, "--json"))["written"]], ["wheel_speed_max_mps"])
        goal = self.once("bench", "goal", 1, 0.5, "--can", BUS, "--json")
        self.assertEqual((goal.returncode, json.loads(goal.stdout)["outcome"]), (0, "reached"), goal.stderr)
        result = plant.result()
        self.assertAlmostEqual(result["final_distance_m"], (499**2 + 0.5**2) ** 0.5, delta=0.15)
        self.assertEqual(controller.end(), 0)
        replay = json.loads(self.once("replay", log, "--json").stdout)
        self.assertEqual((replay["same"], replay["hash"], replay["steps"]), (True, result["hash"], result["ticks"]))

    def test_an_interface_that_is_down(self):
        self.interface.down()
        done = self.once("bench", "get", "--all", "--can", BUS, "--timeout", 0.3)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertRegex(done.stderr, r"\A[^\n]*vbench0: not on the bus after 0.3 s: waits for [^\n]+\n\Z")


if __name__ == "__main__":
    BusCase.whisker = sys.argv.pop(1)
    unittest.main(verbosity=2)
