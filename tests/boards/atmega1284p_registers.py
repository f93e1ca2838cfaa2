"""The registers and bits that the drivers of the ATmega328P name are those of avr-libc's header.

usage: atmega328p_registers.py ROOT HEADER [--alter]     --alter: every constant with one bit changed must be noticed
"""

import pathlib
import re
import sys

CONSTANT = re.compile(r"inline constexpr (Register k(\w+)\{(\w+)\};|uint8_t k(\w+) = bit\((\w+)\);)")
DEFINE = re.compile(r"#define\s+(\w+)\s+(?:_SFR_IO8\s*\((\w+)\)|_SFR_MEM8\s*\((\w+)\)|(\d+)\s*(?:/\*.*)?$)", re.MULTILINE)
IO_OFFSET = 0x20


def facts_of(header):
    facts = {}
    for name, io, memory, number in DEFINE.findall(header):
        facts[name] = int(io, 0) + IO_OFFSET if io else int(memory or number, 0)
    return facts


def problems_of(constants, facts):
    return [f"{name}: {facts.get(name)}, not {value}" for name, value in constants if facts.get(name) != value]


def main(root, header, *options):
    text = pathlib.Path(root, "hal/boards/atmega1284p/registers.hpp").read_text()
    facts = facts_of(pathlib.Path(header).read_text())
    constants = [(r or b, int(address or n, 0)) for _, r, address, b, n in CONSTANT.findall(text)]
    problems = problems_of(constants, facts)
    if len(constants) != text.count("inline constexpr"):
        problems.append("a constant that is neither register nor bit")
    if options == ("--alter",):
        for i, (name, value) in enumerate(constants):
            if not problems_of([(name, value ^ 1)], facts):
                problems.append(f"constant {i}, {name}: altered, and unnoticed")
    print("\n".join(problems))
    print(f"atmega328p_registers: {len(constants)} constants, {len(problems)} wrong")
    return 1 if problems or not constants else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
