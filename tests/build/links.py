"""Links of README.md, docs/ and the unreleased part of CHANGELOG.md lead to a file that is there and, in a page, to a heading. usage: links.py ROOT"""

import pathlib
import re
import sys

from sources import finish

LINK = re.compile(r"\]\(([^)\s]+)\)")
FENCE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)


def anchors(text):
    """GitHub's, of all headings."""
    headings = re.findall(r"^#+ (.*)$", FENCE.sub("", text), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def problems(root, page, text):
    for link in LINK.findall(FENCE.sub("", text)):
        if re.match(r"\w+:", link):
            continue
        path, _, anchor = link.partition("#")
        target = root / page if not path else (root / page).parent / path
        if not target.exists():
            yield f"{page}: {link} is not there"
        elif anchor and anchor not in anchors(target.read_text()):
            yield f"{page}: {link} names no heading"


def main(root):
    root = pathlib.Path(root)
    pages = {path.relative_to(root): path.read_text() for path in (root / "README.md", *sorted((root / "docs").rglob("*.md")))}
    if (root / "CHANGELOG.md").exists():
        pages[pathlib.Path("CHANGELOG.md")] = (root / "CHANGELOG.md").read_text().partition("\n## [0")[0]
    return finish("pages", len(pages), [problem for page, text in pages.items() for problem in problems(root, page, text)])


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
