#include "physics/disk/echo.h"

#include "base/pause.h"
#include "physics/null/null_geodesic.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    RINGS = 256, /* number of cells between the inner and the outer edge, of equal width in ln r */
    AROUND = 256,
    /* number of parts, in each direction, into which a cell is divided; light is interpolated at each part */
    FINER = 2,
};

/* A point of the disk as the observer sees it. g: energy divided by E0. time: t_2 of echo.h. light: photons per area of
 * the image for epsilon = 1. */
struct point { double alpha, beta, g, time, light; };

struct view {
    struct kd_corona corona;
    struct point (*points)[AROUND]; /* light at each of RINGS + 1 rings */
    double log_epsilon[RINGS + 1];
    double *part, *time; /* the corona's light: its parts and their times, by ring and angle */
};

static void finish(struct view *view)
{
    kd_corona_finish(&view->corona);
    free(view->points);
    free(view->part);
    free(view->time);
}

static bool fill_ring(const struct kd_disk_image *image, const struct kd_echo_params *p, double r,
                      struct point ring[AROUND])
{
    double alpha[AROUND], beta[AROUND];
    const struct kd_disk_ring gas = kd_disk_image_gas(image, r);
    kd_disk_image_ring(image, r, 1, AROUND, alpha, beta);
    for (int j = 0; j < AROUND; j++) {
        const struct kd_disk_light light = kd_disk_image_light(image, &gas, alpha[j], beta[j]);
        const struct kd_null_ray ray = { .hole = image->hole,
                                         .radius = INFINITY,
                                         .cos_theta = image->cos_i,
                                         .sin_theta = image->sin_i,
                                         .alpha = alpha[j],
                                         .beta = beta[j],
                                         .orders = 1 };
        const struct kd_null_path path = kd_null_trace_fast(&ray);
        if (!path.crossings)
            return false;
        if (kd_pause_every((uint64_t)j, 64))
            return false;
        ring[j] = (struct point) { alpha[j], beta[j], light.g, path.crossing[0].delay,
                                   light.g * light.g * light.g * kd_limb_at(p->limb, light.mu) };
    }
    return true;
}

static enum kd_status make_view(const struct kd_disk_image *image, const struct kd_echo_params *p, struct view *view,
                                struct kd_echo *echo, struct kd_error *error)
{
    *view = (struct view) { .points = malloc((RINGS + 1) * sizeof *view->points) };
    if (!view->points)
        return kd_error_set(error, KD_ENOMEM, "out of memory for the image of a disk");
    if (!kd_corona_direct_of(&p->source, p->photon_index, image->cos_i, &echo->direct))
        return kd_error_field(error, "/height",
                              "no direct light from the source to the observer was found for this height and "
                              "corona_radius; one of them, or inclination_deg, must be different");
    const enum kd_status status = kd_corona_init(&view->corona, &p->source, p->photon_index, p->inner, p->outer);
    if (status == KD_ENOMEM)
        return kd_error_set(error, KD_ENOMEM, "out of memory for the light of a corona");
    if (status)
        return kd_error_field(error, "/height",
                              "no rays from the source to some radii of the disk were found for this height and "
                              "corona_radius; one of them must be different");
    const size_t angles = (size_t)view->corona.angles;
    view->part = malloc((RINGS + 1) * angles * sizeof(double));
    view->time = malloc((RINGS + 1) * angles * sizeof(double));
    if (!view->part || !view->time)
        return kd_error_set(error, KD_ENOMEM, "out of memory for the light of a corona");
    for (int i = 0; i <= RINGS; i++) {
        const double r = i == RINGS ? p->outer : p->inner * pow(p->outer / p->inner, (double)i / RINGS);
        kd_corona_parts(&view->corona, r, view->part + (size_t)i * angles, view->time + (size_t)i * angles);
        double all = 0;
        for (size_t j = 0; j < angles; j++)
            all += view->part[(size_t)i * angles + j];
        view->log_epsilon[i] = log(all);
        if (!fill_ring(image, p, r, view->points[i]))
            return kd_error_field(
                error, "/inclination_deg",
                "no ray to the ring at %.9g M was found for this inclination_deg; it must be different", r);
    }
    return KD_OK;
}

/* A cell between two rings and two directions. */
struct cell { const struct point *in[2], *out[2]; };

static double at(double x0, double x1, double y0, double y1, double across, double along)
{
    return (x0 + (x1 - x0) * along) * (1 - across) + (y0 + (y1 - y0) * along) * across;
}

