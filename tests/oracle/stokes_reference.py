#!/usr/bin/env python3
"""Makes stokes_reference.h: the light of a length of matter, and its effect on light from behind.

dS/ds = j - K S has the solution S(1) = exp(-K) S(0) + (the integral of exp(-K s) ds) j. Both terms are blocks of the
exponential of [[-K, 1], [0, 0]], which is computed in 40 digits: Taylor's series of the matrix divided by at least 256,
and repeated squaring. There are no eigenvalues, no Pauli matrices, and no special cases for small numbers.
"""

import random

import mpmath as mp

mp.mp.dps = 60


def matrix(depth, a, rho):
    (q, u, v), (x, y, z) = a, rho
    return mp.matrix([[depth, q, u, v], [q, depth, z, -y], [u, -z, depth, x], [v, y, -x, depth]])


def exponential(m):
    size = max(abs(x) for x in m)
    halvings = max(0, int(mp.ceil(mp.log(size + mp.mpf(10) ** -30, 2)))) + 8
    m = m / mp.mpf(2) ** halvings
    term = total = mp.eye(8)
    for n in range(1, 40):
        term = term * m / n
        total = total + term
    for _ in range(halvings):
        total = total * total
    return total


def both(light, depth, a, rho):
    k = matrix(depth, a, rho)
    big = mp.zeros(8)
    for i in range(4):
        for j in range(4):
            big[i, j] = -k[i, j]
        big[i, 4 + i] = 1
    e = exponential(big)
    return e[:4, :4], e[:4, 4:] * mp.matrix(light)


def single(x):
    """The nearest 32-bit floating-point number."""
    import struct

    return struct.unpack("f", struct.pack("f", x))[0]


def cases():
    random.seed(8)
    unit = lambda: [random.gauss(0, 1) for _ in range(3)]

    def along(size):
        v = unit()
        n = sum(x * x for x in v) ** 0.5
        return [size * x / n for x in v]

    depths = [0.0, 1e-12, 1e-3, 0.1, 0.7, 3.0, 20.0, 1e6]
    turns = [0.0, 1e-12, 1e-3, 0.1, 1.0, 7.0, 1e4, 1e6]
    for depth in depths:
        for turn in turns:
            for part in (0.3, 0.99):
                yield along(0.9), depth, along(part * depth), along(turn)
    for depth in (
        1e-3,
        0.5,
        2.0,
        10.0,
    ):  # lambda vanishes if a and rho are equally long and perpendicular; in the second row they are parallel
        yield [0.5, 0.2, -0.1], depth, [0.8 * depth, 0, 0], [0, 0.8 * depth, 0]
        yield [0.5, 0.2, -0.1], depth, [0, 0.6 * depth, 0], [0, 0.6 * depth, 0]
        yield [-0.9, 0.3, 0.1], depth, [0, 0, 0.999 * depth], [1e-4 * depth, 0, 0]


def main():
    rows = []
    for v, depth, a, rho in cases():
        v, depth, a, rho = [single(x) for x in v], single(depth), [single(x) for x in a], [single(x) for x in rho]
        behind = [1.0, single(0.5), single(-0.4), single(0.6)]
        passes, light = both([1.0] + v, depth, a, rho)
        through = passes * mp.matrix(behind)
        rows.append(v + [depth] + a + rho + list(through) + list(light))
    with open("stokes_reference.h", "w") as out:
        out.write(
            "/* Made by stokes_reference.py: what comes of a length of matter that is the same all along. */\n"
            "struct stokes_reference { double light[3], depth, takes[3], turns[3], passes[4], gives[4]; };\n"
            "#define STOKES_BEHIND { 1.0, %.9g, %.9g, %.9g }\n"
            % (single(0.5), single(-0.4), single(0.6))
            + "static const struct stokes_reference stokes_references[] = {\n"
        )
        for r in rows:
            t = [mp.nstr(mp.mpf(x) if abs(x) > 1e-300 else mp.mpf(0), 9) for x in r]
            out.write(
                "    { { %s }, %s, { %s }, { %s }, { %s }, { %s } },\n"
                % (
                    ", ".join(t[:3]),
                    t[3],
                    ", ".join(t[4:7]),
                    ", ".join(t[7:10]),
                    ", ".join(t[10:14]),
                    ", ".join(t[14:]),
                )
            )
        out.write("};\n")


main()
