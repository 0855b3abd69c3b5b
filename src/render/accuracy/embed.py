"""Write a file as C bytes: embed.py OUTPUT FILE NAME gives `const unsigned char NAME[]`, `const size_t NAME_size`."""

import pathlib
import sys

output, file, name = sys.argv[1:]
data = pathlib.Path(file).read_bytes()
rows = ["    " + ",".join(map(str, (data + b"\0")[k : k + 32])) + "," for k in range(0, len(data) + 1, 32)]
pathlib.Path(output).write_text(
    "\n".join(
        [
            "#include <stddef.h>",
            "",
            f"extern const unsigned char {name}[];",
            f"extern const size_t {name}_size;",
            f"const unsigned char {name}[] = {{",
            *rows,
            "};",
            f"const size_t {name}_size = {len(data)};",
        ]
    )
    + "\n"
)
