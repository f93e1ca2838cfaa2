"""A robot with two driven wheels, encoders and three rangefinders in a world of discs and walls. Lengths are in metres."""

import collections
import dataclasses
import math
import tomllib

# The reference robot: what the parameters of docs/protocol.md have as defaults.
RADIUS, TRACK = 0.09, 0.14
COUNTS_PER_M = 5000
PERIOD_S = 0.01
MOTOR_LAG_S = 0.05
SIDE_ANGLE, HALF_CONE = math.radians(30), math.radians(12.5)
NEAREST, FARTHEST = 0.02, 2.0
TICKS_PER_READING, TICKS_OF_LATENCY = 2, 2  # 50 Hz, 20 ms
STEPS = 10  # of the kinematics in a control period
GYRO_RADPS = 8.726646  # rate of a sample of 32768; one sample in a control period, 100 Hz

OK, CLEAR, TOO_NEAR, INVALID, STALE = range(5)


@dataclasses.dataclass(frozen=True)
class Disc:
    x: float
    y: float
    radius: float

    def distance(self, x, y):
        return math.hypot(self.x - x, self.y - y) - self.radius

    def seen(self, x, y, axis):
        """The nearest distance in a cone around the axis, or infinity."""
        away = math.hypot(self.x - x, self.y - y)
        off = abs(turn(math.atan2(self.y - y, self.x - x) - axis))
        if off <= HALF_CONE:
            return away - self.radius
        # Along the cone's edge that is nearer to the disc.
        aside = away * math.sin(off - HALF_CONE)
        if off - HALF_CONE >= math.pi / 2 or aside > self.radius:
            return math.inf
        return away * math.cos(off - HALF_CONE) - math.sqrt(self.radius**2 - aside**2)


@dataclasses.dataclass(frozen=True)
class Wall:
    x: float
    y: float
    to_x: float
    to_y: float

    def nearest(self, x, y):
        ux, uy = self.to_x - self.x, self.to_y - self.y
        t = ((x - self.x) * ux + (y - self.y) * uy) / (ux * ux + uy * uy)
        t = min(1, max(0, t))
        return self.x + t * ux, self.y + t * uy

    def distance(self, x, y):
        near_x, near_y = self.nearest(x, y)
        return math.hypot(near_x - x, near_y - y)

    def seen(self, x, y, axis):
        inside = [
            math.hypot(px - x, py - y)
            for px, py in (self.nearest(x, y), (self.x, self.y), (self.to_x, self.to_y))
            if abs(turn(math.atan2(py - y, px - x) - axis)) <= HALF_CONE
        ]
        return min([*inside, self.along(x, y, axis - HALF_CONE), self.along(x, y, axis + HALF_CONE)])

    def along(self, x, y, heading):
        """Where a ray meets it."""
        dx, dy = math.cos(heading), math.sin(heading)
        ux, uy = self.to_x - self.x, self.to_y - self.y
        cross = dx * uy - dy * ux
        if cross == 0:
            return math.inf
        away = ((self.x - x) * uy - (self.y - y) * ux) / cross
        t = ((self.x - x) * dy - (self.y - y) * dx) / cross
        return away if away >= 0 and 0 <= t <= 1 else math.inf


def walls(points):
    return [Wall(*a, *b) for a, b in zip(points, points[1:])]


def turn(angle):
    """The same angle between -pi and pi."""
    return math.remainder(angle, 2 * math.pi)


@dataclasses.dataclass
class World:
    start: tuple  # x, y, heading
    goal: tuple  # x, y, tolerance
    things: list

    @classmethod
    def load(cls, path):
        """Start, goal, discs, walls and polygons of a scenario file (docs/scenario.md)."""
        with open(path, "rb") as file:
            text = tomllib.load(file)
        start, goal = text["start"], text["goal"]
        things = [Disc(*disc["center"], disc["radius_m"]) for disc in text.get("disc", [])]
        for wall in text.get("wall", []):
            things += walls(wall["points"])
        for polygon in text.get("polygon", []):
            things += walls([*polygon["points"], polygon["points"][0]])
        heading = math.radians(start.get("heading_deg", 0))
        return cls(
            (start["x_m"], start["y_m"], heading), (goal["x_m"], goal["y_m"], goal.get("tolerance_m", 0.1)), things
        )

    def clearance(self, x, y):
        return min((thing.distance(x, y) for thing in self.things), default=math.inf)

    def range(self, x, y, axis):
        return min((thing.seen(x, y, axis) for thing in self.things), default=math.inf)


