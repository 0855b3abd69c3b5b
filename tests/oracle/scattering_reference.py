#!/usr/bin/env python3
"""Light from a deep atmosphere of free electrons, to 20 digits. Writes scattering_reference.h:

python3 tests/oracle/scattering_reference.py > tests/oracle/scattering_reference.h          (needs mpmath; a minute)

kerrd finds the H functions by iteration of their integral equation at the nodes of a quadrature. This program computes
them one by one from the closed integral (S. Chandrasekhar, Radiative Transfer, 1960, section 39, equation 48)

    ln H(mu) = -(mu/pi) Int_0^inf ln T(i y) dy/(y^2 + mu^2),   T(i y) = 1 - 2 y^2 Int_0^1 psi(m) dm/(y^2 + m^2),

whose inner integral is elementary for psi = s (1 - m^2): (1 + y^2) atan(1/y)/y - 1 for s = 1. The emergent light is
I_l = q H_l, I_r = H_r (mu + c), up to a factor (section 68, equation 139). Here q, c and the factor follow from two
physical conditions: straight up both directions of polarisation are equal, and twice the integral of I mu is the flux.
kerrd has the second one from q^2 = 2 (1 - c^2) instead, so that this relation is tested too.
"""

from mpmath import atan, exp, inf, log, mp, mpf, nstr, pi, quad, sqrt
from mpmath.calculus.quadrature import GaussLegendre

mp.dps = 30
ROWS = 40


def t_of(s, y):
    # the terms cancel, so the series in x = 1/y^2 is used; its first term is 0 where scattering is conservative
    if y > 1000:
        x = 1 / (y * y)
        rest = sum((-x) ** n * (mpf(1) / (2 * n + 1) - mpf(1) / (2 * n + 3)) for n in range(1, 8))
        return (1 - 4 * s / 3) - 2 * s * rest
    return 1 - 2 * s * y * y * ((1 + y * y) * atan(1 / y) / y - 1)


def h_of(s, mu):
    if mu == 0:
        return mpf(1)
    places = sorted({0, mu, 1, 10, 1000, inf})
    return exp(-mu / pi * quad(lambda y: log(t_of(s, y)) / (y * y + mu * mu), places))


def main():
    s_l, s_r = mpf(3) / 4, mpf(3) / 8
    rule = [((1 + x) / 2, w / 2) for x, w in GaussLegendre(mp).calc_nodes(4, 100)]  # quadrature in x, with mu = x^2
    moment_l = sum(w * 2 * x * x**2 * h_of(s_l, x**2) for x, w in rule)
    moment_r = [sum(w * 2 * x * x ** (2 * k) * h_of(s_r, x**2) for x, w in rule) for k in (1, 2)]
    l1, r1 = h_of(s_l, mpf(1)), h_of(s_r, mpf(1))
    # f (q l1 - (1 + c) r1) = 0 and 2 f (q moment_l + moment_r[1] + c moment_r[0]) = 1, f = 3/(8 sqrt(2))
    f = mpf(3) / (8 * sqrt(2))
    c = (1 / (2 * f) - moment_r[1] - moment_l * r1 / l1) / (moment_r[0] + moment_l * r1 / l1)
    q = (1 + c) * r1 / l1
    print("/* Made by tests/oracle/scattering_reference.py. */")
    print(f"/* c = {nstr(c, 12)}, q = {nstr(q, 12)}; Chandrasekhar has 0.872941 and 0.689893 */")
    print("static const struct { double mu, across, along; } scattering_reference[] = {")
    for k in range(ROWS + 1):
        mu = (mpf(k) / ROWS) ** 2
        across, along = f * (mu + c) * h_of(s_r, mu), f * q * h_of(s_l, mu)
        print(f"    {{ {nstr(mu, 17)}, {nstr(across, 17)}, {nstr(along, 17)} }},")
    print("};")


main()
