"""Each gate rejects a violation, and accepts a similar valid input. usage: gates_can_fail.py CXX [ARM_CXX ARM_NM]"""

import contextlib
import importlib.machinery
import importlib.util
import io
import json
import pathlib
import sys
import tempfile
import unittest

import absolute_paths
import arduino
import c_params
import components
import core_alone
import cross
import headers_alone
import include_direction
import layout
import lengths
import links
import old_cmake
import example_compiles
import stages
import vendor_macros
import version

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "targets"))

CXX, ARM_CXX, ARM_NM = (sys.argv[1:] + [None] * 3)[:3]


@contextlib.contextmanager
def tree(files):
    """A folder with these files: path -> text."""
    with tempfile.TemporaryDirectory() as root:
        for path, text in files.items():
            target = pathlib.Path(root, path)
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(text)
        yield root


def run(gate, files, *arguments):
    """(exit status, output) of a gate's main on a tree."""
    printed = io.StringIO()
    with tree(files) as root, contextlib.redirect_stdout(printed):
        return gate(root, *arguments), printed.getvalue()


class IncludeDirection(unittest.TestCase):
    def errors(self, path, line):
        return include_direction.errors(path, line + "\n", lambda target: "missing" not in target)

    def test_goes_down(self):
        for path, line in (
            ("firmware/planning/a.cpp", '#include "firmware/fuzzy/b.hpp"'),
            ("firmware/planning/global/a.cpp", '#include "firmware/planning/boundary/b.hpp"'),
            ("firmware/safety/a.cpp", '#include "firmware/perception/b.hpp"'),
            ("firmware/planning/a.cpp", '#include "firmware/params.hpp"'),
            ("firmware/robot.cpp", '#include "firmware/control/b.hpp"'),
            ("firmware/robot.hpp", '#include "hal/drive.hpp"'),
            ("firmware/perception/a.hpp", '#include "hal/types.hpp"'),
            ("firmware/math/a.hpp", "#include <stdint.h>"),
            ("firmware/fuzzy/packed_bilinear.hpp", "#include <arm_acle.h>"),
            ("firmware/apps/a.cpp", '#include "hal/boards/stm32f405/b.hpp"'),
            ("firmware/apps/a.cpp", '#include "hal/drive.hpp"'),
            ("hal/drive.hpp", '#include "hal/types.hpp"'),
            ("hal/drive.hpp", '#include "firmware/math/units.hpp"'),
            ("hal/ports/tty/a.cpp", "#include <vector>"),
            ("hal/ports/slcan/a.cpp", '#include "hal/ports/can_queue.hpp"'),
            ("hal/boards/stm32f405/a.cpp", '#include "firmware/params.hpp"'),
            ("hal/boards/stm32f405/a.cpp", '#include "hal/boards/common/b.hpp"'),
            ("hal/emulated/virt/a.cpp", '#include "hal/runtime/b.hpp"'),
            ("host/harness/run/a.cpp", '#include "hal/ports/tty/b.hpp"'),
            ("host/lab/report/a.cpp", '#include "host/harness/run/b.hpp"'),
            ("host/cli/a.cpp", '#include "host/lab/report/b.hpp"'),
            ("tests/math/a.cpp", '#include "tests/support/b.hpp"'),
        ):
            self.assertEqual(self.errors(path, line), [], (path, line))

    def test_never_up_or_out(self):
        for path, line in (
            ("firmware/math/a.hpp", '#include "firmware/params.hpp"'),
            ("firmware/params.hpp", '#include "firmware/perception/b.hpp"'),
            ("firmware/localization/a.hpp", '#include "firmware/perception/b.hpp"'),
            ("firmware/perception/a.hpp", '#include "firmware/planning/b.hpp"'),
            ("firmware/planning/a.hpp", '#include "firmware/safety/b.hpp"'),
            ("firmware/safety/a.hpp", '#include "firmware/control/b.hpp"'),
            ("firmware/fuzzy/a.hpp", '#include "firmware/planning/b.hpp"'),
            ("firmware/control/a.hpp", '#include "firmware/robot.hpp"'),
            ("firmware/can/a.hpp", '#include "firmware/apps/b.hpp"'),
            ("firmware/unknown/a.hpp", '#include "firmware/math/b.hpp"'),
            ("firmware/planning/a.cpp", "#include <vector>"),
            ("firmware/planning/a.cpp", "  #  include <cstdint>"),
            ("firmware/planning/a.cpp", "#include <arm_acle.h>"),
            ("firmware/planning/a.cpp", '#include "host/harness/sim/body.hpp"'),
            ("firmware/planning/a.cpp", '#include "hal/drive.hpp"'),
            ("firmware/robot.hpp", '#include "hal/ports/tty/b.hpp"'),
            ("firmware/planning/a.cpp", '#include "missing.hpp"'),
            ("firmware/planning/a.cpp", "#include WHERE"),
            ("firmware/apps/a.cpp", "#include <vector>"),
            ("firmware/apps/a.cpp", '#include "hal/ports/tty/b.hpp"'),
            ("firmware/apps/a.cpp", '#include "host/harness/run/b.hpp"'),
            ("hal/drive.hpp", "#include <cstdint>"),
            ("hal/drive.hpp", '#include "hal/ports/tty/b.hpp"'),
            ("hal/drive.hpp", '#include "firmware/params.hpp"'),
            ("hal/unknown/a.cpp", '#include "hal/drive.hpp"'),
            ("hal/ports/slcan/a.cpp", '#include "hal/ports/tty/b.hpp"'),
            ("hal/ports/tty/a.cpp", '#include "firmware/params.hpp"'),
            ("hal/boards/stm32f405/a.cpp", '#include "firmware/apps/b.hpp"'),
            ("hal/boards/stm32f405/a.cpp", '#include "hal/boards/other/b.hpp"'),
            ("hal/emulated/virt/a.cpp", '#include "firmware/robot.hpp"'),
            ("host/harness/run/a.cpp", '#include "tests/support/b.hpp"'),
            ("host/harness/run/a.cpp", '#include "host/lab/report/b.hpp"'),
            ("host/lab/report/a.cpp", '#include "host/cli/b.hpp"'),
            ("host/report/a.cpp", '#include "host/harness/run/b.hpp"'),
            ("host/harness/run/a.cpp", '#include "/usr/include/stdio.h"'),
        ):
            self.assertEqual(len(self.errors(path, line)), 1, (path, line))

    def test_refuses_an_empty_tree(self):
        self.assertEqual(run(include_direction.main, {})[0], 1)


