/* Tests of returning radiation. The test integrates Hamilton's equations of rays in ingoing Kerr-Schild coordinates
 * by a Runge-Kutta method. Its rays go forward in time, from a grid of emission radii and directions in the gas's
 * frame. The code under test integrates over the sky of the receiver by the closed form. Gas and its frame are found by
 * contraction with the metric.
 *
 *     unit_physics_returning [RAYS]     a long run: 2000000 rays in all instead of 200000 */
#include "physics/disk/returning.h"
#include "physics/disk/thin_disk.h"
#include "physics/math/quadrature.h"
#include "physics/spacetime/kerr.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))

static double rays = 200000;
/* Error of a sum over the rays, relative. */
static double grain(void) { return 3 / sqrt(rays); }

static void within(const char *what, double a, double got, double want, double allowed)
{
    if (!(fabs(got - want) <= allowed))
        fail_msg("%s at a = %g: %.9g, not %.9g: off by %.2g, allowed %.2g", what, a, got, want, fabs(got - want),
                 allowed);
}

/* r, theta, p_r, p_theta in ingoing Kerr-Schild coordinates; E and L are constant. With Sigma H as Hamiltonian, whose
 * parameter is not affine, light has the same paths:
 *
 *   2 Sigma H = Delta p_r^2 + 2 (a L - B E) p_r + p_theta^2 + L^2/sin^2(theta) - (Sigma + B) E^2,  B = 2r - q^2. */
struct flight { double a, q2, e, l; };

static void rates(const struct flight *f, const double y[4], double out[4])
{
    const double r = y[0], c = cos(y[1]), s = sin(y[1]), a = f->a, e = f->e, l = f->l, b = 2 * r - f->q2;
    out[0] = (r * r - b + a * a) * y[2] + a * l - b * e;
    out[1] = y[3];
    out[2] = (r + 1) * e * e + 2 * e * y[2] - (r - 1) * y[2] * y[2];
    out[3] = l * l * c / (s * s * s) - a * a * e * e * c * s;
}

/* Makes a step by the method of Dormand & Prince 1980, J. Comput. Appl. Math. 6, 19. Returns an estimate of the error
 * over the tolerance. */
static double step(const struct flight *f, const double y[4], double h, double out[4])
{
    static const double b[7][6] = { { 0 },
                                    { 1. / 5 },
                                    { 3. / 40, 9. / 40 },
                                    { 44. / 45, -56. / 15, 32. / 9 },
                                    { 19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729 },
                                    { 9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656 },
                                    { 35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84 } },
                        less[7] = { 71. / 57600, 0, -71. / 16695, 71. / 1920, -17253. / 339200, 22. / 525, -1. / 40 };
    double k[7][4], error = 0;
    for (int i = 0; i < 7; i++) {
        double at[4];
        for (int j = 0; j < 4; j++) {
            at[j] = y[j];
            for (int n = 0; n < i; n++)
                at[j] += h * b[i][n] * k[n][j];
        }
        rates(f, at, k[i]);
        if (i == 6)
            for (int j = 0; j < 4; j++)
                out[j] = at[j];
    }
    for (int j = 0; j < 4; j++) {
        double sum = 0;
        for (int i = 0; i < 7; i++)
            sum += less[i] * k[i][j];
        const double scale = j == 0 ? fabs(y[0]) : j == 1 ? 1 : fabs(y[j]) + 1;
        error = fmax(error, fabs(h * sum) / (1e-6 * scale));
    }
    return error;
}

/* The metric in the equatorial plane, order t, r, theta, phi. */
static double product(const struct flight *f, double r, const double x[4], const double y[4])
{
    const double b = (2 * r - f->q2) / (r * r), a = f->a, lx = x[0] + x[1] - a * x[3], ly = y[0] + y[1] - a * y[3];
    return -x[0] * y[0] + x[1] * y[1] + r * r * x[2] * y[2] + (r * r + a * a) * x[3] * y[3] -
           a * (x[1] * y[3] + x[3] * y[1]) + b * lx * ly;
}

