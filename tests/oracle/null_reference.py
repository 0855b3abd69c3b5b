#!/usr/bin/env python3
"""Reference numbers, to 20 digits, as C tables: crossings of null geodesics of Kerr, and elliptic integrals.

python3 tests/oracle/null_reference.py rays > tests/oracle/null_reference.h          (needs mpmath; a minute each)
python3 tests/oracle/null_reference.py extremes > tests/oracle/null_extremes.h       (ten minutes)
python3 tests/oracle/null_reference.py integrals > tests/oracle/carlson_reference.h
python3 tests/oracle/null_reference.py close > tests/oracle/null_close.h              (two minutes)

The rays are not found in closed form. These are the equations of motion in Mino time, with w = 1/r and the unit vector
n of the direction in the spheroidal angles:

w'' = A w + 3K w^2 + 2C w^3        n'' = a^2 n_z z - (eta + lambda^2 + 2 a^2 n_z^2) n
chi' = a (2r - a lambda)/Delta     t' = r^2 + 2r + 4 + ((8 - 2 a lambda) r - 4a^2)/Delta + a^2 n_z^2

They are solved by Taylor series, for which turning points and the axis are not special. A crossing is a root of the
series of n_z. Instead of t, S = t +- (r + 2 ln r) is integrated, with + on the way in and - on the way out, because S
stays finite at infinity. The radial first integral is checked after each step. The elliptic integrals are quadratures
of their definitions.
"""

import sys
from multiprocessing import Pool

from mpmath import asinh, atan2, cos, findroot, inf, log, mp, mpf, pi, polyroots, polyval, quad, sin, sqrt

mp.dps = 38
ORDER = 38


def mul(x, y, k):
    return mp.fdot((x[j], y[k - j]) for j in range(k + 1))


def divide(x, y):
    q = []
    for k in range(len(x)):
        q.append((x[k] - mp.fdot((q[j], y[k - j]) for j in range(k))) / y[0])
    return q


def series(a, lam, eta, state, side, q2=0):
    """Taylor coefficients about a point of (w, n_x, n_y, n_z, chi, S)."""
    A, K = a * a - eta - lam * lam, eta + (lam - a) ** 2
    C = -a * a * eta - q2 * K
    w, dw, n, dn, chi, S = state
    W = [w, dw]
    N = [[n[i], dn[i]] for i in range(3)]
    W2, W3, Z2 = [], [], []
    for k in range(ORDER):
        W2.append(mul(W, W, k))
        W3.append(mul(W2, W, k))
        Z2.append(mul(N[2], N[2], k))
        if k < ORDER - 1:
            W.append((A * W[k] + 3 * K * W2[k] + 2 * C * W3[k]) / ((k + 1) * (k + 2)))
            for i in range(3):
                pull = (eta + lam * lam) * N[i][k] + 2 * a * a * mul(Z2, N[i], k)
                N[i].append(((a * a * N[2][k] if i == 2 else 0) - pull) / ((k + 1) * (k + 2)))
    V = [(k + 1) * W[k + 1] for k in range(len(W) - 1)]  # w'
    # chi' = a w (2 - a lam w)/(1 - 2w + a^2 w^2); the last terms of t' = w (8 - 2 a lam - 4 a^2 w)/(same);
    # (1 - side w')(1/w^2 + 2/w) = -(A + 2K w + C w^2)(1 + 2w)/(1 + side w')
    count = len(V)
    # with charge 2r - q^2 replaces 2r everywhere
    den = [(k == 0) - 2 * W[k] + (a * a + q2) * W2[k] for k in range(count)]
    P = divide([a * (2 * W[k] - (a * lam + q2) * W2[k]) for k in range(count)], den)
    rest = 4 * a * a + q2 * (4 - q2 - a * lam)
    Q = divide([(8 - 4 * q2 - 2 * a * lam) * W[k] - rest * W2[k] for k in range(count)], den)
    top = [-(A * (k == 0) + (2 * K + 2 * A) * W[k] + (C + 4 * K) * W2[k] + 2 * C * W3[k]) for k in range(count)]
    G = divide(top, [(k == 0) + side * V[k] for k in range(count)])
    chi_s = [chi] + [P[k] / (k + 1) for k in range(count)]
    S_s = [S] + [((4 - q2) * (k == 0) + Q[k] + G[k] + a * a * Z2[k]) / (k + 1) for k in range(count)]
    return W, N, chi_s, S_s


