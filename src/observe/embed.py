"""Write observations as C arrays: embed.py OUTPUT FILE...

An observation is named by its file, without the extension.
"""

import pathlib
import sys

output, *files = map(pathlib.Path, sys.argv[1:])
lines = ['#include "observe/embedded.h"', ""]
rows = []
for i, file in enumerate(files):
    data = file.read_bytes()
    lines.append(f"static const unsigned char file_{i}[] = {{")
    lines += [",".join(map(str, data[at : at + 32])) + "," for at in range(0, len(data), 32)]
    lines.append("};")
    rows.append(f'    {{ "{file.stem}", file_{i}, sizeof file_{i} }},')
lines += ["const struct kd_embedded_observation kd_embedded_observations[] = {", *rows, "    { 0 },", "};", ""]
output.write_text("\n".join(lines))
