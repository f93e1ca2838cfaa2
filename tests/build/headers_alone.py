"""Every header compiles alone, and twice. usage: headers_alone.py ROOT CXX FLAG...

A header that begins with its includes compiles alone if it compiles after headers that it includes anyway, directly or not, and after
the library headers that it includes anyway, precompiled. So that most headers share a compilation, and none sees another's includes.
With WHISKER_LONG, each is compiled by itself.
"""

import collections
import pathlib
import re
import sys
import tempfile

from compile import LONG, compile_all
from sources import finish, sources

INCLUDE = re.compile(r'\s*#\s*include\s*([<"])([^>"]+)')
SHARED = 5  # headers that are worth a precompiled one


class Header:
    """What it includes, and what of that under no condition; whether all that precedes its code."""

    def __init__(self, text):
        self.project, self.surely, self.library, self.in_front = set(), set(), set(), True
        depth, code = 0, False
        for line in re.sub(r"/\*(?s:.*?)\*/|//.*", "", text).splitlines():
            found = INCLUDE.match(line)
            depth += bool(re.match(r"\s*#\s*if", line)) - bool(re.match(r"\s*#\s*endif", line))
            if found:
                self.in_front &= not code
                self.add(*found.groups(), depth == 0)
            else:
                code |= bool(line.strip()) and not re.match(r"\s*#\s*(pragma once|if|el|endif)", line)

    def add(self, quote, name, surely):
        if quote == '"':
            self.project.add(name)
        if surely:
            (self.surely if quote == '"' else self.library).add(name)


class Tree:
    def __init__(self, root, names):
        self.headers = {name: Header(pathlib.Path(root, name).read_text()) for name in names}
        self.seen = {name: self.closure(name, lambda header: header.project) for name in names}
        self.surely = {name: self.closure(name, lambda header: header.surely) for name in names}

    def closure(self, name, included):
        """The headers that this one sees, with itself."""
        seen, left = set(), [name]
        while left:
            one = left.pop()
            if one in self.headers and one not in seen:
                seen.add(one)
                left += included(self.headers[one])
        return frozenset(seen)

    def library(self, name):
        return frozenset().union(*(self.headers[one].library for one in self.surely[name]))

    def after(self, name, kind):
        """The headers of its kind that see all that it sees, and more."""
        return [b for b in self.headers if kind[b] == kind[name] and self.headers[b].in_front and self.seen[name] < self.surely[b]]

    def chains(self, kind):
        """The headers in few lists, in each of which every one is of one kind and sees all before it: a least path cover, by matching."""
        after, before = {name: self.after(name, kind) for name in self.headers}, {}

        def place(name, tried):
            for other in after[name]:
                if other not in tried:
                    tried.add(other)
                    if other not in before or place(before[other], tried):
                        before[other] = name
                        return True
            return False

        for name in self.headers:
            place(name, set())
        for last in sorted(self.headers.keys() - set(before.values())):
            chain = [last]
            while chain[0] in before:
                chain.insert(0, before[chain[0]])
            yield chain


def includes(form, names):
    return "".join(f"#include {form[0]}{name}{form[1]}\n" for name in names)


def common_libraries(tree):
    """{header: the largest set of library headers that it sees and SHARED headers see exactly}"""
    seen = {name: tree.library(name) for name in tree.headers}
    common = sorted((library for library, count in collections.Counter(seen.values()).items() if count >= SHARED), key=lambda l: (len(l), sorted(l)))
    return {name: ([frozenset()] + [library for library in common if library <= seen[name]])[-1] for name in seen}


def precompiled(command, libraries, folder):
    """{set: the options that read it precompiled}"""
    options, jobs = {}, []
    for library in libraries:
        file = f"{folder}/{len(options)}.hpp"
        pathlib.Path(file).write_text(includes("<>", sorted(library)))
        jobs.append((file, [*command, "-x", "c++-header", file, "-o", f"{file}.gch"], None))
        options[library] = ["-include", file]
    return options, [f"{name}:\n{output}" for name, output in compile_all(jobs) if output]


def main(root, compiler, *flags):
    tree = Tree(root, [header.as_posix() for header in sources(root, ("firmware", "hal", "host"), (".hpp",))])
    command = [compiler, "-std=c++17", f"-I{root}", *flags]
    kind = dict.fromkeys(tree.headers, frozenset()) if LONG else common_libraries(tree)
    chains = [[name] for name in tree.headers] if LONG else tree.chains(kind)
    with tempfile.TemporaryDirectory() as folder:
        options, problems = precompiled(command, set(kind.values()), folder)
        jobs = [
            (", ".join(chain), [*command, *options[kind[chain[0]]], "-fsyntax-only", "-x", "c++", "-"], includes('""', chain) * 2)
            for chain in chains
        ]  # fmt: skip
        problems += [f"{name}: not alone:\n{output}" for name, output in compile_all(jobs) if output]
    return finish("headers alone", len(tree.headers), problems)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
