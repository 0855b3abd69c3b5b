"""Units, temperature of the electrons, and cuts. A simulation in scale-free units does not determine them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .dump import Dump, Row

Numbers = NDArray[np.float64]

# CODATA 2018 and IAU 2015 B3, in CGS units; equal to those in src/physics/math/constants.h of the server.
C, K = 2.99792458e10, 1.380649e-16
PROTON, ELECTRON = 1.67262192369e-24, 9.1093837015e-28
GM_SUN = 1.3271244e26
THETA_LEAST = 1e-3  # lower limit of k T/(m_e c^2), as in ipole
PEAK = 1e6  # value in cm^-3 that the largest density gets if the code's unit is unknown


@dataclass(frozen=True)
class Plasma:
    """Arguments of kerrd.matter, by the same names."""

    electrons: str = "ratio"
    r_low: float = 1.0
    r_high: float = 40.0
    gamma_e: float | None = None
    gamma_p: float | None = None
    sigma_cut: float | None = 1.0
    mass_msun: float | None = None
    m_unit: float | None = None
    rho_floor: float | None = None

    def check(self) -> None:
        """Raises ValueError for an argument that is out of range."""
        for name, value, low, high in (
            ("r_low", self.r_low, 0, 1e9),
            ("r_high", self.r_high, 0, 1e9),
            ("gamma_e", self.gamma_e, 1.0001, 3),
            ("gamma_p", self.gamma_p, 1.0001, 3),
            ("sigma_cut", self.sigma_cut, 1e-9, 1e30),
            ("mass_msun", self.mass_msun, 1e-3, 1e12),
            ("m_unit", self.m_unit, 1e-30, 1e60),
            ("rho_floor", self.rho_floor, 0, 1e60),
        ):
            if value is not None and not low <= value <= high:
                raise ValueError(f"{name} is {value:g}; it must be a number from {low:g} to {high:g}")
        if self.m_unit is not None and self.mass_msun is None:
            raise ValueError("mass_msun is None; it must be given with m_unit, whose length it sets")

    @property
    def density_unit(self) -> float | None:
        """Density in g cm^-3 of one code unit: m_unit (c^2/GM)^3."""
        if self.m_unit is None or self.mass_msun is None:
            return None
        return self.m_unit / (GM_SUN * self.mass_msun / C**2) ** 3

    def kelvin(self, dump: Dump, row: Row, b2: Numbers) -> Numbers:
        """Temperature of the electrons, in one of three ways. (1) From a ratio R of ion and electron temperature, R =
        (R_low + R_high beta^2)/(1 + beta^2), beta = 2 (gamma - 1) u/b^2 (M. Moscibrodzka, H. Falcke & H. Shiokawa 2016,
        A&A 586, A38), with an adiabatic index for ions and one for electrons: Theta = m_p/m_e (gamma_e - 1)(gamma_p -
        1)/((gamma_p - 1) + (gamma_e - 1) R) u/rho, as in ipole's model/iharm. (2) The temperature stored in the file.
        (3) From the stored entropy K: Theta = m_p/m_e K rho^(gamma_e - 1) (S. M. Ressler et al. 2015, MNRAS 454, 1848).
        """
        if self.electrons in dump.kelvin:
            return np.maximum(row[self.electrons], THETA_LEAST * (ELECTRON * C**2 / K))
        electrons = (self.gamma_e or dump.gamma_e or 4 / 3) - 1
        ions = (self.gamma_p or dump.gamma_p or 5 / 3) - 1
        if self.electrons == "ratio":
            beta2 = (2 * (dump.gamma - 1) * row["u"] / np.maximum(b2, 1e-150)) ** 2
            share = 1 / (1 + 1 / np.maximum(beta2, 1e-300))
            ratio = self.r_low + (self.r_high - self.r_low) * share
            theta = electrons * ions / (ions + electrons * ratio) * row["u"] / row["rho"]
        else:
            theta = row[self.electrons] * row["rho"] ** electrons
        return np.maximum(PROTON / ELECTRON * theta, THETA_LEAST) * (ELECTRON * C**2 / K)

    def cut(self, rho: Numbers, b2: Numbers) -> NDArray[np.bool_]:
        """For each node: true if a cut leaves it without matter."""
        none = np.zeros(rho.shape, bool) if self.rho_floor is None else rho <= self.rho_floor
        return none if self.sigma_cut is None else none | (b2 > self.sigma_cut * rho)

    def said(self, dump: Dump) -> list[str]:
        """Sentences that describe the chosen units, temperature and cuts."""
        unit = self.density_unit
        out = [
            f"density 1 is {unit:.6g} g/cm^3"
            if unit is not None
            else f"the largest density is set to {PEAK:g} cm^-3: volume.grid_scale or volume.normalise_to_jy scales it",
            f"electrons: temperature by R_low = {self.r_low:g} and R_high = {self.r_high:g}"
            if self.electrons == "ratio"
            else f"electrons: the file's temperature {self.electrons}"
            if self.electrons in dump.kelvin
            else f"electrons: temperature by the entropy {self.electrons}",
        ]
        if self.sigma_cut is not None:
            out.append(f"no matter where b^2/rho is above {self.sigma_cut:g}")
        if self.rho_floor is not None:
            out.append(f"no matter where the code's density is at most {self.rho_floor:g}")
        return out


def field_unit(density_unit: float) -> float:
    """Magnetic field in gauss of one code unit. The code's unit contains the factor sqrt(4 pi)."""
    return C * math.sqrt(4 * math.pi * density_unit)
