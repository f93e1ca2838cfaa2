"""The examples of host/rules/examples, from file to answers on an emulated Cortex-M0+: the pages and the test of the rule compiler."""

import concurrent.futures
import dataclasses
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import tempfile

from campaigns import ROOT, WHISKER, Section, fail, heading, line, place_in, table

PAGE = ROOT / "docs/rules.md"
PROGRAMS = ROOT / "docs/integration/rules"
RULES = "host/rules/examples"
EXAMPLES = {
    "thesis.toml": "the thesis: 25 rules, two outputs",
    "tip.fis": "a tip calculator: Mamdani, centroid, with NOT, OR and a weight",
    "pendulum.fll": "an inverted pendulum: 25 rules, Mamdani, centroid",
    "fan.fcl": "a fan controller with a proportional and a derivative part: singletons",
    "follower.fis": "a follower: Takagi-Sugeno of order 1, two outputs",
}
TOOLS = ("make", "gcc", "arm-none-eabi-gcc", "arm-none-eabi-nm", "arm-none-eabi-objdump", "qemu-system-arm")
# Inputs asked beside those on the page.
RANDOM, SEED = 25, 20260701
# A printed value is rounded to the fourth decimal.
PRINTED = 0.5001e-4
EXACT = 1e-9


class Wrong(Exception):
    pass


