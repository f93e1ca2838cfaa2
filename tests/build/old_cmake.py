"""The CMake files that other projects read use no command newer than their cmake_minimum_required.

usage: old_cmake.py ROOT WORK_FOLDER CMAKE GENERATOR CXX
"""

import json
import pathlib
import re
import subprocess
import sys

from sources import finish


def number(text):
    return tuple(int(part) for part in text.split("."))


def wanted(root):
    text = pathlib.Path(root, "CMakeLists.txt").read_text()
    return number(re.search(r"^cmake_minimum_required\(VERSION ([\d.]+)\)", text, re.M)[1])


def calls(root, trace):
    """(command, where) of the project's own files, each command once."""
    found = {}
    for line in pathlib.Path(trace).read_text().splitlines():
        call = json.loads(line)
        if pathlib.Path(root) in pathlib.Path(call.get("file", "/")).parents:
            found.setdefault(call["cmd"].lower(), f"{call['file']}:{call['line']}")
    return found


def born(cmake, command):
    """The version that introduced this command; None for an older command or one of the project."""
    done = subprocess.run([cmake, "--help-command", command], capture_output=True, text=True, check=False)
    match = re.match(r"\S+\n-+\n\s*\.\. versionadded:: ([\d.]+)", done.stdout)
    return number(match[1]) if match else None


def too_new(cmake, called, least):
    for command, where in sorted(called.items()):
        version = born(cmake, command)
        if version and version > least:
            yield f"{where}: {command}() needs CMake {'.'.join(map(str, version))}"


def main(root, work, cmake, generator, compiler):
    work = pathlib.Path(work)
    work.mkdir(parents=True, exist_ok=True)
    trace = work / "trace.json"
    command = [
        cmake, "-S", root, "-B", work / "core", "-G", generator, f"-DCMAKE_CXX_COMPILER={compiler}", "-DWHISKER_HOST=OFF",
        "-DWHISKER_TESTS=OFF", "--fresh", "--trace", "--trace-format=json-v1", f"--trace-redirect={trace}",
    ]  # fmt: skip
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        print(done.stdout + done.stderr)
        return finish("old CMake", 1, [f"exit status {done.returncode}: {' '.join(map(str, command))}"])
    called = calls(root, trace)
    return finish("old CMake", len(called), list(too_new(cmake, called, wanted(root))))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
