"""A CAN adapter that is not there: text lines on a Unix socket or a pseudo terminal, as docs/protocol.md has them."""

import os
import pathlib
import select
import socket
import termios
import time
import tty


class Silence(Exception):
    """What was waited for did not come in its time."""


class Adapter:
    """Plays the adapter for one computer. Every wait has an end."""

    PATIENCE_S = 20  # for a line that takes no more

    def __init__(self):
        self.file = None
        self.buffer = b""

    def wait(self, seconds):
        """Until something may have come, or for so long."""
        select.select([self.file], [], [], max(0, seconds))

    def frames(self):
        """(identifier, data) of the frames that have come; commands are answered."""
        try:
            self.buffer += os.read(self.file, 65536)
        except BlockingIOError:
            return
        except OSError as error:
            raise Silence(f"the other end is gone: {error}") from error
        *lines, self.buffer = self.buffer.split(b"\r")
        for line in lines:
            if line[:1] == b"t":
                yield int(line[1:4], 16), bytes.fromhex(line[5:].decode())
            elif line[:1] in (b"S", b"O"):
                self.write(b"\r")

    def send(self, frames):
        lines = (f"t{identifier:03X}{len(data)}{data.hex().upper()}\r" for identifier, data in frames)
        self.write("".join(lines).encode())

    def write(self, data):
        end = time.monotonic() + self.PATIENCE_S
        while data:
            try:
                data = data[os.write(self.file, data) :]
            except BlockingIOError:
                if time.monotonic() > end:
                    raise Silence("the line takes no more") from None
                select.select([], [self.file], [], 1)


class SocketAdapter(Adapter):
    """At a Unix socket on which it listens; one computer at a time."""

    def __init__(self, path):
        super().__init__()
        self.path = pathlib.Path(path)
        self.listener = socket.socket(socket.AF_UNIX)
        self.listener.bind(str(path))
        self.listener.listen(1)

    def open(self, patience_s):
        self.listener.settimeout(patience_s)
        try:
            self.line, _ = self.listener.accept()
        except TimeoutError:
            raise Silence("no computer at the socket") from None
        self.line.setblocking(False)
        self.file = self.line.fileno()


class PtyAdapter(Adapter):
    """At a pseudo terminal, whose name it makes known by a link."""

    def __init__(self, path):
        super().__init__()
        self.path = pathlib.Path(path)
        self.file, self.other = os.openpty()
        tty.setraw(self.other, termios.TCSANOW)
        os.set_blocking(self.file, False)
        self.path.symlink_to(os.ttyname(self.other))

    def open(self, patience_s):
        """A terminal is always there; who comes says so by itself."""
