#include "render/view/rim_sky.h"

#include "base/parallel.h"
#include "render/view/sky_ray.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum {
    LEAST = 9, /* least number of intervals along a side of a grid */
    MOST = 96,
    ASIDE = 4, /* number of lines across the grid on which a number of intervals is tried */
    /* if there are at most this many grids, all threads work on one grid at a time. If there are more, each thread
     * takes whole grids */
    SHARED = 4
};

/* A ray has four angles: turn, drag, t_theta, t_phi. */
enum { ANGLES = 4 };
struct angles { double of[ANGLES]; };

struct follower {
    const struct kd_rim *rim;
    struct kd_sky_rays rays;
    bool alone; /* true if only one thread fills this grid, because other threads fill other grids */
};

static void run_each(const struct follower *f, size_t n, void (*each)(void *user, size_t item), void *user)
{
    if (!f->alone) {
        kd_parallel(n, each, user);
        return;
    }
    for (size_t item = 0; item < n; item++)
        each(user, item);
}

static bool follow(const struct follower *f, double u, double l, struct angles *out)
{
    struct kd_null_bend bend;
    double place[2], look[3];
    kd_rim_place(f->rim, u, exp(l), place);
    kd_rim_look(f->rim, place, look);
    const bool escapes = kd_sky_ray_bend(&f->rays, look, &bend);
    *out = (struct angles) { { bend.turn, bend.drag, bend.t_theta, bend.t_phi } };
    return escapes;
}

static void direction(const struct follower *f, const struct angles *a, double out[3])
{
    const double length = sqrt(a->of[2] * a->of[2] + a->of[3] * a->of[3]);
    const struct kd_null_bend bend = { a->of[0], a->of[1], a->of[2] / length, a->of[3] / length };
    kd_null_bend_sky(&bend, f->rays.at.u, f->rays.at.s, out);
}

static double apart(const struct angles *a, const struct angles *b)
{
    double most = 0;
    for (int i = 0; i < ANGLES; i++)
        most = fmax(most, fabs(a->of[i] - b->of[i]));
    return most;
}

/* A side of a grid from its first ray to its last, with the extrema of a polynomial on it. */
struct side {
    double from, to;
    int n;
};

/* The place of extremum j, and its barycentric weight: J.-P. Berrut & L. N. Trefethen 2004, SIAM Rev. 46, 501, eqs.
 * 4.2, 5.4. */
static double place_of(const struct side *s, int n, int j)
{
    return 0.5 * (s->from + s->to) + 0.5 * (s->from - s->to) * cos(M_PI * j / n);
}

static void weights(const struct side *s, int n, double place, double w[MOST + 1])
{
    double sum = 0;
    for (int j = 0; j <= n; j++) {
        const double off = place - place_of(s, n, j);
        if (fabs(off) < 1e-12) {
            memset(w, 0, (size_t)(n + 1) * sizeof *w);
            w[j] = 1;
            return;
        }
        w[j] = (j & 1 ? -1 : 1) * (j == 0 || j == n ? 0.5 : 1) / off;
        sum += w[j];
    }
    for (int j = 0; j <= n; j++)
        w[j] /= sum;
}

static struct side side_of(const struct kd_rim_grid *g, bool along_u)
{
    return along_u ? (struct side) { g->u, g->u + (g->columns - 1) * g->du, 0 }
                   : (struct side) { g->l, g->l - (g->rows - 1) * g->dl, 0 };
}

/* Follows the ray at u = place and l = line if along_u is true, otherwise at l = place and u = line. */
static bool follow_on(const struct follower *f, bool along_u, double place, double line, struct angles *out)
{
    return along_u ? follow(f, place, line, out) : follow(f, line, place, out);
}

/* Tests whether n intervals are accurate enough along a line. Returns 1 if so, 0 if not, and -1 if a ray does not
 * escape. */
static int serves(const struct follower *f, const struct side *s, int n, bool along_u, double line)
{
    struct angles at[MOST + 1], want;
    double w[MOST + 1];
    for (int j = 0; j <= n; j++)
        if (!follow_on(f, along_u, place_of(s, n, j), line, &at[j]))
            return -1;
    for (int p = 1; p < 2 * n; p += n > 8 ? 4 : 2) {
        struct angles sum = { { 0 } };
        const double place = place_of(s, 2 * n, p);
        weights(s, n, place, w);
        for (int j = 0; j <= n; j++)
            for (int q = 0; q < ANGLES; q++)
                sum.of[q] += w[j] * at[j].of[q];
        if (!follow_on(f, along_u, place, line, &want))
            return -1;
        /* the bound is stricter than KD_RIM_EXACT, because errors are larger between the lines, and larger for images
         * next to a caustic */
        if (apart(&sum, &want) > 0.1 * KD_RIM_EXACT)
            return 0;
    }
    return 1;
}

