"""The component for ESP-IDF and the module for Zephyr: their files are well-formed and there, and they compile all sources of the core.

usage: components.py ROOT CMAKE
"""

import pathlib
import re
import shutil
import sys
import tempfile

import yaml

from commands import Failure, run
from sources import core_sources, finish, sources
from version import of_header

IDF, ZEPHYR = "toolchain/package/esp-idf", "toolchain/package/zephyr"
# Commands of these systems that print their arguments, run by cmake -P: the list, one argument a line. As in ESP-IDF, which first reads
# a component for its requirements only, the registration returns.
STUBS = """
function(say)
  foreach(argument IN LISTS ARGN)
    message(STATUS "${{argument}}")
  endforeach()
endfunction()
macro(idf_component_register)
  say(${{ARGN}})
  return()
endmacro()
function(zephyr_library_sources)
  say(SRCS ${{ARGN}})
endfunction()
function(zephyr_include_directories)
  say(INCLUDE_DIRS ${{ARGN}})
endfunction()
function(zephyr_library_named)
endfunction()
function(zephyr_compile_definitions)
  say(DEFINITIONS ${{ARGN}})
endfunction()
set(ESP_PLATFORM {esp_platform})
set(CONFIG_WHISKER y)
set(CONFIG_WHISKER_MAP_BYTES 2048)
include({file})
"""


def listed(cmake, file, esp_platform=0):
    """The words that follow each keyword."""
    with tempfile.TemporaryDirectory() as folder:
        script = pathlib.Path(folder, "stub.cmake")
        script.write_text(STUBS.format(file=file, esp_platform=esp_platform))
        found, key = {}, None
        for line in run(cmake, "-P", script).stdout.splitlines():
            word = line.removeprefix("-- ")
            if re.fullmatch(r"[A-Z_]+", word):
                key = word
            else:
                found.setdefault(key, []).append(word)
        return found


def managed(root, folder):
    """A copy of the repository as a git dependency, in `folder`: what the component manager copies."""
    files = yaml.safe_load((root / "idf_component.yml").read_text())["files"]
    left_out = [pattern.removesuffix("/**/*") for pattern in files["exclude"]]
    copy = pathlib.Path(folder, "managed_components/whisker")
    nowhere = ["build", "dist", ".git", "node_modules"]  # the manager's own, and what is in no repository
    shutil.copytree(root, copy, ignore=lambda at, _: nowhere + left_out * (pathlib.Path(at) == root))
    return copy


def source_problems(root, cmake, folder, wanted, esp_platform=0):
    """wanted: the sources, by their paths below `root`."""
    said = listed(cmake, f"{root}/{folder}/CMakeLists.txt", esp_platform)
    wanted = {f"{root}/{path}" for path in wanted}
    for path in sorted(wanted ^ set(said.get("SRCS", []))):
        yield f"{folder}/CMakeLists.txt: {path} is {'not compiled' if path in wanted else 'no source of the core'}"
    if said.get("INCLUDE_DIRS") != [str(root)]:
        yield f"{folder}/CMakeLists.txt: include folders {said.get('INCLUDE_DIRS')}"
    for kconfig in said.get("KCONFIG", []):
        if not pathlib.Path(kconfig).is_file():
            yield f"{folder}/CMakeLists.txt: no {kconfig}"


def kconfig_problems(folder, cmake_text, kconfig):
    """Each option that the CMake file reads is one of Kconfig."""
    known = set(re.findall(r"^\s*config (\w+)$", kconfig, re.MULTILINE))
    for name in sorted(set(re.findall(r"\bCONFIG_(\w+)", cmake_text)) - known):
        yield f"{folder}/Kconfig: no {name}"
    if len(re.findall(r"^\s*(?:if|menu)\b", kconfig, re.MULTILINE)) != len(re.findall(r"^\s*end(?:if|menu)\b", kconfig, re.MULTILINE)):
        yield f"{folder}/Kconfig: a block is not closed"


def manifest_problems(root):
    manifest = yaml.safe_load((root / "idf_component.yml").read_text())
    if manifest.get("version") != of_header((root / "firmware/version.hpp").read_text()):
        yield f"idf_component.yml: version {manifest.get('version')}"
    if manifest.get("url") != (root / "toolchain/package/url").read_text().strip():
        yield f"idf_component.yml: url {manifest.get('url')}"
    for name in sorted(manifest.keys() - {"version", "description", "url", "license", "dependencies", "files"}):
        yield f"idf_component.yml: unknown field {name}"
    module = yaml.safe_load((root / ZEPHYR / "zephyr/module.yml").read_text())
    if not re.fullmatch(r"[\w-]+", module.get("name", "")) or module.keys() - {"name", "build"}:
        yield f"{ZEPHYR}/zephyr/module.yml: {module}"
    build = module.get("build", {})
    for file in (pathlib.Path(build.get("cmake", "?"), "CMakeLists.txt"), build.get("kconfig", "?")):
        if not (root / ZEPHYR / file).is_file():
            yield f"{ZEPHYR}/zephyr/module.yml: no {file}"


def main(root, cmake):
    root = pathlib.Path(root)
    problems = list(manifest_problems(root))
    try:
        wanted = [*core_sources(root), *sources(root, ("hal/boards/common",), (".cpp",))]
        problems += source_problems(root, cmake, ZEPHYR, wanted)
        with tempfile.TemporaryDirectory() as folder:
            problems += source_problems(managed(root, folder), cmake, ".", wanted, esp_platform=1)
        for file in (f"{IDF}/component.cmake", f"{ZEPHYR}/CMakeLists.txt"):
            folder = pathlib.PurePath(file).parent
            problems += kconfig_problems(folder, (root / file).read_text(), (root / folder / "Kconfig").read_text())
    except Failure as failure:
        problems.append(str(failure))
    return finish("components", 2, problems)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
