"""Matter on a grid: the file that the scene's volume.grid names (docs/physics/volume.md)."""

from __future__ import annotations

import io
import json
import os
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .dump import Dump
from .file import DumpProblem
from .kerr_schild import flow
from .plasma import ELECTRON, PEAK, PROTON, Plasma, field_unit

UNITS = {
    "r": "M",
    "theta": "rad",
    "density": "cm^-3",
    "temperature": "K",
    "u_con_r": "c",
    "u_con_theta": "c/M",
    "u_cov_phi": "c M",
    "b_con_r": "G",
    "b_con_theta": "G/M",
    "b_cov_phi": "G M",
}
ARRAYS = tuple(UNITS)[2:]
KIND = "application/x-npz"


@dataclass(frozen=True)
class Matter:
    """A grid of matter. spin: the hole's spin, which the scene's spacetime.spin must equal. r, theta, phi: of the
    nodes. arrays: each of the shape (rows, columns) or (rows, columns, layers). notes: what was chosen, cut and left
    out."""

    spin: float
    r: NDArray[np.float64]
    theta: NDArray[np.float64]
    phi: NDArray[np.float64] | None
    arrays: dict[str, NDArray[np.float32]] = field(repr=False)
    notes: tuple[str, ...] = ()

    @staticmethod
    def of(dump: Dump, plasma: Plasma) -> Matter:
        """The matter of a dump."""
        if plasma.electrons != "ratio" and plasma.electrons not in dump.electrons:
            names = " or ".join(f'"{name}"' for name in ("ratio", *dump.electrons))
            raise ValueError(f'electrons is "{plasma.electrons}"; it must be {names} for {dump.file}')
        arrays = {name: np.empty(dump.shape, np.float32) for name in ARRAYS}
        empty = 0
        for i in range(dump.shape[0]):
            row = dump.row(i)
            _check(dump, i, row)
            theta = dump.angles(i)[:, None]
            moves = flow(
                dump.spin, dump.r[i], theta, (row["U1"], row["U2"], row["U3"]), (row["B1"], row["B2"], row["B3"])
            )
            cut = plasma.cut(row["rho"], moves.b2)
            empty += int(np.count_nonzero(cut))
            values = (np.where(cut, 0, row["rho"]), plasma.kelvin(dump, row, moves.b2), *moves.u, *moves.b)
            for name, of in zip(ARRAYS, values):
                arrays[name][i] = of
        _scale(arrays, plasma.density_unit)
        if dump.phi is None:
            arrays = {name: of[..., 0] for name, of in arrays.items()}
        notes = (*dump.notes, *plasma.said(dump))
        if empty:
            notes = (*notes, f"{empty} of {np.prod(dump.shape)} zones have no matter by this cut")
        return Matter(dump.spin, dump.r, dump.theta, dump.phi, arrays, notes)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the file that `--asset NAME=FILE` and client.put_asset take."""
        with open(path, "wb") as file:
            self._write(file)

    def to_bytes(self) -> bytes:
        """The bytes of the same file, for client.put_asset(matter.to_bytes(), "application/x-npz")."""
        file = io.BytesIO()
        self._write(file)
        return file.getvalue()

    def _write(self, file: Any) -> None:
        header = {"format": "kerrd-grid", "version": 1, "spin": self.spin, "azimuth": "kerr-schild", "units": UNITS}
        places = {"r": self.r, "theta": self.theta}
        if self.phi is not None:
            places["phi"] = self.phi
        np.savez(file, header=np.array(json.dumps(header)), **places, **self.arrays)  # type: ignore[arg-type]


def _check(dump: Dump, i: int, row: dict[str, NDArray[np.float64]]) -> None:
    """Refuses a number that is not finite, and a density or energy that is not above 0."""
    for name, values in row.items():
        bad = ~np.isfinite(values)
        must = "a finite number"
        if name in ("rho", "u"):
            bad |= ~(values > 0) if name == "rho" else ~(values >= 0)
            must = "a finite number above 0" if name == "rho" else "a finite number of at least 0"
        if bad.any():
            j, k = (int(x) for x in np.argwhere(bad)[0])
            raise DumpProblem(dump.file, f"{name}[{i}, {j}, {k}]", f"is {values[j, k]:g}; it must be {must}")


def _scale(arrays: dict[str, NDArray[np.float32]], unit: float | None) -> None:
    """From the code's units to cm^-3 and gauss."""
    if unit is None:
        most = float(arrays["density"].max())
        unit = PEAK * (PROTON + ELECTRON) / most if most > 0 else 1.0
    arrays["density"] *= np.float32(unit / (PROTON + ELECTRON))
    for name in ("b_con_r", "b_con_theta", "b_cov_phi"):
        arrays[name] *= np.float32(field_unit(unit))