static void take_off(const struct flight *f, double r, double x[4], const double leg[4], double sign)
{
    const double part = sign * product(f, r, x, leg);
    for (int i = 0; i < 4; i++)
        x[i] -= part * leg[i];
}

static void normalise(const struct flight *f, double r, double x[4])
{
    const double size = sqrt(fabs(product(f, r, x, x)));
    for (int i = 0; i < 4; i++)
        x[i] /= size;
}

/* Velocity of gas on a circular geodesic: the derivative of u.u by r vanishes. */
static void gas_at(const struct flight *f, double r, double u[4])
{
    const double fall = -2 / (r * r) + 2 * f->q2 / (r * r * r), a = f->a, tt = fall, tp = -a * fall,
                 pp = 2 * r + a * a * fall;
    u[0] = 1, u[1] = u[2] = 0, u[3] = (-tp + sqrt(tp * tp - tt * pp)) / pp;
    normalise(f, r, u);
}

/* The end of one ray. r: the radius where it meets the disk, 0 if it falls into the hole, INFINITY if it escapes.
 * energy, momentum: E and L at infinity of light with energy 1 in the gas's frame. */
struct end { double r, energy, momentum; };

static struct end fly(const struct kd_hole *hole, double isco, double r, double mu, double azimuth)
{
    struct flight f = { .a = hole->a, .q2 = hole->q * hole->q };
    double u[4], along[4] = { 0, 0, 0, 1 }, out[4] = { 0, 1, 0, 0 }, k[4], y[4], next[4], h = 1e-3 / r;
    gas_at(&f, r, u);
    take_off(&f, r, along, u, -1);
    normalise(&f, r, along);
    take_off(&f, r, out, u, -1);
    take_off(&f, r, out, along, 1);
    normalise(&f, r, out);
    const double level = sqrt(1 - mu * mu);
    for (int i = 0; i < 4; i++)
        k[i] = u[i] + level * (cos(azimuth) * out[i] + sin(azimuth) * along[i]);
    k[2] = -mu / r;
    const double legs[3][4] = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 0, 1 } };
    f.e = -product(&f, r, k, legs[0]), f.l = product(&f, r, k, legs[2]);
    y[0] = r, y[1] = M_PI / 2, y[2] = product(&f, r, k, legs[1]), y[3] = -r * mu;
    for (int i = 0, side = -1; i < 20000; i++) {
        const double error = step(&f, y, h, next);
        if (error > 1) {
            h *= fmax(0.2, 0.9 * pow(error, -0.25));
            continue;
        }
        if ((next[1] - M_PI / 2) * side < 0) { /* interpolates by the cubic through both ends and their slopes */
            double d0[4], d1[4], low = 0, high = 1;
            rates(&f, y, d0);
            rates(&f, next, d1);
            double at[2] = { 0, 0 };
            for (int n = 0; n < 50; n++) {
                const double x = 0.5 * (low + high), z = 1 - x;
                for (int j = 0; j < 2; j++)
                    at[j] = z * z * (1 + 2 * x) * y[j] + x * x * (1 + 2 * z) * next[j] +
                            h * x * z * (z * d0[j] - x * d1[j]);
                *((at[1] - M_PI / 2) * side > 0 ? &low : &high) = x;
            }
            if (at[0] >= isco)
                return (struct end) { at[0], f.e, f.l };
            side = -side;
        }
        for (int j = 0; j < 4; j++)
            y[j] = next[j];
        if (y[0] < hole->outer)
            return (struct end) { 0, f.e, f.l };
        if (y[0] > 1e4 * r)
            return (struct end) { INFINITY, f.e, f.l };
        h *= fmin(4, 0.9 * pow(fmax(error, 1e-8), -0.2));
    }
    fail_msg("a ray from %g at a = %g does not end", r, hole->a);
    return (struct end) { 0 };
}

/* Direction i of side^2 directions. They form a grid about the direction to the hole, at angles rho from it; its rows
 * are shifted. For distant gas they are dense where light is bent back to the disk. weight: mu dOmega/pi. */
struct direction { double mu, azimuth, weight; };

