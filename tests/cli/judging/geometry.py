"""Distances in the plane, metres. Points are (x, y)."""

import math

NOTHING = math.inf


def to_segment(p, a, b):
    """Distance from a point to a segment."""
    ux, uy = b[0] - a[0], b[1] - a[1]
    vx, vy = p[0] - a[0], p[1] - a[1]
    square = ux * ux + uy * uy
    t = min(1.0, max(0.0, (vx * ux + vy * uy) / square)) if square > 0 else 0.0
    return math.hypot(vx - t * ux, vy - t * uy)


def inside(p, polygon):
    """Whether the point is inside, by the even-odd rule."""
    odd = False
    for (ax, ay), (bx, by) in zip(polygon, polygon[1:] + polygon[:1]):
        if (ay > p[1]) != (by > p[1]) and p[0] < ax + (p[1] - ay) * (bx - ax) / (by - ay):
            odd = not odd
    return odd


class Cone:
    """All points whose bearing from the apex lies within `half` of `direction`, rad; half < 90 degrees.

    The nearest point of an obstacle within the cone is the obstacle's nearest point, if that is in the cone;
    otherwise it lies where the obstacle crosses one of the cone's two edges.
    """

    def __init__(self, apex, direction, half):
        self.x, self.y = apex
        self.axis = (math.cos(direction), math.sin(direction))
        self.cosine = math.cos(half)
        self.edges = [(math.cos(direction + s * half), math.sin(direction + s * half)) for s in (-1, 1)]

    def _holds(self, qx, qy, distance):
        return qx * self.axis[0] + qy * self.axis[1] >= distance * self.cosine

    def to_disc(self, center, radius):
        qx, qy = center[0] - self.x, center[1] - self.y
        d = math.hypot(qx, qy)
        if d <= radius:
            return 0.0
        if self._holds(qx, qy, d):
            return d - radius
        best = NOTHING
        for ex, ey in self.edges:
            along, off = qx * ex + qy * ey, qx * ey - qy * ex
            if along > 0 and abs(off) <= radius:
                best = min(best, along - math.sqrt(radius * radius - off * off))
        return best

    def to_segment(self, a, b):
        ax, ay, bx, by = a[0] - self.x, a[1] - self.y, b[0] - self.x, b[1] - self.y
        ux, uy = bx - ax, by - ay
        square = ux * ux + uy * uy
        t = min(1.0, max(0.0, -(ax * ux + ay * uy) / square)) if square > 0 else 0.0
        nx, ny = ax + t * ux, ay + t * uy
        d = math.hypot(nx, ny)
        if self._holds(nx, ny, d):
            return d
        best = NOTHING
        for x, y in ((ax, ay), (bx, by)):
            d = math.hypot(x, y)
            if d < best and self._holds(x, y, d):
                best = d
        for ex, ey in self.edges:
            across = ex * uy - ey * ux
            if across:
                along = (ax * uy - ay * ux) / across
                at = (ax * ey - ay * ex) / across
                if 0 <= along < best and 0 <= at <= 1:
                    best = along
        return best
