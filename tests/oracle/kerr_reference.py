#!/usr/bin/env python3
"""Reference numbers for circular equatorial orbits of Kerr, to 50 digits, as the C table kerr_reference.h.

python3 tests/oracle/kerr_reference.py > tests/oracle/kerr_reference.h      (needs mpmath)

No formula of Bardeen, Press & Teukolsky is used. Everything follows from the metric alone. The angular velocity is that
of a circular geodesic: the r-derivative of the metric, contracted with u, vanishes. u^t follows from u.u = -1. The
photon orbit is where u.u = 0, and the marginally bound orbit where -u_t = 1. At the ISCO the radial potential R =
(E(r^2 + a^2) - aL)^2 - Delta (r^2 + (L - aE)^2) has R = R' = R'' = 0. Roots are found by bisection on a sign, so that a
triple root near a = 1 costs only digits of the working precision.
"""

from mpmath import mp, mpf, sqrt

mp.dps = 60
SPINS = [-(1 - 1e-12), -0.998, -0.9, -0.5, -2e-4, -1e-9, 0.0, 1e-9, 2e-4, 0.5, 0.9, 0.998, 0.9999, 1 - 1e-12]


def metric(a, r):
    """g_tt, g_tphi, g_phiphi in the plane, and their r-derivatives (Boyer-Lindquist)."""
    return (
        (-1 + 2 / r, -2 * a / r, r * r + a * a + 2 * a * a / r),
        (-2 / r**2, 2 * a / r**2, 2 * r - 2 * a * a / r**2),
    )


def omega(a, r):
    """The root of g_tt' + 2 g_tphi' W + g_phiphi' W^2 = 0 for an orbit towards +phi."""
    tt, tp, pp = metric(a, r)[1]
    return (-tp + sqrt(tp * tp - tt * pp)) / pp


def norm2(a, r):
    """-(1, 0, 0, W).g.(1, 0, 0, W), which is positive where the circle is timelike."""
    tt, tp, pp = metric(a, r)[0]
    w = omega(a, r)
    return -(tt + 2 * tp * w + pp * w * w)


def orbit(a, r):
    """W, E, L and u^t of the circular orbit."""
    tt, tp, pp = metric(a, r)[0]
    w, ut = omega(a, r), 1 / sqrt(norm2(a, r))
    return w, -(tt + tp * w) * ut, (tp + pp * w) * ut, ut


def curvature(a, r, energy, momentum):
    """R, R', R'' of the radial potential as a polynomial c4 r^4 + 2 r^3 + c2 r^2 + c1 r."""
    k = (momentum - a * energy) ** 2
    c4, c2, c1 = energy**2 - 1, a * a * (energy**2 - 1) - momentum**2, 2 * k
    return (
        c4 * r**4 + 2 * r**3 + c2 * r**2 + c1 * r,
        4 * c4 * r**3 + 6 * r**2 + 2 * c2 * r + c1,
        12 * c4 * r**2 + 12 * r + 2 * c2,
    )


def bisect(f, low, high):
    """The place where f changes from positive (at low) to negative."""
    assert f(high) < 0, (low, high)
    while (high - low) > mpf(10) ** (15 - mp.dps) * high:
        middle = (low + high) / 2
        if f(middle) > 0:
            low = middle
        else:
            high = middle
    return (low + high) / 2


def orbits(a):
    """Radii of the photon orbit, the marginally bound orbit, and the ISCO."""
    horizon = 1 + sqrt((1 - a) * (1 + a))
    photon = bisect(lambda r: -norm2(a, r), horizon, mpf(20))
    bound = bisect(lambda r: orbit(a, r)[1] - 1, photon, mpf(20))
    isco = bisect(lambda r: curvature(a, r, *orbit(a, r)[1:3])[2], photon, mpf(20))
    residual = curvature(a, isco, *orbit(a, isco)[1:3])
    assert max(abs(x) for x in residual) < mpf(10) ** (25 - mp.dps), residual
    return photon, bound, isco


def c(x):
    return mp.nstr(x, 20, min_fixed=0, max_fixed=0)


def main():
    print(
        "/* Made by tests/oracle/kerr_reference.py; do not edit. Circular equatorial orbits from the metric alone. */"
    )
    print("#ifndef KD_TESTS_KERR_REFERENCE_H\n#define KD_TESTS_KERR_REFERENCE_H\n")
    print(
        "struct kerr_reference { double a, horizon, photon, bound, isco, isco_energy, isco_momentum, isco_omega; };\n"
    )
    print("static const struct kerr_reference kerr_reference[] = {")
    for spin in SPINS:
        a = mpf(spin)
        photon, bound, isco = orbits(a)
        w, energy, momentum, _ = orbit(a, isco)
        row = [1 + sqrt((1 - a) * (1 + a)), photon, bound, isco, energy, momentum, w]
        print("    { %s," % float(spin).hex() + " /* %.17g */" % spin)
        print("      " + ", ".join(map(c, row[:4])) + ",\n      " + ", ".join(map(c, row[4:])) + " },")
    print("};\n\n/* A circular orbit at r: angular velocity, energy, angular momentum, u^t. */")
    print("struct orbit_reference { double a, r, omega, energy, momentum, ut; };\n")
    print("static const struct orbit_reference orbit_reference[] = {")
    for spin in SPINS:
        a = mpf(spin)
        photon, _, isco = orbits(a)
        for r in (float((photon + isco) / 2), float(isco) * 1.0625, 10.0, 100.0, 1e6):
            row = orbit(a, mpf(r))
            print("    { %s, %s," % (float(spin).hex(), r.hex()) + "\n      " + ", ".join(map(c, row)) + " },")
    print("};\n\n#endif")


if __name__ == "__main__":
    main()
