#!/usr/bin/env python3
"""Checks that oracles share no code with the program under test: files of tests/oracle use no header, function or macro
of the program.

oracles.py ROOT     exit 1 naming each line of tests/oracle that does, after proving that it finds such lines
"""

import pathlib
import re
import sys

# Files that may use the program, each with the reason.
OTHERS = {"line_triangles.h": "its rays are those of the disk's image, which other oracles judge; its sums are its own"}
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"')
NAME = re.compile(r"\b(?:kd_|KD_(?!TESTS_))\w+")
IMPORT = re.compile(r"^\s*(?:import|from)\s+kerrd\b")
COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.S)


def uses(name, text, own):
    """Numbers and text of the lines that use the program. own: names of the files of tests/oracle."""
    if not name.endswith(".py"):
        text = COMMENT.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)
    for number, line in enumerate(text.split("\n"), 1):
        header = INCLUDE.match(line)
        if name.endswith(".py"):
            wrong = IMPORT.match(line)
        else:
            wrong = (header and header[1] not in own) or NAME.search(line)
        if wrong:
            yield number, line.strip()


def self_test():
    own = {"kerr_schild.h"}
    right = [
        ("a.c", '#include "physics/spacetime/kerr.h"'),
        ("a.h", "double isco = kd_kerr_isco(hole);"),
        ("a.h", "return KD_HOLE_DELTA_W(root, w);"),
        ("a.py", "import kerrd"),
        ("a.py", "    from kerrd.grmhd import koral"),
    ]
    wrong = [
        ("a.c", '#include "kerr_schild.h"'),
        ("a.c", "/* as kd_kerr_isco */"),
        ("a.h", "#ifndef KD_TESTS_A_H"),
        ("a.py", "import kerr_reference"),
        ("a.py", "print('kd_kerr_isco')"),
    ]
    missed = [line for line in right if not list(uses(*line, own))] + [line for line in wrong if list(uses(*line, own))]
    for line in missed:
        print("judged wrongly:", line)
    return bool(missed)


def main():
    if self_test():
        return True
    files = sorted(pathlib.Path(sys.argv[1], "tests/oracle").iterdir())
    own, bad, seen = {path.name for path in files}, [], 0
    for path in files:
        if path.suffix not in {".c", ".h", ".py"}:
            continue
        seen += 1
        found = list(uses(path.name, path.read_text(encoding="utf-8"), own))
        if path.name not in OTHERS:
            bad += [f"tests/oracle/{path.name}:{number}: {line}" for number, line in found]
        elif not found:
            bad += [f"tests/oracle/{path.name}: its row in OTHERS is stale"]
    bad += [f"tests/oracle/{name}: there is no such file" for name in sorted(OTHERS.keys() - own)]
    for line in bad:
        print(line)
    return bool(bad) or not seen


if __name__ == "__main__":
    sys.exit(main())
