"""The interface for C: the header is C99 and C++, the robot's example gives the same commands as C++, and the guard's stops at the obstacle.

usage: c_interface.py ROOT BUILD WORK_FOLDER CXX C_COMPILER...
"""

import pathlib
import shutil
import sys

import mission
from commands import Failure, run
from sources import finish

EXAMPLES = "docs/integration/c"
GUARDED = "obstacle: granted 0 %, wheels 0 0, 0.8"


def main(root, build, work, cxx, *c_compilers):
    work = pathlib.Path(work)
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    problems = []
    try:
        libraries = mission.objects_of_core(root, build)
        plant = mission.plant(root, work, c_compilers[0])
        wanted = mission.says(mission.cpp_program(root, work, cxx, "in_cpp", [f"-I{root}"], [plant, *libraries]))
        run(cxx, *mission.CXX17, f"-I{root}", "-fsyntax-only", "-xc++", f"{root}/firmware/c/whisker.h")
        for i, compiler in enumerate(c_compilers):
            board, programs = work / f"board_{i}.o", {}
            run(compiler, *mission.C99, f"-I{root}", "-c", f"{root}/{EXAMPLES}/board.c", "-o", board)
            for name in ("main", "guard"):
                main_object, programs[name] = work / f"{name}_{i}.o", work / f"{name}_{i}"
                run(compiler, *mission.C99, f"-I{root}", "-c", f"{root}/{EXAMPLES}/{name}.c", "-o", main_object)
                run(cxx, main_object, board, plant, *libraries, "-lm", "-o", programs[name])
            said = mission.says(programs["main"])
            if said != wanted:
                problems.append(f"{compiler}: '{said}', in C++ '{wanted}'")
            guarded = run(programs["guard"]).stdout.strip()
            if not guarded.startswith(GUARDED):
                problems.append(f"{compiler}: '{guarded}' begins otherwise than '{GUARDED}'")
    except Failure as failure:
        problems.append(str(failure))
    return finish("the interface for C", len(c_compilers), problems)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
