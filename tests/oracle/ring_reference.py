#!/usr/bin/env python3
"""Reference numbers for lensed rings round a hole without spin, and for embedded planes: the C table ring_reference.h.

python3 tests/oracle/ring_reference.py > tests/oracle/ring_reference.h      (needs mpmath)

Ring: a ray stays in a plane, in which (du/dpsi)^2 = 1/b^2 - u^2 + 2u^3, u = 1/r (Darwin 1959). The emitter at (r, phi)
lies at the angle psi0 from the observer's direction, cos psi0 = sin i cos phi. The ray to its image of order 0 turns by
psi = psi0; that of order 1 turns by 2 pi - psi0, round the other side. b is found by bisection on this angle, which is
a quadrature in 30 digits on either branch (before or after the turning point u_t). From b follow alpha = +-b sin
phi/sin psi0, beta = -+b cos i cos phi/sin psi0 and g = sqrt(1 - 3/r)/(1 + r^(-3/2) alpha sin i).

Embedding: dz and dl from the metric of Boyer & Lindquist are integrated by quadrature in sqrt(r - r+).
"""

from kerr_reference import c
from mpmath import acos, cos, diff, mp, mpf, pi, polyroots, quad, sin, sqrt

mp.dps = 30


def turned(b, u, beyond):
    """The angle from u = 0 to u. `beyond`: the path passes the turning point. The variable w = sqrt(u_t - u) removes
    the root at the turning point."""
    roots = sorted(
        (x.real for x in polyroots([2, -1, 0, 1 / b**2], maxsteps=200, extraprec=200) if abs(x.imag) < 1e-15)
    )
    if b * b > 27:
        low, top, far = roots
        share = lambda w: 2 / sqrt(2 * (far - top + w * w) * (top - low - w * w))
        to_u, all_of_it = quad(share, [sqrt(max(0, top - u)), sqrt(top)]), quad(share, [0, sqrt(top)])
        return 2 * all_of_it - to_u if beyond else to_u
    return quad(
        lambda x: 1 / sqrt(1 / b**2 - x * x + 2 * x**3), [0, min(u, mpf(1) / 3), u] if u > mpf(1) / 3 else [0, u]
    )


def impact(u, psi):
    """b of the ray that turns by psi on its way from u."""
    edge = 1 / (u * sqrt(1 - 2 * u))  # for this b the turning point is at u
    if u >= mpf(1) / 3:
        low, high, rising = mpf(10) ** -9, sqrt(mpf(27)) * (1 - mpf(10) ** -20), lambda b: turned(b, u, False)
    elif turned(edge * (1 - mpf(10) ** -25), u, False) >= psi:
        low, high, rising = mpf(10) ** -9, edge * (1 - mpf(10) ** -25), lambda b: turned(b, u, False)
    else:  # beyond the turning point a ray turns more if it passes closer to the hole
        low, high, rising = (
            edge * (1 - mpf(10) ** -25),
            sqrt(mpf(27)) * (1 + mpf(10) ** -20),
            lambda b: turned(b, u, True),
        )
    for _ in range(62):
        middle = (low + high) / 2
        if rising(middle) < psi:
            low = middle
        else:
            high = middle
    return low


def ring(i, r, phi, order):
    i, phi, u = i * pi / 180, phi * pi / 180, 1 / mpf(r)
    psi0, side = acos(sin(i) * cos(phi)), 1 if order == 0 else -1
    b = impact(u, psi0 if order == 0 else 2 * pi - psi0)
    alpha, beta = side * b * sin(phi) / sin(psi0), -side * b * cos(i) * cos(phi) / sin(psi0)
    return alpha, beta, sqrt(1 - 3 * u) / (1 + u ** mpf(1.5) * alpha * sin(i)) if r > 3 else mpf(0)


def embedding(a, r):
    """R, z and proper distance at r."""
    radius = lambda x: sqrt(x * x + a * a + 2 * a * a / x)
    top = 1 + sqrt((1 - a) * (1 + a))
    inner = a * a / top

    def height(y):  # r = r+ + y^2
        x = top + y * y
        slope = diff(radius, x, h=mpf(10) ** -14)
        return sqrt(4 * x * x / (x - inner) - (2 * y * slope) ** 2)

    length = lambda y: sqrt(4 * (top + y * y) ** 2 / (top + y * y - inner))
    end = sqrt(r - top)
    edges = [0] + [
        end * mpf(2) ** -k for k in range(int(mp.log(end / sqrt(top - inner), 2)) + 3 if inner else 3, -1, -1)
    ]
    return radius(r), quad(height, edges), quad(length, edges)


def main():
    print("/* Made by tests/oracle/ring_reference.py; do not edit. */")
    print("#ifndef KD_TESTS_RING_REFERENCE_H\n#define KD_TESTS_RING_REFERENCE_H\n")
    print("struct ring_reference { double inclination_deg, r, phi_deg; int order; double alpha, beta, g; };")
    print("static const struct ring_reference ring_reference[] = {")
    for i, r, phi in (
        (60, 6, 90),
        (60, 6, 180),
        (60, 6, 30),
        (75, 6, 200),
        (75, 10, 270),
        (30, 20, 10),
        (85, 3, 100),
        (85, 30, 179),
        (45, 2.5, 300),
        (20, 1000, 45),
    ):
        for order in (0, 1):
            print("    { %s, %s, %s, %d, %s }," % (i, r, phi, order, ", ".join(map(c, ring(i, r, phi, order)))))
    print("};\n\nstruct embedding_reference { double a, r, radius, z, distance; };")
    print("static const struct embedding_reference embedding_reference[] = {")
    for a in (0.0, -0.5, 0.9, 0.998, 1 - 1e-12):
        for r in (2.0, 2.5, 10.0, 1e5):
            print("    { %s, %s, %s }," % (a.hex(), r, ", ".join(map(c, embedding(mpf(a), mpf(r))))))
    print("};\n\n#endif")


if __name__ == "__main__":
    main()
