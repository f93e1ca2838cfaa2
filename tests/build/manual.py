"""The build's man page and completions name every command; groff and the shells accept them; bash completes.

usage: manual.py FOLDER WHISKER
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from sources import finish

# Words typed, the last one to complete: what is offered in a folder with the files a.toml and b.csv, and the folder c.
OFFERS = (
    (("ru",), {"run", "rules"}),
    (("run", "--planner", "th"), {"thesis"}),
    (("run", ""), {"a.toml", "b.csv", "c"}),
    (("robot", "layout", "--sens"), {"--sensor"}),
    (("world", "ga"), {"gap", "gap-at-wall"}),
    (("movers", "--contacts", ""), {"c"}),
)
COMPLETE = 'source "$1"; shift; COMP_WORDS=(whisker "$@"); COMP_CWORD=$#; _whisker; printf "%s\\n" "${COMPREPLY[@]}"'
# Each with the command that accepts it; zsh and fish only where they are installed.
FILES = {"whisker.1": "groff -man -ww -z", "whisker.bash": "bash -n", "_whisker": "zsh -n", "whisker.fish": "fish -n"}


def offered(script, words):
    with tempfile.TemporaryDirectory() as folder:
        for name in ("a.toml", "b.csv"):
            pathlib.Path(folder, name).touch()
        pathlib.Path(folder, "c").mkdir()
        done = subprocess.run(["bash", "-c", COMPLETE, "bash", script, *words], cwd=folder, capture_output=True, text=True, check=False)
        return {line for line in (done.stdout + done.stderr).splitlines() if line}


def problems(folder, whisker):
    told = subprocess.run([whisker, "--help"], capture_output=True, text=True, check=True).stdout
    commands = re.findall(r"^  (\w+) ", told.partition("Subcommands:")[2].partition("\n\n")[0], re.MULTILINE)
    if not commands:
        yield "the help names no command"
    for name, command in FILES.items():
        text = (folder / name).read_text() if (folder / name).is_file() else ""
        for word in commands:
            if not re.search(rf"\b{word}\b", text):
                yield f"{name} does not name {word}"
        words = command.split()
        if name.endswith((".1", ".bash")) or shutil.which(words[0]):
            done = subprocess.run([*words, folder / name], capture_output=True, text=True, check=False)
            if done.returncode or done.stderr:
                yield f"{command} {name}: exit status {done.returncode}\n{done.stdout}{done.stderr}"
    for words, wanted in OFFERS:
        found = offered(folder / "whisker.bash", words)
        if found != wanted:
            yield f"whisker {' '.join(words)}: bash offers {sorted(found)}, not {sorted(wanted)}"


def main(folder, whisker):
    return finish("the manual", len(FILES) + len(OFFERS), list(problems(pathlib.Path(folder), whisker)))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
