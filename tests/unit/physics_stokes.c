/* Tests of polarised spectra of a disk whose atmosphere scatters the light that returns. The same light is summed by
 * the Monte Carlo method: over places of the image, and at each over one direction from which light arrives there. All
 * rays are followed in Cartesian Kerr-Schild coordinates, with the vectors of their polarisation
 * (kerr_schild_transport.h); the gas's frame is found by contraction with the metric. Energies are not counted by
 * temperature, no ring is interpolated, and no constant of motion is used. The law of reflection is tested by itself
 * (physics_scattering.c).
 *
 *     unit_physics_stokes [SAMPLES]     samples of each case; with SAMPLES all nine cases */
#include "kerr_schild_transport.h"
#include "physics/disk/disk_stokes.h"
#include "physics/disk/scattering.h"
#include "physics/disk/thin_disk.h"
#include "physics/math/constants.h"
#include "physics/spacetime/kerr.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { ENERGIES = 4, BATCHES = 8 };
#define OUTER 60
#define RADIAN (M_PI / 180)
static const double kev[ENERGIES] = { 2, 3, 5, 8 };
static long samples;

struct disk {
    struct kd_hole hole;
    double theta, isco, largest, hottest_k;
};

/* Planck's law without 2 h nu^3/c^2, at the temperature that is `ratio` times the largest one. */
static double planck(const struct disk *d, double ratio, double energy)
{
    return 1 / expm1(energy * 1e3 * 1.602176634e-19 / (KD_K_J_K * d->hottest_k * ratio));
}

static double heat(const struct disk *d, double r)
{
    return pow(kd_disk_flux_page_thorne(&d->hole, r) / d->largest, 0.25);
}

/* The atmosphere at many cosines; the nearest one is taken. */
enum { FINE = 20000 };
static struct kd_scattered emission[FINE + 1];
static struct kd_scattering_functions reflection[FINE + 1];

static void make_atmosphere(void)
{
    static double mu[FINE + 1];
    for (int i = 0; i <= FINE; i++)
        mu[i] = pow((double)i / FINE, 2);
    kd_scattered_light(mu, FINE + 1, emission);
    kd_scattering_functions(mu, FINE + 1, reflection);
}

static int row(double mu) { return (int)lround(FINE * sqrt(fmin(mu, 1))); }
static struct kd_scattered emitted(double mu) { return emission[row(mu)]; }

/* The last place above the plane and the first below it. */
struct crossing {
    struct ks_carried above, below;
    bool met;
};

static void told(void *user, const struct ks_carried *at)
{
    struct crossing *c = user;
    if (c->met)
        return;
    if (at->x[3] > 0)
        c->above = *at;
    else
        c->below = *at, c->met = c->above.r > 0;
}

static void mean(const double a[4], const double b[4], double x, double out[4])
{
    for (int i = 0; i < 4; i++)
        out[i] = a[i] + x * (b[i] - a[i]);
}

/* Removes from v its component along the unit vector `leg`. sign: the square of leg, +1 or -1. */
static void take_off(const struct ks_carried *at, double v[4], const double leg[4], double sign)
{
    const double part = sign * ks_carried_product(at, v, leg);
    for (int i = 0; i < 4; i++)
        v[i] -= part * leg[i];
}

static void normalise(const struct ks_carried *at, double v[4])
{
    const double size = sqrt(fabs(ks_carried_product(at, v, v)));
    for (int i = 0; i < 4; i++)
        v[i] /= size;
}

/* Velocity of the gas at a crossing, and unit vectors outwards, forwards and along the normal. */
static void frame_of(const struct disk *d, const struct ks_carried *at, double legs[4][4])
{
    const double r = at->r, omega = 1 / (pow(r, 1.5) + d->hole.a);
    ks_carried_vector(at, (const double[4]) { 1, 0, 0, omega }, legs[0]);
    normalise(at, legs[0]);
    memcpy(legs[3], (const double[4]) { 0, 0, 0, 1 }, sizeof legs[3]);
    ks_carried_vector(at, (const double[4]) { 0, 0, 0, 1 }, legs[2]);
    memcpy(legs[1], (const double[4]) { 0, at->x[1], at->x[2], 0 }, sizeof legs[1]);
    for (int i = 3; i > 0; i--) {
        take_off(at, legs[i], legs[0], -1);
        for (int j = 3; j > i; j--)
            take_off(at, legs[i], legs[j], 1);
        normalise(at, legs[i]);
    }
}

