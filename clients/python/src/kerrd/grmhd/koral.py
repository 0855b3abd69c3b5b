"""Files of KORAL for analysis (ana*.h5), as fprint_anaout_hdf5 of its fileop.c writes them (achael/koral_lite):
density, pressure, u^mu and b^mu in code units, in Kerr-Schild or Boyer-Lindquist coordinates, and r, theta and phi of
each zone."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .dump import Dump, Row, check_count, rows_within
from .file import SIDE_MOST, DumpFile

Numbers = NDArray[np.float64]
METRIC = "header/metric_out"
FIELDS = ("rho", "pgas", "u0", "u1", "u2", "u3", "b0", "b1", "b2", "b3")
KELVIN = "te"
EVEN = 1e-3  # tolerance for geometric radii and even azimuths, as a fraction of a step


def _even(file: DumpFile, name: str, values: Numbers, must: str) -> None:
    wanted = np.linspace(values[0], values[-1], len(values))
    worst = int(np.argmax(np.abs(values - wanted)))
    if not abs(values[worst] - wanted[worst]) <= EVEN * (wanted[-1] - wanted[0]) / (len(values) - 1):
        raise file.must(name, f"{values[worst]:.7g} at zone {worst}", f"{wanted[worst]:.7g}: {must}")


def _coordinates(file: DumpFile, shape: tuple[int, int, int]) -> tuple[Numbers, Numbers, Numbers | None]:
    """Returns r of the rows, theta of shape (rows, columns), and phi of the layers."""
    arrays = {name: file.array("grid_out/" + name, shape) for name in ("r", "th", "ph")}

    def read(name: str, at: Any) -> Numbers:
        return file.part("grid_out/" + name, arrays[name], at)

    r, theta = read("r", (slice(None), 0, 0)), read("th", (slice(None), slice(None), 0))
    if not (np.isfinite(r).all() and (r > 0).all() and (np.diff(r) > 0).all()):
        raise file.problem("grid_out/r", "is not in ascending order; it must be above 0 and grow from row to row")
    if not np.allclose(read("r", (slice(None), -1, -1)), r, rtol=1e-9):
        raise file.problem("grid_out/r", "differs between columns; it must be the same in a row")
    if not (
        np.isfinite(theta).all() and (np.diff(theta, axis=1) > 0).all() and (0 < theta).all() and (theta < np.pi).all()
    ):
        raise file.problem("grid_out/th", "is not in ascending order; it must grow from 0 to pi in each row")
    if not np.allclose(read("th", (slice(None), slice(None), -1)), theta, rtol=0, atol=1e-9):
        raise file.problem("grid_out/th", "differs between layers; it must be the same for all phi")
    _even(file, "grid_out/r", np.log(r), "radii must grow by one ratio (log r is shown), with mksr0 = 0")
    if shape[2] == 1:
        return r, theta, None
    phi = read("ph", (0, 0, slice(None)))
    _even(file, "grid_out/ph", phi, "azimuths must be evenly spaced")
    turn = (phi[-1] - phi[0]) * shape[2] / (shape[2] - 1)
    if abs(turn - 2 * math.pi) > 1e-3:
        raise file.problem("grid_out/ph", f"spans {turn:.6g}; it must span 2 pi, the whole turn")
    return r, theta, phi


def _schild(a: float, r: float, v: list[Numbers]) -> list[Numbers]:
    """Converts contravariant Boyer-Lindquist components to ingoing Kerr-Schild coordinates."""
    delta = r * r - 2 * r + a * a
    return [v[0] + 2 * r / delta * v[1], v[1], v[2], v[3] + a / delta * v[1]]


def read(file: DumpFile, outer: float | None = None) -> Dump:
    """The dump of an open file. A row is read when it is requested."""
    metric = file.text(METRIC)
    if metric not in ("KS", "BL"):
        raise file.must(METRIC, f'"{metric[:40]}"', "KS or BL")
    shape = tuple(file.whole(f"header/n{axis}", low, SIDE_MOST) for axis, low in ((1, 2), (2, 3), (3, 1)))
    n1, n2, n3 = shape
    check_count(file, "header/n1 n2 n3", (n1, n2, n3))
    spin, gamma = file.number("header/bhspin", -1, 1), file.number("header/gam", 1.0001, 3)
    r, theta, phi = _coordinates(file, (n1, n2, n3))
    keep = rows_within(file, r, outer)
    kelvin = (KELVIN,) if "quants/" + KELVIN in file else ()
    arrays = {name: file.array("quants/" + name, (n1, n2, n3)) for name in (*FIELDS, *kelvin)}

    def row(i: int) -> Row:
        of = {name: file.part("quants/" + name, array, i) for name, array in arrays.items()}
        u, b = ([of[f"{kind}{k}"] for k in range(4)] for kind in "ub")
        if metric == "BL":
            u, b = _schild(spin, float(r[i]), u), _schild(spin, float(r[i]), b)
        h = 2 * r[i] / (r[i] ** 2 + (spin * np.cos(theta[i][:, None])) ** 2)
        return {
            "rho": of["rho"],
            "u": of["pgas"] / (gamma - 1),
            "U1": u[1] + u[0] * h / (1 + h),  # g^tr/g^tt = -h/(1 + h)
            "U2": u[2],
            "U3": u[3],
            **{f"B{k}": b[k] * u[0] - b[0] * u[k] for k in (1, 2, 3)},
            **{name: of[name] for name in kelvin},
        }

    notes = [f"{n1 - keep} rows beyond r = {outer:g} are left out"] if keep < n1 else []
    units = "header/units/"
    if all(units + name in file for name in ("M_bh", "L_unit", "M_unit")):
        density, length = (file.number(units + name, 1e-100, 1e100) for name in ("M_unit", "L_unit"))
        mass = file.number(units + "M_bh", 1e-300, 1e300)
        notes.append(f"the file's own units are mass_msun={mass:.6g} and m_unit={density * length**3:.6g}")
    return Dump(
        file=file.path,
        code="koral",
        spin=spin,
        gamma=gamma,
        time=file.number("t"),
        r=r[:keep],
        theta=theta[:keep],
        phi=phi,
        row=row,
        kelvin=kelvin,
        notes=tuple(notes),
    )
