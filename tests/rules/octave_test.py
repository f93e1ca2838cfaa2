"""`whisker rules` against GNU Octave's fuzzy-logic-toolkit: the files that it ships, and random ones.

usage: octave_test.py WHISKER [unittest options]
Needs octave-cli with the toolkit (scripts/setup octave) and gcc. OCTAVE_SEED is the first seed of the random files (random, printed),
OCTAVE_COUNT their number.

An exact answer must be within Octave's resolution, and one of the compiled header within the printed bound more. Octave
samples sets at POINTS places; octave_answers.m derives from the samples where the answer of the sets themselves may be.
"""

import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "cli"))
import whisker  # noqa: E402
from random_fis import random_fis  # noqa: E402
from whisker import Case  # noqa: E402

OCTAVE = "octave-cli"
POINTS = 2001
SEED = int(os.environ.get("OCTAVE_SEED") or random.SystemRandom().randrange(1, 10**6))
COUNT = int(os.environ.get("OCTAVE_COUNT") or 40)
# Whisker's own accuracy, share of the range.
ACCURACY = 2e-9
# A resolution above this share of the range says nothing.
UNDECIDED = 0.02
VARIABLE = r"(?ms)^\s*\[%s\d+\].*?Name\s*=\s*'([^']*)'.*?Range\s*=\s*\[\s*(\S+)\s+(\S+?)\s*\]"


def octave(*arguments, **options):
    command = [OCTAVE, "--no-gui", "--norc", "--quiet", *map(str, arguments)]
    return subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False, **options)


def variables(section, text):
    """Name, lowest and highest value of each."""
    return [(name, float(low), float(high)) for name, low, high in re.findall(VARIABLE % section, text)]


class Base:
    """A rule base in a folder of its own copy, with inputs to compare at."""

    def __init__(self, folder, key, text, octaves_text=None, own=False, points=POINTS):
        self.key, self.text, self.own, self.points = key, text, own, points
        self.path = folder / f"{key}.fis"
        self.path.write_text(text, encoding="utf-8")
        (folder / "octave").mkdir(exist_ok=True)
        (folder / "octave" / f"{key}.fis").write_text(octaves_text or text, encoding="utf-8")
        self.inputs, self.outputs = variables("Input", text), variables("Output", text)
        self.table = None
        self.rows = []

    def refusal(self):
        """What the command says of a file that it does not read."""
        lowest = [f"{name}={low!r}" for name, low, _ in self.inputs]
        done = whisker.whisker("rules", "evaluate", self.path.name, *lowest, cwd=self.path.parent)
        return done.stderr if done.returncode else ""

    def compile(self):
        """A table has one or two inputs. A drastic operator jumps where a degree is 1 to the last bit."""
        if len(self.inputs) > 2 or "'drastic" in self.text:
            return
        done = whisker.whisker("rules", "compile", self.path, "--header", self.path.with_suffix(".h"), "--json", "--steps", 64)
        assert done.returncode == 0, done.stderr
        self.table = json.loads(done.stdout)

    def choose(self, count, seed):
        """The corners of the ranges and random inputs; those of a table are raw values."""
        draw = random.Random(seed)
        for p in range(count):
            row, raw = [], []
            for i, (_, low, high) in enumerate(self.inputs):
                value = low + (high - low) * ((p >> i & 1) if p < 4 else draw.random())
                if self.table:
                    t = self.table["inputs"][i]
                    raw.append(min(max(round((value - t["origin"]) * t["raw_per_unit"]), t["raw_low"]), t["raw_high"]))
                    value = t["origin"] + raw[-1] / t["raw_per_unit"]
                row.append((min(max(value, low), high), raw[-1] if raw else None))
            self.rows.append(row)

    def at(self, row):
        return [f"{name}={value!r}" for (name, *_), (value, _) in zip(self.inputs, row)]

    def evaluated(self, row):
        """Answer, whether a rule fires: for each output."""
        done = whisker.whisker("rules", "evaluate", self.path, *self.at(row))
        assert done.returncode == 0, done.stderr
        lines = [line.rpartition(" = ")[2] for line in done.stdout.splitlines()]
        return [(float(line.split()[0]), "no rule fires" not in line) for line in lines]


