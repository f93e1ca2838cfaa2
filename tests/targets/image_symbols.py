"""Every linked image is free of heap, floating point, guards, exceptions and libc."""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts/lib"))

import chips  # noqa: E402

TOOLS = {"cortex": "arm-none-eabi-", "rv32im": "riscv64-unknown-elf-"}
PROGRAMS = ["bare", "bare-map", "replay"]

# Linker symbols that no image may contain.
FORBIDDEN = re.compile(
    r"malloc|calloc|realloc|free|_sbrk|_Zn[wa][jmy](RKSt9nothrow_t|St\w*)?|_Zd[la]\w*"
    r"|_ZGV\w*|__cxa_(?!pure_virtual)\w*|__gxx_\w*|_Unwind_\w*|__dso_handle|__aeabi_atexit|atexit"
    r"|__aeabi_(f|d|cf|cd)(add|sub|rsub|mul|div|cmp\w*|2\w+)|__aeabi_u?[il]2[fd]"
    r"|__(add|sub|mul|div|neg|eq|ne|lt|le|gt|ge|unord|cmp)[sd]f[23]|__(fix|fixuns|float|floatun)\w*|__extend\w*|__trunc\w*"
    r"|printf|puts|putchar|abort|__libc\w*|_impure_\w*"
)


def symbols(prefix, image):
    text = subprocess.run([prefix + "nm", "--format=posix", image], capture_output=True, text=True, check=True).stdout
    return {line.split()[0] for line in text.splitlines() if line}


def forbidden(names):
    return sorted(name for name in names if FORBIDDEN.fullmatch(name))


def main():
    checked, problems = 0, []
    for build, target in chips.sample():
        prefix = next((tool for start, tool in TOOLS.items() if build.startswith(start)), None)
        more = ["can-node", "guard-node"] if target.board in ("mps2", "virt") else []
        more += ["can-node-stm32f103", "guard-node-stm32f103"] if build == "cortex-m3" else []
        for program in PROGRAMS + more if prefix else ():
            image = chips.image(build, target, program)
            checked += 1
            problems += [f"{image}: {name}" for name in forbidden(symbols(prefix, image))]
    print(*problems, sep="\n")
    print(f"image symbols: {checked} images, {len(problems)} problems")
    return 1 if problems or not checked else 0


if __name__ == "__main__":
    sys.exit(main())