class HeadersAlone(unittest.TestCase):
    def status(self, text):
        return run(headers_alone.main, {"firmware/core/a.hpp": text}, CXX, "-Wall", "-Werror")[0]

    def test_accepts_a_complete_header(self):
        self.assertEqual(self.status("#pragma once\n#include <stdint.h>\nstruct A { uint8_t x; };\n"), 0)

    def test_refuses_a_missing_include(self):
        self.assertEqual(self.status("#pragma once\nstruct A { uint8_t x; };\n"), 1)

    def test_refuses_a_missing_guard(self):
        self.assertEqual(self.status("struct A { int x; };\n"), 1)

    def test_refuses_what_only_a_header_beside_it_includes(self):
        a, words, b = "struct A {};\n", "#include <string>\n", 'struct B { A a; };\n'
        several = {f"host/{i}.hpp": f"#pragma once\n{words}struct W{i} {{ std::string a; }};\n" for i in range(headers_alone.SHARED)}
        for wanted, text in (
            (0, f'#include "host/a.hpp"\n{b}'),
            (1, b),
            (1, f'{b}#include "host/a.hpp"\n'),
            (1, f'#ifdef NEVER\n#include "host/a.hpp"\n#endif\n{b}'),
            (0, f"{words}struct B {{ std::string a; }};\n"),
            (1, "struct B { std::string a; };\n"),
            (1, f"#ifdef NEVER\n{words}#endif\nstruct B {{ std::string a; }};\n"),
        ):
            files = {**several, "host/a.hpp": f"#pragma once\n{a}", "host/b.hpp": f"#pragma once\n{text}"}
            self.assertEqual(run(headers_alone.main, files, CXX)[0], wanted, text)


