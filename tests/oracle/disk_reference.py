#!/usr/bin/env python3
"""Reference numbers for the thin disk, as the C table disk_reference.h.

python3 tests/oracle/disk_reference.py > tests/oracle/disk_reference.h (needs mpmath)

Flux: the defining integral of Page & Thorne 1974 (eqs 11b and 12), by quadrature; the orbits come from the metric
alone:

F/Mdot = 1/(4 pi r) (-dW/dr) (E - W L)^-2 Integral from ISCO to r of (E - W L) dL/dr dr

Their closed form 15n is not used. Peak: where the slope of this flux is zero, by bisection. Temperature: in cgs units,
from G and the Sun's mass in grams instead of from their product.
"""

from kerr_reference import c, metric, orbit, orbits
from mpmath import findroot, mp, mpf, pi, quad

mp.dps = 30
SPINS = [-0.998, -0.5, 0.0, 1e-9, 0.5, 0.9, 0.998, 0.9999]
STRETCH = [1.0009765625, 1.015625, 1.25, 1.5, 2.0, 4.0, 16.0, 1000.0]  # r over the ISCO


def slopes(a, r):
    """dW/dr and dL/dr, by differentiating the geodesic condition, the normalisation u.u = -1 and L = u_phi."""
    (_, tp, pp), (tt1, tp1, pp1) = metric(a, r)
    tt2, tp2, pp2 = -2 * tt1 / r, -2 * tp1 / r, 2 + 4 * a * a / r**3
    w, _, momentum, ut = orbit(a, r)
    dw = -(tt2 + 2 * tp2 * w + pp2 * w * w) / (2 * (tp1 + pp1 * w))
    return dw, (tp1 + pp1 * w + pp * dw) * ut + momentum * ut**2 * (tp + pp * w) * dw


def flux(a, r, isco):
    def share(x):
        w, energy, momentum, _ = orbit(a, x)
        return (energy - w * momentum) * slopes(a, x)[1]

    # the integral is in ln r and in pieces, because the integrand changes quickly near the ISCO and slowly far out
    edges = [isco * (r / isco) ** (mpf(i) / 4) for i in range(5)]
    total = quad(lambda y: share(mp.e**y) * mp.e**y, [mp.log(x) for x in edges], method="gauss-legendre")
    w, energy, momentum, _ = orbit(a, r)
    return -slopes(a, r)[0] / (energy - w * momentum) ** 2 * total / (4 * pi * r)


def peak(a, isco):
    """The radius at which the slope of the flux is zero. The slope is computed by differences, with an error of some
    1e-16 of the radius."""
    f, h = lambda r: flux(a, r, isco), mpf(10) ** -9
    top = findroot(
        lambda r: f(r * (1 + h)) / f(r * (1 - h)) - 1,
        (isco * mpf("1.15"), isco * mpf("2.1")),
        solver="anderson",
        tol=mpf(10) ** -28,
        verify=False,
    )
    return top, flux(a, top, isco)


def temperature(a, r, mass, mdot):
    """Effective temperature in K. F is in erg/s/cm^2 and follows from masses in grams: CODATA 2018, the Sun's mass
    1.98841e33 g."""
    G, sun, light = mpf("6.67430e-8"), mpf("1.98841e33"), mpf("2.99792458e10")
    proton, thomson, stefan = mpf("1.67262192369e-24"), mpf("6.6524587321e-25"), mpf("5.670374419e-5")
    isco = orbits(a)[2]
    eddington = 4 * pi * G * mass * sun * proton * light / thomson  # erg/s
    rate = mdot * eddington / ((1 - orbit(a, isco)[1]) * light**2)  # g/s
    length = G * mass * sun / light**2
    return (flux(a, r, isco) * rate * light**2 / length**2 / stefan) ** mpf("0.25")


def main():
    print("/* Made by tests/oracle/disk_reference.py; do not edit. Page & Thorne's integral by quadrature. */")
    print("#ifndef KD_TESTS_DISK_REFERENCE_H\n#define KD_TESTS_DISK_REFERENCE_H\n")
    print("struct flux_reference { double a, r, flux; };\nstruct peak_reference { double a, r, flux; };")
    print("struct temperature_reference { double a, r, mass_msun, mdot_edd, kelvin; };\n")
    print("static const struct flux_reference flux_reference[] = {")
    for spin in SPINS:
        isco = orbits(mpf(spin))[2]
        for stretch in STRETCH:
            r = float(isco) * stretch
            print("    { %s, %s, %s }," % (float(spin).hex(), r.hex(), c(flux(mpf(spin), mpf(r), isco))))
    print("};\n\nstatic const struct peak_reference peak_reference[] = {")
    for spin in (-0.9, 0.0, 0.9, 0.998, 0.9999):
        r, top = peak(mpf(spin), orbits(mpf(spin))[2])
        print("    { %s, %s, %s }," % (float(spin).hex(), mp.nstr(r, 17), c(top)))
    print("};\n\nstatic const struct temperature_reference temperature_reference[] = {")
    for spin, r, mass, mdot in ((0.0, 10, 10, 0.1), (0.0, 9.5, 10, 0.1), (0.9, 5, 1e8, 0.3), (-0.5, 30, 4.3e6, 1e-3)):
        kelvin = temperature(mpf(spin), mpf(r), mpf(mass), mpf(mdot))
        print("    { %s, %s, %s, %s, %s }," % (float(spin).hex(), r, mass, mdot, mp.nstr(kelvin, 10)))
    print("};\n\n#endif")


if __name__ == "__main__":
    main()