def at(c, h):
    return polyval(c[::-1], h)


def slope(c, h):
    return polyval([k * c[k] for k in range(len(c) - 1, 0, -1)], h)


def trace(a, u, radius, alpha, beta, outward, orders, q=0):
    """Crossings (r, phi, delay, sense), whether the ray is captured, and (cos theta, phi) of the escape."""
    a, u, alpha, beta = mpf(a), mpf(u), mpf(alpha), mpf(beta)
    s = sqrt((1 - u) * (1 + u))
    lam, eta = -alpha * s, (alpha**2 - a * a) * u * u + beta**2
    q2 = mpf(q) ** 2
    A, K = a * a - eta - lam * lam, eta + (lam - a) ** 2
    C = -a * a * eta - q2 * K
    w = mpf(0) if radius == inf else 1 / mpf(radius)
    dw = sqrt(1 + A * w * w + 2 * K * w**3 + C * w**4) * (-1 if outward else 1)
    n, dn = [s, mpf(0), u], [-beta * u, alpha, beta * s]
    phi = mpf(0)
    # azimuths count from the direction in the image, so the frame is turned such that the ray starts along +x
    if s == 0:
        phi = atan2(alpha, -beta * u)
        dn = [sqrt(alpha**2 + beta**2), mpf(0), mpf(0)]
    side = -1 if outward else 1
    S = side * (1 / w - 2 * log(w)) if w else mpf(0)  # at infinity r + 2 ln r is subtracted
    state = (w, dw, n, dn, mpf(0), S)
    horizon = 1 / (1 + sqrt(1 - a * a - q2))
    turn = mpf(0)  # azimuth of n about the axis, not reduced to a turn
    found = []
    scale = 1 / sqrt(1 + eta + lam * lam + a * a)
    for _ in range(4000):
        if side != (1 if dw > 0 else -1):
            side = -side
            state = state[:5] + (state[5] + side * 2 * (1 / w - 2 * log(w)),)
        W, N, X, T = series(a, lam, eta, state, side, q2)
        # estimate of the radius of convergence, from the last coefficients
        rho = min(
            (max(abs(c[k]) for c in (W, X, T) for k in (j, j - 1)) + mpf(10) ** -60) ** (mpf(-1) / j)
            for j in (ORDER - 4, ORDER - 12)
        )
        h = min(rho / 6, scale)
        here = N[2][0]
        ends = None
        w1 = at(W, h)
        if w1 <= 0:
            ends = findroot(lambda x: at(W, x), (mpf(0), h), solver="anderson", tol=mpf(10) ** -60)
            h = ends
        elif w1 >= horizon * (1 - mpf(10) ** -8) or (w > horizon * (1 - mpf(10) ** -8) and dw > 0):
            return found, True, None  # the azimuth diverges at the horizon, so steps become shorter there
        if here != 0 and here * at(N[2], h) < 0:
            x = findroot(lambda x: at(N[2], x), (mpf(0), h), solver="anderson", tol=mpf(10) ** -60)
            if len(found) < orders:
                rotation = turned(N, x)
                r = 1 / at(W, x)
                delay = at(T, x) - side * (r + 2 * log(r))
                found.append((r, phi + turn + rotation - at(X, x), delay, 1 if slope(W, x) > 0 else -1))
        rotation = turned(N, h)
        turn += rotation
        state = (
            at(W, h),
            slope(W, h),
            [at(N[i], h) for i in range(3)],
            [slope(N[i], h) for i in range(3)],
            at(X, h),
            at(T, h),
        )
        w, dw = state[0], state[1]
        check = dw * dw - (1 + A * w * w + 2 * K * w**3 + C * w**4)
        if abs(check) > mpf(10) ** -24:
            raise ArithmeticError(f"first integral {check}")
        if ends is not None:
            return found, False, (state[2][2], phi + turn - state[4])
    raise ArithmeticError("no end")


