"""scripts/mutate finds its kinds of mutants, and none in comments, strings and templates. usage: mutate_test.py ROOT"""

import importlib.machinery
import importlib.util
import pathlib
import sys
import unittest

ROOT = pathlib.Path(sys.argv[1])


def load():
    loader = importlib.machinery.SourceFileLoader("mutate", str(ROOT / "scripts/mutate"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("mutate", loader))
    sys.dont_write_bytecode = True
    loader.exec_module(module)
    return module


def mutated(text):
    return {text[:start] + new + text[end:] for start, end, new in load().mutants(text)}


class Mutants(unittest.TestCase):
    def test_operators_numbers_and_negations(self):
        self.assertEqual(mutated("  return a < 1;\n"), {f"  return {x};\n" for x in ("a <= 1", "a < 2", "a < 0")})
        self.assertEqual(mutated("  return !a && b;\n"), {"  return a && b;\n", "  return !a || b;\n"})
        self.assertEqual(mutated("  return a - INT32_C(0);\n"), {"  return a + INT32_C(0);\n", "  return a - INT32_C(1);\n"})
        self.assertEqual(mutated("  return true;\n"), {"  return false;\n"})

    def test_statements(self):
        for line in ("a_ = b;", "f(b);", "a[i].f(b);", "++a;", "break;", "if (a) return b;"):
            self.assertIn("  ;\n", mutated(f"  {line}\n"), line)
        for line in ("return a;", "const int a = b;", "f(a)};", "F(const A&&) = delete;", "Speed f(Speed a);"):
            self.assertNotIn("  ;\n", mutated(f"  {line}\n"), line)

    def test_nothing_but_code(self):
        for text in ("// a < 1\n", "/* a < 1\n + 2 */\n", '  f = "a < 1 + 2";\n', "#if A < 1\n", "template <int a, int b>\n"):
            self.assertLessEqual(mutated(text), {"  ;\n"}, text)

    def test_every_mutant_is_another_text(self):
        for path in (ROOT / "firmware").rglob("*.[ch]pp"):
            text = path.read_text()
            found = load().mutants(text)
            self.assertEqual(len(found), len(set(found)), path)
            self.assertTrue(all(text[start:end] != new for start, end, new in found), path)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
