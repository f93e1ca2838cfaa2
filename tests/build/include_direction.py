"""Every #include names the same or a lower layer. usage: include_direction.py ROOT"""

import pathlib
import re
import sys

from sources import finish, sources

# The folders of firmware/, lowest first: each may include itself and the folders before it. From localization to control
# they are the stages of a tick, in order.
STAGES = ("version", "math", "part", "health", "params", "storage", "calibration", "fuzzy", "localization", "perception", "planning",
          "safety", "control", "chassis", "guard", "robot", "simple_robot", "can", "c", "apps")

# The files of hal/ that a folder may include; an unlisted folder may include none.
HAL_OF_STAGE = {
    "storage": {"hal/storage.hpp"},
    "localization": {"hal/types.hpp"},
    "perception": {"hal/types.hpp"},
    "planning": {"hal/types.hpp"},
    "control": {"hal/types.hpp", "hal/drive.hpp"},
    "can": {"hal/types.hpp", "hal/can_port.hpp"},
    "chassis": {"hal/types.hpp", "hal/rangefinders.hpp", "hal/drive.hpp", "hal/gyro.hpp"},
    "guard": {"hal/types.hpp", "hal/rangefinders.hpp", "hal/drive.hpp", "hal/gyro.hpp"},
    "robot": {"hal/types.hpp", "hal/rangefinders.hpp", "hal/drive.hpp", "hal/bumper.hpp", "hal/gyro.hpp"},
}

FREESTANDING = {"stdint.h", "stddef.h"}

# The compiler's headers of intrinsics: (file, header).
INSTRUCTIONS = {("firmware/fuzzy/packed_bilinear.hpp", "arm_acle.h")}
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(?:"([^"]*)"|<([^>]*)>|(\S+))', re.MULTILINE)


def stage_of(path):
    """The stage of a file of firmware/, or None if no stage is known for it."""
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
    if STAGES.index(target) > STAGES.index(stage):
        return f"{target} is above {stage}"
    return None


CONTRACT = r"hal/[^/]+"

# The files that a folder of hal/ may include besides the contracts and itself.
HAL_FOLDERS = {
    "runtime": r"hal/runtime/.+",
    "ports": r"hal/ports/[^/]+",
    "boards": r"hal/(boards/common|runtime|ports)/[^/]+|firmware/(?!apps/).+",
    "emulated": r"hal/(emulated/common|runtime)/[^/]+",
}


def hal_error(path, quoted, system):
    parts = path.split("/")
    if len(parts) == 2:
        if system is not None:
            return None if system in FREESTANDING else "a contract has only <stdint.h> and <stddef.h>"
        known = re.fullmatch(rf"{CONTRACT}|firmware/math/.+", quoted)
        return None if known else "a contract includes other contracts and firmware/math/ only"
    if parts[1] not in HAL_FOLDERS:
        return f"unknown folder of hal/: one of {', '.join(HAL_FOLDERS)}"
    own = "/".join(parts[:3]) if len(parts) > 3 else "/".join(parts[:2])
    if system is not None or re.fullmatch(rf"{CONTRACT}|{own}/.+|{HAL_FOLDERS[parts[1]]}", quoted):
        return None
    return "a backend includes the contracts, itself and what its kind shares; boards also firmware/ below apps/"


# What a part of host/ includes of host/: the robot without hardware, and on a bus; what draws, measures, compiles and
# calibrates; the command.
HOST_PARTS = {"harness": ("harness",), "lab": ("harness", "lab"), "cli": ("harness", "lab", "cli")}


def host_error(path, quoted):
    part = path.split("/")[1]
    if part not in HOST_PARTS:
        return f"unknown part of host/: one of {', '.join(HOST_PARTS)}"
    within = quoted is None or not quoted.startswith("host/") or quoted.split("/")[1] in HOST_PARTS[part]
    return None if within else f"host/{part}/ includes of host/ only {', '.join(HOST_PARTS[part])}"


def app_error(quoted, system):
    if system is not None:
        return None if system in FREESTANDING else "a program for a chip has only <stdint.h> and <stddef.h>"
    if re.fullmatch(rf"{CONTRACT}|firmware/.+|hal/ports/(slcan/.+|(can_queue|two_ports)\.hpp)|hal/boards/.+", quoted):
        return None
    return "a program for a chip includes firmware/, the contracts, hal/ports/slcan/, the queues of ports, two ports as one, and its board"


def errors(path, text, exists):
    """(line, message) for every wrong #include of this file. exists(path): whether the tree has the file."""
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
        elif path.startswith("firmware/apps/"):
            error = app_error(quoted, system)
        elif path.startswith("firmware/"):
            error = firmware_error(path, quoted, system)
        elif path.startswith("hal/"):
            error = hal_error(path, quoted, system)
        elif path.startswith("host/"):
            error = host_error(path, quoted)
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