class Lengths(unittest.TestCase):
    def status(self, **files):
        return run(lengths.main, {f"host/{name}.cpp": "\n" * n for name, n in files.items()})[0]

    def test_accepts_the_limits(self):
        self.assertEqual(self.status(a=400, b=100, c=1), 0)

    def test_refuses_a_long_file(self):
        self.assertEqual(self.status(a=401, b=100, c=1), 1)

    def test_refuses_many_branches_on_the_safety_path(self):
        for branches, wanted in ((20, 0), (21, 1)):
            text = "int f(int a) noexcept {\n" + "  if (a > 1) ++a;  // if\n" * branches + "  return a;\n}\n"
            for file, status in (("firmware/safety/a.cpp", wanted), ("firmware/planning/a.cpp", 0)):
                self.assertEqual(run(lengths.main, {file: text, "host/b.cpp": "\n"})[0], status, file)

    def test_refuses_a_long_median(self):
        self.assertEqual(self.status(a=400, b=101, c=1), 1)


class Links(unittest.TestCase):
    def status(self, link):
        return run(links.main, {"README.md": f"# A\n[a]({link})\n```\n[no](link)\n```\n", "docs/b.md": "# B\n\n## It's `c`, d\n"})[0]

    def test_accepts_what_is_there(self):
        for link in ("docs/b.md", "docs/b.md#its-c-d", "#a", "https://example.org/x"):
            self.assertEqual(self.status(link), 0, link)

    def test_refuses_what_is_not(self):
        for link in ("docs/c.md", "docs/b.md#c", "#b"):
            self.assertEqual(self.status(link), 1, link)


class Layout(unittest.TestCase):
    def status(self, page):
        files = {f"{part}/a.cpp": "" for part in layout.PARTS}
        return run(layout.main, {"docs/development.md": page, **files, "host/harness/run/b.cpp": ""})

    def test_wants_every_folder_and_no_other(self):
        rows = "| `firmware/` | |\n| `hal/` | |\n| `host/` | {} |\n"
        self.assertEqual(self.status(rows.format("`harness/`"))[0], 0)
        self.assertIn("host/harness/ is not named", self.status(rows.format(""))[1])
        self.assertIn("host/gone/ is named and not there", self.status(rows.format("`harness/`, `gone/`"))[1])


class Version(unittest.TestCase):
    HEADER = "".join(f"#define WHISKER_VERSION_{part} {n}\n" for part, n in zip(version.PARTS, (1, 2, 3)))

    def problems(self, *headings, **others):
        return list(version.problems(self.HEADER, "\n".join(f"## {h}" for h in headings) + "\n", others))

    def test_wants_the_newest_release_to_be_the_headers(self):
        new, old = "[1.2.3] - 2026-01-02", "[1.2.2] - 2026-01-01"
        self.assertEqual(self.problems("[Unreleased]", new, old, CMake="1.2.3"), [])
        self.assertEqual(len(self.problems("[Unreleased]", old)), 1)
        self.assertEqual(len(self.problems("[Unreleased]", new, old, "[1.2.10] - 2026-01-01")), 1)
        self.assertEqual(len(self.problems(new)), 1)
        self.assertEqual(len(self.problems("[Unreleased]", new, CMake="1.2.4")), 1)


class OldCMake(unittest.TestCase):
    def test_refuses_a_command_of_a_newer_one(self):
        called = {"cmake_path": "a:1", "add_library": "b:2", "our_own": "c:3"}
        self.assertEqual(list(old_cmake.too_new("cmake", called, (3, 18))), ["a:1: cmake_path() needs CMake 3.20"])
        self.assertEqual(list(old_cmake.too_new("cmake", called, (3, 20))), [])


