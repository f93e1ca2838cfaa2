"""The interface for C: the header is C99 and C++, and the example gives the same commands as C++.

usage: c_interface.py ROOT BUILD WORK_FOLDER CXX C_COMPILER...
"""

import pathlib
import shutil
import sys

import mission
from commands import Failure, run
from sources import finish

EXAMPLE = "docs/integration/c/main.c"


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
            main_object, program = work / f"main_{i}.o", work / f"in_c_{i}"
            run(compiler, *mission.C99, f"-I{root}", "-c", f"{root}/{EXAMPLE}", "-o", main_object)
            run(cxx, main_object, plant, *libraries, "-lm", "-o", program)
            said = mission.says(program)
            if said != wanted:
                problems.append(f"{compiler}: '{said}', in C++ '{wanted}'")
    except Failure as failure:
        problems.append(str(failure))
    return finish("the interface for C", len(c_compilers), problems)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
