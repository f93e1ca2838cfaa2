"""The project's C++ files, found by walking the folders, so that a new file is checked from its first build on."""

import pathlib

FOLDERS = ("firmware", "hal", "host", "tests")
SUFFIXES = (".hpp", ".cpp")


def sources(root, folders=FOLDERS, suffixes=SUFFIXES):
    """Paths relative to root, sorted. Fixtures are wrong on purpose, and are left out."""
    root = pathlib.Path(root)
    found = [
        path.relative_to(root)
        for folder in folders
        for path in (root / folder).rglob("*")
        if path.suffix in suffixes and "fixtures" not in path.parts
    ]
    return sorted(found)


def core_sources(root, suffix=".cpp"):
    """Those of the core: what a chip's program includes or links, but no program."""
    return [path for path in sources(root, ("firmware",), (suffix,)) if path.parts[1] != "apps"]


def finish(name, checked, problems):
    """Prints the verdict and returns the exit status. Checking nothing is a failure."""
    for problem in problems:
        print(problem)
    if not checked:
        print(f"{name}: nothing to check: wrong root?")
        return 1
    print(f"{name}: {checked} checked, {len(problems)} wrong")
    return 1 if problems else 0