/* A test of one number of intervals, on lines across a side. */
struct trial {
    const struct follower *f;
    const struct side *side, *other;
    bool along_u;
    int serves[ASIDE];
};

static void try_line(void *user, size_t k)
{
    struct trial *t = user;
    const double line = t->other->to + (t->other->from - t->other->to) * (double)k / (ASIDE - 1);
    t->serves[k] = serves(t->f, t->side, t->side->n, t->along_u, line);
}

/* Finds how many intervals are enough along one side. Tests this on lines at both ends of the other side and between
 * its ends. If even MOST intervals are too few, the result exceeds MOST. Returns false if a ray does not escape. */
static bool enough(const struct follower *f, struct side *s, const struct side *other, bool along_u)
{
    struct trial trial = { .f = f, .side = s, .other = other, .along_u = along_u };
    for (s->n = LEAST; s->n <= MOST; s->n += s->n / 2) {
        int least = 1;
        run_each(f, ASIDE, try_line, &trial);
        for (int k = 0; k < ASIDE && least > 0; k++)
            least = trial.serves[k];
        if (least)
            return least > 0;
    }
    return true;
}

struct sheet {
    const struct follower *f;
    const struct kd_rim_grid *grid;
    struct side u, l;
    struct angles at[MOST + 1][MOST + 1]; /* rows of l */
    double *columns;                      /* values by row and angle, for all columns */
    float *out;
    _Atomic bool escapes; /* true if every ray of the sheet escapes */
};

static void follow_line(void *user, size_t j)
{
    struct sheet *o = user;
    for (int i = 0; i <= o->u.n; i++)
        if (!follow(o->f, place_of(&o->u, o->u.n, i), place_of(&o->l, o->l.n, (int)j), &o->at[j][i]))
            atomic_store(&o->escapes, false);
}

static bool follow_sheet(struct sheet *o)
{
    o->u = side_of(o->grid, true);
    o->l = side_of(o->grid, false);
    if (!enough(o->f, &o->u, &o->l, true) || !enough(o->f, &o->l, &o->u, false))
        return false;
    if (o->u.n <= MOST && o->l.n <= MOST)
        run_each(o->f, (size_t)o->l.n + 1, follow_line, o);
    return atomic_load(&o->escapes);
}

static double *column_at(const struct sheet *o, int j, int q)
{
    return o->columns + ((size_t)j * ANGLES + (size_t)q) * o->grid->columns;
}

static void fill_columns(struct sheet *o)
{
    double w[MOST + 1];
    for (uint32_t k = 0; k < o->grid->columns; k++) {
        weights(&o->u, o->u.n, o->grid->u + k * o->grid->du, w);
        for (int j = 0; j <= o->l.n; j++)
            for (int q = 0; q < ANGLES; q++) {
                double sum = 0;
                for (int i = 0; i <= o->u.n; i++)
                    sum += w[i] * o->at[j][i].of[q];
                column_at(o, j, q)[k] = sum;
            }
    }
}

enum { STRIP = 64 }; /* number of columns whose sums fit on the stack */

static void fill_strip(const struct sheet *o, uint32_t row, const double *w, size_t first, size_t n)
{
    const size_t rays = kd_rim_grid_rays(o->grid), at = row * (size_t)o->grid->columns + first;
    double sums[ANGLES][STRIP] = { { 0 } };
    for (int j = 0; j <= o->l.n; j++)
        for (int q = 0; q < ANGLES; q++) {
            const double *from = column_at(o, j, q) + first;
            for (size_t k = 0; k < n; k++)
                sums[q][k] += w[j] * from[k];
        }
    for (size_t k = 0; k < n; k++) {
        const struct angles a = { { sums[0][k], sums[1][k], sums[2][k], sums[3][k] } };
        double d[3];
        direction(o->f, &a, d);
        for (size_t i = 0; i < 3; i++)
            o->out[i * rays + at + k] = (float)d[i];
    }
}

static void fill_row(void *user, size_t row)
{
    const struct sheet *o = user;
    double w[MOST + 1];
    weights(&o->l, o->l.n, o->grid->l - (double)row * o->grid->dl, w);
    for (size_t first = 0; first < o->grid->columns; first += STRIP) {
        const size_t left = o->grid->columns - first;
        fill_strip(o, (uint32_t)row, w, first, left < STRIP ? left : STRIP);
    }
}

