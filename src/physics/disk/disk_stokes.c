#include "physics/disk/disk_stokes.h"

#include "base/pause.h"
#include "physics/disk/limb.h"
#include "physics/disk/scattering.h"
#include "physics/disk/thin_disk.h"
#include "physics/math/constants.h"
#include "physics/null/null_geodesic.h"
#include "physics/spacetime/kerr.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define STEP 0.02   /* step of ln T between nodes */
#define COLDEST -10 /* ln T of node 0, where T is relative to the disk's largest temperature */
enum {
    RINGS = 24,   /* number of nodes in s = sqrt(r_isco/r) at which reflected light is computed */
    COSINES = 12, /* number of nodes in the cosine of the angle at which reflected light leaves */
    PARTS = 15,   /* number of members l, r, u of struct kd_reflected_stokes */
};

static double place_of(double log_t) { return (log_t - COLDEST) / STEP; }

/* Weights of the cubic through four nodes for a place. The place lies between the second and the third of these nodes,
 * except at the ends of the range. Returns the first node. */
static int weigh(double place, double weight[4])
{
    const int i = (int)fmin(fmax(floor(place), 1), KD_STOKES_NODES - 3);
    const double x = fmin(fmax(place - i, -1), 2);
    weight[0] = -x * (x - 1) * (x - 2) / 6;
    weight[1] = (x + 1) * (x - 1) * (x - 2) / 2;
    weight[2] = -(x + 1) * x * (x - 2) / 2;
    weight[3] = (x + 1) * x * (x - 1) / 6;
    return i - 1;
}

/* A ray of light at a ring, in the frame of the gas. energy: energy of the photon. n: direction, with components along
 * r, phi and the normal. azimuth: azimuth of n about the normal. l, r: constants of Walker & Penrose for light that is
 * polarised along the directions l and r of scattering.h. */
struct meeting {
    double energy, n[3], azimuth;
    double complex l, r;
};

/* The ray with energy e and angular momentum lambda at infinity. If p_theta < 0, the light goes up. sense: sign of p^r.
 */
static struct meeting meeting_of(const struct kd_hole *hole, double r, double e, double lambda, double p_theta,
                                 int sense)
{
    const double a = hole->a, delta = kd_hole_delta(hole, r), root = r * sqrt(delta),
                 p = (r * r + a * a) * e - a * lambda, k = p_theta * p_theta + (lambda - a * e) * (lambda - a * e),
                 v = (kd_kerr_ring_at(hole, r - 1).s - a) / sqrt(delta), gamma = 1 / sqrt((1 - v) * (1 + v));
    const double kt = p / root, kr = sense * sqrt(fmax(0, p * p - delta * k)) / root, ks = p_theta / r,
                 kp = (lambda - a * e) / r, energy = gamma * (kt - v * kp);
    struct meeting m = { .energy = energy, .n = { kr / energy, gamma * (kp - v * kt) / energy, -ks / energy } };
    const double level = sqrt(m.n[0] * m.n[0] + m.n[1] * m.n[1]);
    const double f[2][3] = { { m.n[2] * m.n[0] / level, m.n[2] * m.n[1] / level, -level },
                             { -m.n[1] / level, m.n[0] / level, 0 } };
    double complex of[2];
    m.azimuth = atan2(m.n[1], m.n[0]);
    for (int i = 0; i < 2; i++) {
        const double ft = gamma * v * f[i][1], fp = gamma * f[i][1];
        of[i] = (kt * f[i][0] - kr * ft) - I * (-kp * f[i][2] - ks * fp);
        of[i] *= r; /* the factor is r - i a cos(theta), which is r in the plane */
    }
    m.l = of[0], m.r = of[1];
    return m;
}

/* Light that a ring reflects, as a Fourier series in the azimuth for each node of the cosine and of ln T. */
struct mirror {
    const struct kd_hole *hole;
    const struct kd_disk_spectrum_params *p;
    double largest; /* largest flux from the disk */
    double mu[COSINES];
    struct kd_scattering_functions at[COSINES];
    double (*parts)[PARTS][KD_STOKES_NODES]; /* array of one ring that is being filled */
    double r;
};

/* Tables of the atmosphere's functions, at nodes in the fourth root of the cosine. */
enum { FINE = 200 };
struct atmosphere {
    double fraction[FINE + 1];
    struct kd_scattering_functions at[FINE + 1];
};

