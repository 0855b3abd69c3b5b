#!/usr/bin/env python3
"""Samples the torus of Fishbone & Moncrief 1976 on a grid for volume.model "grid". dump_grid.py is a converter for
dumps of simulations."""

import argparse
import json

import numpy as np

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("out", metavar="OUT.npz")
parser.add_argument("shape", nargs="*", type=int, metavar="N", help="rows, columns and layers")
parser.add_argument("--spin", type=float, default=0.9375)
parser.add_argument("--charge", type=float, default=0.0, help="of the hole, in M")
given = parser.parse_args()
shape, a, q2 = given.shape or [192, 96], given.spin, given.charge**2
inner, middle, gamma, beta, ratio, peak = (
    6.0,
    12.0,
    13 / 9,
    10.0,
    1.0,
    1.776e7,
)  # the preset `torus`, its Gamma, beta, R and density
r, theta = np.geomspace(5.9, 100, shape[0]), (np.arange(shape[1]) + 0.5) * np.pi / shape[1]
phi = {"phi": np.arange(shape[2]) * 2 * np.pi / shape[2]} if len(shape) > 2 else {}


def metric(
    r, s2
):  # lapse^2, angular velocity of observers of zero angular momentum, g_phiphi (Bardeen, Press & Teukolsky 1972)
    sigma, delta, b = r**2 + a**2 * (1 - s2), r**2 - 2 * r + a**2 + q2, r**2 + a**2
    area = b**2 - a**2 * delta * s2
    return sigma * delta / area, a * (2 * r - q2) / area, np.maximum(area * s2 / sigma, 1e-12)


def log_h(r, s2):  # equation 3.6 with u^t u_phi = l everywhere: ln h but for a constant, and u_phi
    lapse2, omega, g = metric(r, s2)
    root = np.sqrt(1 + 4 * l**2 * lapse2 / g)
    return 0.5 * np.log((1 + root) / lapse2) - 0.5 * root - omega * l, np.sqrt(g * (root - 1) / 2)


# l of the circular orbit at the largest pressure; its angular velocity is x/(r^2 + a x)
x = np.sqrt(middle - q2)
lapse2, omega, g = metric(middle, 1.0)
past = x / (middle**2 + a * x) - omega
l = g * past / (lapse2 - g * past**2)
ln_h, u_phi = log_h(r[:, None], np.sin(theta) ** 2)
h1, most = (
    np.maximum(np.expm1(ln_h - log_h(inner, 1.0)[0]), 0) * (r >= inner)[:, None],
    np.expm1(log_h(middle, 1.0)[0] - log_h(inner, 1.0)[0]),
)
density = peak * (h1 / most) ** (1 / (gamma - 1))  # cm^-3
temperature = (
    1.67262192e-27 * 299792458.0**2 / 1.380649e-23 * (gamma - 1) / gamma * h1 / (1 + ratio)
)  # K, of the electrons
field = np.sqrt(
    8 * np.pi * density * 1.67262192e-24 * 2.99792458e10**2 * (gamma - 1) / gamma * h1 / beta
)  # G, round the axis
lapse2, omega, g = metric(r[:, None], np.sin(theta) ** 2)
arrays = dict(
    density=density,
    temperature=temperature,
    u_con_r=0 * u_phi,
    u_con_theta=0 * u_phi,
    u_cov_phi=u_phi,
    u_con_t=np.sqrt((1 + u_phi**2 / g) / lapse2),
    b_con_r=0 * field,
    b_con_theta=0 * field,
    b_cov_phi=field * np.sqrt(g + u_phi**2),
)
arrays = {name: np.repeat(of[..., None], shape[2], -1) if phi else of for name, of in arrays.items()}
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
header = dict(format="kerrd-grid", version=1, spin=a, charge=given.charge, azimuth="boyer-lindquist", units=units)
np.savez_compressed(given.out, header=json.dumps(header), r=r, theta=theta, **phi, **arrays)
