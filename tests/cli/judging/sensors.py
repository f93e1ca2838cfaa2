"""Checks the ranges against the scenario's obstacles."""

import math

ROUNDING = 0.0006  # m: rounding to the nearest millimetre, and the digits of the pose
GRAZE = 3e-5  # rad: an obstacle this close to a cone's edge may count as inside or outside; more between two rows
SIGMAS = 6.0
NAMES = ("left", "front", "right")


class Rangefinders:
    def __init__(self, scenario, world, trace):
        robot = scenario.robot
        self.world, self.rows = world, trace.rows
        self.period, self.rate, self.latency = (robot[k] for k in ("control_period_s", "range_rate_hz", "range_latency_s"))
        self.low, self.high, self.offset = robot["range_min_m"], robot["range_max_m"], robot["range_offset_m"]
        self.half = math.radians(robot["range_cone_deg"] / 2)
        side = math.radians(robot["range_side_angle_deg"])
        self.directions = (side, 0.0, -side)
        self.bend = robot["wheel_acceleration_max_mps2"] * self.period**2 / (4 * robot["wheel_track_m"])
        self.cache = (None, None)

    def newest(self, t):
        """Number of the newest measurement that arrived; negative before the first."""
        return math.floor((t - self.latency) * self.rate + 1e-6)

    def graze(self, k):
        """Uncertainty of the heading between two rows, interpolated at a constant turn rate."""
        where = k / self.rate / self.period
        return GRAZE + (0.0 if abs(where - round(where)) < 1e-6 else self.bend)

    def pose(self, k):
        where = k / self.rate / self.period
        i = min(math.floor(where + 1e-6), len(self.rows) - 1)
        a, b = self.rows[i], self.rows[min(i + 1, len(self.rows) - 1)]
        f = max(0.0, where - i)
        return tuple(u + f * (v - u) for u, v in ((a.x, b.x), (a.y, b.y), (a.heading, b.heading)))

    def exact(self, k, beam, widen=0.0):
        x, y, heading = self.pose(k)
        direction = heading + self.directions[beam]
        d = self.world.range((x, y), direction, self.half + widen, self.offset, k / self.rate)
        return min(self.high, max(self.low, d))

    def all_exact(self, k):
        """The three exact ranges; cached while the robot stands still in a world without movers."""
        key = self.pose(k) if not self.world.movers else k
        if key != self.cache[0]:
            self.cache = (key, [self.exact(k, beam) for beam in range(3)])
        return self.cache[1]


def agrees(finders, k, beam, value, exact, slack):
    if abs(value - exact) <= slack:
        return True
    graze = finders.graze(k)
    nearest, farthest = (finders.exact(k, beam, widen) for widen in (graze, -graze))
    return nearest - slack <= value <= farthest + slack


def check_ranges(scenario, world, trace):
    finders, noise = Rangefinders(scenario, world, trace), scenario.noise
    sigma, dropout, false_clear = (noise[k] for k in ("range_sigma_m", "range_dropout", "range_false_clear"))
    slack = ROUNDING + SIGMAS * sigma
    seen = lost = 0
    before = None
    for i, row in enumerate(trace.rows):
        k = finders.newest(row.t)
        if k < 0:
            if row.ranges != (None, None, None):
                yield f"row {i}: a range before the first measurement has arrived"
            continue
        fresh, before = k != before, k
        exact = finders.all_exact(k)
        for beam, value in enumerate(row.ranges):
            seen += fresh
            lost += fresh and value is None
            if value is None:
                if dropout == 0:
                    yield f"row {i}: {NAMES[beam]}: a lost reading without dropout"
            elif value == finders.high and (false_clear > 0 or exact[beam] + SIGMAS * sigma >= finders.high):
                continue
            elif not agrees(finders, k, beam, value, exact[beam], slack):
                yield f"row {i}: {NAMES[beam]}: {value:.4f} m, but the nearest thing in its cone was at {exact[beam]:.4f}"
    if abs(lost - seen * dropout) > 1 + 5 * math.sqrt(seen * dropout * (1 - dropout)):
        yield f"{lost} of {seen} readings lost at a dropout of {dropout}"
