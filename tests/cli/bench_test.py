"""`whisker bench` beside nodes on a bus of serial adapters, which needs no CAN."""

import json
import re
import subprocess
import time
import tomllib

import whisker
from slcan_bridge import Bridge
from whisker import Case

PATIENCE_S = 60


class Beside(Case):
    """A bus with sockets for some nodes and one for each bench command, one after the other."""

    def setUp(self):
        super().setUp()
        self.bridge = Bridge(*(self.folder / name for name in ("bench", "controller", "base")))
        self.addCleanup(self.bridge.close)

    def start(self, *arguments):
        with open(self.folder / f"{arguments[0]}.err", "w", encoding="utf-8") as errors:
            process = subprocess.Popen([whisker_binary(), *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=errors)
        self.addCleanup(lambda: (process.kill(), process.wait()))
        return process

    def controller(self, *arguments):
        return self.start("controller", "--can", f"slcan:{self.folder / 'controller'}", *arguments)

    def plant(self, scenario, *arguments):
        return self.start("plant", scenario, "--can", f"slcan:{self.folder / 'base'}", *arguments)

    def bench(self, command, *arguments):
        return whisker.whisker("bench", command, "--socket", self.folder / "bench", *arguments)

    def done(self, *arguments):
        done = self.bench(*arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        return done.stdout

    def json_of(self, *arguments):
        result = json.loads(self.done(*arguments, "--json"))
        self.assertLessEqual(set(whisker.ORIGIN), set(result))
        return result

    def complains(self, *arguments, status=1, says=""):
        done = self.bench(*arguments)
        self.assertEqual((done.returncode, done.stdout), (status, ""), done.stderr)
        self.assertRegex(done.stderr, r"\A[^\n]+\n\Z")
        self.assertIn(says, done.stderr)

    def value(self, name):
        return self.json_of("get", name)["parameters"][0]["value"]


def whisker_binary():
    return whisker.binary


class Nodes(Beside):
    def test_lists_a_lone_controller_with_its_table(self):
        self.controller("--node", 3)
        for _ in range(3):
            (node,) = self.json_of("nodes")["nodes"]
            self.assertEqual((node["robot"], node["role"], node["node"], node["state"]), (3, "controller", 3, "waiting"))
            self.assertEqual((node["protocol"], node["same_table"], node["errors"]), (1, True, []))
            self.assertRegex(node["firmware"], r"\A\d+\.\d+\.\d+\Z")
            self.assertLess(node["age_s"], 0.3)
        self.assertRegex(self.done("nodes"), r"\Arobot 3 controller +node 3 +waiting .* heard 0\.\d\d s ago\n\Z")

    def test_lists_both_nodes_while_they_drive_and_changes_nothing(self):
        self.controller()
        plant = self.plant(self.file("w.toml", whisker.whisker("world", "discs", "--seed", 1).stdout), "--realtime")
        nodes = {}
        end = time.monotonic() + PATIENCE_S
        while [n["state"] for n in nodes.values()] != ["running"] * 2 and time.monotonic() < end:
            done = self.bench("nodes", "--json", "--for", 0.5)
            nodes = {n["role"]: n for n in json.loads(done.stdout)["nodes"]}
        self.assertEqual({role: (n["state"], n["node"], n["errors"]) for role, n in nodes.items()},
                         {"controller": ("running", 1, []), "base": ("running", 9, [])})
        self.complains("get", "--all", says="robot 1 has a base (node 9)")
        self.assertIsNone(plant.poll())

    def test_nobody_there(self):
        done = self.bench("nodes", "--json", "--for", 0.2)
        self.assertEqual((done.returncode, json.loads(done.stdout)["nodes"]), (1, []))
        self.assertRegex(done.stderr, r"\A[^\n]*no node sent a heartbeat in 0\.2 s\n\Z")
        self.complains("get", "gyro", "--timeout", 0.2, says="no controller of robot 1 in 0.2 s")
        self.complains("get", "gyro", "--timeout", 0.2, "--can", "vcan0", status=2, says="choose one of --can, --tty and --socket")
        done = whisker.whisker("bench", "nodes", "--socket", self.folder / "nothing", "--timeout", 0.2)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("not on the bus after 0.2 s: waits for", done.stderr)


class Parameters(Beside):
    def setUp(self):
        super().setUp()
        self.controller()

    def test_get_names_unit_range_and_default(self):
        self.assertRegex(self.done("get", "wheel_speed_max_mps"), r"\Awheel_speed_max_mps +0\.3 m/s +0\.02 to 3\.2 m/s; default 0\.3 m/s\n\Z")
        everything = self.json_of("get", "--all")["parameters"]
        listed = dict(re.findall(r"(?m)^\| `(\w+)` \| (.*?) \|", whisker.whisker("protocol", "--parameters").stdout))
        self.assertEqual([p["name"] for p in everything], list(listed))
        for p in everything:
            self.assertEqual(p["value"], p["default"], p)
        self.complains("get", status=2, says="name parameters, or --all")
        self.complains("get", "wheel_sped_max_mps", status=2, says="did you mean 'wheel_speed_max_mps'?")

    def test_set_writes_all_or_nothing(self):
        written = self.json_of("set", "wheel_speed_max_mps=0.25", "gyro=true", "consensus=median", "range_rate_hz=50")["written"]
        self.assertEqual({w["name"]: (w["from"], w["to"]) for w in written},
                         {"wheel_speed_max_mps": (0.3, 0.25), "gyro": (False, True), "consensus": ("agreeing", "median")})
        self.assertEqual(self.value("wheel_speed_max_mps"), 0.25)
        self.assertEqual(self.done("set", "wheel_speed_max_mps=0.25"), "the robot has these values already\n")
        self.assertEqual(self.done("set", "wheel_speed_max_mps=0.3"), "wheel_speed_max_mps: 0.25 m/s -> 0.3 m/s\n")
        for bad, says in (
            ("wheel_speed_max_mps=9", "too large; it may be 0.02 to 3.2 m/s; the nearest allowed value is 3.2 m/s"),
            ("wheel_speed_max_mps=-1", "the nearest allowed value is 0.02 m/s"),
            ("wheel_speed_max_mps=fast", "is no number; it may be 0.02 to 3.2 m/s"),
            ("wheel_speed_max_mps=nan", "is no number"),
            ("range_rate_hz=50.5", "must be a whole number"),
            ("consensus=mean", "must be agreeing or median"),
            ("gyro", "is no NAME=VALUE"),
            ("gyros=true", "did you mean 'gyro'?"),
            ("wheel_track_m=0.5", "the wheels must lie within the body: wheel_track_m <= 2 body_radius_m; it would fit with"),
        ):
            self.complains("set", "range_latency_s=0.03", bad, status=2, says=says)
        self.assertEqual(self.value("range_latency_s"), 0.02)

    def test_save_and_restore(self):
        self.done("set", "wheel_speed_max_mps=0.25", "range_side_angle_deg=31.7", "gyro=true")
        kept = self.folder / "kept.toml"
        self.assertRegex(self.done("save", kept), r"\A\d+ parameters: ")
        before = {p["name"]: p["value"] for p in self.json_of("get", "--all")["parameters"]}
        self.assertEqual(tomllib.loads(kept.read_text()), before)
        self.assertEqual(self.json_of("restore", kept)["written"], [])
        self.done("set", "wheel_speed_max_mps=0.3", "range_side_angle_deg=30", "gyro=false")
        self.assertEqual([w["name"] for w in self.json_of("restore", kept)["written"]],
                         ["wheel_speed_max_mps", "range_side_angle_deg", "gyro"])
        self.assertEqual({p["name"]: p["value"] for p in self.json_of("get", "--all")["parameters"]}, before)
        self.assertEqual(whisker.whisker("robot", "check", kept).returncode, 0)

    def test_restore_names_the_line_of_what_is_refused(self):
        bad = self.file("bad.toml", "range_latency_s = 0.03\n\nwheel_speed_max_mps = 9\n")
        self.complains("restore", bad, status=2, says=f"{bad}:3:23: 'wheel_speed_max_mps' must be from 0.02 to 3.2 m/s, but is 9")
        self.complains("restore", self.folder / "none.toml", status=2, says="none.toml:1:1:")
        self.assertEqual(self.value("range_latency_s"), 0.02)
        part = self.file("part.toml", "[robot]\nrange_latency_s = 0.03\n")
        self.assertEqual([w["name"] for w in self.json_of("restore", part)["written"]], ["range_latency_s"])

    def test_lost_frames_change_nothing(self):
        written = self.json_of("set", "wheel_speed_max_mps=0.25", "gyro=true", "--drop", 10)["written"]
        self.assertEqual([w["name"] for w in written], ["wheel_speed_max_mps", "gyro"])
        self.assertEqual(self.value("wheel_speed_max_mps"), 0.25)


if __name__ == "__main__":
    whisker.main()
