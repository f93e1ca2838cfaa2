"""Every address, register and bit constant in the drivers of a board matches the table of facts of its chip.

usage: registers.py ROOT [--used-rows BOARD TABLE]    --used-rows prints the rows of a larger table that are needed
"""

import csv
import pathlib
import re
import sys

BOARDS = ("pico", "stm32f405")
REG = "hal/boards/{}/reg"
FACTS = "tests/boards/{}_registers.csv"
COLUMNS = ("peripheral", "base", "register", "offset", "reset", "field", "lsb", "width")

CONSTANT = re.compile(
    r"inline constexpr (Address|Register|Field|PinField) (k\w+)(\[\])?\s*(?:= )?([^;]*);\s*///< ([^\n]*)")
NAMESPACE = re.compile(r"namespace whisker::hal::(?:pico|stm32f405)::(\w+) \{(?:  // ([A-Z0-9_ ]+))?\n")
PLAIN = re.compile(r"inline constexpr uint8_t k\w+ = \d+;")
NUMBER = re.compile(r"0x[0-9A-Fa-f]+|\d+")
FIELDS_OF = {"Address": 1, "Register": 1, "Field": 3, "PinField": 3}


class Facts:
    """The table: bases by peripheral, offsets by register, (offset, lsb, width) by field."""

    def __init__(self, rows):
        self.base, self.register, self.field = {}, {}, {}
        for row in rows:
            p, r = row["peripheral"], row["register"]
            self.base[p] = int(row["base"], 16)
            self.register[p, r] = int(row["offset"], 16)
            self.field[p, r, row["field"]] = (int(row["offset"], 16), int(row["lsb"]), int(row["width"]))


def constants(text):
    """(kind, name, list of number lists, fact names) for each constant; ValueError for any other line."""
    found = []
    body = text[NAMESPACE.search(text).end():text.rindex("}  // namespace")]
    rest = PLAIN.sub("", CONSTANT.sub("", body)).strip()
    if rest:
        raise ValueError(f"not a constant with the name of its fact: {rest.splitlines()[0]}")
    for kind, name, _, numbers, names in CONSTANT.findall(body):
        numbers = [int(n, 0) for n in NUMBER.findall(numbers)]
        size = FIELDS_OF[kind]
        groups = [numbers[i:i + size] for i in range(0, len(numbers), size)]
        names = names.split()
        if len(groups) != len(names) or any(len(group) != size for group in groups):
            raise ValueError(f"{name}: {len(groups)} values, {len(names)} names")
        found += [(kind, name, group, fact) for group, fact in zip(groups, names)]
    return found


def series(names):
    """A0..A3 as A0, A1, A2, A3; any other name as itself."""
    if ".." not in names:
        return [names]
    first, last = re.fullmatch(r"(\w+?)(\d+)\.\.(\w+?)(\d+)", names).group(2, 4)
    stem = re.match(r"\D+", names).group()
    return [f"{stem}{n}" for n in range(int(first), int(last) + 1)]


def expected(kind, group, fact, peripheral):
    """{key of the table: expected value} for one constant of one peripheral."""
    if kind == "Address":
        return {("base", fact): group[0]}
    if kind == "Register":
        return {("register", peripheral, fact): group[0]}
    register, names = fact.split(".", 1)
    names = series(names)
    if kind == "PinField":
        offset, width, first = group
        pins = [int(re.search(r"\d+$", name).group()) for name in names]
        return {("field", peripheral, register, name): (offset, (pin - first) * width, width)
                for name, pin in zip(names, pins)}
    offset, lsb, width = group
    if len(names) == 1:
        return {("field", peripheral, register, names[0]): (offset, lsb, width)}
    if len(names) != width:
        raise ValueError(f"{fact}: {len(names)} bits, and a width of {width}")
    return {("field", peripheral, register, name): (offset, lsb + i, 1) for i, name in enumerate(names)}


def check(headers, facts):
    """(problems, used keys, number of constants checked)."""
    problems, used, checked = [], set(), 0
    for path, text in headers.items():
        try:
            peripherals = (NAMESPACE.search(text).group(2) or "").split() or [None]
            for kind, name, group, fact in constants(text):
                checked += 1
                known = False
                for peripheral in peripherals:
                    for key, says in expected(kind, group, fact, peripheral).items():
                        table = getattr(facts, key[0])
                        index = key[1] if len(key) == 2 else key[1:]
                        if index not in table:
                            continue
                        known = True
                        used.add(key)
                        if table[index] != says:
                            problems.append(f"{path}: {name}: {fact} is {table[index]}, not {says}")
                if not known:
                    problems.append(f"{path}: {name}: the table has no {fact}")
        except ValueError as error:
            problems.append(f"{path}: {error}")
    return problems, used, checked


def rows_of(path):
    """A row a field, from the table's row a register."""
    lines = [line for line in pathlib.Path(path).read_text().splitlines() if not line.startswith("#")]
    return [dict(zip(COLUMNS, register + field.split(":")))
            for *register, fields in csv.reader(lines[1:]) for field in fields.split()]


def table_of(rows):
    """The rows as lines of the table."""
    registers = {}
    for *register, field, lsb, width in (row.values() for row in rows):
        registers.setdefault(",".join(register), []).append(f"{field}:{lsb}:{width}")
    return [f"{register},{' '.join(fields)}" for register, fields in registers.items()]


def keys_of(row):
    p, r = row["peripheral"], row["register"]
    return {("base", p), ("register", p, r), ("field", p, r, row["field"])}


def headers_of(root, board):
    folder = pathlib.Path(root, REG.format(board))
    return {f"{REG.format(board)}/{path.name}": path.read_text() for path in sorted(folder.glob("*.hpp"))}


def needed(rows, used):
    """The rows for the fields that are used, and one for each register and base that no field names."""
    chosen, missing = [], set(used)
    for precise in (True, False):
        for row in rows:
            keys = keys_of(row)
            wanted = [k for k in keys if k[0] == "field"] if precise else keys
            if row not in chosen and missing & set(wanted):
                chosen.append(row)
                missing -= keys
    return sorted(chosen, key=lambda row: (row["peripheral"], int(row["offset"], 16), int(row["lsb"])))


def check_board(root, board):
    headers, table = headers_of(root, board), FACTS.format(board)
    rows = rows_of(pathlib.Path(root, table))
    problems, used, checked = check(headers, Facts(rows))
    wanted = needed(rows, used)
    problems += [f"{table}: no driver uses {'.'.join(r[c] for c in ('peripheral', 'register', 'field'))}"
                 for r in rows if r not in wanted]
    if checked == 0:
        problems.append(f"{REG.format(board)}: nothing to check")
    for problem in problems:
        print(problem)
    print(f"registers of {board}: {checked} constants, {len(rows)} facts, {len(problems)} wrong")
    return len(problems)


def main(root, *options):
    if options[:1] == ("--used-rows",):
        rows = rows_of(options[2])
        used = check(headers_of(root, options[1]), Facts(rows))[1]
        print("\n".join(table_of(needed(rows, used))))
        return 0
    return 1 if sum(check_board(root, board) for board in BOARDS) else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
