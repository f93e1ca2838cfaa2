"""`whisker rules` against fuzzylite, for the rule bases that fuzzylite's authors published.

usage: published_test.py COMPARE [unittest options]
COMPARE is the program whisker_rules_compare. Downloads Debian's source package of fuzzylite 6.0 (1 MB, its SHA-256 is checked) into
build/published, once.
"""

import hashlib
import io
import pathlib
import re
import subprocess
import sys
import tarfile
import unittest
import urllib.request

ROOT = pathlib.Path(__file__).resolve().parents[2]
KEPT = ROOT / "build/published/fuzzylite_6.0.tar.xz"
PACKAGE = "fuzzylite_6.0+dfsg.orig.tar.xz"
SOURCES = (
    f"https://deb.debian.org/debian/pool/main/f/fuzzylite/{PACKAGE}",
    f"http://deb.debian.org/debian/pool/main/f/fuzzylite/{PACKAGE}",
    f"https://snapshot.debian.org/archive/debian/20250520T000000Z/pool/main/f/fuzzylite/{PACKAGE}",
)
SHA256 = "31c871149f63143cd8f25dafcb945cebc56ddd4ba711a020a41b34fa7df643a3"
FILES, COMPILED = 78, 39
PATIENCE_S = 60


def downloaded():
    """The archive, or the reason why there is none."""
    why = []
    for source in SOURCES:
        try:
            with urllib.request.urlopen(source, timeout=PATIENCE_S) as answer:
                data = answer.read()
        except OSError as error:
            why.append(f"{source}: {error}")
            continue
        if hashlib.sha256(data).hexdigest() == SHA256:
            return data
        why.append(f"{source}: another SHA-256 than {SHA256}")
    raise SystemExit("published_test: " + "; ".join(why))


def archive():
    if KEPT.exists() and hashlib.sha256(KEPT.read_bytes()).hexdigest() == SHA256:
        return KEPT.read_bytes()
    data = downloaded()
    KEPT.parent.mkdir(parents=True, exist_ok=True)
    KEPT.write_bytes(data)
    return data


def unpacked():
    """The rule files of the archive, in build/published."""
    files = []
    with tarfile.open(fileobj=io.BytesIO(archive()), mode="r:xz") as tar:
        for member in tar.getmembers():
            name = pathlib.PurePosixPath(member.name)
            if not member.isfile() or name.suffix not in (".fis", ".fll", ".fcl") or ".." in name.parts:
                continue
            file = KEPT.parent.joinpath(*name.parts[1:])
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(tar.extractfile(member).read())
            files.append(file)
    return sorted(files)


class Published(unittest.TestCase):
    compare = ""

    def test_answers_agree_and_the_rest_is_refused_with_its_place(self):
        files = unpacked()
        self.assertEqual(len(files), FILES)
        done = subprocess.run([self.compare, *files], capture_output=True, text=True, check=False, timeout=1200)
        print(done.stdout)
        *lines, total = done.stdout.splitlines()
        self.assertEqual(done.returncode, 0)
        self.assertEqual(len(lines), FILES)
        compiled = 0
        for file, line in zip(files, lines):
            if "not compiled" in line:
                self.assertRegex(line, f"not compiled: {re.escape(str(file))}:[0-9]+:[0-9]+: .+")
            else:
                self.assertRegex(line, f"^{re.escape(str(file))}: [0-9]+ answers agree, [0-9]+ bytes,")
                compiled += 1
        self.assertEqual(compiled, COMPILED)
        self.assertEqual(total, f"{COMPILED} of {FILES} files compiled, 0 disagree")


if __name__ == "__main__":
    Published.compare = sys.argv.pop(1)
    unittest.main(verbosity=2)
