"""The command in docs/porting.md compiles its example, both in sh and in a makefile. The example also compiles in GNU's
dialect and with clang, so check() is a constant expression there. usage: example_compiles.py ROOT CXX [CLANG]"""

import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

from compile import compile_all
from sources import core_sources, finish

SHIM = '#!/bin/sh\nprintf "%s\\n" "$@"\n'


def line_of(readme):
    """The one line between the marks, or None."""
    block = re.search(r"<!-- compile:begin -->\n```\n([^\n]+)\n```\n<!-- compile:end -->\n", readme)
    return block and block[1]


def arguments(command, folder, path):
    """The compiler's arguments. path: the folder searched first for the compiler."""
    environment = {**os.environ, "PATH": f"{path}:{os.environ['PATH']}"}
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    return done.stdout.splitlines() if done.returncode == 0 else [done.stderr]


def main(root, *compilers):
    root = pathlib.Path(root).resolve()
    line = line_of((root / "docs/porting.md").read_text())
    if line is None:
        return finish("the line of docs/porting.md", 1, ["docs/porting.md: no one line between the marks compile:begin and compile:end"])
    problems = []
    with tempfile.TemporaryDirectory() as work:
        for name in ("docs", "firmware", "hal"):
            os.symlink(root / name, pathlib.Path(work, name))
        shims = pathlib.Path(work, "shims")
        shims.mkdir()
        shim = shims / shlex.split(line)[0]
        shim.write_text(SHIM)
        shim.chmod(0o755)
        pathlib.Path(work, "Makefile").write_text(f"all:\n\t@{line}\n")
        in_sh, in_make = arguments(["sh", "-c", line], work, shims), arguments(["make"], work, shims)
        if in_sh != in_make:
            problems.append(f"make gives the compiler other arguments than sh: {in_make} and {in_sh}")
        files = [argument for argument in in_sh if argument.endswith(".cpp")]
        wanted = ["docs/example/main.cpp", *map(str, core_sources(root))]
        if sorted(files) != sorted(wanted):
            problems.append(f"sources that differ: {sorted(set(files) ^ set(wanted))}")
        options = [argument.replace("-I.", f"-I{work}") for argument in in_sh if not argument.endswith(".cpp")]
        # The same as the command, but on all processors, and without code: that the other builds make.
        jobs = [(name, [shlex.split(line)[0], *options, "-fsyntax-only", str(root / name)], None) for name in files]
        for compiler in compilers:
            for standard in ("c++17", "gnu++17"):
                command = [compiler, f"-std={standard}", f"-I{root}", "-fsyntax-only", str(root / wanted[0])]
                jobs.append((f"{compiler} {standard}", command, None))
        problems += [f"{name}:\n{output}" for name, output in compile_all(jobs) if output]
    return finish("the line of docs/porting.md", len(jobs), problems)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
