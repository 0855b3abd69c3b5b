#!/usr/bin/env python3
"""Reference numbers for the plunge from the ISCO, with and without charge, to 20 digits, as the C table plunge_reference.h.

python3 tests/oracle/plunge_reference.py > tests/oracle/plunge_reference.h      (needs mpmath)

Everything follows from the metric alone. The ISCO is where the energy of circular orbits is least. u^t and u^phi come
from raising (-E, L), u^r from u.u = -1, and coordinate time and azimuth from quadrature of u^t/u^r and u^phi/u^r over
r.
"""

from mpmath import mp, mpf, nstr, quad, sqrt

mp.dps = 40
HOLES = [(a, 0.0) for a in (0.0, 0.5, 0.9, 0.998, -0.9, 0.9999)]
HOLES += [(0.0, 0.5), (0.0, 1 - 1e-4), (1e-3, 1e-3), (0.5, 0.6), (0.9, 0.4), (-0.9, 0.4), (0.3, 0.95), (-0.3, 0.95)]
HOLES += [(0.7, 0.713), (0.9, 1e-6)]
PLACES = [0.0625, 0.25, 0.5, 0.75, 0.96875, 0.9990234375]  # fractions of the way from the ISCO to the horizon
START = 0.03125


def metric(a, q, r):
    f = 2 / r - q * q / r**2
    return -1 + f, -a * f, r * r + a * a + a * a * f


def turning(a, q, r):
    """d(phi)/dt of a circular orbit, from the r-derivatives of the metric; and -u.u of this orbit for dt/dtau = 1."""
    f1 = -2 / r**2 + 2 * q * q / r**3
    tt, tp, pp = f1, -a * f1, 2 * r + a * a * f1
    w = (-tp + sqrt(tp * tp - tt * pp)) / pp
    tt, tp, pp = metric(a, q, r)
    return w, -(tt + 2 * tp * w + pp * w * w)


def circle(a, q, r):
    """E and L of a circular orbit."""
    w, norm2 = turning(a, q, r)
    tt, tp, pp = metric(a, q, r)
    return -(tt + tp * w) / sqrt(norm2), (tp + pp * w) / sqrt(norm2)


def bisect(f, low, high):
    """The place between low and high where f changes its sign from - to +."""
    for _ in range(130):
        middle = (low + high) / 2
        low, high = (middle, high) if f(middle) < 0 else (low, middle)
    return high


def isco(a, q):
    """The radius where dE/dr = 0, beyond the photon orbit, where u.u = 0."""
    step = mpf(10) ** -16
    slope = lambda r: circle(a, q, r * (1 + step))[0] - circle(a, q, r * (1 - step))[0]
    photon = bisect(lambda r: turning(a, q, r)[1], 1 + sqrt(1 - a * a - q * q), mpf(10))
    return bisect(slope, photon * (1 + 4 * step), mpf(10))


def velocity(a, q, r, energy, l):
    tt, tp, pp = metric(a, q, r)
    det = tt * pp - tp * tp
    ut, up = (-energy * pp - l * tp) / det, (energy * tp + l * tt) / det
    grr = r * r / (r * r - 2 * r + a * a + q * q)
    return ut, up, -sqrt((energy * ut - l * up - 1) / grr)


def main():
    print("/* Made by tests/oracle/plunge_reference.py; do not edit. Quadrature from the metric. */")
    print("#ifndef KD_TESTS_PLUNGE_REFERENCE_H\n#define KD_TESTS_PLUNGE_REFERENCE_H\n")
    print("/* t and phi from r0 to r; u^t, u^phi and u^r at r. */")
    print("struct plunge_reference { double a, q, r0, r, t, phi, ut, uphi, ur; };\n")
    print("static const struct plunge_reference plunge_reference[] = {")
    for spin, charge in HOLES:
        a, q = mpf(spin), mpf(charge)
        edge, horizon = isco(a, q), 1 + sqrt(1 - a * a - q * q)
        energy, l = circle(a, q, edge)
        start = mpf(float(edge - START * (edge - horizon)))
        for place in PLACES:
            r = mpf(float(edge - place * (edge - horizon)))
            middle = (start + r) / 2
            rate = lambda k: quad(
                lambda x: velocity(a, q, x, energy, l)[k] / velocity(a, q, x, energy, l)[2], [start, middle, r]
            )
            numbers = [rate(0), rate(1), *velocity(a, q, r, energy, l)]
            places = [float(x).hex() for x in (a, q, start, r)]
            print(f"    {{ {', '.join(places)}, /* {spin}, {charge}, {float(r):.6g} */")
            print(f"      {', '.join(nstr(x, 20) for x in numbers)} }},")
    print("};\n\n#endif")


if __name__ == "__main__":
    main()
