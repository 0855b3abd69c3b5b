"""Tests that yt reads from the .athdf files of dumps.py the same fields that were written, and that kerrd.matter reads.
This excludes that writer and reader share an error. yt is in a virtual environment of its own.

yt_reads.py FOLDER
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

FOLDER = pathlib.Path(sys.argv[1])
PYTHON = pathlib.Path(__file__).resolve().parents[2] / "venv-yt/bin/python"
READER = r"""
import json, sys
sys.path[:0] = [sys.argv[2], sys.argv[3]]
import numpy as np
import yt
yt.set_log_level("error")
import dumps, kerrd

path, fine, a = sys.argv[1], json.loads(sys.argv[4]), 0.6

def flow(r, theta, phi):
    g = dumps.metric(a, r, theta)
    h = g[0, 1]
    still = np.stack([np.ones_like(r), -h / (1 + h), 0 * r, 0 * r]) * np.sqrt(1 + h)
    push = np.stack([0 * r, 0.1 * np.sin(theta) + 0 * r, 0.02 * np.cos(phi) / r, 0.05 * np.sin(theta + phi) / r])
    product = lambda v, w: np.einsum("a...,ab...,b...->...", v, g, w)
    u = still * np.sqrt(1 + product(push, push)) + push
    b = np.stack([0 * r, np.cos(theta) / r, -np.sin(theta) / r**2, 0.1 * np.cos(phi) / r**2])
    return 1 / r + np.sin(theta) * (2 + np.cos(phi)), np.sin(theta) / r**2, u, b + u * product(u, b)

dumps.write_athdf(path, (16, 12, 8), flow, a=a, fine=[tuple(x) for x in fine], single=False)
ds, off, zones = yt.load(path), {}, 0
for block in ds.index.grids:
    faces = [np.concatenate([[float(e)], float(e) + np.cumsum(np.asarray(w, float))])
             for e, w in zip(block.LeftEdge, block.cell_widths)]
    r, theta, phi = np.meshgrid(*(0.5 * (f[1:] + f[:-1]) for f in faces), indexing="ij")
    rho, energy, u, b = flow(r, theta, phi)
    U, B = dumps.primitives(dumps.metric(a, r, theta), u, b)
    want = {"rho": rho, "press": (dumps.GAMMA - 1) * energy}
    want |= {f"vel{i + 1}": U[i] for i in range(3)} | {f"Bcc{i + 1}": B[i] for i in range(3)}
    zones += r.size
    for name, of in want.items():
        got = np.asarray(block["athena_pp", name], float)
        off[name] = max(off.get(name, 0), float(np.abs(got - of).max() / np.abs(of).max()))
# the finest level's nodes of kerrd.matter are yt's zones there, in the same order
found = kerrd.matter(path, spin=a, gamma=dumps.GAMMA, sigma_cut=None)
scale, same = None, 0.0
for block in ds.index.grids:
    if block.Level < ds.index.max_level:
        continue
    first = np.rint((np.asarray(block.LeftEdge, float)[1:] - 0) / [np.pi / found.arrays["density"].shape[1],
                    2 * np.pi / found.arrays["density"].shape[2]]).astype(int)
    centre = float(block.LeftEdge[0]) + 0.5 * float(block.cell_widths[0][0])
    i = int(np.argmin(np.abs(found.r - centre)))
    rho = np.asarray(block["athena_pp", "rho"], float)
    n = rho.shape
    part = found.arrays["density"][i : i + n[0], first[0] : first[0] + n[1], first[1] : first[1] + n[2]]
    scale = scale or float(part[0, 0, 0] / rho[0, 0, 0])
    same = max(same, float(np.abs(part / scale - rho).max() / rho.max()))
print(json.dumps({"off": off, "zones": zones, "same": same}))
"""

if not PYTHON.exists():
    print("left out: there is no venv-yt/; scripts/setup --yt makes it")
    sys.exit(77)


class Yt(unittest.TestCase):
    def read(self, fine):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run(
                [PYTHON, "-I", "-c", READER, folder + "/a.athdf", FOLDER / "src", pathlib.Path(__file__).parent, fine],
                capture_output=True,
                text=True,
                timeout=280,
            )
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout.splitlines()[-1])
        self.assertEqual(len(found["off"]), 8)
        for name, off in found["off"].items():
            self.assertLess(off, 1e-12, name)
        self.assertLess(found["same"], 1e-6)
        return found["zones"]

    def test_blocks(self):
        self.assertEqual(self.read("[]"), 16 * 12 * 8)

    def test_refined_blocks(self):
        self.assertEqual(self.read("[[0, 1, 0]]"), 16 * 12 * 8 * (1 + 7 / 8))


if __name__ == "__main__":
    sys.argv = sys.argv[:1] + sys.argv[2:]
    unittest.main(verbosity=2)
