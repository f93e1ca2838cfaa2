"""`whisker plant`, `controller` and `hil` on a real vcan0, with can-utils and iproute2 as the others on the bus.

usage: hil_test.py WHISKER
"""

import json
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

KINDS = ("discs", "poles", "u-trap", "spiral", "maze", "rooms", "enclosed")
PATIENCE_S = 60
FAR = "time_limit_s = 900.0\n[start]\nx_m = 0.0\ny_m = 0.0\n[goal]\nx_m = 200.0\ny_m = 0.0\n"


def ip(*arguments):
    subprocess.run(["ip", "link", *arguments], check=True)


def once(*arguments):
    return subprocess.run([WHISKER, *map(str, arguments)], capture_output=True, text=True, timeout=PATIENCE_S, check=False)


class Running:
    """A whisker process whose words on standard error can be waited for."""

    def __init__(self, *arguments):
        self.log = tempfile.TemporaryFile("w+")
        self.process = subprocess.Popen([WHISKER, *map(str, arguments)], stdout=subprocess.PIPE, stderr=self.log, text=True)

    def words(self):
        self.log.seek(0)
        return self.log.read()

    def wait_for(self, pattern):
        end = time.monotonic() + PATIENCE_S
        while not re.search(pattern, self.words()):
            if time.monotonic() > end or (self.process.poll() is not None and not re.search(pattern, self.words())):
                raise AssertionError(f"no {pattern!r} in: {self.words()}")
            time.sleep(0.02)

    def result(self):
        out, _ = self.process.communicate(timeout=PATIENCE_S)
        return json.loads(out) if out else None

    def end(self, how=signal.SIGTERM):
        if self.process.poll() is None:
            self.process.send_signal(how)
        self.process.communicate(timeout=PATIENCE_S)
        return self.process.returncode

    def close(self):
        self.end(signal.SIGKILL)
        self.log.close()


class OnTheBus(unittest.TestCase):
    def setUp(self):
        box = tempfile.TemporaryDirectory(prefix="whisker-hil-")
        self.addCleanup(box.cleanup)
        self.folder = pathlib.Path(box.name)

    def start(self, *arguments):
        running = Running(*arguments)
        self.addCleanup(running.close)
        return running

    def world(self, kind, seconds):
        text = once("world", kind, "--seed", 4, "--noise").stdout
        path = self.folder / f"{kind}-{seconds}.toml"
        path.write_text(re.sub(r"(?m)^time_limit_s *=.*$", f"time_limit_s = {seconds}", text))
        return path

    def hash_of(self, scenario):
        return json.loads(once("run", scenario, "--json").stdout)["hash"]

    def test_the_trajectory_is_that_of_one_process(self):
        for kind in KINDS:
            scenario = self.world(kind, 3)
            both = json.loads(once("hil", scenario, "--can", "vcan0", "--json").stdout)
            self.assertEqual(both["hash"], self.hash_of(scenario), kind)

    def test_either_may_come_late_and_the_controller_may_start_anew(self):
        scenario = self.world("discs", 12)
        plant = self.start("plant", scenario, "--can", "vcan0", "--json")
        plant.wait_for("waits for the controller")
        first = self.start("controller", "--can", "vcan0")
        first.wait_for("drives")
        first.end(signal.SIGKILL)
        second = self.start("controller", "--can", "vcan0")
        plant.wait_for("the run begins again")
        self.assertEqual(plant.result()["hash"], self.hash_of(scenario))
        second.wait_for("waits for the base")
        again = self.start("plant", scenario, "--can", "vcan0", "--json")
        self.assertEqual(again.result()["hash"], self.hash_of(scenario))
        self.assertEqual(second.end(signal.SIGINT), 0)

    def test_the_interface_may_go_and_come_back(self):
        scenario = self.world("maze", 15)
        controller = self.start("controller", "--can", "vcan0")
        plant = self.start("plant", scenario, "--can", "vcan0", "--json")
        controller.wait_for("drives")
        ip("set", "vcan0", "down")
        plant.wait_for("waits for .*vcan0")
        ip("set", "vcan0", "up")
        controller.wait_for("(?s)drives.*waits.*drives")
        ip("del", "vcan0")
        controller.wait_for("(?s)drives.*waits.*drives.*waits for .*vcan0")
        ip("add", "vcan0", "type", "vcan")
        ip("set", "vcan0", "up")
        result = plant.result()
        self.assertEqual(result["hash"], self.hash_of(scenario))
        self.assertEqual(result["bus"]["safe_stops"], 0)

    def test_cansend_stops_the_robot(self):
        scenario = self.folder / "far.toml"
        scenario.write_text(FAR)
        controller = self.start("controller", "--can", "vcan0")
        plant = self.start("plant", scenario, "--can", "vcan0", "--json")
        controller.wait_for("drives")
        subprocess.run(["cansend", "vcan0", "010#"], check=True)
        result = plant.result()
        self.assertEqual((plant.process.returncode, result["outcome"], result["detail"]), (6, "fault", "e_stop"))
        controller.wait_for("E-stop")

    def test_what_candump_wrote_replays(self):
        scenario, log = self.world("rooms", 6), self.folder / "candump.log"
        with open(log, "w", encoding="ascii") as file:
            dump = subprocess.Popen(["candump", "-r", "4000000", "-L", "vcan0"], stdout=file)
        try:
            result = json.loads(once("hil", scenario, "--can", "vcan0", "--json").stdout)
        finally:
            time.sleep(0.5)
            dump.terminate()
            dump.wait(PATIENCE_S)
        replay = json.loads(once("replay", log, "--json").stdout)
        self.assertEqual((replay["same"], replay["hash"], replay["steps"]), (True, result["hash"], result["ticks"]))

    def test_two_robots_share_the_bus(self):
        worlds = self.world("discs", 5), self.world("poles", 5)
        both = [self.start("hil", world, "--can", "vcan0", "--node", node, "--json") for node, world in enumerate(worlds, 1)]
        for hil, world in zip(both, worlds):
            self.assertEqual(hil.result()["hash"], self.hash_of(world))

    def test_real_time_tells_its_figures(self):
        result = json.loads(once("hil", self.world("discs", 3), "--can", "vcan0", "--realtime", "--json").stdout)
        self.assertEqual(result["bus"]["sets"], result["ticks"])
        for key in ("deadline_misses", "round_trip_us", "load_percent"):
            self.assertIn(key, result["bus"])
        if result["bus"]["deadline_misses"] == 0:
            self.assertEqual(result["hash"], self.hash_of(self.world("discs", 3)))


if __name__ == "__main__":
    WHISKER = sys.argv.pop(1)
    unittest.main(verbosity=2)
