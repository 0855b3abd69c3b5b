#!/usr/bin/env python3
"""Reference values for bound timelike geodesics of Kerr, in 40 digits, by other methods than those of src/physics.

constants of motion   Newton's method on R = 0 at both turning points (R = R' = 0 for a circle), not Schmidt's formulae
frequencies, places   Carter's equations by quadrature in Darwin's phases r = p/(1 + e cos x), cos(theta) = s sin y

orbit_reference.py > orbit_reference.h
"""

from mpmath import cos, findroot, linspace, mp, mpf, pi, polyroots, quad, sin, sqrt

mp.dps = 40

# spin, p, e, x = cos(inclination), and the Mino time of a place on the orbit
ORBITS = [
    (0, 8, 0.5, 1, 3),
    (0, 8, 0.5, 0.5, 40),
    (0, 6.001, 0, 1, 1),
    (0, 37000000.0, 0.2056, 1, 0.002),
    (0, 7.2, 0.59375, 1, 5),
    (0.5, 10, 0.25, 1, 2.5),
    (0.9, 6, 0.5, 0.75, 7),
    (0.9, 12, 0.875, 0, 1.5),
    (0.9, 10, 0.25, -1, 3),
    (0.9, 9, 0.5, -0.5, 20),
    (0.9, 5, 0, 0.5, 2),
    (0.9, 2.875, 0.5, 1, 4),
    (0.998, 3, 0.25, 0.875, 10),
    (0.998, 1.75, 0.25, 1, 2),
    (-0.7, 10, 0.375, 0.25, 6),
    (0.9999, 20, 0.984375, 0.0009765625, 3),
    (1e-8, 8, 0.5, 0.5, 2),
    (0.9, 1000, 0.0009765625, 0.5, 0.5),
    (-0.5, 30, 0.75, -0.25, 1),
]


def radial(a, energy, l, q):
    """R(r), and its derivative."""
    k = q + (l - a * energy) ** 2
    value = lambda r: (energy * (r * r + a * a) - a * l) ** 2 - (r * r - 2 * r + a * a) * (r * r + k)
    slope = lambda r: (
        4 * energy * r * (energy * (r * r + a * a) - a * l)
        - (2 * r - 2) * (r * r + k)
        - 2 * r * (r * r - 2 * r + a * a)
    )
    return value, slope


def carter(a, energy, l_x, x):
    """Q of L = x l_x, for a motion whose turning point in theta is at cos^2 = 1 - x^2."""
    return (1 - x * x) * (a * a * (1 - energy**2) + l_x**2)


def constants(a, p, e, x):
    r1, r2 = p / (1 - e), p / (1 + e)

    def residual(energy, l_x):
        value, slope = radial(a, energy, x * l_x, carter(a, energy, l_x, x))
        return [value(r1) / r1**3, value(r2) / r2**3 if e else slope(r1) / r1**2]

    # starts from the orbit in Schwarzschild's metric, and increases the spin in steps
    energy, l_x = (
        sqrt(((p - 2) ** 2 - 4 * e * e) / (p * (p - 3 - e * e))) if p > 3 + e * e else mpf(1),
        p / sqrt(abs(p - 3 - e * e)),
    )
    full, a = a, mpf(0)
    for i in range(0, 41):
        a = full * i / 40
        try:
            energy, l_x = findroot(residual, (energy, l_x))
        except (ValueError, ZeroDivisionError):
            pass
    a = full
    energy, l_x = findroot(residual, (energy, l_x))
    return energy, x * l_x, carter(a, energy, l_x, x)


class Orbit:
    def __init__(self, a, p, e, x):
        self.a, self.p, self.e = a, p, e
        self.energy, self.l, self.q = constants(a, p, e, x)
        energy, l, q = self.energy, self.l, self.q
        self.b = 1 - energy**2
        k = q + (l - a * energy) ** 2
        quartic = [-self.b, 2, -(a * a * self.b + l * l + q), 2 * k, -a * a * q]
        r1, r2 = p / (1 - e), p / (1 + e)
        # divided by (r - r1)(r - r2)
        c = [quartic[0], quartic[1] + quartic[0] * (r1 + r2)]
        c.append(quartic[2] + c[1] * (r1 + r2) - c[0] * r1 * r2)
        self.rest = lambda r: -(c[0] * r * r + c[1] * r + c[2])
        self.z = 1 - x * x
        flat = a * a * self.b
        # z+ follows from the sum of the roots
        self.pace = lambda u: sqrt(q + l * l + flat - flat * self.z - flat * u * u)

    def r(self, x):
        return self.p / (1 + self.e * cos(x))

    def by_radius(self, x):
        """Mino time, proper time, t, phi per radial phase."""
        a, r = self.a, self.r(x)
        # dr = p e sin x / (1 + e cos x)^2 dx and (r1 - r)(r - r2) = (p e sin x)^2 / ((1 - e^2)(1 + e cos x)^2)
        rate = sqrt(1 - self.e**2) / ((1 + self.e * cos(x)) * sqrt(self.rest(r)))
        delta, past = r * r - 2 * r + a * a, self.energy * (r * r + a * a) - a * self.l
        return rate, rate * r * r, rate * (r * r + a * a) * past / delta, rate * a * past / delta

    def by_theta(self, y):
        u2 = self.z * sin(y) ** 2
        rate, a = 1 / self.pace(sqrt(u2)), self.a
        s2 = 1 - u2
        return (
            rate,
            rate * a * a * u2,
            rate * a * (self.l - a * self.energy * s2),
            rate * ((self.l / s2 if self.l else 0) - a * self.energy),
        )


