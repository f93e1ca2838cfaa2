"""The obstacles of a scenario: distance to the body, and the range that a rangefinder measures."""

import math

from .geometry import Cone, inside, to_segment

SLACK = 0.5  # m that the body may move before the nearby obstacles are collected again


def edges(points, closed):
    return list(zip(points, points[1:] + points[:1] if closed else points[1:]))


class World:
    def __init__(self, scenario):
        self.polygons = scenario.polygons
        self.movers = scenario.movers
        self.discs = scenario.discs
        self.segments = [e for p in scenario.polygons for e in edges(p, True)]
        self.segments += [e for w in scenario.walls for e in edges(w, False)]
        self.bounds = scenario.bounds
        if self.bounds:
            (x0, y0), (x1, y1) = self.bounds["min"], self.bounds["max"]
            self.segments += edges([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], True)
        robot = scenario.robot
        self.radius = robot["body_radius_m"]
        self.reach = robot["range_max_m"] + robot["range_offset_m"] + SLACK
        self.gathered_at = (math.inf, math.inf)

    @property
    def fastest(self):
        return max((m.speed for m in self.movers), default=0.0)

    def _gather(self, p):
        if math.dist(p, self.gathered_at) < SLACK:
            return
        self.gathered_at = p
        self.near_discs = [d for d in self.discs if math.dist(p, d[0]) - d[1] < self.reach]
        self.near_segments = [s for s in self.segments if to_segment(p, *s) < self.reach]

    def gap(self, p, t):
        """Gap between the body at p and the nearest obstacle; negative if they overlap."""
        self._gather(p)
        found = [math.dist(p, center) - radius for center, radius in self.near_discs]
        found += [to_segment(p, a, b) for a, b in self.near_segments]
        if not found:
            found = [math.dist(p, center) - radius for center, radius in self.discs]
            found += [to_segment(p, a, b) for a, b in self.segments]
        found += [math.dist(p, m.at(t)) - m.radius for m in self.movers]
        best = min(found, default=math.inf)
        if any(inside(p, polygon) for polygon in self.polygons):
            best = min(best, -best)
        if self.bounds:
            (x0, y0), (x1, y1) = self.bounds["min"], self.bounds["max"]
            best = min(best, p[0] - x0, x1 - p[0], p[1] - y0, y1 - p[1])
        return best - self.radius

    def range(self, p, direction, half, offset, t):
        """Range within the cone of a rangefinder at p with its apex `offset` ahead; infinite if nothing is in reach."""
        self._gather(p)
        cone = Cone((p[0] + offset * math.cos(direction), p[1] + offset * math.sin(direction)), direction, half)
        found = [cone.to_disc(center, radius) for center, radius in self.near_discs]
        found += [cone.to_segment(a, b) for a, b in self.near_segments]
        found += [cone.to_disc(m.at(t), m.radius) for m in self.movers]
        return min(found, default=math.inf)