/* Unit vectors l and r of scattering.h for a direction in components along the legs. */
static void bases_of(const double n[3], double l[3], double r[3])
{
    const double level = hypot(n[0], n[1]);
    const double along[3] = { n[2] * n[0] / level, n[2] * n[1] / level, -level },
                 across[3] = { -n[1] / level, n[0] / level, 0 };
    memcpy(l, along, sizeof along);
    memcpy(r, across, sizeof across);
}

static void vector_of(double legs[4][4], const double n[3], double out[4])
{
    for (int i = 0; i < 4; i++)
        out[i] = n[0] * legs[1][i] + n[1] * legs[2][i] + n[2] * legs[3][i];
}

/* Light that arrives in the gas's frame against the direction of sight: adds what is reflected to n, for each energy.
 */
static void reflect(const struct disk *d, const struct ks_carried *at, double legs[4][4], const double n[3], double g,
                    double solid, const double source[3], double light[ENERGIES][3])
{
    const double down[3] = { -source[0], -source[1], -source[2] };
    double l[3], r[3];
    struct ks_screen screen = { .a = d->hole.a };
    bases_of(down, l, r);
    memcpy(screen.x, at->x, sizeof screen.x);
    screen.x[3] = 1e-7;
    vector_of(legs, down, screen.k);
    vector_of(legs, l, screen.right);
    vector_of(legs, r, screen.up); /* right x up is along the light */
    for (int i = 0; i < 4; i++)
        screen.k[i] += legs[0][i];
    struct ks_polarized from = { .there = false };
    for (int order = 0; order < 4; order++) {
        from = ks_polarization(&screen, order, KS_VERTICAL, 0);
        if (!from.there || from.r >= d->isco)
            break;
    }
    if (!from.there || from.r < d->isco || !(from.r < 1e4))
        return;
    const struct kd_scattered own = emitted(from.cosine);
    /* `angle`: from up, that is r, towards the left, that is -l */
    const double fraction = kd_scattered_fraction(&own), all = 2 * 0.5 * (own.across + own.along) * solid,
                 x = -sin(from.angle), y = cos(from.angle), q = fraction * (x * x - y * y), u = fraction * 2 * x * y;
    const double stokes[3] = { all * (1 + q) / 2, all * (1 - q) / 2, all * u }, mu[2] = { n[2], source[2] };
    struct kd_reflected_stokes out;
    kd_scattering_reflect(&reflection[row(mu[0])], mu[0], &reflection[row(mu[1])], mu[1], stokes, &out);
    const double turn = atan2(n[1], n[0]) - atan2(down[1], down[0]),
                 angle[5] = { 1, cos(turn), sin(turn), cos(2 * turn), sin(2 * turn) };
    for (int e = 0; e < ENERGIES; e++)
        for (int k = 0; k < 5; k++) {
            const double part = angle[k] * planck(d, g / from.g * heat(d, from.r), kev[e]);
            light[e][0] += part * (out.l[k] + out.r[k]);
            light[e][1] += part * (out.l[k] - out.r[k]);
            light[e][2] += part * out.u[k];
        }
}

