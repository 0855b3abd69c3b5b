#include "physics/disk/disk_spectrum.h"

#include "base/pause.h"
#include "physics/disk/disk_columns.h"
#include "physics/disk/thin_disk.h"
#include "physics/math/constants.h"
#include "physics/spacetime/hole.h"

#include <math.h>
#include <stdlib.h>

enum { PANELS = 32, GAUSS = 3, COLUMNS = 256 /* numbers in each part of an image without a table */ };
static const double at_gauss[GAUSS] = { -0.7745966692414834, 0, 0.7745966692414834 },
                    share_gauss[GAUSS] = { 5. / 18, 8. / 18, 5. / 18 };
/* Fraction of a difference that is reported as the table's error: the difference between the full sum and the sum with
 * every second node. The table's error decreases at best as the sixth power of the step, and the difference is then 63
 * times the error (as in line_profile.c) */
#define TABLE 0.125
/* cos i below which the error of sums does not yet decrease as the square of the cells' size. In this range the errors
 * of randomly chosen sums were up to 2.1 times the estimate (tests/unit/told_spectra.c). Four times the estimate is
 * therefore reported. */
#define EDGE_ON 0.1
#define WIDEST 0.1 /* change of ln r in a cell of the finest columns */
#define APART 1e-3 /* step for slopes of the image, as a fraction of the distance to the horizon */

/* A ring of the integral. Its neighbours are two rings close to it, from which the Jacobian J = |d(alpha, beta)/d(ln r,
 * chi)| is computed at each angle. */
struct ring {
    double alpha[KD_DISK_IMAGE_ANGLES], beta[KD_DISK_IMAGE_ANGLES], below[2][KD_DISK_IMAGE_ANGLES],
        above[2][KD_DISK_IMAGE_ANGLES];
};

/* Derivative along a ring, of fourth order, from four neighbours. */
static double along(const double *x, int j, int n)
{
    double near = x[(j + 1) % n] - x[(j + n - 1) % n], far = x[(j + 2) % n] - x[(j + n - 2) % n];
    return (8 * near - far) / (12 * 2 * M_PI / n);
}

static double stretch_of(const struct ring *ring, double apart, int j, int n)
{
    double a_r = (ring->above[0][j] - ring->below[0][j]) / (2 * apart),
           b_r = (ring->above[1][j] - ring->below[1][j]) / (2 * apart);
    return fabs(a_r * along(ring->beta, j, n) - b_r * along(ring->alpha, j, n));
}

/* Sets up a ring at r. Returns the step in ln r to the two close rings. */
static double go_to(const struct kd_disk_image *image, double r, int skip, int n, struct ring *ring)
{
    const double apart = kd_disk_image_step(image, r, APART);
    kd_disk_image_ring(image, r, skip, n, ring->alpha, ring->beta);
    kd_disk_image_ring(image, r * exp(-apart), skip, n, ring->below[0], ring->below[1]);
    kd_disk_image_ring(image, r * exp(apart), skip, n, ring->above[0], ring->above[1]);
    return apart;
}

static double flux_at(const struct kd_disk_image *image, const struct kd_disk_spectrum_params *p, double r)
{
    return p->returning ? kd_returning_flux(p->returning, r) : kd_disk_flux_page_thorne(&image->hole, r);
}

static double temperature_at(const struct kd_disk_image *image, const struct kd_disk_spectrum_params *p, double r)
{
    return kd_disk_temperature(flux_at(image, p, r), &image->hole, p->mass_msun, p->mdot_edd) * p->colour_correction;
}

/* Adds the light of a part of the image at the temperature t. g^3 B_nu(nu/g) equals B_nu(nu) at the temperature g T.
 * Planck's law here is without the factor 2 h nu^3/c^2. */
static void add_part(const struct kd_disk_spectrum_params *p, double t, const struct kd_disk_light *light, double area,
                     const double *frequencies, int n_f, double *sum)
{
    const double part = area * kd_limb_at(p->limb, light->mu) * kd_limb_scale(p->limb),
                 x = KD_H_J_S / (KD_K_J_K * t * light->g);
    for (int i = 0; i < n_f; i++)
        sum[i] += part / expm1(x * frequencies[i]);
}

/* Adds a ring's light. weight: width of the ring in ln r. */
static void add_ring(const struct kd_disk_image *image, const struct kd_disk_spectrum_params *p, double r,
                     double weight, int skip, int n, const double *frequencies, int n_f, struct ring *ring, double *sum)
{
    struct kd_disk_ring gas = kd_disk_image_gas(image, r);
    const double t = temperature_at(image, p, r);
    if (!(t > 0))
        return;
    const double apart = go_to(image, r, skip, n, ring);
    for (int j = 0; j < n; j++) {
        struct kd_disk_light light = kd_disk_image_light(image, &gas, ring->alpha[j], ring->beta[j]);
        add_part(p, t, &light, weight * stretch_of(ring, apart, j, n) * (2 * M_PI / n), frequencies, n_f, sum);
    }
}

/* For an image next to edge-on: integrates the light of each cell of the columns by Simpson's rule. */
struct by_columns {
    const struct kd_disk_image *image;
    const struct kd_disk_spectrum_params *p;
    const double *frequencies;
    int n;
    double *sum;
};

static void add_cell(void *user, const struct kd_disk_cell *cell)
{
    static const double simpson[] = { 1. / 6, 4. / 6, 1. / 6 };
    const struct by_columns *u = user;
    for (int k = 0; k < 3; k++) {
        const double r = cell->end[k].r, t = temperature_at(u->image, u->p, r);
        if (!(t > 0))
            continue;
        const struct kd_disk_ring gas = kd_disk_image_gas(u->image, r);
        const struct kd_disk_light light = kd_disk_image_light(u->image, &gas, cell->alpha, cell->end[k].beta);
        add_part(u->p, t, &light, simpson[k] * cell->width * cell->length, u->frequencies, u->n, u->sum);
    }
}

