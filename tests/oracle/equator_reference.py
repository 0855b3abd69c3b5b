#!/usr/bin/env python3
"""Reference numbers for motion near the equatorial plane of Kerr, as the C table equator_reference.h.

python3 tests/oracle/equator_reference.py > tests/oracle/equator_reference.h      (needs mpmath)

None of kerrd's formulas is used. Epicyclic frequencies: the second derivatives of Carter's radial and polar potentials
at the circular orbit, over u^t. Effective potential: the root of g^ab p_a p_b = -mu^2, with the metric inverted
numerically. Its extrema: where its derivative, by differences in 60 digits, changes sign. Frame dragging and the light
cone: the metric at any polar angle.
"""

from kerr_reference import SPINS, c, curvature, metric, orbit, orbits
from mpmath import diff, matrix, mp, mpf, sqrt

mp.dps = 60


def epicyclic(a, r):
    """kappa and Omega_theta, the epicyclic frequencies of the circular orbit."""
    _, energy, momentum, ut = orbit(a, r)
    radial = -curvature(a, r, energy, momentum)[2] / 2
    vertical = momentum**2 + a**2 * (1 - energy**2)  # half of -Theta'' at the plane, where Theta is the polar potential
    return sqrt(radial) / r**2 / ut, sqrt(vertical) / r**2 / ut


def potential(a, momentum, mu2, r):
    tt, tp, pp = metric(a, r)[0]
    up = matrix([[tt, tp], [tp, pp]]) ** -1
    # up_tt E^2 - 2 up_tp E L + up_pp L^2 + mu2 = 0
    half, rest = up[0, 1] * momentum, up[1, 1] * momentum**2 + mu2
    return (half - sqrt(half**2 - up[0, 0] * rest)) / up[0, 0]


def turning(f, low, high, sign):
    """The place where the slope of f changes sign, from `sign` to -`sign`."""
    while high - low > mpf(10) ** -28 * high:
        middle = (low + high) / 2
        if sign * diff(f, middle, h=mpf(10) ** -30) > 0:
            low = middle
        else:
            high = middle
    return low


def extrema(a, momentum):
    """r and V of the extrema: maximum and minimum for matter, maximum for light."""
    if momentum < 0:
        a, momentum = -a, -momentum
    photon, _, isco = orbits(a)
    matter, light = (lambda r: potential(a, momentum, 1, r)), (lambda r: potential(a, momentum, 0, r))
    inner, outer = turning(matter, photon, isco, 1), turning(matter, isco, 4 * momentum**2 + 20, -1)
    return inner, matter(inner), outer, matter(outer), photon, light(photon)


def rotation(a, r, u):
    """-g_tphi/g_phiphi, and half the range of dphi/dt of light, with the metric as given by Boyer & Lindquist."""
    s2, sigma = 1 - u**2, r**2 + a**2 * u**2
    tt, tp = -(1 - 2 * r / sigma), -2 * a * r * s2 / sigma
    pp = (r**2 + a**2 + 2 * r * a**2 * s2 / sigma) * s2
    return -tp / pp, sqrt(tp**2 - tt * pp) / pp


def table(struct, name, fields, rows):
    print("struct %s { double %s; };\nstatic const struct %s %s[] = {" % (struct, ", ".join(fields), struct, name))
    for given, computed in rows:
        print("    { %s,\n      %s }," % (", ".join(float(x).hex() for x in given), ", ".join(map(c, computed))))
    print("};\n")


def main():
    print("/* Made by tests/oracle/equator_reference.py; do not edit. */")
    print("#ifndef KD_TESTS_EQUATOR_REFERENCE_H\n#define KD_TESTS_EQUATOR_REFERENCE_H\n")
    rows = []
    for spin in SPINS:
        isco = float(orbits(mpf(spin))[2])
        for r in (isco * 1.0625, isco * 2, 100.0, 1e6):
            rows.append(((spin, r), epicyclic(mpf(spin), mpf(r))))
    table("epicyclic_reference", "epicyclic_reference", ["a", "r", "radial", "vertical"], rows)
    rows = []
    for spin in (-0.9, 0.0, 0.5, 0.998, 1 - 1e-12):
        for momentum in (-6.0, 0.0, 2.5, 40.0):
            horizon = 1 + sqrt(1 - mpf(spin) ** 2)
            for r in (float(horizon * (1 + mpf(10) ** -6)), 2.5, 10.0, 1e5):
                rows.append(((spin, momentum, r), [potential(mpf(spin), mpf(momentum), mu2, mpf(r)) for mu2 in (1, 0)]))
    table("potential_reference", "potential_reference", ["a", "l", "r", "matter", "light"], rows)
    rows = [
        ((spin, momentum), extrema(mpf(spin), mpf(momentum)))
        for spin, momentum in (
            (0.0, 4.0),
            (0.0, -3.75),
            (0.5, 3.0),
            (0.5, -5.0),
            (-0.9, 5.0),
            (0.998, 1.5),
            (0.998, 20.0),
            (1 - 1e-12, 1.25),
            (0.9, -1000.0),
        )
    ]
    table(
        "extrema_reference",
        "extrema_reference",
        ["a", "l", "r_max", "v_max", "r_min", "v_min", "r_light", "v_light"],
        rows,
    )
    rows = []
    for spin in (-0.9, 1e-9, 0.5, 0.998, 1 - 1e-12):
        for r in (2.25, 10.0, 1e6):
            for u in (0.0, 0.5, -0.9990234375):
                rows.append(((spin, r, u), rotation(mpf(spin), mpf(r), mpf(u))))
    table("rotation_reference", "rotation_reference", ["a", "r", "u", "omega", "reach"], rows)
    print("#endif")


if __name__ == "__main__":
    main()
