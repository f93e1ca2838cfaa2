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


def main(root):
    facts = registers.Facts(registers.rows_of(pathlib.Path(root, registers.FACTS)))
    headers = registers.headers_of(root)
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
    drivers = pathlib.Path(root, "hal/boards/stm32f405")
    for path in sorted(drivers.glob("*.[ch]pp")):
        for number in re.findall(r"0x[0-9A-Fa-f']{8,}", path.read_text()):
            if int(number.replace("'", ""), 16) >= 0x20000000:
                problems.append(f"{path.name}: {number}: an address belongs into reg/")
    print("\n".join(problems))
    print(f"registers_test: {tried} alterations tried, {len(problems)} problems")
    return 1 if problems or tried < 300 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
