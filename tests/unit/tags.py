#!/usr/bin/env python3
"""Checks that each public name means one thing: no tag with the prefix kd_ is declared twice.

tags.py SRC SHADERS     exit 1 naming every tag that has two meanings in C and GLSL together

A tag is the name of a struct, enum or union. Declarations with the same text have one meaning, because C and GLSL
expand the same lists of interface.h. A function may have the name of a tag that occurs in its declaration, such as a
function that makes this struct.
"""

import collections
import pathlib
import re
import sys
import tempfile

COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.S)
TAG = re.compile(r"\b(?:struct|enum|union)\s+(kd_\w+)\s*\{")
FUNCTION = re.compile(
    r"^(?!#|return\b|else\b)(?P<result>\w[\w \t*]*?)\b(?P<name>kd_\w+)\((?P<arguments>[^;{}]*?)\)\s*\{", re.M
)


def body(text, start):
    """The text from the brace at `start` to the one that closes it, with single spaces."""
    depth = 0
    for end in range(start, len(text)):
        depth += {"{": 1, "}": -1}.get(text[end], 0)
        if not depth:
            return " ".join(text[start : end + 1].split())
    return text[start:]


def wrong(src, shaders):
    """Sentences, one for each name with two meanings."""
    tags, functions = collections.defaultdict(dict), collections.defaultdict(dict)
    paths = [*src.rglob("*.[ch]"), *(p for p in shaders.rglob("*") if p.suffix in {".comp", ".glsl", ".h"})]
    for path in sorted(paths):
        text = COMMENT.sub(" ", path.read_text(encoding="utf-8"))
        for found in TAG.finditer(text):
            tags[found[1]].setdefault(body(text, found.end() - 1), path)
        for found in FUNCTION.finditer(text):
            functions[found["name"]][path] = found["result"] + found["arguments"]
    for name, bodies in sorted(tags.items()):
        if len(bodies) > 1:
            yield f"{name} is declared with {len(bodies)} meanings: " + ", ".join(map(str, bodies.values()))
        for path, declaration in functions[name].items():
            if not re.search(rf"\b{name}\b", declaration):
                yield f"{name} is a tag in {next(iter(bodies.values()))} and a function in {path}, which has nothing of it"


def self_test():
    """Each kind of doubled name is found, and a permitted repetition is not reported."""
    files = {
        "src/a.h": "struct kd_one { int a; };\nenum kd_two { KD_A };\nstruct kd_three { KD_FIELDS };\nstruct kd_four { int n; };\n",
        "src/b.h": "struct kd_one { int b; };\nstruct kd_two;\n/* struct kd_three { int none; }; */\nstruct own { int a; };\n",
        "src/c.c": "struct own { int b; };\nint kd_four(void)\n{\n}\n",
        "src/d.c": "struct kd_five { int n; };\nstruct kd_five kd_five(int n)\n{\n}\n",
        "shaders/e.glsl": "struct kd_two { float x; };\nstruct kd_three { KD_FIELDS };\n",
    }
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            (pathlib.Path(folder) / name).parent.mkdir(exist_ok=True)
            (pathlib.Path(folder) / name).write_text(text)
        found = [line.split()[0] for line in wrong(pathlib.Path(folder) / "src", pathlib.Path(folder) / "shaders")]
    if found != ["kd_four", "kd_one", "kd_two"]:
        print("its own example is judged wrongly:", found)
        return True
    return False


def main():
    if self_test():
        return True
    src, shaders = map(pathlib.Path, sys.argv[1:3])
    found = list(wrong(src, shaders))
    for line in found:
        print(line)
    return bool(found) or not any(src.rglob("*.c"))


if __name__ == "__main__":
    sys.exit(main())
