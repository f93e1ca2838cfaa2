"""docs/firmware.md shows docs/example/main.cpp verbatim. usage: example.py ROOT"""

import pathlib
import sys

root = pathlib.Path(sys.argv[1])
shown = (root / "docs/firmware.md").read_text()
example = (root / "docs/example/main.cpp").read_text()
block = f"<!-- example:begin -->\n```cpp\n{example}```\n<!-- example:end -->\n"
if block not in shown:
    sys.exit("docs/firmware.md: the example between its marks is not docs/example/main.cpp")
print("docs/firmware.md shows the example that is compiled")
