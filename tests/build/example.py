"""The examples of the documentation are the files that are compiled, verbatim. usage: example.py ROOT"""

import pathlib
import re
import sys

EXAMPLES = {"docs/porting.md": "docs/example/main.cpp", "docs/guard.md": "tests/guard/example.cpp"}

root = pathlib.Path(sys.argv[1])
for page, file in EXAMPLES.items():
    example = (root / file).read_text()
    block = f"<!-- example:begin -->\n```cpp\n{example}```\n<!-- example:end -->\n"
    if block not in (root / page).read_text():
        sys.exit(f"{page}: the example between its marks is not {file}")
    print(f"{page} shows the example that is compiled")
excerpt = re.search(r"```cpp\n(.*?)```\n", (root / "README.md").read_text(), re.DOTALL)
if not excerpt or excerpt[1] not in (root / "docs/example/main.cpp").read_text():
    sys.exit("README.md: its example is no part of docs/example/main.cpp")
print("README.md shows a part of it")
