"""Files stay small: median at most 100 lines, none above 400. Functions on the safety path have at most 20 branches.
usage: lengths.py ROOT"""

import pathlib
import re
import statistics
import sys

from sources import finish, sources

MEDIAN, LONGEST = 100, 400
SAFETY_PATH = ("firmware/safety", "firmware/perception", "firmware/chassis.cpp", "firmware/guard.cpp", "firmware/robot.cpp")
BRANCHES = 20
BRANCH = re.compile(r"\b(?:if|for|while|case)\b|&&|\|\||\?")
NO_CODE = re.compile(r'//[^\n]*|"(?:\\.|[^"\\])*"')
DEFINITION = re.compile(r"^[A-Za-z][^;{}=#]*\([^;{}]*\)[^;{}]*\{\n(.*?)^\}", re.MULTILINE | re.DOTALL)


def branches(text):
    """(first line, number of branches) of every function that is defined at the left margin."""
    for function in DEFINITION.finditer(NO_CODE.sub("", text)):
        yield function.group().split("\n")[0], len(BRANCH.findall(function.group(1)))


def main(root):
    problems, checked = [], 0
    for folder in ("firmware", "hal", "host"):
        lengths = {path: len(pathlib.Path(root, path).read_text().splitlines()) for path in sources(root, (folder,))}
        if not lengths:
            continue
        checked += len(lengths)
        median, longest = statistics.median(lengths.values()), max(lengths, key=lengths.get)
        print(f"{folder}: {len(lengths)} files, median {median:g} lines, longest {lengths[longest]} ({longest})")
        if median > MEDIAN:
            problems.append(f"{folder}: the median is {median:g} lines; at most {MEDIAN}")
        problems += [f"{path}: {n} lines; at most {LONGEST}" for path, n in lengths.items() if n > LONGEST]
    for path in sources(root, ("firmware",), (".cpp",)):
        if not str(path).startswith(SAFETY_PATH):
            continue
        for name, count in branches(pathlib.Path(root, path).read_text()):
            checked += 1
            if count > BRANCHES:
                problems.append(f"{path}: {name}: {count} branches; at most {BRANCHES}")
    return finish("lengths of files, branches of functions", checked, problems)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
