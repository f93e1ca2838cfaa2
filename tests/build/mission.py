"""One mission in a simulated plant (docs/integration/c/plant.c), driven by programs that use the core in different ways. Each prints
the same line, with a hash of its wheel commands."""

import pathlib

from commands import Failure, run

STRICT = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"]
C99 = ["-std=c99", *STRICT]
CXX17 = ["-std=c++17", *STRICT]


def objects_of_core(root, build):
    """The libraries that this build has made: interface for C, and core."""
    libraries = [pathlib.Path(build, "firmware", f"libwhisker_{name}.a") for name in ("c", "core")]
    missing = [str(library) for library in libraries if not library.exists()]
    if missing:
        raise Failure(f"not built: {', '.join(missing)}")
    return libraries


def plant(root, work, c_compiler):
    out = pathlib.Path(work, "plant.o")
    run(c_compiler, *C99, "-c", f"{root}/docs/integration/c/plant.c", "-o", out)
    return out


def cpp_program(root, work, compiler, name, options, objects):
    out = pathlib.Path(work, name)
    source = f"{root}/tests/build/fixtures/mission/main.cpp"
    run(compiler, *CXX17, f"-I{root}/docs/integration/c", *options, source, *objects, "-lm", "-o", out)
    return out


def says(program):
    """What it prints, if it reaches the goal."""
    line = run(program).stdout.strip()
    if not line.startswith("arrived after "):
        raise Failure(f"{program}: {line}")
    return line
