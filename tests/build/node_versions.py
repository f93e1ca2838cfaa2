"""Every locked npm package works with Debian 12's own Node.js and npm. usage: node_versions.py ROOT

On a machine with a newer Node.js, other tests do not detect this, but scripts/test fails on a bare Debian.
"""

import json
import pathlib
import re
import sys

from sources import finish

DEBIAN_12 = {"node": (18, 20, 4), "npm": (9, 2, 0)}

VERSION = re.compile(r"v?(\d+|[xX*])(?:\.(\d+|[xX*]))?(?:\.(\d+|[xX*]))?(?:[-+][\w.+-]+)?$")
COMPARATOR = re.compile(r"(>=|<=|>|<|=|\^|~>?)?\s*(\S*)$")


def numbers(text):
    """The numbers in a version: none for "*", one for "18.x", at most three."""
    if text == "":
        return ()
    found = VERSION.match(text)
    if not found:
        raise ValueError(f"'{text}' is no version")
    stated = []
    for part in found.groups():
        if part is None or not part.isdigit():
            break
        stated.append(int(part))
    return tuple(stated)


def filled(stated):
    return stated + (0,) * (3 - len(stated))


def after(stated, kept):
    """The lowest version whose first `kept` numbers exceed the stated ones."""
    return filled((*stated[: kept - 1], stated[kept - 1] + 1))


def caret_keeps(stated):
    """How many leading numbers ^ keeps: up to and including the first that is not 0."""
    for place, number in enumerate(stated):
        if number:
            return place + 1
    return len(stated)


def comparator_holds(text, version):
    operator, operand = COMPARATOR.match(text).groups()
    stated = numbers(operand)
    if not stated:
        return operator not in ("<", ">")
    least, next_one = filled(stated), after(stated, len(stated))
    if operator == ">=":
        return version >= least
    if operator == "<":
        return version < least
    if operator == ">":
        return version >= next_one
    if operator == "<=":
        return version < next_one
    if operator == "^":
        return least <= version < after(stated, caret_keeps(stated))
    if operator in ("~", "~>"):
        return least <= version < after(stated, min(2, len(stated)))
    return least <= version < next_one


def satisfies(version, wanted):
    """Whether the version is in an npm range, for example "^18.18.0 || 20.x || >=22 <24"."""
    for alternative in wanted.split("||"):
        alternative = re.sub(r"(\S+)\s+-\s+(\S+)", r">=\1 <=\2", alternative.strip())
        alternative = re.sub(r"(>=|<=|>|<|=|\^|~>?)\s+", r"\1", alternative)
        if all(comparator_holds(part, version) for part in alternative.split() or ["*"]):
            return True
    return False


def errors(lock, text):
    """The problems of this package-lock.json."""
    packages = json.loads(text).get("packages")
    if not packages:
        return [f"{lock}: it lists no packages (npm's lock file version 2 or 3 does)"]
    problems = []
    for path, package in packages.items():
        name = f"{path.removeprefix('node_modules/') or 'the project'} {package.get('version', '')}".rstrip()
        for tool, wanted in package.get("engines", {}).items():
            if tool not in DEBIAN_12:
                continue
            try:
                fits = satisfies(DEBIAN_12[tool], wanted)
            except ValueError as error:
                problems.append(f"{lock}: {name} wants {tool} '{wanted}': {error}")
                continue
            if not fits:
                debian = ".".join(map(str, DEBIAN_12[tool]))
                problems.append(f"{lock}: {name} wants {tool} '{wanted}'; Debian 12 has {debian}")
    return problems


def main(root):
    files = pathlib.Path(root).glob("**/package-lock.json")
    places = [path for path in files if not {"node_modules", "build"} & set(path.relative_to(root).parts)]
    problems = [] if places else ["no package-lock.json"]
    for path in sorted(places):
        problems += errors(path.relative_to(root).as_posix(), path.read_text())
    return finish("npm packages for Debian 12", len(places), problems)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
