/* Tests of polarised spectra of a disk whose atmosphere scatters the light that returns. The same light is summed by
 * the Monte Carlo method. Each sample is a place of the image and one direction from which light arrives at the disk
 * there. All rays are followed in Cartesian Kerr-Schild coordinates, with vectors of their polarisation; the gas's
 * frame is found by contraction with the metric. Unlike the code under test, it has no bins of temperature,
 * interpolates no ring and uses no constant of motion. The rays are compared with kerr_schild_transport.h, which takes
 * derivatives as differences. The law of reflection is tested by itself (physics_scattering.c).
 *
 *     unit_physics_stokes [SAMPLES [CASE]]     samples of each case; runs all nine cases, or CASE, from 0 to 8 */
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
#define NEAR 1e-4 /* largest difference of rays of both integrators */
#define RADIAN (M_PI / 180)
static const double kev[ENERGIES] = { 2, 3, 5, 8 };
static long samples, chosen = -1;

struct disk {
    struct kd_hole hole;
    double theta, isco, largest, hottest_k;
};

/* Planck's law without 2 h nu^3/c^2. The temperature is `ratio` times the disk's highest temperature. */
static double planck(const struct disk *d, double ratio, double energy)
{
    return 1 / expm1(energy * 1e3 * 1.602176634e-19 / (KD_K_J_K * d->hottest_k * ratio));
}

static double heat(const struct disk *d, double r)
{
    return pow(kd_disk_flux_page_thorne(&d->hole, r) / d->largest, 0.25);
}

/* A table of the atmosphere's light at many cosines. The nearest cosine is taken. */
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

/* Light that is followed back in time, in Cartesian ingoing Kerr-Schild coordinates with g = eta + f l l. x: its place;
 * v: its wave vector and two vectors that are transported with it. */
enum { VECTORS = 3 };
struct light { double x[4], v[VECTORS][4]; };

/* f and l, and their derivatives by x, y and z. */
struct field { double r, f, l[4], df[4], dl[4][4]; };

static struct field field_at(double a, const double *x)
{
    const double rho2 = x[1] * x[1] + x[2] * x[2] + x[3] * x[3] - a * a,
                 r = sqrt(0.5 * (rho2 + hypot(rho2, 2 * a * x[3]))), r2 = r * r, q = r2 + a * a,
                 w = r2 * r2 + a * a * x[3] * x[3],
                 dr[4] = { 0, r2 * r * x[1] / w, r2 * r * x[2] / w, r * q * x[3] / w };
    struct field o = { .r = r, .f = 2 * r2 * r / w };
    memcpy(o.l, (const double[4]) { 1, (r * x[1] + a * x[2]) / q, (r * x[2] - a * x[1]) / q, x[3] / r }, sizeof o.l);
    for (int i = 1; i < 4; i++) {
        const double dw = 4 * r2 * r * dr[i] + (i == 3 ? 2 * a * a * x[3] : 0), dq = 2 * r * dr[i];
        o.df[i] = o.f * (3 * dr[i] / r - dw / w);
        o.dl[i][1] = (dr[i] * x[1] + (i == 1) * r + (i == 2) * a - o.l[1] * dq) / q;
        o.dl[i][2] = (dr[i] * x[2] + (i == 2) * r - (i == 1) * a - o.l[2] * dq) / q;
        o.dl[i][3] = ((i == 3) - o.l[3] * dr[i]) / r;
    }
    return o;
}

static double dot(const double *p, const double *q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3]; }

static double product(const struct field *o, const double *p, const double *q)
{
    return dot(p, q) - 2 * p[0] * q[0] + o->f * dot(o->l, p) * dot(o->l, q);
}

/* dx = -k and dv^m = Gamma^m_ab k^a v^b */
static void derivative(double a, const struct light *s, struct light *d)
{
    const struct field o = field_at(a, s->x);
    const double *k = s->v[0], lk = dot(o.l, k), dfk = dot(o.df, k);
    double by_k[4], of_k[4]; /* derivatives of l along k, and of l.k by each coordinate */
    for (int m = 0; m < 4; m++) {
        by_k[m] = k[1] * o.dl[1][m] + k[2] * o.dl[2][m] + k[3] * o.dl[3][m];
        of_k[m] = dot(o.dl[m], k);
        d->x[m] = -k[m];
    }
    for (int n = 0; n < VECTORS; n++) {
        const double *v = s->v[n], lv = dot(o.l, v), dfv = dot(o.df, v);
        double by_v[4], low[4];
        for (int m = 0; m < 4; m++)
            by_v[m] = v[1] * o.dl[1][m] + v[2] * o.dl[2][m] + v[3] * o.dl[3][m];
        const double along = dfk * lv + dfv * lk + o.f * (dot(by_k, v) + dot(by_v, k));
        for (int m = 0; m < 4; m++)
            low[m] = 0.5 * (along * o.l[m] + o.f * (by_k[m] * lv + by_v[m] * lk) - o.df[m] * lk * lv -
                            o.f * (of_k[m] * lv + dot(o.dl[m], v) * lk));
        const double up = o.f * (dot(o.l, low) - 2 * low[0]); /* g^-1 = eta - f l l, with l^t = -1 */
        d->v[n][0] = -low[0] + up;
        for (int m = 1; m < 4; m++)
            d->v[n][m] = low[m] - up * o.l[m];
    }
}

