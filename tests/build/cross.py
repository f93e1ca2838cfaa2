"""The core compiles for a bare target, with either engine, and needs no symbol that the target lacks.

usage: cross.py arm|avr|no-float ROOT WORK_FOLDER COMPILER [--nm NM] [--flags FLAG...]
"""

import argparse
import pathlib
import re
import sys

from compile import compile_all
from sources import core_sources, finish
from symbols import forbidden

COMMON = ["-std=c++17", "-fno-exceptions", "-fno-rtti", "-c"]
TARGETS = {
    "arm": ["-mcpu=cortex-m0plus", "-mthumb", "-Os", "-ffreestanding"],
    # With the compiler's own headers: the stdint.h of avr-libc, if installed, hides limits from C++.
    "avr": ["--target=avr", "-mmcu=atmega1284p", "-Os", "-ffreestanding", "-nostdlibinc"],
    # Makes g++ for x86 reject every floating-point operation, even one that the optimiser would fold.
    "no-float": ["-mgeneral-regs-only", "-O0"],
}
ENGINES = {"table": [], "closed": ["-DWHISKER_ENGINE_CLOSED=1"]}
# A source that does not depend on the engine is compiled once; engine.hpp then rejects its inclusion.
ANY_ENGINE = ["-DWHISKER_ENGINE_ANY=1"]
ASKS = "firmware/fuzzy/engine.hpp"


def included(root, path, found):
    """Adds to `found` the files that a source includes by path from the root, recursively."""
    if path in found or not pathlib.Path(root, path).is_file():
        return
    found.add(path)
    for name in re.findall(r'^\s*#\s*include\s*"([^"]+)"', pathlib.Path(root, path).read_text(), re.MULTILINE):
        included(root, name, found)


def engines_of(root, path):
    """The engines to compile a source with, and the definition of each."""
    found = set()
    included(root, str(path), found)
    return ENGINES if ASKS in found else {"any": ANY_ENGINE}


def compile_core(target, root, work, compiler, flags, files):
    """(messages of the files that do not compile, objects of the others by engine)."""
    jobs, objects = [], {}
    common = [compiler, *TARGETS[target], *COMMON, *flags, f"-I{root}"]
    for path in files:
        for engine, defines in engines_of(root, path).items():
            out = pathlib.Path(work, engine, path).with_suffix(".o")
            out.parent.mkdir(parents=True, exist_ok=True)
            out.unlink(missing_ok=True)
            jobs.append((f"{path} ({engine})", [*common, *defines, str(pathlib.Path(root, path)), "-o", str(out)], None))
            for core in ENGINES if engine == "any" else (engine,):
                objects.setdefault(core, []).append(out)
    problems = [f"{name}:\n{output}" for name, output in compile_all(jobs) if output]
    present = {engine: [out for out in outs if out.exists()] for engine, outs in objects.items()}
    return problems, present


def main(argv):
    parser = argparse.ArgumentParser()
    parser.add_argument("target", choices=TARGETS)
    parser.add_argument("root")
    parser.add_argument("work")
    parser.add_argument("compiler")
    parser.add_argument("--nm")
    parser.add_argument("--flags", nargs=argparse.REMAINDER, default=[])
    args = parser.parse_args(argv)

    files = core_sources(args.root)
    problems, objects = compile_core(args.target, args.root, args.work, args.compiler, args.flags, files)
    if args.nm:
        for engine, outs in objects.items():
            problems += [f"{engine}: {problem}" for problem in forbidden(args.nm, outs)]
    return finish(args.target, len(files), problems)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
