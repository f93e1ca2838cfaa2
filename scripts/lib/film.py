#!/usr/bin/env -S python3 -B
"""Drives the boundary planner through a U-trap and writes an animation of the drive, docs/film/u_trap.svg or FILE.

usage: scripts/lib/film.py [FILE]
The animated SVG also plays inside a web page; a viewer without animation shows the end of the drive.
Needs build/host/whisker, or the command in the environment variable WHISKER.
"""

import csv
import itertools
import math
import pathlib
import sys
import tomllib

from campaigns import ROOT, file_of, whisker

WORLD = ("u-trap", "--seed", "7")
BEAMS = (("left", 30, "#0b7f86"), ("front", 0, "#5f4bc4"), ("right", -30, "#b03a80"))
HALF_CONE = math.radians(12.5)
RADIUS, MAX_RANGE = 0.09, 2.0  # of the reference robot, m

WIDTH, HEIGHT, MARGIN = 760, 470, 26
CAPTION = 62  # px below the world
SPEED = 4.0  # times real time
FRAME = 0.2  # s of the drive per frame
HOLD = 2.0  # s that the last frame stays

LOOKS = {"free": ("#3487c4", 3), "table": ("#e69f00", 3.5), "probing": ("#1f1f1f", 3), "danger": ("#b3261e", 4)}
BOUNDARY = {"target_blocked", "exit_left", "exit_right", "edge", "opening", "way_back", "same_side"}
SAYS = {
    "surveying": "turns to both sides to scan the ground around it",
    "going": "drives towards the goal",
    "looking": "turns a beam onto unknown ground",
    "searching": "searches both sides for a clear heading, because the path is blocked",
    "skirting": "follows the boundary until it is nearer to the goal than ever before",
    "arrived": "is at the goal: three rangefinders, the boundary planner without a map",
}


def doing(row):
    """The activity that the path's colour shows."""
    if row["t"] != "0" or row["state"] in ("searching", "skirting"):
        return "danger"
    if row["state"] in ("going", "stepping"):
        return {"table": "table", "narrow": "probing"}.get(row["why"], "danger" if row["why"] in BOUNDARY else "free")
    return "free"


def number(x, digits=1):
    text = f"{x:.{digits}f}"
    text = text.rstrip("0").rstrip(".") if "." in text else text
    return "0" if text == "-0" else text


