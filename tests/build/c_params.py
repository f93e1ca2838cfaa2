"""The parameters of firmware/c/whisker.h are those of docs/protocol.md. --write writes them into the header.

usage: c_params.py ROOT [--write]
"""

import pathlib
import re
import sys

from sources import finish

HEADER, TABLE = "firmware/c/whisker.h", "docs/protocol.md"
ROW = re.compile(r"^\| (\d+) \| (\w+) \| ([^|]+) \|(?: (\d+|-\d+) \| (-?\d+)\.\.(-?\d+) \|| \| \|)$", re.MULTILINE)
BLOCK = re.compile(r"(  /\* params:begin \*/\n)(.*?)(  /\* params:end \*/\n)", re.DOTALL)
# The unit of the value 1, and the suffix of the key that it replaces.
SUFFIX = {"um": "_m", "um/s": "_mps", "um/s2": "_mps2", "urad/s": "_radps", "2^-32 turn": "_deg", "ms": "_s"}


def name(key, unit):
    own = [SUFFIX[unit]] if unit in SUFFIX else []
    ends = SUFFIX.values() if unit == "derived" else own
    suffix = next((end for end in ends if key.endswith(end)), "")
    return "WHISKER_PARAM_" + key.removesuffix(suffix).upper()


def lines(table):
    rows = ROW.findall(table)
    width = 1 + max(len(name(row[1], row[2])) for row in rows)
    for place, (index, key, unit, default, low, high) in enumerate(rows):
        if place != int(index):
            raise ValueError(f"{TABLE}: parameter {key} is the {place}th row and has the index {index}")
        comma = "," if place + 1 < len(rows) else ""
        about = "derived: cannot be set" if unit == "derived" else f"{unit}; {default}; {low} to {high}"
        yield f"  {name(key, unit) + comma:<{width}} /* {about} */\n"


def main(root, write=None):
    root = pathlib.Path(root)
    header = (root / HEADER).read_text()
    wanted = list(lines((root / TABLE).read_text()))
    written = BLOCK.sub(lambda m: m[1] + "".join(wanted) + m[3], header)
    if write:
        (root / HEADER).write_text(written)
        return 0
    problems = [] if written == header else [f"{HEADER}: its parameters are not those of {TABLE}: run scripts/documents"]
    return finish("parameters for C", len(wanted), problems)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
