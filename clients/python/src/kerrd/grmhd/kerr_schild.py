"""Vectors in ingoing Kerr-Schild coordinates: the four-velocity and the magnetic field of HARM's variables.

C. F. Gammie, J. C. McKinney & G. Toth 2003 (ApJ 589, 444): b^t = B^i u_i, b^i = (B^i + b^t u^i)/u^t; the velocity
relative to the normal observer U^i = u^i - gamma beta^i/alpha, whose norm gives gamma^2 = 1 + U.U (also J. C. McKinney
& C. F. Gammie 2004, ApJ 611, 977)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.float64]


@dataclass(frozen=True)
class Flow:
    """u^r, u^theta and u_phi; b^r, b^theta and b_phi; and b^2. These components are the same in Boyer-Lindquist
    coordinates."""

    u: tuple[Numbers, Numbers, Numbers]
    b: tuple[Numbers, Numbers, Numbers]
    b2: Numbers


def flow(a: float, r: float, theta: Numbers, U: tuple[Numbers, ...], B: tuple[Numbers, ...]) -> Flow:
    """The metric at one r and at the angles theta. The arrays broadcast to the shape of the components U^i and B^i."""
    s2 = np.sin(theta) ** 2
    sigma = r * r + a * a * np.cos(theta) ** 2
    h = 2 * r / sigma

    def lower(v: tuple[Numbers, ...]) -> tuple[Numbers, ...]:
        twist = v[1] - a * s2 * v[3]
        along = h * v[0] + (1 + h) * twist
        return h * (v[0] + twist) - v[0], along, sigma * v[2], s2 * (sigma * v[3] - a * along)

    zero = np.zeros_like(U[0])
    norm = sum(x * y for x, y in zip(U, lower((zero, *U))[1:]))
    lapse = 1 / np.sqrt(1 + h)
    lorentz = np.sqrt(1 + np.abs(norm))
    u = (lorentz / lapse, U[0] - lorentz * lapse * h, U[1], U[2])
    below = lower(u)
    bt = B[0] * below[1] + B[1] * below[2] + B[2] * below[3]
    b = (bt, *((B[i] + bt * u[i + 1]) / u[0] for i in range(3)))
    low = lower(b)
    return Flow((u[1], u[2], below[3]), (b[1], b[2], low[3]), np.abs(sum(x * y for x, y in zip(b, low))))
