"""Dumps of iharm3d, and of KHARMA converted to its format, in the coordinates MKS and FMKS.

Names and order of the fields are those that core/io.c of iharm3d (AFD-Illinois/iharm3d) writes and model/iharm/model.c
of ipole (AFD-Illinois/ipole) reads: /prims has the shape (n1, n2, n3, n_prim) with RHO, UU, U1, U2, U3, B1, B2, B3,
then entropies KEL and KTOT. Coordinates: MKS as in C. F. Gammie et al. 2003 (ApJ 589, 444), FMKS as in G. N. Wong et
al. 2022 (ApJS 259, 64)."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .dump import Dump, Row, check_count, rows_within
from .file import SIDE_MOST, DumpFile

Numbers = NDArray[np.float64]
FIELDS = ("RHO", "UU", "U1", "U2", "U3", "B1", "B2", "B3")
METRICS = ("MKS", "MMKS", "FMKS")
PRIMS_MOST = 64
R_LEAST, R_MOST = 0.1, 1e6  # as in src/render/emit/matter_grid.c
BLOCK = 1 << 22  # number of values to read at once; whole rows are read, at least one
ROW_MOST = 1 << 25  # largest number of values in a row
GEOMETRY = "header/geom/"


@dataclass(frozen=True)
class Coordinates:
    """theta as a function of X1 and X2, and its derivatives by X1 and X2; r = exp(X1). turn: factor of X2 in the
    formula."""

    slope: float
    start: float = 0.0
    smooth: float = 0.0
    xt: float = 1.0
    alpha: float = 0.0
    derefined: bool = False
    turn: float = 1.0

    def theta(self, x1: float, x2: Numbers) -> tuple[Numbers, Numbers, Numbers]:
        x2 = self.turn * x2
        usual = np.pi * x2 + 0.5 * (1 - self.slope) * np.sin(2 * np.pi * x2)
        by2 = np.pi + (1 - self.slope) * np.pi * np.cos(2 * np.pi * x2)
        if not self.derefined:
            return usual, np.zeros_like(x2), self.turn * by2
        y = 2 * x2 - 1
        norm = 0.5 * np.pi / (1 + 1 / ((self.alpha + 1) * self.xt**self.alpha))
        power = np.abs(y / self.xt) ** self.alpha
        other = norm * y * (1 + power / (self.alpha + 1)) + 0.5 * np.pi
        share = math.exp(self.smooth * (self.start - x1))
        return (
            usual + share * (other - usual),
            -self.smooth * share * (other - usual),
            self.turn * (by2 + share * (2 * norm * (1 + power) - by2)),
        )


def embed(row: Row, coordinates: Coordinates, x1: float, x2: Numbers) -> Row:
    """The row with vectors converted to components along r, theta and phi: dx^i/dX^j times the components along X1, X2
    and X3."""
    _, by1, by2 = coordinates.theta(x1, x2)
    for kind in ("U", "B"):
        first, second = row[kind + "1"], row[kind + "2"]
        row[kind + "2"] = by1[:, None] * first + by2[:, None] * second
        row[kind + "1"] = math.exp(x1) * first
    return row


def _coordinates(file: DumpFile, metric: str) -> tuple[Coordinates, float]:
    """The coordinates, and the spin of the hole."""
    names = ("mks",) if metric == "MKS" else ("mmks", "fmks")
    group = next((f"{GEOMETRY}{name}/" for name in names if f"{GEOMETRY}{name}" in file), f"{GEOMETRY}{names[0]}/")
    spin, slope = file.number(group + "a", -1, 1), file.number(group + "hslope", 0, 2)
    if metric == "MKS":
        return Coordinates(slope), spin
    return (
        Coordinates(
            slope,
            file.number(GEOMETRY + "startx1", -10, 20),
            file.number(group + "mks_smooth", 0, 100),
            file.number(group + "poly_xt", 0.01, 100),
            file.number(group + "poly_alpha", 0, 100),
            True,
        ),
        spin,
    )


def _centres(file: DumpFile, axis: int, n: int, first: tuple[float, float], step: tuple[float, float]) -> Numbers:
    start, width = file.number(f"{GEOMETRY}startx{axis}", *first), file.number(f"{GEOMETRY}dx{axis}", *step)
    return np.asarray(start + (np.arange(n) + 0.5) * width, np.float64)


def _reader(
    file: DumpFile, columns: dict[str, int], shape: tuple[int, ...], coordinates: Coordinates, x1: Numbers, x2: Numbers
) -> Callable[[int], Row]:
    prims = file.array("prims", shape)
    rows = max(1, BLOCK // math.prod(shape[1:]))
    block: dict[int, Numbers] = {}  # the rows read last, and the index of the first of them

    def row(i: int) -> Row:
        first = i - i % rows
        if first not in block:
            block.clear()
            block[first] = file.part("prims", prims, slice(first, first + rows))
        values = block[first][i - first]
        found = embed({name: values[..., at] for name, at in columns.items()}, coordinates, x1[i], x2)
        return {"rho": found.pop("RHO"), "u": found.pop("UU"), **found}

    return row


def read(file: DumpFile, outer: float | None = None) -> Dump:
    """The dump of an open file. A row is read when it is requested."""
    metric = file.text("header/metric")
    if metric not in METRICS:
        raise file.must("header/metric", f'"{metric[:40]}"', "MKS, MMKS or FMKS")
    n1, n2, n3 = (file.whole(f"header/n{axis}", low, SIDE_MOST) for axis, low in ((1, 2), (2, 3), (3, 1)))
    check_count(file, "header/n1 n2 n3", (n1, n2, n3))
    count = file.whole("header/n_prim", len(FIELDS), PRIMS_MOST)
    if n2 * n3 * count > ROW_MOST:
        raise file.must("header/n2 n3 n_prim", f"{n2} x {n3} x {count} numbers", f"at most {ROW_MOST} in a row")
    names = list(FIELDS)
    if "header/prim_names" in file:
        names = file.texts("header/prim_names", PRIMS_MOST)
        if names[: len(FIELDS)] != list(FIELDS) or len(names) < min(count, len(FIELDS)):
            raise file.must("header/prim_names", ", ".join(names)[:80], ", ".join(FIELDS) + " and others after them")
    coordinates, spin = _coordinates(file, metric)
    x1 = _centres(file, 1, n1, (-10, 20), (1e-6, 10))
    x2 = _centres(file, 2, n2, (0, 0.5), (1e-6, 1))
    if x1[0] < math.log(R_LEAST) or x1[-1] > math.log(R_MOST):
        raise file.must(
            GEOMETRY + "startx1 and dx1", f"{x1[0]:.6g} to {x1[-1]:.6g}", f"log r with r from {R_LEAST:g} to {R_MOST:g}"
        )
    columns = {name: at for at, name in enumerate(names[:count])}
    keep = rows_within(file, np.exp(x1), outer)
    theta = np.array([coordinates.theta(x, x2)[0] for x in x1[:keep]])
    entropies = tuple(name for name in names[len(FIELDS) : count] if name.startswith("KEL"))
    return Dump(
        file=file.path,
        code="iharm3d",
        spin=spin,
        gamma=file.number("header/gam", 1.0001, 3),
        time=file.number("t"),
        r=np.exp(x1[:keep]),
        theta=theta[0] if metric == "MKS" else theta,
        phi=None if n3 == 1 else _centres(file, 3, n3, (-10, 10), (1e-6, 7)),
        row=_reader(file, columns, (n1, n2, n3, count), coordinates, x1, x2),
        electrons=entropies,
        gamma_e=file.number("header/gam_e", 1.0001, 3) if "header/gam_e" in file else None,
        gamma_p=file.number("header/gam_p", 1.0001, 3) if "header/gam_p" in file else None,
        notes=(f"{n1 - keep} rows beyond r = {outer:g} are left out",) if keep < n1 else (),
    )
