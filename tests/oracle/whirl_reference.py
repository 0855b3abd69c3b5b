#!/usr/bin/env python3
"""Reference values for bodies in the equatorial plane that whirl at an unstable circle.

Carter's equations in 1/r are integrated by quadrature in 30 digits, with dense nodes where the radial motion almost
stops. E and L are first rounded to double: the values are those of the motion with exactly these numbers.

whirl_reference.py > whirl_reference.h
"""

from mpmath import findroot, im, mp, mpf, polyroots, quad, sqrt

mp.dps = 30

SPINS = [0, 0.9, -0.9, 0.998]
ENERGIES = ["0.97", "0.9999999999999999", "1", "1.000001", "1.25"]
BESIDE = ["1e-3", "-1e-3", "1e-7", "-1e-7", "3e-10", "-3e-10", "1e-12", "-1e-12"]  # relative differences of L
FAR = mpf(1) / 100


def quartic(a, energy, l):
    b = 1 - energy**2
    return [2 * (l - a * energy) ** 2, -(a * a * b + l * l), mpf(2), -b]  # Q = 0: a cubic


def value(c, w):
    return ((c[0] * w + c[1]) * w + c[2]) * w + c[3]


def slope(c, w):
    return (3 * c[0] * w + 2 * c[1]) * w + c[2]


def whirl(a, energy):
    """w and L of the unstable circle, followed from the marginally bound circle in small steps of E."""
    r = 2 - a + 2 * sqrt(1 - a)
    w, l = 1 / r, 2 * (1 + sqrt(1 - a))
    for k in range(1, 21):
        e = 1 + (energy - 1) * k / 20
        w, l = findroot(lambda w, l: [value(quartic(a, e, l), w), slope(quartic(a, e, l), w)], (w, l))
    return w, l


def rates(a, energy, l, w):
    """The integrands of Mino time, proper time, t and phi."""
    r = 1 / w
    delta, past = r * r - 2 * r + a * a, energy * (r * r + a * a) - a * l
    return 1, r * r, (r * r + a * a) * past / delta + a * (l - a * energy), l - a * energy + a * past / delta


def crowded(low, high, at):
    """Nodes between low and high, which are denser towards `at`."""
    steps = [at + side * mpf(10) ** -k for side in (1, -1) for k in range(1, 9)]
    return sorted({low, high, *[x for x in steps if low < x < high], *([at] if low < at < high else [])})


def inwards(a, energy, l, low, high, middle):
    """Mino time and proper time from low to the horizon, across the minimum of W at `middle`."""
    c = quartic(a, energy, l)
    return [
        quad(lambda w: rates(a, energy, l, w)[i] / sqrt(value(c, w)), crowded(low, high, middle)) for i in range(2)
    ] + [mpf(0)] * 2


def to_turn(a, energy, l, start, turn, others):
    """Integrals from start to the turning point, with w = turn - side s^2. W is divided by the root at the turning
    point."""
    c = quartic(a, energy, l)
    side = 1 if turn > start else -1

    def rest(w):
        product = -side * c[0]
        for root in others:
            product *= w - root
        return product

    nodes = crowded(mpf(0), sqrt(abs(turn - start)), mpf(0))

    def one(i):
        return quad(lambda s: 2 * rates(a, energy, l, turn - side * s * s)[i] / sqrt(rest(turn - side * s * s)), nodes)

    return [one(i) for i in range(4)]


def row(a, energy_text, beside):
    a, energy = mpf(float(a)), mpf(float(energy_text))
    w, l = whirl(a, energy)
    l = mpf(float(l * (1 + mpf(beside))))
    c = quartic(a, energy, l)
    minimum = (-2 * c[1] + sqrt(4 * c[1] ** 2 - 12 * c[0] * c[2])) / (6 * c[0])
    horizon = 1 / (1 + sqrt(1 - a * a))
    roots = sorted(x.real for x in polyroots(c, maxsteps=1000, extraprec=400) if abs(im(x)) < mpf(10) ** -25)
    low = [x for x in roots if x > 0 and x < minimum] if energy < 1 else []
    start = FAR if not low or low[0] < FAR else low[0]
    if value(c, minimum) > 0:  # the body falls in; it starts at the outer turning point if this is within r = 100
        if start == FAR:
            sums = inwards(a, energy, l, FAR, horizon, minimum)
        else:
            others = [x for x in polyroots(c, maxsteps=1000, extraprec=400) if abs(x - start) > mpf(10) ** -22]
            middle = 1 / (1 / start - 1)
            first = to_turn(a, energy, l, middle, start, others)
            second = inwards(a, energy, l, middle, horizon, minimum)
            sums = [first[i].real + second[i] for i in range(2)] + [mpf(0)] * 2
        fate = "WHIRL_PLUNGE"
    elif energy < 1:  # the integrals over a radial period
        outer, inner = low[0], low[1]
        middle = 1 / (1 / inner + 1) if outer < FAR else (outer + inner) / 2
        parts = [to_turn(a, energy, l, middle, x, [y for y in roots if y != x]) for x in (outer, inner)]
        sums = [2 * (p + q) for p, q in zip(*parts)]
        fate = "WHIRL_BOUND"
    else:
        turn = max(x for x in roots if x < minimum)
        sums = [2 * x for x in to_turn(a, energy, l, FAR, turn, [y for y in roots if y != turn])]
        fate = "WHIRL_ESCAPE"
    values = ", ".join(mp.nstr(x.real, 17, min_fixed=-3, max_fixed=17) for x in sums)
    return f"    {{ {float(a)!r}, {float(energy)!r}, {float(l)!r}, {float(beside)!r}, {1 / float(start):.17g}, {fate},\n      {values} }},"


def main():
    print("/* Made by tests/oracle/whirl_reference.py; do not edit. Orbits that whirl, by quadrature. */")
    print(
        "#ifndef KD_TESTS_WHIRL_REFERENCE_H\n#define KD_TESTS_WHIRL_REFERENCE_H\n\n"
        "enum whirl_fate { WHIRL_BOUND, WHIRL_PLUNGE, WHIRL_ESCAPE };\n"
    )
    print(
        "/* beside: how far L is from that of the whirl, relative. From r = `from` to the horizon (t and phi infinite, given as 0), back to\n"
        " * r = 100, or, bound, a radial period. */"
    )
    print(
        "struct whirl_reference {\n    double spin, energy, momentum, beside, from;\n    enum whirl_fate fate;\n    double mino, proper, t, phi;\n};\n"
    )
    print("static const struct whirl_reference whirl_reference[] = {")
    for a in SPINS:
        for energy in ENERGIES:
            for beside in BESIDE:
                print(row(a, energy, beside), flush=True)
    print("};\n\n#endif")


if __name__ == "__main__":
    main()
