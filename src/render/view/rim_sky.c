#include "render/view/rim_sky.h"

#include "render/view/sky_ray.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOST = 96,
    LEAST = 9,
    ASIDE = 4
}; /* intervals along a side of a grid; lines across it, on which so many are tried */

/* A ray has four angles: turn, drag, t_theta, t_phi. */
enum { ANGLES = 4 };
struct angles { double of[ANGLES]; };

struct follower {
    const struct kd_rim *rim;
    struct kd_sky_rays rays;
};

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

/* A side of a grid, from its first ray to its last one, and extrema of a polynomial there. */
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

/* The ray at a place of one side, on the line at a place of the other. */
static bool follow_on(const struct follower *f, bool along_u, double place, double line, struct angles *out)
{
    return along_u ? follow(f, place, line, out) : follow(f, line, place, out);
}

/* Whether n intervals are enough along a line; -1: rays do not escape. */
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
        if (apart(&sum, &want) >
            0.1 * KD_RIM_EXACT) /* between the lines it is more, and images next to a caustic are as exact as this */
            return 0;
    }
    return 1;
}

/* How many intervals are enough along one side, by lines at both ends and in the middle of the other; more than
 * MOST: not even that. False: a ray does not escape. */
static bool enough(const struct follower *f, struct side *s, const struct side *other, bool along_u)
{
    for (s->n = LEAST; s->n <= MOST; s->n += s->n / 2) {
        int least = 1;
        for (int k = 0; k < ASIDE && least > 0; k++) {
            const int is = serves(f, s, s->n, along_u, other->to + (other->from - other->to) * k / (ASIDE - 1));
            least = is < least ? is : least;
        }
        if (least)
            return least > 0;
    }
    return true;
}

struct sheet {
    struct side u, l;
    struct angles at[MOST + 1][MOST + 1]; /* rows of l */
    double *columns;                      /* by row and angle, of all columns */
};

static bool follow_sheet(const struct follower *f, const struct kd_rim_grid *g, struct sheet *o)
{
    o->u = side_of(g, true);
    o->l = side_of(g, false);
    if (!enough(f, &o->u, &o->l, true) || !enough(f, &o->l, &o->u, false))
        return false;
    if (o->u.n > MOST || o->l.n > MOST)
        return true;
    for (int j = 0; j <= o->l.n; j++)
        for (int i = 0; i <= o->u.n; i++)
            if (!follow(f, place_of(&o->u, o->u.n, i), place_of(&o->l, o->l.n, j), &o->at[j][i]))
                return false;
    return true;
}

static double *column_at(const struct sheet *o, const struct kd_rim_grid *g, int j, int q)
{
    return o->columns + ((size_t)j * ANGLES + (size_t)q) * g->columns;
}

static void fill_columns(struct sheet *o, const struct kd_rim_grid *g)
{
    double w[MOST + 1];
    for (uint32_t k = 0; k < g->columns; k++) {
        weights(&o->u, o->u.n, g->u + k * g->du, w);
        for (int j = 0; j <= o->l.n; j++)
            for (int q = 0; q < ANGLES; q++) {
                double sum = 0;
                for (int i = 0; i <= o->u.n; i++)
                    sum += w[i] * o->at[j][i].of[q];
                column_at(o, g, j, q)[k] = sum;
            }
    }
}

static void fill_row(const struct follower *f, const struct sheet *o, const struct kd_rim_grid *g, uint32_t row,
                     double *sums, float *out)
{
    const size_t rays = kd_rim_grid_rays(g), n = g->columns;
    double w[MOST + 1];
    weights(&o->l, o->l.n, g->l - row * g->dl, w);
    memset(sums, 0, ANGLES * n * sizeof *sums);
    for (int j = 0; j <= o->l.n; j++)
        for (int q = 0; q < ANGLES; q++) {
            const double *from = column_at(o, g, j, q);
            for (size_t k = 0; k < n; k++)
                sums[(size_t)q * n + k] += w[j] * from[k];
        }
    for (size_t k = 0; k < n; k++) {
        const struct angles a = { { sums[k], sums[n + k], sums[2 * n + k], sums[3 * n + k] } };
        double d[3];
        direction(f, &a, d);
        for (size_t i = 0; i < 3; i++)
            out[i * rays + row * n + k] = (float)d[i];
    }
}

/* Where no polynomial of MOST intervals is good enough: 10 us a ray. */
static bool follow_each(const struct follower *f, const struct kd_rim_grid *g, float *out)
{
    const uint32_t rays = kd_rim_grid_rays(g);
    for (uint32_t k = 0; k < rays; k++) {
        struct angles a;
        double d[3];
        if (!follow(f, g->u + k % g->columns * g->du, g->l - k / g->columns * g->dl, &a))
            return false;
        direction(f, &a, d);
        for (size_t i = 0; i < 3; i++)
            out[i * rays + k] = (float)d[i];
    }
    return true;
}

static bool fill_rays(const struct follower *f, const struct kd_rim_grid *g, struct sheet *sheet, float *out)
{
    if (!follow_sheet(f, g, sheet))
        return false;
    if (sheet->u.n > MOST || sheet->l.n > MOST)
        return follow_each(f, g, out);
    fill_columns(sheet, g);
    for (uint32_t row = 0; row < g->rows; row++)
        fill_row(f, sheet, g, row, sheet->columns + (size_t)(MOST + 1) * ANGLES * g->columns, out);
    return true;
}

/* Where a grid's part begins or ends, in its own columns or rows; far off where it does not. */
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

static uint32_t most_columns(const struct kd_rim_grids *grids)
{
    uint32_t most = 0;
    for (uint32_t i = 0; i < grids->n; i++)
        most = grids->of[i].columns > most ? grids->of[i].columns : most;
    return most;
}

enum kd_status kd_rim_sky(const struct kd_scene *scene, const struct kd_rim *rim, const struct kd_rim_grids *grids,
                          float *out, struct kd_error *error)
{
    const struct follower f = { rim, kd_sky_rays_of(scene) };
    struct sheet *sheet = malloc(sizeof *sheet);
    double *columns = malloc(sizeof *columns * (MOST + 2) * ANGLES * (most_columns(grids) + 1));
    enum kd_status status = KD_OK;
    if (!sheet || !columns)
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for rays next to the critical curve"));
    sheet->columns = columns;
    memset(out, 0, grids->numbers * sizeof *out);
    memcpy(out, rim->edge, sizeof rim->edge);
    for (uint32_t i = 0; i < grids->n; i++) {
        const struct kd_rim_grid *g = &grids->of[i];
        if (!fill_rays(&f, g, sheet, out + g->first))
            KD_TRY(kd_error_field(
                error, "/camera",
                "camera is where a ray next to the critical curve does not escape: no stars can be sought there"));
        fill_table(rim, g, out + g->table);
    }
done:
    free(columns);
    free(sheet);
    return status;
}

bool kd_rim_sky_at(const struct kd_scene *scene, const struct kd_rim *rim, double u, double off, double out[3])
{
    const struct follower f = { rim, kd_sky_rays_of(scene) };
    struct angles a;
    if (!follow(&f, u, log(off), &a))
        return false;
    direction(&f, &a, out);
    return true;
}
