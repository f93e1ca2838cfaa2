"""`whisker bench` beside nodes on a bus of serial adapters, which needs no CAN."""

import http.client
import json
import pathlib
import re
import shlex
import signal
import socket
import subprocess
import threading
import time
import tomllib

import whisker
from slcan_bridge import Bridge
from whisker import Case, with_time_limit

PATIENCE_S = 240  # a lockstep goes on as slowly as a busy computer lets it
PATIENT = ("--timeout", 60)
SILENCE = ("--timeout", 3)  # nobody will answer; it is enough to get onto the bus of a busy computer
FAR = "time_limit_s = 3000.0\n[start]\nx_m = 0.0\ny_m = 0.0\n[goal]\nx_m = 500.0\ny_m = 0.0\n"
ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/can.md"
STRAIGHT = ROOT / "host/lab/rules/laws/straight.toml"


class Ear:
    """A place on the bus that only listens. heard: receives each line."""

    def __init__(self, heard):
        self.sendall = heard
        self.over = threading.Event()

    def recv(self, _):
        self.over.wait()
        return b""

    def close(self):
        self.over.set()


class Beside(Case):
    """A bus with sockets for some nodes and one for each bench command, one after the other."""

    def setUp(self):
        super().setUp()
        self.bridge = Bridge(*(self.folder / name for name in ("bench", "controller", "base")))
        self.addCleanup(self.bridge.close)
        self.processes = []

    def start(self, *arguments, stdout=subprocess.DEVNULL):
        with open(self.folder / f"{arguments[0]}.err", "w", encoding="utf-8") as errors:
            process = subprocess.Popen([whisker.binary, *map(str, arguments)], stdout=stdout, stderr=errors)
        self.addCleanup(lambda: (process.kill(), process.wait()))
        self.processes.append(process)
        return process

    def controller(self, *arguments):
        """Returns when it is on the bus."""
        with self.bridge.arrives("controller"):
            return self.start("controller", "--can", f"slcan:{self.folder / 'controller'}", *arguments)

    def plant(self, scenario):
        """In lockstep, where no node is too late on a busy computer. Returns when it is on the bus; its result: `result_of`."""
        with self.bridge.arrives("base"):
            plant = subprocess.Popen([whisker.binary, "plant", str(scenario), "--can", f"slcan:{self.folder / 'base'}", "--json"],
                                     stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
            self.addCleanup(lambda: (plant.kill(), plant.communicate()))
        return plant

    def result_of(self, plant):
        return json.loads(plant.communicate(timeout=PATIENCE_S)[0])

    def drives_far(self):
        """A base in lockstep for longer than any test."""
        return self.plant(self.file("far.toml", FAR))

    def wait_for(self, said, process):
        """Until the process has said so on standard error, or ended."""
        errors = self.folder / "bench.err"
        end = time.monotonic() + PATIENCE_S
        while not (found := re.search(said, errors.read_text())) and process.poll() is None and time.monotonic() < end:
            time.sleep(0.01)
        self.assertTrue(found, errors.read_text())
        return found

    def bench(self, command, *arguments):
        patience = () if "--timeout" in arguments else PATIENT
        return whisker.whisker("bench", command, "--socket", self.folder / "bench", *arguments, *patience, timeout=PATIENCE_S)

    def start_bench(self, command, *arguments, **options):
        """Returns when it is on the bus. Its words: `wait_for`."""
        with self.bridge.arrives("bench"):
            return self.start("bench", command, *arguments, "--socket", self.folder / "bench", **options)

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

    def world(self, kind, seconds=60):
        return self.file(f"{kind}.toml", with_time_limit(whisker.whisker("world", kind, "--seed", 1).stdout, seconds))

    def wait_for_running(self):
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            nodes = json.loads(self.bench("nodes", "--json", "--for", 0.3).stdout or '{"nodes": []}')["nodes"]
            if [n["state"] for n in nodes] == ["running"] * 2:
                return {n["role"]: n for n in nodes}
        self.fail("the robot does not drive")

    def last(self):
        """The last line of a watch that heard both nodes and a status."""
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            lines = self.bench("watch", "--for", 0.5, "--json").stdout.splitlines()
            last = json.loads(lines[-1]) if lines else {}
            if all(last.get(key) is not None for key in ("controller", "base", "outcome", "wheel_mps")):
                return last
        self.fail("the robot says nothing")

    def value(self, name):
        return self.json_of("get", name)["parameters"][0]["value"]


class Nodes(Beside):
    def test_lists_a_lone_controller_with_its_table(self):
        self.controller("--node", 3)
        for _ in range(3):
            (node,) = self.json_of("nodes")["nodes"]
            self.assertEqual((node["robot"], node["role"], node["node"], node["state"]), (3, "controller", 3, "waiting"))
            self.assertEqual((node["protocol"], node["same_table"], node["errors"]), (1, True, []))
            self.assertRegex(node["firmware"], r"\A\d+\.\d+\.\d+\Z")
            self.assertGreaterEqual(node["age_s"], 0)
        self.assertRegex(self.done("nodes"), r"\Arobot 3 controller +node 3 +waiting .* heard \d+\.\d\d s ago\n\Z")

    def test_lists_both_nodes_while_they_drive_and_changes_nothing(self):
        self.controller()
        plant = self.drives_far()
        nodes = self.wait_for_running()
        self.assertEqual({role: (n["state"], n["node"], n["errors"]) for role, n in nodes.items()},
                         {"controller": ("running", 1, []), "base": ("running", 9, [])})
        self.complains("rules", says="robot 1 has a base (node 9)")
        self.assertIsNone(plant.poll())

    def test_a_base_that_is_held_up_keeps_its_place(self):
        """The bench hears one heartbeat of it. A second base on the bus would stop the robot for good."""
        self.controller()
        plant = self.drives_far()
        self.wait_for_running()
        held = threading.Event()

        def hold(line):
            if line.startswith(b"t709") and self.bridge.ends[0] is not None and not held.is_set():
                plant.send_signal(signal.SIGSTOP)
                held.set()

        self.bridge.join(Ear(hold))
        with self.bridge.arrives("bench"):
            bench = subprocess.Popen([whisker.binary, "bench", "get", "gyro", "--json", "--socket", str(self.folder / "bench")],
                                     stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            self.addCleanup(lambda: (bench.kill(), bench.communicate()))
        self.assertTrue(held.wait(PATIENCE_S))
        time.sleep(1)
        plant.send_signal(signal.SIGCONT)
        told, errors = bench.communicate(timeout=PATIENCE_S)
        self.assertEqual((bench.returncode, errors), (0, ""))
        self.assertEqual(json.loads(told)["parameters"][0]["value"], False)
        self.wait_for_running()

    def test_nobody_there(self):
        done = self.bench("nodes", "--json", "--for", 0.2)
        self.assertEqual((done.returncode, json.loads(done.stdout)["nodes"]), (1, []))
        self.assertRegex(done.stderr, r"\A[^\n]*no node sent a heartbeat in 0\.2 s\n\Z")
        self.complains("get", "gyro", *SILENCE, says="no controller of robot 1 in 3 s")
        self.complains("get", "gyro", "--timeout", 0.2, "--can", "vcan0", status=2, says="choose one of --can, --tty and --socket")
        done = whisker.whisker("bench", "nodes", "--socket", self.folder / "nothing", "--timeout", 0.2)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("not on the bus after 0.2 s: waits for", done.stderr)


class Page(Beside):
    """The commands of docs/can.md that show what they print."""

    def test_shows_what_the_commands_print(self):
        self.controller()
        page = PAGE.read_text()
        shown = re.findall(r"^\$ whisker (bench .*) --can vcan0\n((?:[^$`].*\n)*)", page, re.MULTILINE)
        self.assertGreaterEqual(len(shown), 5)
        varies = re.compile(r"boot \w+  up +\d+ s  heard [\d.]+ s")
        for command, wanted in shown:
            done = whisker.whisker(*shlex.split(command), "--socket", self.folder / "bench", *PATIENT, cwd=self.folder, timeout=PATIENCE_S)
            self.assertEqual(varies.sub("", done.stdout + done.stderr), varies.sub("", wanted), command)


class Parameters(Beside):
    def setUp(self):
        super().setUp()
        self.controller()

    def test_get_names_unit_range_and_default(self):
        self.assertRegex(self.done("get", "wheel_speed_max_mps"), r"\Awheel_speed_max_mps +0\.3 m/s +0\.02 to 3\.2 m/s; default 0\.3 m/s\n\Z")
        everything = self.json_of("get", "--all")["parameters"]
        listed = dict(re.findall(r"(?m)^\| `(\w+)` \| (.*?) \|", whisker.whisker("protocol", "--parameters").stdout))
        self.assertEqual({p["name"] for p in everything}, set(listed))
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


class Orders(Beside):
    def test_stop_and_reset_of_a_lone_controller(self):
        self.controller()
        self.complains("selftest", says="robot 1 needs its controller and its base")
        self.assertEqual(self.done("stop"), "robot 1: E-stop\n")
        (node,) = self.json_of("nodes")["nodes"]
        self.assertEqual((node["state"], node["errors"]), ("e_stopped", ["e_stop"]))
        self.assertIn("starts nothing", self.done("reset"))
        (node,) = self.json_of("nodes")["nodes"]
        self.assertEqual((node["state"], node["errors"]), ("waiting", []))
        self.assertEqual(self.done("cancel"), "robot 1: cancelled\n")

    def test_nobody_hears_a_stop(self):
        self.complains("stop", *SILENCE, says="the E-stop was sent, but robot 1 was silent for 3 s")
        self.complains("reset", *SILENCE, says="robot 1 was silent")

    def test_stops_both_nodes_of_a_robot_that_drives(self):
        self.controller()
        self.drives_far()
        self.wait_for_running()
        self.done("stop")
        states = {n["role"]: n["state"] for n in self.json_of("nodes")["nodes"]}
        self.assertEqual(set(states.values()), {"e_stopped"})


class Watching(Beside):
    def test_a_record_replays_and_watching_changes_nothing(self):
        scenario, log = self.world("discs", 10), self.folder / "run.log"
        recorder = self.start_bench("record", log, "--for", PATIENCE_S)
        self.controller()
        plant = self.result_of(self.plant(scenario))
        recorder.terminate()
        self.assertEqual(recorder.wait(), 0)
        run = json.loads(whisker.whisker("run", scenario, "--json").stdout)
        replay = json.loads(whisker.whisker("replay", log, "--json").stdout)
        self.assertEqual(plant["hash"], run["hash"])
        self.assertEqual((replay["same"], replay["hash"], replay["steps"]), (True, run["hash"], run["ticks"]))

    def test_watch_tells_what_the_bus_carries(self):
        self.controller()
        self.drives_far()
        self.wait_for_running()
        lines = [json.loads(line) for line in self.done("watch", "--for", 2, "--every", 0.2, "--json").splitlines()]
        self.assertGreaterEqual(len(lines), 5)
        last = lines[-1]
        self.assertEqual((last["controller"], last["base"]), ({"state": "running", "errors": ""},) * 2)
        self.assertEqual((last["outcome"], last["fault"]), ("running", "none"))
        self.assertEqual((len(last["wheel_mps"]), len(last["counts"]), len(last["range_m"])), (2, 2, 3))
        self.assertEqual(sorted(line["t_s"] for line in lines), [line["t_s"] for line in lines])
        self.assertRegex(self.done("watch", "--for", 2), r"(?m)^ +\d\.\d{3} controller running, base running; running: \w+, \w+; wheels ")

    def test_the_live_page_has_the_run(self):
        scenario = self.world("discs", 300)
        watcher = self.start_bench("watch", "--for", PATIENCE_S, "--view", 0, "--view-stay")
        found = self.wait_for(r"http://127\.0\.0\.1:(\d+)/", watcher)
        self.controller()
        run = self.result_of(self.plant(scenario))
        server = http.client.HTTPConnection("127.0.0.1", int(found.group(1)), timeout=PATIENCE_S)
        server.request("GET", "/events")
        answer, events = server.getresponse(), []
        while not events or not events[-1].get("result"):
            if (line := answer.readline().decode()).startswith("data: "):
                events.append(json.loads(line[6:]))
            self.assertTrue(line)
        server.close()
        setting, goal = events[0]["setting"], tomllib.loads(scenario.read_text())["goal"]
        self.assertEqual(setting["world"]["goal"][:2], [goal["x_m"], goal["y_m"]])
        self.assertEqual((setting["inside"], setting["planner"]), (False, None))
        result = events[-1]["result"]
        self.assertEqual((result["outcome"], result["hash"]), ("reached", run["hash"]))
        watcher.terminate()

    def test_silence_is_an_error(self):
        self.complains("watch", "--for", 0.3, says="robot 1 was silent for 0.3 s")
        self.complains("record", self.folder / "a.log", "--for", 0.3, says="no frame in 0.3 s")


class Rules(Beside):
    """The response table of a controller."""

    def setUp(self):
        super().setUp()
        self.built_in, self.other = (json.loads(whisker.whisker("run", self.world("discs", 1), *rules, "--json").stdout)["rules_digest"]
                                     for rules in ((), ("--rules", STRAIGHT)))

    def rules(self):
        return self.json_of("rules")["rules_hash"]

    def test_are_sent_kept_and_restored(self):
        kept = self.folder / "kept"
        controller = self.controller("--keep", kept)
        self.assertEqual(self.done("rules"), f"response table: {self.built_in}\n")
        self.assertEqual(self.done("rules", STRAIGHT), f"response table: {self.built_in} -> {self.other}, kept for the next start\n")
        for expected, restored in ((self.other, False), (self.built_in, True)):
            if restored:
                told = self.json_of("rules", "--restore")
                self.assertEqual((told["rules_hash"], told["kept"]), (self.built_in, True))
            controller.kill()
            controller.wait()
            refused = whisker.whisker("controller", "--can", "slcan:none", "--calibration", kept)
            self.assertEqual((refused.returncode, refused.stderr), (2, f"whisker: --calibration: {kept}: has a response table: name another file\n"))
            controller = self.controller("--keep", kept)
            self.assertEqual(self.rules(), expected)

    def test_without_a_storage_they_last_until_the_next_start(self):
        controller = self.controller()
        self.assertEqual(self.done("rules", STRAIGHT, "--drop", 5), f"response table: {self.built_in} -> {self.other}, until the controller restarts\n")
        controller.kill()
        controller.wait()
        self.controller()
        self.assertEqual(self.rules(), self.built_in)

    def test_a_damaged_file_is_not_used(self):
        kept = self.folder / "kept"
        controller = self.controller("--keep", kept)
        self.done("rules", STRAIGHT)
        controller.kill()
        controller.wait()
        stored = bytearray(kept.read_bytes())
        stored[4000] ^= 1
        kept.write_bytes(stored)
        self.controller("--keep", kept)
        self.assertEqual(self.rules(), self.built_in)

    def test_refusals_change_nothing_and_are_one_line(self):
        self.complains("rules", STRAIGHT, *SILENCE, says="no controller of robot 1")
        controller = self.controller("--planner", "fan")
        self.assertEqual(self.done("rules"), "response table: none\n")
        self.complains("rules", STRAIGHT, says="the controller says unsupported: it takes no table; its response table is unchanged")
        self.complains("rules", "--restore", says="unsupported")
        controller.kill()
        controller.wait()
        self.controller()
        self.complains("rules", STRAIGHT, "--restore", status=2, says="a file, or --restore")
        self.complains("rules", "--map", "SA=steer", status=2, says="--map needs a file")
        self.complains("rules", STRAIGHT, "--map", "SA=steer", status=2, says="no output 'steer'")
        self.assertEqual(self.rules(), self.built_in)


class Driving(Beside):
    """The bench in the controller's place: its socket is the controller's."""

    def beside_plant(self, scenario, *arguments):
        plant = self.plant(scenario)
        done = self.bench(*arguments, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout), self.result_of(plant)

    def test_the_goal_of_the_base_gives_the_run_of_one_process(self):
        scenario = self.world("discs", 300)
        goal = tomllib.loads(scenario.read_text())["goal"]
        told, plant = self.beside_plant(scenario, "goal", goal["x_m"], goal["y_m"], "--tolerance", goal["tolerance_m"])
        run = json.loads(whisker.whisker("run", scenario, "--json").stdout)
        self.assertEqual((told["outcome"], plant["outcome"], told["hash"]), ("reached", "reached", plant["hash"]))
        self.assertEqual(plant["hash"], run["hash"])
        self.assertEqual((told["final_distance_m"], told["min_clearance_m"]), (None, None))
        self.assertAlmostEqual(told["believed_distance_m"], run["believed_distance_m"], delta=1e-4)

    def test_another_goal_is_reached(self):
        scenario = self.file("empty.toml", "time_limit_s = 60.0\n[start]\nx_m = 0.0\ny_m = 0.0\n[goal]\nx_m = 3.0\ny_m = 0.0\n")
        told, plant = self.beside_plant(scenario, "goal", 1, 0.5)
        self.assertEqual((told["outcome"], plant["outcome"]), ("reached", "off_goal"))
        self.assertAlmostEqual(plant["final_distance_m"], (2**2 + 0.5**2) ** 0.5, delta=0.15)

    def test_drives_by_hand_and_the_guard_keeps_off_the_wall(self):
        wall = "[[wall]]\npoints = [[1.0, -1.0], [1.0, 1.0]]\n"
        scenario = self.file("wall.toml", "time_limit_s = 60.0\n[start]\nx_m = 0.0\ny_m = 0.0\n[goal]\nx_m = 3.0\ny_m = 0.0\n" + wall)
        commands = self.file("ahead.csv", "t_s,v_mps,omega_radps\n" + "".join(f"{i / 10},0.3,0\n" for i in range(80)))
        told, plant = self.beside_plant(scenario, "drive", "--commands", commands, "--vouch", 0.3)
        self.assertEqual((told["outcome"], told["fault"]), ("ended", "none"))
        self.assertGreater(told["pose"]["x_m"], 0.6)
        self.assertGreater(plant["min_clearance_m"], 0)
        self.assertLess(plant["min_clearance_m"], 0.1)

    def test_takes_no_taken_place(self):
        self.controller()
        self.complains("goal", 1, 0, says="robot 1 has a controller (node 1)")
        self.complains("drive", "--commands", self.file("c.csv", "t_s,v_mps,omega_radps\n0,0,0\n"), says="has a controller")
        self.complains("drive", status=2, says="choose --keys or --commands")
        self.complains("drive", "--keys", status=2, says="standard input is no terminal")
        self.complains("goal", 1, 0, "--node", 2, *SILENCE, says="no base of robot 2 in 3 s")

    def test_an_option_of_the_guard_needs_the_guard(self):
        for arguments in (("--guard", "--planner", "map"), ("--command-timeout", 0.1)):
            done = whisker.whisker("controller", "--can", "vcan0", *arguments)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn("--guard", done.stderr)


class Calibrating(Beside):
    ROOM = """[robot]
gyro = true
[noise]
gyro_scale_sigma = 0.01
[start]
x_m = 0
y_m = 0
heading_deg = 0
[goal]
x_m = 0.5
y_m = 0
[[wall]]
points = [[0.9, -0.7], [0.9, 0.8], [-1.1, 0.8], [-1.1, -0.7], [0.9, -0.7]]
"""

    def measured(self, world, *arguments, status=0):
        """The bench's result and standard error, while a base gives its order to start."""
        scenario = self.file("world.toml", world)
        plant = self.plant(scenario)
        done = self.bench("calibrate", *arguments, "--json")
        plant.kill()
        plant.wait()
        self.assertEqual(done.returncode, status, done.stderr)
        return json.loads(done.stdout), done.stderr

    def test_measures_what_the_base_has(self):
        spin, _ = self.measured(self.ROOM, "spin")
        self.assertEqual([v["key"] for v in spin["values"]], ["gyro_scale", "wheel_track_m"])
        scale = spin["values"][0]
        self.assertEqual(scale["before"], 1)
        self.assertTrue(0.0001 < abs(scale["value"] - 1) < 0.04, scale)
        self.assertLess(scale["sigma"], 0.001)
        self.assertTrue(spin["lines"][0].startswith("gyro_scale = "))
        tape, _ = self.measured(self.ROOM[: self.ROOM.index("[[wall]]")], "tape", "--length", 1)
        self.assertRegex(tape["steps"][0]["found"], r"^drove (1\.0|0\.99)\d+ m by its wheels$")

    def test_says_why_there_is_no_result(self):
        blocked, err = self.measured(self.ROOM, "straight", status=6)
        self.assertEqual(blocked["steps"][0]["trouble"], "blocked")
        self.assertIn("whisker: straight: no result: blocked\n", err)

    def test_refuses(self):
        self.complains("calibrate", "spine", status=2, says="did you mean 'spin'")
        self.complains("calibrate", "spin", "--length", 2, status=2, says="--length has no meaning")
        self.complains("calibrate", "spin", *SILENCE, says="no base of robot 1 in 3 s")
        self.controller()
        self.complains("calibrate", "spin", says="robot 1 has a controller (node 1)")


class ThirdParty(Beside):
    """The bench beside a controller and a base, which drives to a goal that is far away."""

    def setUp(self):
        super().setUp()
        self.log = self.folder / "run.log"
        self.node = self.controller("--record", self.log)
        self.base = self.drives_far()

    def test_parameters_orders_and_the_replay_of_all(self):
        self.wait_for_running()
        self.assertEqual(self.value("wheel_speed_max_mps"), 0.3)
        self.complains("set", "wheel_speed_max_mps=0.25", says="a mission runs (busy): nothing was written; cancel it first")
        self.assertEqual(self.done("cancel"), "robot 1: cancelled\n")
        last = self.last()
        self.assertEqual((last["outcome"], last["wheel_mps"], last["base"]["state"]), ("none", [0, 0], "running"))
        self.assertEqual(self.done("set", "wheel_speed_max_mps=0.25"), "wheel_speed_max_mps: 0.3 m/s -> 0.25 m/s\n")
        self.assertEqual(self.value("wheel_speed_max_mps"), 0.25)
        self.complains("set", "wheel_speed_max_mps=9", status=2, says="the nearest allowed value is 3.2 m/s")
        kept = self.folder / "kept.toml"
        self.done("save", kept)
        self.done("set", "wheel_speed_max_mps=0.2")
        self.assertEqual([w["name"] for w in self.json_of("restore", kept)["written"]], ["wheel_speed_max_mps"])
        done = self.bench("goal", 1, 0.5, "--json")
        self.assertEqual((done.returncode, done.stderr.splitlines()[-1].endswith(": drives")), (0, True), done.stderr)
        told = json.loads(done.stdout)
        self.assertEqual((told["outcome"], told["detail"]), ("reached", "at_goal"))
        result = self.result_of(self.base)
        self.assertEqual(result["outcome"], "off_goal")
        self.assertAlmostEqual(result["final_distance_m"], (499**2 + 0.5**2) ** 0.5, delta=0.15)
        self.node.terminate()
        self.node.wait()
        replay = json.loads(whisker.whisker("replay", self.log, "--json").stdout)
        self.assertEqual((replay["same"], replay["hash"], replay["steps"]), (True, result["hash"], result["ticks"]), replay)
        self.assertEqual(replay["missions"], 2, "the operator's goal is one with the new parameters")

    def goal_that_is_far(self):
        goal = self.start_bench("goal", 100, 50)
        self.wait_for(": drives", goal)
        return goal

    def test_a_goal_while_it_drives_and_a_robot_that_falls_silent(self):
        self.wait_for_running()
        goal = self.goal_that_is_far()
        self.base.kill()
        self.assertEqual(goal.wait(PATIENCE_S), 1)
        self.assertIn("the controller sends no NavStatus for 3000 ms (waiting)", (self.folder / "bench.err").read_text())

    def test_the_end_of_its_time_and_an_interruption_cancel(self):
        self.wait_for_running()
        self.complains("goal", 1, 0, "--planner", "map", status=2, says="the robot's own controller drives it")
        done = self.bench("goal", 100, 50, "--for", 3)
        self.assertEqual((done.returncode, done.stdout[:22]), (4, "gave_up (time_limit) b"), done.stderr)
        self.assertEqual(self.last()["outcome"], "none")
        goal = self.goal_that_is_far()
        goal.send_signal(signal.SIGINT)
        self.assertEqual(goal.wait(PATIENCE_S), 130)
        self.assertEqual(self.last()["outcome"], "none")


class ThroughAGuardNode(Beside):
    """The bench as the operator of a guard node, whose base has a wall before it."""

    WALL = "[[wall]]\npoints = [[1.0, -1.0], [1.0, 1.0]]\n"

    def world_of(self, seconds):
        return self.file("wall.toml", f"time_limit_s = {seconds}\n[start]\nx_m = 0.0\ny_m = 0.0\n[goal]\nx_m = 3.0\ny_m = 0.0\n{self.WALL}")

    def ahead(self, seconds):
        return self.file("ahead.csv", "t_s,v_mps,omega_radps\n" + "".join(f"{i / 10},0.3,0\n" for i in range(10 * seconds)))

    def driven_by_hand(self, seconds, plant_s):
        """What the bench and the plant tell of a drive ahead. The operator is there first, and the bus waits for it."""
        self.bridge.pace("bench", "base")
        told = self.folder / "told.json"
        with open(told, "w", encoding="utf-8") as to:
            drive = self.start_bench("drive", "--commands", self.ahead(seconds), "--vouch", 0.3, "--json", *PATIENT, stdout=to)
        self.wait_for("guard 1 on .*: waits for the base\n", drive)
        plant = self.plant(self.world_of(plant_s))
        self.assertEqual(drive.wait(PATIENCE_S), 0, (self.folder / "bench.err").read_text())
        return json.loads(told.read_text()), self.result_of(plant)

    def test_drives_by_hand_and_stops_before_the_wall_from_a_serial_device(self):
        device = self.bridge.terminal("device")
        with self.bridge.arrives("device"):
            self.start("controller", "--can", f"slcan:{device}", "--guard", "--command-timeout", 2)
        told, result = self.driven_by_hand(6, 60)
        self.assertEqual((told["outcome"], told["fault"], told["pose"]), ("ended", "none", None))
        self.assertGreater(told["time_s"], 5)
        self.assertEqual(result["outcome"], "gave_up", "the time of its scenario is over")
        self.assertGreater(result["path_m"], 0.6)
        self.assertGreater(result["min_clearance_m"], 0)
        self.assertLess(result["min_clearance_m"], 0.1)

    @staticmethod
    def told_of_a_clear_wish(lines):
        """The lines of each GuardStatus, except where a Velocity came between set and answer: only the GuardStatus says whether it was in time."""
        told, velocity, asked = [], False, False
        for i, line in enumerate(lines):
            if " 089#" in line:
                velocity = False
            elif " 0C1#" in line:
                velocity = True
            elif " 101#" in line:
                asked = velocity
            elif " 1F1#" in line and not asked:
                told.append(i)
        return told

    def test_a_record_of_a_guard_node_replays(self):
        log = self.folder / "run.log"
        self.controller("--guard", "--command-timeout", 2, "--record", log)
        _, result = self.driven_by_hand(5, 30)
        for process in self.processes:
            process.terminate()
            process.wait()
        replay = json.loads(whisker.whisker("replay", log, "--json").stdout)
        self.assertEqual((replay["same"], replay["guard"], replay["hash"]), (True, True, result["hash"]), replay)
        self.assertGreater(replay["compared"], 2900)
        text = log.read_text()
        lines = text.splitlines(keepends=True)
        told = self.told_of_a_clear_wish(lines)
        waits = next(line for line in lines if " 1F1#" in line)
        for name, lost, instead in (
            ("each seventh and the last", {*told[::7], told[-1]}, ""),
            ("the first", {*told[:150]}, ""),
            ("one, and the node said then that it waits for a set", {told[len(told) // 10]}, waits),
            ("many, likewise", {*told[20::7]}, waits),
        ):
            with self.subTest(name):
                thinned = self.file("thinned.log", "".join(instead if i in lost else line for i, line in enumerate(lines)))
                replay = json.loads(whisker.whisker("replay", thinned, "--json").stdout)
                self.assertEqual((replay["same"], replay["hash"]), (True, result["hash"]), replay)
                self.assertGreater(replay["missing_answers"], 0 if len(lost) == 1 else 100)
        other = self.file("other.log", text.replace("1F1#", "1F2#"))
        self.assertEqual(whisker.whisker("replay", other).returncode, 1, "without what was asked, the core drives")
        done = whisker.whisker("replay", log, "--html", self.folder / "page.html")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("the log of a guard node has no planner to show", done.stderr)

    def test_nodes_and_watch_know_a_guard_node(self):
        self.controller("--guard")
        self.plant(self.world_of(3600))
        self.wait_for_running()
        self.assertEqual([n["role"] for n in self.json_of("nodes")["nodes"]], ["guard", "base"])
        guard = self.last()["guard"]
        self.assertEqual((guard["reason"], guard["armed"], guard["asked_mps"]), ("command_timeout", False, 0))
        self.assertIn("; guard command_timeout, granted 1.0, 1.0; wheels ", self.done("watch", "--for", 2, "--every", 0.2))

    def test_a_robot_has_one_operator(self):
        self.controller("--guard")
        with socket.socket(socket.AF_UNIX) as other:
            other.connect(str(self.folder / "base"))
            over = threading.Event()

            def drive():
                while not over.wait(0.02):
                    other.sendall(b"t0C16000000000000\r")

            thread = threading.Thread(target=drive)
            thread.start()
            self.addCleanup(thread.join)
            self.addCleanup(over.set)
            self.complains("drive", "--commands", self.ahead(1), says="another operator drives robot 1")
            over.set()
            thread.join()

    def test_finds_a_guard_node_that_comes_later(self):
        drive = self.start_bench("drive", "--commands", self.ahead(1), "--timeout", PATIENCE_S)
        time.sleep(1)  # it has listened
        self.controller("--guard")
        self.wait_for("guard 1 on .*: waits for the base\n", drive)
        drive.send_signal(signal.SIGINT)
        self.assertEqual(drive.wait(PATIENCE_S), 130)

    def test_waits_for_a_base_and_its_order(self):
        self.controller("--guard")
        done = self.bench("drive", "--commands", self.ahead(1), "--for", 0.5)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("the guard node of robot 1: waits for the base for 0.5 s", done.stderr.splitlines()[-1])


if __name__ == "__main__":
    whisker.main()
