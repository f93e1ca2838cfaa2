"""The test programs, CTest labels and presets that scripts/stages.sh names exist, also those of the optional stages.

usage: stages.py ROOT
"""

import json
import pathlib
import re
import sys

from sources import finish


def defined(root):
    """(test programs, labels): a label is the folder of the CMakeLists.txt that defines a program, or is set explicitly."""
    programs, labels = set(), set()
    for path in pathlib.Path(root, "tests").rglob("CMakeLists.txt"):
        text = path.read_text()
        found = re.findall(r"^\s*whisker_test\((\w+)", text, re.MULTILINE)
        programs.update(found)
        labels.update([path.parent.name] if found else [])
        for given in re.findall(r'LABELS "?([\w;]+)|^bus_test\("[^"]*" (\w+)', text, re.MULTILINE):
            labels.update("".join(given).split(";"))
    return programs, labels


def problems(root, text):
    programs, labels = defined(root)
    presets = {p["name"] for p in json.loads(pathlib.Path(root, "CMakePresets.json").read_text())["configurePresets"]}
    for name in sorted(set(re.findall(r"\bwhisker_core_properties\b|\bwhisker_\w+_tests\b", text)) - programs):
        yield f"scripts/stages.sh: no test program is {name}"
    patterns = re.findall(r"['\"]\^?\(?([\w|$]+)\)?\\?\$?['\"]", text)
    named = {label for pattern in patterns if "|" in pattern for label in pattern.split("|") if label}
    for label in sorted(named - labels):
        yield f"scripts/stages.sh: no test has the label {label}"
    used = set(re.findall(r"^\s*(?:build|build_and_test|build_and_test_core) ([\w-]+)", text, re.MULTILINE))
    for preset in sorted(used - presets):
        yield f"scripts/stages.sh: no preset is {preset}"


def main(root):
    text = pathlib.Path(root, "scripts/stages.sh").read_text()
    return finish("stages", len(text.splitlines()), list(problems(root, text)))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
