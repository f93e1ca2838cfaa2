"""`whisker socket`: the example of docs/integration/socket over TCP, UDP with a lost answer, standard input, and what it refuses."""

import json
import math
import pathlib
import re
import socket
import subprocess
import sys
import time

import whisker
from whisker import Case

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
EXAMPLES = ROOT / "docs/integration/socket"
sys.path.insert(0, str(EXAMPLES))
import sectors  # an example

HELLO = '{"whisker": 1, "goal": {"x_m": 1, "y_m": 0}}'
LINES = [HELLO, *(json.dumps({"t_s": i / 100, "range_m": ["clear"] * 3, "counts": [0, 0]}) for i in range(3))]


def by_standard_input(text):
    return subprocess.run([whisker.binary, "socket", "--stdio"], input=text.encode("latin-1"), capture_output=True, timeout=30,
                          check=False)


class Server:
    """The command, listening."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen([whisker.binary, "socket", *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True)

    def __enter__(self):
        self.port = int(re.fullmatch(r"listening on port (\d+)\n", self.process.stderr.readline())[1])
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.communicate()

    def end(self):
        out, err = self.process.communicate(timeout=20)
        return self.process.returncode, out, err


class Socket(Case):
    def test_the_examples_drive_to_the_goal(self):
        lidar = ["--robot", ROOT / "host/robots/owned/turtlebot3.toml"]
        for name, program, words, robot in (
            ("simulator.py", [sys.executable], [], []),
            ("simulator.py", [sys.executable], ["scan"], lidar),
            ("simulator.mjs", ["node"], [], []),
        ):
            with self.subTest(name, words=words), Server("--tcp", "0", "--json", *robot) as server:
                client = subprocess.run([*program, EXAMPLES / name, str(server.port), "3", *words], capture_output=True, text=True,
                                        timeout=120, check=False)
                self.assertEqual((client.returncode, client.stderr), (0, ""), client.stdout)
                status, out, err = server.end()
                self.assertEqual(status, 0, err)
                result = json.loads(out)
                self.assertEqual(result["outcome"], "reached")
                self.assertLess(result["believed_distance_m"], 0.1)
                self.assertIsNone(result["final_distance_m"], "the core does not know")

    def test_a_sector_reads_as_its_nearest_ray(self):
        beams = [{"angle_deg": a, "cone_deg": 10} for a in (30, 0, -30)]

        def read(rays):
            scan = [rays.get(deg, math.inf) for deg in range(360)]
            return sectors.readings(scan, 0, 1, 0.1, beams)

        self.assertEqual(read({}), ["clear"] * 3)
        self.assertEqual(read({25: 1.5, 35: 1.2, 355: 0.7, 330: 0.05}), [1.2, 0.7, "too_near"])
        self.assertEqual(read({23: 1, 37: 1, 90: 1}), ["clear"] * 3, "beside the sectors")
        self.assertEqual(read({28: math.nan, 5: -math.inf, 326: 0.4}), ["invalid", "too_near", 0.4])
        self.assertEqual(sectors.readings([1.0] * 10, 0, 1, 0.1, beams), ["invalid"] * 3, "half a sector")
        self.assertEqual(sectors.readings([1.0] * 11, -5, 1, 0.1, beams), ["invalid", 1.0, "invalid"])

    def test_udp_answers_a_repeated_line_again(self):
        with Server("--udp", "0") as server, socket.socket(type=socket.SOCK_DGRAM) as client:
            client.settimeout(10)
            client.connect(("127.0.0.1", server.port))

            def ask(line):
                client.send(line.encode())
                return client.recv(65536)

            ask(LINES[0])
            first = ask(LINES[1])
            self.assertEqual(ask(LINES[1]), first)
            self.assertNotEqual(ask(LINES[2]), first)
            client.send(b"")
            status, out, err = server.end()
            self.assertEqual((status, out), (4, ""), err)
            self.assertIn("running after 0.01 s, 4 lines", err)

    def test_udp_hears_the_first_sender_only(self):
        with Server("--udp", "0", "--timeout", "30") as server, socket.socket(type=socket.SOCK_DGRAM) as client, socket.socket(type=socket.SOCK_DGRAM) as other:
            for one in (client, other):
                one.settimeout(10)
                one.connect(("127.0.0.1", server.port))

            def ask(line):
                client.send(line.encode())
                return json.loads(client.recv(65536))

            def disturb():
                for line in (b"", b"wrong", HELLO.encode(), b'{"t_s": 0.5, "counts": [0, 0], "place": {"x_m": 20}}'):
                    other.send(line)

            client.send(b"")
            other.send(b"")
            ask(LINES[0])
            client.send(b"")
            for line in LINES[1:]:
                disturb()
                answer = ask(line)
                self.assertEqual((answer["t_s"], answer["pose"]["x_m"]), (json.loads(line)["t_s"], 0))
            disturb()
            client.send(b"")
            status, out, err = server.end()
            self.assertEqual((status, out), (4, ""), err)
            self.assertIn("running after 0.02 s, 4 lines", err)
            other.setblocking(False)
            self.assertRaises(OSError, other.recv, 65536)

    def test_an_address_that_others_reach_is_said(self):
        for kind in ("--tcp", "--udp"):
            with Server(kind, "0", "--timeout", "0.1", "--address", "0.0.0.0") as server:
                self.assertEqual(server.process.stderr.readline(), f"whoever can reach 0.0.0.0 port {server.port} can drive this robot\n")

    def test_what_a_client_says_does_not_act_on_the_terminal(self):
        done = by_standard_input('{"whisker":1,"\\u001b]0;owned\\u0007":1}\n')
        self.assertEqual((done.returncode, done.stderr), (2, b"whisker: line 1: unknown key '?]0;owned?'\n"))
        done = by_standard_input(HELLO + '\n{"range_m": ["\\u009b2J", 1, 1]}\n')
        self.assertTrue(done.stderr.endswith(b"but is '?2J'\n"), done.stderr)

    def test_standard_input_and_output(self):
        done = by_standard_input("\n".join(LINES) + "\n")
        answers = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertEqual([a.get("outcome") for a in answers], [None, "running", "running", "running"])
        self.assertEqual(answers[0]["whisker"], 1)
        self.assertEqual(done.returncode, 4, "no verdict yet")

    def test_a_wrong_line_is_answered_and_ends_it(self):
        longest = 65536
        long_line = HELLO + " " * (longest + 1 - len(HELLO)) + "\n"
        for text, says in ((HELLO + "\n" + '{"range": []}\n', "line 2: unknown key 'range'"), ("hello\n", "line 1: no JSON at byte 1"),
                           ("\xff\xfe{\n", "line 1: no JSON at byte 1"), (long_line, f"line 1: longer than {longest} bytes"),
                           (HELLO + "\n" + "x" * 70000, f"line 2: longer than {longest} bytes")):
            done = by_standard_input(text)
            self.assertEqual(done.returncode, 2)
            self.assertEqual(json.loads(done.stdout.splitlines()[-1]), {"error": says})
            self.assertEqual(done.stderr.decode(), f"whisker: {says}\n")

    def test_the_longest_line_is_read(self):
        done = by_standard_input(HELLO + " " * (65536 - len(HELLO)) + "\n" + LINES[1] + "\n")
        self.assertEqual([line.startswith(b'{"error') for line in done.stdout.splitlines()], [False, False], done.stderr)

    def test_the_answer_to_a_line_that_is_too_long_reaches_a_client_that_still_writes(self):
        with Server("--tcp", "0") as server, socket.create_connection(("127.0.0.1", server.port), timeout=10) as client:
            client.sendall(b"x" * 20_000_000 + b"\n")
            self.assertEqual(json.loads(client.makefile().readline()), {"error": "line 1: longer than 65536 bytes"})
            self.assertEqual(server.end()[0], 2)

    def test_the_answer_to_a_wrong_line_reaches_a_client_that_has_written_more(self):
        # TCP takes back what was not yet read if its end closes with bytes of the client unread.
        with Server("--tcp", "0") as server, socket.create_connection(("127.0.0.1", server.port), timeout=10) as client:
            client.sendall(b"wrong\n" + (HELLO + "\n").encode() * 2000)
            client.shutdown(socket.SHUT_WR)
            time.sleep(0.3)
            self.assertEqual(client.makefile().read(), '{"error":"line 1: no JSON at byte 1"}\n')
            self.assertEqual(server.end()[0], 2)

    def test_a_line_that_never_ends_is_answered_at_once_and_not_read_for_ever(self):
        with Server("--tcp", "0", "--timeout", "0.5") as server, socket.create_connection(("127.0.0.1", server.port), timeout=10) as client:
            client.sendall(b"x" * 70000)
            self.assertIn("longer than", client.makefile().readline())
            self.assertEqual(server.end()[0], 2)

    def test_the_verdict_of_a_session_without_an_outcome_says_what_is_so(self):
        lines = [HELLO, '{"t_s": 0, "counts": [0, 0]}', '{"t_s": 0.01, "counts": [0, 0], "cancel": true}']
        for text, says in (("\n".join(lines[:2]), "running after 0 s, 2 lines (goal_set)"),
                           ("\n".join(lines), "idle after 0.01 s, 3 lines (cancelled)"),
                           ('{"whisker": 1}\n' + lines[1], "idle after 0 s, 2 lines (no_goal)")):
            done = by_standard_input(text + "\n")
            self.assertEqual((done.returncode, done.stderr.decode()), (4, says + "\n"))

    def test_silence_ends_with_the_verdict_so_far(self):
        for kind in ("udp", "tcp"):
            with self.subTest(kind), Server(f"--{kind}", "0", "--timeout", "0.3", "--json") as server, \
                    socket.socket(type=socket.SOCK_DGRAM if kind == "udp" else socket.SOCK_STREAM) as client:
                client.settimeout(10)
                client.connect(("127.0.0.1", server.port))
                for line in LINES:
                    client.send(line.encode() + b"\n")
                    client.recv(65536)
                status, out, err = server.end()
                self.assertEqual((status, json.loads(out)["outcome"]), (1, "running"))
                self.assertRegex(err, r"\Awhisker: no line for 0.3 s\nrunning after 0.02 s, 4 lines \(\w+\)\n\Z")

    def test_every_wait_is_bounded(self):
        with Server("--tcp", "0", "--timeout", "0.2") as server:
            status, out, err = server.end()
            self.assertEqual((status, out), (1, ""))
            self.assertEqual(err, "whisker: nobody connected for 0.2 s\n")
        with Server("--tcp", "0", "--timeout", "0.3") as server, socket.create_connection(("127.0.0.1", server.port)) as client:
            client.sendall((HELLO + "\n").encode())
            self.assertIn(b'"whisker":1', client.recv(65536))
            self.assertEqual(server.end()[::2], (1, "whisker: no line for 0.3 s\n"))
        with Server("--tcp", "0", "--timeout", "0.5") as server, socket.create_connection(("127.0.0.1", server.port)) as client:
            for _ in range(20):
                if server.process.poll() is not None:
                    break
                client.sendall(b"{")
                time.sleep(0.2)
            self.assertIsNotNone(server.process.returncode)
            self.assertEqual(server.end()[::2], (1, "whisker: no line for 0.5 s\n"), "parts of a line are no line")

    def test_refusals(self):
        self.refused("socket", says="needs one of --tcp, --udp and --stdio")
        self.refused("socket", "--stdio", "--tcp", "1", says="needs one of")
        self.refused("socket", "--stdio", "--json", says="--json")
        self.refused("socket", "--tcp", "65536", says="--tcp")
        self.refused("socket", "--tcp", "0", "--address", "here", status=1, says="'here' is no IPv4 address")


if __name__ == "__main__":
    whisker.main()
