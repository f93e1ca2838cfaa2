"""A program that adds Whisker as a subfolder gets the core, without a search for any package.

usage: core_alone.py ROOT WORK_FOLDER CMAKE GENERATOR CXX
"""

import json
import pathlib
import subprocess
import sys

from sources import finish

LOOKS_OUTSIDE = {
    "find_package", "find_library", "find_path", "find_file", "find_program", "pkg_check_modules",
    "pkg_search_module", "fetchcontent_declare", "fetchcontent_makeavailable", "externalproject_add",
}  # fmt: skip


def lookups(root, trace):
    """The commands of the project's CMake files that search for something outside the project."""
    found = []
    for line in pathlib.Path(trace).read_text().splitlines():
        call = json.loads(line)
        if call.get("cmd", "").lower() in LOOKS_OUTSIDE and pathlib.Path(root) in pathlib.Path(call["file"]).parents:
            found.append(f"{call['file']}:{call['line']}: {call['cmd']}({' '.join(call['args'])})")
    return found


def main(root, work, cmake, generator, compiler):
    work = pathlib.Path(work)
    work.mkdir(parents=True, exist_ok=True)
    consumer, build, trace = f"{root}/tests/build/fixtures/consumer", work / "consumer", work / "trace.json"
    configure = [
        cmake, "-S", consumer, "-B", build, "-G", generator, f"-DCMAKE_CXX_COMPILER={compiler}",
        f"-DWHISKER_ROOT={root}", "--fresh", "--trace-expand", "--trace-format=json-v1", f"--trace-redirect={trace}",
    ]  # fmt: skip
    for command in (configure, [cmake, "--build", build], [build / "consumer"]):
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            print(done.stdout + done.stderr)
            return finish("the core alone", 1, [f"exit status {done.returncode}: {' '.join(map(str, command))}"])
    return finish("the core alone", 1, lookups(root, trace))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
