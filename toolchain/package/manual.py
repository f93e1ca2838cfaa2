"""Writes the man page of the whisker command and its completions for bash, zsh and fish, from the help of all its subcommands.

usage: manual.py WHISKER VERSION FOLDER
"""

import pathlib
import re
import subprocess
import sys

PATHS = {"FILE": "file", "PATH": "file", "SCENARIO": "file", "ROBOT": "file", "FOLDER": "folder", "KIND|DIR": "folder"}
HEAD = "# Completion of the whisker command. Made by toolchain/package/manual.py.\n"


class Entry:
    """An option, a positional argument or a subcommand, as a line of the help and those that continue it."""

    def __init__(self, left, text):
        self.text = text
        name, _, rest = left.partition(" ")
        self.names = name.split(",")
        self.required = "REQUIRED" in rest.split()
        self.argument = re.split(r" ?(?:REQUIRED|Excludes:|Needs:|\.\.\.)", rest)[0].strip()
        self.several = "..." in rest
        # What the argument is: a file, a folder, a value, or "" for a flag.
        self.kind = PATHS.get(re.split(r"[:=]", self.argument.strip("[]"))[0], "value") if self.argument else ""

    @property
    def values(self):
        """The words that the text lists as values of the argument."""
        if "--robots" in self.names:
            return [self.argument]
        if not {"--planner", "--map-bytes"} & {*self.names} and "KIND" not in self.names[0] or "`" in self.text:
            return []
        return re.findall(r"[a-z0-9][a-z0-9-]*", re.sub(r"\b(Planner|baselines|Of planner map):|\bor\b", " ", self.text))

    @property
    def place(self):
        """What a positional argument completes to."""
        return self.kind if self.kind in ("file", "folder") else "folder" if "DIR" in self.names[0] else ""


class Command:
    def __init__(self, path, text):
        self.path, self.positionals, self.options, self.subcommands = path, [], [], []
        sections = {"Positionals:": self.positionals, "Options:": self.options, "Subcommands:": self.subcommands}
        self.about, *lines = text.splitlines()
        section, footer = None, []
        for line in lines:
            if line.startswith("Usage:"):
                self.usage = line[len("Usage: ") :]
            elif line in sections:
                section = sections[line]
            elif section is not None and line.startswith("      "):
                section[-1].text = f"{section[-1].text} {line.strip()}".strip()
            elif section is not None and line.startswith("  "):
                left, _, right = re.sub(r"\s{2,}", "\0", line.strip(), count=1).partition("\0")
                section.append(Entry(left, right))
            elif line or footer:
                section = None
                footer.append(line)
        self.footer = "\n".join(footer)


def read(whisker, path=("whisker",)):
    """The command and all below it, in the order of the help."""
    command = Command(path, subprocess.run([whisker, *path[1:], "--help"], capture_output=True, text=True, check=True).stdout)
    return [command, *(below for entry in command.subcommands for below in read(whisker, (*path, entry.names[0])))]


