#!/usr/bin/env python3
"""Reference numbers for the bending of light in the equatorial plane of Kerr, as the C table deflection_reference.h.

python3 tests/oracle/deflection_reference.py > tests/oracle/deflection_reference.h      (needs mpmath)

Everything follows from the metric alone. dphi/dr is the ratio of two components of g^-1 p with p = (-1, p_r, b). The
closest approach is the largest root of g^-1 p p = 0 at p_r = 0. The angle is twice the integral from there to infinity,
less pi, by quadrature to 40 digits. The critical b is where that root is double, by a search over the radius.
"""

from kerr_reference import c, metric
from mpmath import mp, mpf, pi, polyroots, quad, sqrt

mp.dps = 50
SPINS = [0.0, 0.5, -0.5, 0.9, -0.9, 0.99, 0.9999, -0.9999]
EXCESS = [1e-9, 1e-6, 1e-3, 0.1, 0.9]  # relative excess of b over the critical b
FAR = [12.0, 19.5, 20.5, 30.0, 1e3, 1e6, 1e12]


def inverse(a, r):
    """g^tt, g^tphi, g^phiphi, g^rr."""
    tt, tp, pp = metric(a, r)[0]
    det = tt * pp - tp * tp
    return pp / det, -tp / det, tt / det, -det / r**2


def impact(a, r):
    """The b > 0 for which the ray turns at r. Of the two roots, the one that stays finite through the ergosphere is
    returned."""
    tt, tp, pp, _ = inverse(a, r)
    return tt / (tp - sqrt(tp * tp - tt * pp))


def critical(a):
    """The smallest b with a turning point, by golden section over the radius. The minimum is flat, so that b has twice
    as many digits as the radius."""
    low, high, golden = 1 + sqrt(1 - a * a) + mpf(10) ** -9, mpf(6), (sqrt(mpf(5)) - 1) / 2
    for _ in range(130):
        x, y = high - golden * (high - low), low + golden * (high - low)
        if impact(a, x) < impact(a, y):
            high = y
        else:
            low = x
    return impact(a, (low + high) / 2)


def bending(a, b):
    """The angle, and the closest approach."""
    # r^3 times the radial equation, written out: r^3 + (a^2 - b^2) r + 2 (a - b)^2
    r0 = max((x.real for x in polyroots([1, 0, a * a - b * b, 2 * (a - b) ** 2], maxsteps=200, extraprec=200)))
    tt, tp, pp, _ = inverse(a, r0)
    assert abs(tt - 2 * b * tp + b * b * pp) < mpf(10) ** -25 * abs(tt)

    def rate(x):
        """dphi/dx, r = r0/(1 - x^2): removes the root at the turning point."""
        r = r0 / (1 - x * x)
        tt, tp, pp, rr = inverse(a, r)
        radial = -(tt - 2 * b * tp + b * b * pp) * rr
        return (b * pp - tp) / sqrt(radial) * 2 * x * r0 / (1 - x * x) ** 2

    # close to the critical ray, most of the angle comes from x near 0
    edges = [mpf(0)] + [mpf(10) ** -k for k in range(5, 0, -1)] + [mpf("0.4"), mpf("0.7"), mpf(1)]
    return 2 * quad(rate, edges, method="gauss-legendre") - pi, r0


def main():
    print("/* Made by tests/oracle/deflection_reference.py; do not edit. Quadrature from the metric. */")
    print("#ifndef KD_TESTS_DEFLECTION_REFERENCE_H\n#define KD_TESTS_DEFLECTION_REFERENCE_H\n")
    print(
        "struct critical_reference { double a, b; };\nstruct bending_reference { double a, b, excess, angle, closest; };\n"
    )
    limits = {a: critical(mpf(a)) for a in SPINS}
    print("static const struct critical_reference critical_reference[] = {")
    for a in SPINS:
        print("    { %s, %s }," % (a.hex(), c(limits[a])))
    print("};\n\nstatic const struct bending_reference bending_reference[] = {")
    for a in SPINS:
        for b in [float(limits[a]) * (1 + x) for x in EXCESS] + FAR:
            angle, r0 = bending(mpf(a), mpf(b))
            print("    { %s, %s, %.6e, %s, %s }," % (a.hex(), b.hex(), b / limits[a] - 1, c(angle), c(r0)))
    print("};\n\n#endif")


if __name__ == "__main__":
    main()