def turned(N, h):
    """The angle by which n turns about the axis in a step, traced backwards: -Int lam / sin^2."""
    x0, y0, x1, y1 = N[0][0], N[1][0], at(N[0], h), at(N[1], h)
    return atan2(x0 * y1 - y0 * x1, x0 * x1 + y0 * y1) if (x0 or y0) else atan2(y1, x1)


EXACT = {0: mpf(1), 90: mpf(0), 180: mpf(-1)}


def cosine(i):
    return EXACT[i] if i in EXACT else mpf(float(cos(mpf(i) * pi / 180)))


INF = inf
RAYS = [  # spin, inclination, radius, alpha, beta, outward
    # Schwarzschild, direct and lensed
    (0.0, 0, INF, 8.0, 0.0, 0),
    (0.0, 0, INF, 3.0, 4.5, 0),
    (0.0, 17, INF, -6.0, 1.5, 0),
    (0.0, 45, INF, 5.0, -2.5, 0),
    (0.0, 70, INF, -5.2, 0.25, 0),
    (0.0, 90, INF, 5.25, 0.125, 0),
    (0.0, 135, INF, 4.0, 5.0, 0),
    (0.0, 180, INF, 0.0, 5.5, 0),
    # a small spin: 1e-9, 1e-4, both signs
    (1e-9, 45, INF, 5.0, -2.5, 0),
    (-1e-9, 45, INF, 5.0, -2.5, 0),
    (1e-4, 70, INF, -5.2, 0.25, 0),
    # moderate and fast spin, all inclinations
    (0.5, 17, INF, 3.0, 5.0, 0),
    (0.5, 45, INF, -5.5, -3.0, 0),
    (0.5, 70, INF, 5.5, 1.0, 0),
    (0.5, 135, INF, 5.0, 3.0, 0),
    (0.9, 0, INF, 5.0, 3.0, 0),
    (0.9, 0, INF, 0.0, 6.0, 0),
    (0.9, 0, INF, -4.0, 0.0, 0),
    (0.9, 180, INF, 5.0, 3.0, 0),
    (0.9, 17, INF, -4.9, 0.5, 0),
    (0.9, 45, INF, -3.0, 4.0, 0),
    (0.9, 45, INF, 6.0, -1.0, 0),
    (0.9, 70, INF, -3.75, 1.0, 0),
    (0.9, 70, INF, 12.0, 3.0, 0),
    (0.9, 70, INF, 6.5, 0.5, 0),
    (0.9, 70, INF, 2.0, -5.0, 0),
    (0.9, 90, INF, 5.0, 4.0, 0),
    (0.9, 90, INF, 6.0, -2.0, 0),
    (0.9, 90, INF, -3.0, -1.0, 0),
    (0.9, 135, INF, -4.0, 3.0, 0),
    (0.9, 135, INF, 1.0, -6.0, 0),
    # the turning point of theta, the axis and its neighbourhood
    (0.9, 70, INF, 6.0, 0.0, 0),
    (0.9, 110, INF, -4.5, 0.0, 0),
    (0.9, 45, INF, 0.0, 5.5, 0),
    (0.9, 70, INF, 0.0, -5.0, 0),
    (0.9, 70, INF, 1e-3, 5.0, 0),
    (0.9, 70, INF, -1e-7, 5.0, 0),
    (-0.9, 135, INF, 0.0, -6.0, 0),
    # retrograde
    (-0.9, 17, INF, 6.0, 2.0, 0),
    (-0.9, 70, INF, -6.0, 1.0, 0),
    (-0.9, 70, INF, 4.0, -3.0, 0),
    (-0.9, 90, INF, 3.5, 2.0, 0),
    # near maximal
    (0.998, 45, INF, -1.8, 1.1, 0),
    (0.998, 70, INF, -2.5, 1.25, 0),
    (0.9999, 70, INF, -2.25, 1.0, 0),
    (0.9999, 17, INF, 4.0, 3.0, 0),
    (0.9999, 90, INF, 6.0, 3.0, 0),
    (0.9999, 135, INF, 5.0, -3.0, 0),
    # far from the hole; almost edge-on
    (0.5, 70, INF, 300.0, 200.0, 0),
    (0.9, 89, INF, 5.0, -4.0, 0),
    (0.9, 60, INF, -40.0, -25.0, 0),
    # eta just above 0, and vortical: no crossing
    (0.9, 60, INF, 0.25, 0.5, 0),
    (0.9, 60, INF, 0.875, 0.125, 0),
    (0.9, 45, INF, 0.125, 0.25, 0),
    # in the equatorial plane
    (0.9, 90, INF, 7.5, 0.0, 0),
    # an observer nearby, tracing inwards
    (0.9, 70, 50.0, 6.0, 2.0, 0),
    (0.9, 70, 1000.0, -5.0, -3.0, 0),
    (0.0, 45, 20.0, 5.0, 3.0, 0),
    (0.9999, 17, 6.0, 2.0, 4.0, 0),
    (-0.9, 90, 12.0, 3.0, -5.0, 0),
    (0.9, 0, 10.0, 4.0, 3.0, 0),
    (0.5, 120, 1e6, 4.0, 4.0, 0),
    # starting outwards: escaping, or turned back below the photon sphere
    (0.9, 70, 4.0, 1.0, 3.0, 1),
    (0.5, 45, 10.0, 5.0, -4.0, 1),
    (0.0, 60, 2.5, 4.0, 3.5, 1),
    (0.9, 70, 2.25, 4.5, 3.75, 1),
    (0.0, 60, 2.5, 4.0, 3.5, 0),
    (0.9, 70, 2.25, 4.5, 3.75, 0),
    (0.9, 60, 5.0, 0.25, 0.125, 1),
    (0.5, 0, 3.0, 1.0, 1.0, 1),
    (0.9, 80, 8.0, 0.0, 0.125, 1),
    (0.9, 70, 3.0, 6.5, 0.5, 1),
    (0.9, 70, 3.0, 6.5, 0.5, 0),
    (-0.9, 110, 3.125, -6.5, 0.75, 1),
    (0.9, 60, 5.0, -0.375, 0.25, 1),
    (0.9, 60, 5.0, -0.5, -0.125, 1),
    (0.998, 20, 1.5, 0.25, -0.25, 1),
    # 1e-3, 1e-6, 1e-10 inside and outside the critical curve
    (0.0, 45, INF, 4.1527650162271401, 3.1145737621703553, 0),
    (0.0, 45, INF, 4.1610788601034701, 3.1208091450776028, 0),
    (0.0, 45, INF, 4.1569260950872433, 3.1176945713154325, 0),
    (0.0, 45, INF, 4.1569219377496127, 3.1176914533122098, 0),
    (0.9, 70, INF, 5.8338642697626328, -2.9169321348813164, 0),
    (0.9, 70, INF, 5.8455436777101051, -2.9227718388550525, 0),
    (0.9, 70, INF, 5.8396981340323952, -2.9198490670161976, 0),
    (0.9, 70, INF, 5.8397039743203392, -2.9198519871601696, 0),
    (0.9, 20, INF, 5.4191935035892858, 1.3547983758973214, 0),
    (0.9, 20, INF, 5.413785137645144, 1.353446284411286, 0),
    (0.9, 20, INF, 5.4137797233240432, 1.3534449308310108, 0),
    (-0.9, 120, INF, 1.8102807157584875, 3.620561431516975, 0),
    (-0.9, 120, INF, 1.8120946206598629, 3.6241892413197259, 0),
    (-0.9, 120, INF, 1.8120928083858452, 3.6241856167716904, 0),
]


