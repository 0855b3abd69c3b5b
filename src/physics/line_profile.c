#include "physics/line_profile.h"

#include "physics/lamppost.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define STEP 0.03 /* of ln r between rings */
enum { FEWEST = 64, MOST = 512 }; /* rings */

double kd_line_limb(enum kd_line_limb limb, double mu)
{
    switch (limb) {
    case KD_LIMB_LAOR: return 1 + 2.06 * mu;
    case KD_LIMB_HAARDT: return log1p(1 / fmax(mu, 1e-300));
    case KD_LIMB_ISOTROPIC: break;
    }
    return 1;
}

static double emissivity(const struct kd_line_params *p, const struct kd_lamppost *lamp, double r)
{
    switch (p->emissivity) {
    case KD_LINE_POWER: return pow(r, -p->index);
    case KD_LINE_BROKEN: return pow(p->break_r, -p->index) * pow(r / p->break_r, r < p->break_r ? -p->index : -p->outer_index);
    case KD_LINE_LAMPPOST: break;
    }
    return kd_lamppost_at(lamp, r);
}

/* A ring as it is seen: places, energies, and how bright. */
struct ring {
    double alpha[KD_DISK_IMAGE_ANGLES], beta[KD_DISK_IMAGE_ANGLES], g[KD_DISK_IMAGE_ANGLES], light[KD_DISK_IMAGE_ANGLES];
};

struct sum {
    const double *edges;
    int bins, last; /* the bin that was met last: neighbours are near */
    double *in;     /* each bin */
    double total;
};

static int bin_of(struct sum *s, double g)
{
    int at = s->last;
    while (at > 0 && g < s->edges[at])
        at--;
    while (at < s->bins - 1 && g >= s->edges[at + 1])
        at++;
    return s->last = at;
}

struct corner {
    double g, light;
};

static void order(struct corner *x, struct corner *y)
{
    if (x->g > y->g) {
        struct corner t = *x;
        *x = *y, *y = t;
    }
}

/* A triangle over which g is linear, with these values at its corners in order: the share of it below an energy is square in that. */
struct slope {
    double low, middle, high, rise, fall; /* 1/((high - low)(middle - low)), 1/((high - low)(high - middle)) */
};

static double share_below(const struct slope *t, double g)
{
    if (g <= t->low)
        return 0;
    if (g >= t->high)
        return 1;
    return g < t->middle ? (g - t->low) * (g - t->low) * t->rise : 1 - (t->high - g) * (t->high - g) * t->fall;
}

static void add_triangle(struct sum *s, struct corner a, struct corner b, struct corner c, double area)
{
    double light = area * (a.light + b.light + c.light) / 3;
    order(&a, &b);
    order(&b, &c);
    order(&a, &b);
    s->total += light;
    int i = bin_of(s, a.g);
    if (a.g >= s->edges[i] && c.g <= s->edges[i + 1]) {
        s->in[i] += light;
        return;
    }
    double span = c.g - a.g;
    struct slope t = { a.g, b.g, c.g, 1 / (span * (b.g - a.g)), 1 / (span * (c.g - b.g)) };
    double before = share_below(&t, s->edges[i]);
    for (; i < s->bins && s->edges[i] < c.g; i++) {
        double share = share_below(&t, s->edges[i + 1]);
        s->in[i] += light * (share - before);
        before = share;
    }
}

static void fill_ring(const struct kd_disk_image *image, const struct kd_line_params *p, const struct kd_lamppost *lamp, double r, int skip, int n, struct ring *ring)
{
    double bright = emissivity(p, lamp, r);
    kd_disk_image_ring(image, r, skip, n, ring->alpha, ring->beta);
    struct kd_disk_ring gas = kd_disk_image_gas(image, r);
    for (int j = 0; j < n; j++) {
        struct kd_disk_light at = kd_disk_image_light(image, &gas, ring->alpha[j], ring->beta[j]);
        double g3 = at.g * at.g * at.g;
        ring->g[j] = at.g;
        ring->light[j] = bright * (p->energy ? g3 * at.g : g3) * (p->limb == KD_LIMB_ISOTROPIC ? 1 : kd_line_limb(p->limb, at.mu));
    }
}

static double area(const struct ring *x, int i, const struct ring *y, int j, const struct ring *z, int k)
{
    double a1 = y->alpha[j] - x->alpha[i], b1 = y->beta[j] - x->beta[i], a2 = z->alpha[k] - x->alpha[i], b2 = z->beta[k] - x->beta[i];
    return 0.5 * fabs(a1 * b2 - a2 * b1);
}

static struct corner corner_of(const struct ring *x, int i) { return (struct corner) { x->g[i], x->light[i] }; }

