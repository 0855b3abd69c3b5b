#!/usr/bin/env python3
"""Reference numbers for the critical curve of Kerr, its exponents and the lensing bands, to 20 digits, as a C table.

python3 tests/oracle/critical_reference.py > tests/oracle/critical_reference.h          (needs mpmath; some minutes)

No formula of spherical photon orbits is used. Consider the least value of the radial potential R(r) = (r^2 + a^2 - a
lambda)^2 - Delta (eta + (lambda - a)^2) outside the horizon. A point of the curve is where this value passes through
zero along a line in the image plane. The exponents are quadratures of the equations of motion in Mino time over one
half oscillation in latitude, with R'' by differences. At the edge of a band of order n two times are equal: the time to
the n-th crossing of the plane, by quadrature in the latitude, and the time to the source radius, by quadrature in r
between the roots of R. The working precision is 60 digits, so that distances from the curve down to 1e-14 need no
special care.
"""

from mpmath import asinh, cos, diff, findroot, inf, mp, mpf, pi, polyroots, quad, sin, sinh, sqrt

mp.dps = 60


def constants(a, u, alpha, beta):
    """lambda and eta of a point of the image plane."""
    return -alpha * sqrt(1 - u * u), (alpha**2 - a * a) * u * u + beta**2


def potential(a, lam, eta):
    return lambda r: (r * r + a * a - a * lam) ** 2 - (r * r - 2 * r + a * a) * (eta + (lam - a) ** 2)


def lowest(a, lam, eta):
    """r and R(r) at the outermost minimum of R: the root of R' = 4r^3 + 2Ar + 2K by Newton's method from outside."""
    A, K = a * a - eta - lam * lam, eta + (lam - a) ** 2
    r = mpf(12)
    for _ in range(200):
        step = (4 * r**3 + 2 * A * r + 2 * K) / (12 * r * r + 2 * A)
        r -= step
        if abs(step) < mpf(10) ** (5 - mp.dps):
            break
    # if R has no minimum outside the horizon, the ray does not turn
    return (r, potential(a, lam, eta)(r)) if r > 1 else (r, mpf(1))


def on_line(a, u, start, direction, bound):
    """The distance of the curve from `start` along `direction`. The distance is bracketed by a change of sign, and
    found by Ridder's method."""
    value = lambda d: lowest(a, *constants(a, u, start[0] + d * direction[0], start[1] + d * direction[1]))[1]
    low, high = mpf(bound) / 100, mpf(bound)
    while high - low > mpf(1) / 1000:
        middle = (low + high) / 2
        low, high = (middle, high) if value(middle) > 0 else (low, middle)
    return findroot(value, (low, high), solver="anderson", tol=mpf(10) ** (-90))


class Curve:
    def __init__(self, a, u):
        self.a, self.u = mpf(a), mpf(u)
        inside = 2 * self.a * sqrt(1 - self.u**2)
        self.right = inside + on_line(self.a, self.u, (inside, 0), (1, 0), 8)
        self.left = inside - on_line(self.a, self.u, (inside, 0), (-1, 0), 8)
        self.centre = (self.left + self.right) / 2

    def rho(self, angle):
        return on_line(self.a, self.u, (self.centre, mpf(0)), (cos(angle), sin(angle)), 8)

    def point(self, angle, rho):
        return self.centre + rho * cos(angle), rho * sin(angle)


def exponents(a, lam, eta):
    """r, half period in Mino time, gamma, delta, tau."""
    r = lowest(a, lam, eta)[0]
    bend = diff(potential(a, lam, eta), r, 2) / 2
    delta = r * r - 2 * r + a * a
    A = a * a - eta - lam * lam
    z = 2 * eta / (-A + sqrt(A * A + 4 * a * a * eta))
    n = eta / z

    def over(f):  # integral over the half oscillation, u = sqrt(z) sin x
        return 2 * quad(lambda x: f(z * sin(x) ** 2) / sqrt(n + a * a * z * sin(x) ** 2), mp.linspace(0, pi / 2, 5))

    mino = over(lambda v: mpf(1))
    # for the orbit over the axis this is the limit lambda -> 0+
    about = over(lambda v: lam / (1 - v)) if lam != 0 else pi
    azimuth = about + a * ((r * r + a * a - a * lam) / delta - 1) * mino
    time = over(lambda v: a * (lam - a * (1 - v))) + (r * r + a * a) * (r * r + a * a - a * lam) / delta * mino
    return r, mino, sqrt(bend) * mino, azimuth, time


def polar_time(a, u, alpha, beta, order):
    lam, eta = constants(a, u, alpha, beta)
    A = a * a - eta - lam * lam
    z = 2 * eta / (-A + sqrt(A * A + 4 * a * a * eta))
    n = eta / z
    f = lambda x: 1 / sqrt(n + a * a * z * sin(x) ** 2)
    quarter, start = quad(f, [0, pi / 4, pi / 2]), quad(f, [0, mp.asin(u / sqrt(z))])
    return 2 * order * quarter + (start if beta < 0 else 2 * quarter - start)


