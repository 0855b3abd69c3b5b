"""Write files as C arrays: embed.py MINIFIER OUTPUT FILE...

Each file is written as it is, and also compressed by gzip unless it is a picture or a film. Files below the folder of
the first file are named by their paths from that folder. Other files are named by their folder and name. MINIFIER is
the program esbuild, which minifies scripts and styles. If MINIFIER is "", scripts and styles are not minified.
"""

import gzip
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile

TYPES = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".mjs": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".json": "application/json; charset=utf-8",
    ".svg": "image/svg+xml",
    ".jpg": "image/jpeg",
    ".webm": "video/webm",
    "": "text/plain; charset=utf-8",
}
minifier, output = sys.argv[1], pathlib.Path(sys.argv[2])
files = [pathlib.Path(os.path.normpath(file)) for file in sys.argv[3:]]
folder = files[0].parent
lines = ['#include "server/http/served.h"', ""]
rows = []


def shortened(names):
    """Minify these files. Each stays a module of its own and keeps its name, so that a fault can be traced to its file.

    Return a dictionary from name to bytes.
    """
    with tempfile.TemporaryDirectory() as out:
        told = subprocess.run(
            [
                minifier,
                *names,
                "--minify",
                "--charset=utf8",
                "--log-level=warning",
                f"--outdir={out}",
                f"--outbase={folder}",
            ],
            capture_output=True,
            text=True,
        )
        if told.returncode or told.stderr:
            sys.exit(f"{minifier}: {told.stderr}")
        return {name: (pathlib.Path(out) / name.relative_to(folder)).read_bytes() for name in names}


def form(name, data):
    lines.append(f"static const unsigned char {name}[] = {{")
    lines.extend("    " + ",".join(str(b) for b in data[k : k + 32]) + "," for k in range(0, len(data), 32))
    lines.extend(["};", ""])
    return f'{{ "\\"{hashlib.sha256(data).hexdigest()}\\"", {name}, sizeof {name} }}'


short = shortened([f for f in files if f.suffix in (".js", ".css") and "vendor" not in f.parts]) if minifier else {}
for i, file in enumerate(files):
    data = short.get(file) or file.read_bytes()
    if file.suffix == ".json":
        data = json.dumps(json.loads(data), ensure_ascii=False, separators=(",", ":")).encode()
    packed = "{ 0 }" if file.suffix in (".jpg", ".webm") else form(f"gzip_{i}", gzip.compress(data, 9, mtime=0))
    inside = folder in file.parents
    name = file.relative_to(folder).as_posix() if inside else f"{file.parent.name}/{file.name}"
    rows.append(f'    {{ "{name}", "{TYPES[file.suffix]}", {form(f"plain_{i}", data)},\n      {packed} }},')
lines += [
    "const struct kd_served kd_page_files[] = {",
    *rows,
    "};",
    "const size_t kd_n_page_files = sizeof kd_page_files / sizeof *kd_page_files;",
]
output.write_text("\n".join(lines) + "\n")
