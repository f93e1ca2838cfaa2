"""The readings of three beams from the scan of a lidar. Written from docs/socket.md."""

import math


def readings(ranges, first_deg, step_deg, min_m, beams):
    """What each beam reads. ranges: of the rays, counter-clockwise, the first at first_deg from ahead, as REP 117 says: infinite is
    nothing within range, minus infinite or less than min_m too near, and no number a ray that failed.
    """

    def rays(beam):
        half = (beam["cone_deg"] + step_deg) / 2  # one ray beyond each edge, so that the cone has no bare rim
        return [
            r for i, r in enumerate(ranges) if abs(math.remainder(first_deg + i * step_deg - beam["angle_deg"], 360)) <= half
        ]

    return [sector(rays(beam), min_m) if len(rays(beam)) * step_deg >= beam["cone_deg"] else "invalid" for beam in beams]


def sector(rays, min_m):
    """Nothing is nearer in all of it: a ray that failed leaves a hole, and proves nothing of the rest."""
    if any(math.isnan(r) for r in rays):
        return "invalid"
    nearest = min(rays)
    return "too_near" if nearest < min_m else "clear" if nearest == math.inf else nearest
