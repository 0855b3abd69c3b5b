"""A simulation's fields on its own grid of r, theta and phi, in ingoing Kerr-Schild coordinates."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from .file import NODES_MOST, DumpFile

Row = dict[str, NDArray[np.float64]]


@dataclass(frozen=True)
class Dump:
    """A dump in the form that all readers return.

    r: of each row. theta: of each column, or of each node of a layer, (rows, columns). phi: of each layer, or None if
    the dump is axisymmetric. gamma: the gas's adiabatic index. gamma_e, gamma_p: those of electrons and ions, if the
    file has them. row(i): fields of a row, of the shape (columns, layers): "rho"; "u", internal energy; "U1" to "U3",
    the velocity relative to the normal observer, u^i + alpha gamma g^ti, and "B1" to "B3", B^i = *F^it, along r, theta
    and phi; entropies of electrons, and their temperatures in K, by the names in electrons and kelvin. The field's unit
    has the factor sqrt(4 pi). notes: sentences about what was left out or changed.
    """

    file: str
    code: str
    spin: float
    gamma: float
    time: float
    r: NDArray[np.float64]
    theta: NDArray[np.float64]
    phi: NDArray[np.float64] | None
    row: Callable[[int], Row] = field(repr=False)
    electrons: tuple[str, ...] = ()
    kelvin: tuple[str, ...] = ()
    gamma_e: float | None = None
    gamma_p: float | None = None
    notes: tuple[str, ...] = ()

    @property
    def shape(self) -> tuple[int, int, int]:
        """Number of rows, columns and layers."""
        return len(self.r), self.theta.shape[-1], 1 if self.phi is None else len(self.phi)

    def angles(self, row: int) -> NDArray[np.float64]:
        """theta of the nodes of a row."""
        return self.theta if self.theta.ndim == 1 else self.theta[row]


def check_count(file: DumpFile, name: str, shape: tuple[int, int, int]) -> None:
    """Refuses more nodes than a dump may have."""
    nodes = math.prod(shape)
    if nodes > NODES_MOST:
        raise file.must(name, f"{shape[0]} x {shape[1]} x {shape[2]} zones", f"at most {NODES_MOST} in all")


def rows_within(file: DumpFile, r: NDArray[np.float64], outer: float | None) -> int:
    """Number of rows within r = outer; at least two."""
    if outer is None:
        return len(r)
    rows = int(np.count_nonzero(r <= outer))
    if rows < 2:
        raise file.must("outer", f"{outer:g}", f"at least r of the second row, {r[1]:.6g}")
    return rows
