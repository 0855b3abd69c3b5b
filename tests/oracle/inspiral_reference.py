#!/usr/bin/env python3
"""Reference times to coalescence, as the C table inspiral_reference.h.

python3 tests/oracle/inspiral_reference.py > tests/oracle/inspiral_reference.h      (needs mpmath)

Everything follows from the two rates alone (Peters 1964, eqs 5.6 and 5.7, which tests/unit/physics_inspiral.c derives
anew). While e decreases, ln a is the integral of their ratio, by quadrature, and so is the time. Neither a(e) nor T in
closed form is used.
"""

from mpmath import exp, log, mp, mpf, nstr
from mpmath.calculus.quadrature import GaussLegendre

mp.dps = 25
CASES = [
    (0.25, 100.0, 1e-3),
    (0.25, 100.0, 0.1),
    (0.25, 1e4, 0.5),
    (0.2, 1e6, 0.9),
    (0.01, 50.0, 0.99),
    (0.1, 1e5, 0.9999),
]


def axis_rate(a, e):
    return -mpf(64) / 5 / a**3 / (1 - e * e) ** 3.5 * (1 + mpf(73) / 24 * e**2 + mpf(37) / 96 * e**4)


def eccentricity_rate(a, e):
    return -mpf(304) / 15 * e / a**4 / (1 - e * e) ** 2.5 * (1 + mpf(121) / 304 * e**2)


# Gauss-Legendre quadrature with 24 points in each interval
NODES = [(x, w) for x, w in GaussLegendre(mp).calc_nodes(4, 120)]


def gauss(f, low, high):
    return (high - low) / 2 * sum(w * f((low + high) / 2 + (high - low) / 2 * x) for x, w in NODES)


def pieces(high):
    """Intervals that start at 0; each covers half of what remains up to 1, because near e = 1 the integrands are powers
    of 1 - e."""
    edges = [mpf(0)]
    while 1 - (1 - edges[-1]) / 2 < high:
        edges.append(1 - (1 - edges[-1]) / 2)
    return edges + [high]


def time(eta, a0, e0):
    def slope(e):
        """d ln a/de without its pole 12/(19 e) at e = 0."""
        return axis_rate(mpf(1), e) / eccentricity_rate(mpf(1), e) - mpf(12) / 19 / e

    total, fallen, edges = mpf(0), mpf(0), pieces(e0)
    for low, high in reversed(list(zip(edges, edges[1:]))):

        def speed(x):
            """dt/dx with e = x^19. In x the powers of e in 19ths are smooth."""
            e = x**19
            lna = log(a0) - fallen - gauss(slope, e, high) + mpf(12) / 19 * log(e / e0)
            return -19 * x**18 / eccentricity_rate(exp(lna), e)

        root = mpf(1) / 19
        start, width = low**root, (high**root - low**root) / 4
        total += sum(gauss(speed, start + k * width, start + (k + 1) * width) for k in range(4))
        fallen += gauss(slope, low, high)
    return total / eta


def main():
    print("/* Made by tests/oracle/inspiral_reference.py; do not edit. Quadrature of Peters's rates. */")
    print("#ifndef KD_TESTS_INSPIRAL_REFERENCE_H\n#define KD_TESTS_INSPIRAL_REFERENCE_H\n")
    print("struct inspiral_reference { double eta, a, e, time; };\n")
    print("static const struct inspiral_reference inspiral_reference[] = {")
    for eta, a, e in CASES:
        print("    { %s, %s, %s, %s }," % (eta, a, e, nstr(time(mpf(eta), mpf(a), mpf(e)), 17)), flush=True)
    print("};\n\n#endif")


if __name__ == "__main__":
    main()
