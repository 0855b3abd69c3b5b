"""Matter on a grid: the file that the scene's volume.grid names (docs/physics/volume.md)."""

from __future__ import annotations

import io
import json
import math
import os
from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .dump import Dump
from .file import DumpProblem, printable
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
# limits of a grid, equal to those in src/render/emit/matter_grid.h
NODES_MOST, SIDE_MOST, FRAMES_MOST = 1 << 25, 4096, 1024


@dataclass(frozen=True)
class Matter:
    """A grid of matter. spin, charge: of the hole; the scene's spacetime.spin and spacetime.charge must equal them.
    r, theta, phi: coordinates of the nodes. arrays: quantities by name, each of the shape (rows, columns) or (rows,
    columns, layers). time: time of each frame of a series, whose arrays have the frames as first axis; None: the grid
    is one moment in time. notes: sentences about what was chosen, cut and left out."""

    spin: float
    r: NDArray[np.float64]
    theta: NDArray[np.float64]
    phi: NDArray[np.float64] | None
    arrays: dict[str, NDArray[np.float32]] = field(repr=False)
    notes: tuple[str, ...] = ()
    charge: float = 0.0
    time: NDArray[np.float64] | None = None

    @staticmethod
    def of(dump: Dump, plasma: Plasma) -> Matter:
        """The matter of a dump."""
        _check_electrons(dump, plasma)
        check_size(dump)
        arrays = {name: np.empty(dump.shape, np.float32) for name in ARRAYS}
        empty = _fill(arrays, dump, plasma)
        if not arrays["density"].any():
            raise _nothing(dump, plasma, empty == math.prod(dump.shape))
        return _finished(dump, plasma, arrays, empty)

    @staticmethod
    def series(dumps: Callable[[int], AbstractContextManager[Dump]], time: list[float], plasma: Plasma) -> Matter:
        """The matter of a series of dumps in the order of their times, whose nodes are the same. The caller has checked
        times and nodes. dumps: opens a dump by its number."""
        with dumps(0) as first:
            arrays = {name: np.empty((len(time), *first.shape), np.float32) for name in ARRAYS}
        empty = 0
        for i in range(len(time)):
            with dumps(i) as dump:
                _check_electrons(dump, plasma)
                empty += _fill({name: of[i] for name, of in arrays.items()}, dump, plasma)
        if not arrays["density"].any():
            raise _nothing(first, plasma, empty == arrays["density"].size)
        return replace(_finished(first, plasma, arrays, empty), time=np.array(time))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the file, which can be given to `--asset NAME=FILE` and client.put_asset."""
        with open(path, "wb") as file:
            self._write(file)

    def to_bytes(self) -> bytes:
        """The bytes of the same file, for client.put_asset(matter.to_bytes(), "application/x-npz")."""
        file = io.BytesIO()
        self._write(file)
        return file.getvalue()

    def _write(self, file: Any) -> None:
        header = {"format": "kerrd-grid", "version": 1, "spin": self.spin, "azimuth": "kerr-schild", "units": UNITS}
        if self.charge:
            header["charge"] = self.charge
        places = {"r": self.r, "theta": self.theta}
        if self.time is not None:
            header["units"] = {**UNITS, "time": "M"}
            places["time"] = self.time
        if self.phi is not None:
            places["phi"] = self.phi
        np.savez(file, header=np.array(json.dumps(header)), **places, **self.arrays)  # type: ignore[arg-type]


def _check_electrons(dump: Dump, plasma: Plasma) -> None:
    """Refuses the name of a stored entropy or temperature that is not in the dump."""
    stored = (*dump.electrons, *dump.kelvin)
    if plasma.electrons != "ratio" and plasma.electrons not in stored:
        names = " or ".join(f'"{name}"' for name in ("ratio", *stored))
        raise ValueError(printable(f'electrons is "{plasma.electrons}"; it must be {names} for {dump.file}'))


def _fill(arrays: dict[str, NDArray[np.float32]], dump: Dump, plasma: Plasma) -> int:
    """Fills the arrays, in the code's units. Returns the number of zones that a cut leaves without matter."""
    empty = 0
    with np.errstate(all="ignore"):  # _check_single finds overflows
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
    return empty


