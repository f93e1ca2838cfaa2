"""What the scripts here share: the classes of worlds, and `whisker campaign` through them."""

import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
WHISKER = pathlib.Path(os.environ.get("WHISKER", ROOT / "build/host/whisker")).resolve()
PROGRAM = pathlib.Path(sys.argv[0]).name

# Name: arguments of `whisker world` without the seed.
CLASSES = {
    "15 discs": "discs --discs 15",
    "30 discs": "discs",
    "50 discs": "discs --discs 50",
    "75 discs in a box": "discs --discs 75 --box",
    "U-traps": "u-trap",
    "spirals": "spiral",
    "mazes": "maze",
    "rooms": "rooms",
    "poles": "poles",
    "enclosed": "enclosed",
}


def need_whisker():
    if not WHISKER.exists():
        sys.exit(f"{PROGRAM}: {WHISKER} is missing: cmake --preset host && cmake --build --preset host")


def summary(command, arguments, count, first_seed, *more):
    """The summary that this command of whisker prints. Ends the program if it fails."""
    words = [command, *arguments.split(), "--count", str(count), "--seed", str(first_seed), *more]
    done = subprocess.run([WHISKER, *words, "--json"], stdout=subprocess.PIPE, check=False)
    if done.returncode != 0:
        sys.exit(f"{PROGRAM}: whisker {' '.join(words)}: exit status {done.returncode}")
    return json.loads(done.stdout)


def campaign(arguments, count, first_seed, *more):
    """Of `whisker campaign --json`; see docs/campaign.md."""
    return summary("campaign", arguments, count, first_seed, *more)


def scan(arguments, count, first_seed):
    """Of `whisker scanner --json`, in the same worlds; see docs/comparison.md."""
    return summary("scanner", arguments, count, first_seed)


def cell(estimate, scale=1, digits=0):
    """"value (low-high)" with 95 % bounds; "?" for a bound that the sample is too small for."""
    if estimate is None or estimate["value"] is None:
        return "-"
    text = ["?" if estimate[k] is None else f"{scale * estimate[k]:.{digits}f}" for k in ("value", "low", "high")]
    return "{} ({}-{})".format(*text)


def percent(estimate):
    """With a decimal: one mission in a thousand must show."""
    return cell(estimate, 100, 1)


def faults(summary):
    """Missions that ended in a fault."""
    return round(summary["fault"]["value"] * summary["missions"])


def row(*cells):
    print(f"| {' | '.join(cells)} |", flush=True)


def heading(*cells):
    row(*cells)
    print(f"|{'---|' * len(cells)}")


def whole_numbers(texts, usage):
    """Command-line arguments that are counts and seeds. Ends the program with exit status 2 for others."""
    if not all(text.isascii() and text.isdecimal() for text in texts):
        print(usage, file=sys.stderr)
        sys.exit(2)
    return [int(text) for text in texts]
