"""`whisker socket`: the example of docs/integration/socket over TCP, UDP with a lost answer, standard input, and what it refuses."""

import json
import pathlib
import re
import socket
import subprocess
import sys

import whisker
from whisker import Case

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
EXAMPLES = ROOT / "docs/integration/socket"
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
        for name, program in (("simulator.py", [sys.executable]), ("simulator.mjs", ["node"])):
            with self.subTest(name), Server("--tcp", "0", "--json") as server:
                client = subprocess.run([*program, EXAMPLES / name, str(server.port), "3"], capture_output=True, text=True,
                                        timeout=120, check=False)
                self.assertEqual((client.returncode, client.stderr), (0, ""), client.stdout)
                status, out, err = server.end()
                self.assertEqual(status, 0, err)
                result = json.loads(out)
                self.assertEqual(result["outcome"], "reached")
                self.assertLess(result["believed_distance_m"], 0.1)
                self.assertIsNone(result["final_distance_m"], "the core does not know")

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
            self.assertIn("gave_up after 0.01 s, 4 lines", err)

    def test_standard_input_and_output(self):
        done = by_standard_input("\n".join(LINES) + "\n")
        answers = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertEqual([a.get("outcome") for a in answers], [None, "running", "running", "running"])
        self.assertEqual(answers[0]["whisker"], 1)
        self.assertEqual(done.returncode, 4, "no verdict yet")

    def test_a_wrong_line_is_answered_and_ends_it(self):
        for text, says in ((HELLO + "\n" + '{"range": []}\n', "line 2: unknown key 'range'"), ("hello\n", "line 1: no JSON"),
                           ("\xff\xfe{\n", "line 1: no JSON")):
            done = by_standard_input(text)
            self.assertEqual(done.returncode, 2)
            self.assertEqual(json.loads(done.stdout.splitlines()[-1]), {"error": says})
            self.assertEqual(done.stderr.decode(), f"whisker: {says}\n")

    def test_every_wait_is_bounded(self):
        with Server("--tcp", "0", "--timeout", "0.2") as server:
            status, out, err = server.end()
            self.assertEqual((status, out), (1, ""))
            self.assertEqual(err, "whisker: nobody connected for 0.2 s\n")
        with Server("--tcp", "0", "--timeout", "0.3") as server, socket.create_connection(("127.0.0.1", server.port)) as client:
            client.sendall((HELLO + "\n").encode())
            self.assertIn(b'"whisker":1', client.recv(65536))
            self.assertEqual(server.end()[::2], (1, "whisker: no line for 0.3 s\n"))

    def test_refusals(self):
        self.refused("socket", says="needs one of --tcp, --udp and --stdio")
        self.refused("socket", "--stdio", "--tcp", "1", says="needs one of")
        self.refused("socket", "--stdio", "--json", says="--json")
        self.refused("socket", "--tcp", "65536", says="--tcp")
        self.refused("socket", "--tcp", "0", "--address", "here", status=1, says="'here' is no IPv4 address")
        too_long = by_standard_input("x" * 70000)
        self.assertEqual((too_long.returncode, too_long.stderr), (1, b"whisker: a line of over 65536 bytes\n"))


if __name__ == "__main__":
    whisker.main()