static void add(struct light *s, const struct light *d, double h)
{
    for (int i = 0; i < 4; i++) {
        s->x[i] += h * d->x[i];
        for (int n = 0; n < VECTORS; n++)
            s->v[n][i] += h * d->v[n][i];
    }
}

static void step(double a, struct light *s, double h)
{
    struct light d[4], at;
    derivative(a, s, &d[0]);
    for (int i = 1; i < 4; i++) {
        at = *s;
        add(&at, &d[i - 1], i == 3 ? h : 0.5 * h);
        derivative(a, &at, &d[i]);
    }
    for (int i = 0; i < 4; i++)
        add(s, &d[i], h * (i == 0 || i == 3 ? 1. / 6 : 1. / 3));
}

/* Follows light to the next place where it meets the plane. Returns false if it comes from the hole or from beyond
 * `outer`. Light from within the innermost photon orbit (J. M. Bardeen, W. H. Press & S. A. Teukolsky 1972, ApJ 178,
 * 347, eq. 2.18) comes from the hole. */
static bool to_plane(double a, struct light *s, double outer)
{
    const double horizon = 1 + sqrt(1 - a * a), innermost = 2 * (1 + cos(2. / 3 * acos(-a)));
    for (int n = 0; n < 20000; n++) {
        const double r = field_at(a, s->x).r, speed = sqrt(dot(s->v[0], s->v[0]) - s->v[0][0] * s->v[0][0]);
        if (r < innermost || r > outer)
            return false;
        const struct light last = *s;
        step(a, s, (r > 1e3 ? 0.2 : r > 100 ? 0.1 : 0.05) * fmin(r, 8 * (r - horizon)) / speed);
        if (n == 0 || (last.x[3] > 0) == (s->x[3] > 0))
            continue;
        *s = last;
        for (int i = 0; i < 20 && fabs(s->x[3]) > 1e-12; i++)
            step(a, s, s->x[3] / s->v[0][3]);
        return true;
    }
    return false;
}

/* Unit vectors of the gas on a circular orbit at a place on the plane: its velocity, outwards, forwards, normal. */
static void frame_of(const struct disk *d, const double *x, double legs[4][4])
{
    const struct field o = field_at(d->hole.a, x);
    const double omega = 1 / (pow(o.r, 1.5) + d->hole.a);
    const double raw[4][4] = {
        { 1, -omega * x[2], omega * x[1], 0 }, { 0, x[1], x[2], 0 }, { 0, -x[2], x[1], 0 }, { 0, 0, 0, 1 }
    };
    static const int order[4] = { 0, 3, 2, 1 };
    memcpy(legs, raw, sizeof raw);
    /* The outward leg is orthogonal to the velocity and to the projected azimuthal Killing vector. */
    for (int n = 0; n < 4; n++) {
        double *v = legs[order[n]];
        for (int k = 0; k < n; k++) {
            const double *w = legs[order[k]], part = product(&o, v, w) * (order[k] ? 1 : -1);
            for (int i = 0; i < 4; i++)
                v[i] -= part * w[i];
        }
        const double size = sqrt(fabs(product(&o, v, v)));
        for (int i = 0; i < 4; i++)
            v[i] /= size;
    }
}

/* Light that meets the plane at the radius r. energy, n: its energy and direction in the gas's frame. l, r_: components
 * of the two transported vectors along l and r of scattering.h. */
struct met { double r, energy, n[3], l[2], r_[2]; };

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

static struct met met_by(const struct disk *d, const struct light *s, double legs[4][4])
{
    const struct field o = field_at(d->hole.a, s->x);
    struct met m = { .r = o.r };
    double l[3], r[3], along[4], across[4];
    frame_of(d, s->x, legs);
    m.energy = -product(&o, s->v[0], legs[0]);
    for (int i = 0; i < 3; i++)
        m.n[i] = product(&o, s->v[0], legs[i + 1]) / m.energy;
    bases_of(m.n, l, r);
    vector_of(legs, l, along);
    vector_of(legs, r, across);
    for (int i = 0; i < 2; i++)
        m.l[i] = product(&o, s->v[i + 1], along), m.r_[i] = product(&o, s->v[i + 1], across);
    return m;
}

