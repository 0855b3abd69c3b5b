"""Files as C arrays: embed.py OUTPUT FILE... A file index.html is served as "/", others by their name."""
import pathlib
import sys

output, files = pathlib.Path(sys.argv[1]), [pathlib.Path(f) for f in sys.argv[2:]]
lines = ['#include "server/assets.h"', '']
rows = []
for i, file in enumerate(files):
    data = file.read_bytes()
    path = '/' if file.name == 'index.html' else '/' + file.name
    lines.append(f'static const unsigned char file_{i}[] = {{')
    lines += ['    ' + ','.join(str(b) for b in data[k:k + 32]) + ',' for k in range(0, len(data), 32)]
    lines += ['};', '']
    rows.append(f'    {{ "{path}", file_{i}, sizeof file_{i} }},')
lines += ['const struct kd_asset kd_assets[] = {', *rows, '};',
          'const size_t kd_n_assets = sizeof kd_assets / sizeof *kd_assets;']
output.write_text('\n'.join(lines) + '\n')
