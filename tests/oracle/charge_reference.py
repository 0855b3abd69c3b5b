#!/usr/bin/env python3
"""Reference numbers for neutral matter about charged holes, to 40 digits, as the C table charge_reference.h.

python3 tests/oracle/charge_reference.py > tests/oracle/charge_reference.h      (needs mpmath)

Everything follows from the metric of Kerr and Newman in the equatorial plane, as in kerr_reference.py. Orbits: the
r-derivative of the metric, contracted with u, vanishes, and u.u = -1. The photon orbit is where u.u = 0; the ISCO is
where dE/dr = 0. The flux is the integral of Page & Thorne 1974 (eqs 11b and 12) by quadrature.
"""

import math

from mpmath import mp, mpf, pi, quad, sqrt

mp.dps = 40
HOLES = [
    (0.0, 0.5),
    (0.0, 0.9),
    (0.0, 1 - 1e-12),
    (0.3, 0.6),
    (-0.3, 0.6),
    (0.6, 0.3),
    (0.9, 1e-6),
    (0.9, 0.4),
    (-0.9, 0.4),
    (1e-6, 0.7),
    (0.5, 0.866),
    (0.7, 0.714),
    (0.8, 0.599999),
    (0.8, 0.5999999999999),
]
STRETCH = [1.0625, 1.25, 2.0, 4.0, 16.0, 1000.0]  # r over the ISCO
# The half disk a^2 + q^2 < 1, q > 0: values of a^2 + q^2, and the number of directions.
SIZES, DIRECTIONS = [0.04, 0.3, 0.6, 0.9, 0.99, 1 - 1e-4, 1 - 1e-6, 1 - 1e-9, 1 - 1e-12], 15


def metric(a, q, r):
    """g_tt, g_tphi, g_phiphi, and their first and second r-derivatives."""
    f, f1, f2 = 2 / r - q * q / r**2, -2 / r**2 + 2 * q * q / r**3, 4 / r**3 - 6 * q * q / r**4
    return (
        (-1 + f, -a * f, r * r + a * a + a * a * f),
        (f1, -a * f1, 2 * r + a * a * f1),
        (f2, -a * f2, 2 + a * a * f2),
    )


def omega(a, q, r):
    tt, tp, pp = metric(a, q, r)[1]
    return (-tp + sqrt(tp * tp - tt * pp)) / pp


def norm2(a, q, r):
    tt, tp, pp = metric(a, q, r)[0]
    w = omega(a, q, r)
    return -(tt + 2 * tp * w + pp * w * w)


def orbit(a, q, r):
    """W, E, L, u^t, dW/dr and dL/dr of the circular orbit."""
    (tt, tp, pp), (tt1, tp1, pp1), (tt2, tp2, pp2) = metric(a, q, r)
    w = omega(a, q, r)
    ut = 1 / sqrt(-(tt + 2 * tp * w + pp * w * w))
    momentum = (tp + pp * w) * ut
    dw = -(tt2 + 2 * tp2 * w + pp2 * w * w) / (2 * (tp1 + pp1 * w))
    dl = (tp1 + pp1 * w + pp * dw) * ut + momentum * ut**2 * (tp + pp * w) * dw
    return w, -(tt + tp * w) * ut, momentum, ut, dw, dl


def bisect(f, low, high):
    """The place between low and high where f changes sign; f is positive at `high`."""
    while high - low > mpf(10) ** (5 - mp.dps) * high:
        middle = (low + high) / 2
        if f(middle) > 0:
            high = middle
        else:
            low = middle
    return high


def places(a, q):
    horizon = 1 + sqrt(1 - a * a - q * q)
    photon = bisect(lambda r: norm2(a, q, r), horizon, mpf(20))
    return photon, bisect(lambda r: orbit(a, q, r)[5], photon * (1 + mpf(10) ** (12 - mp.dps)), mpf(20))


def flux(a, q, r, photon, isco):
    def share(x):
        w, energy, momentum, _, _, dl = orbit(a, q, x)
        return (energy - w * momentum) * dl

    # integrated in the logarithm of the distance from the photon orbit, where the integrand has a pole
    low, high = mp.log(isco - photon), mp.log(r - photon)
    edges = [low + (high - low) * i / 6 for i in range(7)]
    total = quad(lambda y: share(photon + mp.e**y) * mp.e**y, edges, method="gauss-legendre")
    w, energy, momentum, _, dw, _ = orbit(a, q, r)
    return -dw / (energy - w * momentum) ** 2 * total / (4 * pi * r)


def peak(a, q, photon, isco):
    """The radius at which the slope of the flux vanishes, to some 1e-17. The slope comes from differences over the
    distance from r = 1."""
    f, h = lambda y: flux(a, q, 1 + y, photon, isco), mpf(10) ** -9
    low, high = mp.log(isco - 1), mp.log(3 * isco - 1)
    while high - low > mpf(10) ** -18:
        middle = (low + high) / 2
        y = mp.e**middle
        if y * (1 - h) <= isco - 1 or f(y * (1 + h)) > f(y * (1 - h)):
            low = middle
        else:
            high = middle
    return 1 + mp.e**low


