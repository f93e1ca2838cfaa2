"""Reads a trace file into rows of numbers."""

import csv
from typing import NamedTuple, Optional

COLUMNS = "t_s x_m y_m heading_rad left_m front_m right_m v_left_mps v_right_mps state why".split()
COARSEST = {"x_m": 1e-4, "y_m": 1e-4, "heading_rad": 1e-4}  # resolution that the format guarantees


class TraceError(Exception):
    """The file is not a trace."""


class Row(NamedTuple):
    t: float
    x: float
    y: float
    heading: float
    ranges: tuple[Optional[float], ...]  # None: lost
    v_left: float
    v_right: float
    command: Optional[tuple[int, int]]  # 0.1 mm/s, left and right
    pressed: bool  # a bump switch

    @property
    def at(self):
        return self.x, self.y


class Trace:
    """`unit` of a column is the value of its last digit; the rounding error is at most half of it."""

    def __init__(self, rows, unit):
        self.rows, self.unit = rows, unit

    @property
    def position_unit(self):
        return max(self.unit["x_m"], self.unit["y_m"])


def unit_of(text):
    return 10.0 ** -len(text.partition(".")[2])


def numbered(fields, number):
    try:
        return Row(
            *(float(fields[c]) for c in COLUMNS[:4]),
            tuple(float(fields[c]) if fields[c] else None for c in COLUMNS[4:7]),
            *(float(fields[c]) for c in COLUMNS[7:9]),
            tuple(round(float(fields[f"cmd_{s}_mps"]) * 10000) for s in ("left", "right"))
            if "cmd_left_mps" in fields
            else None,
            int(fields.get("pressed", 0)) != 0,
        )
    except (TypeError, ValueError) as error:
        raise TraceError(f"row {number}: {error}") from error


def load(path):
    with open(path, newline="", encoding="utf-8") as file:
        reader = csv.DictReader(file)
        names = reader.fieldnames or []
        if names[: len(COLUMNS)] != COLUMNS:
            raise TraceError(f"the header begins with {names[: len(COLUMNS)]}, not {COLUMNS}")
        first, rows = None, []
        for number, fields in enumerate(reader):
            if None in fields or None in fields.values():
                raise TraceError(f"row {number}: not {len(names)} fields")
            first = first or fields
            rows.append(numbered(fields, number))
    if not rows:
        raise TraceError("no rows")
    unit = {c: unit_of(first[c]) for c in COLUMNS[:4] + COLUMNS[7:9]}
    for column, coarsest in COARSEST.items():
        if unit[column] > coarsest * 1.001:
            raise TraceError(f"{column} has too few digits")
    return Trace(rows, unit)