def octaves_answers(folder, bases):
    """{(key, row, output): (least, answer, greatest), or None where no rule fires}, and {key: message}, of one process."""
    jobs = folder / "octave"
    (jobs / "jobs").write_text("".join(f"{b.key} {b.points} {int(b.own)}\n" for b in bases))
    for b in bases:
        (jobs / f"{b.key}.inputs").write_text("".join(" ".join(repr(value) for value, _ in row) + "\n" for row in b.rows))
    done = octave(HERE / "octave_answers.m", jobs)
    assert done.stdout.endswith("all answered\n"), f"Octave ended early:\n{done.stdout[-500:]}{done.stderr}"
    answers, failures = {}, {}
    for line in done.stdout.splitlines()[:-1]:
        found = re.fullmatch(r"(\w+): (answer|silent|failed) (.*)", line)
        if not found:
            # Before an error, the toolkit prints where its help is.
            continue
        key, word, rest = found.groups()
        if word == "failed":
            failures[key] = rest
            continue
        row, output, *values = rest.split()
        answers[key, int(row) - 1, int(output) - 1] = tuple(map(float, values)) or None
    return answers, failures


def header_answers(folder, bases):
    """{(key, row, output): value} of the headers, in one program."""
    bases = [b for b in bases if b.table]
    lines = [f'#include "{b.key}.h"' for b in bases] + ["#include <stdio.h>", "int main(void) {"]
    order = []
    for b in bases:
        names = [re.sub(r"[^a-z0-9]+", "_", name.lower()) for name, *_ in b.outputs]
        for r, row in enumerate(b.rows):
            prints = "".join(f' printf("%.17g\\n", {b.key}_{n}_value(o.raw_{n}));' for n in names)
            lines.append(f"  {{ const {b.key}_outputs o = {b.key}_look_up({', '.join(str(raw) for _, raw in row)});{prints} }}")
            order += [(b.key, r, o) for o in range(len(names))]
    source, program = folder / "headers.c", folder / "headers"
    source.write_text("\n".join([*lines, "  return 0;", "}", ""]))
    subprocess.run(["gcc", "-std=c99", "-O0", source, "-o", program], check=True)
    values = subprocess.run([program], capture_output=True, text=True, check=True).stdout.split()
    return dict(zip(order, map(float, values), strict=True))


class Comparison:
    """Compares all answers of some bases; `wrong` says where they differ."""

    def __init__(self, folder, bases):
        self.answers = self.silent = self.open = self.headers = 0
        self.greatest, self.widest, self.fullest = (0.0, ""), 0.0, 0.0
        self.wrong = []
        octaves, failures = octaves_answers(folder, bases)
        headers = header_answers(folder, bases)
        self.wrong += [f"{key}: Octave failed: {message}" for key, message in failures.items()]
        self.bases = len(bases)
        self.rules = sum(len(re.findall(r"(?m)^[^\[\n=]*\)\s*:\s*[12]\s*$", b.text)) for b in bases)
        self.points = sum(len(b.rows) for b in bases)
        for b in bases:
            if b.key in failures:
                continue
            for r, row in enumerate(b.rows):
                for o, (value, fires) in enumerate(b.evaluated(row)):
                    self.one(b, row, o, value, fires, octaves[b.key, r, o], headers.get((b.key, r, o)))

    def one(self, base, row, o, value, fires, theirs, header):
        name, low, high = base.outputs[o]
        place = f"{base.key}: {name} at {' '.join(base.at(row))}"
        if theirs is None or not fires:
            self.silent += 1
            if fires or theirs is not None:
                self.wrong.append(f"{place}: only one of the two fires")
            return
        least, answer, greatest = theirs
        share, resolution = abs(value - answer) / (high - low), max(greatest - answer, answer - least)
        if resolution > UNDECIDED * (high - low):
            # For example, two places of almost the same height: samples do not say which is the maximum.
            self.open += 1
            return
        self.answers += 1
        accuracy = ACCURACY * max(abs(low), abs(high), abs(answer), high - low)
        self.greatest = max(self.greatest, (share, place))
        self.widest = max(self.widest, resolution / (high - low))
        self.fullest = max(self.fullest, abs(value - answer) / (resolution + accuracy))
        if not least - accuracy <= value <= greatest + accuracy:
            self.wrong.append(f"{place} = {value:.9g}, but Octave says {answer:.9g}, exactly {least:.9g} to {greatest:.9g}")
        if header is None:
            return
        self.headers += 1
        bound = base.table["outputs"][o]["max_error"] + accuracy
        if not least - bound <= header <= greatest + bound:
            self.wrong.append(f"{place}: the header answers {header:.9g}, Octave {answer:.9g}; the bound is {bound:.3g}")

    def words(self):
        return (
            f"{self.bases} files, {self.rules} rules, {self.points} points: {self.answers} answers compared, {self.headers} also of headers; no rule "
            f"fires at {self.silent}, samples leave {self.open} open\n"
            f"greatest difference {100 * self.greatest[0]:.2g} % of the range ({self.greatest[1]}); greatest resolution "
            f"{100 * self.widest:.2g} %; at most {self.fullest:.2f} of the allowed difference"
        )