static struct direction direction_of(double r, int i, int side)
{
    const double v = (i / side + 0.5) / side, shift = fmod(0.6180339887498949 * (i / side) + 0.3819660112501051 * r, 1),
                 c = 2 * (i % side + shift) / side - 1, b = 1 + log(r), rho = M_PI * sinh(b * v) / sinh(b),
                 level = sin(rho) * c;
    return (struct direction) { sin(rho) * sqrt((1 - c) * (1 + c)), atan2(level, -cos(rho)),
                                2 * b * cosh(b * v) / sinh(b) * pow(sin(rho), 2) / (side * side) };
}

static void add(struct kd_returning_shares *shares, double r, double weight)
{
    *(r == 0 ? &shares->falls_in : isfinite(r) ? &shares->returns : &shares->escapes) += weight;
}

static void shares_agree(const char *what, double a, const struct kd_returning_shares *got,
                         const struct kd_returning_shares *want)
{
    printf("    %s, a = %g: returns %.6f, by rays %.6f (%+.2e), falls in %.6f, %.6f, escapes %.6f, %.6f\n", what, a,
           got->returns, want->returns, got->returns / want->returns - 1, got->falls_in, want->falls_in, got->escapes,
           want->escapes);
    within("light that returns", a, got->returns, want->returns, (3e-3 + grain()) * want->returns);
    within("light that falls in", a, got->falls_in, want->falls_in, 3e-3 * want->falls_in + 0.05 * grain());
    within("light that escapes", a, got->escapes, want->escapes, 3e-3 * want->escapes);
}

static const struct kd_hole *holes(size_t i)
{
    static struct kd_hole all[4];
    const double spins[] = { 0, 0.9, 0.998 };
    all[i] = i < 3 ? kd_hole_of(spins[i]) : kd_hole_charged(0.5, 0.6);
    return &all[i];
}

/* Light of rings at the ISCO and at 3 times its radius arrives where the test's rays arrive. */
static void light_of_a_ring_goes_where_followed_rays_go(void **state)
{
    (void)state;
    for (size_t n = 0; n < 4; n++)
        for (int far = 0; far < 2; far++) {
            const struct kd_hole *hole = holes(n);
            const enum kd_limb limb = n == 1 ? KD_LIMB_LAOR : KD_LIMB_ISOTROPIC;
            const double isco = kd_kerr_isco(hole), r = isco * (far ? 3 : 1 + 1e-9);
            const struct kd_returning_ring got = kd_returning_ring(hole, limb, r);
            struct kd_returning_ring want = { .error = 0 };
            const int side = (int)sqrt(rays / 16);
            double photons = 0, energy = 0;
            for (int i = 0; i < side * side; i++) {
                const struct direction d = direction_of(r, i, side);
                const struct end end = fly(hole, isco, r, d.mu, d.azimuth);
                const double part = kd_limb_at(limb, d.mu) * kd_limb_scale(limb) * d.weight;
                add(&want.photons, end.r, part);
                add(&want.energy, end.r, part * end.energy);
                photons += part, energy += part * end.energy;
            }
            within("sum of the directions", hole->a, photons, 1, 1e-3);
            want.energy.returns /= energy, want.energy.falls_in /= energy, want.energy.escapes /= energy;
            shares_agree(far ? "photons of 3 ISCO" : "photons of the ISCO", hole->a, &got.photons, &want.photons);
            shares_agree(far ? "energy of 3 ISCO" : "energy of the ISCO", hole->a, &got.energy, &want.energy);
            within("sum of the shares", hole->a, got.error, 0, 1e-5);
        }
}

enum { BINS = 8, RINGS = 24 };
/* Light of the whole disk of Page & Thorne. shares: shares of its luminosity. energy, deficit: for s = 1/8, 2/8, ...,
 * what the rings within r = r_isco/s^2 receive. energy is measured in the gas's frame. deficit is the angular momentum
 * that the light lacks compared with the gas. */
struct sums {
    struct kd_returning_shares shares;
    double energy[BINS], deficit[BINS], momentum; /* momentum: L of the gas times the energy, summed over all rings */
};

