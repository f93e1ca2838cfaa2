"""Starts processes on a CAN bus and observes their output and frames."""

import fcntl
import json
import os
import pathlib
import re
import signal
import socket
import struct
import subprocess
import tempfile
import threading
import time
import unittest

PATIENCE_S = 200  # for each step
WATCH_S = 0.02  # between two polls


def wait_until(condition, trouble):
    end = time.monotonic() + PATIENCE_S
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(trouble())
        time.sleep(WATCH_S)


class Interface:
    """A private virtual CAN interface, up from the constructor to close()."""

    def __init__(self, name):
        self.name = name
        self.add()

    def set(self, *arguments):
        done = subprocess.run(["ip", "link", *arguments], capture_output=True, text=True, timeout=PATIENCE_S, check=False)
        if done.returncode != 0:
            raise AssertionError(f"ip link {' '.join(arguments)}: {done.stderr.strip()}; under scripts/with-vcan?")

    def add(self):
        self.set("add", "dev", self.name, "type", "vcan")
        self.up()

    def up(self):
        self.set("set", self.name, "up")

    def down(self):
        self.set("set", self.name, "down")

    def remove(self):
        self.set("del", self.name)

    def close(self):
        # The test may have failed while the interface was down.
        subprocess.run(["ip", "link", "del", self.name], capture_output=True, timeout=PATIENCE_S, check=False)


class BusCase(unittest.TestCase):
    """A test beside processes of the program `whisker` on the interface `bus`."""

    whisker = None
    bus = None

    def setUp(self):
        box = tempfile.TemporaryDirectory(prefix="whisker-vcan-")
        self.addCleanup(box.cleanup)
        self.folder = pathlib.Path(box.name)
        self.interface = Interface(self.bus)
        self.addCleanup(self.interface.close)

    def once(self, *arguments):
        return subprocess.run([self.whisker, *map(str, arguments)], capture_output=True, text=True, timeout=PATIENCE_S, check=False)

    def start(self, *arguments):
        running = Running(self.whisker, *arguments)
        self.addCleanup(running.close)
        return running


class Valve:
    """A record written to a pipe: its writer continues only as far as the pipe is drained."""

    ROOM = 4096  # bytes: about a dozen ticks

    def __init__(self, path):
        os.mkfifo(path)
        self.pipe = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
        fcntl.fcntl(self.pipe, fcntl.F_SETPIPE_SZ, self.ROOM)

    def drip(self):
        try:
            os.read(self.pipe, self.ROOM)
        except BlockingIOError:
            pass

    def open(self):
        os.set_blocking(self.pipe, True)
        threading.Thread(target=self.drain, daemon=True).start()

    def drain(self):
        while os.read(self.pipe, self.ROOM):
            pass


class Running:
    """A process; tests can wait for its messages on standard error."""

    def __init__(self, *command):
        self.log = tempfile.TemporaryFile("w+")
        self.process = subprocess.Popen(list(map(str, command)), stdout=subprocess.PIPE, stderr=self.log, text=True)

    def words(self):
        self.log.seek(0)
        return self.log.read()

    def says(self, pattern):
        if re.search(pattern, self.words()):
            return True
        over = self.process.poll() is not None
        if over and not re.search(pattern, self.words()):
            raise AssertionError(f"it is over without {pattern!r}: {self.words()}")
        return over

    def wait_for(self, pattern, valve=None):
        def found():
            if self.says(pattern):
                return True
            if valve is not None:
                valve.drip()
            return False

        wait_until(found, lambda: f"no {pattern!r} in: {self.words()}")

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


def listeners(interface):
    """Sockets that receive every frame of the interface."""
    return len(re.findall(rf"{interface} .* raw$", pathlib.Path("/proc/self/net/can/rcvlist_all").read_text("ascii"), re.M))


class Candump:
    """A log of an interface from the constructor to end()."""

    LAST = "7FF#"  # no other node sends it

    def __init__(self, path, interface):
        self.path = path
        self.interface = interface
        before = listeners(interface)
        with open(path, "w", encoding="ascii") as file:
            # Line-buffered: a block buffer would hold back the last frame.
            self.process = subprocess.Popen(["stdbuf", "-oL", "candump", "-r", "4000000", "-L", interface], stdout=file)
        wait_until(lambda: listeners(interface) > before, lambda: "candump does not listen")

    def end(self):
        subprocess.run(["cansend", self.interface, self.LAST], check=True)
        wait_until(lambda: self.LAST in self.path.read_text("ascii"), lambda: "candump does not write")
        self.process.terminate()
        self.process.wait(PATIENCE_S)
        return [line for line in self.path.read_text("ascii").splitlines() if self.LAST not in line]


def frames_of(log_lines):
    return [line.split()[2] for line in log_lines]


class Meddler:
    """Answers every other frame on an interface with an invalid one that every node must ignore: with a wrong bit, one
    byte short, as a remote request, with a long identifier, and one that wins every arbitration. Exact copies are a
    different fault: a second node with the same identifiers."""

    FRAME = struct.Struct("<IB3x8s")

    def __init__(self, interface):
        self.bus = socket.socket(socket.PF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
        self.bus.bind((interface,))
        self.bus.settimeout(WATCH_S)
        self.said = 0
        self.over = False
        self.thread = threading.Thread(target=self.run)
        self.thread.start()

    @staticmethod
    def worse(identifier, size, data, how):
        wrong = bytearray(data)
        wrong[how % max(size, 1)] ^= 1 << how % 8
        return (
            (identifier, size, bytes(wrong)),
            (identifier, size - 1, data),
            (identifier | socket.CAN_RTR_FLAG, size, data),
            (identifier | socket.CAN_EFF_FLAG, size, data),
            (0, 8, data),
        )[how % 5]

    def run(self):
        heard = 0
        while not self.over:
            try:
                identifier, size, data = self.FRAME.unpack(self.bus.recv(self.FRAME.size))
            except TimeoutError:
                continue
            heard += 1
            if heard % 2 == 0 and size > 0:
                self.bus.send(self.FRAME.pack(*self.worse(identifier, size, data, self.said)))
                self.said += 1

    def end(self):
        self.over = True
        self.thread.join(PATIENCE_S)
        self.bus.close()
        return self.said
