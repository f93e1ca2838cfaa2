"""The targets, as the files of toolchain/ declare them. Used by scripts/chip, golden and budget."""

import json
import os
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = ROOT / "build"
ENGINES = ("table", "closed")

# Time limit of a run; only a broken image reaches it.
SECONDS = "600"

# One instruction is 2^shift ns of the emulator's time.
QEMU = "-display none -monitor none -semihosting-config enable=on,target=native"
EMULATORS = {
    "qemu-arm": "qemu-system-arm -M {} -icount shift=10 " + QEMU,
    "qemu-riscv": "qemu-system-riscv32 -M {} -bios none -icount shift=0 " + QEMU,
    "node": "node " + str(ROOT / "hal/emulated/wasm/run.mjs"),
}


class Target:
    """A toolchain file that names a board, with its WHISKER_TITLE, WHISKER_RUNS_ON and so on."""

    def __init__(self, path):
        text = path.read_text()
        facts = dict(re.findall(r'^set\(WHISKER_(\w+) "?([^")]*)"?\)', text, re.MULTILINE))
        self.name = path.stem
        self.title, self.board = facts.get("TITLE"), facts.get("BOARD")
        emulator, _, self.machine = facts.get("RUNS_ON", "").partition(" ")
        self.emulator = EMULATORS.get(emulator, "").format(self.machine)
        self.runs_on = f"QEMU `{self.machine}`" if self.machine else {"node": "Node.js"}.get(emulator, emulator)
        self.compilers = facts.get("COMPILERS", "").split()
        self.builds = [self.name, *(f"{self.name}-{c}" for c in self.compilers[1:])]
        # Those of the default run of scripts/test.
        self.by_day = [b for b, c in zip(self.builds, self.compilers) if c in facts.get("BY_DAY", "").split()]
        self.recording = facts.get("RECORDING", "full")  # largest golden recording that is fast enough on it
        self.counts = facts.get("COUNTS")
        self.in_budget = "BUDGET" in facts  # scripts/budget measures it
        self.is_robot = (ROOT / "hal/boards" / str(self.board)).is_dir()
        self.suffix = ".wasm" if ".wasm" in text else ".elf"
        self.tools = "riscv64-unknown-elf-" if "riscv" in text else "arm-none-eabi-"

    def command(self, image, serial=False):
        """serial: standard input and output are the board's UART instead of its faster semihosting channel."""
        # In the foreground, so that ending the process group also ends the emulator: QEMU ignores SIGTERM while it
        # waits for input.
        parts = ["timeout", "--foreground", "--kill-after=5", SECONDS, *self.emulator.split()]
        if self.emulator.startswith("qemu"):
            parts += ["-serial", "stdio" if serial else "none", "-kernel"]
        return [*parts, str(image)]

    def command_in_time(self, image, serial):
        """The command that runs in real time until terminated. serial: QEMU's device for the board's UART."""
        # One thread: otherwise a chip that polls its UART holds the lock that the UART's input thread needs.
        emulator = re.sub(r"-icount \S+", "-accel tcg,thread=single", self.emulator)
        return [*emulator.split(), "-serial", serial, "-kernel", str(image)]


ALL = [t for t in map(Target, sorted(ROOT.glob("toolchain/*.cmake"))) if t.title]
TARGETS = {t.name: t for t in ALL if not t.is_robot}
# Boards whose program is a complete robot.
ROBOTS = {t.name: t for t in ALL if t.is_robot}


def builds():
    """(preset, target) of each target that runs in an emulator."""
    return [(build, target) for target in TARGETS.values() for build in target.builds]


def sample():
    """The builds that the default run of scripts/test makes and compares: one of each kind; with WHISKER_LONG, all."""
    return [(build, target) for build, target in builds() if build in target.by_day or "WHISKER_LONG" in os.environ]


def image(build, target, program):
    return BUILD / build / "firmware/apps" / (program + target.suffix)


def presets():
    """toolchain/presets.json."""

    def preset(name, inherits, title):
        file = next(t.name for t in ALL if name in t.builds)
        return {
            "name": name,
            "displayName": title,
            "inherits": inherits,
            "toolchainFile": f"${{sourceDir}}/toolchain/{file}.cmake",
        }

    # No cache of compiled files: it would not keep the call graphs (bare_metal.cmake).
    plain = {
        "CMAKE_BUILD_TYPE": "Release", "CMAKE_CXX_COMPILER_LAUNCHER": "", "WHISKER_HOST": "OFF", "WHISKER_TESTS": "OFF",
        "WHISKER_IMAGES": "ON",
    }
    hidden = [
        {"name": "base", "hidden": True, "generator": "Ninja", "binaryDir": "${sourceDir}/build/${presetName}"},
        {"name": "chip", "hidden": True, "inherits": "base", "cacheVariables": plain},
        {"name": "chip-clang", "hidden": True, "inherits": "chip", "cacheVariables": {"WHISKER_CLANG": "ON"}},
    ]
    named = []
    for target in ALL:
        on = f"{target.title} ({target.runs_on.replace('`', '')})"
        named.append(preset(target.name, "chip", on))
        named += [preset(b, "chip-clang", on + ", clang 14") for b in target.builds[1:]]
    builds = [{"name": p["name"], "configurePreset": p["name"]} for p in named]
    whole = {"version": 6, "configurePresets": hidden + named, "buildPresets": builds}
    return json.dumps(whole, indent=2) + "\n"


def table():
    """The table of docs/porting.md."""
    rows = ["| preset | chip | compilers | runs on | instruction counter |", "|---|---|---|---|---|"]
    for t in TARGETS.values():
        rows.append(f"| `{t.name}` | {t.title} | {', '.join(t.compilers)} | {t.runs_on} | {t.counts} |")
    return "\n".join(rows) + "\n"


def documents():
    """(file, content) of each file generated from toolchain/."""
    yield ROOT / "toolchain/presets.json", presets()
    page = ROOT / "docs/porting.md"
    marks = "<!-- targets:begin -->\n", "<!-- targets:end -->\n"
    before, _, rest = page.read_text().partition(marks[0])
    yield page, before + marks[0] + table() + marks[1] + rest.partition(marks[1])[2]
