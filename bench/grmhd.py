#!/usr/bin/env python3
"""Compares the torus read from dumps of iharm3d (MKS, FMKS) and Athena++ with the analytic torus, and measures rays a
second through grids.

    venv/bin/python bench/grmhd.py                         some minutes; needs numpy and h5py
    venv/bin/python bench/grmhd.py --nodes 96 48 8 --pixels 48 --rates 96x48x8

The error of each of I, Q, U and V is the sum of squared differences divided by the sum of squares. Rates are for
unpolarised rays on one thread: the difference of two pictures' numbers of rays, divided by the difference of their
processor times. Writes bench/results/DATE-DEVICE-grmhd.{json,md}. Exits with 1 if an error is above 1e-3 in I, or 5e-3
in Q, U or V.
"""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import measure

sys.path[:0] = [str(measure.ROOT / "clients/python/src"), str(measure.ROOT / "tests/python")]
import dumps
import kerrd
import numpy as np
from radio import render

LIGHT = ("intensity", "stokes_q", "stokes_u", "stokes_v")
BOUNDS = (1e-3, 5e-3, 5e-3, 5e-3)
GRID = ["--set", "volume.model=grid", "--set", "volume.grid=g"]
TORUS = {"r_low": 1, "r_high": 1, "gamma_e": dumps.GAMMA, "gamma_p": dumps.GAMMA, "rho_floor": 2 * dumps.FLOOR}


def write(kind, path, nodes):
    if kind == "athdf":
        dumps.write_athdf(path, nodes, dumps.torus_flow)
        return {"spin": dumps.SPIN, "gamma": dumps.GAMMA}
    dumps.write_iharm(path, kind, nodes, dumps.torus_flow)
    return {}


def convert(kind, folder, nodes, mass):
    """Writes a dump and converts it. Returns the grid's path and the seconds that kerrd.matter and save took."""
    dump, grid = str(folder / "dump"), str(folder / f"{kind}.npz")
    more = write(kind, dump, nodes)
    start = time.monotonic()
    kerrd.matter(dump, mass_msun=mass, m_unit=dumps.mass_unit(mass), **TORUS, **more).save(grid)
    return grid, time.monotonic() - start


def repeated(folder, nodes, mass):
    """Writes a grid of many nodes without a dump of that size, by repeating one layer of the torus in FMKS coordinates."""
    rows, columns, layers = nodes
    grid, _ = convert("fmks", folder, (rows, columns, 1), mass)
    with np.load(grid) as file:
        arrays = {name: of if of.ndim < 2 or name == "theta" else of[..., None] for name, of in file.items()}
    phi = np.arange(layers) * 2 * np.pi / layers
    shape = (rows, columns, layers)
    arrays = {name: np.broadcast_to(of, shape) if of.ndim == 3 else of for name, of in arrays.items()}
    np.savez(grid, **arrays, phi=phi)
    return grid


def light(program, folder, pixels, *more):
    out = str(folder / "light.npz")
    command = [program, "render", "-p", "torus", "--size", f"{pixels}x{pixels}", "--set", "image.critical_factor=1"]
    command += ["--set", "polarization.model=transfer", "--set", "image.layers=" + ",".join(LIGHT), "-o", out, *more]
    subprocess.run(command, check=True)
    with np.load(out) as file:
        return [file[name].astype(float) for name in LIGHT]


def rate(program, grid, sizes, core, rounds):
    """Rays per second and core, from the least processor times of two pictures of different sizes."""
    arguments = ["-p", "torus", "--asset", "g=" + grid, *GRID]
    least = {}
    for n in range(rounds + 1):  # the first picture fills the driver's cache of kernels
        for size in sizes:
            seconds, told = render(program, arguments, size, core)
            if n:
                least[size] = min(seconds, least.get(size, seconds))
    small, large = sizes
    return (large**2 - small**2) / (least[large] - least[small]), told


def main():
    p = measure.parser(__doc__)
    p.add_argument("--nodes", type=int, nargs=3, default=[192, 96, 96], help="nodes of the compared dumps")
    p.add_argument("--pixels", type=int, default=96, help="pixels along a side of the compared pictures (96)")
    p.add_argument(
        "--rates", nargs="*", default=["192x96x96", "256x256x128"], help="nodes of the grids for rays a second"
    )
    p.add_argument("--sizes", type=int, nargs=2, default=[64, 160], help="pixels along a side of the timed pictures")
    p.add_argument("--rounds", type=int, default=2, help="timed runs of each picture (2)")
    o = p.parse_args()
    program, load = measure.binary(o.build, "src/kerrd"), os.getloadavg()[0]
    mass = json.loads(subprocess.check_output([program, "scene", "-p", "torus"]))["spacetime"]["mass_msun"]
    errors, rates, worst = {}, {}, 0.0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        want = light(program, folder, o.pixels)
        for kind in ("mks", "fmks", "athdf"):
            grid, seconds = convert(kind, folder, tuple(o.nodes), mass)
            got = light(program, folder, o.pixels, "--asset", "g=" + grid, *GRID)
            off = [float(((g - w) ** 2).sum() / (w**2).sum()) for g, w in zip(got, want)]
            errors[kind] = {"nmse": dict(zip(LIGHT, off)), "seconds": seconds}
            worst = max(worst, *(x / bound for x, bound in zip(off, BOUNDS)))
        for nodes in o.rates:
            grid = repeated(folder, tuple(map(int, nodes.split("x"))), mass)
            rates[nodes], _ = rate(program, grid, o.sizes, o.core, o.rounds)
    doctor = subprocess.run([program, "doctor"], capture_output=True, text=True).stdout
    found = re.search(r"llvmpipe[^\n]*", doctor)
    h = measure.head(found[0] if found else "device", load)
    text = measure.head_markdown("The torus as dumps of simulations", h)
    text += f"{o.nodes[0]} × {o.nodes[1]} × {o.nodes[2]} nodes, pictures of {o.pixels} × {o.pixels} pixels.\n\n"
    rows = [
        [kind, *(f"{of['nmse'][name]:.1e}" for name in LIGHT), f"{of['seconds']:.1f}"] for kind, of in errors.items()
    ]
    text += measure.table(["dump", "I", "Q", "U", "V", "seconds of conversion"], rows) + "\n"
    text += measure.table(["nodes, FMKS", "k rays/s and core"], [[n, f"{x / 1e3:.1f}"] for n, x in rates.items()])
    measure.save(o.out, "grmhd", h, {"errors": errors, "rays_per_s_core": rates}, text)
    return int(worst > 1)


if __name__ == "__main__":
    sys.exit(main())