def advance(q, p, e):
    """Azimuth from periastron to periastron beyond a full turn, at a = 0. E^2 = f (1 + L^2 w^2) at both turning points,
    with f = 1 - 2w + q^2 w^2. The substitution w = m - d cos(chi) removes the factors of both turning points from
    the root. The rest of the integrand is regular."""
    w1, w2 = (1 - e) / p, (1 + e) / p
    f1, both, squares = 1 - 2 * w1 + q * q * w1 * w1, w1 + w2, w1 * w1 + w2 * w2
    # divided by w2 - w1, so that a circle needs no special case
    l2 = (2 - q * q * both) / (both - 2 * (squares + w1 * w2) + q * q * both * squares)
    rest = [q * q * l2, both * q * q * l2 - 2 * l2, (1 - f1 * (1 + l2 * w1 * w1)) / (w1 * w2)]

    def share(chi):
        w = both / 2 - (w2 - w1) / 2 * mp.cos(chi)
        return sqrt(l2 / (rest[2] + w * (rest[1] + w * rest[0])))

    return 2 * quad(share, [0, pi / 2, pi]) - 2 * pi


def bending(a, q, b):
    """Deflection of light of impact parameter b > 0 towards +phi in the plane, from the conserved E = 1 and L = b."""
    e, k = a * b + q * q, (b - a) ** 2
    # (dw/dlambda)^2, and its quotient by w0 - w, by Horner's scheme
    radial = [-q * q * k, 2 * k, a * a - b * b, mpf(0), mpf(1)]
    roots = mp.polyroots(radial if q else radial[1:], maxsteps=200, extraprec=400)
    w0 = min(mp.re(w) for w in roots if mp.re(w) > 0 and abs(mp.im(w)) < mpf(10) ** -30)
    quotient = [radial[0]]
    for c in radial[1:4]:
        quotient.append(quotient[-1] * w0 + c)

    def share(x):  # w = w0 (1 - x^2), so that the root at w0 becomes regular
        w = w0 * (1 - x * x)
        turn = b + a * (2 * w - e * w * w) / (1 - 2 * w + (a * a + q * q) * w * w)
        return 2 * turn * sqrt(w0 / -mp.polyval(quotient, w))

    return 2 * quad(share, [0, mpf(1) / 64, mpf(1) / 8, mpf(1) / 2, 1]) - pi


def text(x):
    return mp.nstr(x, 22)


def main():
    print("/* Made by tests/oracle/charge_reference.py; do not edit. Orbits and disks about charged holes. */")
    print("#ifndef KD_TESTS_CHARGE_REFERENCE_H\n#define KD_TESTS_CHARGE_REFERENCE_H\n")
    print("struct charge_place_reference { double a, q, photon, impact, isco, peak; };")
    print("struct charge_radius_reference { double a, q, photon, impact, isco; };")
    print("struct charge_orbit_reference { double a, q, r, omega, energy, momentum, ut, flux; };")
    print("struct charge_advance_reference { double q, p, e, advance; };")
    print("struct charge_bending_reference { double a, q, b, angle; };\n")
    print("static const struct charge_place_reference charge_place_reference[] = {")
    orbits = []
    for a, q in HOLES:
        x, y = mpf(a), mpf(q)
        photon, isco = places(x, y)
        numbers = [photon, 1 / omega(x, y, photon), isco, peak(x, y, photon, isco)]
        print(f"    {{ {a.hex()}, {q.hex()}, {', '.join(text(n) for n in numbers)} }},")
        for k in STRETCH:
            r = float(isco * k)
            w, energy, momentum, ut, _, _ = orbit(x, y, mpf(r))
            numbers = [w, energy, momentum, ut, flux(x, y, mpf(r), photon, isco)]
            orbits.append(f"    {{ {a.hex()}, {q.hex()}, {r.hex()}, {', '.join(text(n) for n in numbers)} }},")
    print("};\n\nstatic const struct charge_radius_reference charge_radius_reference[] = {")
    for size in SIZES:
        for k in range(DIRECTIONS):
            turn = math.pi * (k + 0.5) / DIRECTIONS
            a, q = math.sqrt(size) * math.cos(turn), math.sqrt(size) * math.sin(turn)
            x, y = mpf(a), mpf(q)
            photon, isco = places(x, y)
            numbers = [photon, 1 / omega(x, y, photon), isco]
            print(f"    {{ {a.hex()}, {q.hex()}, {', '.join(text(n) for n in numbers)} }},")
    print("};\n\nstatic const struct charge_orbit_reference charge_orbit_reference[] = {")
    print("\n".join(orbits) + "\n};\n\nstatic const struct charge_advance_reference charge_advance_reference[] = {")
    for q in [0, 1e-3, 0.3, 0.7, 0.95, 1 - 1e-9]:
        for p, e in [(6.7, 0.3), (6.25, 0.1), (8, 0.9), (20, 0), (1000, 0.5), (3.7e7, 0.2)]:
            q, p, e = float(q), float(p), float(e)
            print(f"    {{ {q.hex()}, {p.hex()}, {e.hex()}, {text(advance(mpf(q), mpf(p), mpf(e)))} }},")
    print("};\n\nstatic const struct charge_bending_reference charge_bending_reference[] = {")
    for a, q in [(0.0, 0.5), (0.0, 1 - 1e-9), (0.3, 0.6), (-0.3, 0.6), (0.9, 0.4), (-0.9, 0.4), (0.8, 0.599999)]:
        photon, _ = places(mpf(a), mpf(q))
        for factor in [1.001, 1.3, 3, 12, 1e3, 1e7]:
            b = float(factor / omega(mpf(a), mpf(q), photon))
            print(f"    {{ {a.hex()}, {q.hex()}, {b.hex()}, {text(bending(mpf(a), mpf(q), mpf(b)))} }},")
    print("};\n\n#endif")


if __name__ == "__main__":
    main()
