#!/usr/bin/env python3
"""Write the double-precision twin of a kernel, so that both have one source.

to_double.py INCLUDE_DIR INPUT OUTPUT DEPFILE

Includes are expanded; float, vec3 and vec4 become double, dvec3 and dvec4; numbers with a point or an exponent get the
suffix LF; KD_DOUBLE is defined. Kernels that are converted here use math.glsl instead of built-in transcendental
functions, which GLSL has in single precision only.
"""

import pathlib
import re
import sys

include_dir, source, output, depfile = map(pathlib.Path, sys.argv[1:])
seen = []


def expand(path):
    seen.append(path)
    lines = []
    for line in path.read_text().splitlines():
        match = re.match(r'\s*#include "(.+)"', line)
        if match:
            included = include_dir / match[1]
            lines += [] if included in seen else expand(included)
        else:
            lines.append(line)
    return lines


text = "\n".join(expand(source))


def blank(comment):
    """The line breaks of a comment. In a macro, whose line ends with a backslash, they need one each."""
    return ("\\\n" if comment[1].endswith("\\") else "\n") * comment[0].count("\n")


text = re.sub(r"/\*.*?\*/(?=([^\n]*))", blank, text, flags=re.S)
text = re.sub(r"(?<![\w.])(\d+\.\d*(?:e[+-]?\d+)?|\d+e[+-]?\d+)(?![\w.])", r"\1LF", text)
text = re.sub(r"\bfloat\b", "double", text)
text = re.sub(r"\bvec([34])\b", r"dvec\1", text)
text = re.sub(r"^(#version .*)$", r"\1\n#define KD_DOUBLE", text, count=1, flags=re.M)
output.write_text(text + "\n")
depfile.write_text(f"{output}: " + " ".join(str(path).replace(" ", r"\ ") for path in seen) + "\n")
