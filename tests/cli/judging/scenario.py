"""A scenario file with its defaults filled in. SI units; angles in rad."""

import math
import tomllib

ROBOT = {
    "body_radius_m": 0.09,
    "wheel_track_m": 0.14,
    "wheel_speed_max_mps": 0.30,
    "wheel_acceleration_max_mps2": 1.0,
    "motor_lag_s": 0.05,
    "range_side_angle_deg": 30.0,
    "range_cone_deg": 25.0,
    "range_min_m": 0.02,
    "range_max_m": 2.0,
    "range_offset_m": 0.0,
    "range_rate_hz": 50,
    "range_latency_s": 0.02,
    "control_period_s": 0.01,
}
NOISE = {
    "range_sigma_m": 0.0,
    "range_dropout": 0.0,
    "range_false_clear": 0.0,
    "wheel_scale_sigma": 0.0,
    "heading_drift_deg_per_sqrt_m": 0.0,
    "wheel_scale_common_sigma": 0.0,
    "wheel_slip": 0.0,
}


class Mover:
    """A disc that moves along its path to and fro, from its centre's position on it, forwards first."""

    def __init__(self, table):
        self.radius, self.speed = table["radius_m"], table["speed_mps"]
        self.path = [tuple(p) for p in table["path"]]
        self.legs = [math.dist(a, b) for a, b in zip(self.path, self.path[1:])]
        self.length = sum(self.legs)
        self.start = self._arc_of(tuple(table["center"]))

    def _arc_of(self, p):
        best, before = (math.inf, 0.0), 0.0
        for a, b, leg in zip(self.path, self.path[1:], self.legs):
            t = ((p[0] - a[0]) * (b[0] - a[0]) + (p[1] - a[1]) * (b[1] - a[1])) / leg
            t = min(leg, max(0.0, t))
            foot = (a[0] + (b[0] - a[0]) * t / leg, a[1] + (b[1] - a[1]) * t / leg)
            best = min(best, (math.dist(p, foot), before + t))
            before += leg
        return best[1]

    def at(self, t):
        arc = (self.start + self.speed * t) % (2 * self.length)
        arc = min(arc, 2 * self.length - arc)
        for a, b, leg in zip(self.path, self.path[1:], self.legs):
            if arc <= leg:
                return a[0] + (b[0] - a[0]) * arc / leg, a[1] + (b[1] - a[1]) * arc / leg
            arc -= leg
        return self.path[-1]


class Scenario:
    def __init__(self, table, robot=None):
        start, goal = table["start"], table["goal"]
        self.start = (start["x_m"], start["y_m"])
        self.goal = (goal["x_m"], goal["y_m"])
        self.tolerance = goal.get("tolerance_m", 0.10)
        towards = math.atan2(self.goal[1] - self.start[1], self.goal[0] - self.start[0])
        self.heading = math.radians(start["heading_deg"]) if "heading_deg" in start else towards
        self.time_limit = table.get("time_limit_s", 600.0)
        self.discs = [(tuple(d["center"]), d["radius_m"]) for d in table.get("disc", [])]
        self.polygons = [[tuple(p) for p in shape["points"]] for shape in table.get("polygon", [])]
        self.walls = [[tuple(p) for p in wall["points"]] for wall in table.get("wall", [])]
        self.movers = [Mover(m) for m in table.get("mover", [])]
        self.bounds = table.get("bounds")
        self.noise = NOISE | table.get("noise", {})
        self.robot = ROBOT | table.get("robot", {}) | (robot or {})

    @property
    def odometry_is_exact(self):
        keys = ("wheel_scale_sigma", "wheel_scale_common_sigma", "wheel_slip", "heading_drift_deg_per_sqrt_m")
        return all(self.noise[key] == 0 for key in keys)


def load(path, robot_path=None):
    """robot_path: the file given to --robot, if any."""
    with open(path, "rb") as file:
        table = tomllib.load(file)
    robot = None
    if robot_path:
        with open(robot_path, "rb") as file:
            robot = tomllib.load(file)
        robot = robot.get("robot", {}) | {k: v for k, v in robot.items() if k != "robot"}
    return Scenario(table, robot)
