"""Every linked image is free of heap, floating point, guards, exceptions and libc, and of two known code generation
faults of clang 14 for AVR."""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

import chips  # noqa: E402

TOOLS = {"cortex": "arm-none-eabi-", "rv32im": "riscv64-unknown-elf-", "atmega": "avr-"}
PROGRAMS = [f"{program}-{engine}" for program in ("bare", "replay", "companion") for engine in chips.ENGINES]

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


# AVR instructions that do not change the flags.
QUIET = {"mov", "movw", "ldi", "ld", "ldd", "lds", "st", "std", "sts", "in", "out", "push", "pop", "lpm", "elpm"}


def follows(before, operands):
    """Whether `operands`, without an offset, load the register after one at offset 63 of the same pointer."""
    first, second = (re.findall(r"\br(\d+)\b", text) for text in (before, operands))
    pointer = re.search(r"\b([YZ])\+63\b", before)
    return bool(first and second and pointer and re.search(rf"\b{pointer[1]}(?!\+)\b", operands)
                and int(second[0]) == int(first[0]) + 1)


def miscompiled(listing):
    """Finds two faults of clang 14 for AVR: after it turns an addition into a subtraction, it uses the carry without
    inverting it; it reads the upper byte of a half word at offset 63 from offset 0, because 64 loses its top bit."""
    function, flags, before, found = "?", "", "", []
    for line in listing.splitlines():
        if head := re.match(r"[0-9a-f]+ <(.*)>:$", line):
            function, flags, before = head[1], "", ""
            continue
        parts = line.split("\t")
        if len(parts) < 3:
            continue
        operation, operands = parts[2].strip(), parts[3] if len(parts) > 3 else ""
        if operation == "adc" and flags in ("subi", "sbci"):
            found.append(f"{function}: a borrow taken for a carry")
        if operation in ("ld", "st") and follows(before, operands):
            found.append(f"{function}: an offset beyond 63")
        if operation not in QUIET:
            flags = operation
        before = operands
    # libgcc's division uses a borrow as carry on purpose.
    return [problem for problem in found if not problem.startswith("__udivmod")]


def main():
    checked, problems = 0, []
    for build, target in chips.sample():
        prefix = next((tool for start, tool in TOOLS.items() if build.startswith(start)), None)
        more = [] if prefix == "avr-" else ["bare-map-table"]
        more += ["can-node", "guard-node"] if "mps2" in target.emulator else []
        more += ["can-node-stm32f103", "guard-node-stm32f103"] if target.name == "cortex-m3" else []
        for program in PROGRAMS + more if prefix else ():
            image = chips.image(build, target, program)
            checked += 1
            problems += [f"{image}: {name}" for name in forbidden(symbols(prefix, image))]
            if prefix == "avr-":
                listing = subprocess.run([prefix + "objdump", "-dC", image], capture_output=True, text=True, check=True)
                problems += [f"{image}: {what}" for what in miscompiled(listing.stdout)]
    print(*problems, sep="\n")
    print(f"image symbols: {checked} images, {len(problems)} problems")
    return 1 if problems or not checked else 0


if __name__ == "__main__":
    sys.exit(main())