def critical(a, i, r, distance):
    """The image of the bound orbit of radius r (Bardeen 1973, eqs. 48, 49), moved away from the centre by a fraction of
    its distance."""
    a, r, u = mpf(a), mpf(r), cosine(i)
    s, delta = sqrt(1 - u * u), r * r - 2 * r + a * a
    if a == 0:
        alpha, beta = 3, sqrt(mpf(18))
    else:
        lam = a + r / a * (r - 2 * delta / (r - 1))
        eta = r**3 / a**2 * (4 * delta / (r - 1) ** 2 - r)
        alpha, beta = -lam / s, sqrt(eta + u * u * (a * a - lam * lam / s**2))
    return a, i, INF, float(alpha * (1 + mpf(distance))), float(beta * (1 + mpf(distance))), 0


def extremes():
    """Rays of eight orders: spins and inclinations at the ends of their ranges, observers from next to the horizon to a
    million M away, and rays 1e-3 to 1e-12 from the critical curve."""
    below, above = 89.99999999999999, 90.00000000000001
    rays = []
    for what, a in (("a 1-1e-7", 1 - 1e-7), ("a 1-1e-12", 1 - 1e-12), ("a -1+1e-12", 1e-12 - 1)):
        horizon = float((1 + sqrt(1 - mpf(a) ** 2)) * mpf("1.0001"))
        rays += [
            (what, ray)
            for ray in (
                (a, 45, INF, 3.0, 4.0, 0),
                (a, below, INF, -3.0, 2.0, 0),
                (a, above, INF, 6.0, -2.0, 0),
                (a, 0, INF, 5.0, 3.0, 0),
                (a, 60, horizon, 0.25, 0.25, 1),
                (a, 60, horizon, -1.5, 0.5, 1),
                (a, 60, horizon, 1.5, 0.5, 0),
                (a, 60, 4.0, 3.0, 3.0, 0),
                (a, 60, 4.0, 3.0, -3.0, 1),
                (a, 60, 1e6, 4.0, -3.0, 0),
                (a, 90, 1e6, -6.0, 1.0, 0),
            )
        ]
    rays += [
        ("i 90-, 90+", ray)
        for ray in ((5e-324, 45, INF, 5.0, -2.5, 0), (5e-324, below, INF, 4.0, 4.0, 0), (0.9, above, INF, -4.0, 2.0, 0))
    ]
    for d in (1e-3, -1e-6, 1e-9, -1e-12):
        rays += [
            (f"b/bc 1{d:+.0e}", critical(a, i, r, d))
            for a, i, r in (
                (0.0, 60, 3),
                (0.9, 60, 2.5),
                (1 - 1e-7, 60, 2),
                (1 - 1e-12, 60, 2),
                (1 - 1e-12, 80, 1.25),
                (1e-12 - 1, 75, 3),
            )
        ]
    return rays


