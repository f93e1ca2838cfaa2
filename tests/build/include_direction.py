"""Every #include goes down the layers. usage: include_direction.py ROOT"""

import pathlib
import re
import sys

from sources import finish, sources

# The stages of firmware/, lowest first: a stage includes itself and those before it.
STAGES = ("version", "core", "health", "params", "ranges", "ground", "fuzzy", "map", "nav", "motion", "mapper", "robot", "can")

# What a stage may include of hal/; a stage that is not named here includes none of it.
HAL_OF_STAGE = {
    "ranges": {"hal/wire.hpp"},
    "motion": {"hal/wire.hpp"},
    "mapper": {"hal/wire.hpp"},
    "can": {"hal/wire.hpp", "hal/can_port.hpp"},
    "robot": {"hal/wire.hpp", "hal/rangefinders.hpp", "hal/drive.hpp"},
}

# (from, to): stages that may include a higher one all the same.
EXCEPTIONS = set()

FREESTANDING = {"stdint.h", "stddef.h"}

# The compiler's own headers of instructions: (file, header).
INSTRUCTIONS = {("firmware/fuzzy/packed_bilinear.hpp", "arm_acle.h")}
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(?:"([^"]*)"|<([^>]*)>|(\S+))', re.MULTILINE)


def stage_of(path):
    """The stage of a file of firmware/, or None for one that no stage is known for."""
    parts = pathlib.PurePosixPath(path).parts
    stage = parts[1].split(".")[0] if len(parts) > 1 else ""
    return stage if stage in STAGES else None


def firmware_error(path, quoted, system):
    if system is not None:
        known = system in FREESTANDING or (path, system) in INSTRUCTIONS
        return None if known else "the core has only <stdint.h> and <stddef.h>"
    stage = stage_of(path)
    if stage is None:
        return f"unknown stage: add it to STAGES, in its place ({', '.join(STAGES)})"
    if quoted.startswith("hal/"):
        return None if quoted in HAL_OF_STAGE.get(stage, ()) else f"not among {stage}'s HAL headers"
    if not quoted.startswith("firmware/"):
        return "the core includes firmware/ and the HAL contracts only"
    target = stage_of(quoted)
    if target is None:
        return "unknown stage"
    if STAGES.index(target) > STAGES.index(stage) and (stage, target) not in EXCEPTIONS:
        return f"{target} is above {stage}"
    return None


def hal_error(path, quoted, system):
    backend = path.split("/")[1] if path.count("/") > 1 else None
    if backend is None:
        if system is not None:
            return None if system in FREESTANDING else "a contract has only <stdint.h> and <stddef.h>"
        return None if re.fullmatch(r"hal/[^/]+", quoted) else "a contract includes other contracts only"
    if system is not None or re.fullmatch(rf"hal/({backend}/.+|[^/]+)", quoted):
        return None
    if quoted.startswith(("firmware/", "host/sim/")):
        return None
    return "a backend includes firmware/, the contracts, itself and host/sim/"


def image_error(quoted, system):
    if system is not None:
        return None if system in FREESTANDING else "an image has only <stdint.h> and <stddef.h>"
    if quoted.startswith(("firmware/", "images/", "hal/can_remote/", "hal/link/", "hal/slcan/")) or re.fullmatch(r"hal/[^/]+", quoted):
        return None
    return "an image includes firmware/, the contracts, hal/can_remote/, hal/link/, hal/slcan/ and images/: the board is linked"


def errors(path, text, exists):
    """(line, message) for every wrong #include of this file. exists(path) says what the tree has."""
    found = []
    for match in INCLUDE.finditer(text):
        quoted, system, computed = match.groups()
        target = quoted if quoted is not None else system
        error = None
        if computed is not None:
            error = "a computed include cannot be checked"
        elif pathlib.PurePosixPath(target).is_absolute():
            error = "an absolute path"
        elif quoted is not None and not exists(quoted):
            error = "quotes are for files of the project, written from its root"
        elif quoted is not None and quoted.startswith("tests/") and not path.startswith("tests/"):
            error = "only tests include tests/"
        elif path.startswith("firmware/"):
            error = firmware_error(path, quoted, system)
        elif path.startswith("hal/"):
            error = hal_error(path, quoted, system)
        elif path.startswith("images/"):
            error = image_error(quoted, system)
        if error:
            found.append((text.count("\n", 0, match.start()) + 1, f"{match.group().strip()}: {error}"))
    return found


def main(root):
    root = pathlib.Path(root)
    files = [path.as_posix() for path in sources(root)]
    problems = [
        f"{path}:{line}: {message}"
        for path in files
        for line, message in errors(path, (root / path).read_text(), lambda p: (root / p).is_file())
    ]
    return finish("include direction", len(files), problems)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