def prepared(folder, texts, points, seed):
    """The bases that Whisker reads, and the refusals of others."""
    bases, refusals = [], {}
    for n, (key, text) in enumerate(texts.items()):
        base = Base(folder, key, text)
        refusal = base.refusal()
        if refusal:
            refusals[key] = refusal
            continue
        base.compile()
        base.choose(points, seed + n)
        bases.append(base)
    return bases, refusals


def shipped_files():
    found = octave("--eval", "pkg load fuzzy-logic-toolkit; puts (fileparts (which ('evalfis')));").stdout
    return {path.stem: path.read_text(encoding="utf-8") for path in sorted(pathlib.Path(found.strip()).glob("*.fis"))}


class Agrees(Case):
    maxDiff = None

    def agree(self, bases):
        comparison = Comparison(self.folder, bases)
        print("\n" + comparison.words(), flush=True)
        self.assertEqual(comparison.wrong[:20], [], f"{len(comparison.wrong)} wrong")
        return comparison

    def test_shipped_files(self):
        texts = shipped_files()
        bases, refusals = prepared(self.folder, texts, 16, 7)
        print(f"\nshipped: {len(texts)} files, {len(refusals)} of them refused")
        for key, refusal in refusals.items():
            print(f"  {refusal}", end="")
            self.assertRegex(refusal, rf"\A{key}\.fis:\d+:\d+: [^\n]+\n\Z")
        # The refusals that docs/rules.md names, and no other.
        reasons = ("implication 'einstein_product' cannot be compiled", "a hedge in a conclusion cannot be compiled")
        self.assertEqual([key for key, refusal in refusals.items() if not any(r in refusal for r in reasons)], [])
        comparison = self.agree(bases)
        self.assertGreaterEqual(len(texts), 6)
        self.assertGreaterEqual(comparison.answers, 12 * len(bases))

    def test_random_files(self):
        print(f"\nagain: OCTAVE_SEED={SEED} OCTAVE_COUNT={COUNT} scripts/test --only octave")
        bases, refusals = prepared(self.folder, {f"r{seed}": random_fis(seed) for seed in range(SEED, SEED + COUNT)}, 9, SEED)
        self.assertEqual(refusals, {})
        comparison = self.agree(bases)
        self.assertGreaterEqual(comparison.answers, 5 * COUNT)
        self.assertLessEqual(comparison.open, comparison.answers // 10)


class CanFail(Case):
    def test_small_changes_are_noticed(self):
        """A change of a file that only Whisker reads: each gives a wrong answer."""
        shipped = shipped_files()["mamdani_tip_calculator"]
        changes = {
            "parameter": ("'gaussmf',[2 20]", "'gaussmf',[2 20.02]"),
            "input": ("'Good':'trapmf',[3 7 10 11]", "'Good':'trapmf',[3 7.01 10 11]"),
            "rule": ("2 2, 3 3 (1) : 1", "2 2, 2 3 (1) : 1"),
            "weight": ("1 1, 1 1 (1) : 1", "1 1, 1 1 (0.99) : 1"),
            "connection": ("1 2, 2 2 (1) : 1", "1 2, 2 2 (1) : 2"),
            "hedge": ("2 2, 3 3 (1) : 1", "2.20 2, 3 3 (1) : 1"),
            "conjunction": ("AndMethod='min'", "AndMethod='prod'"),
            "implication": ("ImpMethod='min'", "ImpMethod='prod'"),
            "aggregation": ("AggMethod='max'", "AggMethod='sum'"),
            "defuzzifier": ("DefuzzMethod='centroid'", "DefuzzMethod='bisector'"),
        }
        bases = []
        for key, (old, new) in {"nothing": ("", ""), **changes}.items():
            self.assertIn(old, shipped)
            base = Base(self.folder, key, shipped.replace(old, new, 1), octaves_text=shipped)
            base.compile()
            base.choose(12, 5)
            bases.append(base)
        wrong = Comparison(self.folder, bases).wrong
        noticed = {line.split(":")[0] for line in wrong}
        print(f"\n{len(wrong)} wrong answers of {len(changes)} changes")
        self.assertEqual(noticed, set(changes))

    def test_a_wrong_table_is_noticed(self):
        """The header is that of other rules, the exact answers are right."""
        shipped = shipped_files()["heart_disease_risk"]
        base = Base(self.folder, "heart", shipped.replace("'constant', [7.5]", "'constant', [7.7]"), octaves_text=shipped)
        base.compile()
        base.choose(12, 5)
        base.path.write_text(shipped)
        wrong = Comparison(self.folder, [base]).wrong
        self.assertTrue(wrong)
        self.assertTrue(all("the header answers" in line for line in wrong), wrong)


SYSTEM = """[System]
Name='small'
Type='mamdani'
Version=2.0
NumInputs=1
NumOutputs=1
NumRules=2
AndMethod='min'
OrMethod='max'
ImpMethod='min'
AggMethod='max'
DefuzzMethod='centroid'

[Input1]
Name='x'
Range=[0 1]
NumMFs=2
MF1='low':'trapmf',[-1 0 0.2 0.4]
MF2='high':'trapmf',[0.6 0.8 1 2]

[Output1]
Name='y'
Range=[-4 2]
NumMFs=2
MF1='left':'trapmf',[-3.5 -3 -2.5 -2]
MF2='right':'trapmf',[0.5 1 1.5 1.8]

[Rules]
1, 1 (1) : 1
2, 2 (1) : 1
"""


def changed(text, *pairs):
    for old, new in pairs:
        assert old in text, old
        text = text.replace(old, new)
    return text


class Differs(Case):
    """What Octave defines otherwise: it does, and it is not Whisker's answer."""

    def both(self, text, row, points=POINTS):
        """Octave's own answers or its message, and Whisker's."""
        base = Base(self.folder, "small", text, own=True, points=points)
        base.rows = [[(value, None) for value in row]]
        answers, failures = octaves_answers(self.folder, [base])
        theirs = failures.get("small") or [a and a[1] for a in (answers[key] for key in sorted(answers))]
        return theirs, base.evaluated(base.rows[0])

    def test_equal_answers_of_a_sugeno_system(self):
        """At 105 and 37, rules say 5 with 0.25 and 0.75, and 2.5 with 0.2 twice."""
        (theirs,), ((ours, _),) = self.both(shipped_files()["heart_disease_risk"], [105, 37])
        self.assertAlmostEqual(theirs, (0.75 * 5 + 0.2 * 2.5) / 0.95)
        self.assertAlmostEqual(ours, (1 * 5 + 0.4 * 2.5) / 1.4)

    def test_bisector_is_an_index(self):
        (theirs,), ((ours, _),) = self.both(changed(SYSTEM, ("centroid", "bisector")), [0.1])
        self.assertAlmostEqual(ours, -2.75, places=6)
        self.assertLessEqual(abs(-4 + (theirs - 1) * 6 / (POINTS - 1) - ours), 6 / (POINTS - 1))

    def test_maxima_go_by_sign(self):
        both_fire = ("2, 2 (1)", "1, 2 (1)")
        for method, theirs_y, ours_y in (("som", -3, 1), ("lom", 1.5, -3)):
            (theirs,), ((ours, _),) = self.both(changed(SYSTEM, ("centroid", method), both_fire), [0.1])
            self.assertAlmostEqual(theirs, theirs_y, delta=6 / (POINTS - 1))
            self.assertAlmostEqual(ours, ours_y, places=6)

    def test_no_rule_fires(self):
        theirs, ours = self.both(SYSTEM, [0.5])
        self.assertEqual((theirs, ours), ([None], [(-1.0, False)]))

    def test_one_rule(self):
        """Octave aggregates over the samples of the only set, so that the set is constant."""
        one = changed(SYSTEM, ("NumRules=2", "NumRules=1"), ("2, 2 (1) : 1\n", ""))
        (theirs,), ((ours, _),) = self.both(one, [0.1])
        self.assertAlmostEqual(theirs, -1)
        self.assertAlmostEqual(ours, -2.75, places=6)

    def test_difference_of_sigmoids_below_zero(self):
        fall = ("'trapmf',[-3.5 -3 -2.5 -2]", "'dsigmf',[5 -2 5 -3]")
        (theirs,), ((ours, _),) = self.both(changed(SYSTEM, fall, ("1, 1 (1)", "-2, 1 (1)"), ("2, 2 (1)", "1, 2 (0.5)")), [0.1])
        self.assertGreater(theirs, 1)
        self.assertLess(ours, 0)

    def test_drastic_operators_of_one_and_three(self):
        third = "\n[Input{}]\nName='{}'\nRange=[0 1]\nNumMFs=1\nMF1='up':'trimf',[-0.01 1 2]\n"
        three = changed(SYSTEM, ("NumInputs=1", "NumInputs=3"), ("'min'\nOr", "'drastic_product'\nOr"), ("1, 1 (1)", "1 1 1, 1 (1)"),
                        ("2, 2 (1)", "1 0 0, 2 (0.5)"), ("\n[Output1]", third.format(2, "z") + third.format(3, "w") + "\n[Output1]"))  # fmt: skip
        (theirs,), ((ours, _),) = self.both(three, [0.1, 0.5, 0.5])
        self.assertLess(theirs, 0)
        self.assertGreater(ours, 0.5)
        one = changed(SYSTEM, ("'min'\nOr", "'drastic_product'\nOr"))
        self.assertEqual(self.both(one, [0.3])[0], [None])
        self.assertTrue(self.both(one, [0.3])[1][0][1])

    def test_names_of_operators(self):
        """Whisker reads MATLAB's and Octave's name, Octave only its own."""
        theirs, ours = self.both(changed(SYSTEM, ("AggMethod='max'", "AggMethod='probor'")), [0.1])
        self.assertIn("probor", theirs)
        self.assertEqual(ours, self.both(changed(SYSTEM, ("AggMethod='max'", "AggMethod='algebraic_sum'")), [0.1])[1])



def missing():
    """The one line that says what is missing, or nothing."""
    if not shutil.which(OCTAVE):
        return f"no {OCTAVE}: scripts/setup octave"
    if octave("--eval", "pkg load fuzzy-logic-toolkit").returncode:
        return "Octave has no fuzzy-logic-toolkit: scripts/setup octave"
    return ""


if __name__ == "__main__":
    if lacks := missing():
        sys.exit(f"octave_test: {lacks}")
    whisker.main()