static double area(const struct kd_hole *hole, double isco, double s) /* 4 pi r dr/ds over the efficiency */
{
    return 8 * M_PI * isco * isco / pow(s, 5) / kd_kerr_efficiency(hole);
}

static void sum_rays(const struct kd_hole *hole, enum kd_limb limb, struct sums *sums)
{
    const double isco = kd_kerr_isco(hole);
    const int side = (int)sqrt(rays / 4 / RINGS);
    double at[RINGS], weight[RINGS];
    kd_gauss_legendre(RINGS, at, weight);
    for (int i = 0; i < RINGS * side * side; i++) {
        const int ring = i / (side * side);
        const double s = at[ring], r = isco / (s * s);
        const struct direction d = direction_of(r, i % (side * side), side);
        const struct end end = fly(hole, isco, r, d.mu, d.azimuth);
        double u[4];
        const double part = area(hole, isco, s) * kd_disk_flux_page_thorne(hole, r) * kd_limb_at(limb, d.mu) *
                            kd_limb_scale(limb) * d.weight * weight[ring];
        add(&sums->shares, end.r, part * end.energy);
        if (!(end.r > 0) || !isfinite(end.r))
            continue;
        const struct flight f = { .a = hole->a, .q2 = hole->q * hole->q };
        const double along[4] = { 0, 0, 0, 1 };
        gas_at(&f, end.r, u);
        const double seen = u[0] * end.energy - u[3] * end.momentum, own = product(&f, end.r, u, along);
        sums->momentum += part * own * seen;
        for (int b = (int)(BINS * sqrt(isco / end.r)); b >= 0; b--)
            if (b < BINS)
                sums->energy[b] += part * seen, sums->deficit[b] += part * (own * seen - end.momentum);
    }
}

/* Sums over the rings with s of at least b/BINS. */
static void sum_table(const struct kd_returning *table, struct sums *sums)
{
    const int points = 1024;
    sums->shares = table->first;
    for (int i = 0; i < points; i++) {
        const double s = (i + 0.5) / points, r = table->isco / (s * s),
                     da = area(&table->hole, table->isco, s) / points;
        for (int b = (int)(BINS * s); b >= 0; b--) {
            sums->energy[b] += da * kd_returning_at(table, table->once, r);
            sums->deficit[b] += da * kd_returning_at(table, table->lacks, r) / s;
        }
    }
}

static void the_kernel_is_that_of_followed_rays(void **state)
{
    (void)state;
    struct kd_returning *table = malloc(sizeof *table);
    assert_non_null(table);
    for (size_t n = 0; n < 4; n++) {
        const struct kd_hole *hole = holes(n);
        const enum kd_limb limb = n == 1 ? KD_LIMB_LAOR : KD_LIMB_ISOTROPIC;
        struct sums got = { .energy = { 0 } }, want = { .energy = { 0 } };
        kd_returning_init(table, hole, limb);
        sum_table(table, &got);
        sum_rays(hole, limb, &want);
        shares_agree("the disk", hole->a, &got.shares, &want.shares);
        for (int b = 0; b < BINS; b++) {
            printf("    from s = %.3f: energy %+.2e, deficit %+.2e of all\n", (double)b / BINS,
                   (got.energy[b] - want.energy[b]) / want.energy[0],
                   (got.deficit[b] - want.deficit[b]) / want.momentum);
            within("energy received", hole->a, got.energy[b] / want.energy[0], want.energy[b] / want.energy[0],
                   3e-3 + grain());
            /* L of the gas grows outwards, and only a few rays arrive that far out. */
            if (b)
                within("angular momentum lacking", hole->a, got.deficit[b] / want.momentum,
                       want.deficit[b] / want.momentum, 3e-3 + 2 * grain());
        }
    }
    free(table);
}

/* The gas radiates exactly the energy that accretion releases. E at infinity of all light that leaves the converged
 * disk for good is 1 - E(ISCO), and the light that returns for the first time arrives without loss. The work F_t of the
 * stress is part of this balance. */
