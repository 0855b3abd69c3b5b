#include "physics/disk/line_profile.h"

#include "base/pause.h"
#include "physics/disk/disk_columns.h"
#include "physics/disk/lamppost.h"
#include "physics/spacetime/hole.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define STEP 0.03 /* mean spacing of rings in ln r */
/* cos i below which the error of coarse sums does not yet decrease as the square of the cells' size */
#define EDGE_ON 0.1
#define WIDEST 0.1 /* change of ln r in a cell of the finest columns */
/* spacing of rings at the brighter edge, relative to the mean spacing; at the other edge the relative spacing is 2
 * minus this */
#define BRIGHT 0.5
enum {
    FEWEST = 64,
    MOST = 512,
    COARSEST = 16,
    /* FEWEST, MOST: limits of the number of rings. COARSEST: factor by which the coarsest sum has fewer rings and
     * angles. LOOKED: number of parts into which a line is divided; two sums are compared at the edges of these parts
     * to estimate the error. */
    LOOKED = 128,
    COLUMNS = 256 /* number of the finest columns in each part of the image */
};

/* The light that the disk receives, on which some emissivities depend. */
struct received {
    struct kd_lamppost lamp;
    struct kd_corona_light corona;
};

static double emissivity(const struct kd_line_params *p, const struct received *received, double r)
{
    switch (p->emissivity) {
    case KD_LINE_POWER: return pow(r, -p->index);
    case KD_LINE_BROKEN:
        return pow(p->break_r, -p->index) * pow(r / p->break_r, r < p->break_r ? -p->index : -p->outer_index);
    case KD_LINE_LAMPPOST: return kd_lamppost_at(&received->lamp, r);
    case KD_LINE_RING:
    case KD_LINE_DISK:
    case KD_LINE_SLAB: break;
    }
    return kd_corona_light_at(&received->corona, r);
}

/* A ring's image: place, energy and brightness in each direction. The first direction is repeated at the end. */
struct ring {
    double alpha[KD_DISK_IMAGE_ANGLES + 1], beta[KD_DISK_IMAGE_ANGLES + 1], g[KD_DISK_IMAGE_ANGLES + 1],
        light[KD_DISK_IMAGE_ANGLES + 1];
};

/* The cells between two rings. For each cell: its light, and the distribution of its energies. This is the distribution
 * of a linear g over a parallelogram, with the corners at centre -+ (narrow +- wide)/2. */
struct strip {
    double light[KD_DISK_IMAGE_ANGLES], centre[KD_DISK_IMAGE_ANGLES], narrow[KD_DISK_IMAGE_ANGLES],
        wide[KD_DISK_IMAGE_ANGLES];
};