def number(x):
    return "INFINITY" if x == inf else "NAN" if x != x else mp.nstr(x, 21, min_fixed=-3, max_fixed=9)


def extreme_line(named):
    return f'    {{ "{named[0]}",\n  ' + ray_line(named[1], 8)[5:]


def ray_line(spec, orders=4):
    a, i, radius, alpha, beta, outward = spec
    u = cosine(i)
    found, captured, sky = trace(a, u, radius, alpha, beta, outward, orders)
    sky = sky or (mpf("nan"), mpf("nan"))
    rows = ",\n        ".join(f"{{ {number(r)}, {number(f)}, {number(t)}, {s} }}" for r, f, t, s in found)
    head = (
        f"{float(a)!r}, {number(radius)}, {float(u).hex()}, {float(alpha)!r}, {float(beta)!r}, {outward}, /* i = {i} */"
    )
    body = f"\n      {len(found)}, {{ {rows} }}," if found else "\n      0, { { 0 } },"
    return f"    {{ {head}{body}\n      {int(captured)}, {number(sky[0])}, {number(sky[1])} }},"


def cross_table():
    print(
        "struct null_reference_crossing { double r, phi, delay; int sense; };\n"
        "struct null_reference {\n    double spin, radius, cos_theta, alpha, beta;\n    int outward, crossings;\n"
        "    struct null_reference_crossing crossing[4];\n    int captured;\n    double sky_u, sky_phi;\n};\n"
    )
    print("static const struct null_reference null_reference[] = {")
    with Pool(2) as pool:
        for line in pool.imap(ray_line, RAYS):
            print(line, flush=True)
    print("};\n")


