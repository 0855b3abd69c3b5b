#!/usr/bin/env python3
"""Makes a grid for volume.model "grid" from a dump of a simulation in Kerr-Schild coordinates.

dump_grid.py DUMP.npz OUT.npz

The dump has the spin `a`, and `r`, `theta` and `phi` in even steps of log r, theta and phi. (Interpolate a code's own
grid to such steps first.) The following arrays have the shape (rows, columns, layers): the density `rho`, the electron
temperature `te` in K, `u` = u^t, u^r, u^theta, u^phi, and `B` = B^r, B^theta, B^phi. All except te are in the code's
units, with the factor sqrt(4 pi) in B. `rho_unit` is the code's unit of density in g cm^-3."""

import json
import sys

import numpy as np

dump = np.load(sys.argv[1])
a, r, theta, u, B = float(dump["a"]), dump["r"], dump["theta"], dump["u"], dump["B"]
R, s2 = r[:, None, None], np.sin(theta)[:, None] ** 2
S = R**2 + a**2 * (1 - s2)
h = 2 * R / S


def lower(v):  # lowers the index, with the metric in ingoing Kerr-Schild coordinates
    along = h * v[0] + (1 + h) * (v[1] - a * s2 * v[3])
    return np.array(
        [-v[0] + h * (v[0] + v[1] - a * s2 * v[3]), along, S * v[2], s2 * (S * v[3] - a * along) + 0 * v[0]]
    )


below = lower(u)
bt = sum(B[i] * below[i + 1] for i in range(3))
b = np.array(
    [bt, *((B[i] + bt * u[i + 1]) / u[0] for i in range(3))]
)  # the field in the frame of the matter, code units
gauss = np.sqrt(4 * np.pi * float(dump["rho_unit"])) * 2.99792458e10
arrays = dict(
    density=dump["rho"] * float(dump["rho_unit"]) / 1.67262192e-24,
    temperature=dump["te"],
    u_con_r=u[1],
    u_con_theta=u[2],
    u_cov_phi=below[3],
    b_con_r=gauss * b[1],
    b_con_theta=gauss * b[2],
    b_cov_phi=gauss * lower(b)[3],
)
units = dict(
    r="M",
    theta="rad",
    density="cm^-3",
    temperature="K",
    u_con_r="c",
    u_con_theta="c/M",
    u_cov_phi="c M",
    b_con_r="G",
    b_con_theta="G/M",
    b_cov_phi="G M",
)
header = dict(format="kerrd-grid", version=1, spin=a, azimuth="kerr-schild", units=units)
np.savez_compressed(sys.argv[2], header=json.dumps(header), r=r, theta=theta, phi=dump["phi"], **arrays)