def roff(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\n".join(f"\\&{line}" if line.startswith((".", "'")) else line for line in text.split("\n"))


def man_entry(entry, more=""):
    names = ", ".join(f"\\fB{roff(name)}\\fR" for name in entry.names)
    argument = f" \\fI{roff(entry.argument)}\\fR" if entry.argument else ""
    return [".TP", names + argument + (" ..." if entry.several else ""), roff(entry.text + more)]


def man(commands, version):
    top = commands[0]
    yield from (f'.TH WHISKER 1 "" "Whisker {version}" "User Commands"', ".SH NAME", f"whisker \\- {roff(top.about.split(': ', 1)[1])}")
    yield from (".SH SYNOPSIS", f".B whisker\n{roff(top.usage.split(' ', 1)[1])}", ".SH OPTIONS")
    for entry in top.options:
        yield from man_entry(entry)
    yield ".SH COMMANDS"
    for command in commands[1:]:
        yield from (f".SS {roff(' '.join(command.path[1:]))}", roff(command.about + "."), ".PP", f"\\fB{roff(command.usage)}\\fR")
        for entry in [*command.positionals, *command.options]:
            if "--help" not in entry.names:
                yield from man_entry(entry, ". Required." if entry.required and entry in command.options else "")
    notes = dict.fromkeys(command.footer for command in commands[1:] if command.footer)
    yield from (".SH EXIT STATUS", ".nf", *(roff(note) + "\n" for note in notes), ".fi")
    yield from (".SH FIRST STEPS", ".nf", roff(top.footer.split("First steps:\n", 1)[1]), ".fi")


def bash(commands):
    paths = " | ".join(f'"{" ".join(command.path)}"' for command in commands[1:])
    yield f"""# shellcheck shell=bash
{HEAD}_whisker() {{
  local path=whisker word here=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} options="" words="" paths=none
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    case "$path $word" in
      {paths}) path+=" $word" ;;
    esac
  done
  case $path in"""
    for command in commands:
        options = " ".join(name for entry in command.options for name in entry.names)
        words = [entry.names[0] for entry in command.subcommands] + [word for entry in command.positionals for word in entry.values]
        place = next((entry.place for entry in command.positionals if entry.place), "none")
        yield f'    "{" ".join(command.path)}")\n      options="{options}" words="{" ".join(words)}" paths={place}'
        cases = {}
        for entry in command.options:
            if entry.kind:
                cases.setdefault(f'words="{" ".join(entry.values)}" paths={entry.kind}', []).extend(entry.names)
        if cases:
            yield "      case $before in"
            yield from (f'        {" | ".join(names)}) options="" {found} ;;' for found, names in cases.items())
            yield "      esac"
        yield "      ;;"
    yield """  esac
  [[ $here == -* ]] && words=$options
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$here")
  [[ $here == -* ]] && return
  case $paths in
    file) mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -- "$here") ;;
    folder) mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -d -- "$here") ;;
  esac
}
complete -o filenames -F _whisker whisker"""


def zsh_text(text):
    return re.sub(r"([\[\]:\\])", r"\\\1", text).replace("'", "'\\''")


def zsh_specs(command):
    actions = {"file": "_files", "folder": "_files -/"}

    def action(entry, kind, other):
        return f"({' '.join(entry.values)})" if entry.values else actions.get(kind, other)

    for entry in command.options:
        argument = f":{zsh_text(entry.argument)}:{action(entry, entry.kind, '')}" if entry.kind else ""
        yield from (f"'{name}[{zsh_text(entry.text)}]{argument}'" for name in entry.names)
    for entry in command.positionals:
        yield f"':{zsh_text(entry.names[0])}:{action(entry, entry.place, '_files')}'"


def zsh(commands):
    yield f"#compdef whisker\n{HEAD}"
    for command in commands:
        name = "_".join(("", *command.path))
        below = ["'1:command:->command'", "'*::argument:->argument'"] if command.subcommands else []
        yield f"{name}() {{" + ("\n  local line state" if below else "")
        yield " \\\n    ".join([f"  _arguments{' -C' if below else ''}", *zsh_specs(command), *below])
        if below:
            yield "  case $state in\n    command)\n      local -a commands=("
            yield from (f"        '{entry.names[0]}:{zsh_text(entry.text)}'" for entry in command.subcommands)
            yield "      )\n      _describe command commands\n      ;;\n    argument)"
            yield f"      (($+functions[{name}_$line[1]])) && {name}_$line[1]\n      ;;\n  esac"
        yield "}\n"
    yield '_whisker "$@"'


def fish_quoted(text):
    return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"


def fish(commands):
    yield HEAD.rstrip()
    for command in commands:
        here = command.path[1:]
        condition = " && ".join(f"__fish_seen_subcommand_from {word}" for word in here) or "__fish_use_subcommand"
        if here and command.subcommands:
            condition += " && not __fish_seen_subcommand_from " + " ".join(entry.names[0] for entry in command.subcommands)
        start = f"complete -c whisker -n {fish_quoted(condition)}"
        yield from (f"{start} -f -a {entry.names[0]} -d {fish_quoted(entry.text)}" for entry in command.subcommands)
        for entry in command.options:
            names = "".join(f" -l {name[2:]}" if name.startswith("--") else f" -s {name[1:]}" for name in entry.names)
            argument = {"": "", "file": " -r -F", "folder": " -x -a '(__fish_complete_directories)'", "value": " -x"}[entry.kind]
            offered = f" -a {fish_quoted(' '.join(entry.values))}" if entry.values else ""
            yield f"{start}{names}{argument}{offered} -d {fish_quoted(entry.text)}"
        yield from (f"{start} -f -a {fish_quoted(' '.join(entry.values))}" for entry in command.positionals if entry.values)


def main(whisker, version, folder):
    commands, out = read(whisker), pathlib.Path(folder)
    out.mkdir(parents=True, exist_ok=True)
    for name, lines in (("whisker.1", man(commands, version)), ("whisker.bash", bash(commands)), ("_whisker", zsh(commands)), ("whisker.fish", fish(commands))):
        (out / name).write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