static void atmosphere_init(struct atmosphere *a)
{
    double mu[FINE + 1];
    struct kd_scattered light[FINE + 1];
    for (int i = 0; i <= FINE; i++)
        mu[i] = pow((double)i / FINE, 4);
    kd_scattered_light(mu, FINE + 1, light);
    kd_scattering_functions(mu, FINE + 1, a->at);
    for (int i = 0; i <= FINE; i++)
        a->fraction[i] = kd_scattered_fraction(&light[i]);
}

static double between(double a, double b, double x) { return a + x * (b - a); }

static double fraction_at(const struct atmosphere *a, double mu)
{
    const double at = FINE * sqrt(sqrt(fmin(mu, 1)));
    const int i = (int)fmin(at, FINE - 1);
    return between(a->fraction[i], a->fraction[i + 1], at - i);
}

static struct kd_scattering_functions functions_at(const struct atmosphere *a, double mu)
{
    const double at = FINE * sqrt(sqrt(fmin(mu, 1)));
    const int i = (int)fmin(at, FINE - 1);
    const double x = at - i;
    const struct kd_scattering_functions *f = a->at + i, *g = f + 1;
    return (struct kd_scattering_functions) { between(f->psi, g->psi, x),     between(f->phi, g->phi, x),
                                              between(f->chi, g->chi, x),     between(f->zeta, g->zeta, x),
                                              between(f->first, g->first, x), between(f->second, g->second, x) };
}

struct filling {
    struct mirror *mirror;
    const struct atmosphere *atmosphere;
};

static void reflect(void *user, const struct kd_returning_ray *ray)
{
    const struct filling *filling = user;
    struct mirror *m = filling->mirror;
    const struct atmosphere *a = filling->atmosphere;
    const double e = ray->energy, lambda = ray->momentum;
    const struct meeting from = meeting_of(m->hole, ray->from, e, lambda, ray->order % 2 ? ray->polar : -ray->polar,
                                           ray->leaves),
                         at = meeting_of(m->hole, m->r, e, lambda, ray->polar, ray->arrives);
    const double mu_e = fabs(from.n[2]), mu0 = fabs(at.n[2]), g = at.energy / from.energy,
                 flux = kd_disk_flux_page_thorne(m->hole, ray->from);
    if (!(flux > 0) || !(mu0 > 0))
        return;
    /* mu dOmega in the frame of zero angular momentum, where the light has the energy 1 */
    const double solid = ray->solid / pow(at.energy, 3) / mu0,
                 light = kd_limb_at(m->p->limb, mu_e) * kd_limb_scale(m->p->limb) * solid,
                 fraction = fraction_at(a, mu_e);
    /* At its source the light is polarised along r. At this ring the direction of polarisation is x l + y r. */
    const double complex turn = from.r / at.l, other = at.r / at.l;
    const double y = cimag(turn) / cimag(other), x = creal(turn) - y * creal(other), size = x * x + y * y,
                 q = fraction * (x * x - y * y) / size, u = fraction * 2 * x * y / size;
    const double stokes[3] = { light * (1 + q) / 2, light * (1 - q) / 2, light * u };
    const struct kd_scattering_functions in = functions_at(a, mu0);
    double weight[4];
    const int first = weigh(place_of(0.25 * log(flux / m->largest) + log(g)), weight);
    const double c = cos(at.azimuth), s = sin(at.azimuth), c2 = c * c - s * s, s2 = 2 * s * c;
    for (int j = 0; j < COSINES; j++) {
        struct kd_reflected_stokes out;
        kd_scattering_reflect(&m->at[j], m->mu[j], &in, mu0, stokes, &out);
        const double *const all[3] = { out.l, out.r, out.u };
        /* Converts the series in the difference of azimuths to a series in the azimuth of the outgoing light. Terms in
         * the first multiple of the azimuth are proportional to the sine of the angle from the normal. Here they are
         * divided by this sine, so that they are smooth functions of the cosine; add_place multiplies them by the sine.
         * */
        const double level = sqrt((1 - m->mu[j]) * (1 + m->mu[j]));
        for (int k = 0; k < 3; k++) {
            const double *f = all[k], turned[5] = { f[0], (f[1] * c - f[2] * s) / level, (f[1] * s + f[2] * c) / level,
                                                    f[3] * c2 - f[4] * s2, f[3] * s2 + f[4] * c2 };
            for (int w = 0; w < 4; w++)
                for (int n = 0; n < 5; n++)
                    m->parts[j][5 * k + n][first + w] += weight[w] * turned[n];
        }
    }
}