static void add_rings(struct sum *s, const struct ring *x, const struct ring *y, int n)
{
    for (int j = 0; j < n; j++) {
        int k = j + 1 < n ? j + 1 : 0;
        add_triangle(s, corner_of(x, j), corner_of(y, j), corner_of(y, k), area(x, j, y, j, y, k));
        add_triangle(s, corner_of(x, j), corner_of(x, k), corner_of(y, k), area(x, j, x, k, y, k));
    }
}

/* How closely an integral looks: rings and angles `coarse` times fewer, and every `skip`th node of the table. */
struct looks {
    int coarse, skip;
};

static void integrate(const struct kd_disk_image *image, const struct kd_line_params *p, const struct kd_lamppost *lamp, struct looks looks, struct ring rings[2],
                      struct sum *s)
{
    int around = image->angles > 64 || image->cos_i < 0.6 ? KD_DISK_IMAGE_ANGLES : KD_DISK_IMAGE_ANGLES / 2;
    int n = around / looks.coarse, m = (int)fmin(fmax(ceil(log(p->outer / p->inner) / STEP), FEWEST), MOST) / looks.coarse;
    for (int i = 0; i <= m; i++) {
        double r = i == m ? p->outer : p->inner * pow(p->outer / p->inner, (double)i / m);
        fill_ring(image, p, lamp, r, looks.skip, n, &rings[i & 1]);
        if (i)
            add_rings(s, &rings[!(i & 1)], &rings[i & 1], n);
    }
}

/* How far two sums differ in the cumulative share, at the edge where they do most. */
static double apart(const struct sum *x, const struct sum *y)
{
    double a = 0, b = 0, most = 0;
    for (int i = 0; i < x->bins; i++) {
        a += x->in[i] / x->total, b += y->in[i] / y->total;
        most = fmax(most, fabs(a - b));
    }
    return most;
}

enum { LEVELS = 3 }; /* looks: 4, 2 and 1 times fewer rings and angles */

/* Sums ever closer until the error is as small as it may be: at least two, of which the later one is the answer, in sums[*n]. Triangles err with the square of their size, so that halving it shows three
 * times what is left, of which half is counted; the table with the sixth power of its step, which would be 63 times: an eighth is counted. */
static double approach(const struct kd_disk_image *image, const struct kd_line_params *p, const struct kd_lamppost *lamp, struct ring rings[2], struct sum sums[LEVELS + 1], int *n)
{
    integrate(image, p, lamp, (struct looks) { 4, 2 }, rings, &sums[LEVELS]);
    integrate(image, p, lamp, (struct looks) { 4, 1 }, rings, &sums[0]);
    double table = 0.125 * apart(&sums[0], &sums[LEVELS]), error = INFINITY;
    for (*n = 0; *n < LEVELS - 1 && !(error <= p->tolerance);) {
        ++*n;
        integrate(image, p, lamp, (struct looks) { 4 >> *n, 1 }, rings, &sums[*n]);
        error = 0.5 * apart(&sums[*n], &sums[*n - 1]) + table;
    }
    return error;
}

enum kd_status kd_line_profile(const struct kd_disk_image *image, const struct kd_line_params *params, const double *edges, int bins, double *share,
                               struct kd_line_profile *profile, struct kd_error *error)
{
    struct kd_lamppost lamp;
    struct sum sums[LEVELS + 1];
    if (params->emissivity == KD_LINE_LAMPPOST && !kd_lamppost_init(&lamp, image->spin, params->height, params->photon_index, params->inner, params->outer))
        return kd_error_field(error, "/height", "height is %.9g: its light is not found on the whole disk", params->height);
    struct ring *rings = malloc(2 * sizeof *rings);
    double *in = calloc((size_t)bins * (LEVELS + 1), sizeof *in);
    enum kd_status status = rings && in ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory for %d bins", bins);
    if (!status) {
        int n;
        for (int i = 0; i <= LEVELS; i++)
            sums[i] = (struct sum) { .edges = edges, .bins = bins, .in = in + (size_t)i * (size_t)bins };
        double left = approach(image, params, &lamp, rings, sums, &n);
        *profile = (struct kd_line_profile) { .total = sums[n].total + (sums[n].total - sums[n - 1].total) / 3, .error = left };
        for (int i = 0; i < bins; i++)
            share[i] = sums[n].in[i] / sums[n].total;
        if (!(sums[n].total > 0 && isfinite(profile->total)))
            status = kd_error_field(error, "/spin", "spin is %.17g: the sum is no number, so near an extremal hole", image->spin);
    }
    free(rings);
    free(in);
    return status;
}
