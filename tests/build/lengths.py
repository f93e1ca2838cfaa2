"""Files stay small: median at most 100 lines, none above 400. usage: lengths.py ROOT"""

import pathlib
import statistics
import sys

from sources import finish, sources

MEDIAN, LONGEST = 100, 400


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
    return finish("file lengths", checked, problems)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