/* Weights of Chebyshev's nodes for interpolation at x (returning.c). */
static void cheb_weights(const double *nodes, int n, double x, double *weights)
{
    double sum = 0;
    for (int j = 0; j < n; j++) {
        const double gap = x - nodes[j];
        weights[j] = (j % 2 ? -1 : 1) * sin(M_PI * (j + 0.5) / n) / (gap == 0 ? 1e-300 : gap);
        sum += weights[j];
    }
    for (int j = 0; j < n; j++)
        weights[j] /= sum;
}

/* State during the computation of a spectrum. */
struct work {
    struct kd_disk_stokes *out;
    const struct kd_disk_image *image;
    const struct kd_disk_spectrum_params *p;
    struct atmosphere atmosphere;
    struct mirror mirror;
    bool scattered;
    double nodes[RINGS];
    double (*rings)[COSINES][PARTS][KD_STOKES_NODES]; /* reflected light at the nodes in s: r^3 times the parts */
    double (*ring)[PARTS][KD_STOKES_NODES];           /* reflected light at the radius `ring_at`: the parts */
    double ring_at;
    int first, last; /* first and last node of ln T with light */
};

static double flux_of(const struct work *w, double r)
{
    return w->p->returning ? kd_returning_flux(w->p->returning, r) : kd_disk_flux_page_thorne(&w->image->hole, r);
}

static void make_mirror(struct work *w)
{
    const double isco = w->image->isco;
    for (int i = 0; i < RINGS; i++) {
        w->nodes[i] = 0.5 * (1 + cos(M_PI * (i + 0.5) / RINGS));
        w->mirror.parts = w->rings[i];
        w->mirror.r = isco / (w->nodes[i] * w->nodes[i]);
        kd_returning_rays(&w->image->hole, w->mirror.r, reflect, &(struct filling) { &w->mirror, &w->atmosphere });
        if (kd_pause())
            return;
        for (int j = 0; j < COSINES; j++)
            for (int n = 0; n < PARTS; n++)
                for (int k = 0; k < KD_STOKES_NODES; k++) {
                    double *value = &w->rings[i][j][n][k];
                    if (*value != 0)
                        w->first = k < w->first ? k : w->first, w->last = k > w->last ? k : w->last;
                    *value *= pow(w->mirror.r, 3);
                }
    }
}

static void go_to_ring(struct work *w, double r)
{
    double weights[RINGS];
    if (w->ring_at == r)
        return;
    w->ring_at = r;
    cheb_weights(w->nodes, RINGS, sqrt(w->image->isco / r), weights);
    for (int j = 0; j < COSINES; j++)
        for (int n = 0; n < PARTS; n++) {
            double *sum = w->ring[j][n];
            memset(sum, 0, sizeof w->ring[j][n]);
            for (int i = 0; i < RINGS; i++)
                for (int k = w->first; k <= w->last; k++)
                    sum[k] += weights[i] / (r * r * r) * w->rings[i][j][n][k];
        }
    kd_pause();
}

static void add(struct kd_disk_iqu *nodes, double place, struct kd_disk_iqu light)
{
    double weight[4];
    const int first = weigh(place, weight);
    for (int i = 0; i < 4; i++) {
        nodes[first + i].i += weight[i] * light.i;
        nodes[first + i].q += weight[i] * light.q;
        nodes[first + i].u += weight[i] * light.u;
    }
}