/* Adds the light that arrives in the gas's frame from the direction `source` and is reflected to n. */
static void reflect(const struct disk *d, const double *x, double legs[4][4], const double n[3], double g, double solid,
                    const double source[3], double light[ENERGIES][3])
{
    const double down[3] = { -source[0], -source[1], -source[2] };
    double l[3], r[3], there[4][4];
    struct light s;
    struct met from;
    bases_of(down, l, r);
    memcpy(s.x, x, sizeof s.x);
    s.x[3] = 1e-9;
    vector_of(legs, down, s.v[0]);
    vector_of(legs, l, s.v[1]);
    vector_of(legs, r, s.v[2]);
    for (int i = 0; i < 4; i++)
        s.v[0][i] += legs[0][i];
    for (int order = 0;; order++) {
        if (order == 6 || !to_plane(d->hole.a, &s, 500))
            return;
        from = met_by(d, &s, there);
        if (from.r >= d->isco)
            break;
    }
    const struct kd_scattered own = emitted(fabs(from.n[2]));
    /* The source's light is polarised along r. */
    const double fraction = kd_scattered_fraction(&own), all = (own.across + own.along) * solid,
                 part = fraction / (from.r_[0] * from.r_[0] + from.r_[1] * from.r_[1]),
                 q = part * (from.r_[0] * from.r_[0] - from.r_[1] * from.r_[1]), u = part * 2 * from.r_[0] * from.r_[1];
    const double stokes[3] = { all * (1 + q) / 2, all * (1 - q) / 2, all * u }, mu[2] = { n[2], source[2] };
    struct kd_reflected_stokes out;
    kd_scattering_reflect(&reflection[row(mu[0])], mu[0], &reflection[row(mu[1])], mu[1], stokes, &out);
    const double turn = atan2(n[1], n[0]) - atan2(down[1], down[0]),
                 angle[5] = { 1, cos(turn), sin(turn), cos(2 * turn), sin(2 * turn) };
    const double warmth = g / from.energy * heat(d, from.r);
    for (int e = 0; e < ENERGIES; e++)
        for (int k = 0; k < 5; k++) {
            const double some = angle[k] * planck(d, warmth, kev[e]);
            light[e][0] += some * (out.l[k] + out.r[k]);
            light[e][1] += some * (out.l[k] - out.r[k]);
            light[e][2] += some * out.u[k];
        }
}

/* Light of the ray (alpha, beta) of an observer at infinity, placed at r = 1e6. Its two vectors point up and to the
 * left. */
static struct light seen_at(const struct disk *d, double alpha, double beta)
{
    const double far = 1e6, s = sin(d->theta), c = cos(d->theta);
    struct light o = { .x = { 0, far * s - beta * c, alpha, far * c + beta * s },
                       .v = { { 0, s, 0, c }, { 0, -c, 0, s }, { 0, 0, -1, 0 } } };
    const struct field f = field_at(d->hole.a, o.x);
    const double along = f.l[1] * s + f.l[3] * c; /* solves g kk = 0 for k = (t, s, 0, c) */
    o.v[0][0] = (f.f * along + sqrt(1 - f.f + f.f * along * along)) / (1 - f.f);
    return o;
}

/* One sample, chosen by four numbers between 0 and 1. light: direct and reflected Stokes parameters at each energy. */
static void sample(const struct disk *d, const double at[4], double light[2][ENERGIES][3])
{
    const double most = log(1.25 * OUTER), least = log(0.5), b = exp(least + (most - least) * at[0]),
                 psi = 2 * M_PI * at[1], squash = 0.75, area = (most - least) * 2 * M_PI * b * b * squash;
    struct light s = seen_at(d, b * cos(psi) + d->hole.a * sin(d->theta), squash * b * sin(psi) + 1);
    double legs[4][4];
    if (!to_plane(d->hole.a, &s, 2e6))
        return;
    const struct met seen = met_by(d, &s, legs);
    if (!(seen.r > d->isco && seen.r < OUTER))
        return;
    const double g = 1 / seen.energy, *const l = seen.l, *const r = seen.r_;
    const struct kd_scattered own = emitted(seen.n[2]);
    const double all = area * (own.across + own.along),
                 part = area * (own.across - own.along) / (r[0] * r[0] + r[1] * r[1]);
    for (int e = 0; e < ENERGIES; e++) {
        const double of = planck(d, g * heat(d, seen.r), kev[e]);
        light[0][e][0] += of * all;
        light[0][e][1] += of * part * (r[0] * r[0] - r[1] * r[1]);
        light[0][e][2] += of * part * 2 * r[0] * r[1];
    }
    /* Directions are densest near the direction to the hole, rho = 0. */
    const double spread = 1 + log(seen.r), rho = M_PI * sinh(spread * at[2]) / sinh(spread), sine = sin(rho),
                 chi = M_PI * at[3], source[3] = { -cos(rho), sine * cos(chi), sine * sin(chi) },
                 solid = sine * M_PI * spread * cosh(spread * at[2]) / sinh(spread) * M_PI;
    double mirrored[ENERGIES][3] = { { 0 } };
    reflect(d, s.x, legs, seen.n, g, solid, source, mirrored);
    for (int e = 0; e < ENERGIES; e++) {
        const double q = mirrored[e][1], u = mirrored[e][2];
        light[1][e][0] += area * mirrored[e][0];
        light[1][e][1] += area * (0.5 * q * (l[0] * l[0] - l[1] * l[1] - r[0] * r[0] + r[1] * r[1]) +
                                  u * (l[0] * r[0] - l[1] * r[1]));
        light[1][e][2] += area * (q * (l[0] * l[1] - r[0] * r[1]) + u * (l[0] * r[1] + l[1] * r[0]));
    }
}

