#!/usr/bin/env python3
"""Checks that every header compiles alone, that is, includes what it uses.

headers.py SRC COMPILER... -- FLAG...
"""

import concurrent.futures
import os
import pathlib
import subprocess
import sys


def compile_alone(header, compiler, flags):
    """The compiler's error message, or an empty text."""
    # The header is included twice, which also tests its include guard.
    text = f'#include "{header}"\n#include "{header}"\ntypedef int not_empty;\n'
    done = subprocess.run(
        [
            *compiler,
            "-x",
            "c",
            "-std=gnu11",
            "-D_GNU_SOURCE",
            "-Wall",
            "-Wextra",
            "-Werror",
            *flags,
            "-fsyntax-only",
            "-",
        ],
        input=text,
        capture_output=True,
        text=True,
        check=False,
    )
    return done.stderr if done.returncode else ""


def main():
    at = sys.argv.index("--")
    src, compiler, flags = pathlib.Path(sys.argv[1]), sys.argv[2:at], sys.argv[at + 1 :]
    headers = sorted(str(path.relative_to(src)) for path in src.rglob("*.h"))
    assert compile_alone("no/such/header.h", compiler, flags), "the compiler accepts anything"
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        complaints = list(pool.map(lambda header: compile_alone(header, compiler, flags), headers))
    for header, complaint in zip(headers, complaints):
        if complaint:
            print(f"{header} does not compile alone:\n{complaint}")
    print(f"{len(headers)} headers")
    return any(complaints) or not headers


if __name__ == "__main__":
    sys.exit(main())