def extreme_table():
    print(
        "struct null_extreme {\n    const char *what;\n    double spin, radius, cos_theta, alpha, beta;\n    int outward, crossings;\n"
        "    struct { double r, phi, delay; int sense; } crossing[8];\n"
        "    int captured;\n    double sky_u, sky_phi;\n};\n"
    )
    print("static const struct null_extreme null_extremes[] = {")
    with Pool(2) as pool:
        for line in pool.imap(extreme_line, extremes()):
            print(line, flush=True)
    print("};\n")


def radial(a, q, lam, eta, begin, end):
    """Differences of Mino time, azimuth and time between two radii, by quadrature in ln(r - r+). If `end` is None, up
    to the root r3, by quadrature in s with s^2 = r3 - r. Returns None if a root lies between the radii, or if r3 is not
    beyond `begin`."""
    k = eta + (lam - a) ** 2
    lead, last = a * a - eta - lam * lam, -a * a * eta - q * q * k
    found = polyroots([1, 0, lead, 2 * k, last], 300, extraprec=300)
    roots = sorted(r.real for r in found if abs(r.imag) < mpf(10) ** -30)

    def rates(r):
        delta, out = (r - 1) ** 2 - (1 - a * a - q * q), r * r + a * a
        return 1, a * (2 * r - q * q - a * lam) / delta, out * (out - a * lam) / delta + a * lam - a * a

    if end is not None:
        if any(begin <= r <= end for r in roots):
            return None
        horizon = 1 + sqrt(1 - a * a - q * q)
        ends = log(begin - horizon), log(end - horizon)
        pieces = int(ends[1] - ends[0]) + 1
        bounds = [ends[0] + (ends[1] - ends[0]) * mpf(i) / pieces for i in range(pieces + 1)]
        speed = lambda r: sqrt(polyval([1, 0, lead, 2 * k, last], r)) / (r - horizon)
        return [quad(lambda x, i=i: rates(horizon + mp.e**x)[i] / speed(horizon + mp.e**x), bounds) for i in range(3)]
    if len(roots) < 4 or roots[2] <= begin:
        return None
    r1, r2, r3, r4 = roots
    bounds = [sqrt(r3 - begin) * mpf(i) / 8 for i in range(9)]
    rest = lambda r: 2 / sqrt((r - r1) * (r - r2) * (r4 - r))
    return [quad(lambda s, i=i: rates(r3 - s * s)[i] * rest(r3 - s * s), bounds) for i in range(3)]


