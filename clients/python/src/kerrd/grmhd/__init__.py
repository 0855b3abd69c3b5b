"""Matter of simulations (GRMHD) for volume.model "grid", from the files of iharm3d, KHARMA, KORAL and Athena++
(docs/importing.md)."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace

from . import athena, iharm, kharma, koral
from .dump import Dump
from .file import DumpFile, DumpProblem, is_hdf5
from .grid import Matter
from .plasma import Plasma
from .series import series

__all__ = ["CODES", "DumpProblem", "Matter", "is_hdf5", "matter"]
CODES = ("iharm3d", "kharma", "koral", "athena++")


def _dump(file: DumpFile, code: str | None, spin: float | None, gamma: float | None, outer: float | None) -> Dump:
    if code is None:
        code = "kharma" if file.has_attribute(kharma.DECK) or file.has_attribute("Info/MeshBlockSize") else None
    if code is None and koral.METRIC in file:
        code = "koral"
    if code is None:
        code = "athena++" if any(map(file.has_attribute, ("Coordinates", "MeshBlockSize"))) else "iharm3d"
    if code == "athena++":
        return athena.read(file, spin, gamma, outer)
    if spin is not None or gamma is not None:
        raise ValueError(f"spin and gamma must be None for a file of {code}, which has both")
    if code == "kharma":
        return kharma.read(file, outer)
    return koral.read(file, outer) if code == "koral" else iharm.read(file, outer)


def _thinned(dump: Dump, step: int) -> Dump:
    """Each step-th row."""
    if step == 1:
        return dump
    if len(dump.r[::step]) < 2:
        raise ValueError(f"row_step is {step}; it must leave at least 2 of {len(dump.r)} rows")
    return replace(
        dump,
        r=dump.r[::step],
        theta=dump.theta if dump.theta.ndim == 1 else dump.theta[::step],
        row=lambda i: dump.row(step * i),
        notes=(*dump.notes, f"1 of {step} rows is kept"),
    )


def matter(
    path: str | os.PathLike[str] | Sequence[str | os.PathLike[str]],
    *,
    mass_msun: float | None = None,
    m_unit: float | None = None,
    electrons: str = "ratio",
    r_low: float = 1.0,
    r_high: float = 40.0,
    gamma_e: float | None = None,
    gamma_p: float | None = None,
    sigma_cut: float | None = 1.0,
    rho_floor: float | None = None,
    outer: float | None = None,
    spin: float | None = None,
    gamma: float | None = None,
    code: str | None = None,
    every: int = 1,
    row_step: int = 1,
) -> Matter:
    """The matter of a simulation's dump, as the file that volume.grid names. A list of dumps in the order of their
    times becomes a series in time. With volume.slow_light, light then takes time to cross the changing matter.

    mass_msun, m_unit: mass of the hole, and the code's unit of mass, g; together they give the density in cm^-3 and the
    field in gauss. Without m_unit the largest density is 1e6 cm^-3, and the scene's volume.grid_scale or
    volume.normalise_to_jy sets it. electrons: how their temperature is found. "ratio": from a ratio of ion and electron
    temperatures by r_low and r_high (Moscibrodzka et al. 2016). A name such as "KEL": from that stored entropy. "te":
    the temperature stored by KORAL. gamma_e, gamma_p: adiabatic indices of electrons and ions; None: those in the file,
    or 4/3 and 5/3 if it has none. sigma_cut: zones with a larger b^2/rho have no matter; None: no such cut. rho_floor:
    zones whose density in the code's units is at most this have no matter, because there the density is the
    simulation's floor; None: no such cut. outer: rows beyond this r are left out. row_step: n keeps every n-th row.
    every: n keeps every n-th dump of a series. code: "iharm3d", "kharma", "koral" or "athena++"; None: found by the
    contents. spin, gamma: of the hole, and the gas's adiabatic index: needed for Athena++, whose files have neither.
    DumpProblem, with file and name, for a file that cannot be read; ValueError for another argument; ImportError
    without the package h5py.
    """
    if code is not None and code not in CODES:
        raise ValueError(f"code is {code!r}; it must be {', '.join(CODES)} or None")
    plasma = Plasma(electrons, r_low, r_high, gamma_e, gamma_p, sigma_cut, mass_msun, m_unit, rho_floor)
    plasma.check()
    for name, value in (("every", every), ("row_step", row_step)):
        if value < 1 or value != int(value):
            raise ValueError(f"{name} is {value}; it must be a whole number of at least 1")

    @contextmanager
    def dump(of: str | os.PathLike[str]) -> Iterator[Dump]:
        with DumpFile(of) as file:
            yield _thinned(_dump(file, code, spin, gamma, outer), row_step)

    if not isinstance(path, (str, os.PathLike)):
        paths = [os.fspath(one) for one in path][::every]
        return series(paths, lambda i: dump(paths[i]), plasma)
    if every != 1:
        raise ValueError(f"every is {every}; it must be 1 for one dump")
    with dump(path) as one:
        return Matter.of(one, plasma)
