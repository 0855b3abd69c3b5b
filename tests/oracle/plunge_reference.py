#!/usr/bin/env python3
"""Reference numbers for the plunge from the ISCO of Kerr, to 20 digits, as the C table plunge_reference.h.

python3 tests/oracle/plunge_reference.py > tests/oracle/plunge_reference.h      (needs mpmath)

Everything follows from the metric alone. The ISCO is where the energy of circular orbits is least. u^t and u^phi come
from raising (-E, L), u^r from u.u = -1, and coordinate time and azimuth from quadrature of u^t/u^r and u^phi/u^r over
r.
"""

from mpmath import mp, mpf, nstr, quad, sqrt

mp.dps = 40
SPINS = [0.0, 0.5, 0.9, 0.998, -0.9, 0.9999]
PLACES = [0.0625, 0.25, 0.5, 0.75, 0.96875, 0.9990234375]  # fractions of the way from the ISCO to the horizon
START = 0.03125


def metric(a, r):
    return -1 + 2 / r, -2 * a / r, r * r + a * a + 2 * a * a / r


def circle(a, r):
    """E and L of a circular orbit, with d(phi)/dt from the r-derivatives of the metric."""
    tt, tp, pp = -2 / r**2, 2 * a / r**2, 2 * r - 2 * a * a / r**2
    w = (-tp + sqrt(tp * tp - tt * pp)) / pp
    tt, tp, pp = metric(a, r)
    ut = 1 / sqrt(-(tt + 2 * tp * w + pp * w * w))
    return -ut * (tt + tp * w), ut * (tp + pp * w)


def isco(a):
    """The radius where dE/dr = 0, by bisection outwards from the marginally bound orbit, E = 1."""
    step = mpf(10) ** -16
    slope = lambda r: circle(a, r * (1 + step))[0] - circle(a, r * (1 - step))[0]
    low, high = (1 + sqrt(1 - a)) ** 2, mpf(10)
    for _ in range(110):
        middle = (low + high) / 2
        low, high = (middle, high) if slope(middle) < 0 else (low, middle)
    return low


def velocity(a, r, energy, l):
    tt, tp, pp = metric(a, r)
    det = tt * pp - tp * tp
    ut, up = (-energy * pp - l * tp) / det, (energy * tp + l * tt) / det
    grr = r * r / (r * r - 2 * r + a * a)
    return ut, up, -sqrt((energy * ut - l * up - 1) / grr)


def main():
    print("/* Made by tests/oracle/plunge_reference.py; do not edit. Quadrature from the metric. */")
    print("#ifndef KD_TESTS_PLUNGE_REFERENCE_H\n#define KD_TESTS_PLUNGE_REFERENCE_H\n")
    print("/* t and phi from r0 to r; u^t, u^phi and u^r at r. */")
    print("struct plunge_reference { double a, r0, r, t, phi, ut, uphi, ur; };\n")
    print("static const struct plunge_reference plunge_reference[] = {")
    for spin in SPINS:
        a = mpf(spin)
        edge, horizon = isco(a), 1 + sqrt(1 - a * a)
        energy, l = circle(a, edge)
        start = mpf(float(edge - START * (edge - horizon)))
        for place in PLACES:
            r = mpf(float(edge - place * (edge - horizon)))
            middle = (start + r) / 2
            rate = lambda k: quad(
                lambda x: velocity(a, x, energy, l)[k] / velocity(a, x, energy, l)[2], [start, middle, r]
            )
            numbers = [rate(0), rate(1), *velocity(a, r, energy, l)]
            print(f"    {{ {float(a).hex()}, {float(start).hex()}, {float(r).hex()}, /* {spin}, {float(r):.6g} */")
            print(f"      {', '.join(nstr(x, 20) for x in numbers)} }},")
    print("};\n\n#endif")


if __name__ == "__main__":
    main()
