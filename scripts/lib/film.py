#!/usr/bin/env -S python3 -B
"""Drives the boundary planner through a U-trap and writes an animation of the drive, docs/film/u_trap.svg or FILE.

usage: scripts/lib/film.py [FILE]
The animated SVG also plays inside a web page; a viewer without animation shows the end of the drive.
Needs build/host/whisker, or the command in the environment variable WHISKER.
"""

import csv
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORLD = ("u-trap", "--seed", "7")
BEAMS = (("left", 30, "#0b7f86"), ("front", 0, "#5f4bc4"), ("right", -30, "#b03a80"))
HALF_CONE = 12.5  # degrees
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
    "arrived": "is at the goal: no map, three rangefinders",
}


def drive():
    """(scenario, rows of the trace)"""
    whisker = os.environ.get("WHISKER", str(ROOT / "build/host/whisker"))
    with tempfile.TemporaryDirectory() as folder:
        world, trace = f"{folder}/world.toml", f"{folder}/trace.csv"
        subprocess.run([whisker, "world", *WORLD, "--out", world], check=True, stdout=subprocess.DEVNULL)
        subprocess.run([whisker, "run", world, "--planner", "skirt", "--trace", trace], check=True, stdout=subprocess.DEVNULL)
        with open(world, "rb") as file:
            scenario = tomllib.load(file)
        with open(trace, newline="") as file:
            return scenario, list(csv.DictReader(file))


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
        self.x = [float(row["x_m"]) for row in rows]
        self.y = [float(row["y_m"]) for row in rows]
        self.t = [float(row["t_s"]) for row in rows]
        self.goal = (scenario["goal"]["x_m"], scenario["goal"]["y_m"])
        self.solids = [polygon["points"] for polygon in scenario.get("polygon", [])]
        corners = [p for solid in self.solids for p in solid] + [self.goal] + list(zip(self.x, self.y))
        left, right = min(p[0] for p in corners) - 0.2, max(p[0] for p in corners) + 0.2
        low, high = min(p[1] for p in corners) - 0.2, max(p[1] for p in corners) + 0.25
        self.scale = min((WIDTH - 2 * MARGIN) / (right - left), (HEIGHT - CAPTION - MARGIN) / (high - low))
        self.middle = ((left + right) / 2, (low + high) / 2)
        # The ticks shown, and the film's time as fractions of its length.
        step = round(FRAME / (self.t[1] - self.t[0]))
        shown = list(range(0, len(rows), step))
        self.frames = shown + [len(rows) - 1] * (1 + round(HOLD * SPEED / FRAME))
        self.seconds = len(self.frames) * FRAME / SPEED

    def at(self, x, y):
        return (
            WIDTH / 2 + (x - self.middle[0]) * self.scale,
            (HEIGHT - CAPTION) / 2 - (y - self.middle[1]) * self.scale,
        )

    def pair(self, x, y):
        return ",".join(map(number, self.at(x, y)))

    def line(self, ticks):
        return "M" + "L".join(self.pair(self.x[i], self.y[i]) for i in ticks)

    def animate(self, attribute, values, kind="animate", more=""):
        return (
            f'<{kind} attributeName="{attribute}" {more}dur="{number(self.seconds, 2)}s" repeatCount="indefinite" '
            f'values="{";".join(values)}"/>'
        )

    def world(self):
        parts = []
        for solid in self.solids:
            points = " ".join(self.pair(*p) for p in solid)
            parts.append(f'<polygon points="{points}" fill="#d3d3d0" stroke="#6f6f6c"/>')
        gx, gy = self.at(*self.goal)
        radius = self.scenario["goal"]["tolerance_m"] * self.scale
        start = self.at(self.x[0], self.y[0])
        line = f"M{number(start[0])},{number(start[1])}L{number(gx)},{number(gy)}"
        parts.append(f'<path d="{line}" stroke="#8a8a86" stroke-dasharray="1 5" fill="none"/>')
        parts.append(
            f'<circle cx="{number(gx)}" cy="{number(gy)}" r="{number(radius)}" fill="#00795c" fill-opacity=".2" stroke="#00795c" stroke-width="2"/>'
        )
        for word, (x, y), dy, colour in (("goal", (gx, gy), 28, "#00755a"), ("start", start, -18, "#5b5d58")):
            parts.append(
                f'<text x="{number(x)}" y="{number(y + dy)}" text-anchor="middle" font-weight="600" fill="{colour}">{word}</text>'
            )
        return parts

    def pieces(self):
        """(activity, ticks) of each section of the path."""
        pieces = []
        for i in range(len(self.rows) - 1):
            what = doing(self.rows[i + 1])
            if not pieces or pieces[-1][0] != what:
                pieces.append((what, [i]))
            pieces[-1][1].append(i + 1)
        return pieces

    def path(self):
        parts = []
        for what, ticks in self.pieces():
            way = {ticks[0]: 0.0}
            for a, b in zip(ticks, ticks[1:]):
                way[b] = way[a] + math.hypot(self.x[b] - self.x[a], self.y[b] - self.y[a])
            if way[ticks[-1]] < 0.005:
                continue
            # The thinned polyline looks the same; its lengths are between the points kept.
            kept = [i for k, i in enumerate(ticks) if k % 8 == 0 or i == ticks[-1]]
            total = way[ticks[-1]]
            # One dash as long as the section, moved along it; the gap is at least as long.
            dash = math.ceil(total * self.scale) + 1
            left = [dash * (1 - way[min(max(i, ticks[0]), ticks[-1])] / total) for i in self.frames]
            colour, width = LOOKS[what]
            parts.append(
                f'<path d="{self.line(kept)}" fill="none" stroke="{colour}" stroke-width="{width}" '
                f'stroke-dasharray="{dash} {dash}" stroke-linejoin="round">'
                + self.animate("stroke-dashoffset", map(number, left))
                + "</path>"
            )
        return parts

    def ranges(self, name):
        """Metres at each frame; a missing reading repeats the last one."""
        last, out = MAX_RANGE, []
        for i in self.frames:
            last = float(self.rows[i][f"{name}_m"] or last)
            out.append(last)
        return out

    def robot(self):
        places = [self.pair(self.x[i], self.y[i]) for i in self.frames]
        turns = [number(-math.degrees(float(self.rows[i]["heading_rad"]))) for i in self.frames]
        rim = (math.cos(math.radians(HALF_CONE)), math.sin(math.radians(HALF_CONE)))
        parts = [f'<g transform="translate({places[-1]})">', self.animate("transform", places, "animateTransform", 'type="translate" ')]
        parts += [f'<g transform="rotate({turns[-1]})">', self.animate("transform", turns, "animateTransform", 'type="rotate" ')]
        for name, axis, colour in BEAMS:
            sizes = [number(max(r * self.scale, 1), 0) for r in self.ranges(name)]
            parts.append(
                f'<g transform="rotate({-axis})"><path d="M0,0L{rim[0]:.4f},{-rim[1]:.4f}A1,1 0 0 1 {rim[0]:.4f},{rim[1]:.4f}Z" '
                f'fill="{colour}" fill-opacity=".25" '
                f'transform="scale({sizes[-1]})">'
                + self.animate("transform", sizes, "animateTransform", 'type="scale" ')
                + "</path></g>"
            )
        body = number(RADIUS * self.scale)
        nose = number(0.85 * RADIUS * self.scale)
        parts.append(f'<circle r="{body}" fill="#1b1c1a" stroke="#fff"/><path d="M2,0H{nose}" stroke="#fff" stroke-width="2.5"/></g></g>')
        return parts

    def words(self):
        """The current activity, and the smallest distance to the goal so far."""
        parts, spans = [], []
        for k, i in enumerate(self.frames):
            says = SAYS[self.rows[i]["state"]]
            if not spans or spans[-1][0] != says:
                spans.append([says, k, k])
            spans[-1][2] = k + 1
        y = HEIGHT - 34
        for says in dict.fromkeys(span[0] for span in spans):
            seen = [0] * len(self.frames)
            for other, first, end in spans:
                if other == says:
                    seen[first:end] = [1] * (end - first)
            keys = [k for k in range(len(seen)) if k == 0 or seen[k] != seen[k - 1]]
            times = ";".join(number(k / len(seen), 4) for k in keys)
            values = [str(seen[k]) for k in keys]
            more = f'calcMode="discrete" keyTimes="{times}" '
            parts.append(
                f'<text x="{MARGIN}" y="{y}" font-size="16" font-weight="600" opacity="{seen[-1]}">The robot {says}.'
                + self.animate("opacity", values, more=more)
                + "</text>"
            )
        return parts + self.gauge()

    def gauge(self):
        away = [math.hypot(x - self.goal[0], y - self.goal[1]) for x, y in zip(self.x, self.y)]
        scale = 330 / max(away)
        x0, y = 250, HEIGHT - 20
        widths = [number(away[i] * scale) for i in self.frames]
        nearest, least = [], float("inf")
        for row, d in zip(self.rows, away):
            least = min(least, d)
            nearest.append(least)
        marks = [number(x0 + nearest[i] * scale) for i in self.frames]
        return [
            f'<text x="{MARGIN}" y="{y + 9}" fill="#5b5d58">distance to the goal; line: nearest so far</text>',
            f'<rect x="{x0 + 30}" y="{y}" width="{widths[-1]}" height="10" rx="2" fill="#3487c4">'
            + self.animate("width", widths)
            + "</rect>",
            f'<g transform="translate(30)"><rect x="{marks[-1]}" y="{y - 4}" width="3" height="18" fill="#b3261e">'
            + self.animate("x", marks)
            + "</rect></g>",
        ]

    def svg(self):
        command = f"whisker world {' '.join(WORLD)}"
        parts = [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}" '
            'role="img" font-family="Inter, system-ui, sans-serif" font-size="13" fill="#1b1c1a">',
            f"<title>A robot finds its way out of a U-trap ({command}), {number(SPEED)} times as fast</title>",
            f'<rect width="{WIDTH}" height="{HEIGHT}" rx="8" fill="#fbfbf9" stroke="#d5d6d0"/>',
            f'<clipPath id="world"><rect width="{WIDTH}" height="{HEIGHT - CAPTION}" rx="8"/></clipPath><g clip-path="url(#world)">',
            *self.world(),
            *self.path(),
            *self.robot(),
            "</g>",
            f'<path d="M0,{HEIGHT - CAPTION}H{WIDTH}" stroke="#d5d6d0"/>',
            *self.words(),
            "</svg>",
        ]
        return "\n".join(parts) + "\n"


def main(file=ROOT / "docs/film/u_trap.svg"):
    path = pathlib.Path(file)
    text = Film(*drive()).svg()
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    print(f"{path}: {len(text.encode())} bytes")


if __name__ == "__main__":
    if len(sys.argv) > 2 or "--help" in sys.argv or "-h" in sys.argv:
        print(__doc__.strip())
        sys.exit(0 if "--help" in sys.argv or "-h" in sys.argv else 2)
    main(*sys.argv[1:])