/* One sample, of four numbers between 0 and 1. light: direct and reflected Stokes parameters at each energy. */
static void sample(const struct disk *d, const double at[4], double light[2][ENERGIES][3])
{
    const double most = log(1.25 * OUTER), least = log(0.5), b = exp(least + (most - least) * at[0]),
                 psi = 2 * M_PI * at[1], squash = 0.75, area = (most - least) * 2 * M_PI * b * b * squash;
    const struct ks_screen screen =
        ks_screen_far(d->hole.a, 0, d->theta, b * cos(psi) + d->hole.a * sin(d->theta), squash * b * sin(psi) + 1);
    const struct ks_polarized seen = ks_polarization(&screen, 0, KS_VERTICAL, 0);
    if (!seen.there || !(seen.r > d->isco && seen.r < OUTER))
        return;
    const double g = 1 / seen.g;
    const struct kd_scattered own = emitted(seen.cosine);
    const double all = area * (own.across + own.along), part = all * kd_scattered_fraction(&own);
    for (int e = 0; e < ENERGIES; e++) {
        const double of = planck(d, g * heat(d, seen.r), kev[e]);
        light[0][e][0] += of * all;
        light[0][e][1] += of * part * cos(2 * seen.angle); /* from up, which is north, to the left, which is east */
        light[0][e][2] += of * part * sin(2 * seen.angle);
    }
    struct crossing c = { .met = false };
    double legs[4][4], n[3];
    ks_carry(&screen, 0.8 * seen.r, 1.25 * seen.r, 0.01, told, &c);
    if (!c.met)
        return;
    struct ks_carried place = c.above;
    const double x = c.above.x[3] / (c.above.x[3] - c.below.x[3]);
    mean(c.above.x, c.below.x, x, place.x), mean(c.above.k, c.below.k, x, place.k);
    mean(c.above.right, c.below.right, x, place.right), mean(c.above.up, c.below.up, x, place.up);
    for (int i = 0; i < 4; i++)
        mean(c.above.g[i], c.below.g[i], x, place.g[i]);
    place.r = seen.r;
    frame_of(d, &place, legs);
    const double energy = -ks_carried_product(&place, place.k, legs[0]);
    for (int i = 0; i < 3; i++)
        n[i] = ks_carried_product(&place, place.k, legs[i + 1]) / energy;
    /* Directions are densest about the direction to the hole, rho = 0. */
    const double spread = 1 + log(seen.r), rho = M_PI * sinh(spread * at[2]) / sinh(spread), s = sin(rho),
                 chi = M_PI * at[3], source[3] = { -cos(rho), s * cos(chi), s * sin(chi) },
                 solid = s * M_PI * spread * cosh(spread * at[2]) / sinh(spread) * M_PI;
    double mirrored[ENERGIES][3] = { { 0 } };
    reflect(d, &place, legs, n, g, solid, source, mirrored);
    /* The picture's vectors, without their parts along the light, and l and r of the light that leaves. */
    double l[3], r[3], along[4], across[4];
    bases_of(n, l, r);
    vector_of(legs, l, along);
    vector_of(legs, r, across);
    const double north_l = ks_carried_product(&place, along, place.up),
                 east_l = -ks_carried_product(&place, along, place.right),
                 north_r = ks_carried_product(&place, across, place.up),
                 east_r = -ks_carried_product(&place, across, place.right);
    for (int e = 0; e < ENERGIES; e++) {
        const double q = mirrored[e][1], u = mirrored[e][2];
        light[1][e][0] += area * mirrored[e][0];
        light[1][e][1] += area * 0.5 *
                          (q * (north_l * north_l - east_l * east_l - north_r * north_r + east_r * east_r) +
                           2 * u * (north_l * north_r - east_l * east_r));
        light[1][e][2] +=
            area * (q * (north_l * east_l - north_r * east_r) + u * (north_l * east_r + east_l * north_r));
    }
}

/* Degree in per cent and angle of the light of both kinds, or of the direct light alone. */
struct shown { double i, q, u; };
static struct shown shown_of(double light[2][ENERGIES][3], int e, bool both)
{
    const double i = light[0][e][0] + both * light[1][e][0];
    return (struct shown) { i, 100 * (light[0][e][1] + both * light[1][e][1]) / i,
                            100 * (light[0][e][2] + both * light[1][e][2]) / i };
}

static double sigma(const double x[BATCHES], double *average)
{
    double sum = 0, squares = 0;
    for (int b = 0; b < BATCHES; b++)
        sum += x[b] / BATCHES;
    for (int b = 0; b < BATCHES; b++)
        squares += (x[b] - sum) * (x[b] - sum);
    *average = sum;
    return sqrt(squares / (BATCHES * (BATCHES - 1)));
}

