"""A release (scripts/release): its image and its sums, and its Debian package: what that depends on, what it holds, and other
projects that use it, by pkg-config and by find_package.

usage: deb.py ROOT BUILD WORK_FOLDER CMAKE GENERATOR C_COMPILER CXX
"""

import pathlib
import shlex
import shutil
import sys

import mission
from commands import Failure, run
from sources import finish
from version import of_header

HELD = (
    "bin/whisker", "include/whisker/firmware/robot.hpp", "include/whisker/firmware/c/whisker.h", "include/whisker/hal/drive.hpp",
    "lib/libwhisker_core.a", "lib/libwhisker_c.a", "lib/pkgconfig/whisker.pc",
    "lib/cmake/whisker/whiskerConfig.cmake", "share/doc/whisker/copyright", "share/whisker/robots/hc-sr04.toml",
    "share/man/man1/whisker.1", "share/bash-completion/completions/whisker", "share/whisker/whisker.uf2",
)  # fmt: skip


class Package:
    def __init__(self, root, build, work):
        self.image = work / "image.uf2"
        self.image.write_bytes(bytes(range(256)) * 2)  # the real one is of the stage pico
        run(f"{root}/scripts/release", "--of", build, self.image, work / "made")
        (self.file,) = (work / "made").glob("*.deb")
        run("dpkg-deb", "--extract", self.file, work / "tree")
        self.root, self.work, self.usr = root, work, work / "tree/usr"
        self.examples = self.usr / "share/doc/whisker/examples"

    def field(self, name):
        return run("dpkg-deb", "--field", self.file, name).stdout.strip()

    def pkg_config(self, *options):
        only_here = f"PKG_CONFIG_LIBDIR={self.usr}/lib/pkgconfig"
        return shlex.split(run("env", only_here, "pkg-config", *options, "whisker").stdout)


def release_problems(package):
    made = package.file.parent
    run("sh", "-c", 'cd "$1" && sha256sum --strict --check SHA256SUMS', "sh", made)
    summed = sorted(line.split()[1] for line in (made / "SHA256SUMS").read_text().splitlines())
    held = sorted(path.name for path in made.iterdir() if path.name != "SHA256SUMS")
    if summed != held or held != ["whisker.uf2", package.file.name]:
        yield f"it holds {held}, with sums of {summed}"
    for file in (made / "whisker.uf2", package.usr / "share/whisker/whisker.uf2"):
        if file.is_file() and file.read_bytes() != package.image.read_bytes():
            yield f"{file} is not the image"


def content_problems(package, version):
    for path in HELD:
        if not (package.usr / path).is_file():
            yield f"it does not hold /usr/{path}"
    if package.field("Version") != version or package.field("Package") != "whisker":
        yield f"it is {package.field('Package')} {package.field('Version')}, not whisker {version}"
    names = {part.split()[0] for part in package.field("Depends").split(", ")}
    for needed in ("libc6", "libstdc++6", "libfmt9", "zlib1g"):
        if needed not in names:
            yield f"it does not depend on {needed}"
    for name in sorted(names):
        if name.endswith("-dev"):
            yield f"it depends on {name}"
    for path in package.usr.rglob("*"):
        if path.suffix in (".cmake", ".pc") and str(package.root) in path.read_text():
            yield f"{path.name} names the source tree"
    if run(package.usr / "bin/whisker", "--version").stdout.split()[1] != version:
        yield "its command has another version"


def by_pkg_config(package, c_compiler, cxx):
    """The examples that the package holds, compiled with what pkg-config says."""
    work, flags, libraries = package.work, package.pkg_config("--cflags"), package.pkg_config("--libs")
    if package.pkg_config("--modversion") != [package.field("Version")]:
        yield "pkg-config says another version"
    fixture = f"{package.root}/tests/build/fixtures/packaged/drivers.cpp"
    run(cxx, *mission.CXX17, f"-I{package.examples}", fixture, *flags, *libraries, "-o", work / "in_cpp")
    if run(work / "in_cpp").stdout != "drives: yes\n":
        yield "by pkg-config, the example does not drive"
    sources = [package.examples / name for name in ("main.c", "board.c", "plant.c")]
    run(c_compiler, *mission.C99, *sources, *flags, *libraries, "-lm", "-o", work / "in_c")
    mission.says(work / "in_c")


def by_find_package(package, cmake, generator, cxx):
    build = package.work / "found"
    run(cmake, "-S", f"{package.root}/tests/build/fixtures/packaged", "-B", build, "-G", generator, f"-DCMAKE_CXX_COMPILER={cxx}",
        f"-DCMAKE_PREFIX_PATH={package.usr}", f"-DEXAMPLES={package.examples}")  # fmt: skip
    run(cmake, "--build", build)
    if run(build / "packaged").stdout != "drives: yes\n":
        yield "by find_package, the example does not drive"


def main(root, build, work, cmake, generator, c_compiler, cxx):
    work = pathlib.Path(work)
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    problems = []
    try:
        package = Package(root, build, work)
        problems += release_problems(package)
        problems += content_problems(package, of_header(pathlib.Path(root, "firmware/version.hpp").read_text()))
        problems += by_pkg_config(package, c_compiler, cxx)
        problems += by_find_package(package, cmake, generator, cxx)
    except Failure as failure:
        problems.append(str(failure))
    return finish("the release", len(HELD), problems)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
