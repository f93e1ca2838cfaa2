"""Finds the project's C++ files in the folders, so that a new file is checked from its first build."""

import pathlib

FOLDERS = ("firmware", "hal", "host", "tests")
SUFFIXES = (".hpp", ".cpp")


def sources(root, folders=FOLDERS, suffixes=SUFFIXES):
    """Paths relative to root, sorted, without fixtures, which are wrong on purpose."""
    root = pathlib.Path(root)
    found = [
        path.relative_to(root)
        for folder in folders
        for path in (root / folder).rglob("*")
        if path.suffix in suffixes and "fixtures" not in path.parts
    ]
    return sorted(found)


def core_sources(root, suffix=".cpp"):
    """The files of the core: those that a chip's program includes or links, without the programs."""
    return [path for path in sources(root, ("firmware",), (suffix,)) if path.parts[1] != "apps"]


def finish(name, checked, problems):
    """Prints the verdict and returns the exit status. An empty check is a failure."""
    for problem in problems:
        print(problem)
    if not checked:
        print(f"{name}: nothing to check: wrong root?")
        return 1
    print(f"{name}: {checked} checked, {len(problems)} wrong")
    return 1 if problems else 0
