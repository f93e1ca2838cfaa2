"""No source names a place on somebody's machine. usage: absolute_paths.py ROOT"""

import pathlib
import re
import sys

from sources import FOLDERS, finish, sources

# A literal that starts like a path of two parts or more; devices and kernel files are the same everywhere.
PATH = re.compile(r"""["'<]/(?!dev/|proc/|sys/)[A-Za-z0-9_.]+/[^"'>\n]*["'>]""")


def errors(text):
    """(line, literal) of every absolute path."""
    return [(text.count("\n", 0, match.start()) + 1, match.group()) for match in PATH.finditer(text)]


def main(root):
    files = sources(root, FOLDERS, (".hpp", ".cpp", ".txt", ".cmake"))
    problems = [
        f"{path}:{line}: {literal}: an absolute path"
        for path in files
        for line, literal in errors(pathlib.Path(root, path).read_text())
    ]
    return finish("absolute paths", len(files), problems)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
