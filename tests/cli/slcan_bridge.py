"""A CAN bus: adapters on Unix sockets that pass every frame to all others (SLCAN: docs/protocol.md)."""

import contextlib
import os
import pathlib
import pty
import socket
import threading
import tty

PATIENCE_S = 240
ANSWER = b"t1018"  # WheelCommand of the controller of robot 1
MODE, TICK = slice(7, 8), slice(17, 21)  # of that line
VELOCITY = b"t0C1"  # of the operator of robot 1


class Terminal:
    """The far end of a pseudo terminal, as a socket has it; a node opens `path`."""

    def __init__(self):
        # The near end stays open here, too: otherwise the far end fails while no node has it.
        self.far, self.near = pty.openpty()
        tty.setraw(self.near)
        self.line = threading.Lock()
        self.path = os.ttyname(self.near)

    def recv(self, room):
        return os.read(self.far, room)

    def sendall(self, data):
        with self.line:
            while data:
                data = data[os.write(self.far, data) :]

    def close(self):
        os.close(self.near)
        os.close(self.far)


class Bridge:
    """`slcan:<path>` of each path is one place on the bus, for one node after the other. Ends with close()."""

    def __init__(self, *paths):
        self.ends = [None] * len(paths)
        self.places = [pathlib.Path(path).name for path in paths]
        self.came = [0] * len(paths)
        self.changed = threading.Condition()
        self.paced = None
        self.owes = False
        self.answered = b""
        self.listeners = []
        for index, path in enumerate(paths):
            listener = socket.socket(socket.AF_UNIX)
            listener.bind(str(path))
            listener.listen(1)
            self.listeners.append(listener)
            threading.Thread(target=self.serve, args=(index, listener), daemon=True).start()

    @contextlib.contextmanager
    def arrives(self, place):
        """Ends when the node that is started within is on the bus: it receives every frame from then on."""
        index = self.places.index(place)
        before = self.came[index]
        yield
        with self.changed:
            assert self.changed.wait_for(lambda: self.came[index] > before, PATIENCE_S), f"{place} does not come onto the bus"

    def pace(self, operator, base):
        """The base waits for the operator as it does, in lockstep, for the controller: its next frame passes when a
        Velocity came after the answer before, or the operator has gone. A lockstep without it is as fast as the
        computer, and an operator that is held up would miss all of it."""
        self.paced = self.places.index(operator), self.places.index(base)

    def terminal(self, place):
        """One more place on the bus, which is a serial device; its path."""
        end = Terminal()
        self.join(end, place)
        return end.path

    def join(self, end, place=""):
        """One more node, at the other side of this line."""
        self.places.append(place)
        self.came.append(0)
        self.ends.append(end)
        threading.Thread(target=self.carry, args=(len(self.ends) - 1, end), daemon=True).start()

    def serve(self, index, listener):
        while True:
            try:
                end, _ = listener.accept()
            except OSError:
                return
            self.ends[index] = end
            self.carry(index, end)
            with self.changed:
                self.ends[index] = None
                self.changed.notify_all()
            end.close()

    def carry(self, index, end):
        rest = b""
        while data := self.receive(end):
            *lines, rest = (rest + data).split(b"\r")
            for line in lines:
                if line.startswith(b"t"):
                    self.keep_pace(index, line)
                    for other, to in enumerate(self.ends):
                        if other != index:
                            self.send(to, line + b"\r")
                elif line in (b"S6", b"O"):
                    self.send(end, b"\r")
                    self.count(index, line)

    def keep_pace(self, index, line):
        if self.paced is None:
            return
        operator, base = self.paced
        with self.changed:
            if index == base:
                self.changed.wait_for(lambda: not self.owes or self.ends[operator] is None, PATIENCE_S)
            elif line.startswith(ANSWER) and line[MODE] == b"1" and line[TICK] != self.answered:
                self.owes, self.answered = True, line[TICK]
            elif line.startswith(VELOCITY):
                self.owes = False
                self.changed.notify_all()

    def count(self, index, line):
        with self.changed:
            self.came[index] += line == b"O"
            self.changed.notify_all()

    @staticmethod
    def receive(end):
        try:
            return end.recv(65536)
        except OSError:
            return b""

    @staticmethod
    def send(end, data):
        """A frame to an end that is not there, or gone, is lost, as on a bus."""
        try:
            if end is not None:
                end.sendall(data)
        except OSError:
            pass

    def close(self):
        for listener in self.listeners:
            # Wakes the thread that accepts.
            listener.shutdown(socket.SHUT_RDWR)
            listener.close()
        for end in self.ends:
            if end is not None:
                end.close()
