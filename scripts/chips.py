"""The targets: how each image is run, and what it may be held to. Used by scripts/chip, golden and budget."""

import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = ROOT / "build"
ENGINES = ("table", "closed")

# A runaway ends after this; only ever met by a broken image.
SECONDS = "600"

# One instruction is 2^shift ns of the emulator's time.
QEMU = "-display none -monitor none -semihosting-config enable=on,target=native"
ARM = "qemu-system-arm -M {} -icount shift=10 " + QEMU
RISCV = "qemu-system-riscv32 -M virt -bios none -icount shift=0 " + QEMU
AVR = str(BUILD / "host/whisker_avr")
NODE = "node " + str(ROOT / "hal/emulated/wasm/run.mjs")


class Target:
    def __init__(self, name, emulator, suffix=".elf", compilers=("gcc",), recording="full", counts="instructions"):
        self.name = name
        self.emulator = emulator
        self.suffix = suffix
        self.builds = [name + ("" if c == "gcc" else "-clang") for c in compilers]
        self.recording = recording  # which of the golden recordings it is fast enough for
        self.counts = counts  # what its meter gives, or None

    def command(self, image, serial=False):
        """serial: standard input and output are the board's UART instead of its fast way to the host."""
        # In the foreground: who ends the process group ends the emulator, too. QEMU that waits for input hears no
        # SIGTERM.
        parts = ["timeout", "--foreground", "--kill-after=5", SECONDS, *self.emulator.split()]
        if self.emulator.startswith("qemu"):
            parts += ["-serial", "stdio" if serial else "none", "-kernel"]
        return [*parts, str(image)]

    def command_in_time(self, image, serial):
        """The emulator's clock is this computer's. serial: what QEMU shall take for the board's UART. Until it is
        ended."""
        # One thread: a chip that polls its UART would else hold the lock that the thread that brings its bytes needs.
        emulator = re.sub(r"-icount \S+", "-accel tcg,thread=single", self.emulator)
        return [*emulator.split(), "-serial", serial, "-kernel", str(image)]


BOTH = ("gcc", "clang")
TARGETS = {
    t.name: t
    for t in (
        Target("cortex-m0plus", ARM.format("microbit"), compilers=BOTH),
        Target("cortex-m3", ARM.format("mps2-an385"), compilers=BOTH),
        Target("cortex-m4", ARM.format("mps2-an386"), compilers=BOTH),
        Target("cortex-m7", ARM.format("mps2-an500"), compilers=BOTH),
        Target("cortex-m33", ARM.format("mps2-an505"), compilers=BOTH),
        Target("rv32imac", RISCV, compilers=BOTH),
        Target("atmega1284p", AVR, recording="short", counts="cycles"),
        Target("wasm32", NODE, suffix=".wasm", counts=None),
    )
}


# Boards with a whole robot as their program: preset -> prefix of its tools.
ROBOTS = {"stm32f405": "arm-none-eabi-"}


def builds():
    """(preset, target) of everything that runs in an emulator alone."""
    return [(build, target) for target in TARGETS.values() for build in target.builds]


def image(build, target, program):
    return BUILD / build / "firmware/apps" / (program + target.suffix)