static void energy_is_conserved(void **state)
{
    (void)state;
    const double spins[] = { -0.998, -0.5, 0, 0.3, 0.7, 0.9, 0.95, 0.99, 0.998, 0.9999 };
    struct kd_returning *table = malloc(sizeof *table);
    assert_non_null(table);
    for (size_t i = 0; i < COUNT(spins); i++)
        for (enum kd_limb limb = KD_LIMB_ISOTROPIC; limb <= KD_LIMB_SCATTERING; limb++) {
            if (limb && i % 4)
                continue;
            kd_returning_init(table, kd_hole(spins[i]), limb);
            const struct kd_returning_shares *first = &table->first, *last = &table->lastly;
            printf("    a = %g, law %d: first %.6f returns, %.6f falls in; at last %.6f falls in; told %.1e\n",
                   spins[i], (int)limb, first->returns, first->falls_in, last->falls_in, table->error);
            within("first", spins[i], first->returns + first->falls_in + first->escapes, 1,
                   limb > KD_LIMB_LAOR ? 5e-5 : 1e-6);
            within("at last", spins[i], last->falls_in + last->escapes, 1, 2e-4);
            within("told error", spins[i], table->error, 0, 1e-3);
            assert_true(table->error >= fabs(last->falls_in + last->escapes - 1));
            for (double r = table->isco * 1.03; r < 1e4; r *= 30) {
                const struct kd_returning_ring ring = kd_returning_ring(&table->hole, limb, r);
                const struct kd_returning_shares photons = kd_returning_shares_at(table, &table->photons, r),
                                                 energy = kd_returning_shares_at(table, &table->energy, r);
                within("photons that return", spins[i], photons.returns, ring.photons.returns, 1e-4);
                within("photons that fall in", spins[i], photons.falls_in, ring.photons.falls_in, 1e-4);
                within("energy that returns", spins[i], energy.returns, ring.energy.returns, 1e-4);
                within("energy that escapes", spins[i], energy.escapes, ring.energy.escapes, 1e-4);
            }
        }
    free(table);
}

/* Flux times temperature of the light that arrives at rings with s of at least b/BINS, by rays. They start from a disk
 * with the fluxes and temperatures of the reflection under test, which must give the same result. */
static void reflected_light_is_as_warm_as_followed_rays(void **state)
{
    (void)state;
    struct kd_returning *table = malloc(sizeof *table);
    assert_non_null(table);
    for (size_t n = 1; n < 4; n++) {
        const struct kd_hole *hole = holes(n);
        struct kd_reflection reflection;
        double at[RINGS], weight[RINGS], got[BINS] = { 0 }, want[BINS] = { 0 }, arrives = 0, flux = 0;
        kd_returning_init(table, hole, KD_LIMB_ISOTROPIC);
        kd_reflection_init(&reflection, table, 0.9);
        kd_gauss_legendre(RINGS, at, weight);
        const int side = (int)sqrt(rays / 8 / RINGS), points = 1024;
        for (int i = 0; i < RINGS * side * side; i++) {
            const int ring = i / (side * side);
            const double s = at[ring], r = table->isco / (s * s);
            const struct kd_reflected light = kd_reflection_at(&reflection, table, r);
            const struct direction d = direction_of(r, i % (side * side), side);
            const struct end end = fly(hole, table->isco, r, d.mu, d.azimuth);
            if (!(end.r > 0) || !isfinite(end.r))
                continue;
            const struct flight f = { .a = hole->a, .q2 = hole->q * hole->q };
            double u[4];
            gas_at(&f, end.r, u);
            const double seen = u[0] * end.energy - u[3] * end.momentum,
                         part = area(hole, table->isco, s) * d.weight * weight[ring] * seen;
            flux += part * (light.absorbed + light.flux);
            for (int b = (int)(BINS * sqrt(table->isco / end.r)); b >= 0; b--)
                if (b < BINS)
                    want[b] += part * seen * (pow(light.absorbed, 1.25) + light.flux * light.warm);
        }
        for (int i = 0; i < points; i++) {
            const double s = (i + 0.5) / points, r = table->isco / (s * s),
                         back = area(hole, table->isco, s) / points * kd_returning_at(table, table->back, r);
            arrives += back;
            for (int b = (int)(BINS * s); b >= 0; b--)
                got[b] += back * kd_reflection_at(&reflection, table, r).warm;
        }
        within("flux that returns", hole->a, arrives / flux, 1, 3e-3 + 2 * grain());
        for (int b = 0; b < BINS; b++) {
            printf("    a = %g, from s = %.3f: warmth %+.2e of all\n", hole->a, (double)b / BINS,
                   (got[b] - want[b]) / want[0]);
            /* tolerance: because of the factor g^2 a few rays dominate, especially for fast holes; the error falls
             * as the number of rays */
            within("warmth", hole->a, got[b] / want[0], want[b] / want[0], 3e-3 + (hole->a > 0.99 ? 10 : 3) * grain());
        }
    }
    free(table);
}

