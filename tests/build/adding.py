"""The planner, message and parameter of docs/development.md, applied to a copy of the tree, compile where they are read; with WHISKER_LONG,
the command is built with them, and they work.

usage: adding.py ROOT WORK_FOLDER CMAKE GENERATOR CXX
"""

import json
import os
import pathlib
import re
import shutil
import sys

from commands import Failure, run
from compile import LONG, compile_all
from sources import core_sources, finish

# They list the planners.
NUMBERS = ("firmware/apps/replay.cpp", "firmware/c/whisker.cpp")
PARTS = ("firmware", "hal", "host", "toolchain", "CMakeLists.txt")
WORLD = """time_limit_s = 120.0
[start]
x_m = 0.0
y_m = 0.0
[goal]
x_m = 1.0
y_m = 0.0
[robot]
patience_s = 0.25
"""


def with_lines(text, diff, file):
    """Applies a diff: a line with a leading blank matches the next equal line of the text; a plus line is inserted after it."""
    lines, at = text.splitlines(), -1
    for line in diff.splitlines():
        mark, rest = line[:1], line[1:]
        if mark == "+":
            at += 1
            lines.insert(at, rest)
        else:
            found = [i for i in range(at + 1, len(lines)) if lines[i].strip() == rest.strip()]
            if not found:
                raise Failure(f"docs/development.md: {file} has no line '{rest.strip()}'")
            at = found[0]
    return "\n".join(lines) + "\n"


def apply(page, tree):
    """The files created or changed."""
    touched = set()
    for new, file, text in re.findall(r"^(New,|In) `([^`]+)`[^\n]*:\n```\w+\n(.*?)^```", page, re.MULTILINE | re.DOTALL):
        path = tree / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text if new == "New," else with_lines(path.read_text(), text, file))
        touched.add(file)
    return touched


def check(whisker, folder):
    world = folder / "world.toml"
    world.write_text(WORLD)
    direct = json.loads(run(whisker, "run", world, "--planner", "beeline", "--json").stdout)
    yield "the planner arrives", (direct["outcome"], direct["planner"]) == ("reached", "beeline")
    bus = json.loads(run(whisker, "hil", world, "--planner", "beeline", "--json").stdout)
    yield "the planner drives alike on the bus", bus["hash"] == direct["hash"]
    yield "the help names the planner", "beeline" in run(whisker, "run", "--help").stdout
    page = run(whisker, "protocol").stdout
    yield "the protocol has the messages", "### Ping" in page and "| Pong | 0x19 |" in page
    yield "the DBC file has the messages", re.search(r"BO_ \d+ Ping: 4 Base1", run(whisker, "protocol", "--dbc").stdout)
    yield "the protocol has the parameter", "| 83 | patience_s | ms | 500 | 0..5000 |" in page
    yield "the manual's table has it", "| `patience_s` | s | 0.5 | 0 to 5 |" in run(whisker, "protocol", "--parameters").stdout


def command_problems(tree, build, work, cmake, generator, compiler):
    options = ["-DCMAKE_BUILD_TYPE=Debug", "-DCMAKE_CXX_FLAGS_DEBUG=-O0", "-DWHISKER_TESTS=OFF", "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=16"]
    run(cmake, "-S", tree, "-B", build, "-G", generator, f"-DCMAKE_CXX_COMPILER={compiler}", *options)
    run(cmake, "--build", build, "-j", os.cpu_count(), "--target", "whisker")
    return [f"not so: {what}" for what, holds in check(build / "whisker", work) if not holds]


def includes(path, headers):
    text = path.read_text()
    return any(f'#include "{header}"' in text for header in headers)


def compiler_problems(tree, touched, compiler):
    """Of the core's sources that are new or changed, include a header that is or handle messages, and of those that number the planners."""
    of_core = map(str, core_sources(tree))
    read = [path for path in of_core if path in touched or path.startswith("firmware/can/") or includes(tree / path, touched)]
    listed = (tree / "firmware/CMakeLists.txt").read_text()
    unlisted = [f"firmware/CMakeLists.txt: no {path}" for path in touched if path.endswith(".cpp") and path.removeprefix("firmware/") not in listed]
    jobs = [(path, [compiler, "-std=c++17", f"-I{tree}", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", str(tree / path)], None) for path in (*read, *NUMBERS)]
    return unlisted + [f"{name}:\n{output}" for name, output in compile_all(jobs) if output]


def main(root, work, cmake, generator, compiler):
    root, work = pathlib.Path(root), pathlib.Path(work)
    tree, build = work / "tree", work / "build"
    shutil.rmtree(tree, ignore_errors=True)
    tree.mkdir(parents=True)
    for part in PARTS:
        if (root / part).is_dir():
            shutil.copytree(root / part, tree / part, ignore=shutil.ignore_patterns("node_modules", "web"))
        else:
            shutil.copy2(root / part, tree / part)
    try:
        touched = apply((root / "docs/development.md").read_text(), tree)
        problems = compiler_problems(tree, touched, compiler)
        if LONG and not problems:
            problems = command_problems(tree, build, work, cmake, generator, compiler)
    except Failure as failure:
        touched, problems = (), [str(failure)]
    return finish("additions", len(touched) or 1, problems)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