class VendorMacros(unittest.TestCase):
    def status(self, line):
        files = {"firmware/a.hpp": f"#pragma once\n{line}\n", "firmware/a.cpp": ""}
        return run(vendor_macros.main, files, CXX)[0]

    def test_refuses_a_name_that_is_a_macro(self):
        self.assertEqual(self.status("constexpr int (min)(int a, int b) { return a < b ? a : b; }"), 0)
        self.assertEqual(self.status("constexpr int min(int a, int b) { return a < b ? a : b; }"), 1)


class AbsolutePaths(unittest.TestCase):
    def test_refuses_a_home(self):
        for text in ('open("/home/me/world.toml")', "#include </opt/x/y.h>", "set(X '/usr/lib/x')"):
            self.assertEqual(len(absolute_paths.errors(text)), 1, text)
        self.assertEqual(len(absolute_paths.errors('open("/checkout/whisker/a.toml")', "/checkout/whisker")), 1)

    def test_accepts_what_is_everywhere(self):
        for text in ('"/dev/ttyS0"', 'ROOT "/tests/a/b.txt"', '"/"', '"host/harness/sim/a.hpp"', '"http://example.org/a/b"', '// "a" / b / "c"'):
            self.assertEqual(absolute_paths.errors(text), [], text)


class ExampleCompiles(unittest.TestCase):
    def status(self, line):
        files = {
            "docs/porting.md": f"<!-- compile:begin -->\n```\n{line}\n```\n<!-- compile:end -->\n",
            "docs/example/main.cpp": '#include "firmware/a/a.hpp"\n',
            "firmware/a.cpp": "int a;\n",
            "firmware/a/b.cpp": "int b;\n",
            "firmware/a/a.hpp": "",
        }
        return run(example_compiles.main, files, CXX)[0]

    def test_accepts_a_line_that_compiles_all(self):
        self.assertEqual(self.status("g++ -I. -c docs/example/main.cpp firmware/*.cpp firmware/*/*.cpp"), 0)

    def test_refuses_a_line_that_misses_files_or_is_no_line_of_a_shell(self):
        for line in (
            "g++ -I. -c docs/example/main.cpp firmware/**/*.cpp",
            "g++ -c docs/example/main.cpp firmware/*.cpp firmware/*/*.cpp",
            "g++ -I. -c docs/example/main.cpp $(wildcard firmware/*.cpp firmware/*/*.cpp)",
            "two\nlines",
        ):
            self.assertEqual(self.status(line), 1, line)


class Stages(unittest.TestCase):
    def status(self, text):
        files = {
            "scripts/stages.sh": text,
            "CMakePresets.json": json.dumps({"configurePresets": [{"name": "host"}]}),
            "tests/a/CMakeLists.txt": "whisker_test(whisker_a_tests\n  SOURCES a.cpp)\n",
        }
        return run(stages.main, files)[0]

    def test_accepts_what_is_there(self):
        self.assertEqual(self.status("stage_x() {\n  build_and_test_core host '^(a|a)$' whisker_a_tests\n}\n"), 0)

    def test_refuses_what_is_not(self):
        for text in ("  build_and_test_core host '^(a|b)$' whisker_a_tests\n", "  build_and_test guest\n", "  x whisker_b_tests\n"):
            self.assertEqual(self.status(text), 1, text)


class CoreAlone(unittest.TestCase):
    def lookups(self, file, command):
        line = f'{{"cmd": "{command}", "args": ["fmt"], "file": "{file}", "line": 1}}\n'
        with tree({"trace": '{"version": {"major": 1, "minor": 2}}\n' + line}) as folder:
            return core_alone.lookups("/root", f"{folder}/trace")

    def test_refuses_a_look_outside(self):
        self.assertEqual(len(self.lookups("/root/host/CMakeLists.txt", "find_package")), 1)
        self.assertEqual(len(self.lookups("/root/CMakeLists.txt", "FetchContent_Declare")), 1)

    def test_accepts_the_rest(self):
        self.assertEqual(self.lookups("/root/CMakeLists.txt", "add_library"), [])
        self.assertEqual(self.lookups("/usr/share/cmake/Modules/X.cmake", "find_program"), [])