def integral(f, end, i, start=0):
    pieces = max(2, int(abs(end - start) / pi * 6) + 1)
    axis = mp.floor(start / pi) * pi + pi / 2  # here phi of an orbit that passes near the axis changes fastest
    near = [axis + side * mpf(10) ** -k for side in (1, -1) for k in range(1, 6)]
    return quad(lambda x: f(x)[i], sorted(linspace(start, end, pieces + 1) + [x for x in near if start < x < end]))


def phase_at(f, mino, half):
    """The radial phase at which the first integral equals `mino`, found by counting whole half turns and then by
    Newton's method."""
    turns = mp.floor(mino / half)
    rest, x = mino - turns * half, (mino / half) * pi
    for _ in range(60):
        step = (integral(f, x, 0, turns * pi) - rest) / f(x)[0]
        x -= step
        if abs(step) < mpf(10) ** -30:
            break
    return turns, x


def number(x):
    return mp.nstr(mpf(x), 21, min_fixed=-3, max_fixed=9)


def row(spin, p, e, x, mino):
    o = Orbit(mpf(spin), mpf(p), mpf(e), mpf(x))
    half = [integral(o.by_radius, pi, i) for i in range(4)]
    swing = [integral(o.by_theta, pi, i) for i in range(4)]
    if not o.l:
        swing[3] += pi  # L/sin^2 theta is a step of pi at each passage of the axis
    mean = [half[i] / half[0] + swing[i] / swing[0] for i in range(4)]
    mino_r, mino_theta = pi / half[0], pi / swing[0]
    values = [o.energy, o.b, o.l, o.q, mino_r, mino_theta, mean[3], mean[2], mean[1]]
    mino = mpf(mino)
    n, x_r = phase_at(o.by_radius, mino, half[0])
    m, y = phase_at(o.by_theta, mino, swing[0])
    place = [
        n * half[i] + integral(o.by_radius, x_r, i, n * pi) + m * swing[i] + integral(o.by_theta, y, i, m * pi)
        for i in range(1, 4)
    ]
    if not o.l:
        place[2] += pi if y - m * pi > pi / 2 else 0
    r = o.r(x_r)
    u = sqrt(o.z) * sin(y)
    values += [mino, *place, r, u]
    return (
        f"    {{ {float(spin)!r}, {float(p)!r}, {float(e)!r}, {float(x)!r},\n      "
        + ", ".join(map(number, values))
        + " },"
    )


# Falls and escapes in the equatorial plane: spin, E, L, r at the start (0: at the nearest turning point) and at the
# end.
FALLS = [
    (0, 0.9375, 0, 0, 2.125),
    (0.5, 0.9375, 1.5, 0, 2),
    (0.9, 0.96875, 1, 10, 1.5),
    (0.9, 0.96875, -2.5, 10, 1.4375),
    (0.998, 1, 0.5, 20, 1.125),
    (-0.9, 1.25, 3, 30, 1.4375),
    (0.9, 1.125, 2, 1.75, 50),
    (0, 1.0625, 0, 5, 100),
    (0.9375, 0.75, 0, 0, 1.375),
]


def fall_row(spin, energy, l, start, end):
    a, energy, l, end = mpf(spin), mpf(energy), mpf(l), mpf(end)
    value, _ = radial(a, energy, l, mpf(0))
    if not start:
        k = (l - a * energy) ** 2
        start = max(
            r.real
            for r in polyroots([energy**2 - 1, 2, a * a * (energy**2 - 1) - l * l, 2 * k], maxsteps=200, extraprec=200)
            if abs(r.imag) < 1e-25
        )
    start = mpf(start)
    way = 1 if end > start else -1

    def rates(s):  # r = start + way s^2
        r = start + way * s * s
        delta, past = r * r - 2 * r + a * a, energy * (r * r + a * a) - a * l
        root = sqrt(value(r)) if s else 1
        return [
            2 * s * f / root
            for f in (
                mpf(1),
                r * r,
                (r * r + a * a) * past / delta + a * (l - a * energy),
                l - a * energy + a * past / delta,
            )
        ]

    stop = sqrt(abs(end - start))
    sums = [quad(lambda s: rates(s)[i], linspace(0, stop, 13)) for i in range(4)]
    return "    { " + ", ".join(map(number, [spin, energy, l, start, end, *sums])) + " },"


def main():
    print("/* Made by tests/oracle/orbit_reference.py; do not edit. Bound timelike geodesics of Kerr by quadrature. */")
    print("#ifndef KD_TESTS_ORBIT_REFERENCE_H\n#define KD_TESTS_ORBIT_REFERENCE_H\n")
    print(
        "struct orbit_reference {\n    double spin, p, e, x;\n    double energy, binding, momentum, carter;\n"
        "    double mino_r, mino_theta, mino_phi, mino_t, mino_proper;\n    double mino, proper, t, phi, r, u;\n};\n"
    )
    print("static const struct orbit_reference orbit_reference[] = {")
    for orbit in ORBITS:
        print(row(*orbit), flush=True)
    print(
        "};\n\n/* In the equatorial plane, from r to r: Mino time, proper time, t, phi. */\nstruct fall_reference {\n"
        "    double spin, energy, momentum, from, to, mino, proper, t, phi;\n};\n"
    )
    print("static const struct fall_reference fall_reference[] = {")
    for fall in FALLS:
        print(fall_row(*fall), flush=True)
    print("};\n\n#endif")


if __name__ == "__main__":
    main()
