"""Values to CAN frames and back: signals, counter and CRC, as docs/protocol.md has them."""

COUNTERS = 15
MOST_AHEAD = 8  # of the counter before; more is no successor


class BadFrame(Exception):
    """A frame that must not be obeyed."""


def crc8(data):
    crc = 0
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = (crc << 1 ^ 0x1D if crc & 0x80 else crc << 1) & 0xFF
    return crc


def fnv1a_32(data):
    value = 0x811C9DC5
    for byte in data:
        value = (value ^ byte) * 0x01000193 & 0xFFFFFFFF
    return value


def crc_of(identifier, data):
    return crc8(bytes([identifier & 0xFF, identifier >> 8]) + data[1:])


def _present(message, values):
    """The signals of a frame with these values: those of all parts, and of this one."""
    part = values.get("Part")
    return [s for s in message.signals if s.part is None or s.part == part]


def encode(message, node, counter, values):
    """(identifier, data)"""
    bits = counter << 8
    for s in _present(message, values):
        value = values.get(s.name, 0)
        if not s.least <= value <= s.most:
            raise ValueError(f"{message.name}.{s.name}: {value}")
        bits |= (value & (1 << s.length) - 1) << s.start
    data = bits.to_bytes(8, "little")[: message.size]
    identifier = message.function << 4 | node
    return identifier, bytes([crc_of(identifier, data)]) + data[1:]


def decode(message, identifier, data):
    """(counter, values). Raises BadFrame."""
    if len(data) != message.size or data[0] != crc_of(identifier, data):
        raise BadFrame(message.name)
    bits = int.from_bytes(data, "little")
    values = {}
    for s in message.signals:
        if s.part is not None and s.part != values.get("Part"):
            continue
        value = bits >> s.start & (1 << s.length) - 1
        if s.signed and value >> s.length - 1:
            value -= 1 << s.length
        if not s.least <= value <= s.most:
            raise BadFrame(f"{message.name}.{s.name}: {value}")
        values[s.name] = value
    return bits >> 8 & 0x0F, values


class Counters:
    """Those of the frames that are sent, and those that were heard."""

    def __init__(self):
        self.sent, self.heard = {}, {}

    def next(self, identifier):
        now = self.sent.get(identifier, 0)
        self.sent[identifier] = (now + 1) % COUNTERS
        return now

    def in_turn(self, identifier, counter):
        if counter >= COUNTERS:
            return False
        before = self.heard.get(identifier)
        self.heard[identifier] = counter if before is None or counter != before else before
        return before is None or 1 <= (counter - before) % COUNTERS <= MOST_AHEAD
