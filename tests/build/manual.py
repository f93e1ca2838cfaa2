"""The man page and the completions are what the help of the command says; groff and the shells accept them; bash completes.

usage: manual.py ROOT WHISKER
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile

from sources import finish

# Words typed, the last one to complete: what is offered in a folder with the files a.toml and b.csv, and the folder c.
OFFERS = (
    (("ru",), {"run", "rules"}),
    (("--v",), {"--version"}),
    (("run", "--pl"), {"--planner"}),
    (("run", "--planner", "th"), {"thesis"}),
    (("run", "--seed", ""), set()),
    (("run", ""), {"a.toml", "b.csv", "c"}),
    (("run", "--robot", "a"), {"a.toml"}),
    (("robot", ""), {"check", "layout", "calibrate", "calibrate-drive"}),
    (("robot", "layout", "--sens"), {"--sensor"}),
    (("world", "ga"), {"gap", "gap-at-wall"}),
    (("movers", "--contacts", ""), {"c"}),
    (("campaign", "--robots", ""), {"random"}),
)
COMPLETE = 'source "$1"; shift; COMP_WORDS=(whisker "$@"); COMP_CWORD=$#; _whisker; printf "%s\\n" "${COMPREPLY[@]}"'


def offered(script, words):
    with tempfile.TemporaryDirectory() as folder:
        for name in ("a.toml", "b.csv"):
            pathlib.Path(folder, name).touch()
        pathlib.Path(folder, "c").mkdir()
        done = subprocess.run(["bash", "-c", COMPLETE, "bash", script, *words], cwd=folder, capture_output=True, text=True, check=False)
        return {line for line in (done.stdout + done.stderr).splitlines() if line}


def problems(root, whisker):
    folder = pathlib.Path(root, "toolchain/package/manual")
    checks = {
        "scripts/manual --check": ([f"{root}/scripts/manual", "--check", whisker], True),
        "groff": (["groff", "-man", "-ww", "-z", folder / "whisker.1"], True),
        "bash": (["bash", "-n", folder / "whisker.bash"], True),
        # Checked where they are installed.
        "zsh": (["zsh", "-n", folder / "_whisker"], False),
        "fish": (["fish", "-n", folder / "whisker.fish"], False),
    }
    for name, (command, needed) in checks.items():
        if not needed and not shutil.which(command[0]):
            continue
        done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)
        if done.returncode or done.stderr:
            yield f"{name}: exit status {done.returncode}\n{done.stdout}{done.stderr}"
    for words, wanted in OFFERS:
        found = offered(folder / "whisker.bash", words)
        if found != wanted:
            yield f"whisker {' '.join(words)}: bash offers {sorted(found)}, not {sorted(wanted)}"


def main(root, whisker):
    return finish("the manual", len(OFFERS), list(problems(root, whisker)))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
