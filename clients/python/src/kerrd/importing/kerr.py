"""Quantities of the hole that the other codes compute instead of reading them from input files: orbits, and the
frequency and direction of light for an observer near the hole."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..eht import PARSEC_M, SUN_M

C_M_S = 299792458.0
GM_SUN = SUN_M * C_M_S**2  # m^3/s^2
PROTON_KG, THOMSON_M2 = 1.67262192595e-27, 6.6524587051e-29  # CODATA 2022
UAS = math.pi / (180 * 3600 * 1e6)


def horizon(a: float) -> float:
    return 1 + math.sqrt(1 - a * a)


def isco(a: float) -> float:
    """Radius of the innermost stable circular orbit; retrograde for a < 0 (Bardeen, Press & Teukolsky 1972, 2.21)."""
    z1: float = 1 + (1 - a * a) ** (1 / 3) * ((1 + a) ** (1 / 3) + (1 - a) ** (1 / 3))
    z2 = math.sqrt(3 * a * a + z1 * z1)
    return 3 + z2 - math.copysign(math.sqrt((3 - z1) * (3 + z1 + 2 * z2)), a)


def efficiency(a: float) -> float:
    """Fraction of its rest energy that gas radiates before it reaches the ISCO: 1 - E, with E^2 = 1 - 2/(3 r)."""
    return 1 - math.sqrt(1 - 2 / (3 * isco(a)))


def eddington_kg_s(mass_msun: float) -> float:
    """Eddington luminosity over c^2: L_Edd/c^2 = 4 pi G M m_p/(sigma_T c)."""
    return 4 * math.pi * GM_SUN * mass_msun * PROTON_KG / (THOMSON_M2 * C_M_S)


def kepler(a: float, r: float) -> float:
    """Angular velocity of a circular orbit in the equatorial plane, 1/M."""
    return 1 / (math.pow(r, 1.5) + a)


def field_m(angle_rad: float, mass_msun: float, distance_pc: float) -> float:
    """Width in M of an angle on the sky."""
    return angle_rad * distance_pc * PARSEC_M / (SUN_M * mass_msun)


@dataclass(frozen=True)
class Received:
    """Frequency and motion of an observer. infinity: a photon's frequency at infinity over its frequency at the
    observer. still: true if the observer is at rest with respect to infinity. velocity: r, theta and phi components
    relative to the local observer of zero angular momentum, c."""

    infinity: float
    still: bool
    velocity: tuple[float, float, float]


def received(
    a: float, r: float, theta: float, past_normal: tuple[float, float, float], photon: tuple[float, float, float]
) -> Received:
    """Frequency and motion of an observer that is given in spherical Kerr-Schild coordinates. past_normal:
    contravariant components r, theta, phi of its velocity, minus those of the normal observer. photon: the covariant
    components k_r, k_theta, k_phi of an outgoing photon.

    C. J. White 2022 (ApJS 262, 28), section 2.1, describes a camera by these numbers. theta must not be a pole unless
    the phi components are 0.
    """
    s, c = math.sin(theta), math.cos(theta)
    sigma, delta = r * r + a * a * c * c, r * r - 2 * r + a * a
    h = 2 * r / sigma
    ur, ut, up = past_normal
    kr, kt, kp = photon
    lapse, shift = 1 / math.sqrt(1 + h), h / (1 + h)
    energy = math.sqrt(
        1
        + (1 + h) * (ur - a * s * s * up) ** 2
        + sigma * ut * ut
        + ((r * r + a * a + h * a * a * s * s) * s * s - (1 + h) * (a * s * s) ** 2) * up * up
    )
    u0, u1, u2, u3 = energy / lapse, ur - shift / lapse * energy, ut, up
    # Null condition, which gives k_t: g^tt k_t^2 + 2 g^tr k_r k_t + g^ij k_i k_j = 0, with g^tt = -(1 + h), g^tr = h.
    square = (delta * kr * kr + 2 * a * kr * kp + kt * kt) / sigma + (kp * kp / (sigma * s * s) if kp else 0.0)
    k0 = (h * kr - math.sqrt(h * h * kr * kr + (1 + h) * square)) / (1 + h)
    local = -(k0 * u0 + kr * u1 + kt * u2 + kp * u3)
    # From here on in Boyer-Lindquist coordinates, relative to the observer of zero angular momentum.
    t, phi = u0 - 2 * r / delta * u1, u3 - a / delta * u1
    area = (r * r + a * a) ** 2 - a * a * delta * s * s
    gamma = math.sqrt(sigma * delta / area) * t
    velocity = (
        math.sqrt(sigma / delta) * u1 / gamma,
        math.sqrt(sigma) * u2 / gamma,
        math.sqrt(area / sigma) * s * (phi - 2 * a * r / area * t) / gamma,
    )
    still = max(abs(u1), abs(r * u2), abs(r * s * u3)) < 1e-6
    return Received(-k0 / local, still, velocity)
