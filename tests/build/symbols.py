"""The symbols that the core's ARM objects may define and need; every other symbol is a problem."""

import re
import subprocess

# Integer and memory helpers of libgcc and the run-time ABI. Soft float (__aeabi_f*, __aeabi_d*),
# the heap, guards of static locals, exceptions and unwinding are not here, so they are problems.
EXTERNAL = re.compile(
    r"memcpy|memmove|memset"
    r"|__aeabi_mem(cpy|move|set|clr)[48]?"
    r"|__aeabi_u?ldivmod|__aeabi_u?idiv(mod)?|__aeabi_l(mul|lsl|lsr|asr|cmp)|__aeabi_ulcmp"
    r"|__gnu_thumb1_case_[us][qhs]i"
    r"|__(clz|ctz|popcount)[sd]i2"
)


def symbols(nm, objects):
    """(type letter, name) of every symbol of the objects."""
    listing = subprocess.run(
        [nm, "--format=posix", *map(str, objects)], capture_output=True, text=True, check=True
    ).stdout
    return [(kind, name) for name, kind in re.findall(r"^(\S+) ([A-Za-z])(?: .*)?$", listing, re.MULTILINE)]


def forbidden(nm, objects):
    found = symbols(nm, objects) if objects else []
    defined = {name for kind, name in found if kind not in "UwvN"}
    problems = []
    for kind, name in sorted(set(found)):
        if kind in "Uwv" and name not in defined and not EXTERNAL.fullmatch(name):
            problems.append(f"symbol {name}: not in the core, and not an integer or memory helper")
        elif name.startswith("_GLOBAL__sub_I_"):
            problems.append(f"symbol {name}: code that runs before main")
        elif kind in "bBdDcC" and not name.startswith("$"):
            problems.append(f"symbol {name}: state outside of the caller's objects")
    return problems
