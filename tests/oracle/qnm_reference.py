#!/usr/bin/env python3
"""Reference numbers for the quasi-normal modes of Kerr, as the C table qnm_reference.h.

python3 tests/oracle/qnm_reference.py > tests/oracle/qnm_reference.h      (needs mpmath and numpy; a few minutes)

No continued fraction is used. Radial: Teukolsky's equation in r itself. The wave into the horizon is a power series in
r - r+. The outgoing wave is an asymptotic series in 1/r, far out along the ray arg r = pi/2 - arg omega, on which the
wave decays. From there it is continued by Taylor series through the upper half plane to r = 10, and on to r+ + (r+ -
r-)/4, where the two waves must agree. Angular: the eigenvalue in the basis of spin-weighted spherical harmonics (Cook &
Zalutskiy 2014, Phys. Rev. D 90, 124021, section II.C). Modes are followed from a = 0 in small steps, starting with
published Schwarzschild values of four digits (Leaver 1985, table 1; l = 4: Iyer 1987, Phys. Rev. D 35, 3632).
"""

import cmath

import numpy as np
from mpmath import exp, eye, log, lu_solve, matrix, mp, mpc, mpf, nstr, sqrt

S = -2
SEEDS = {
    (2, 0): 0.3737 - 0.0890j,
    (2, 1): 0.3467 - 0.2739j,
    (2, 2): 0.3011 - 0.4783j,
    (2, 3): 0.2515 - 0.7051j,
    (3, 0): 0.5993 - 0.0927j,
    (3, 1): 0.5824 - 0.2814j,
    (4, 0): 0.8092 - 0.0942j,
}
SPINS = [0.0, 0.2, 0.5, 0.8, 0.95, 0.99, 0.999]
EXTREME = [(2, 2, 0), (2, 2, 1), (2, 0, 0)]  # these modes are followed up to 0.9999
MODES = [(2, m, n) for n in (0, 1) for m in range(-2, 3)] + [
    (2, 2, 2),
    (2, -2, 3),
    (2, 0, 3),
    (2, 1, 2),
    (3, 3, 0),
    (3, 3, 1),
    (3, -1, 1),
    (4, 4, 0),
]


def angular_matrix(m, c, number):
    """-A as the matrix of the angular equation. cos(theta) is tridiagonal in the harmonics l."""
    first, size = max(abs(m), -S), 18
    ls = [first + k for k in range(size + 1)]
    step = [
        number(((l + 1) ** 2 - m * m) * ((l + 1) ** 2 - S * S)) / ((2 * l + 1) * (2 * l + 3) * (l + 1) ** 2) for l in ls
    ]
    up = [x ** (number(1) / 2) for x in step]
    cos = [[number(0)] * (size + 1) for _ in ls]
    for k, l in enumerate(ls):
        cos[k][k] = number(-m * S) / (l * (l + 1))
        if k:
            cos[k][k - 1] = cos[k - 1][k] = up[k - 1]
    out = [[number(0) * c] * size for _ in range(size)]
    for i in range(size):
        for j in range(max(0, i - 2), min(size, i + 3)):
            square = sum(
                cos[i][k] * cos[k][j] for k in range(max(0, i - 1, j - 1), min(size, i + 1, j + 1) + 1) if k <= size
            )
            out[i][j] = -c * c * square + 2 * c * S * cos[i][j]
        out[i][i] += ls[i] * (ls[i] + 1) - S * (S + 1)
    return out


def separation(m, c, near, exact):
    """The eigenvalue next to `near`; with `exact` it is improved by Rayleigh quotients."""
    values, vectors = np.linalg.eig(np.array(angular_matrix(m, complex(c), float)))
    k = int(np.argmin(abs(values - complex(near))))
    if not exact:
        return complex(values[k])
    rows = matrix(angular_matrix(m, c, mpf))
    v, value = matrix([mpc(complex(x)) for x in vectors[:, k]]), mpc(complex(values[k]))
    for _ in range(2):
        v = lu_solve(rows - (value + mpf(10) ** -20) * eye(len(v)), v)
        v /= max(abs(x) for x in v)
        value = (v.T * rows * v)[0] / (v.T * v)[0]
    return value