/* Follows each ray of a row by itself, where no polynomial of MOST intervals is accurate enough; 10 us a ray. */
static void follow_row(void *user, size_t row)
{
    struct sheet *o = user;
    const struct kd_rim_grid *g = o->grid;
    const size_t rays = kd_rim_grid_rays(g);
    for (size_t k = 0; k < g->columns; k++) {
        struct angles a;
        double d[3];
        if (!follow(o->f, g->u + (double)k * g->du, g->l - (double)row * g->dl, &a)) {
            atomic_store(&o->escapes, false);
            return;
        }
        direction(o->f, &a, d);
        for (size_t i = 0; i < 3; i++)
            o->out[i * rays + row * g->columns + k] = (float)d[i];
    }
}

static bool fill_rays(struct sheet *o)
{
    if (!follow_sheet(o))
        return false;
    const bool each = o->u.n > MOST || o->l.n > MOST;
    if (!each)
        fill_columns(o);
    run_each(o->f, o->grid->rows, each ? follow_row : fill_row, o);
    return atomic_load(&o->escapes);
}

/* Border of a grid's part in its own columns or rows; far away if the border is infinite. */
static float border(double at, double from, double by)
{
    return isfinite(at) ? (float)((at - from) / by) : at > 0 ? -1e6f : 1e6f;
}

static void fill_table(const struct kd_rim *rim, const struct kd_rim_grid *g, float *out)
{
    const float part[] = { border(g->low_u, g->u, g->du),          border(g->high_u, g->u, g->du),
                           (float)(g->du / (2 * KD_RIM_SHARED_U)), border(g->high_l, g->l, -g->dl),
                           border(g->low_l, g->l, -g->dl),         (float)(g->dl / (2 * KD_RIM_SHARED_L)) };
    _Static_assert(sizeof part == KD_RIM_TABLE * sizeof *out, "as rim_grid.h says");
    memcpy(out, part, sizeof part);
    for (uint32_t k = 0; k < g->columns; k++) {
        const double u = g->u + k * g->du, h = 0.1 * g->du;
        double at[2], before[2], after[2];
        kd_rim_place(rim, u, 0, at);
        kd_rim_place(rim, u - h, 0, before);
        kd_rim_place(rim, u + h, 0, after);
        for (size_t i = 0; i < 2; i++) {
            out[KD_RIM_TABLE + 4 * k + i] = (float)at[i];
            out[KD_RIM_TABLE + 4 * k + 2 + i] = (float)((after[i] - before[i]) / 0.2);
        }
    }
}

/* State shared by the threads that fill the grids. */
struct fill {
    struct follower f;
    const struct kd_rim_grids *grids;
    float *out;
    _Atomic int status; /* error of the first grid that failed: KD_ENOMEM or KD_EINVAL */
};

static void fill_grid(void *user, size_t i)
{
    struct fill *fill = user;
    const struct kd_rim_grid *g = &fill->grids->of[i];
    struct sheet *sheet = malloc(sizeof *sheet);
    double *columns = malloc(sizeof *columns * (MOST + 1) * ANGLES * g->columns);
    int none = KD_OK;
    if (!sheet || !columns)
        atomic_compare_exchange_strong(&fill->status, &none, KD_ENOMEM);
    else {
        sheet->f = &fill->f;
        sheet->grid = g;
        sheet->columns = columns;
        sheet->out = fill->out + g->first;
        atomic_init(&sheet->escapes, true);
        if (!fill_rays(sheet))
            atomic_compare_exchange_strong(&fill->status, &none, KD_EINVAL);
        fill_table(fill->f.rim, g, fill->out + g->table);
    }
    free(columns);
    free(sheet);
}

enum kd_status kd_rim_sky(const struct kd_scene *scene, const struct kd_rim *rim, const struct kd_rim_grids *grids,
                          float *out, struct kd_error *error)
{
    /* true if threads take whole grids; otherwise threads share the rows of one grid */
    const bool many = grids->n > SHARED;
    struct fill fill = { .f = { rim, kd_sky_rays_of(scene), many }, .grids = grids, .out = out, .status = KD_OK };
    memset(out, 0, grids->numbers * sizeof *out);
    memcpy(out, rim->edge, sizeof rim->edge);
    if (many)
        kd_parallel(grids->n, fill_grid, &fill);
    for (size_t i = 0; !many && i < grids->n; i++)
        fill_grid(&fill, i);
    switch (atomic_load(&fill.status)) {
    case KD_OK: return KD_OK;
    case KD_ENOMEM: return kd_error_set(error, KD_ENOMEM, "out of memory for rays next to the critical curve");
    default:
        return kd_error_field(error, "/camera",
                              "images of stars cannot be computed at this camera position, because a ray close to the "
                              "critical curve does not escape");
    }
}

bool kd_rim_sky_at(const struct kd_scene *scene, const struct kd_rim *rim, double u, double off, double out[3])
{
    const struct follower f = { rim, kd_sky_rays_of(scene), true };
    struct angles a;
    if (!follow(&f, u, log(off), &a))
        return false;
    direction(&f, &a, out);
    return true;
}