def run(*command, **options):
    done = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False, **options)
    if done.returncode:
        raise Wrong(f"{' '.join(map(str, command))}: exit status {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


@dataclasses.dataclass
class Answers:
    """What a program prints."""

    lines: list
    asked: list  # [({input: raw}, {output: (shown, raw)})]
    cost: str
    inputs: int
    checksum: str


def parse(text):
    *lines, last = text.splitlines()
    whole = re.fullmatch(r"(\d+) inputs, checksum (\d+)", last)
    if not whole:
        raise Wrong(f"no checksum in\n{text}")
    cost = lines.pop() if lines[-1].startswith("a look-up: ") else ""
    asked = []
    for line in lines:
        left, right = ({name: (float(shown), int(raw)) for name, shown, raw in re.findall(r"(\w+) (-?[\d.]+) \((-?\d+)\)", half)}
                       for half in line.split(" -> "))  # fmt: skip
        asked.append(({name: raw for name, (_, raw) in left.items()}, right))
    return Answers(lines, asked, cost.removeprefix("a look-up: "), int(whole[1]), whole[2])


class Example:
    def __init__(self, name, work):
        self.rules, self.stem = f"{RULES}/{name}", name.partition(".")[0]
        self.folder = work / self.stem
        shutil.copytree(PROGRAMS, self.folder)
        self.header = self.folder / "out" / f"{self.stem}.h"
        self.told = json.loads(run(WHISKER, "rules", "compile", self.rules, "--json", cwd=ROOT))
        self.on_page = self.ask_more()

    def ask_more(self):
        """Adds random inputs to the program. Returns the number of those that it had."""
        source = self.folder / f"{self.stem}.c"
        text, mark = source.read_text(), f"  demo_measure(&{self.stem});\n"
        rng = random.Random(SEED)
        more = (", ".join(str(rng.randint(i["raw_low"], i["raw_high"])) for i in self.told["inputs"]) for _ in range(RANDOM))
        source.write_text(text.replace(mark, "".join(f"  demo_ask(&{self.stem}, {raw});\n" for raw in more) + mark))
        return text.count("demo_ask(")

    def make(self, target):
        return run("make", "-s", f"WHISKER={WHISKER}", f"RULES={ROOT / RULES}", target, cwd=self.folder)

    def spoil(self):
        """Adds 1 to a node of the header."""
        text, count = re.subn(r"(?<= = \{\n  )-?\d+", lambda node: str(int(node[0]) + 1), self.header.read_text(), count=1)
        if count != 1:
            raise Wrong(f"{self.header.name} has no node")
        self.header.write_text(text)

    def answers(self, broken):
        """Those of the chip, compared with this computer's and with the exact ones."""
        self.make(f"out/{self.stem}.here")
        here = parse(run(self.folder / f"out/{self.stem}.here"))
        if broken:
            self.spoil()
        self.make(f"out/{self.stem}.elf")
        chip = parse(self.make(f"{self.stem}.answers"))
        if (chip.asked, chip.inputs, chip.checksum) != (here.asked, here.inputs, here.checksum):
            raise Wrong(f"the chip answers otherwise: checksum {chip.checksum}, here {here.checksum}")
        if chip.inputs != self.told["representable_inputs"] or len(chip.asked) != self.on_page + RANDOM:
            raise Wrong(f"{chip.inputs} inputs, {len(chip.asked)} questions")
        return chip

    def judged(self, raw, outputs):
        """[(output, exact, error)] at these raw inputs."""
        at = [f"{i['name']}={i['origin'] + raw[i['name']] / i['raw_per_unit']!r}" for i in self.told["inputs"]]
        exact = dict(line.split(" = ") for line in run(WHISKER, "rules", "show", self.rules, *at, cwd=ROOT).splitlines())
        judged = []
        for o in self.told["outputs"]:
            shown, answer = outputs[o["name"]]
            value = o["origin"] + answer / o["raw_per_unit"]
            error = value - float(exact[o["name"]].split()[0])
            if abs(shown - value) > PRINTED or abs(error) > o["max_error"] + EXACT:
                raise Wrong(f"{', '.join(at)}: {o['name']} {shown} ({answer}), exact {exact[o['name']]}, error at most {o['max_error']}")
            judged.append((o, float(exact[o["name"]].split()[0]), error))
        return judged

    def check_worst(self, chip, judged):
        """The program asks where the compiler says the error is greatest, and it is."""
        for o in self.told["outputs"]:
            at = dict(zip((i["name"] for i in self.told["inputs"]), o["max_error_raw_at"]))
            errors = [abs(error) for (raw, _), row in zip(chip.asked, judged) for output, _, error in row if output is o and raw == at]
            if not errors or abs(errors[0] - o["max_error"]) > EXACT:
                raise Wrong(f"{self.stem}.c does not ask at {at}, or the error of {o['name']} is not {o['max_error']} there: {errors}")

    def sizes(self):
        elf = self.folder / f"out/{self.stem}.elf"
        sizes = {line.split()[3]: int(line.split()[1], 16) for line in run("arm-none-eabi-nm", "-S", "--size-sort", elf).splitlines()}
        if floating := [name for name in sizes if re.match(r"__aeabi_[df]|__\w+[ds]f[23i]", name)]:
            raise Wrong(f"floating point in {elf.name}: {floating}")
        code = run("arm-none-eabi-objdump", "-d", "--disassemble=look_up", elf)
        return sizes["look_up"], sizes[f"{self.stem}_nodes"], len(re.findall(r"\tmuls\t", code))

    def on_a_cortex_m3(self):
        """Instructions of a look-up, from its call to its return. It has no branch, so that it executes what it has."""
        source, made = self.folder / "m3.c", self.folder / "m3.o"
        names = [f"a{i}" for i in range(len(self.told["inputs"]))]
        taken = ", ".join(f"int16_t {name}" for name in names)
        source.write_text(f'#include "{self.header}"\n{self.stem}_outputs f({taken}) {{ return {self.stem}_look_up({", ".join(names)}); }}\n')
        run("arm-none-eabi-gcc", "-mcpu=cortex-m3", "-mthumb", "-Os", "-c", source, "-o", made)
        code = re.findall(r"^ +[0-9a-f]+:\t[0-9a-f ]+\t([a-z.]+)", run("arm-none-eabi-objdump", "-d", "--disassemble=f", made), re.MULTILINE)
        if branches := [c for c in code if re.match(r"b(?!fi|fc|ic)|cb", c) and c != "bx"]:
            raise Wrong(f"the look-up of {self.header.name} branches on a Cortex-M3: {branches}")
        return sum(c not in (".word", "nop") for c in code)

    def row(self, broken=False):
        """Its line of the table on the page."""
        chip = self.answers(broken)
        self.check_worst(chip, [self.judged(*asked) for asked in chip.asked])
        code, table, products = self.sizes()
        name = pathlib.Path(self.rules).name
        files = f"[{name}](../{self.rules}), [program](integration/rules/{self.stem}.c)"
        error = max(o["max_error_percent"] for o in self.told["outputs"])
        return line(files, EXAMPLES[name], f"{error:.2f} %", f"{table:,}", f"{code}", chip.cost.partition(" ins")[0], products, self.on_a_cortex_m3())


def shown(rows):
    """What the page shows."""
    compiler = run("arm-none-eabi-gcc", "-dumpfullversion").strip()
    yield f"`scripts/measure rule-examples`: arm-none-eabi-gcc {compiler}, `-Os`.\n"
    yield heading("rule base", "what it is", "greatest error", "table, bytes", "look-up on the M0+: bytes", "instructions", "of them products", "on a Cortex-M3")
    yield from rows
    told = run(WHISKER, "rules", "compile", f"{RULES}/tip.fis", cwd=ROOT)
    yield f"\n```\n$ whisker rules compile {RULES}/tip.fis --header tip.h\n{told}header: tip.h\n```"


@table("docs/rules.md", check={"action": "store_true", "help": "exit status 1 if the page shows others"},
       broken={"action": "store_true", "help": "one node is wrong in the chip's header only; fails unless the example fails. With WHISKER_LONG "
               "in the environment each of them, otherwise the first"})  # fmt: skip
def rule_examples(o):
    """The examples of host/rules/examples from file to answers on an emulated Cortex-M0+: compiles each to a header, builds its program
    in docs/integration/rules for the chip and for this computer, and runs both. Exit status 1 unless both give the same answers to all
    inputs, and the answers keep the printed bound on exact inference. Needs make, gcc, gcc-arm-none-eabi and QEMU (scripts/setup cross)."""
    if missing := [tool for tool in TOOLS if not shutil.which(tool)]:
        fail(f"not there: {', '.join(missing)} (scripts/setup build cross)")
    chosen = list(EXAMPLES)[:1] if o.broken and "WHISKER_LONG" not in os.environ else list(EXAMPLES)

    def example(name):
        try:
            return Example(name, pathlib.Path(work)).row(o.broken), None
        except Wrong as error:
            return "", f"{name}: {error}"

    with tempfile.TemporaryDirectory() as work, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        rows, errors = zip(*pool.map(example, chosen))
    wrong = [error for error in errors if error]
    if o.broken:
        found = sum("the chip answers otherwise" in error for error in wrong)
        yield f"rule examples: {len(chosen)} broken headers, {found} found"
        o.failed = None if found == len(chosen) else "\n".join(["not noticed", *wrong])
        return
    if wrong:
        fail("\n".join(wrong))
    if not o.check:
        yield Section("docs/rules.md", "examples", made=False)
        yield from shown(rows)
        return
    before, after = place_in(PAGE, "examples")
    if PAGE.read_text() != before + "".join(f"{text}\n" for text in shown(rows)) + after:
        fail(f"{PAGE.name} shows other examples: scripts/measure rule-examples --update")
    yield f"rule examples: {len(EXAMPLES)} on the chip, as on this computer and on the page"
