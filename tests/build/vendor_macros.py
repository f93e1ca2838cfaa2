"""The headers for chips compile after Arduino's macros, and in each language mode that other projects may choose. The
first compiler also compiles the sources as GNU's C++20, with WHISKER_LONG as C++17 too, without the macros.

usage: vendor_macros.py ROOT COMPILER... Each may have options: "arm-none-eabi-g++ -mcpu=cortex-m3 -mthumb".
"""

import pathlib
import re
import shlex
import sys

from compile import LONG, compile_all
from sources import core_sources, finish, sources

MODES = ("c++17", "gnu++17", "c++20", "gnu++20")
MACROS = pathlib.Path(__file__).parent / "fixtures/arduino_macros.hpp"
# Excluded: ports for Linux, and boards with their own register headers.
HOSTED = re.compile(r"hal/(ports/(socketcan|stdio|tty)|boards|emulated|runtime)/")
OPTIONS = ("-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fno-exceptions", "-fno-rtti", "-ffreestanding", "-fsyntax-only")


def public_headers(root):
    return [path.as_posix() for path in sources(root, ("firmware", "hal"), (".hpp",)) if not HOSTED.match(path.as_posix())]


def command(root, compiler, mode):
    return [*shlex.split(compiler), f"-std={mode}", f"-I{root}", *OPTIONS, "-x", "c++"]


def main(root, *compilers):
    headers = public_headers(root)
    text = f'#include "{MACROS}"\n' + "".join(f'#include "{header}"\n' for header in headers)
    jobs = [(f"{c}, {mode}", [*command(root, c, mode), "-"], text) for c in compilers for mode in MODES]
    for mode in ("gnu++17", "gnu++20") if LONG else ("gnu++20",):
        for source in core_sources(root):
            jobs.append((f"{source}, {mode}", [*command(root, compilers[0], mode), f"{root}/{source}"], None))
    problems = [f"{name}:\n{output}" for name, output in compile_all(jobs) if output]
    return finish(f"{len(headers)} headers after vendors' macros", len(jobs) if headers else 0, problems)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
