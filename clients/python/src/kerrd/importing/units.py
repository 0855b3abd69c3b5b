"""Units of GYOTO's input files. GYOTO accepts all units of udunits; kerrd accepts those that GYOTO's manual and
examples use."""

from __future__ import annotations

import math

from ..eht import PARSEC_M, SUN_M
from .kerr import C_M_S, GM_SUN, UAS
from .sheet import Sheet

G_SI = 6.67430e-11  # CODATA 2022
AU_M, LIGHT_YEAR_M, SUN_RADIUS_M = 149597870700.0, 9.4607304725808e15, 6.957e8
LENGTHS = {
    **{"m": 1.0, "meter": 1.0, "cm": 1e-2, "mm": 1e-3, "µm": 1e-6, "μm": 1e-6, "nm": 1e-9, "km": 1e3},
    **{name: AU_M for name in ("AU", "au", "ua", "astronomicalunit", "astronomical_unit")},
    **{"sunradius": SUN_RADIUS_M, "ly": LIGHT_YEAR_M, "light_year": LIGHT_YEAR_M},
    **{"pc": PARSEC_M, "parsec": PARSEC_M, "kpc": 1e3 * PARSEC_M, "Mpc": 1e6 * PARSEC_M, "Gpc": 1e9 * PARSEC_M},
}
TIMES = {"s": 1.0, "second": 1.0, "min": 60.0, "h": 3600.0, "d": 86400.0, "yr": 3.15576e7, "kyr": 3.15576e10}
MASSES = {"kg": G_SI / GM_SUN, "kilogram": G_SI / GM_SUN, "g": 1e-3 * G_SI / GM_SUN, "sunmass": 1.0}
ANGLES = {
    **{"rad": 1.0, "radian": 1.0, "": 1.0},
    **{name: math.radians(1) for name in ("degree", "degrees", "deg", "°")},
    **{name: math.radians(1 / 60) for name in ("arcmin", "arcminute")},
    **{
        prefix + name: scale * UAS
        for name in ("as", "arcsec", "arcsecond")
        for prefix, scale in {"": 1e6, "milli": 1e3, "m": 1e3, "micro": 1.0, "µ": 1.0, "μ": 1.0, "u": 1.0}.items()
    },
}


class Units:
    """Converts values of a section. mass_msun: the hole's mass, or None if the file does not state it."""

    def __init__(self, mass_msun: float | None) -> None:
        self.mass_msun = mass_msun

    def _hole_m(self, sheet: Sheet, key: str) -> float:
        if self.mass_msun is None:
            raise sheet.wrong(key, "in geometrical units, because Metric/Mass is missing")
        return SUN_M * self.mass_msun

    def mass(self, sheet: Sheet, key: str) -> float:
        """Solar masses."""
        return sheet.positive(key) * _factor(sheet, key, MASSES, "kg")

    def angle(self, sheet: Sheet, key: str) -> float:
        """Radians."""
        return sheet.number(key) * _factor(sheet, key, ANGLES, "rad")

    def length(self, sheet: Sheet, key: str, default: str) -> float:
        """The length in M. default: unit of a value without a unit."""
        unit = sheet.entries[key].unit or default
        if unit == "geometrical":
            return sheet.number(key)
        metres = sheet.number(key) * _factor(sheet, key, {**LENGTHS, "geometrical": 1.0}, default)
        return metres / self._hole_m(sheet, key)

    def time(self, sheet: Sheet, key: str) -> float:
        """The time in M. A value in units of length is the time that light needs for that length."""
        unit = sheet.entries[key].unit or "s"
        if unit in ("geometrical_time", "geometrical"):
            return sheet.number(key)
        seconds = {**TIMES, **{name: metres / C_M_S for name, metres in LENGTHS.items()}, "geometrical_time": 1.0}
        return sheet.number(key) * _factor(sheet, key, seconds, "s") * C_M_S / self._hole_m(sheet, key)

    def field(self, sheet: Sheet, key: str, distance_m: float) -> float:
        """The angle in radians, from an angle or from a length at the hole. distance_m: the hole's distance in M."""
        unit = sheet.entries[key].unit
        if unit == "geometrical" or unit in LENGTHS:
            return self.length(sheet, key, "geometrical") / distance_m
        return sheet.number(key) * _factor(sheet, key, {**ANGLES, **LENGTHS, "geometrical": 1.0}, "rad")


def _factor(sheet: Sheet, key: str, units: dict[str, float], default: str) -> float:
    unit = sheet.entries[key].unit or default
    if unit not in units:
        raise sheet.wrong(key, "in one of the units " + ", ".join(name for name in units if name))
    return units[unit]