class CParams(unittest.TestCase):
    TABLE = "| 0 | body_radius_m | um | 90000 | 20000..1000000 |\n| 1 | gyro | choice | 0 | 0..1 |\n"
    HEADER = "enum whisker_param {\n  /* params:begin */\n%s  /* params:end */\n};\n"
    LINES = (
        "  WHISKER_PARAM_BODY_RADIUS, /* um; 90000; 20000 to 1000000 */\n"
        "  WHISKER_PARAM_GYRO         /* choice; 0; 0 to 1 */\n"
    )  # fmt: skip

    def status(self, lines, table=TABLE):
        return run(c_params.main, {c_params.HEADER: self.HEADER % lines, c_params.TABLE: table})[0]

    def test_wants_the_parameters_of_the_table(self):
        self.assertEqual(self.status(self.LINES), 0)
        self.assertEqual(self.status(self.LINES.replace("RADIUS", "RADIUS_M")), 1)
        self.assertEqual(self.status(self.LINES.replace("20000", "10000")), 1)
        self.assertEqual(self.status("".join(self.LINES.splitlines(True)[1:])), 1)


class Amalgamation(unittest.TestCase):
    SCRIPT = str(pathlib.Path(__file__).resolve().parents[2] / "scripts/amalgamate")

    def setUp(self):
        loader = importlib.machinery.SourceFileLoader("amalgamate", self.SCRIPT)
        self.script = importlib.util.module_from_spec(importlib.util.spec_from_loader("amalgamate", loader))
        loader.exec_module(self.script)

    def test_finds_the_names_of_unnamed_namespaces(self):
        for text, names in (
            ("constexpr int kA = 1, kB = 2;", {"kA", "kB"}),
            ("constexpr int8_t kA[] = {1, 2};", {"kA"}),
            ("struct A { int x; int f() { return x; } };", {"A"}),
            ("enum class A : uint8_t { b, c };", {"A"}),
            ("template <class T, int n> T f(T a, int b) noexcept { int c = 0; return a; }", {"f"}),
            ("[[gnu::noinline]] ns::Pair g(int a);", {"g"}),
            ("using A = int;  // using B = int;\nusing ns::c;", {"A"}),
            ("static_assert(kX == 1);", set()),
            ("const char* const s = \"int x;\";", {"s"}),
            ("struct A { int x; };\nint f() { return 1; }\nA a{};", {"A", "f", "a"}),
        ):
            source = "namespace whisker {\nint outside;\nnamespace {\n" + text + "\n}  // namespace\nint after() { return 1; }\n}\n"
            self.assertEqual(self.script.unnamed_names(source), names, text)

    def test_renames_neither_members_nor_words(self):
        before = "f(x.f, ns::f, p->f, \"f\", ff); // f"
        self.assertEqual(self.script.renamed(before, {"f"}, "_a"), "f_a(x.f, ns::f, p->f, \"f\", ff); // f")

    def test_knows_names_outside(self):
        source = "namespace whisker::a {\nnamespace {\nint f() { return 1; }\n}\nint f(int x) { return x; }\nint A::g() { return 1; }\n}\n"
        self.assertEqual(self.script.names_in(source, "namespace whisker.*"), {"f"})


class Arduino(unittest.TestCase):
    PROPERTIES = (
        "name=A\nversion=1.2.3\nauthor=a\nmaintainer=a\nsentence=a\nparagraph=a\ncategory=Other\nurl=https://a.b\narchitectures=*\n"
        "includes=a.hpp\n"
    )  # fmt: skip
    JSON = {"name": "A", "version": "1.2.3", "description": "a", "keywords": ["a"], "authors": [{"name": "a"}], "license": "MIT"}

    def properties(self, text):
        return list(arduino.properties_problems(text, "1.2.3", lambda path: path == "src/a.hpp"))

    def json(self, **changes):
        return list(arduino.json_problems(json.dumps({**self.JSON, **changes}), "1.2.3", lambda path: path == "src/a.hpp"))

    def test_properties(self):
        self.assertEqual(self.properties(self.PROPERTIES), [])
        for before, after in (
            ("author=a\n", ""), ("1.2.3", "1.2.4"), ("Other", "Robots"), ("https://a.b", "a.b"), ("a.hpp", "b.hpp"),
            ("sentence", "sentense"), ("name=A", "name=Arduino A"), ("name=A", "name=-A"),
        ):  # fmt: skip
            self.assertNotEqual(self.properties(self.PROPERTIES.replace(before, after)), [], after)

    def test_json(self):
        self.assertEqual(self.json(headers=["a.hpp"], build={"flags": ["-O2"]}), [])
        for changes in (
            {"version": "1"}, {"headers": ["b.hpp"]}, {"build": {"flag": ""}}, {"author": "a"}, {"license": ""}, {"name": "a/b"},
            {"description": ""},
        ):  # fmt: skip
            self.assertNotEqual(self.json(**changes), [], changes)


