"""The core compiles for a bare target, with either engine, and asks for nothing that the target has not.

usage: cross.py arm|avr|no-float ROOT WORK_FOLDER COMPILER [--nm NM] [--flags FLAG...]
"""

import argparse
import pathlib
import sys

from compile import compile_all
from sources import finish, sources
from symbols import forbidden

COMMON = ["-std=c++17", "-fno-exceptions", "-fno-rtti", "-c"]
TARGETS = {
    "arm": ["-mcpu=cortex-m0plus", "-mthumb", "-Os", "-ffreestanding"],
    # With avr-libc installed, clang would take its <stdint.h>, which keeps its limits from C++.
    "avr": ["--target=avr", "-mmcu=atmega328p", "-Os", "-ffreestanding", "-nostdlibinc"],
    # With g++ for x86 a floating-point operation is then an error.
    "no-float": ["-mgeneral-regs-only", "-O2"],
}
ENGINES = {"table": [], "closed": ["-DWHISKER_ENGINE_CLOSED=1"]}


def compile_core(target, root, work, compiler, flags, files):
    """The messages of the files that do not compile, and the objects of those that do, by engine."""
    jobs, objects = [], {}
    for engine, defines in ENGINES.items():
        for path in files:
            out = pathlib.Path(work, engine, path).with_suffix(".o")
            out.parent.mkdir(parents=True, exist_ok=True)
            out.unlink(missing_ok=True)
            command = [compiler, *TARGETS[target], *COMMON, *flags, *defines, f"-I{root}"]
            jobs.append((f"{path} ({engine})", [*command, str(pathlib.Path(root, path)), "-o", str(out)], None))
            objects.setdefault(engine, []).append(out)
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

    files = sources(args.root, ("firmware",), (".cpp",))
    problems, objects = compile_core(args.target, args.root, args.work, args.compiler, args.flags, files)
    if args.nm:
        for engine, outs in objects.items():
            problems += [f"{engine}: {problem}" for problem in forbidden(args.nm, outs)]
    return finish(args.target, len(files) * len(ENGINES), problems)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