/* Adds the light of a place of the image. */
static void add_place(void *user, const struct kd_disk_place *place)
{
    struct work *w = user;
    const struct kd_hole *hole = &w->image->hole;
    const double lambda = -place->alpha * w->image->sin_i, a = hole->a,
                 eta = (place->alpha - a) * (place->alpha + a) * w->image->cos_i * w->image->cos_i +
                       place->beta * place->beta;
    const struct kd_null_ray ray = { .hole = *hole,
                                     .radius = INFINITY,
                                     .cos_theta = w->image->cos_i,
                                     .sin_theta = w->image->sin_i,
                                     .alpha = place->alpha,
                                     .beta = place->beta,
                                     .orders = 1 };
    const struct kd_null_path path = kd_null_trace_radii(&ray);
    const struct meeting m =
        meeting_of(hole, place->r, 1, lambda, -sqrt(fmax(eta, 0)), path.crossings ? path.crossing[0].sense : 1);
    const double g = 1 / m.energy, flux = flux_of(w, place->r);
    /* The polarisation is along f = x right + y up, where x - i y = kappa/kappa(right). North + i east is y - i x. */
    const double complex right = (place->alpha + a * w->image->sin_i) + I * place->beta, l = m.l / right,
                         r = m.r / right;
    const double complex z = conj(l) * -I / cabs(l), turn = z * z; /* -i (x + i y) */
    const double side = cimag(conj(r) / conj(l)) > 0 ? 1 : -1;
    if (flux > 0) {
        const double light = place->area * kd_limb_at(w->p->limb, m.n[2]) * kd_limb_scale(w->p->limb),
                     q = -light * fraction_at(&w->atmosphere, m.n[2]);
        add(w->out->direct, place_of(0.25 * log(flux / w->mirror.largest) + log(g)),
            (struct kd_disk_iqu) { light, q * creal(turn), q * cimag(turn) });
    }
    if (!w->scattered)
        return;
    go_to_ring(w, place->r);
    double weights[COSINES];
    const double c = m.n[0] / hypot(m.n[0], m.n[1]), s = m.n[1] / hypot(m.n[0], m.n[1]),
                 angle[5] = { 1, m.n[0], m.n[1], c * c - s * s, 2 * s * c };
    cheb_weights(w->mirror.mu, COSINES, m.n[2], weights);
    double light[3][KD_STOKES_NODES] = { { 0 } };
    for (int j = 0; j < COSINES; j++)
        for (int n = 0; n < PARTS; n++) {
            const double part = place->area * weights[j] * angle[n % 5], *of = w->ring[j][n];
            double *to = light[n / 5];
            for (int k = w->first; k <= w->last; k++)
                to[k] += part * of[k];
        }
    for (int k = w->first; k <= w->last; k++) {
        const double q = light[0][k] - light[1][k], u = side * light[2][k];
        add(w->out->scattered, k + log(g) / STEP,
            (struct kd_disk_iqu) { light[0][k] + light[1][k], q * creal(turn) - u * cimag(turn),
                                   q * cimag(turn) + u * creal(turn) });
    }
}

enum kd_status kd_disk_stokes_init(struct kd_disk_stokes *stokes, const struct kd_disk_image *image,
                                   const struct kd_disk_spectrum_params *p, bool scattered, struct kd_error *error)
{
    const double length = KD_M_SUN_M * p->mass_msun / (p->distance_pc * KD_PARSEC_M),
                 f2 = p->colour_correction * p->colour_correction;
    struct work *w = calloc(1, sizeof *w);
    *stokes = (struct kd_disk_stokes) { .scale = length * length / (f2 * f2) };
    if (w) {
        w->rings = scattered ? calloc(RINGS, sizeof *w->rings) : NULL; /* takes 30 MB */
        w->ring = scattered ? calloc(COSINES, sizeof *w->ring) : NULL;
    }
    if (!w || (scattered && !(w->rings && w->ring))) {
        free(w ? w->rings : NULL);
        free(w ? w->ring : NULL);
        free(w);
        return kd_error_set(error, KD_ENOMEM, "out of memory for a polarised spectrum");
    }
    w->out = stokes, w->image = image, w->p = p, w->scattered = scattered;
    w->first = KD_STOKES_NODES, w->last = -1;
    atmosphere_init(&w->atmosphere);
    w->mirror.hole = &image->hole, w->mirror.p = p;
    w->mirror.largest = p->returning ? p->returning->largest
                                     : kd_disk_flux_page_thorne(&image->hole, kd_disk_peak_page_thorne(&image->hole));
    stokes->hottest_k =
        p->colour_correction * kd_disk_temperature(w->mirror.largest, &image->hole, p->mass_msun, p->mdot_edd);
    for (int j = 0; j < COSINES; j++)
        w->mirror.mu[j] = 0.5 * (1 + cos(M_PI * (j + 0.5) / COSINES));
    kd_scattering_functions(w->mirror.mu, COSINES, w->mirror.at);
    if (scattered)
        make_mirror(w);
    kd_disk_places(image, p->inner, p->outer, add_place, w);
    free(w->rings);
    free(w->ring);
    free(w);
    return KD_OK;
}

struct kd_disk_iqu kd_disk_stokes_at(const struct kd_disk_stokes *stokes,
                                     const struct kd_disk_iqu nodes[KD_STOKES_NODES], double frequency)
{
    struct kd_disk_iqu sum = { 0, 0, 0 };
    const double planck = 2 * KD_H_J_S * frequency * frequency * frequency / (KD_C_M_S * KD_C_M_S) * stokes->scale;
    for (int k = 0; k < KD_STOKES_NODES; k++) {
        const double light =
            planck / expm1(KD_H_J_S * frequency / (KD_K_J_K * stokes->hottest_k * exp(COLDEST + STEP * k)));
        sum.i += light * nodes[k].i, sum.q += light * nodes[k].q, sum.u += light * nodes[k].u;
    }
    return sum;
}