class Film:
    def __init__(self, scenario, rows):
        self.scenario, self.rows = scenario, rows
        self.x, self.y, t = ([float(row[key]) for row in rows] for key in ("x_m", "y_m", "t_s"))
        self.goal = (scenario["goal"]["x_m"], scenario["goal"]["y_m"])
        self.solids = [polygon["points"] for polygon in scenario.get("polygon", [])]
        x, y = zip(*(p for solid in self.solids for p in solid), self.goal, *zip(self.x, self.y))
        left, right, low, high = min(x) - 0.2, max(x) + 0.2, min(y) - 0.2, max(y) + 0.25
        self.scale = min((WIDTH - 2 * MARGIN) / (right - left), (HEIGHT - CAPTION - MARGIN) / (high - low))
        self.middle = ((left + right) / 2, (low + high) / 2)
        # The ticks shown.
        last = len(rows) - 1
        self.frames = [*range(0, len(rows), round(FRAME / (t[1] - t[0]))), *[last] * (1 + round(HOLD * SPEED / FRAME))]

    def at(self, x, y):
        return WIDTH / 2 + (x - self.middle[0]) * self.scale, (HEIGHT - CAPTION) / 2 - (y - self.middle[1]) * self.scale

    def pair(self, x, y):
        return ",".join(map(number, self.at(x, y)))

    def animate(self, attribute, values, kind="animate", more=""):
        seconds = number(len(self.frames) * FRAME / SPEED, 2)
        return f'<{kind} attributeName="{attribute}" {more}dur="{seconds}s" repeatCount="indefinite" values="{";".join(values)}"/>'

    def moved(self, kind, values):
        return self.animate("transform", values, "animateTransform", f'type="{kind}" ')

    def group(self, kind, values):
        yield from (f'<g transform="{kind}({values[-1]})">', self.moved(kind, values))

    def world(self):
        for solid in self.solids:
            yield f'<polygon points="{" ".join(self.pair(*p) for p in solid)}" fill="#d3d3d0" stroke="#6f6f6c"/>'
        goal, start = self.at(*self.goal), self.at(self.x[0], self.y[0])
        (gx, gy), radius = map(number, goal), number(self.scenario["goal"]["tolerance_m"] * self.scale)
        yield f'<path d="M{self.pair(self.x[0], self.y[0])}L{gx},{gy}" stroke="#8a8a86" stroke-dasharray="1 5" fill="none"/>'
        yield f'<circle cx="{gx}" cy="{gy}" r="{radius}" fill="#00795c" fill-opacity=".2" stroke="#00795c" stroke-width="2"/>'
        for word, (x, y), dy, colour in (("goal", goal, 28, "#00755a"), ("start", start, -18, "#5b5d58")):
            yield f'<text x="{number(x)}" y="{number(y + dy)}" text-anchor="middle" font-weight="600" fill="{colour}">{word}</text>'

    def path(self):
        for what, group in itertools.groupby(range(len(self.rows) - 1), lambda i: doing(self.rows[i + 1])):
            ticks = list(group)
            ticks.append(ticks[-1] + 1)
            way = {ticks[0]: 0.0}
            for a, b in zip(ticks, ticks[1:]):
                way[b] = way[a] + math.hypot(self.x[b] - self.x[a], self.y[b] - self.y[a])
            total = way[ticks[-1]]
            if total < 0.005:
                continue
            # The thinned polyline looks the same; its lengths are between the points kept. One dash as long as the section, moved
            # along it; the gap is at least as long.
            line = "L".join(self.pair(self.x[i], self.y[i]) for k, i in enumerate(ticks) if k % 8 == 0 or i == ticks[-1])
            dash, (colour, width) = math.ceil(total * self.scale) + 1, LOOKS[what]
            left = [number(dash * (1 - way[min(max(i, ticks[0]), ticks[-1])] / total)) for i in self.frames]
            drawn = f'<path d="M{line}" fill="none" stroke="{colour}" stroke-width="{width}" stroke-dasharray="{dash} {dash}" stroke-linejoin="round">'
            yield f"{drawn}{self.animate('stroke-dashoffset', left)}</path>"

    def ranges(self, name):
        """Pixels at each frame; a missing reading repeats the last one."""
        last = MAX_RANGE
        for i in self.frames:
            last = float(self.rows[i][f"{name}_m"] or last)
            yield number(max(last * self.scale, 1), 0)

    def robot(self):
        yield from self.group("translate", [self.pair(self.x[i], self.y[i]) for i in self.frames])
        yield from self.group("rotate", [number(-math.degrees(float(self.rows[i]["heading_rad"]))) for i in self.frames])
        x, y = math.cos(HALF_CONE), math.sin(HALF_CONE)
        for name, axis, colour in BEAMS:
            sizes = list(self.ranges(name))
            cone = f'<path d="M0,0L{x:.4f},{-y:.4f}A1,1 0 0 1 {x:.4f},{y:.4f}Z" fill="{colour}" fill-opacity=".25" transform="scale({sizes[-1]})">'
            yield f'<g transform="rotate({-axis})">{cone}{self.moved("scale", sizes)}</path></g>'
        body, nose = number(RADIUS * self.scale), number(0.85 * RADIUS * self.scale)
        yield f'<circle r="{body}" fill="#1b1c1a" stroke="#fff"/><path d="M2,0H{nose}" stroke="#fff" stroke-width="2.5"/></g></g>'

    def words(self):
        """The current activity."""
        said = [SAYS[self.rows[i]["state"]] for i in self.frames]
        for says in dict.fromkeys(said):
            seen = [int(other == says) for other in said]
            keys = [k for k in range(len(seen)) if k == 0 or seen[k] != seen[k - 1]]
            more = f'calcMode="discrete" keyTimes="{";".join(number(k / len(seen), 4) for k in keys)}" '
            moves = self.animate("opacity", [str(seen[k]) for k in keys], more=more)
            yield f'<text x="{MARGIN}" y="{HEIGHT - 34}" font-size="16" font-weight="600" opacity="{seen[-1]}">The robot {says}.{moves}</text>'

    def gauge(self):
        """The distance to the goal, and the smallest so far."""
        away = [math.hypot(x - self.goal[0], y - self.goal[1]) for x, y in zip(self.x, self.y)]
        scale, x0, y, nearest = 330 / max(away), 250, HEIGHT - 20, list(itertools.accumulate(away, min))
        widths, marks = ([number(x + of[i] * scale) for i in self.frames] for of, x in ((away, 0), (nearest, x0)))
        yield f'<text x="{MARGIN}" y="{y + 9}" fill="#5b5d58">distance to the goal; line: nearest so far</text>'
        yield f'<rect x="{x0 + 30}" y="{y}" width="{widths[-1]}" height="10" rx="2" fill="#3487c4">{self.animate("width", widths)}</rect>'
        mark = f'<rect x="{marks[-1]}" y="{y - 4}" width="3" height="18" fill="#b3261e">'
        yield f'<g transform="translate(30)">{mark}{self.animate("x", marks)}</rect></g>'

    def svg(self):
        yield (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}" '
            'role="img" font-family="Inter, system-ui, sans-serif" font-size="13" fill="#1b1c1a">'
        )
        yield f"<title>A robot finds its way out of a U-trap (whisker world {' '.join(WORLD)}), {number(SPEED)} times as fast</title>"
        yield f'<rect width="{WIDTH}" height="{HEIGHT}" rx="8" fill="#fbfbf9" stroke="#d5d6d0"/>'
        yield f'<clipPath id="world"><rect width="{WIDTH}" height="{HEIGHT - CAPTION}" rx="8"/></clipPath><g clip-path="url(#world)">'
        yield from (*self.world(), *self.path(), *self.robot(), "</g>")
        yield from (f'<path d="M0,{HEIGHT - CAPTION}H{WIDTH}" stroke="#d5d6d0"/>', *self.words(), *self.gauge(), "</svg>")


def main(file=ROOT / "docs/film/u_trap.svg"):
    world, trace = file_of(""), file_of("")
    whisker("world", *WORLD, "--out", world)
    whisker("run", world, "--planner", "skirt", "--trace", trace)
    with trace.open(newline="") as rows:
        text = "\n".join(Film(tomllib.loads(world.read_text()), list(csv.DictReader(rows))).svg()) + "\n"
    pathlib.Path(file).parent.mkdir(parents=True, exist_ok=True)
    pathlib.Path(file).write_text(text, encoding="utf-8")
    print(f"{file}: {len(text.encode())} bytes")


if __name__ == "__main__":
    if len(sys.argv) > 2 or "--help" in sys.argv or "-h" in sys.argv:
        print(__doc__.strip())
        sys.exit(0 if "--help" in sys.argv or "-h" in sys.argv else 2)
    main(*sys.argv[1:])