def _finished(dump: Dump, plasma: Plasma, arrays: dict[str, NDArray[np.float32]], empty: int) -> Matter:
    """The matter of the filled arrays, with the same units for all frames."""
    _scale(arrays, plasma.density_unit)
    _check_single(dump, plasma, arrays)
    if dump.phi is None:
        arrays = {name: of[..., 0] for name, of in arrays.items()}
    notes = (*dump.notes, *plasma.said(dump))
    if empty:
        notes = (*notes, f"{empty} of {arrays['density'].size} zones have no matter by this cut")
    return Matter(dump.spin, dump.r, dump.theta, dump.phi, arrays, notes)


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


def check_size(dump: Dump) -> None:
    """Refuses more nodes than a grid may have."""
    if max(dump.shape) <= SIDE_MOST and math.prod(dump.shape) <= NODES_MOST:
        return
    rows, columns, layers = dump.shape
    fewer = min(SIDE_MOST, NODES_MOST // (columns * layers))
    remedy = ""
    if max(columns, layers) <= SIDE_MOST and fewer >= 2:
        remedy = f": an `outer` below {dump.r[fewer]:.6g} leaves out the other rows"
    raise DumpProblem(
        dump.file,
        None,
        f"has {rows} x {columns} x {layers} zones; it must have at most {SIDE_MOST} a side and {NODES_MOST} in all"
        + remedy,
    )


def _nothing(dump: Dump, plasma: Plasma, by_cuts: bool) -> Exception:
    """The error that is raised if no zone has a density."""
    if not by_cuts:
        return DumpProblem(
            dump.file, "rho", "is 0 in single precision wherever no cut applies; it must be above 1.4e-45"
        )
    cuts = (("sigma_cut", plasma.sigma_cut), ("rho_floor", plasma.rho_floor))
    given = " and ".join(f"{name} is {value:g}" for name, value in cuts if value is not None)
    return ValueError(f"{given}; at least one zone of {printable(dump.file)} must have matter by these cuts")


def _scale(arrays: dict[str, NDArray[np.float32]], unit: float | None) -> None:
    """Converts from the code's units to cm^-3 and gauss."""
    if unit is None:
        unit = PEAK * (PROTON + ELECTRON) / float(arrays["density"].max())
    gauss = field_unit(unit)
    factors = {"density": unit / (PROTON + ELECTRON), "b_con_r": gauss, "b_con_theta": gauss, "b_cov_phi": gauss}
    with np.errstate(all="ignore"):
        for name, factor in factors.items():
            np.multiply(arrays[name], factor, out=arrays[name], dtype=np.float64, casting="same_kind")


def _check_single(dump: Dump, plasma: Plasma, arrays: dict[str, NDArray[np.float32]]) -> None:
    """Refuses numbers outside the range of single precision, in which a grid is stored."""
    for name, values in arrays.items():
        bad = ~np.isfinite(values)
        if not bad.any():
            continue
        at = ", ".join(str(int(x)) for x in np.argwhere(bad)[0])
        if plasma.m_unit is not None and name not in ("temperature", "u_con_r", "u_con_theta", "u_cov_phi"):
            raise ValueError(
                f"m_unit is {plasma.m_unit:g}; it must make {name}[{at}] smaller than 3.4e38 {UNITS[name]}"
            )
        raise DumpProblem(dump.file, None, f"{name}[{at}] is infinite in single precision; it must be finite")
    if not arrays["density"].any():
        shown = "None" if plasma.m_unit is None else f"{plasma.m_unit:g}"
        raise ValueError(f"m_unit is {shown}; it must make the largest density larger than 1.4e-45 cm^-3")