def polynomials(a, m, omega, lam, at):
    """Delta^2 R'' + p1 R' + p0 R = 0, as coefficients of powers of r - at."""

    def times(x, y):
        out = [0 * at] * (len(x) + len(y) - 1)
        for i, u in enumerate(x):
            for j, v in enumerate(y):
                out[i + j] += u * v
        return out

    delta, half = [at * at - 2 * at + a * a, 2 * at - 2, 1], [at - 1, 1]
    k = [(at * at + a * a) * omega - a * m, 2 * at * omega, omega]
    p2, p1 = times(delta, delta), [2 * (S + 1) * x for x in times(half, delta)]
    spin = [-2j * S * x for x in times(half, k)] + [0]
    rest = times([4j * S * omega * at - lam, 4j * S * omega], delta) + [0]
    return p2, p1, [x + y + z for x, y, z in zip(times(k, k), spin, rest)]


def advance(a, m, omega, lam, at, to, y, dy, terms):
    """Taylor's series of the solution with value y and slope dy, from `at` to `to`."""
    p2, p1, p0 = polynomials(a, m, omega, lam, at)
    c = [y, dy]
    for k in range(terms):
        total = sum(p0[j] * c[k - j] for j in range(min(k, 4) + 1))
        total += sum(p1[j] * (k - j + 1) * c[k - j + 1] for j in range(min(k + 1, 4)))
        total += sum(p2[j] * (k - j + 2) * (k - j + 1) * c[k - j + 2] for j in range(1, min(k + 1, 4) + 1))
        c.append(-total / (p2[0] * (k + 1) * (k + 2)))
    h, y, dy = to - at, 0, 0
    for k in range(len(c) - 1, -1, -1):
        dy = dy * h + y
        y = y * h + c[k]
    return y, dy


def horizon(a, m, omega, lam, outer, gap, to, terms):
    """Frobenius's series with the exponent of the ingoing wave. The power itself is not a factor of the returned y, but
    is included in dy/y."""
    p2, p1, p0 = polynomials(a, m, omega, lam, outer)
    p2, p1 = p2[2:], p1[1:]  # Delta^2 ~ x^2 and p1 ~ x have exact zeros
    rho = -S - 1j * ((outer**2 + a * a) * omega - a * m) / gap
    c = [1 + 0 * omega]
    for k in range(1, terms):
        total = sum(
            (p2[j] * (k - j + rho) * (k - j + rho - 1) if j < 3 else 0) * c[k - j]
            + (p1[j] * (k - j + rho) if j < 3 else 0) * c[k - j]
            + p0[j] * c[k - j]
            for j in range(1, min(k, 4) + 1)
        )
        c.append(-total / (p2[0] * (k + rho) * (k + rho - 1) + p1[0] * (k + rho) + p0[0]))
    x = to - outer
    y = sum(v * x**k for k, v in enumerate(c))
    return y, sum(v * (k + rho) * x ** (k - 1) for k, v in enumerate(c))


def infinity(a, m, omega, lam, r, terms):
    """exp(i omega r) r^nu (c0 + c1/r + ...), up to the smallest term of the series. The factor before the brackets is
    not included in y, as in `horizon`."""
    p2, p1, p0 = polynomials(a, m, omega, lam, 0 * r)
    p2, p1, p0, nu = p2[::-1], [0] + p1[::-1], p0[::-1], 2j * omega - 1 - 2 * S

    def factor(i, k):
        """The coefficient of r^(4 - i) when the equation is applied to the k-th term."""
        mu, get = nu - k, lambda p, n: p[n] if 0 <= n < len(p) else 0
        return (
            get(p2, i) * -(omega**2)
            + get(p2, i - 1) * 2j * omega * mu
            + get(p2, i - 2) * mu * (mu - 1)
            + get(p1, i) * 1j * omega
            + get(p1, i - 1) * mu
            + get(p0, i)
        )

    c, last = [1 + 0 * omega], abs(r)
    for k in range(1, terms):
        new = -sum(factor(k + 1 - j, j) * c[j] for j in range(max(0, k - 6), k)) / factor(1, k)
        if abs(new / r**k) > last:
            break
        last = abs(new / r**k)
        c.append(new)
    y = sum(v / r**k for k, v in enumerate(c))
    return y, sum(v * (1j * omega + (nu - k) / r) / r**k for k, v in enumerate(c))