/* Reflected light carries away the light that returns. The sum of the two fluxes is the flux of a disk that absorbs all
 * light. Neither is negative. */
static void reflection_changes_no_flux(void **state)
{
    (void)state;
    const double spins[] = { -0.9, 0, 0.5, 0.9, 0.998 };
    struct kd_returning *table = malloc(sizeof *table);
    assert_non_null(table);
    for (size_t i = 0; i < COUNT(spins); i++)
        for (double albedo = 0; albedo <= 1; albedo += 0.25) {
            struct kd_reflection reflection;
            kd_returning_init(table, kd_hole(spins[i]), KD_LIMB_ISOTROPIC);
            kd_reflection_init(&reflection, table, albedo);
            for (double r = table->isco; r < 1e5; r *= 1.1) {
                const struct kd_reflected light = kd_reflection_at(&reflection, table, r);
                const double all = kd_returning_flux(table, r);
                within("sum", spins[i], light.absorbed + light.flux, all, 1e-12 * all);
                assert_true(light.absorbed >= 0 && light.flux >= 0 && light.warm > 0);
                assert_true(all <= table->largest * (1 + 1e-12));
                if (r > 1.02 * table->isco)
                    within("share", spins[i], light.flux, albedo * kd_returning_at(table, table->back, r), 1e-12 * all);
            }
        }
    free(table);
}

/* A disk that radiates only by a torque at the ISCO, F ~ -Omega'/(r (E - Omega L)^2). E. Agol & J. H. Krolik 2000, ApJ
 * 528, 161, abstract: up to 58 % of its light returns, at a = 0.998. They followed random rays. */
static void published_share_of_a_disk_with_torque(void **state)
{
    (void)state;
    const struct kd_hole *hole = kd_hole(0.998);
    struct kd_returning *table = malloc(sizeof *table);
    double all = 0, returns = 0;
    assert_non_null(table);
    kd_returning_init(table, hole, KD_LIMB_ISOTROPIC);
    for (double s = 0.0005; s < 1; s += 0.001) {
        const double r = table->isco / (s * s), omega = kd_kerr_omega(hole, r), ut = kd_kerr_ut(hole, r),
                     flux = 1.5 * sqrt(r) * omega * omega * ut * ut / r,
                     light = flux * r / (s * s * s) * kd_kerr_energy(hole, r);
        all += light;
        returns += light * kd_returning_shares_at(table, &table->energy, r).returns;
    }
    within("share that returns", 0.998, returns / all, 0.58, 0.01);
    /* K. S. Thorne 1974, ApJ 191, 507, abstract: since the hole captures light, the efficiency is 30 %. */
    within("efficiency", 0.998, kd_kerr_efficiency(hole) * table->lastly.escapes, 0.30, 6e-3);
    free(table);
}

int main(int argc, char **argv)
{
    if (argc > 1)
        rays = strtod(argv[1], NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_of_a_ring_goes_where_followed_rays_go),
        cmocka_unit_test(the_kernel_is_that_of_followed_rays),
        cmocka_unit_test(energy_is_conserved),
        cmocka_unit_test(reflected_light_is_as_warm_as_followed_rays),
        cmocka_unit_test(reflection_changes_no_flux),
        cmocka_unit_test(published_share_of_a_disk_with_torque),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