class Components(unittest.TestCase):
    def test_options_are_in_kconfig(self):
        known = "menu \"a\"\nconfig A\n\tbool\nendmenu\n"
        self.assertEqual(list(components.kconfig_problems("a", "if(CONFIG_A)", known)), [])
        self.assertEqual(len(list(components.kconfig_problems("a", "if(CONFIG_B)", known))), 1)
        self.assertEqual(len(list(components.kconfig_problems("a", "", known.replace("endmenu\n", "")))), 1)


def cross_status(target, compiler, text, *options):
    with tempfile.TemporaryDirectory() as work:
        gate = lambda root: cross.main([target, root, work, compiler, *options])  # noqa: E731
        return run(gate, {"firmware/core/a.cpp": text})


class NoFloat(unittest.TestCase):
    def test_accepts_integers(self):
        status, output = cross_status("no-float", CXX, "int twice(int x) { return 2 * x; }\n")
        self.assertEqual(status, 0, output)

    def test_refuses_a_float(self):
        status, output = cross_status("no-float", CXX, "float twice(float x) { return 2 * x; }\n")
        self.assertEqual(status, 1)
        self.assertIn("SSE", output)


class ArmSymbols(unittest.TestCase):
    ACCEPTED = (
        "long long f(long long a, long long b) { return a / b * a % b; }",
        "struct S { int x[64]; }; void f(S& a, const S& b) { a = b; a = {}; }",
        "int f(int x) { switch (x) { case 1: return 7; case 2: return 4; case 3: return 9; case 4: return 1; "
        "case 5: return 88; default: return 0; } }",
        "constexpr int kTable[] = {3, 1, 4}; int f(int i) { return kTable[i]; }",
    )
    REFUSED = (
        ("float f(float x) { return x * x; }", "__aeabi_fmul"),
        ("double f(double x) { return x + x; }", "__aeabi_dadd"),
        ("int* f() { return new int; }", "_Znwj"),
        ("void f(int* p) { delete p; }", "_ZdlPv"),
        ("extern \"C\" void* malloc(unsigned); void* f() { return malloc(4); }", "malloc"),
        ("int g(); int f() { static const int x = g(); return x; } int g() { return 1; }", "guard"),
        ("int g() noexcept; int x = g();", "before main"),
        ("int calls; int f() { return ++calls; }", "state"),
        ("int f() { static int calls = 7; return ++calls; }", "state"),
        ("extern \"C\" int printf(const char*, ...); void f() { printf(\"x\"); }", "printf"),
        ("struct B { virtual ~B() = default; }; struct D : B { ~D(); }; D::~D() {}", "_ZdlPv"),
    )  # fmt: skip

    def run_gate(self, text):
        return cross_status("arm", ARM_CXX, text + "\n", "--nm", ARM_NM)

    def test_accepts_integer_and_memory_helpers(self):
        for text in self.ACCEPTED:
            status, output = self.run_gate(text)
            self.assertEqual(status, 0, text + "\n" + output)

    def test_refuses_everything_else(self):
        for text, reason in self.REFUSED:
            status, output = self.run_gate(text)
            self.assertEqual(status, 1, text)
            self.assertIn(reason, output, text)

    def test_refuses_an_exception(self):
        self.assertEqual(self.run_gate("void f() { throw 1; }")[0], 1)


if not ARM_CXX:
    del ArmSymbols

if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
