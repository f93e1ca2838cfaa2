"""The examples of docs/integration build in an empty folder, and those for QEMU run and reach their goal. With WHISKER_LONG also the
one that finds an installed package.

usage: integration.py ROOT WORK_FOLDER CMAKE GENERATOR
"""

import os
import pathlib
import shutil
import subprocess
import sys


def run(*command, **options):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False, **options)
    if done.returncode:
        sys.exit(f"exit status {done.returncode}: {' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


def drives(root, image):
    """The output of the program on its board."""
    said = run(root / "scripts/chip", "cortex-m3", image, "--serial", stdin=subprocess.DEVNULL)
    if not said.endswith("arrived: at_goal\n"):
        sys.exit(f"{image}: it said\n{said}")


def main(root, work, cmake, generator):
    root, work = pathlib.Path(root), pathlib.Path(work)
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    examples = root / "docs/integration"

    toolchain = f"-DCMAKE_TOOLCHAIN_FILE={root}/toolchain/cortex-m3.cmake"
    run(cmake, "-S", examples / "qemu", "-B", work / "qemu", "-G", generator, toolchain, "-DCMAKE_BUILD_TYPE=Release")
    run(cmake, "--build", work / "qemu")
    drives(root, work / "qemu/my_robot.elf")

    if "WHISKER_LONG" in os.environ:
        finds_the_package(root, work, examples, cmake, generator)

    run("make", "-C", examples / "makefile", f"OUT={work}/make")
    drives(root, work / "make/my_robot.elf")
    print("integration: the other build systems work")


def finds_the_package(root, work, examples, cmake, generator):
    core = work / "core"
    run(cmake, "-S", root, "-B", core, "-G", generator, "-DWHISKER_HOST=OFF", "-DWHISKER_TESTS=OFF")
    run(cmake, "--build", core)
    run(cmake, "--install", core, "--prefix", work / "installed")
    prefix = f"-DCMAKE_PREFIX_PATH={work}/installed"
    run(cmake, "-S", examples / "package", "-B", work / "package", "-G", generator, prefix)
    run(cmake, "--build", work / "package")
    run(work / "package/my_robot")


if __name__ == "__main__":
    main(*sys.argv[1:])
