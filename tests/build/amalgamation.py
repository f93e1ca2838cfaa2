"""scripts/amalgamate: its files compile with each compiler and for chips, and give the same commands as the library.

usage: amalgamation.py ROOT BUILD WORK_FOLDER C_COMPILER CXX CLANGXX-14|- ARM_CXX|-
"""

import pathlib
import re
import shutil
import sys

import mission
from commands import Failure, run
from compile import compile_all
from sources import core_sources, finish

# Not optimised, which takes a third of the time: the commands are the same.
CORE = ["-std=c++17", "-O0", "-fno-exceptions", "-fno-rtti", *mission.STRICT]
LESS = [f"-DWHISKER_{part}=0" for part in ("MAP_BYTES", "GYRO")]


def each_file_once(root, folder):
    """A problem for each file that the result lacks or has twice."""
    text = (folder / "whisker.hpp").read_text() + (folder / "whisker.cpp").read_text()
    found = re.findall(r"^// ---- (\S+)$", text, re.MULTILINE)
    wanted = [path.as_posix() for suffix in (".hpp", ".cpp") for path in core_sources(root, suffix)]
    for path in wanted:
        if found.count(path) != 1:
            yield f"{path} is {found.count(path)} times in it"
    for include in re.findall(r'^\s*#\s*include\s*"([^"]+)"', text, re.MULTILINE):
        if include not in ("whisker.hpp", "whisker.h", "whisker_config.h"):
            yield f'#include "{include}" is left'


def main(root, build, work, cc, cxx, clang, arm):
    work = pathlib.Path(work)
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    folder = work / "amalgamation"
    problems, compiled = [], {"host": [cxx]}
    if clang != "-":
        compiled["clang"] = [clang]
    if arm != "-":
        chip = [arm, "-mcpu=cortex-m3", "-mthumb", "-ffreestanding"]
        compiled |= {"ARM": chip, "ARM, without map and gyro": [*chip, "-fsyntax-only", *LESS]}
    try:
        run(f"{root}/scripts/amalgamate", folder)
        problems += each_file_once(root, folder)
        source = folder / "whisker.cpp"
        jobs = [(name, [*command, *CORE, "-c", source, "-o", work / f"{name}.o"], None) for name, command in compiled.items()]
        # The header alone, twice, and as C.
        jobs.append(("whisker.hpp", [cxx, *CORE, f"-I{folder}", "-fsyntax-only", "-xc++", "-"], '#include "whisker.hpp"\n' * 2))
        jobs.append(("whisker.h", [cc, *mission.C99, f"-I{folder}", "-fsyntax-only", "-xc", "-"], '#include "whisker.h"\n' * 2))
        problems += [f"{name}:\n{output}" for name, output in compile_all(jobs) if output]
        if not problems:
            plant = mission.plant(root, work, cc)
            library = mission.cpp_program(root, work, cxx, "library", [f"-I{root}"], [plant, *mission.objects_of_core(root, build)])
            wanted = mission.says(library)
            for name in sorted({"host", "clang"} & set(compiled)):
                options = [f"-I{folder}", "-DWHISKER_AMALGAMATION"]
                said = mission.says(mission.cpp_program(root, work, cxx, f"mission_{name}", options, [plant, work / f"{name}.o"]))
                if said != wanted:
                    problems.append(f"{name}: '{said}', the library: '{wanted}'")
    except Failure as failure:
        problems.append(str(failure))
    return finish("amalgamation", len(compiled), problems)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