struct sum {
    const double *edges;
    /* last: index of the bin that last received light. The search for a bin starts there, because neighbouring cells
     * have similar energies */
    int bins, last;
    double *in; /* light in each bin */
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

/* Distribution of the energies in a cell, for a linear g over a parallelogram. The fraction of light below an energy is
 * a quadratic function at both ends and a linear one between them. */
struct spread {
    /* low: lowest energy. all: narrow + wide. slope: 1/wide. steep: 1/(2 narrow wide) */
    double low, narrow, all, slope, steep;
};

static double share_below(const struct spread *s, double g)
{
    double above = g - s->low, left = s->all - above;
    if (above <= 0)
        return 0;
    if (left <= 0)
        return 1;
    if (above < s->narrow)
        return above * above * s->steep;
    return left < s->narrow ? 1 - left * left * s->steep : (above - 0.5 * s->narrow) * s->slope;
}

static void add_cell(struct sum *s, double light, double centre, double narrow, double wide)
{
    double half = 0.5 * (narrow + wide), low = centre - half, high = centre + half;
    int i = bin_of(s, low);
    s->total += light;
    if (low >= s->edges[i] && high <= s->edges[i + 1]) {
        s->in[i] += light;
        return;
    }
    struct spread spread = { low, narrow, narrow + wide, 1 / wide, 0.5 / (narrow * wide) };
    double before = share_below(&spread, s->edges[i]);
    for (; i < s->bins && s->edges[i] < high; i++) {
        double share = share_below(&spread, s->edges[i + 1]);
        s->in[i] += light * (share - before);
        before = share;
    }
}

/* Shifts nodes so that chords between them are more accurate. A chord between nodes at the distance h deviates from the
 * curve by -h^2 f''/12 on average. If each node is shifted by a twelfth of its second difference, the remaining error
 * is of order h^4. At the horns of a profile, where g is stationary along a ring, the shift improves the accuracy as
 * much as twice as many directions would. Where f must stay positive, a node changes by no more than half of its value.
 */
static void straighten(double *f, int n, bool positive)
{
    double before = f[n - 1], first = f[0];
    for (int j = 0; j < n; j++) {
        double here = f[j], next = j + 1 < n ? f[j + 1] : first, moved = here - (1. / 12) * (before - 2 * here + next);
        f[j] = positive && moved < 0.5 * here ? 0.5 * here : moved;
        before = here;
    }
    f[n] = f[0];
}

static void fill_ring(const struct kd_disk_image *image, const struct kd_line_params *p,
                      const struct received *received, double r, int skip, int n, struct ring *ring)
{
    double bright = emissivity(p, received, r);
    kd_disk_image_ring(image, r, skip, n, ring->alpha, ring->beta);
    struct kd_disk_ring gas = kd_disk_image_gas(image, r);
    for (int j = 0; j < n; j++) {
        double g = ring->g[j] = kd_disk_image_redshift(image, &gas, ring->alpha[j]);
        ring->light[j] = bright * (p->energy ? g * g * g * g : g * g * g);
    }
    for (int j = 0; j < n && p->limb != KD_LIMB_ISOTROPIC; j++)
        ring->light[j] *= kd_limb_at(p->limb, kd_disk_image_light(image, &gas, ring->alpha[j], ring->beta[j]).mu);
    straighten(ring->alpha, n, false);
    straighten(ring->beta, n, false);
    straighten(ring->g, n, true);
    straighten(ring->light, n, true);
}

/* Fills the cells between two rings x and y, whose distance in ln r is `apart`. Across a cell the light is a power of
 * r. The area of a cell grows with the length of its edges and with its width, which is about proportional to r. The
 * product of light and area is integrated by Simpson's rule, with the geometric mean of the light in the middle. The
 * light-weighted mean of g differs from its middle value by a twelfth of the products of the steps of g and of the
 * light. */
static void fill_strip(const struct ring *x, const struct ring *y, double apart, int n, struct strip *strip)
{
    for (int j = 0; j < n; j++) {
        int k = j + 1;
        double wa = 0.5 * (y->alpha[j] + y->alpha[k] - x->alpha[j] - x->alpha[k]),
               wb = 0.5 * (y->beta[j] + y->beta[k] - x->beta[j] - x->beta[k]);
        double here = fabs(wa * (x->beta[k] - x->beta[j]) - wb * (x->alpha[k] - x->alpha[j])),
               there = fabs(wa * (y->beta[k] - y->beta[j]) - wb * (y->alpha[k] - y->alpha[j]));
        double area = 0.5 * (here + there), grown = 0.5 * area * apart, in = 0.5 * (x->light[j] + x->light[k]),
               out = 0.5 * (y->light[j] + y->light[k]);
        double first = in * (here - grown), last = out * (there + grown),
               light = (first + 4 * sqrt(in * out) * area + last) * (1. / 6);
        double along = (x->light[k] + y->light[k] - x->light[j] - y->light[j]) / (in + out);
        double g = 0.25 * (x->g[j] + x->g[k] + y->g[j] + y->g[k]),
               g_across = 0.5 * (y->g[j] + y->g[k] - x->g[j] - x->g[k]),
               g_along = 0.5 * (x->g[k] + y->g[k] - x->g[j] - y->g[j]);
        strip->light[j] = light;
        strip->centre[j] = g + (g_along * along + g_across * (last - first) / light) * (1. / 12);
        double one = fabs(g_across), other = fabs(g_along);
        strip->narrow[j] = one < other ? one : other, strip->wide[j] = one < other ? other : one;
    }
}

static void add_strip(struct sum *s, const struct ring *x, const struct ring *y, double apart, int n,
                      struct strip *strip)
{
    fill_strip(x, y, apart, n, strip);
    for (int j = 0; j < n; j++)
        add_cell(s, strip->light[j], strip->centre[j], strip->narrow[j], strip->wide[j]);
}

struct work {
    struct ring rings[2];
    struct strip strip;
};

/* Resolution of an integral. coarse: the finest integral has this many times more rings and angles. skip: every
 * `skip`th node of the table is used. */
struct looks { int coarse, skip; };

/* Adds the rings from p->inner to p->outer, between which the emissivity must have no break. */
static void add_rings(const struct kd_disk_image *image, const struct kd_line_params *p,
                      const struct received *received, struct looks looks, struct work *work, struct sum *s)
{
    int around = image->angles > 64 || image->cos_i < 0.6 ? KD_DISK_IMAGE_ANGLES : KD_DISK_IMAGE_ANGLES / 2;
    double rings_of_coarsest = ceil(log(p->outer / p->inner) / (STEP * COARSEST));
    int n = around / looks.coarse,
        m = (int)fmin(fmax(rings_of_coarsest, FEWEST / COARSEST), MOST / COARSEST) * (COARSEST / looks.coarse);
    struct ring *rings = work->rings;
    bool outwards = emissivity(p, received, p->outer) * p->outer * p->outer >
                    /* compares the light of rings of equal width in ln r */
                    emissivity(p, received, p->inner) * p->inner * p->inner;
    double before = 0, first = outwards ? 2 - BRIGHT : BRIGHT;
    for (int i = 0; i <= m; i++) {
        if (kd_pause_every((uint64_t)i, 4))
            return;
        double part = (double)i / m,
               r = i == m ? p->outer : p->inner * pow(p->outer / p->inner, part * (first + (1 - first) * part));
        fill_ring(image, p, received, r, looks.skip, n, &rings[i & 1]);
        if (i)
            add_strip(s, &rings[!(i & 1)], &rings[i & 1], log(r / before), n, &work->strip);
        before = r;
    }
}

struct range { double low, high; };

struct by_columns {
    const struct kd_disk_image *image;
    const struct kd_line_params *p;
    const struct received *received;
    union {
        struct sum *sum;
        struct range *range;
    };
};

/* g beside the middle of a cell. part: distance from the middle, as a fraction of the cell's width. The radius is kept
 * within the disk's edges. */
static double beside(const struct by_columns *u, const struct kd_disk_cell *cell, double part)
{
    const double aside = part * cell->width,
                 r = fmin(fmax(cell->end[1].r + cell->slope * aside, u->p->inner), u->p->outer);
    const struct kd_disk_ring gas = kd_disk_image_gas(u->image, r);
    return kd_disk_image_redshift(u->image, &gas, cell->alpha + aside);
}

/* Adds the light of a cell, integrated by Simpson's rule. g is taken as linear in alpha, and as linear in beta in each
 * half of the cell. */
static void add_column_cell(void *user, const struct kd_disk_cell *cell)
{
    const struct by_columns *u = user;
    double g[3], light[3];
    for (int k = 0; k < 3; k++) {
        const struct kd_disk_ring gas = kd_disk_image_gas(u->image, cell->end[k].r);
        const struct kd_disk_light seen = kd_disk_image_light(u->image, &gas, cell->alpha, cell->end[k].beta);
        g[k] = seen.g;
        light[k] = emissivity(u->p, u->received, cell->end[k].r) * kd_limb_at(u->p->limb, seen.mu) * seen.g * seen.g *
                   seen.g * (u->p->energy ? seen.g : 1);
    }
    const double all = cell->length * cell->width * (light[0] + 4 * light[1] + light[2]) / 6,
                 both = light[0] + 2 * light[1] + light[2];
    const double wide = fabs(beside(u, cell, 0.5) - beside(u, cell, -0.5));
    for (int k = 0; k < 2; k++) {
        const double half = light[k] + light[k + 1], along = g[k + 1] - g[k],
                     centre = 0.5 * (g[k] + g[k + 1]) + along * (light[k + 1] - light[k]) / (6 * half);
        if (half > 0)
            add_cell(u->sum, all * half / both, centre, fmin(fabs(along), wide), fmax(fabs(along), wide));
    }
}

/* Adds the light of an image without a table. */
static void add_columns(const struct kd_disk_image *image, const struct kd_line_params *p,
                        const struct received *received, int coarse, struct sum *s)
{
    struct by_columns user = { image, p, received, { .sum = s } };
    kd_disk_columns(image,
                    &(struct kd_disk_columns) { p->inner, p->outer, p->emissivity == KD_LINE_BROKEN ? p->break_r : 0,
                                                COLUMNS / coarse, WIDEST * sqrt(coarse), add_column_cell, &user });
}

/* Integrates with a ring at the break of the emissivity. Otherwise the break would be inside a cell, and the error
 * would depend on its position there. */
static void integrate(const struct kd_disk_image *image, const struct kd_line_params *p,
                      const struct received *received, struct looks looks, struct work *work, struct sum *s)
{
    struct kd_line_params inside = *p, outside = *p;
    if (!image->angles) {
        add_columns(image, p, received, looks.coarse, s);
        return;
    }
    if (p->emissivity != KD_LINE_BROKEN || p->break_r <= p->inner || p->break_r >= p->outer) {
        add_rings(image, p, received, looks, work, s);
        return;
    }
    inside.outer = outside.inner = p->break_r;
    add_rings(image, &inside, received, looks, work, s);
    add_rings(image, &outside, received, looks, work, s);
}

/* Edges of the bins of the sums. They are the requested edges, and further edges between and beyond these, because the
 * error estimate needs many. If two sums are compared at a few edges only, they may agree there by chance. */
struct edges {
    double *at;
    int n, bins;       /* n: number of requested edges. bins: number of bins of the sums */
    const double *own; /* the requested edges */
    int first;         /* index of the first requested edge: at[first] is own[0] */
};

/* Approximate range of energies of the line, from a few rings in a few directions. */
static struct range energies_of_rings(const struct kd_disk_image *image, const struct kd_line_params *p)
{
    enum { RINGS = 8, AROUND = 32 };
    double alpha[AROUND], beta[AROUND];
    struct range range = { INFINITY, 0 };
    for (int i = 0; i <= RINGS; i++) {
        double r = i == RINGS ? p->outer : p->inner * pow(p->outer / p->inner, (double)i / RINGS);
        struct kd_disk_ring gas = kd_disk_image_gas(image, r);
        kd_disk_image_ring(image, r, 1, AROUND, alpha, beta);
        for (int j = 0; j < AROUND; j++) {
            double g = kd_disk_image_redshift(image, &gas, alpha[j]);
            range.low = fmin(range.low, g), range.high = fmax(range.high, g);
        }
    }
    return range;
}

static void widen(void *user, const struct kd_disk_cell *cell)
{
    const struct by_columns *u = user;
    struct range *range = u->range;
    for (int k = 0; k < 3; k++) {
        const struct kd_disk_ring gas = kd_disk_image_gas(u->image, cell->end[k].r);
        const double g = kd_disk_image_redshift(u->image, &gas, cell->alpha);
        range->low = fmin(range->low, g), range->high = fmax(range->high, g);
    }
}

static struct range energies(const struct kd_disk_image *image, const struct kd_line_params *p)
{
    struct range range = { INFINITY, 0 };
    const struct by_columns user = { .image = image, .range = &range };
    if (image->angles)
        return energies_of_rings(image, p);
    kd_disk_columns(image, &(struct kd_disk_columns) { p->inner, p->outer, 0, 64, 0.5, widen, (void *)&user });
    return range;
}

/* Adds edges in the range [from, to): one at `from` and, within the line, one at each LOOKED-th part of the line's
 * range. Returns their number. */
static int divide(double from, double to, const struct range *line, double *at)
{
    double low = fmax(from, line->low), high = fmin(to, line->high);
    int n = 0, parts = high > low ? (int)ceil(LOOKED * ((high - low) / (line->high - line->low))) : 0;
    at[n++] = from;
    for (int i = low > from ? 0 : 1; i < parts; i++)
        at[n++] = low + (high - low) * i / parts;
    return n;
}

/* Makes the edges. at: memory for bins + 2 LOOKED + 4 edges. */
static struct edges edges_of(const struct range *line, const double *own, int bins, double *at)
{
    struct edges e = { .at = at, .n = bins + 1, .own = own };
    int n = line->low < own[0] ? divide(line->low, own[0], line, at) : 0;
    e.first = n;
    for (int i = 0; i < bins; i++)
        n += divide(own[i], own[i + 1], line, at + n);
    if (line->high > own[bins])
        n += divide(own[bins], line->high, line, at + n), at[n++] = line->high;
    else
        at[n++] = own[bins];
    e.bins = n - 1;
    return e;
}

/* Largest difference between the cumulative shares of two sums. Shares are cumulated from the first requested edge on.
 */
static double apart(const struct edges *edges, const struct sum *x, const struct sum *y)
{
    double off = 0, most = 0, first = 0;
    for (int i = 0; i < edges->first; i++)
        first += x->in[i] / x->total - y->in[i] / y->total;
    most = fabs(first);
    for (int i = 0; i < edges->bins; i++) {
        off += x->in[i] / x->total - y->in[i] / y->total;
        most = fmax(most, fabs(off - first));
    }
    return most;
}

/* Combines the bins of a sum into the requested bins. */
static void gather(const struct edges *edges, const struct sum *s, double *share)
{
    for (int i = 0, at = edges->first; i < edges->n - 1; i++)
        for (share[i] = 0; at < s->bins && edges->at[at] < edges->own[i + 1]; at++)
            share[i] += s->in[at] / s->total;
}

enum { LEVELS = 5 }; /* number of sums; they have 16, 8, 4, 2 and 1 times fewer rings and angles than the finest */

/* Computes finer and finer sums until the error is within the tolerance or no finer sum exists. At least three sums are
 * computed. The answer is the last sum, sums[*n]. Returns the estimated error.
 *
 * The error due to the cells decreases as the square of their size. So halving the cells changes the sum by three times
 * the remaining error. For safety three quarters of the change are reported as the error. Near edge-on, where this does
 * not hold yet, the whole difference is reported, from at least four sums. Two sums may agree by chance. The reported
 * error is therefore at least a quarter of the error that the halving before suggests. The error of the table decreases
 * as the sixth power of its step, so that a sum with twice the step differs by 63 times the error. An eighth of this
 * difference is added, and near edge-on a quarter. */
static double approach(const struct kd_disk_image *image, const struct kd_line_params *p,
                       const struct received *received, const struct edges *edges, struct work *work,
                       struct sum sums[LEVELS + 1], int *n)
{
    const bool edge_on = image->cos_i < EDGE_ON;
    double table = 0;
    integrate(image, p, received, (struct looks) { COARSEST, 1 }, work, &sums[0]);
    integrate(image, p, received, (struct looks) { COARSEST / 2, 1 }, work, &sums[1]);
    if (image->angles) {
        integrate(image, p, received, (struct looks) { COARSEST / 2, 2 }, work, &sums[LEVELS]);
        table = (edge_on ? 0.25 : 0.125) * apart(edges, &sums[1], &sums[LEVELS]);
    }
    double before = apart(edges, &sums[1], &sums[0]), error = INFINITY;
    for (*n = 1; *n < LEVELS - 1 && (*n < (edge_on ? 3 : 2) || !(error <= p->tolerance));) {
        ++*n;
        integrate(image, p, received, (struct looks) { COARSEST >> *n, 1 }, work, &sums[*n]);
        double here = apart(edges, &sums[*n], &sums[*n - 1]);
        error = (edge_on ? 1 : 0.75) * fmax(here, 0.25 * before) + table;
        before = here;
    }
    return error;
}

static enum kd_status receive(const struct kd_hole *hole, const struct kd_line_params *p, struct received *received,
                              struct kd_error *error)
{
    enum kd_status status = KD_OK;
    if (p->emissivity == KD_LINE_LAMPPOST)
        status =
            kd_lamppost_init(&received->lamp, hole, p->height, p->photon_index, p->inner, p->outer) ? KD_OK : KD_EINVAL;
    else if (p->emissivity >= KD_LINE_RING)
        status = kd_corona_light_of(hole, &p->corona, p->photon_index, p->inner, p->outer, &received->corona);
    if (status == KD_ENOMEM)
        return kd_error_set(error, KD_ENOMEM, "out of memory for the light of a corona");
    if (status)
        return kd_error_field(
            error, "/height",
            "height is %.9g M; it must be different, because no rays from there to some radii of the disk were found",
            p->height);
    return KD_OK;
}

enum kd_status kd_line_profile(const struct kd_disk_image *image, const struct kd_line_params *params,
                               const double *edges, int bins, double *share, struct kd_line_profile *profile,
                               struct kd_error *error)
{
    const struct kd_hole_parameter largest = kd_hole_largest(&image->hole);
    struct received received;
    struct sum sums[LEVELS + 1];
    const enum kd_status lit = receive(&image->hole, params, &received, error);
    if (lit)
        return lit;
    struct work *work = malloc(sizeof *work);
    const size_t most = (size_t)bins + 2 * LOOKED + 4;
    double *in = calloc(most * (LEVELS + 2), sizeof *in);
    enum kd_status status = work && in ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory for %d bins", bins);
    if (!status) {
        int n;
        const struct range line = energies(image, params);
        const struct edges all = edges_of(&line, edges, bins, in + most * (LEVELS + 1));
        for (int i = 0; i <= LEVELS; i++)
            sums[i] = (struct sum) { .edges = all.at, .bins = all.bins, .in = in + (size_t)i * most };
        double left = approach(image, params, &received, &all, work, sums, &n);
        *profile = (struct kd_line_profile) { .total = sums[n].total + (sums[n].total - sums[n - 1].total) / 3,
                                              .error = left };
        gather(&all, &sums[n], share);
        if (!(sums[n].total > 0 && isfinite(profile->total)))
            status = kd_error_field(error, largest.pointer,
                                    "%s is %.17g, so close to an extremal hole that the profile is not a number",
                                    largest.name, largest.value);
    }
    free(work);
    free(in);
    return status;
}