def close_table():
    """Radial integrals about holes whose horizons are close. Rays: some that are captured, some that turn, one that
    starts outwards within the photon orbits and turns back (INNER), and vortical rays without real roots."""
    print("/* Integrals from r to `end` (0: to r3). */")
    print("struct null_close { double a, q, cos_theta, alpha, beta, r, end, tau, phi, t; };\n")
    print("static const struct null_close null_close[] = {")
    for root in (1e-6, 1e-4, 0.02):
        for turn in (0, 0.7, -0.6):
            size = sqrt(mpf(1) - mpf(root) ** 2)
            a, q = float(size * cos(turn)), float(abs(size * sin(turn)))
            for u, alpha, beta, r, end in (
                (0.5, 1.5, 0.5, 1.02 + root, 100.0),
                (0.5, -2.0, 1.5, 1 + 2 * root, 100.0),
                (0.2, 7.0, 3.0, 10.0, 100.0),
                (0.2, -9.0, 1.0, 10.0, 100.0),
                (0.5, 4.5, 6.5, 1.1, 0.0),
                (0.5, -9.0, -0.5, 1.5, 0.0),
                (0.999, 0.01, 0.005, 1.05, 100.0),
                (0.99, 0.1, 0.05, 1 + 3 * root, 100.0),
            ):
                A, Q, U = mpf(a), mpf(q), mpf(u)
                lam = -mpf(alpha) * sqrt(1 - U * U)
                eta = (mpf(alpha) ** 2 - A * A) * U * U + mpf(beta) ** 2
                found = radial(A, Q, lam, eta, mpf(r), mpf(end) if end else None)
                if not found:
                    continue
                tau, phi, t = found
                print(
                    f"    {{ {a!r}, {q!r}, {u!r}, {alpha!r}, {beta!r}, {r!r}, {end!r},\n"
                    f"      {number(tau)}, {number(phi)}, {number(t)} }},",
                    flush=True,
                )
    print("};\n\n/* (f(p) - f(q))/(p - q) for f = R_J(x, y, z, .) and f = R_C(1, .). */")
    print("struct carlson_slope { double x, y, z, p, q, rj, rc; };\n")
    print("static const struct carlson_slope carlson_slopes[] = {")
    for x, y, z in ((1, 2, 3), (0.5, 1, 0), (1e-3, 1e3, 1)):
        for p in (1e-3, 0.7, 1.0, 5.0, 1e4):
            for change in (0, -1e-9, 0.4, 40):
                p_, q_ = mpf(p), mpf(p * (1 + change))
                slope = -3 * half_line(lambda t: 1 / ((t + p_) * (t + q_) * sqrt((t + x) * (t + y) * (t + z)))) / 2
                rc = -half_line(lambda t: 1 / ((t + p_) * (t + q_) * sqrt(t + 1))) / 2
                print(
                    f"    {{ {float(x)!r}, {float(y)!r}, {float(z)!r}, {p!r}, {float(q_)!r}, {number(slope)}, {number(rc)} }},"
                )
    print("};\n")


def half_line(f):
    """Int_0^inf of f, with the substitution t = e^x."""
    return quad(lambda x: f(mp.e**x) * mp.e**x, [-inf, -100, -30, -10, 0, 10, 30, 100, inf])


def rf(x, y, z):
    return half_line(lambda t: 1 / sqrt((t + x) * (t + y) * (t + z))) / 2


def rj(x, y, z, p):
    return 3 * half_line(lambda t: 1 / ((t + p) * sqrt((t + x) * (t + y) * (t + z)))) / 2


def carlson_table():
    triples = [
        (1, 2, 3),
        (0.5, 1, 0),
        (2, 3, 4),
        (1e-6, 1, 2),
        (1, 1, 1),
        (1e-3, 1e3, 1),
        (0.25, 0.25, 8),
        (1e-10, 2e-10, 1),
    ]
    print(
        "/* R_F(x, y, z), R_D(x, y, z), R_J(x, y, z, p). */\n"
        "struct carlson_reference { double x, y, z, p, rf, rd, rj; };\n\nstatic const struct carlson_reference carlson_reference[] = {"
    )
    for x, y, z in triples:
        for p in (0.125, 1.0, 5.0, 1e4):
            X, Y, Z, P = mpf(x), mpf(y), mpf(z), mpf(p)
            rd = inf if z == 0 else rj(X, Y, Z, Z)
            print(
                f"    {{ {float(x)!r}, {float(y)!r}, {float(z)!r}, {p!r}, {number(rf(X, Y, Z))}, {number(rd)}, {number(rj(X, Y, Z, P))} }},"
            )
    print(
        "};\n\n/* The same for x and y +- i v: R_F(x, y +- iv), R_J(x, y +- iv, p), R_D(y +- iv, x). */\n"
        "static const struct { double x, y, v, p, rf, rj, rd; } carlson_pairs[] = {"
    )
    for x, y, v in [(1, 2, 3), (0.5, -1, 2), (3, -2, 0.01), (1, 1, 1e-8), (1e-4, 1, 5), (2, 0, 1)]:
        for p in (0.25, 3.0, 200.0):
            X, V, P = mpf(x), mpf(v), mpf(p)
            pair = lambda t, Y=mpf(y), V=V: sqrt((t + Y) ** 2 + V * V)
            f = half_line2(lambda t: 1 / (sqrt(t + X) * pair(t)), -y, v) / 2
            j = 3 * half_line2(lambda t: 1 / ((t + P) * sqrt(t + X) * pair(t)), -y, v) / 2
            d = 3 * half_line2(lambda t: 1 / ((t + X) * sqrt(t + X) * pair(t)), -y, v) / 2
            print(f"    {{ {float(x)!r}, {float(y)!r}, {float(v)!r}, {p!r}, {number(f)}, {number(j)}, {number(d)} }},")
    print("};\n")
    print(
        "/* R_J with a complex p = q + i v. */\n"
        "static const struct { double x, y, z, q, v, re, im; } carlson_complex[] = {"
    )
    for x, y, z, q, v in [(1, 2, 3, 1, 1), (0.5, 1, 4, 0.25, 3), (2, 2, 3, 0.01, -2), (1, 5, 9, 30, 40)]:
        j = rj(mpf(x), mpf(y), mpf(z), mp.mpc(q, v))
        print(
            f"    {{ {float(x)!r}, {float(y)!r}, {float(z)!r}, {float(q)!r}, {float(v)!r}, {number(j.real)}, {number(j.imag)} }},"
        )
    print("};\n")


