"""The base of robot 1 on a CAN bus, as docs/protocol.md has it."""

import struct
import time

from document import Protocol
from frames import BadFrame, Counters, decode, encode, fnv1a_32
from slcan import Silence

CONTROLLER, BASE = 1, 9
HEARTBEAT_S, PEER_LOST_S, ORDER_REPEAT_S = 0.1, 0.3, 0.05
RESEND_S = 0.2  # a set without an answer
NAP_S = 0.02

WAITING, READY, RUNNING, SAFE_STOP, E_STOPPED = range(1, 6)
START, CANCEL, RESUME = range(3)
ACCEPTED, INCOMPLETE = 0, 1
READ, WRITE, COMMIT = range(3)
REAL_TIME, LOCKSTEP = 0, 1
COMMAND_LATE, PEER_LOST, PEER_STOPPED = 1 << 0, 1 << 3, 1 << 7  # of Errors


class Refused(Exception):
    """The controller does not want what it is told."""


class Base:
    def __init__(self, adapter, boot, patience_s):
        """patience_s: for anything that is waited for."""
        self.adapter, self.boot, self.patience_s = adapter, boot, patience_s
        self.protocol = Protocol()
        self.counters = Counters()
        self.began = time.monotonic()
        self.state, self.errors = WAITING, 0
        self.beat_at = self.peer_at = float("-inf")
        self.peer_boot = self.peer_hash_right = None
        self.peer_heard = False
        self.heard = {}  # message name: its last values
        self.mission = 0
        self.lockstep = True
        self.trouble = 0  # frames that were not obeyed

    # What it says.

    def frame(self, name, **values):
        message = self.protocol.messages[name]
        counter = self.counters.next(message.function << 4 | BASE)
        return encode(message, BASE, counter, values)

    def say(self, name, **values):
        self.adapter.send([self.frame(name, **values)])

    def beat(self):
        now = time.monotonic()
        self.beat_at = now
        uptime = int(now - self.began) % 256
        self.say("Heartbeat", State=self.state, Errors=self.errors, Boot=self.boot, Protocol=self.protocol.version, Uptime=uptime)

    def inform(self):
        self.beat()
        self.say("Info", Part=0, Boot=self.boot, TableHash=self.protocol.table_hash)
        self.say("Info", Part=1, Boot=self.boot, Version=0)

    def enter(self, state, errors=0):
        if (self.state, self.errors) != (state, errors):
            self.state, self.errors = state, errors
            self.beat()

    def stop(self, error):
        """A safe stop, latched until a new order."""
        if self.state == RUNNING:
            self.enter(SAFE_STOP, error)

    # What it hears.

    def poll(self, nap_s=NAP_S):
        """Waits a little for frames, obeys them, and lives on."""
        self.adapter.wait(nap_s)
        for identifier, data in self.adapter.frames():
            self.hear(identifier, data)
        now = time.monotonic()
        if self.peer_heard and now - self.peer_at > PEER_LOST_S:
            self.lose_peer()
        if now - self.beat_at >= HEARTBEAT_S:
            self.beat()

    def lose_peer(self):
        self.peer_heard = False
        self.counters.heard.clear()
        if self.state == READY:
            self.enter(WAITING)
        if not self.lockstep:
            self.stop(PEER_LOST)

    def matched(self):
        return self.peer_heard and self.peer_hash_right is True

    def hear(self, identifier, data):
        message = self.protocol.by_function.get(identifier >> 4)
        if identifier & 0x0F != CONTROLLER or message is None:
            return
        try:
            counter, values = decode(message, identifier, data)
        except BadFrame:
            self.trouble += 1
            return
        if not self.counters.in_turn(identifier, counter):
            self.trouble += 1
        elif message.name == "Heartbeat":
            self.hear_heartbeat(values)
        elif message.name == "Info":
            self.hear_info(values)
        elif message.name == "InfoRequest":
            self.inform()
        elif self.matched() and not values.get("Operator"):
            self.heard[message.name] = values

    def hear_heartbeat(self, values):
        if self.peer_boot not in (None, values["Boot"]):
            raise Silence("the controller started anew and has forgotten the mission")
        known = self.peer_heard
        self.peer_boot, self.peer_at, self.peer_heard = values["Boot"], time.monotonic(), True
        if values["Protocol"] != self.protocol.version:
            raise Refused(f"the controller speaks version {values['Protocol']}")
        if not known:
            self.inform()
        if self.peer_hash_right is None:
            self.say("InfoRequest")
        if values["State"] in (SAFE_STOP, E_STOPPED):
            self.stop(PEER_STOPPED)

    def hear_info(self, values):
        if values["Part"] != 0 or values["Boot"] != self.peer_boot:
            return
        self.peer_hash_right = values["TableHash"] == self.protocol.table_hash
        if not self.peer_hash_right:
            raise Refused(f"the controller has table {values['TableHash']:08X}")
        if self.state == WAITING:
            self.enter(READY)

    # What it waits for.

    def until(self, done, what, repeat=None, every_s=ORDER_REPEAT_S):
        """Polls until done() is not None, and repeats itself. Raises Silence."""
        end, again = time.monotonic() + self.patience_s, time.monotonic()
        while (result := done()) is None:
            if time.monotonic() > end:
                raise Silence(f"no {what} for {self.patience_s:g} s")
            if repeat and time.monotonic() >= again:
                again = time.monotonic() + every_s
                repeat()
            self.poll()
        return result

    def shake_hands(self):
        self.inform()
        self.until(lambda: True if self.matched() else None, "handshake")
        self.enter(READY)

    def ask(self, action, index=0, value=0):
        """(status, value) of a parameter request."""
        self.heard.pop("ParamReply", None)
        request = {"Action": action, "Index": index, "Value": value}

        def reply():
            said = self.heard.get("ParamReply")
            return said if said and said["Index"] == index else None

        said = self.until(reply, "ParamReply", lambda: self.say("ParamRequest", **request), 1)
        return said["Status"], said["Value"]

    def set_parameters(self, values):
        """name: raw value. Raises Refused."""
        for name, value in values.items():
            index = self.protocol.parameters[name].index
            if self.ask(WRITE, index, value & 0xFFFFFFFF) != (0, value):
                raise Refused(f"{name} = {value}")
        status, relation = self.ask(COMMIT, 255)
        if status:
            raise Refused(f"the parameters do not go together: relation {relation}")

    def give(self, order, values):
        """values: those of parts 1 to 6, raw."""
        self.mission = (self.mission + 1) % 256
        raw = b"".join(struct.pack("<I", value & 0xFFFFFFFF) for value in values)
        folded = fnv1a_32(raw)
        digest = (folded ^ folded >> 16) & 0xFFFF
        names = ("StartX", "StartY", "StartHeading", "GoalX", "GoalY", "GoalTolerance")

        def say():
            parts = [
                self.frame("Mission", Part=part, Mission=self.mission, **{name: value})
                for part, (name, value) in enumerate(zip(names, values), 1)
            ]
            parts.append(self.frame("Mission", Part=0, Mission=self.mission, Order=order, Digest=digest))
            self.adapter.send(parts)

        def reply():
            said = self.heard.get("MissionReply")
            return said["Status"] if said and said["Mission"] == self.mission and said["Status"] != INCOMPLETE else None

        status = self.until(reply, "MissionReply", say)
        if status != ACCEPTED:
            raise Refused(f"order {order}: status {status}")
        self.enter(READY if order == CANCEL else RUNNING)

    def send_set(self, tick, ranges, counts, period_ms, gyro=None):
        """gyro: sum and number of its samples; None: there is none."""
        names = ("RangeLeft", "RangeFront", "RangeRight")
        frames = [self.range(name, reading, tick) for name, reading in zip(names, ranges)]
        frames.append(self.frame("WheelState", Valid=1, Tick=tick % 8, Left=counts[0], Right=counts[1]))
        mode = LOCKSTEP if self.lockstep else REAL_TIME
        if gyro:
            total, samples = gyro
            frames.append(self.frame("Gyro", Valid=1, Tick=tick % 8, Sum=total % 2**24, Samples=samples % 65536, Saturated=0))
        sync = {"Mode": mode, "Gyro": 1 if gyro else 0, "Fix": 0}
        frames.append(self.frame("Sync", **sync, Tick=tick, Period=period_ms, Mission=self.mission))
        self.adapter.send(frames)

    def step(self, tick, ranges, counts, period_ms, gyro=None):
        """In lockstep: sends an input set; (left, right, outcome, fault) of the answer."""

        def answer():
            command, status = self.heard.get("WheelCommand"), self.heard.get("NavStatus")
            if not command or not status or command["Mode"] != 1:
                return None
            return (command, status) if command["Tick"] == status["Tick"] == tick % 65536 else None

        def say():
            self.send_set(tick, ranges, counts, period_ms, gyro)

        command, status = self.until(answer, f"answer to set {tick}", say, RESEND_S)
        return command["Left"], command["Right"], status["Outcome"], status["Fault"]

    def range(self, name, reading, tick):
        distance = {0: reading.mm, 1: 65535}.get(reading.status, 65534)
        values = {"Status": reading.status, "Distance": distance, "Age": reading.age_ms, "Sequence": reading.sequence}
        return self.frame(name, **values, Tick=tick % 65536)
