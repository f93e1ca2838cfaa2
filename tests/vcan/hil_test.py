"""`whisker plant`, `controller` and `hil` on a Linux CAN interface, together with can-utils and iproute2.

usage: hil_test.py WHISKER
"""

import json
import pathlib
import re
import signal
import subprocess
import sys
import unittest

from bus import PATIENCE_S, BusCase, Candump, Meddler, Valve, frames_of

KINDS = ("discs", "poles", "u-trap", "spiral", "maze", "rooms", "enclosed")
BUS = "vhil0"
FAR = "time_limit_s = 900.0\n[start]\nx_m = 0.0\ny_m = 0.0\n[goal]\nx_m = 200.0\ny_m = 0.0\n"


class OnTheBus(BusCase):
    bus = BUS

    def start_behind_valve(self, *arguments):
        """The plant, which cannot finish its run before the valve opens."""
        valve = Valve(self.folder / "valve")
        return self.start("plant", *arguments, "--record", self.folder / "valve"), valve

    def world(self, kind, seconds):
        text = self.once("world", kind, "--seed", 4, "--noise").stdout
        path = self.folder / f"{kind}-{seconds}.toml"
        path.write_text(re.sub(r"(?m)^time_limit_s *=.*$", f"time_limit_s = {seconds}", text))
        return path

    def hash_of(self, scenario):
        return json.loads(self.once("run", scenario, "--json").stdout)["hash"]

    def test_the_trajectory_is_that_of_one_process(self):
        for kind in KINDS:
            scenario = self.world(kind, 3)
            both = json.loads(self.once("hil", scenario, "--can", BUS, "--json").stdout)
            self.assertEqual(both["hash"], self.hash_of(scenario), kind)

    def test_so_it_is_when_two_per_cent_of_the_frames_are_lost(self):
        lost = 0
        for kind in KINDS:
            scenario = self.world(kind, 1)
            both = json.loads(self.once("hil", scenario, "--can", BUS, "--drop", 2, "--json").stdout)
            self.assertEqual(both["hash"], self.hash_of(scenario), kind)
            lost += both["bus"]["lost"]
        self.assertGreater(lost, 0)

    def test_so_it_is_beside_a_process_that_meddles(self):
        scenario = self.world("u-trap", 3)
        meddler = Meddler(BUS)
        try:
            both = json.loads(self.once("hil", scenario, "--can", BUS, "--json").stdout)
        finally:
            said = meddler.end()
        self.assertEqual((both["hash"], both["bus"]["safe_stops"]), (self.hash_of(scenario), 0))
        self.assertGreater(said, both["ticks"])
        self.assertGreater(both["bus"]["refused"], said / 10)

    def test_either_may_come_late_and_the_controller_may_start_anew(self):
        scenario = self.world("discs", 5)
        plant, valve = self.start_behind_valve(scenario, "--can", BUS, "--json")
        plant.wait_for("waits for the controller")
        first = self.start("controller", "--can", BUS)
        first.wait_for("drives", valve)
        first.end(signal.SIGKILL)
        second = self.start("controller", "--can", BUS)
        plant.wait_for("the run begins again", valve)
        valve.open()
        self.assertEqual(plant.result()["hash"], self.hash_of(scenario))
        second.wait_for("waits for the base")
        again = self.start("plant", scenario, "--can", BUS, "--json")
        self.assertEqual(again.result()["hash"], self.hash_of(scenario))
        self.assertEqual(second.end(signal.SIGINT), 0)

    def test_the_plant_may_start_anew(self):
        scenario = self.world("poles", 5)
        controller = self.start("controller", "--can", BUS)
        first, valve = self.start_behind_valve(scenario, "--can", BUS)
        controller.wait_for("drives", valve)
        first.end(signal.SIGKILL)
        second = self.start("plant", scenario, "--can", BUS, "--json")
        self.assertEqual(second.result()["hash"], self.hash_of(scenario))

    def test_the_interface_may_go_and_come_back(self):
        scenario = self.world("maze", 8)
        controller = self.start("controller", "--can", BUS)
        plant, valve = self.start_behind_valve(scenario, "--can", BUS, "--json")
        controller.wait_for("drives", valve)
        self.interface.down()
        plant.wait_for(f"waits for {BUS} is down", valve)
        controller.wait_for(f"waits for {BUS} is down")
        self.interface.up()
        controller.wait_for("(?s)is down.*drives", valve)
        self.interface.remove()
        plant.wait_for(f"waits for {BUS} does not exist", valve)
        controller.wait_for(f"waits for {BUS} does not exist")
        self.interface.add()
        valve.open()
        result = plant.result()
        self.assertEqual(result["hash"], self.hash_of(scenario))
        self.assertEqual(result["bus"]["safe_stops"], 0)

    def test_cansend_stops_the_robot(self):
        scenario = self.folder / "far.toml"
        scenario.write_text(FAR)
        controller = self.start("controller", "--can", BUS)
        plant, valve = self.start_behind_valve(scenario, "--can", BUS, "--json")
        controller.wait_for("drives", valve)
        subprocess.run(["cansend", BUS, "010#"], check=True)
        valve.open()
        result = plant.result()
        self.assertEqual((plant.process.returncode, result["outcome"], result["detail"]), (6, "fault", "e_stop"))
        controller.wait_for("E-stop")

    def test_what_candump_wrote_replays(self):
        dump = Candump(self.folder / "candump.log", BUS)
        result = json.loads(self.once("hil", self.world("rooms", 6), "--can", BUS, "--json").stdout)
        dump.end()
        replay = json.loads(self.once("replay", dump.path, "--json").stdout)
        self.assertEqual((replay["same"], replay["hash"], replay["steps"]), (True, result["hash"], result["ticks"]))

    def test_others_read_and_play_what_was_recorded(self):
        log = self.folder / "run.log"
        result = json.loads(self.once("hil", self.world("discs", 3), "--record", log, "--json").stdout)
        frames = frames_of(log.read_text().splitlines())

        fields = ("-T", "fields", "-E", "separator=#", "-e", "can.id", "-e", "data.data")
        shark = subprocess.run(["tshark", "-r", log, *fields], capture_output=True, text=True, timeout=PATIENCE_S, check=True)
        read = [line.partition("#") for line in shark.stdout.splitlines()]
        self.assertEqual([f"{int(number, 0):03X}#{data.upper()}" for number, _, data in read], frames)

        dump = Candump(self.folder / "played.log", BUS)
        subprocess.run(["canplayer", "-t", "-I", log, f"{BUS}=private"], timeout=PATIENCE_S, check=True)
        self.assertEqual(frames_of(dump.end()), frames)
        replay = json.loads(self.once("replay", dump.path, "--json").stdout)
        self.assertEqual((replay["same"], replay["hash"]), (True, result["hash"]))

    def test_two_robots_share_the_bus(self):
        worlds = self.world("discs", 5), self.world("poles", 5)
        both = [self.start("hil", world, "--can", BUS, "--node", node, "--json") for node, world in enumerate(worlds, 1)]
        for hil, world in zip(both, worlds):
            self.assertEqual(hil.result()["hash"], self.hash_of(world))

    def test_two_controllers_with_one_number_are_a_fault(self):
        scenario = self.world("discs", 5)
        controllers = [self.start("controller", "--can", BUS) for _ in range(2)]
        for controller in controllers:
            controller.wait_for("safe stop: duplicate_node")
        plant = self.start("plant", scenario, "--can", BUS, "--json")
        result = plant.result()
        self.assertEqual((plant.process.returncode, result["outcome"], result["detail"]), (6, "fault", "duplicate_node"))

    def test_real_time_tells_its_figures(self):
        result = json.loads(self.once("hil", self.world("discs", 3), "--can", BUS, "--realtime", "--json").stdout)
        self.assertEqual(result["bus"]["sets"], result["ticks"])
        for key in ("deadline_misses", "round_trip_us", "load_percent"):
            self.assertIn(key, result["bus"])
        if result["bus"]["deadline_misses"] == 0:
            self.assertEqual(result["hash"], self.hash_of(self.world("discs", 3)))


if __name__ == "__main__":
    BusCase.whisker = sys.argv.pop(1)
    unittest.main(verbosity=2)
