"""docs/development.md names every folder of firmware/, hal/ and host/, optionally deeper ones, and none that does not exist. usage: layout.py ROOT"""

import pathlib
import re
import sys

from sources import finish

PAGE = "docs/development.md"
PARTS = ("firmware", "hal", "host")


def problems(root, text):
    for part in PARTS:
        row = re.search(rf"^\| `{part}/` \|(.*)\|$", text, re.MULTILINE)
        named = set(re.findall(r"`(\w+)/`", row[1])) if row else set()
        below = {path.name for path in pathlib.Path(root, part).rglob("*") if path.is_dir()}
        there = {path.name for path in pathlib.Path(root, part).iterdir() if path.is_dir()}
        for name in sorted(there - named):
            yield f"{PAGE}: {part}/{name}/ is not named"
        for name in sorted(named - below):
            yield f"{PAGE}: {part}/{name}/ is named and not there"


def main(root):
    found = list(problems(root, pathlib.Path(root, PAGE).read_text()))
    return finish("layout", len(PARTS), found)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
