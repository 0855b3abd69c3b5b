"""Files as C arrays, as they are and as gzip: embed.py OUTPUT FILE..., named as seen from the first one's folder"""
import gzip
import hashlib
import pathlib
import sys

TYPES = {'.html': 'text/html; charset=utf-8', '.js': 'text/javascript; charset=utf-8',
         '.css': 'text/css; charset=utf-8', '.svg': 'image/svg+xml', '': 'text/plain; charset=utf-8'}
output, files = pathlib.Path(sys.argv[1]), [pathlib.Path(f) for f in sys.argv[2:]]
lines = ['#include "server/http/served.h"', '']
rows = []


def form(name, data):
    lines.append(f'static const unsigned char {name}[] = {{')
    lines.extend('    ' + ','.join(str(b) for b in data[k:k + 32]) + ',' for k in range(0, len(data), 32))
    lines.extend(['};', ''])
    return f'{{ "\\"{hashlib.sha256(data).hexdigest()[:32]}\\"", {name}, sizeof {name} }}'


for i, file in enumerate(files):
    data = file.read_bytes()
    rows.append(f'    {{ "{file.relative_to(files[0].parent).as_posix()}", "{TYPES[file.suffix]}", {form(f"plain_{i}", data)},\n'
                f'      {form(f"gzip_{i}", gzip.compress(data, 9, mtime=0))} }},')
lines += ['const struct kd_served kd_page_files[] = {', *rows, '};',
          'const size_t kd_n_page_files = sizeof kd_page_files / sizeof *kd_page_files;']
output.write_text('\n'.join(lines) + '\n')