static void judge(double a, double inclination, long count)
{
    struct disk d = { .hole = kd_hole_of(a), .theta = inclination * RADIAN };
    struct kd_disk_image *image = malloc(sizeof *image);
    struct kd_disk_stokes *stokes = malloc(sizeof *stokes);
    struct kd_error error;
    static const double steps[4] = { 0.8566748838545029, 0.7338918566271260, 0.6287067210378087, 0.5385972572236101 };
    d.isco = kd_kerr_isco(&d.hole);
    d.largest = kd_disk_flux_page_thorne(&d.hole, kd_disk_peak_page_thorne(&d.hole));
    const struct kd_disk_spectrum_params p = { d.isco, OUTER, 10, 1e4, 0.1, 1.8, KD_LIMB_SCATTERING, NULL };
    assert_true(image && stokes && kd_disk_image_init(image, &d.hole, d.theta));
    assert_int_equal(kd_disk_stokes_init(stokes, image, &p, true, &error), KD_OK);
    d.hottest_k = stokes->hottest_k;
    struct shown of[2][ENERGIES][BATCHES];
    for (int batch = 0; batch < BATCHES; batch++) {
        double light[2][ENERGIES][3] = { { { 0 } } };
        for (long i = 0; i < count / BATCHES; i++) {
            double at[4];
            for (int k = 0; k < 4; k++)
                at[k] = fmod((double)(i + 1) * steps[k] + (batch + 0.5) * (0.125 + 0.0377 * k), 1);
            sample(&d, at, light);
        }
        for (int both = 0; both < 2; both++)
            for (int e = 0; e < ENERGIES; e++)
                of[both][e][batch] = shown_of(light, e, both);
    }
    for (int both = 0; both < 2; both++)
        for (int e = 0; e < ENERGIES; e++) {
            const double hz = kev[e] * 1e3 * 1.602176634e-19 / KD_H_J_S;
            const struct kd_disk_iqu one = kd_disk_stokes_at(stokes, stokes->direct, hz),
                                     two = kd_disk_stokes_at(stokes, stokes->scattered, hz);
            const double i = one.i + both * two.i, q = 100 * (one.q + both * two.q) / i,
                         u = 100 * (one.u + both * two.u) / i;
            double mq[BATCHES], mu[BATCHES], q_mean, u_mean;
            for (int b = 0; b < BATCHES; b++)
                mq[b] = of[both][e][b].q, mu[b] = of[both][e][b].u;
            const double sq = sigma(mq, &q_mean), su = sigma(mu, &u_mean), degree = hypot(q, u),
                         found = hypot(q_mean, u_mean), error_ = fmax(sq, su);
            double turned = fabs(atan2(u, q) - atan2(u_mean, q_mean)) / 2 / RADIAN;
            turned = fmin(turned, 180 - turned);
            printf("    a %g, i %g, %s, %g keV: degree %.3f %%, by samples %.3f +- %.3f; angle %.1f, %.1f\n", a,
                   inclination, both ? "with returning light" : "direct", kev[e], degree, found, error_,
                   atan2(u, q) / 2 / RADIAN, atan2(u_mean, q_mean) / 2 / RADIAN);
            fflush(stdout);
            if (!(fabs(degree - found) <= 3 * error_ + 0.1))
                fail_msg("a %g, i %g, %g keV: degree %g, by samples %g +- %g", a, inclination, kev[e], degree, found,
                         error_);
            if (degree > 1 && error_ < 0.1 && !(turned <= 2 + 3 * error_ / degree / 2 / RADIAN))
                fail_msg("a %g, i %g, %g keV: the angle is off by %g", a, inclination, kev[e], turned);
        }
    free(image);
    free(stokes);
}

static void polarisation_is_that_of_samples(void **state)
{
    static const double spins[] = { 0, 0.9, 0.99 }, inclinations[] = { 45, 60, 75 };
    (void)state;
    for (int a = 0; a < 3; a++)
        for (int i = 0; i < 3; i++)
            if (samples || (a == 1 && i == 2))
                judge(spins[a], inclinations[i], samples ? samples : 320);
}

/* Summed over directions and energies, scattered over direct light is first.returns / first.escapes of the kernel of
 * returning light, less the share that falls on the disk or into the hole again. */
static void scattered_light_is_what_returned(void **state)
{
    (void)state;
    static const double cosines[] = { 0.1127016653792583, 0.5, 0.8872983346207417 },
                        weights[] = { 5. / 18, 8. / 18, 5. / 18 };
    const struct kd_hole hole = kd_hole_of(0.9);
    struct kd_disk_image *image = malloc(sizeof *image);
    struct kd_disk_stokes *stokes = malloc(sizeof *stokes);
    struct kd_returning *table = malloc(sizeof *table);
    struct kd_error error;
    double direct = 0, scattered = 0;
    assert_true(image && stokes && table);
    kd_returning_init(table, &hole, KD_LIMB_SCATTERING);
    for (int i = 0; i < 3; i++) {
        const struct kd_disk_spectrum_params p = { kd_kerr_isco(&hole), 3000, 10, 1e4, 0.1, 1.8,
                                                   KD_LIMB_SCATTERING,  NULL };
        assert_true(kd_disk_image_init(image, &hole, acos(cosines[i])));
        assert_int_equal(kd_disk_stokes_init(stokes, image, &p, true, &error), KD_OK);
        for (int k = 0; k < KD_STOKES_NODES; k++) {
            const double fourth = exp(0.08 * k); /* of the temperature of the node */
            direct += weights[i] * fourth * stokes->direct[k].i;
            scattered += weights[i] * fourth * stokes->scattered[k].i;
        }
    }
    const double most = table->first.returns / table->first.escapes;
    printf("    scattered over direct light %.4f, at most %.4f\n", scattered / direct, most);
    assert_true(scattered / direct < 1.02 * most && scattered / direct > 0.9 * most);
    free(image);
    free(stokes);
    free(table);
}

int main(int argc, char **argv)
{
    make_atmosphere();
    samples = argc > 1 ? strtol(argv[1], NULL, 10) : 0;
    const struct CMUnitTest tests[] = { cmocka_unit_test(polarisation_is_that_of_samples),
                                        cmocka_unit_test(scattered_light_is_what_returned) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
