"""Commands in README.md and docs/: their names and options exist, and what is shown below `$ whisker ...` is what it prints."""

import functools
import pathlib
import re

import whisker
from whisker import Case

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
BLOCK = re.compile(r"^```(?:sh)?\n(.*?)^```", re.MULTILINE | re.DOTALL)
FENCE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
SHOWN = re.compile(r"^```\n\$ whisker ([^\n]*)\n(.*?)^```", re.MULTILINE | re.DOTALL)
COMMAND = re.compile(r"(?:^|[ /$'(`])whisker ([a-z-]+)((?: [a-z-]+)?)([^|;&#`\n]*)")


@functools.cache
def help_of(*words):
    return whisker.whisker(*words, "--help", cwd=ROOT).stdout


class Pages(Case):
    def test_name_only_commands_and_options_that_exist(self):
        checked = 0
        for page in PAGES:
            code = "\n".join(BLOCK.findall(page.read_text())).replace("\\\n", " ")
            spans = re.findall(r"`[^`]+`", FENCE.sub("", page.read_text()))
            for command, word, rest in COMMAND.findall("\n".join([code, *(" ".join(span.split()) for span in spans)])):
                words = [command, word.strip()] if command in ("bench", "robot", "rules") and word else [command]
                self.assertTrue(help_of(*words), (page.name, words))
                for option in re.findall(r"(?<!\S)--[a-z-]+", rest):
                    checked += 1
                    self.assertRegex(help_of(*words), rf"(?<![\w-]){option}(?![\w-])", (page.name, words))
        self.assertGreater(checked, 90)

    def test_show_what_the_commands_print(self):
        shown = [(page.name, *found) for page in PAGES for found in SHOWN.findall(page.read_text())]
        # bench_test and tests/rules/cli_test run those that need a bus or write a header.
        alone = [one for one in shown if not re.search(r" --(can|header) ", one[1])]
        self.assertGreaterEqual(len(alone), 3)
        for page, command, wanted in alone:
            self.assertEqual(whisker.whisker(*command.split(), cwd=ROOT).stdout, wanted, page)


if __name__ == "__main__":
    whisker.main()
