"""`whisker hil`, `plant`, `controller` and `replay`, as far as they need no CAN."""

import csv
import http.client
import json
import os
import pathlib
import re
import signal
import socket
import subprocess
import time

import slcan_bridge
import whisker
from whisker import KINDS, SCENARIOS, STATUS, Case, with_time_limit

PRIVATE_TRACE = ("d", "r", "sa", "sd", "est_x_m", "est_y_m", "est_heading_rad", "guide", "way_x_m", "way_y_m", "bend_rad", "pace_mps")  # not on the bus


class OnABus(Case):
    def world(self, kind, seconds=30, seed=5):
        text = whisker.whisker("world", kind, "--seed", seed, "--noise").stdout
        return self.file(f"{kind}.toml", with_time_limit(text, seconds))

    def json_of(self, *arguments):
        done = whisker.whisker(*arguments, "--json")
        self.assertTrue(done.stdout, done.stderr)
        result = json.loads(done.stdout)
        if "outcome" in result:
            self.assertEqual(done.returncode, STATUS[result["outcome"]])
        return result


class Hil(OnABus):
    def test_two_processes_give_the_run_of_one(self):
        for kind in KINDS:
            scenario = self.world(kind)
            alone = self.json_of("run", scenario)
            both = self.json_of("hil", scenario)
            bus = both.pop("bus")
            for key in whisker.RANGE_TRUST:
                here, there = alone.pop(key), both.pop(key)
                if isinstance(here, (int, float)):
                    self.assertAlmostEqual(there, here, delta=1 / 64, msg=key)
                else:
                    self.assertEqual(there, here, key)
            self.assertEqual(both, alone, kind)
            self.assertEqual(bus["sets"], alone["ticks"])
            self.assertEqual((bus["safe_stops"], bus["refused"], bus["deadline_misses"]), (0, 0, 0))

    def test_a_gyro_and_fixes_give_the_run_of_one_also_if_frames_are_dropped_and_in_the_log(self):
        gyro = "gyro = true\nwheel_scale_sigma = 0.005\n[noise]\ngyro_bias_dps = 1\n"
        fixes = "fix_every_m = 1\nfix_sigma_m = 0.02\nfix_sigma_deg = 1\n"
        scenario, robot = self.world("discs"), self.file("gyro.toml", gyro + fixes)
        log = self.folder / "gyro.log"
        alone = self.json_of("run", scenario, "--robot", robot)
        both = self.json_of("hil", scenario, "--robot", robot, "--record", log)
        self.assertEqual(both["hash"], alone["hash"])
        self.assertEqual(both["believed_distance_m"], alone["believed_distance_m"])
        for key in ("sigma_along_m", "sigma_across_m", "bound_m"):
            self.assertAlmostEqual(both[key], alone[key], delta=0.005, msg=key)
        sent = both["bus"]["fixes"]["sent"]
        self.assertGreater(sent, 3)
        self.assertEqual(both["bus"]["fixes"], {"sent": sent, "accepted": sent, "refused": 0})
        self.assertNotEqual(self.json_of("run", scenario)["hash"], alone["hash"])
        replayed = self.json_of("replay", log)
        self.assertEqual((replayed["hash"], replayed["unknown_sets"]), (alone["hash"], 0))
        dropped = self.json_of("hil", scenario, "--robot", robot, "--drop", 2)
        self.assertEqual(dropped["hash"], alone["hash"])
        self.assertGreater(dropped["bus"]["resent"], 100)

    def test_a_robot_off_its_goal_is_judged_the_same(self):
        both = self.json_of("hil", SCENARIOS / "bad_wheels.toml")
        del both["bus"]
        self.assertEqual(both["outcome"], "off_goal")
        self.assertEqual(both, self.json_of("run", SCENARIOS / "bad_wheels.toml"))

    def test_the_load_is_that_of_a_bus_in_real_time(self):
        """About 7 frames per period of 10 ms are a fifth of 500 kbit/s, regardless of the speed in lockstep."""
        scenario = self.world("discs", 5)
        load = self.json_of("hil", scenario)["bus"]["load_percent"]
        self.assertTrue(10 < load < 40, load)
        words = whisker.whisker("hil", scenario).stdout
        told = float(re.search(r"load of the bus in real time ([0-9.]+) %", words).group(1))
        # Heartbeats follow the wall clock, not the lockstep: two runs differ by a few frames.
        self.assertAlmostEqual(told, load, delta=0.5)

    def test_a_log_that_ends_within_a_line_is_replayed_up_to_there(self):
        log = self.folder / "whole.log"
        self.json_of("hil", self.world("discs", 3), "--record", log)
        lines = log.read_text().splitlines(keepends=True)
        whole = json.loads(whisker.whisker("replay", log, "--json").stdout)
        self.assertEqual((whole["same"], whole["cut_line"]), (True, 0))
        for rest in (1, 5, 20, 26):
            self.assertLess(rest, len(lines[-1]) - 1)
            cut = self.file("cut.log", "".join(lines[:-1]) + lines[-1][:rest])
            done = whisker.whisker("replay", cut, "--json")
            told = json.loads(done.stdout)
            self.assertEqual((done.returncode, told["same"], told["cut_line"]), (0, True, len(lines)), rest)
            self.assertEqual(done.stderr, f"whisker: {cut}: line {len(lines)}, the last, is cut off and left out\n")
        self.file("cut.log", lines[0] + lines[1][:9] + "\n" + "".join(lines[2:]))
        self.refused("replay", "cut.log", says="cut.log:2:1: not a frame")
        self.file("cut.log", lines[0][:9])
        self.refused_all("replay", "cut.log")

    def test_frames_that_are_not_a_robots_are_left_out_counted_and_said(self):
        log = self.folder / "whole.log"
        self.json_of("hil", self.world("discs", 3), "--record", log)
        lines = log.read_text().splitlines()
        whole = json.loads(whisker.whisker("replay", log, "--json").stdout)
        self.assertEqual(whole["skipped"], {})
        foreign = ("(1.000000) can0 20000080#0000000000000000", "(1.000000) can0 123##0112233", "(1.0) can0 123#R8 T", "(1.0) can0 18DAF110#0102", "(1.0) can0 7DF#02")
        # As candump writes it without -L, and with -x and CRLF.
        loud = [re.sub(r"^\((\S+)\) (\S+) ([0-9A-F]+)#(\S*)$", lambda m: f" ({m[1]})  {m[2]}  RX - -  {m[3]}   [{len(m[4]) // 2}]  {' '.join(re.findall('..', m[4]))}", line) for line in lines]
        for text in ("\n".join([*foreign, *lines]), "\ufeff" + "\r\n".join([*loud[:20], *foreign, *loud[20:]])):
            mixed = self.file("mixed.log", text + "\n")
            done = whisker.whisker("replay", mixed, "--json")
            told = json.loads(done.stdout)
            self.assertEqual(told["skipped"], {"29-bit": 1, "CAN FD": 1, "error": 1, "other": 1, "remote": 1})
            self.assertEqual({**told, "skipped": {}, "robot_name": ""}, {**whole, "robot_name": ""})
            self.assertEqual(done.stderr, f"whisker: {mixed}: frames that are not a robot's are left out: 1 29-bit, 1 CAN FD, 1 error, 1 other, 1 remote\n")

    def refused_all(self, *arguments):
        done = whisker.whisker(*arguments, cwd=self.folder)
        self.assertEqual((done.returncode, done.stdout), (2, ""))

    def test_lost_frames_change_nothing(self):
        scenario = self.world("discs", 5)
        both = self.json_of("hil", scenario, "--drop", 5)
        self.assertEqual(both["hash"], self.json_of("run", scenario)["hash"])
        self.assertGreater(both["bus"]["resent"], 0)
        self.assertGreater(both["bus"]["lost"], 0)

    def test_it_ends_when_its_controller_does(self):
        for pace in ((), ("--realtime",)):
            log = self.folder / f"{len(pace)}.log"
            with subprocess.Popen([whisker.binary, "hil", self.world("rooms", 3600), *pace, "--record", log], stderr=subprocess.PIPE, text=True) as process:
                while not log.exists() or log.read_text().count("\n") < 100:
                    self.assertIsNone(process.poll())
                (child,) = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
                os.kill(int(child), signal.SIGKILL)
                error = process.communicate(timeout=60)[1]
            self.assertEqual((process.returncode, error.splitlines()[-1]), (1, "whisker: the controller's process was ended by signal 9"))
            self.assertGreaterEqual(log.read_text().count("\n"), 100)

    def test_a_storage_that_was_not_finished_is_created_again(self):
        size = 16 + 2 * 8192
        for left in (b"", b"\xff" * 100, b"\0" * 16 + b"\xff" * 8192, b"\0" * 16 + b"\xff" * (size - 16), b"\0" * size):
            (self.folder / "kept").write_bytes(left)
            self.with_a_storage()
            self.assertEqual((self.folder / "kept").read_bytes(), b"whisker storage\n" + b"\xff" * (size - 16))
        for other in (b"precious", b"\xff" * (size + 1), b"whisker storage\n", b"x" * size):
            (self.folder / "kept").write_bytes(other)
            self.refused("controller", "--can", "slcan:none", "--keep", "kept", says="--keep: kept: not a storage of whisker controller: name another file")

    def with_a_storage(self, also=lambda: None):
        with subprocess.Popen([whisker.binary, "controller", "--can", "slcan:none", "--keep", "kept"], stderr=subprocess.PIPE, text=True, cwd=self.folder) as process:
            self.assertIn("waits for", process.stderr.readline())
            also()
            process.terminate()
        self.assertEqual(process.returncode, 0)

    def test_two_controllers_do_not_share_a_storage(self):
        def another():
            for option in ("--keep", "--calibration"):
                self.refused("controller", "--can", "slcan:none", option, "kept", says=f"{option}: kept: another controller uses it")

        self.with_a_storage(another)
        self.with_a_storage()

    def test_an_adapter_that_sends_no_frames_is_said(self):
        for name, arguments, partner in (("plant", ("plant", self.world("discs")), "controller"), ("controller", ("controller",), "base")):
            path = self.folder / name
            with socket.socket(socket.AF_UNIX) as listener:
                listener.bind(str(path))
                listener.listen(1)
                with subprocess.Popen([whisker.binary, *map(str, arguments), "--can", f"slcan:{path}"], stderr=subprocess.PIPE, text=True) as process, listener.accept()[0] as adapter:
                    said = ""
                    while said != f"{name} 1 on slcan:{path}: waits for the {partner}, and for frames: the adapter sends lines that are none\n":
                        adapter.sendall(b"x1232AABB\r")
                        said = process.stderr.readline()
                        self.assertTrue(said, "it has ended")
                    process.terminate()

    def test_options_reach_the_other_process(self):
        scenario = self.world("discs")
        robot = self.file("robot.toml", "body_radius_m = 0.1\nwheel_speed_max_mps = 0.25\n")
        options = ("--planner", "thesis", "--robot", robot, "--seed", 77)
        alone = self.json_of("run", scenario, *options)
        both = self.json_of("hil", scenario, *options, "--node", 7)
        self.assertEqual(both["hash"], alone["hash"])
        self.assertNotEqual(both["hash"], self.json_of("hil", scenario)["hash"])

    def test_knows_of_its_controller_what_the_bus_does_not_carry(self):
        robot = self.file("fixed.toml", "gyro = true\nbend_course = true\n[noise]\ngyro_bias_dps = 1\nfix_every_m = 1\nfix_sigma_m = 0.02\n")
        for kind, *options in (("u-trap",), ("rooms", "--robot", robot), ("discs", "--planner", "thesis"), ("maze", "--drop", 3)):
            scenario = self.world(kind, 20)
            alone = [option for option in options if option not in ("--drop", 3)]
            files = {name: self.folder / name for name in ("run.csv", "run.html", "hil.csv", "hil.html")}
            self.json_of("run", scenario, *alone, "--trace", files["run.csv"], "--html", files["run.html"])
            self.json_of("hil", scenario, *options, "--trace", files["hil.csv"], "--html", files["hil.html"])
            self.assertEqual(files["hil.csv"].read_text(), files["run.csv"].read_text(), kind)
            ticks = [re.search(r'id="columns-0">(.*?)<', files[name].read_text(), re.S)[1] for name in ("run.html", "hil.html")]
            self.assertEqual(ticks[0], ticks[1], kind)

    def test_the_trace_of_a_plant_has_what_the_bus_carries(self):
        scenario = self.world("u-trap", 10)
        self.json_of("run", scenario, "--trace", self.folder / "run.csv")
        places = self.folder / "plant", self.folder / "controller"
        bridge = slcan_bridge.Bridge(*places)
        self.addCleanup(bridge.close)
        controller = subprocess.Popen([whisker.binary, "controller", "--can", f"slcan:{places[1]}"], stderr=subprocess.DEVNULL)
        self.addCleanup(controller.wait)
        self.addCleanup(controller.terminate)
        self.json_of("plant", scenario, "--can", f"slcan:{places[0]}", "--trace", self.folder / "plant.csv")
        rows = [list(csv.DictReader((self.folder / name).read_text().splitlines())) for name in ("run.csv", "plant.csv")]
        self.assertEqual(len(rows[0]), len(rows[1]))
        for alone, both in zip(*rows):
            self.assertEqual(both, {**alone, **dict.fromkeys(PRIVATE_TRACE, "")})

    def test_a_recorded_run_replays_to_the_bit(self):
        scenario, log = self.world("rooms"), self.folder / "run.log"
        result = self.json_of("hil", scenario, "--record", log)
        for line in log.read_text().splitlines():
            self.assertRegex(line, r"\A\(\d{10}\.\d{6}\) private [0-9A-F]{3}#([0-9A-F]{2}){2,8}\Z")
        replay = self.json_of("replay", log)
        self.assertEqual((replay["same"], replay["hash"], replay["steps"]), (True, result["hash"], result["ticks"]))
        self.assertEqual((replay["robot"], replay["missions"], replay["unknown_sets"], replay["damaged"]), (1, 1, 0, 0))
        other = whisker.whisker("replay", log, "--planner", "thesis")
        self.assertEqual(other.returncode, 1)
        self.assertRegex(other.stdout, r"line \d+: tick \d+: recorded .*, the core says ")

    def test_a_replay_takes_the_rules_from_the_log(self):
        log, rules = self.folder / "run.log", pathlib.Path(__file__).resolve().parents[2] / "host/lab/rules/laws/straight.toml"
        result = self.json_of("hil", self.world("discs", 60), "--rules", rules, "--record", log)
        for options in ((), ("--rules", rules)):
            replay = self.json_of("replay", log, *options)
            self.assertEqual((replay["same"], replay["hash"], replay["rules_digest"]), (True, result["hash"], result["rules_digest"]))
        parts = re.compile(r" 2[0-2][19]#")
        without = self.file("without.log", "".join(line for line in log.read_text().splitlines(True) if not parts.search(line)))
        self.assertEqual(whisker.whisker("replay", without).returncode, 1)
        self.assertTrue(self.json_of("replay", without, "--rules", rules)["same"])

    def test_a_replay_shows_what_the_core_knew(self):
        scenario, log = self.world("rooms"), self.folder / "run.log"
        result = self.json_of("run", scenario, "--trace", self.folder / "run.csv")
        self.json_of("hil", scenario, "--record", log)
        self.json_of("replay", log, "--trace", self.folder / "log.csv", "--html", self.folder / "log.html")
        rows = [list(csv.DictReader((self.folder / name).read_text().splitlines())) for name in ("run.csv", "log.csv")]
        self.assertEqual(len(rows[0]), len(rows[1]))
        for run, logged in zip(*rows):
            for true, estimate in (("x_m", "est_x_m"), ("y_m", "est_y_m"), ("heading_rad", "est_heading_rad")):
                self.assertEqual(logged[true], run[estimate])
            # A wheel's speed is a whole number of counts of 0.2 mm per 10 ms.
            for wheel in ("v_left_mps", "v_right_mps"):
                self.assertAlmostEqual(float(logged[wheel]), float(run[wheel]), delta=0.03)
            for key in set(run) - {"x_m", "y_m", "heading_rad", "v_left_mps", "v_right_mps"}:
                self.assertEqual(logged[key], run[key], key)
        data = re.search(r'<script type="application/json" id="data">(.*?)</script>', (self.folder / "log.html").read_text(), re.S)[1]
        run = json.loads(data)["runs"][0]
        self.assertEqual((run["result"]["outcome"], run["result"]["hash"]), (result["outcome"].replace("off_goal", "reached"), result["hash"]))
        self.assertIsNone(run["result"]["final_distance_m"], "no log has the true place")
        self.assertAlmostEqual(run["result"]["believed_distance_m"], result["believed_distance_m"], places=4)
        self.assertEqual((run["planner"], run["inside"]), ("map", True))

    def test_a_replay_shows_the_map_that_led(self):
        scenario, log = self.world("rooms", 4), self.folder / "run.log"
        options = ("--planner", "map", "--map-bytes", 1024)
        self.json_of("run", scenario, *options, "--trace", self.folder / "run.csv", "--html", self.folder / "run.html")
        self.json_of("hil", scenario, *options, "--record", log, "--html", self.folder / "hil.html")
        self.json_of("replay", log, *options, "--trace", self.folder / "log.csv", "--html", self.folder / "log.html")
        led = [
            [(row["guide"], row["way_x_m"], row["way_y_m"]) for row in csv.DictReader((self.folder / name).read_text().splitlines())]
            for name in ("run.csv", "log.csv")
        ]
        self.assertEqual(*led)
        self.assertIn("place", {guide for guide, _, _ in led[0]})
        pages = [json.loads(re.search(r'id="data">(.*?)</script>', (self.folder / name).read_text(), re.S)[1])["runs"][0] for name in ("run.html", "log.html", "hil.html")]
        pictures = [[count for name, _, _, count in page["columns"] if name == "map_tick"] for page in pages]
        self.assertEqual(pictures[0], pictures[1])
        self.assertGreater(pictures[0][0], 20)
        self.assertEqual(pictures[2], pictures[0])
        for page in pages:
            self.assertEqual(page["map"], {"bytes": 1024, "columns": 32, "rows": 48, "cell": 0.125})

    def test_a_log_that_breaks_off_shows_what_there_is(self):
        log, page = self.folder / "run.log", self.folder / "page.html"
        self.json_of("hil", self.world("rooms"), "--record", log)
        lines = log.read_text().splitlines()
        log.write_text("\n".join(lines[: len(lines) // 2]) + "\n")
        self.assertTrue(self.json_of("replay", log, "--html", page)["same"])
        run = json.loads(re.search(r'id="data">(.*?)</script>', page.read_text(), re.S)[1])["runs"][0]
        self.assertEqual(run["result"]["outcome"], "gave_up")

    def test_a_replay_finds_altered_ranges(self):
        log = self.folder / "run.log"
        self.json_of("hil", self.world("discs", 8), "--record", log)
        lines = log.read_text().splitlines()
        ranges = [i for i, line in enumerate(lines) if " 139#" in line]
        for i in ranges[300:]:
            place, _, data = lines[i].partition("#")
            frame = bytearray.fromhex(data)
            frame[1] = frame[1] & 0x0F | 0x20  # too near
            frame[2:4] = b"\xfe\xff"
            frame[0] = crc(0x139, frame[1:])
            lines[i] = place + "#" + frame.hex().upper()
        log.write_text("\n".join(lines) + "\n")
        replay = self.json_of("replay", log)
        self.assertFalse(replay["same"])
        self.assertGreater(int(re.match(r"line (\d+)", replay["difference"])[1]), ranges[300])

    def test_damaged_frames_are_counted_not_replayed(self):
        log = self.folder / "run.log"
        self.json_of("hil", self.world("discs", 8), "--record", log)
        text = log.read_text() + "(1000000000.000000) can0 139#00FFFFFFFFFFFFFF\n(1000000000.000000) can0 139#01\n(1.000000) can0 00000123#R\n"
        log.write_text(text)
        replay = self.json_of("replay", log)
        self.assertEqual((replay["same"], replay["damaged"]), (True, 2))


class Precedence(Case):
    WORDS = "gets no real-time priority: Operation not permitted"
    AHEAD = "time_limit_s = 2.0\n[start]\nx_m = 0.0\ny_m = 0.0\n[goal]\nx_m = 200.0\ny_m = 0.0\n"

    def policies(self, *prefix, options):
        """(scheduling policies observed of the plant, its error output)."""
        scenario = self.file("ahead.toml", self.AHEAD)
        hil = subprocess.Popen(
            [*prefix, whisker.binary, "hil", scenario, *options], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
        )
        seen = set()
        while hil.poll() is None:
            seen.add(os.sched_getscheduler(hil.pid) & ~os.SCHED_RESET_ON_FORK)
            time.sleep(0.01)
        return seen, hil.communicate()[1]

    def test_ticks_in_time_go_before_other_processes_where_that_is_allowed(self):
        seen, said = self.policies(options=["--realtime"])
        self.assertEqual(os.SCHED_FIFO in seen, self.WORDS not in said)

    def test_where_it_is_not_the_run_goes_on_and_says_so(self):
        # Only root has this right; the test drops it.
        drop = ("setpriv", "--inh-caps=-sys_nice", "--bounding-set=-sys_nice") if os.geteuid() == 0 else ()
        seen, said = self.policies("prlimit", "--rtprio=0", *drop, options=["--realtime"])
        self.assertNotIn(os.SCHED_FIFO, seen)
        self.assertEqual(said.count(self.WORDS), 2, said)

    def test_lockstep_asks_for_nothing(self):
        seen, said = self.policies(options=[])
        self.assertNotIn(os.SCHED_FIFO, seen)
        self.assertNotIn("priority", said)


class View(OnABus):
    def test_who_is_watched_drives_the_same_way(self):
        scenario = self.world("u-trap", 10)
        alone = whisker.whisker("hil", scenario, "--json", "--trace", self.folder / "alone.csv")
        seen = whisker.whisker("hil", scenario, "--json", "--trace", self.folder / "seen.csv", "--view", 0)
        self.assertRegex(seen.stderr, r"(?m)^watch it at http://127\.0\.0\.1:\d+/$")
        self.assertNotIn("can watch", seen.stderr)
        results = [json.loads(done.stdout) for done in (alone, seen)]
        for result in results:
            del result["bus"]
        self.assertEqual(*results)
        self.assertEqual((self.folder / "alone.csv").read_bytes(), (self.folder / "seen.csv").read_bytes())

    def test_a_run_that_is_over_is_served_until_the_interruption(self):
        scenario = self.world("discs", 5)
        command = [whisker.binary, "hil", scenario, "--json", "--view", "0", "--view-stay"]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
            try:
                port = None
                for line in process.stderr:
                    port = int(m[1]) if (m := re.match(r"watch it at \S+:(\d+)/", line)) else port
                    if "can still be watched" in line:
                        break
                result = json.loads(process.stdout.readline())
                for _ in range(2):
                    server = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
                    server.request("GET", "/events")
                    events = re.findall(r"(?m)^data: (.*)$", server.getresponse().read().decode())
                    self.assertEqual(json.loads(events[-1])["result"]["hash"], result["hash"])
                process.send_signal(signal.SIGINT)
                self.assertEqual(process.wait(60), STATUS[result["outcome"]])
            finally:
                process.kill()

    def test_the_controller_does_not_hold_the_port(self):
        def sockets(process):
            folder = pathlib.Path(f"/proc/{process}/fd")
            files = {os.readlink(file) for file in folder.iterdir()}
            return {file for file in files if file.startswith("socket:")}

        command = [whisker.binary, "hil", self.world("rooms", 5), "--realtime", "--view", "0"]
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
            try:
                for line in process.stderr:
                    if ": drives" in line:
                        break
                (child,) = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
                self.assertTrue(sockets(child), "it has its end of the bus")
                self.assertFalse(sockets(child) & sockets(process.pid))
            finally:
                process.kill()

    def test_the_default_port_is_the_documented_one(self):
        done = whisker.whisker("hil", self.world("discs", 1), "--view")
        # Another program may use the port.
        self.assertIn("8765", done.stderr)

    def test_it_warns_where_others_can_watch(self):
        done = whisker.whisker("hil", self.world("discs", 1), "--view", 0, "--view-address", "0.0.0.0")
        self.assertRegex(done.stderr, r"(?m)^whoever can reach 0\.0\.0\.0 port \d+ can watch this run$")

    def test_a_page_of_a_run_on_a_bus_knows_what_this_computer_knows(self):
        page = self.folder / "page.html"
        whisker.whisker("hil", self.world("discs", 5), "--planner", "thesis", "--html", page)
        data = re.search(r'<script type="application/json" id="data">(.*?)</script>', page.read_text(), re.S)[1]
        run = json.loads(data)["runs"][0]
        self.assertEqual((run["planner"], run["inside"]), ("thesis", True))

    def test_what_cannot_be_served_is_refused_before_anything_starts(self):
        scenario = self.world("discs", 5)
        outputs = ("--trace", self.folder / "t.csv", "--record", self.folder / "r.log")

        def refused(*arguments, says):
            self.refused(*arguments, *outputs, says=says)

        with socket.create_server(("127.0.0.1", 0)) as taken:
            port = taken.getsockname()[1]
            refused("hil", scenario, "--view", port, says=f"port {port}: Address already in use")
            refused("plant", scenario, "--can", "slcan:nothing", "--view", port, says="Address already in use")
        for wrong in ("65536", "-1", "x", "1.5"):
            refused("hil", scenario, "--view", wrong, says=wrong)
        refused("hil", scenario, "--view", 0, "--view-address", "192.0.2.1", says="192.0.2.1")
        refused("hil", scenario, "--view", 0, "--view-address", "", says="--view")
        refused("hil", scenario, "--view-stay", says="--view")
        refused("hil", scenario, "--view-address", "127.0.0.1", says="--view")


class Refusals(Case):
    def refused(self, *arguments):
        done = whisker.whisker(*arguments)
        self.assertEqual((done.returncode, done.stdout), (2, ""), arguments)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        return done.stderr

    def test_bad_logs_are_one_line(self):
        self.assertIn("No such file", self.refused("replay", self.folder / "none.log"))
        self.assertIn("is empty", self.refused("replay", self.file("empty.log", "")))
        self.refused("replay", self.file("own.log", "x\n"), "--html", self.folder / "own.log")
        self.assertIn("bad.log:2:1: not a frame", self.refused("replay", self.file("bad.log", "(1.000000) can0 123#\nx\n")))
        self.assertIn("no commands", self.refused("replay", self.file("other.log", "(1.000000) can0 123#\n")))

    def test_bad_usage_is_one_line(self):
        scenario = self.file("s.toml", whisker.whisker("world", "discs", "--seed", 1).stdout)
        self.refused("plant", scenario)
        self.refused("controller")
        self.refused("controller", "--can", "vcan0", "--node", "8")
        self.refused("hil", scenario, "--can", "slcan:/dev/null")
        self.refused("hil", scenario, "--can", "a-name-that-is-too-long-for-an-interface")
        self.refused("hil", scenario, "--record", scenario)
        self.refused("hil", scenario, "--drop", "101")
        self.refused("dbc", "--robot", "0")
        self.assertIn("s.toml", self.refused("hil", self.file("s.toml", "x = 1\n")))


def crc(identifier, data):
    """The CRC of AUTOSAR E2E Profile 1, computed bit by bit."""
    value = 0
    for byte in (identifier & 0xFF, identifier >> 8, *data):
        value ^= byte
        for _ in range(8):
            value = (value << 1 ^ 0x1D if value & 0x80 else value << 1) & 0xFF
    return value


if __name__ == "__main__":
    whisker.main()
