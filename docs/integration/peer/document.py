"""The tables of docs/protocol.md: the document is what this peer knows of Whisker."""

import dataclasses
import pathlib
import re

DOCS = pathlib.Path(__file__).resolve().parents[2]


def rows(text, *columns):
    """The rows of the table with this head, as tuples of texts."""
    head = "| " + " | ".join(columns) + " |\n"
    begin = text.index(head) + len(head)
    for line in text[begin:].splitlines()[1:]:
        if not line.startswith("|"):
            return
        yield tuple(cell.strip() for cell in line.strip("|").split("|"))


@dataclasses.dataclass(frozen=True)
class Signal:
    name: str
    part: int | None
    start: int
    length: int
    signed: bool
    least: int
    most: int


@dataclasses.dataclass(frozen=True)
class Message:
    name: str
    function: int
    size: int
    signals: tuple


@dataclasses.dataclass(frozen=True)
class Parameter:
    index: int
    default: int
    least: int
    most: int


def _signal(row):
    name, bits, sign, reach, _, _ = row
    named = re.fullmatch(r"(\w+)(?: \(part (\d+)\))?", name)
    start, end = map(int, bits.split(".."))
    least, most = map(int, reach.split(".."))
    return Signal(named[1], int(named[2]) if named[2] else None, start, end - start + 1, sign == "signed", least, most)


class Protocol:
    """The protocol on the CAN bus."""

    def __init__(self):
        text = (DOCS / "protocol.md").read_text()
        self.table_hash = int(re.search(r"The hash is `([0-9A-F]{8})`", text)[1], 16)
        self.version = int(re.search(r"Protocol is (\d+)\.", text)[1])
        self.messages = {}
        for name, function, _, _, _, size, _, _ in rows(
            text, "message", "function", "controller", "base", "operator", "bytes", "period", "meaning"
        ):
            section = text[text.index(f"\n### {name}\n") :]
            signals = rows(section, "signal", "bits", "sign", "raw range", "unit of 1", "meaning")
            self.messages[name] = Message(name, int(function, 16), int(size), tuple(map(_signal, signals)))
        self.by_function = {message.function: message for message in self.messages.values()}
        self.parameters = {}
        for index, name, unit, default, reach in rows(text, "index", "parameter", "unit of 1", "default", "range"):
            if unit == "derived":
                continue
            least, most = map(int, reach.split(".."))
            self.parameters[name] = Parameter(int(index), int(default), least, most)
        self.examples = [tuple(row) for row in rows(text, "what", "SLCAN")]
