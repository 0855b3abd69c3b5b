#!/usr/bin/env python3
"""Checks that what the documents name exists: links, headings, and files and folders in backquotes.

It also checks that docs/web.md names each module of the page.

documents.py ROOT     exit 1 naming each document and each missing thing that it names

A text in backquotes is the name of a file if it begins with a folder of ROOT or has the suffix of a source. `job/run.c`
may stand for src/server/job/run.c; stars and braces have their meaning in a shell. Files made by a build or a
benchmark, in build/ and with a DATE, need not exist.
"""

import os
import pathlib
import re
import sys
import tempfile

LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
QUOTED = re.compile(r"`([^`\s]+)`")
SOURCE = re.compile(r"\.(c|h|comp|glsl|py|md|svg)$")
CODE = re.compile(r"^```.*?^```", re.M | re.S)


def braces(name):
    """Expands a{b,c} as a shell does: ab, ac."""
    found = re.search(r"\{([^{}]*)\}", name)
    if not found:
        return [name]
    return [each for part in found[1].split(",") for each in braces(name[: found.start()] + part + name[found.end() :])]


def anchors(text):
    """The anchors of a document's headings, as links use them."""
    return {
        re.sub(r"[^\w\- ]", "", line.lstrip("#").strip().lower()).replace(" ", "-")
        for line in text.splitlines()
        if line.startswith("#")
    }


def tree(root):
    """Every file and folder of ROOT that people write, as a path relative to ROOT."""
    for folder, folders, names in os.walk(root):
        if "build.ninja" in names or "pyvenv.cfg" in names:
            folders.clear()
            continue
        folders[:] = [name for name in folders if name == ".ci" or not name.startswith((".", "__", "build", "venv"))]
        yield from ((pathlib.Path(folder) / name).relative_to(root).as_posix() for name in (*folders, *names))


def named(name, paths, tops):
    """Two values: true if a quoted text is the name of a file or folder; and true if this file or folder exists."""
    if not re.fullmatch(r"[\w.*{},/-]+", name) or name.startswith("build/") or "DATE" in name or name.startswith("."):
        return True
    for each in braces(name):
        if not (each.split("/")[0] in tops and "/" in each or SOURCE.search(each)):
            continue
        pattern = re.compile("(^|/)" + re.escape(each.rstrip("/")).replace(r"\*", "[^/]*") + "$")
        if not any(pattern.search(path) for path in paths):
            return False
    return True


def wrong(root):
    """Sentences, one for each name of a file that does not exist."""
    paths = list(tree(root))
    tops = {path for path in paths if "/" not in path}
    for document in [
        path
        for path in paths
        if path.endswith(".md") and not path.startswith(("bench/results/", "clients/web/vendor/"))
    ]:
        text = CODE.sub("", (root / document).read_text(encoding="utf-8"))
        for link in LINK.findall(text):
            target, _, anchor = link.partition("#")
            if ":" in target:
                continue
            place = (root / document).parent / target if target else root / document
            if not place.exists():
                yield f"{document}: there is no {link}"
            elif anchor and anchor not in anchors(place.read_text(encoding="utf-8")):
                yield f"{document}: there is no such heading: {link}"
        for name in QUOTED.findall(text):
            if not named(name, paths, tops):
                yield f"{document}: there is no file {name}"


def untold(root):
    """Modules of the page that docs/web.md does not name."""
    folder, document = root / "clients/web", root / "docs/web.md"
    told = set(re.findall(r"[\w-]+\.js", document.read_text(encoding="utf-8"))) if document.exists() else set()
    yield from (
        f"docs/web.md does not name {module.relative_to(root)}"
        for module in sorted(folder.rglob("*.js"))
        if module.name not in told and "vendor" not in module.parts
    )


def self_test():
    """Each kind of wrong name is found, and a right one is not reported."""
    files = {
        "src/job/run.c": "",
        "docs/right.md": "# A b\n[x](wrong.md#c-1) [y](#a-b) `src/job` `job/run.c` `run.{c,c}` `src/*/run.c` `a/b` `GET /v1` [z](https://a.b/c.md)\n```\n`no.c`\n```\n",
        "docs/wrong.md": "# C: 1\n[x](none.md)\n[y](right.md#c-1)\n`src/none` `none.c` `run.{c,h}`\n",
    }
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            (pathlib.Path(folder) / name).parent.mkdir(parents=True, exist_ok=True)
            (pathlib.Path(folder) / name).write_text(text)
        found = list(wrong(pathlib.Path(folder)))
        for name, text in (("clients/web/a.js", ""), ("clients/web/x/b-c.js", ""), ("docs/web.md", "| a.js | a |")):
            (pathlib.Path(folder) / name).parent.mkdir(parents=True, exist_ok=True)
            (pathlib.Path(folder) / name).write_text(text)
        missed = list(untold(pathlib.Path(folder)))
    if (
        len(found) != 5
        or not all(line.startswith("docs/wrong.md") for line in found)
        or missed != ["docs/web.md does not name clients/web/x/b-c.js"]
    ):
        print("its own example is judged wrongly:", *found, sep="\n  ")
        return True
    return False


def main():
    if self_test():
        return True
    root = pathlib.Path(sys.argv[1])
    found = [*wrong(root), *untold(root)]
    for line in found:
        print(line)
    return bool(found) or not (root / "docs").is_dir()


if __name__ == "__main__":
    sys.exit(main())
