"""The wiring of the Raspberry Pi Pico robot, from the pin table of its drivers, hal/boards/pico/wiring.hpp.

usage: pico_wiring.py --write | --check    writes, or checks, docs/pico/wiring.svg and the table of docs/build-a-pico-robot.md
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PINS = ROOT / "hal/boards/pico/wiring.hpp"
PAGE = ROOT / "docs/build-a-pico-robot.md"
DRAWING = ROOT / "docs/pico/wiring.svg"
MARKS = ("<!-- pins:begin -->\n", "<!-- pins:end -->\n")

# Pico data sheet, figure 3: what is at the 40 pins of the board, from 1 on.
BOARD = """GP0 GP1 GND GP2 GP3 GP4 GP5 GND GP6 GP7 GP8 GP9 GND GP10 GP11 GP12 GP13 GND GP14 GP15
GP16 GP17 GND GP18 GP19 GP20 GP21 GND GP22 RUN GP26 GP27 GND GP28 VREF 3V3 3V3_EN GND VSYS VBUS""".split()

# Power: (part, terminal, name of the Pico's pin).
POWER = (
    ("VL53L0X, gyro", "VIN", "3V3"),
    ("left encoder", "VCC", "3V3"),
    ("right encoder", "VCC", "3V3"),
    ("battery, 5 V", "+", "VSYS"),
    ("HC-SR04", "VCC", "VSYS"),
    ("everything", "GND", "GND"),
)
COLOURS = ("#c0392b", "#2471a3", "#1e8449", "#9a7d0a", "#6c3483", "#b9770e", "#117a65", "#566573")


def wires():
    """[(number of the pin, part, terminal)], in the order of the table."""
    found = re.findall(r"inline constexpr Gpio k\w+ = (\d+);\s*///< (?!on the Pico)([^:\n]+): ([^\n]+)", PINS.read_text())
    return [(int(number), part, terminal) for number, part, terminal in found]


def board_pin(name):
    return BOARD.index(name) + 1


def table():
    rows = ["| part | terminal | Pico | pin of the board |", "|---|---|---|---|"]
    for gpio, part, terminal in wires():
        rows.append(f"| {part} | {terminal} | GP{gpio} | {board_pin(f'GP{gpio}')} |")
    for part, terminal, name in POWER:
        rows.append(f"| {part} | {terminal} | {name} | {'3, 8, 13, 18, 23, 28 or 38' if name == 'GND' else board_pin(name)} |")
    return "\n".join(rows) + "\n"


def position(pin):
    """(x, y, direction) of a pin of the board: 1 to 20 down the left side, 21 to 40 up the right side."""
    return (360, 60 + 22 * (pin - 1), -1) if pin <= 20 else (500, 60 + 22 * (40 - pin), 1)


def drawing():
    parts = list(dict.fromkeys(part for _, part, _ in wires()))
    lines = [
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 860 540" font-family="sans-serif" font-size="12">',
        '<rect width="860" height="540" fill="#ffffff"/>',
        '<rect x="350" y="34" width="160" height="476" rx="10" fill="#e8f5ee" stroke="#1e8449"/>',
        '<rect x="408" y="24" width="44" height="26" fill="#bdc3c7" stroke="#7f8c8d"/>',
        '<text x="430" y="530" text-anchor="middle">Raspberry Pi Pico; at the top, its USB: power, file, orders</text>',
    ]
    for i, name in enumerate(BOARD):
        x, y, side = position(i + 1)
        lines.append(f'<circle cx="{x}" cy="{y}" r="4" fill="#f4d03f" stroke="#7d6608"/>')
        anchor = "start" if side < 0 else "end"
        lines.append(f'<text x="{x - 10 * side}" y="{y + 4}" text-anchor="{anchor}" fill="#566573">{name}</text>')
    ends = [(f"GP{gpio}", part, terminal, COLOURS[parts.index(part) % len(COLOURS)]) for gpio, part, terminal in wires()]
    ends += [(name, part, terminal, "#000000") for part, terminal, name in POWER if name != "GND"]
    drawn = set()
    for name, part, terminal, colour in ends:
        x, y, side = position(board_pin(name))
        if name in drawn:
            continue
        drawn.add(name)
        same = [f"{p}: {t}" for n, p, t, _ in ends if n == name]
        lines.append(f'<line x1="{x + 5 * side}" y1="{y}" x2="{x + 60 * side}" y2="{y}" stroke="{colour}" stroke-width="2"/>')
        anchor = "end" if side < 0 else "start"
        text = ", ".join(same) if len(same) < 3 else f"{same[0]}; encoders: VCC"
        lines.append(f'<text x="{x + 66 * side}" y="{y + 4}" text-anchor="{anchor}" fill="{colour}">{text}</text>')
    lines.append('<text x="430" y="16" text-anchor="middle">Every part: its ground to a GND</text>')
    return "\n".join([*lines, "</svg>", ""])


def page():
    before, _, rest = PAGE.read_text().partition(MARKS[0])
    return before + MARKS[0] + table() + MARKS[1] + rest.partition(MARKS[1])[2]


def main(argv):
    texts = {PAGE: page(), DRAWING: drawing()}
    if argv == ["--write"]:
        DRAWING.parent.mkdir(exist_ok=True)
        for path, text in texts.items():
            path.write_text(text)
    elif argv == ["--check"]:
        wrong = [path for path, text in texts.items() if not path.is_file() or path.read_text() != text]
        for path in wrong:
            print(f"{path.relative_to(ROOT)} is not what {PINS.relative_to(ROOT)} says: scripts/documents")
        return 1 if wrong else 0
    else:
        print(__doc__.strip())
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
