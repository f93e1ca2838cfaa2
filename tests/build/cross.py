"""The core compiles for a bare target, and needs no symbol that the target lacks.

usage: cross.py arm|no-float ROOT WORK_FOLDER COMPILER [--nm NM] [--flags FLAG...]
"""

import argparse
import pathlib
import sys

from compile import compile_all
from sources import core_sources, finish
from symbols import forbidden

COMMON = ["-std=c++17", "-fno-exceptions", "-fno-rtti", "-c"]
TARGETS = {
    "arm": ["-mcpu=cortex-m0plus", "-mthumb", "-Os", "-ffreestanding"],
    # Makes g++ for x86 reject every floating-point operation, even one that the optimiser would fold.
    "no-float": ["-mgeneral-regs-only", "-O0"],
}
def compile_core(target, root, work, compiler, flags, files):
    """(messages of the files that do not compile, objects of the others)."""
    jobs, objects = [], []
    common = [compiler, *TARGETS[target], *COMMON, *flags, f"-I{root}"]
    for path in files:
        out = pathlib.Path(work, path).with_suffix(".o")
        out.parent.mkdir(parents=True, exist_ok=True)
        out.unlink(missing_ok=True)
        objects.append(out)
        jobs.append((str(path), [*common, str(pathlib.Path(root, path)), "-o", str(out)], None))
    problems = [f"{name}:\n{output}" for name, output in compile_all(jobs) if output]
    return problems, [out for out in objects if out.exists()]


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
        problems += forbidden(args.nm, objects)
    return finish(args.target, len(files), problems)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