def wronskian(a, m, omega, lam, far, terms):
    gap = 2 * (sqrt if isinstance(omega, mpc) else cmath.sqrt)((1 - a) * (1 + a))
    outer, r = 1 + gap / 2, far
    y, dy = infinity(a, m, omega, lam, r, 3 * terms)
    # the path has a corner: near r+ it follows the real axis, because only there the waves keep their size
    for goal in (10 + 0 * r, outer + gap / 4 + 0 * r):
        while r != goal:
            room = 0.5 * min(abs(r - outer), abs(r - outer + gap))
            to = goal if abs(goal - r) <= room else r + (goal - r) / abs(goal - r) * room
            y, dy = advance(a, m, omega, lam, r, to, y, dy, terms)
            r = to
    in_y, in_dy = horizon(a, m, omega, lam, outer, gap, goal, terms)
    return dy * in_y - in_dy * y


def mode(m, a, omega, sep, final):
    """The mode, by the secant method from the guess. Returns None if the guess is too far off. Near a = 1 the wave
    changes fast at the horizon and its series cancels, so that more digits are used."""
    gap = 2 * np.sqrt((1 - a) * (1 + a))
    exact = final or a > 0.6 or omega.imag < -0.4  # 16 digits are not enough for overtones either
    mp.dps = (26 if final else 16) + int(0.5 * abs((2 + gap) * omega - a * m) / gap)
    terms, reach = (4 * mp.dps, 2.5 * mp.dps) if exact else (50, 25)
    small, start = (mpf(10) ** -12, mpf(10) ** -8) if final else (1e-6, 1e-4)
    far = 1j * reach / omega  # fixed for all steps, because the function must be analytic in omega
    if exact:
        a, omega, far = mpf(a), mpc(omega), mpc(far)

    def at(w):
        nonlocal sep
        sep = separation(m, a * w, sep, final)
        # the factor e^(i w r) r^nu that infinity() left out. Without this factor the function has the same root, but
        # almost no slope there
        left = (exp if exact else cmath.exp)(1j * (w - omega) * (far + 2 * (log if exact else cmath.log)(far)))
        return left * wronskian(a, m, w, sep + a * a * w * w - 2 * a * m * w, far, terms)

    x0, x1 = omega, omega * (1 + start)
    f0 = at(x0)
    for _ in range(12):
        f1 = at(x1)
        x0, x1, f0 = x1, x1 - f1 * (x1 - x0) / (f1 - f0), f1
        if abs(x1 - x0) < small * abs(x1):
            return (x1, sep) if final else (complex(x1), complex(sep))
    return None


def follow(l, m, n):
    a, sep = 0.0, complex(l * (l + 1) - S * (S + 1))
    omega, sep = mode(m, a, SEEDS[l, n], sep, False)
    slope, step = 0, 0.05
    for goal in SPINS + ([0.9999] if (l, m, n) in EXTREME else []):
        while a < goal:
            y = -np.log1p(-a)
            to = goal if -np.log1p(-goal) - y < step else float(-np.expm1(-y - step))
            ahead = -np.log1p(-to) - y
            guess = omega + slope * ahead
            new, new_sep = mode(m, to, guess, sep, False) or (0, 0)
            if abs(new - guess) > 0.1 * -omega.imag / (n + 0.5):
                step /= 2
                continue
            slope, a, omega, sep, step = (new - omega) / ahead, to, new, new_sep, min(step * 1.5, 0.6)
        yield goal, mode(m, goal, omega, sep, True)


def main():
    print("/* Made by tests/oracle/qnm_reference.py; do not edit. Teukolsky's equation, matched by Taylor series. */")
    print("#ifndef KD_TESTS_QNM_REFERENCE_H\n#define KD_TESTS_QNM_REFERENCE_H\n")
    print("struct qnm_reference { int l, m, n; double a, re, im, separation_re, separation_im; };\n")
    print("static const struct qnm_reference qnm_reference[] = {")
    for l, m, n in MODES:
        for a, (omega, sep) in follow(l, m, n):
            numbers = ", ".join(nstr(x, 17) for x in (omega.real, omega.imag, sep.real, sep.imag))
            print("    { %d, %d, %d, %s, %s }," % (l, m, n, a, numbers), flush=True)
    print("};\n\n#endif")


if __name__ == "__main__":
    main()
