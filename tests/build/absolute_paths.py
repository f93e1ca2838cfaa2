"""No source contains a machine-specific path. usage: absolute_paths.py ROOT"""

import pathlib
import re
import sys

from sources import FOLDERS, finish, sources

# A literal that starts like a path of at least two parts.
PATH = re.compile(r"""["'<]/([A-Za-z0-9_.]+)/[^"'>\n]*["'>]""")

PLACES = {"Users", "etc", "home", "media", "mnt", "opt", "root", "srv", "tmp", "usr", "var"}


def errors(text, root="/"):
    """(line, literal) of every path that starts in a machine-specific folder or in this checkout."""
    places = PLACES | set(pathlib.Path(root).resolve().parts[1:2]) - set(FOLDERS)
    return [
        (text.count("\n", 0, match.start()) + 1, match.group())
        for match in PATH.finditer(text)
        if match.group(1) in places
    ]


def main(root):
    files = sources(root, FOLDERS, (".hpp", ".cpp", ".txt", ".cmake"))
    problems = [
        f"{path}:{line}: {literal}: an absolute path"
        for path in files
        for line, literal in errors(pathlib.Path(root, path).read_text(), root)
    ]
    return finish("absolute paths", len(files), problems)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