@dataclasses.dataclass(frozen=True)
class Reading:
    status: int
    mm: int  # 0 unless status is OK
    age_ms: int
    sequence: int


class Robot:
    """Steps by control periods. What it measures at a tick comes before the command of that tick takes hold."""

    def __init__(self, world):
        self.world = world
        self.x, self.y, self.heading = world.start
        self.speeds = [0.0, 0.0]  # left, right
        self.ways = [0.0, 0.0]
        self.commands = [0.0, 0.0]
        self.tick = 0
        self.gyro_sum = 0  # of one sample for each tick
        self.least_clearance = world.clearance(self.x, self.y)
        self.measured = collections.deque()  # (tick, sequence, distances), oldest first

    def command(self, left, right):
        """Rims' speeds in 0.1 mm/s."""
        self.commands = [left * 1e-4, right * 1e-4]

    def counts(self):
        return [math.floor(way * COUNTS_PER_M) % (1 << 24) for way in self.ways]

    def gyro(self):
        """Sum of the samples, and their number."""
        return self.gyro_sum, self.tick

    def ranges(self):
        """Left, front, right."""
        if self.tick % TICKS_PER_READING == 0 and (not self.measured or self.measured[-1][0] != self.tick):
            axes = (self.heading + SIDE_ANGLE, self.heading, self.heading - SIDE_ANGLE)
            distances = [self.world.range(self.x, self.y, axis) for axis in axes]
            self.measured.append((self.tick, self.tick // TICKS_PER_READING % 16, distances))
        while len(self.measured) > 1 and self.measured[1][0] + TICKS_OF_LATENCY <= self.tick:
            self.measured.popleft()
        tick, sequence, distances = self.measured[0]
        if tick + TICKS_OF_LATENCY > self.tick:
            return [Reading(STALE, 0, 255, 0)] * 3
        age_ms = round((self.tick - tick) * PERIOD_S * 1000)
        return [self.reading(distance, age_ms, sequence) for distance in distances]

    @staticmethod
    def reading(distance, age_ms, sequence):
        if distance > FARTHEST:
            return Reading(CLEAR, 0, age_ms, sequence)
        if distance < NEAREST:
            return Reading(TOO_NEAR, 0, age_ms, sequence)
        return Reading(OK, round(distance * 1000), age_ms, sequence)

    def advance(self):
        """One control period."""
        dt, heading = PERIOD_S / STEPS, self.heading
        for _ in range(STEPS):
            for i in (0, 1):
                self.speeds[i] += (self.commands[i] - self.speeds[i]) * dt / MOTOR_LAG_S
                self.ways[i] += self.speeds[i] * dt
            forward, turning = sum(self.speeds) / 2, (self.speeds[1] - self.speeds[0]) / TRACK
            middle = self.heading + turning * dt / 2
            self.x += forward * dt * math.cos(middle)
            self.y += forward * dt * math.sin(middle)
            self.heading += turning * dt
        self.gyro_sum += round((self.heading - heading) / PERIOD_S / GYRO_RADPS * 32768)
        self.tick += 1
        self.least_clearance = min(self.least_clearance, self.world.clearance(self.x, self.y))

    def touched(self):
        return self.least_clearance < RADIUS

    def distance_to_goal(self):
        return math.hypot(self.world.goal[0] - self.x, self.world.goal[1] - self.y)


def micrometres(metres):
    return round(metres * 1e6)


def binary_angle(radians):
    return round(radians / (2 * math.pi) * 2**32) % 2**32


OUTCOMES = ("none", "running", "reached", "unreachable", "gave_up")


@dataclasses.dataclass
class Run:
    """What became of a mission."""

    outcome: str = "none"
    fault: int = 0
    hash: int = 0xCBF29CE484222325  # of the commands, FNV-1a 64 over left and right, 2 bytes each, little-endian

    def add(self, outcome, fault, left, right):
        self.outcome, self.fault = OUTCOMES[outcome], fault
        for byte in left.to_bytes(2, "little", signed=True) + right.to_bytes(2, "little", signed=True):
            self.hash = (self.hash ^ byte) * 0x100000001B3 % 2**64

    def over(self):
        return self.fault != 0 or OUTCOMES.index(self.outcome) >= 2

    def report(self, robot):
        return {
            "outcome": self.outcome,
            "fault": self.fault,
            "touched": robot.touched(),
            "ticks": robot.tick,
            "seconds": round(robot.tick * PERIOD_S, 2),
            "distance_to_goal_m": round(robot.distance_to_goal(), 3),
            "least_clearance_m": round(robot.least_clearance, 3) if robot.world.things else None,
            "hash": f"{self.hash:016x}",
        }
