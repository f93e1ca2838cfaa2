"""Random .fis files of what Octave's fuzzy-logic-toolkit and Whisker both define, and define alike."""

import random

# Hamacher's operators divide by degrees, so where these are nearly 0 or 1, rounding decides who fires: not drawn.
ANDS = ("min", "prod", "algebraic_product", "bounded_difference", "einstein_product")
ORS = ("max", "algebraic_sum", "bounded_sum", "sum", "einstein_sum")
AGGREGATIONS = ("max", "max", "sum", "algebraic_sum", "bounded_sum", "einstein_sum")
HEDGES = ("", "", ".05", ".20", ".40")


class Writer:
    def __init__(self, seed):
        self.random = random.Random(seed)
        self.chance = lambda p: self.random.random() < p
        self.sugeno = self.chance(0.35)
        sets = ("centroid", "centroid", "centroid", "bisector", "mom", "som", "lom")
        self.defuzzifier = self.pick("wtaver", "wtaver", "wtsum") if self.sugeno else self.pick(*sets)
        self.peaks = self.defuzzifier in ("mom", "som", "lom")
        self.terms = [self.random.randint(2, 5) for _ in range(self.pick(1, 2, 2, 2, 3))]
        self.answers = [self.random.randint(2, 5) for _ in range(self.pick(1, 1, 1, 2))]

    def pick(self, *all_of):
        return self.random.choice(all_of)

    def numbers(self, *values):
        return "[" + " ".join(f"{v:.6f}" for v in values) + "]"

    def shape(self, low, high, i, n, peaked):
        """A set about the i-th of n places. A term's neighbours overlap it."""
        gap = (high - low) / (n - 1)
        c = low + gap * i
        w = gap * self.random.uniform(0.7, 1.3)
        shapes = {
            "trimf": (c - w, c, c + w),
            "trapmf": (c - w, c - w / 4, c + w / 4, c + w),
            "gaussmf": (w / 2, c),
            "gauss2mf": (w / 2, c, w / 3, c + w / 4),
            "pimf": (c - w, c - w / 8, c + w / 8, c + w),
            "smf": (c - w, c + w),
            "zmf": (c - w, c + w),
        }
        if not peaked:
            # Their tops are too flat to say where they are greatest.
            shapes["sigmf"] = (self.pick(-4, 4) / w, c)
            shapes["dsigmf"] = (9 / w, c - w / 2, 9 / w, c + w / 2)
            shapes["psigmf"] = (8 / w, c - w / 2, -8 / w, c + w / 2)
        kind = self.pick("trimf", "trimf", *shapes, *(() if peaked else ("gbellmf",)))
        if kind == "gbellmf":
            # Octave wants a whole slope.
            return f"'gbellmf',[{w / 2:.6f} {self.random.randint(1, 4)} {c:.6f}]"
        return f"'{kind}',{self.numbers(*shapes[kind])}"

    def variable(self, section, name, count, is_output):
        # Octave's som and lom go by sign, MATLAB's by absolute value.
        low = 0 if self.chance(0.5) or (is_output and self.peaks) else self.random.uniform(-20, 5)
        high = low + self.random.uniform(0.5, 30)
        lines = [f"[{section}]", f"Name='{name}'", f"Range={self.numbers(low, high)}", f"NumMFs={count}"]
        for t in range(count):
            if not (is_output and self.sugeno):
                what = self.shape(low, high, t, count, is_output and self.peaks)
            elif self.chance(0.5):
                what = f"'constant',{self.numbers(self.random.uniform(low, high))}"
            else:
                slopes = [self.random.uniform(-1, 1) for _ in self.terms]
                what = f"'linear',{self.numbers(*slopes, self.random.uniform(low, high))}"
            lines.append(f"MF{t + 1}='t{t}':{what}")
        return [*lines, ""]

    def rule(self):
        codes = ["-" * self.chance(0.1) + str(self.random.randint(1, n)) + (self.pick(*HEDGES) if self.chance(0.3) else "") for n in self.terms]
        kept = self.random.randrange(len(codes))
        condition = [code if self.drastic or i == kept or self.chance(0.85) else "0" for i, code in enumerate(codes)]
        conclusion = ["-" * (not self.sugeno and self.chance(0.05)) + str(self.random.randint(1, n)) for n in self.answers]
        if len(conclusion) > 1 and self.chance(0.2):
            conclusion[self.random.randrange(len(conclusion))] = "0"
        weight = f"{self.random.uniform(0.1, 0.9):.6f}" if self.chance(0.2) else "1"
        return f"{' '.join(condition)}, {' '.join(conclusion)} ({weight}) : {1 + self.chance(0.2)}"

    def text(self):
        both = self.pick(*ANDS)
        either = self.pick(*ORS)
        self.aggregation = "sum" if self.sugeno else "max" if self.peaks else self.pick(*AGGREGATIONS)
        # Octave's drastic operators are right for exactly two degrees.
        self.drastic = len(self.terms) == 2 and self.chance(0.15)
        if self.drastic:
            both, either = "drastic_product", "drastic_sum"
        # A strength above 1 may cut a set, but not scale it: S-norms are defined up to 1.
        implication = "min" if either == "sum" else self.pick("min", "prod")
        rules = [self.rule() for _ in range(self.random.randint(3, 14))]
        lines = ["[System]", "Name='random'", f"Type='{'sugeno' if self.sugeno else 'mamdani'}'", "Version=2.0"]
        lines += [f"NumInputs={len(self.terms)}", f"NumOutputs={len(self.answers)}", f"NumRules={len(rules)}"]
        lines += [f"AndMethod='{both}'", f"OrMethod='{either}'", f"ImpMethod='{implication}'"]
        lines += [f"AggMethod='{self.aggregation}'"]
        lines += [f"DefuzzMethod='{self.defuzzifier}'", ""]
        for i, count in enumerate(self.terms):
            lines += self.variable(f"Input{i + 1}", f"in{i}", count, False)
        for o, count in enumerate(self.answers):
            lines += self.variable(f"Output{o + 1}", f"out{o}", count, True)
        return "\n".join([*lines, "[Rules]", *rules, ""])


def random_fis(seed):
    return Writer(seed).text()