def half_line2(f, near, width):
    """The same integral, split at t = near > 0, where the integrand peaks."""
    if near <= 0:
        return half_line(f)
    w = mpf(width)
    inside = quad(lambda x: f(near + w * mp.sinh(x)) * w * mp.cosh(x), [-asinh(near / w), 0, asinh(near / w)])
    return inside + quad(lambda x: f(2 * near + mp.e**x) * mp.e**x, [-inf, -100, -30, -10, 0, 10, 30, 100, inf])


def legendre_table():
    print(
        "/* F, E and Pi of (n; phi|m); sn, cn, dn of (u|m) as functions of their inverse. */\n"
        "static const struct { double n, phi, m, f, e, pi; } legendre_reference[] = {"
    )
    for n, phi, m in [
        (0.5, 0.5, 0.5),
        (-3.0, 1.0, 0.75),
        (0.25, 1.5, -8.0),
        (0.875, 1.25, 0.9990234375),
        (-0.5, 4.0, 0.25),
        (0.5, -1.0, 0.0),
    ]:
        N, X, M = mpf(n), mpf(phi), mpf(m)
        f = quad(lambda x: 1 / sqrt(1 - M * mp.sin(x) ** 2), mp.linspace(0, X, 9))
        e = quad(lambda x: sqrt(1 - M * mp.sin(x) ** 2), mp.linspace(0, X, 9))
        p = quad(lambda x: 1 / ((1 - N * mp.sin(x) ** 2) * sqrt(1 - M * mp.sin(x) ** 2)), mp.linspace(0, X, 9))
        print(f"    {{ {n!r}, {phi!r}, {m!r}, {number(f)}, {number(e)}, {number(p)} }},")
    print("};\n")


def main(what):
    guard, about = {
        "rays": ("NULL", "Null geodesics of Kerr by Taylor series"),
        "extremes": ("NULL_EXTREMES", "Null geodesics of Kerr at the extremes by Taylor series"),
        "integrals": ("CARLSON", "Elliptic integrals by quadrature"),
        "close": ("NULL_CLOSE", "Integrals of light about close horizons"),
    }[what]
    print(f"/* Made by tests/oracle/null_reference.py {what}; do not edit. {about}. */")
    print(f"#ifndef KD_TESTS_{guard}_REFERENCE_H\n#define KD_TESTS_{guard}_REFERENCE_H\n\n#include <math.h>\n")
    if what == "rays":
        cross_table()
    elif what == "extremes":
        extreme_table()
    elif what == "close":
        close_table()
    else:
        carlson_table()
        legendre_table()
    print("#endif")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "rays")
