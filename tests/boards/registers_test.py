"""The gate on register constants passes on the tree, and fails if any number is altered.

usage: registers_test.py ROOT
"""

import pathlib
import re
import sys

import registers


def altered(text):
    """A header of one constant with one number changed, for every number of every constant."""
    opening = registers.NAMESPACE.search(text).group()
    for match in registers.CONSTANT.finditer(text):
        line, start = match.group(), match.start()
        for number in registers.NUMBER.finditer(text, *match.span(4)):
            value = int(number.group(), 0) ^ 1
            wrong = line[:number.start() - start] + str(value) + line[number.end() - start:]
            yield match.group(2), f"{opening}{wrong}\n}}  // namespace"


# Assembly, which has no constants of reg/, and numbers that are no addresses: sums and a magic.
NO_ADDRESSES = {"pico": ("boot2.cpp", "divider.cpp", "image.hpp", "startup.cpp"), "stm32f405": ()}


def try_board(root, board):
    """(problems, number of alterations)"""
    facts = registers.Facts(registers.rows_of(pathlib.Path(root, registers.FACTS.format(board))))
    headers = registers.headers_of(root, board)
    problems = registers.check(headers, facts)[0]
    tried = 0
    for path, text in headers.items():
        for name, wrong in altered(text):
            tried += 1
            if not registers.check({path: wrong}, facts)[0]:
                problems.append(f"{path}: {name}: an altered number went unseen")
        for extra in ("inline constexpr Field kNew{0x00, 0, 1};\n", "inline constexpr uint32_t kMagic = 0x40;\n"):
            body = text.replace("}  // namespace", extra + "}  // namespace")
            if not registers.check({path: body}, facts)[0]:
                problems.append(f"{path}: {extra.strip()} went unseen")
    for path in sorted(pathlib.Path(root, "hal/boards", board).glob("*.[ch]pp")):
        for number in re.findall(r"0x[0-9A-Fa-f']{8,}", path.read_text()):
            if int(number.replace("'", ""), 16) >= 0x20000000 and path.name not in NO_ADDRESSES[board]:
                problems.append(f"{path.name}: {number}: an address belongs into reg/")
    return problems, tried


def main(root):
    failed = False
    for board in registers.BOARDS:
        problems, tried = try_board(root, board)
        print("\n".join(problems))
        print(f"registers_test of {board}: {tried} alterations tried, {len(problems)} problems")
        failed = failed or bool(problems) or tried < 200
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