#define AT(member, across, along) \
    at(c->in[0]->member, c->in[1]->member, c->out[0]->member, c->out[1]->member, across, along)

/* Half the range of a member's values within a part of the cell, where the member is taken as linear. */
#define REACH(member) \
    (0.5 / FINER * \
     (fabs(AT(member, across, 1) - AT(member, across, 0)) + fabs(AT(member, 1, along) - AT(member, 0, along))))

static double area_at(const struct cell *c, double across, double along)
{
    const double wa = AT(alpha, 1, along) - AT(alpha, 0, along), wb = AT(beta, 1, along) - AT(beta, 0, along),
                 la = AT(alpha, across, 1) - AT(alpha, across, 0), lb = AT(beta, across, 1) - AT(beta, across, 0);
    return fabs(wa * lb - wb * la) / (FINER * FINER);
}

/* Histogram over energy and time. edges: edges of the bins of energy. step: width of the bins of time. row: scratch
 * memory for the light, by time, of the part of a cell that is being added. */
struct sum {
    double total, late;
    const double *edges;
    double first, step;
    size_t bins, times;
    /* in: light in each bin. steps: changes of `row` from one bin of time to the next, times + 1 entries */
    double *in, *row, *steps;
};

static size_t first_bin(const double *edges, size_t n, double x)
{
    size_t low = 0, high = n;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (edges[middle + 1] <= x)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Fraction of the range from `low` to `high` that is in bin i. */
static double overlap(double low, double high, const double *edges, size_t i)
{
    if (high <= low)
        return low >= edges[i] && low < edges[i + 1];
    return fmax(0, fmin(high, edges[i + 1]) - fmax(low, edges[i])) / (high - low);
}

/* The bins that a range overlaps: from `first` to end - 1. */
struct touched { size_t first, end; };

/* Spreads light evenly over the time between `from` and `to`. Returns the bins of time that this range overlaps. */
static struct touched spread(struct sum *s, double light, double from, double to)
{
    const double low = (from - s->first) / s->step, high = (to - s->first) / s->step, last = (double)s->times;
    if (!(high >= 0 && low < last))
        return (struct touched) { s->times, 0 };
    const struct touched at = { low > 0 ? (size_t)low : 0, high < last ? (size_t)high + 1 : s->times };
    const size_t end = at.end - 1;
    const double density = light / fmax(high - low, 1e-9);
    if (high - low < 1e-9) {
        s->row[at.first] += light;
        return at;
    }
    s->row[at.first] += density * (fmin(high, (double)at.first + 1) - fmax(low, (double)at.first));
    if (end > at.first) {
        s->row[end] += density * (fmin(high, (double)at.end) - (double)end);
        s->steps[at.first + 1] += density, s->steps[end] -= density;
    }
    return at;
}

/* Adds a part of a cell. Light that leaves the source at different angles arrives at different times. The light between
 * two neighbouring angles is spread evenly over the time between the arrivals of both. */
static void add_part(const struct view *view, const struct cell *c, size_t ring, size_t skip, double zero,
                     double across, double along, struct sum *s)
{
    const size_t n = (size_t)view->corona.angles;
    const double *parts[2] = { view->part + ring * n, view->part + (ring + skip) * n },
                 *times[2] = { view->time + ring * n, view->time + (ring + skip) * n };
    /* Between two rings epsilon is interpolated as a power of r. The share of epsilon that each angle has is
     * interpolated linearly. */
    const double in = view->log_epsilon[ring], out = view->log_epsilon[ring + skip],
                 power = exp((1 - across) * in + across * out) / ((1 - across) * exp(in) + across * exp(out));
    const double light = power * AT(light, across, along) * area_at(c, across, along), g = AT(g, across, along),
                 wide = REACH(g), late = AT(time, across, along) - zero, slow = REACH(time);
    double before = 0, before_part = 0;
    struct touched all = { s->times, 0 };
    /* the angles are periodic, so the angle before the first one is the last one */
    for (size_t k = n > 1 ? 0 : 1; k <= n; k++) {
        const size_t j = (k + n - 1) % n;
        const double bright = light * ((1 - across) * parts[0][j] + across * parts[1][j]),
                     here = late + (1 - across) * times[0][j] + across * times[1][j],
                     runs = slow + 0.5 / FINER * fabs(times[1][j] - times[0][j]);
        if (k) {
            const double piece = n > 1 ? 0.5 * (bright + before_part) : bright, other = n > 1 ? before : here,
                         from = fmin(here, other) - runs, to = fmax(here, other) + runs;
            const struct touched at = spread(s, piece, from, to);
            s->total += piece;
            s->late += piece * 0.5 * (from + to);
            all.first = at.first < all.first ? at.first : all.first;
            all.end = at.end > all.end ? at.end : all.end;
        }
        before = here, before_part = bright;
    }
    double level = 0;
    for (size_t k = all.first; k < all.end; k++) {
        level += s->steps[k], s->steps[k] = 0;
        s->row[k] += level;
    }
    for (size_t i = first_bin(s->edges, s->bins, g - wide); i < s->bins && s->edges[i] <= g + wide; i++) {
        const double share = overlap(g - wide, g + wide, s->edges, i);
        for (size_t k = all.first; k < all.end; k++)
            s->in[i * s->times + k] += share * s->row[k];
    }
    for (size_t k = all.first; k < all.end; k++)
        s->row[k] = 0;
}

static struct cell cell_of(const struct view *view, int i, int j, int skip)
{
    const int next = (j + skip) % AROUND;
    return (struct cell) { { &view->points[i][j], &view->points[i][next] },
                           { &view->points[i + skip][j], &view->points[i + skip][next] } };
}

/* Adds the cells between every `skip`th ring and every `skip`th direction. */
static void add_all(const struct view *view, double zero, int skip, struct sum *s)
{
    for (int i = 0; i < RINGS; i += skip)
        for (int j = 0; j < AROUND; j += skip) {
            const struct cell cell = cell_of(view, i, j, skip);
            if (kd_pause())
                return;
            for (int x = 0; x < FINER; x++)
                for (int y = 0; y < FINER; y++)
                    add_part(view, &cell, (size_t)i, (size_t)skip, zero, (x + 0.5) / FINER, (y + 0.5) / FINER, s);
        }
}

/* Finds the largest difference between the cumulative shares of two histograms. */
static enum kd_status apart(const struct sum *x, const struct sum *y, double *worst, struct kd_error *error)
{
    double *above = calloc(x->times + 1, sizeof *above);
    *worst = 0;
    for (size_t i = 0; above && i < x->bins; i++) {
        double row = 0;
        for (size_t k = 0; k < x->times; k++) {
            row += x->in[i * x->times + k] / x->total - y->in[i * x->times + k] / y->total;
            above[k] += row;
            *worst = fmax(*worst, fabs(above[k]));
        }
    }
    const bool made = above;
    free(above);
    return made ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory for %zu times", x->times);
}

/* Computes the strength of the line. The gas is taken to emit as many photons as it receives, by the law of limb
 * darkening. */
static void describe(const struct kd_echo_params *p, double total, struct kd_echo *echo)
{
    echo->strength = total * kd_limb_scale(p->limb) / (M_PI * echo->direct.flux);
}

enum kd_status kd_echo_impulse(const struct kd_disk_image *image, const struct kd_echo_params *params,
                               const double *edges, size_t bins, double first, double step, size_t times, double *share,
                               struct kd_echo *echo, struct kd_error *error)
{
    struct view view;
    double *room = calloc((bins + 2) * times + 1, sizeof *room);
    struct sum fine = { 0, 0, edges, first, step, bins, times, share, room, NULL }, rough;
    enum kd_status status;
    memset(share, 0, bins * times * sizeof *share);
    *echo = (struct kd_echo) { .error = NAN };
    KD_TRY(make_view(image, params, &view, echo, error));
    if (!room)
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for %zu bins", bins * times));
    fine.steps = room + (bins + 1) * times;
    rough = fine;
    rough.in = room + times;
    add_all(&view, echo->direct.time, 1, &fine);
    add_all(&view, echo->direct.time, 2, &rough);
    KD_TRY(apart(&fine, &rough, &echo->error, error));
    describe(params, fine.total, echo);
    echo->mean = fine.late / fine.total;
    for (size_t i = 0; i < bins * times; i++)
        share[i] /= fine.total;
done:
    finish(&view);
    free(room);
    return status;
}

/* Light of the corona at a ring. mean: mean of t_1. of: mean of exp(2 pi i f (t_1 - mean)) for each frequency f. */
struct beat { double log_epsilon, mean, *of; /* real and imaginary part for each frequency */ };

static void fill_beat(const struct view *view, size_t i, const double *frequencies, size_t n, struct beat *beat)
{
    const size_t angles = (size_t)view->corona.angles;
    const double *part = view->part + i * angles, *time = view->time + i * angles;
    double all = 0, sum = 0;
    for (size_t j = 0; j < angles; j++)
        all += part[j], sum += part[j] * time[j];
    beat->mean = sum / all, beat->log_epsilon = log(all);
    for (size_t k = 0; k < n; k++) {
        beat->of[2 * k] = beat->of[2 * k + 1] = 0;
        for (size_t j = 0; j < angles; j++) {
            const double phase = 2 * M_PI * frequencies[k] * (time[j] - beat->mean);
            beat->of[2 * k] += part[j] / all * cos(phase);
            beat->of[2 * k + 1] += part[j] / all * sin(phase);
        }
    }
}

struct transform {
    const double *edges, *frequencies;
    size_t bins, n;
    double total, *out;
};

static double sinc(double x) { return fabs(x) < 1e-6 ? 1 : sin(x) / x; }

static void transform_part(const struct cell *c, const struct beat *in, const struct beat *out, double zero,
                           double across, double along, struct transform *t)
{
    const double light = AT(light, across, along) * area_at(c, across, along) *
                         exp((1 - across) * in->log_epsilon + across * out->log_epsilon),
                 g = AT(g, across, along), wide = REACH(g),
                 slow = REACH(time) + 0.5 / FINER * fabs(out->mean - in->mean),
                 late = AT(time, across, along) - zero + (1 - across) * in->mean + across * out->mean;
    const size_t first = first_bin(t->edges, t->bins, g - wide);
    t->total += light;
    for (size_t k = 0; k < t->n; k++) {
        const double turn = 2 * M_PI * t->frequencies[k], c0 = cos(turn * late), s0 = sin(turn * late),
                     re = (1 - across) * in->of[2 * k] + across * out->of[2 * k],
                     im = (1 - across) * in->of[2 * k + 1] + across * out->of[2 * k + 1],
                     all = light * sinc(turn * slow);
        for (size_t i = first; i < t->bins && t->edges[i] <= g + wide; i++) {
            const double share = all * overlap(g - wide, g + wide, t->edges, i);
            t->out[2 * (i * t->n + k)] += share * (re * c0 - im * s0);
            t->out[2 * (i * t->n + k) + 1] += share * (re * s0 + im * c0);
        }
    }
}

static void transform_all(const struct view *view, const struct beat *beats, double zero, int skip, struct transform *t)
{
    for (int i = 0; i < RINGS; i += skip)
        for (int j = 0; j < AROUND; j += skip) {
            const struct cell cell = cell_of(view, i, j, skip);
            if (kd_pause())
                return;
            for (int x = 0; x < FINER; x++)
                for (int y = 0; y < FINER; y++)
                    transform_part(&cell, &beats[i], &beats[i + skip], zero, (x + 0.5) / FINER, (y + 0.5) / FINER, t);
        }
}

void kd_echo_direct(const struct kd_corona_direct *direct, double frequency, double part[2])
{
    part[0] = part[1] = 0;
    for (int k = 0; k < direct->n; k++) {
        const double phase = 2 * M_PI * frequency * (direct->part_time[k] - direct->time);
        part[0] += direct->part[k] / direct->flux * cos(phase);
        part[1] += direct->part[k] / direct->flux * sin(phase);
    }
}

enum kd_status kd_echo_transform(const struct kd_disk_image *image, const struct kd_echo_params *params,
                                 const double *edges, size_t bins, const double *frequencies, size_t n, double *part,
                                 double *coarse, struct kd_echo *echo, struct kd_error *error)
{
    struct view view;
    struct beat beats[RINGS + 1];
    double *room = malloc((RINGS + 1) * 2 * n * sizeof *room);
    enum kd_status status;
    memset(part, 0, 2 * bins * n * sizeof *part);
    memset(coarse, 0, 2 * bins * n * sizeof *coarse);
    *echo = (struct kd_echo) { .error = NAN };
    KD_TRY(make_view(image, params, &view, echo, error));
    if (!room)
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for %zu frequencies", n));
    for (size_t i = 0; i <= RINGS; i++) {
        beats[i].of = room + i * 2 * n;
        if (kd_pause())
            KD_TRY(kd_error_set(error, KD_ECANCELLED, "the computation of the echo was cancelled"));
        fill_beat(&view, i, frequencies, n, &beats[i]);
    }
    for (int skip = 1; skip <= 2; skip++) {
        struct transform t = { edges, frequencies, bins, n, 0, skip == 1 ? part : coarse };
        transform_all(&view, beats, echo->direct.time, skip, &t);
        for (size_t i = 0; i < 2 * bins * n; i++)
            t.out[i] /= t.total;
        if (skip == 1)
            describe(params, t.total, echo);
    }
done:
    finish(&view);
    free(room);
    return status;
}