static void add_columns(const struct kd_disk_image *image, const struct kd_disk_spectrum_params *p, int coarse,
                        const double *frequencies, int n, double *sum)
{
    struct by_columns user = { image, p, frequencies, n, sum };
    kd_disk_columns(image, &(struct kd_disk_columns) { .inner = p->inner,
                                                       .outer = p->outer,
                                                       .columns = COLUMNS / coarse,
                                                       .step = WIDEST * sqrt(coarse),
                                                       .add = add_cell,
                                                       .user = &user });
}

/* Resolution of an integral. coarse: the finest integral has this many times more points. skip: every `skip`th node of
 * the table is used. */
struct looks { int coarse, skip; };

static void integrate(const struct kd_disk_image *image, const struct kd_disk_spectrum_params *p, struct looks looks,
                      const double *frequencies, int n_f, struct ring *ring, double *sum)
{
    int n = (image->angles > 128 ? 512 : image->angles > 64 ? 256 : 128) / looks.coarse, panels = PANELS / looks.coarse;
    double span = log(p->outer / p->inner);
    if (!image->angles) {
        add_columns(image, p, looks.coarse, frequencies, n_f, sum);
        return;
    }
    for (int i = 0; i < panels; i++)
        for (int k = 0; k < GAUSS; k++) {
            if (kd_pause())
                return;
            /* ln r = ln inner + span s^2: points are even in s, because T varies as the square root of r - r_isco */
            double s = (i + 0.5 + 0.5 * at_gauss[k]) / panels;
            add_ring(image, p, p->inner * exp(span * s * s), span * 2 * s * share_gauss[k] / panels, looks.skip, n,
                     frequencies, n_f, ring, sum);
        }
}

void kd_disk_places(const struct kd_disk_image *image, double inner, double outer,
                    void (*each)(void *user, const struct kd_disk_place *place), void *user)
{
    struct ring ring;
    const int n = image->angles > 128 ? 512 : image->angles > 64 ? 256 : 128;
    const double span = log(outer / inner);
    for (int i = 0; i < PANELS * GAUSS; i++) {
        const double s = (i / GAUSS + 0.5 + 0.5 * at_gauss[i % GAUSS]) / PANELS, r = inner * exp(span * s * s),
                     weight = span * 2 * s * share_gauss[i % GAUSS] / PANELS, apart = go_to(image, r, 1, n, &ring);
        for (int j = 0; j < n; j++)
            each(user, &(struct kd_disk_place) { r, ring.alpha[j], ring.beta[j],
                                                 weight * stretch_of(&ring, apart, j, n) * (2 * M_PI / n) });
        if (kd_pause())
            return;
    }
}

/* The error of a sum. It is estimated from two coarser sums, because two sums alone may agree by chance. One coarser
 * sum has half as many points. The other uses every second node of the table; next to edge-on it has a quarter as many
 * points instead. */
static double told(const struct kd_disk_image *image, double flux, double other, double rough)
{
    const double here = fabs(other - flux), before = fabs(rough - other);
    if (!image->angles)
        return fmax(here, 0.25 * before);
    return (image->cos_i < EDGE_ON ? 4 : 1) * (here + TABLE * before);
}

enum kd_status kd_disk_spectrum(const struct kd_disk_image *image, const struct kd_disk_spectrum_params *p,
                                const double *frequencies, int n, double *flux, double *error_out,
                                struct kd_error *error)
{
    const struct kd_hole_parameter largest = kd_hole_largest(&image->hole);
    struct ring *ring = malloc(sizeof *ring);
    double *other = calloc(2 * (size_t)n, sizeof *other), *rough = other + n,
           f2 = p->colour_correction * p->colour_correction, most = 0;
    double length = KD_M_SUN_M * p->mass_msun / (p->distance_pc * KD_PARSEC_M), scale = length * length / (f2 * f2);
    enum kd_status status =
        ring && other ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory for %d frequencies", n);
    for (int i = 0; i < n; i++)
        flux[i] = 0;
    if (!status) {
        integrate(image, p, (struct looks) { 1, 1 }, frequencies, n, ring, flux);
        integrate(image, p, (struct looks) { 2, 1 }, frequencies, n, ring, other);
        integrate(image, p, image->angles ? (struct looks) { 2, 2 } : (struct looks) { 4, 1 }, frequencies, n, ring,
                  rough);
    }
    for (int i = 0; !status && i < n; i++) {
        double planck = 2 * KD_H_J_S * frequencies[i] * frequencies[i] * frequencies[i] / (KD_C_M_S * KD_C_M_S) * scale;
        flux[i] *= planck, other[i] *= planck, rough[i] *= planck;
        most = fmax(most, flux[i]);
        if (!isfinite(flux[i]) || !isfinite(other[i]) || !isfinite(rough[i]))
            status =
                kd_error_field(error, largest.pointer,
                               "%s is %.17g, so close to an extremal hole that the flux at %.9g Hz is not a number",
                               largest.name, largest.value, frequencies[i]);
    }
    *error_out = 0;
    for (int i = 0; !status && i < n; i++)
        if (flux[i] > 1e-6 * most)
            *error_out = fmax(*error_out, told(image, flux[i], other[i], rough[i]) / flux[i]);
    free(ring);
    free(other);
    return status;
}
