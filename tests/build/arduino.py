"""scripts/amalgamate: its descriptions follow the specifications of Arduino and PlatformIO, and library and sketch compile for a
Cortex-M0+ after the declarations of fixtures/arduino, with WHISKER_LONG to code.

usage: arduino.py ROOT WORK_FOLDER ARM_CXX
"""

import json
import pathlib
import re
import shutil
import sys
import zipfile

import mission
from commands import Failure, run
from compile import LONG, compile_all
from sources import finish
from version import of_header

# https://arduino.github.io/arduino-cli/latest/library-specification/
REQUIRED = ("name", "version", "author", "maintainer", "sentence", "paragraph", "category", "url", "architectures")
OPTIONAL = ("depends", "dot_a_linkage", "includes", "precompiled", "ldflags")
CATEGORIES = (
    "Display", "Communication", "Signal Input/Output", "Sensors", "Device Control", "Timing", "Data Storage", "Data Processing", "Other",
)  # fmt: skip
# https://docs.platformio.org/en/latest/manifests/library-json/
FIELDS = (
    "name", "version", "description", "keywords", "homepage", "repository", "authors", "license", "frameworks", "platforms", "headers",
    "examples", "dependencies", "export", "scripts", "build",
)  # fmt: skip
BUILD = ("flags", "unflags", "includeDir", "srcDir", "srcFilter", "extraScript", "libArchive", "libLDFMode", "libCompatMode", "builder")
CHIP = [
    "-mcpu=cortex-m0plus", "-mthumb", "-std=gnu++17", "-Os", "-ffreestanding", "-fno-exceptions", "-fno-rtti", "-fno-threadsafe-statics",
    "-isystem", str(pathlib.Path(__file__).parent / "fixtures/arduino"), *mission.STRICT,
]  # fmt: skip


def properties_problems(text, version, exists):
    """What library.properties has wrong. exists(path): whether the archive has this file."""
    fields = dict(line.split("=", 1) for line in text.splitlines() if line and not line.startswith("#"))
    for name in REQUIRED:
        if not fields.get(name):
            yield f"library.properties: no {name}"
    for name in sorted(fields.keys() - {*REQUIRED, *OPTIONAL}):
        yield f"library.properties: unknown field {name}"
    if not re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9 _.-]{0,62}", fields.get("name", "")) or "arduino" in fields["name"].lower():
        yield f"library.properties: name {fields.get('name')}"
    if fields.get("version") != version:
        yield f"library.properties: version {fields.get('version')}, not {version}"
    if fields.get("category") not in CATEGORIES:
        yield f"library.properties: category {fields.get('category')}"
    if not re.match(r"https?://\S+$", fields.get("url", "")):
        yield f"library.properties: url {fields.get('url')}"
    for header in filter(None, fields.get("includes", "").split(",")):
        if not exists(f"src/{header}"):
            yield f"library.properties: includes {header}, which is not in src/"


def json_problems(text, version, exists):
    """What library.json has wrong."""
    fields = json.loads(text)
    for name in ("name", "version", "description", "keywords", "authors"):
        if not fields.get(name):
            yield f"library.json: no {name}"
    for name in sorted(fields.keys() - set(FIELDS)):
        yield f"library.json: unknown field {name}"
    for name in sorted(fields.get("build", {}).keys() - set(BUILD)):
        yield f"library.json: unknown field build.{name}"
    if fields.get("version") != version:
        yield f"library.json: version {fields.get('version')}, not {version}"
    if len(fields.get("name", "")) > 50 or re.search(r'[/@:"\'<>\\]', fields.get("name", "")):
        yield f"library.json: name {fields['name']}"
    for header in fields.get("headers", []):
        if not exists(f"src/{header}"):
            yield f"library.json: headers {header}, which is not in src/"
    if fields.get("license") not in ("MIT",):
        yield "library.json: license is not that of LICENSE"


def sketch_as_cpp(text):
    """What Arduino's builder makes of this sketch, which needs no prototypes."""
    return f'#include <Arduino.h>\n#line 1 "drive.ino"\n{text}'


def main(root, work, compiler):
    work = pathlib.Path(work)
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    problems = []
    try:
        archives = [work / f"{i}.zip" for i in range(2)]
        for archive in archives:
            run(f"{root}/scripts/amalgamate", archive)
        if archives[0].read_bytes() != archives[1].read_bytes():
            problems.append("two archives of one tree differ")
        zipfile.ZipFile(archives[0]).extractall(work)
        library = work / "Whisker"
        version = of_header(pathlib.Path(root, "firmware/version.hpp").read_text())
        exists = lambda path: (library / path).is_file()  # noqa: E731
        problems += properties_problems((library / "library.properties").read_text(), version, exists)
        problems += json_problems((library / "library.json").read_text(), version, exists)
        sketches = sorted(library.glob("examples/*/*.ino"))
        for sketch in sketches:
            if sketch.stem != sketch.parent.name:
                problems.append(f"{sketch.name}: a sketch has the name of its folder")
        command = [compiler, *CHIP, f"-I{library}/src", "-x", "c++", "-c" if LONG else "-fsyntax-only", "-"]
        jobs = [(sketch.name, [*command, "-o", str(sketch.with_suffix(".o"))], sketch_as_cpp(sketch.read_text())) for sketch in sketches]
        jobs.append(("whisker.cpp", [*command, "-o", str(work / "whisker.o")], (library / "src/whisker.cpp").read_text()))
        problems += [f"{name}:\n{output}" for name, output in compile_all(jobs) if output]
    except Failure as failure:
        problems.append(str(failure))
        sketches = []
    return finish("Arduino", len(sketches), problems)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