/* Rays of both integrators meet the disk at the same place, with the same energy, direction and polarisation. */
static void rays_are_those_of_differences(void **state)
{
    (void)state;
    static const struct {
        double a, inclination, alpha, beta;
    } rays[] = {
        { 0, 60, -7, 3 }, { 0.9, 75, -5, 2 }, { 0.9, 75, 4, 6 }, { 0.99, 45, -3, -4 }, { 0.99, 75, 20, 5 },
    };
    for (size_t i = 0; i < sizeof rays / sizeof *rays; i++) {
        const struct disk d = { .hole = kd_hole_of(rays[i].a), .theta = rays[i].inclination * RADIAN };
        const struct ks_screen screen = ks_screen_far(rays[i].a, 0, d.theta, rays[i].alpha, rays[i].beta);
        const struct ks_polarized want = ks_polarization(&screen, 0, KS_VERTICAL, 0);
        struct light s = seen_at(&d, rays[i].alpha, rays[i].beta);
        double legs[4][4];
        assert_true(want.there && to_plane(rays[i].a, &s, 2e6));
        const struct met m = met_by(&d, &s, legs);
        double turned = atan2(m.r_[1], m.r_[0]) - want.angle;
        turned -= M_PI * round(turned / M_PI);
        if (!(fabs(m.r / want.r - 1) < NEAR && fabs(m.energy / want.g - 1) < NEAR &&
              fabs(fabs(m.n[2]) - want.cosine) < NEAR && fabs(turned) < NEAR))
            fail_msg("ray %zu: r %.6f, %.6f; energy %.6f, %.6f; cosine %.6f, %.6f; turned by %.2g", i, m.r, want.r,
                     m.energy, want.g, fabs(m.n[2]), want.cosine, turned);
    }
}

/* The degree, in per cent, and the angle of polarisation of direct and scattered light, or of direct light alone. */
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
            if (both) {
                double shares[BATCHES], share;
                for (int b = 0; b < BATCHES; b++)
                    shares[b] = of[1][e][b].i / of[0][e][b].i - 1;
                const double of_share = sigma(shares, &share), wanted = two.i / one.i;
                printf("    a %g, i %g, %g keV: share of scattered light %.5f, by samples %.5f +- %.5f\n", a,
                       inclination, kev[e], wanted, share, of_share);
                /* Above 3 keV this light comes from a few samples, so that their standard deviation is underestimated.
                 */
                if (!(e || fabs(wanted - share) <= 3 * of_share + 0.02 * wanted))
                    fail_msg("a %g, i %g, %g keV: share %g, by samples %g +- %g", a, inclination, kev[e], wanted, share,
                             of_share);
            }
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
    static const long suite[3][3] = { { 0, 20000, 0 }, { 0, 0, 16000 } };
    (void)state;
    for (int a = 0; a < 3; a++)
        for (int i = 0; i < 3; i++)
            if (chosen < 0 ? samples || suite[a][i] : chosen == 3 * a + i)
                judge(spins[a], inclinations[i], samples ? samples : suite[a][i]);
}

/* The ratio of scattered to direct light, summed over directions and energies, follows from the kernel of returning
 * light. It is first.returns / first.escapes, less the share of scattered light that meets the disk or the hole
 * again. */
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
            const double fourth = exp(0.08 * k); /* fourth power of the node's temperature */
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
    chosen = argc > 2 ? strtol(argv[2], NULL, 10) : -1;
    const struct CMUnitTest alone[] = { cmocka_unit_test(polarisation_is_that_of_samples) };
    const struct CMUnitTest tests[] = { cmocka_unit_test(rays_are_those_of_differences),
                                        cmocka_unit_test(polarisation_is_that_of_samples),
                                        cmocka_unit_test(scattered_light_is_what_returned) };
    return chosen < 0 ? cmocka_run_group_tests(tests, NULL, NULL) : cmocka_run_group_tests(alone, NULL, NULL);
}
