"""A CAN bus: adapters on Unix sockets that pass every frame to all others (SLCAN: docs/protocol.md)."""

import os
import pty
import socket
import threading
import tty


class Terminal:
    """The far end of a pseudo terminal, as a socket has it; a node opens `path`."""

    def __init__(self):
        # The near end stays open here, too: otherwise the far end fails while no node has it.
        self.far, self.near = pty.openpty()
        tty.setraw(self.near)
        self.path = os.ttyname(self.near)

    def recv(self, room):
        return os.read(self.far, room)

    def sendall(self, data):
        while data:
            data = data[os.write(self.far, data) :]

    def close(self):
        os.close(self.near)
        os.close(self.far)


class Bridge:
    """`slcan:<path>` of each path is one place on the bus, for one node after the other. Ends with close()."""

    def __init__(self, *paths):
        self.ends = [None] * len(paths)
        self.listeners = []
        for index, path in enumerate(paths):
            listener = socket.socket(socket.AF_UNIX)
            listener.bind(str(path))
            listener.listen(1)
            self.listeners.append(listener)
            threading.Thread(target=self.serve, args=(index, listener), daemon=True).start()

    def terminal(self):
        """One more place on the bus, which is a serial device; its path."""
        end = Terminal()
        self.join(end)
        return end.path

    def join(self, end):
        """One more node, at the other side of this line."""
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
            self.ends[index] = None
            end.close()

    def carry(self, index, end):
        rest = b""
        while data := self.receive(end):
            *lines, rest = (rest + data).split(b"\r")
            for line in lines:
                if line.startswith(b"t"):
                    for other, to in enumerate(self.ends):
                        if other != index:
                            self.send(to, line + b"\r")
                elif line in (b"S6", b"O"):
                    self.send(end, b"\r")

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
