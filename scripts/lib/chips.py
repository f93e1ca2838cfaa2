"""The targets, as the files of toolchain/ declare them. Used by scripts/chip, golden and budget."""

import os
import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build"

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
    """(name, target) of each target that runs in an emulator."""
    return [(build, target) for target in TARGETS.values() for build in target.builds]


def sample():
    """The builds that the default run of scripts/test makes and compares: one of each kind; with WHISKER_LONG, all."""
    return [(build, target) for build, target in builds() if build in target.by_day or "WHISKER_LONG" in os.environ]


def image(build, target, program):
    return BUILD / build / "firmware/apps" / (program + target.suffix)


def make(name, jobs):
    """Builds the images of a target."""
    target, folder = next(t for t in ALL if name in t.builds), BUILD / name
    clang = ["-D", "WHISKER_CLANG=ON"] if name in target.builds[1:] else []
    toolchain = ROOT / f"toolchain/{target.name}.cmake"
    subprocess.run(["cmake", "--preset", "chip", "-B", folder, "--toolchain", toolchain, *clang], cwd=ROOT, stdout=subprocess.DEVNULL, check=True)
    subprocess.run(["cmake", "--build", folder, "-j", str(jobs), "--", "--quiet"], cwd=ROOT, check=True)


def table():
    """The table of docs/porting.md."""
    rows = ["| target | chip | compilers | runs on | instruction counter |", "|---|---|---|---|---|"]
    for t in TARGETS.values():
        rows.append(f"| `{t.name}` | {t.title} | {', '.join(t.compilers)} | {t.runs_on} | {t.counts} |")
    return "\n".join(rows) + "\n"


def page():
    """(docs/porting.md, its text with the table)"""
    path, marks = ROOT / "docs/porting.md", ("<!-- targets:begin -->\n", "<!-- targets:end -->\n")
    before, _, rest = path.read_text().partition(marks[0])
    return path, before + marks[0] + table() + marks[1] + rest.partition(marks[1])[2]