def radial_time(a, u, alpha, beta, source):
    """Mino time from infinity to the source radius. The ray reaches this radius on its way in if it has no turning
    point, and otherwise on its way out."""
    lam, eta = constants(a, u, alpha, beta)
    A, K = a * a - eta - lam * lam, eta + (lam - a) ** 2
    roots = polyroots([1, 0, A, 2 * K, -a * a * eta], maxsteps=500, extraprec=400)
    real = sorted(mp.re(x) for x in roots if abs(mp.im(x)) < mpf(10) ** (-45))
    pieces = list(range(0, 80, 4)) + [120, 160]  # for |t| > ln(1/distance) the integrand falls as exp(-t)
    if len(real) == 4 and real[3] > 1 + sqrt(1 - a * a):  # r = r4 + r43 sinh^2 t
        r1, r2, r3, r4 = real
        leg = lambda t: 2 / sqrt((r4 + (r4 - r3) * sinh(t) ** 2 - r1) * (r4 + (r4 - r3) * sinh(t) ** 2 - r2))
        out = sum(quad(leg, [x, y]) for x, y in zip(pieces, pieces[1:]))
        if source == inf:
            return 2 * out
        return out + quad(leg, mp.linspace(0, asinh(sqrt((source - r4) / (r4 - r3))), 12))
    pair = [x for x in roots if mp.im(x) > mpf(10) ** (-45)]
    assert len(pair) == 1, roots
    m, v = mp.re(pair[0]), mp.im(pair[0])  # r = m + v sinh t
    r1, r2 = real
    leg = lambda t: 1 / sqrt((m + v * sinh(t) - r1) * (m + v * sinh(t) - r2))
    begin = asinh((source - m) / v)
    return sum(quad(leg, [begin + x, begin + y]) for x, y in zip(pieces, pieces[1:]))


def edge(curve, angle, rho, order, source, guess):
    """The delta for which the edge is at rho (1 + delta)."""

    def late(s):
        point = curve.point(angle, rho * (1 + (1 if guess > 0 else -1) * mp.e**s))
        return polar_time(curve.a, curve.u, *point, order) - radial_time(curve.a, curve.u, *point, source)

    before = mp.log(abs(guess))
    s, f = before + mpf(1) / 8, late(before)
    while abs(s - before) > mpf(10) ** (-25):  # secant method: the time is almost linear in the logarithm
        g = late(s)
        before, s, f = s, s - g * (s - before) / (g - f), g
    return (1 if guess > 0 else -1) * mp.e**s


def number(x):
    return "INFINITY" if x == inf else mp.nstr(x, 21, min_fixed=-3, max_fixed=9)


def cosine(degrees):
    return mpf(float(mp.cos(mpf(degrees) * pi / 180))) if degrees != 90 else mpf(0)


# spin, inclination, angles in degrees
CURVES = [
    (0.0, 0, (40,)),
    (0.0, 60, (40, 80, 150)),
    (1e-9, 60, (20, 135)),
    (0.3, 1, (10, 100)),
    (0.5, 45, (45, 120, 170)),
    (0.9, 0, (30,)),
    (0.9, 60, (1, 60, 135, 179)),
    (0.9, 90, (30, 120)),
    (0.998, 30, (60, 160)),
    (0.998, 90, (10, 90, 160)),
    (1 - 1e-12, 17, (50, 170)),
    (1 - 1e-12, 90, (20, 110, 170)),
]
# spin, inclination, angle, orders
BANDS = [
    (0.0, 0, 90, (1, 2, 3, 6, 8)),
    (0.0, 60, -30, (1, 2, 6)),
    (0.9, 60, 20, (1, 4, 8)),
    (0.9, 60, 160, (1, 2, 6, 8)),
    (0.9, 60, -100, (1, 3, 6)),
    (0.998, 80, 170, (2, 6)),
    (1 - 1e-6, 60, 160, (2, 6)),
]


def main():
    print(
        "/* Made by tests/oracle/critical_reference.py; do not edit. Critical curve, exponents and lensing bands of Kerr. */"
    )
    print("#ifndef KD_TESTS_CRITICAL_REFERENCE_H\n#define KD_TESTS_CRITICAL_REFERENCE_H\n\n#include <math.h>\n")
    print(
        "/* Angle in degrees about the centre; delta and tau per half orbit. */\n"
        "struct critical_reference {\n    double spin, cos_theta, left, right, angle, rho, r, mino, gamma, delta, tau;\n};\n"
    )
    print("static const struct critical_reference critical_reference[] = {")
    kept = {}
    for a, i, angles in CURVES:
        curve = kept[a, i] = Curve(a, cosine(i))
        for degrees in angles:
            angle = mpf(degrees) * pi / 180
            rho = curve.rho(angle)
            row = exponents(curve.a, *constants(curve.a, curve.u, *curve.point(angle, rho)))
            values = [curve.left, curve.right, degrees, rho, *row]
            print(
                f"    {{ {float(a).hex()}, {float(curve.u).hex()}, /* a = {a!r}, i = {i} */\n      "
                + ", ".join(map(number, values[:5]))
                + ",\n      "
                + ", ".join(map(number, values[5:]))
                + " },",
                flush=True,
            )
    print(
        "};\n\n/* Edges of band `order`: distance from the curve over rho of it; of the image of `source`. */\n"
        "struct band_reference {\n    double spin, cos_theta, angle;\n    int order;\n    double source, distance;\n};\n"
    )
    print("static const struct band_reference band_reference[] = {")
    for a, i, degrees, orders in BANDS:
        curve = kept.get((a, i)) or Curve(a, cosine(i))
        angle = mpf(degrees) * pi / 180
        rho = curve.rho(angle)
        gamma = exponents(curve.a, *constants(curve.a, curve.u, *curve.point(angle, rho)))[2]
        for source in (float(1 + sqrt(1 - curve.a**2)), 6.0, inf):
            guess = mpf(-0.8) if source < 3 else mpf(4 if source == inf else 1)
            for order in orders:
                first = min(guess * mp.e ** (-gamma * order), mpf("0.1"))
                value = edge(curve, angle, rho, order, mpf(source), first)
                head = f"{float(a).hex()}, {float(curve.u).hex()}, {degrees}, {order}"
                far = "INFINITY" if source == inf else repr(source)
                print(f"    {{ {head}, {far}, {number(value)} }}, /* a = {a!r}, i = {i} */", flush=True)
    print("};\n\n#endif")


if __name__ == "__main__":
    main()
