"""firmware/version.hpp, the newest release of CHANGELOG.md, CMake and the command state the same version.

usage: version.py ROOT CMAKE_VERSION [WHISKER]
"""

import pathlib
import re
import subprocess
import sys

from sources import finish

PARTS = ("MAJOR", "MINOR", "PATCH")


def of_header(text):
    return ".".join(re.search(rf"^#define WHISKER_VERSION_{part} (\d+)$", text, re.MULTILINE)[1] for part in PARTS)


def releases(changelog):
    """The versions in the headings, newest first."""
    return re.findall(r"^## \[(\d+\.\d+\.\d+)\] - \d{4}-\d\d-\d\d$", changelog, re.MULTILINE)


def problems(header, changelog, others):
    version = of_header(header)
    known = releases(changelog)
    if not re.search(r"^## \[Unreleased\]$", changelog, re.MULTILINE):
        yield "CHANGELOG.md: no heading [Unreleased]"
    if not known or known[0] != version:
        yield f"CHANGELOG.md: its newest release is {known[0] if known else 'none'}, firmware/version.hpp says {version}"
    if known != sorted(known, key=lambda v: [int(n) for n in v.split(".")], reverse=True):
        yield "CHANGELOG.md: its releases are not in order"
    for who, said in others.items():
        if said != version:
            yield f"{who} says {said}, firmware/version.hpp says {version}"


def main(root, of_cmake, command=None):
    root = pathlib.Path(root)
    others = {"CMake": of_cmake}
    if command:
        said = subprocess.run([command, "--version"], capture_output=True, text=True, check=True).stdout
        others["the command"] = said.split()[1]
    found = problems((root / "firmware/version.hpp").read_text(), (root / "CHANGELOG.md").read_text(), others)
    return finish("version", 1 + len(others), list(found))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
