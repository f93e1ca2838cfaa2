"""Another project can use Whisker: as a subfolder with its own warnings, and installed, as C++20. With BUILD, that build is installed;
without, or with WHISKER_LONG, one of the core alone.

usage: dependency.py ROOT WORK_FOLDER CMAKE GENERATOR CXX [BUILD]
"""

import pathlib
import re
import shutil
import sys

from commands import Failure, run
from compile import LONG
from sources import finish
from version import of_header

# A warning that this project does not enable and that all C++ code triggers.
STRANGE = "-Waggregate-return"


def version(root):
    return of_header(pathlib.Path(root, "firmware/version.hpp").read_text())


class Other:
    """The other project."""

    def __init__(self, root, work, cmake, generator, compiler, built=None):
        self.root, self.work, self.cmake = root, work, cmake
        self.built = None if LONG else built
        self.options = ["-G", generator, f"-DCMAKE_CXX_COMPILER={compiler}"]
        self.source = f"{root}/tests/build/fixtures/dependent"

    def configure(self, source, build, *options):
        run(self.cmake, "-S", source, "-B", self.work / build, *self.options, *options)

    def build(self, folder):
        done = run(self.cmake, "--build", self.work / folder)
        return done.stdout + done.stderr

    def says_its_version(self, folder):
        said = run(self.work / folder / "dependent").stdout.strip()
        if said != version(self.root):
            raise Failure(f"{folder}: the header says {said}")

    def as_subfolder(self):
        self.configure(self.source, "subfolder", f"-DWHISKER_ROOT={self.root}", f"-DCMAKE_CXX_FLAGS={STRANGE}")
        if STRANGE not in self.build("subfolder"):
            raise Failure(f"{STRANGE} warned of nothing: this proves nothing")
        self.says_its_version("subfolder")

    def as_package(self):
        if not self.built:
            self.configure(self.root, "core", "-DWHISKER_HOST=OFF", "-DWHISKER_TESTS=OFF")
            self.build("core")
        prefix = self.work / "prefix"
        run(self.cmake, "--install", self.built or self.work / "core", "--prefix", prefix)
        self.no_warnings_go_along(prefix)
        self.headers_have_libraries(prefix)
        found = [f"-DCMAKE_PREFIX_PATH={prefix}", f"-DWHISKER_VERSION={version(self.root)}", "-DCMAKE_CXX_STANDARD=20"]
        self.configure(self.source, "package", *found)
        self.build("package")
        self.says_its_version("package")

    @staticmethod
    def no_warnings_go_along(prefix):
        for file in prefix.rglob("*.cmake"):
            if re.search(r"-W\w|whisker_warnings", file.read_text()):
                raise Failure(f"{file.name} hands on warnings")

    @staticmethod
    def headers_have_libraries(prefix):
        """Below hal/, the contracts are header-only; each port is a library, and so are the programs' shared sources."""
        targets = "".join(file.read_text() for file in prefix.rglob("whiskerTargets.cmake"))
        installed = prefix / "include/whisker"
        wanted = {"core", "can", "c", "can_remote", *(path.name for path in (installed / "hal/ports").iterdir() if path.is_dir())}
        missing = [name for name in sorted(wanted) if f"add_library(whisker::{name} " not in targets]
        if missing:
            raise Failure(f"headers are installed, libraries are not: {', '.join(missing)}")

    def own_warnings_are_errors(self):
        options = ["-DWHISKER_HOST=OFF", "-DWHISKER_TESTS=OFF", f"-DCMAKE_CXX_FLAGS={STRANGE}"]
        self.configure(self.root, "own", *options)
        try:
            self.build("own")
        except Failure:
            return
        raise Failure("a warning in the project's own build is no error")


def main(root, work, *tools):
    work = pathlib.Path(work)
    shutil.rmtree(work, ignore_errors=True)
    other = Other(root, work, *tools)
    ways = (other.as_subfolder, other.as_package, other.own_warnings_are_errors)
    problems = []
    for way in ways:
        try:
            way()
        except Failure as failure:
            problems.append(f"{way.__name__}: {failure}")
    return finish("dependency", len(ways), problems)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
