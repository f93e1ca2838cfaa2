"""Every header compiles alone, and twice. usage: headers_alone.py ROOT CXX FLAG..."""

import sys

from compile import compile_all
from sources import finish, sources


def main(root, compiler, *flags):
    headers = sources(root, ("firmware", "hal", "host"), (".hpp",))
    command = [compiler, "-std=c++17", f"-I{root}", *flags, "-fsyntax-only", "-x", "c++", "-"]
    jobs = [(header.as_posix(), command, f'#include "{header}"\n' * 2) for header in headers]
    problems = [f"{name} does not compile alone:\n{output}" for name, output in compile_all(jobs) if output]
    return finish("headers alone", len(headers), problems)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
