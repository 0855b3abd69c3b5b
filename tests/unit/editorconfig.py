#!/usr/bin/env python3
"""Checks that every text of the tree follows .editorconfig.

The rules are UTF-8, LF, no blanks at the ends of lines, no tabs, and one newline at the end.

editorconfig.py ROOT     exit 1 naming each file and line that does not follow them
"""

import os
import pathlib
import sys
import tempfile

SUFFIXES = {
    ".c",
    ".h",
    ".comp",
    ".glsl",
    ".py",
    ".md",
    ".js",
    ".html",
    ".css",
    ".json",
    ".ini",
    ".txt",
    ".build",
    ".supp",
    "",
}
# Files that we do not write: third-party files, results that a program wrote, and files made by git or a build.
LEFT_OUT = ("clients/web/vendor", "bench/results", "venv")


def texts(root):
    """The files of ROOT that people write. Hidden folders are left out, and those of builds, which are recognised by
    the names that git ignores or by a build.ninja."""
    for folder, folders, names in os.walk(root):
        where = pathlib.Path(folder).relative_to(root).as_posix()
        if where in LEFT_OUT or "build.ninja" in names or "pyvenv.cfg" in names:
            folders.clear()
            continue
        folders[:] = sorted(
            name
            for name in folders
            if name == ".ci" or not name.startswith((".", "__", "build", "venv-")) and not name.endswith(".egg-info")
        )
        for name in sorted(names):
            path = pathlib.Path(folder) / name
            if (
                path.suffix in SUFFIXES
                and (not name.startswith(".") or name in {".editorconfig", ".gitignore"})
                and not path.is_symlink()
            ):
                yield path


def wrong(root):
    """Sentences, one for each fault."""
    for path in texts(root):
        where = path.relative_to(root)
        data = path.read_bytes()
        try:
            data.decode()
        except UnicodeDecodeError as error:
            yield f"{where}: no UTF-8: {error}"
            continue
        if data and (not data.endswith(b"\n") or data.endswith(b"\n\n")):
            yield f"{where}: does not end with one newline"
        for number, line in enumerate(data.split(b"\n"), 1):
            if line.rstrip() != line:
                yield f"{where}:{number}: blanks or CR at the end"
            if b"\t" in line and not (
                number > 1 and line.startswith(b"\t") and data.startswith(b"#!/usr/bin/make ")
            ):  # make requires tabs
                yield f"{where}:{number}: a tab"


def self_test():
    """Each kind of fault is found, and a right text is not reported."""
    faults = {
        "a.c": b"int a; \n",
        "b.py": b"if 1:\n\tpass\n",
        "c.md": b"text",
        "d.md": b"text\n\n",
        "e.h": b"int a;\r\n",
        "f.js": b"\xff\n",
    }
    right = {
        "g.c": b"int a;\n",
        "empty.py": b"",
        "rules": b"#!/usr/bin/make -f\na:\n\ttrue\n",
        "build/h.c": b"int a; \n",
        "build/build.ninja": b"",
        ".git/i.c": b"int a; \n",
    }
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, data in {**faults, **right}.items():
            (root / name).parent.mkdir(exist_ok=True)
            (root / name).write_bytes(data)
        found = {line.split(":")[0] for line in wrong(root)}
    if found != set(faults):
        print("its own example is judged wrongly:", sorted(found ^ set(faults)))
        return True
    return False


def main():
    if self_test():
        return True
    root = pathlib.Path(sys.argv[1])
    found = list(wrong(root))
    for line in found:
        print(line)
    return bool(found) or not (root / "meson.build").exists()


if __name__ == "__main__":
    sys.exit(main())
