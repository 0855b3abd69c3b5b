#include "render/view/rim_grid.h"

#include "base/parallel.h"
#include "render/view/sky_ray.h"

#include "interface.h"

#include <math.h>
#include <string.h>

/* The rim is sampled in cells: ROUND along the curve, ACROSS away from it. u is the turn along the curve, l the
 * logarithm of the relative distance from it (rim.h). */
enum { ROUND = 64, ACROSS = 20 };

#define OVERHEAD 1000.0 /* fixed cost of a grid, as a number of rays */
#define LONGEST_L 0.5   /* largest step of l from row to row */
#define NUDGE 1e-4
#define SLOW 0.6   /* a rim whose `winds` is less than this, in rad, is measured in every second cell only */
#define BESIDE 0.2 /* fraction of a cell's size by which the cell may extend beyond its corners in the picture */
#define FEW 6.0    /* the grids of a rim whose `winds` is less than this, in rad, never exceed the limit of rays */
#define SPREAD 4.0 /* an image up to this many pixels outside the picture may light some of it */

/* by_u, by_l: shift of the sky per unit of u and of l. most_u, most_l: largest values of by_u and by_l in this cell and
 * half way to its neighbours. shown: solid angle of the sky that a pixel shows, sr. */
struct cell {
    double by_u, by_l, most_u, most_l, shown;
    bool in_picture, wanted;
};
/* Cells u0 ... u1 - 1, l0 ... l1 - 1. */
struct part { int u0, u1, l0, l1; };

struct layout {
    const struct kd_rim *rim;
    struct kd_sky_rays rays;
    double first, du, dl; /* first: l at which the cells begin; du, dl: size of a cell */
    double step;
    struct cell of[ROUND][ACROSS];
    struct kd_rim_grids *out;
};

struct sample { double place[2], turn, drag, n[3]; };

static bool sample_at(const struct layout *o, double u, double l, struct sample *out)
{
    double look[3];
    struct kd_null_bend bend;
    kd_rim_place(o->rim, u, exp(l), out->place);
    kd_rim_look(o->rim, out->place, look);
    if (!kd_sky_ray_bend(&o->rays, look, &bend))
        return false;
    out->turn = bend.turn, out->drag = bend.drag;
    kd_null_bend_sky(&bend, o->rays.at.u, o->rays.at.s, out->n);
    return true;
}

static double solid_angle(const double n[3], const double a[3], const double b[3])
{
    const double i[] = { a[0] - n[0], a[1] - n[1], a[2] - n[2] }, j[] = { b[0] - n[0], b[1] - n[1], b[2] - n[2] };
    return fabs(n[0] * (i[1] * j[2] - i[2] * j[1]) + n[1] * (i[2] * j[0] - i[0] * j[2]) +
                n[2] * (i[0] * j[1] - i[1] * j[0]));
}

/* Measures a block of apart x apart cells by the ray in its middle and two rays next to it. */
static void measure(struct layout *o, int i, int j, int apart)
{
    const double u = (i + 0.5 * apart) * o->du, l = o->first - (j + 0.5 * apart) * o->dl;
    struct sample at, beside, below;
    if (!sample_at(o, u, l, &at) || !sample_at(o, u + NUDGE, l, &beside) || !sample_at(o, u, l - NUDGE, &below))
        return; /* skipped, because the ray does not escape; kd_rim_sky reports it */
    const double area = (beside.place[0] - at.place[0]) * (below.place[1] - at.place[1]) -
                        (beside.place[1] - at.place[1]) * (below.place[0] - at.place[0]);
    for (int k = 0; k < apart * apart; k++) {
        struct cell *cell = &o->of[i + k / apart][j + k % apart];
        cell->by_u = hypot(beside.turn - at.turn, beside.drag - at.drag) / NUDGE;
        cell->by_l = hypot(below.turn - at.turn, below.drag - at.drag) / NUDGE;
        cell->shown = solid_angle(at.n, beside.n, below.n) * o->rim->pixel * o->rim->pixel / fabs(area);
    }
}

/* Corners of cells, in the picture. */
struct corner {
    double x, y;
    bool seen;
};

static void see_corners(const struct layout *o, struct corner corners[ROUND + 1][ACROSS + 1])
{
    for (int i = 0; i <= ROUND; i++) {
        double point[2], place[2], look[3];
        kd_rim_place(o->rim, i * o->du, 0, point);
        for (int j = 0; j <= ACROSS; j++) {
            const double out = 1 + exp(o->first - j * o->dl);
            place[0] = out * point[0], place[1] = out * point[1];
            kd_rim_look(o->rim, place, look);
            corners[i][j].seen = kd_camera_seen(&o->rays.camera, look, &corners[i][j].x, &corners[i][j].y);
        }
    }
}

/* A rectangle of the picture, in rays. */
struct rectangle { double left, top, right, bottom; };

/* True if images in the cell with these corners may light some of the rectangle. spread: SPREAD, converted to rays. */
static bool may_light(const struct corner *c[4], const struct rectangle *r, double spread)
{
    double left = INFINITY, right = -INFINITY, top = INFINITY, bottom = -INFINITY;
    int seen = 0;
    for (int k = 0; k < 4; k++) {
        if (!c[k]->seen)
            continue;
        left = fmin(left, c[k]->x), right = fmax(right, c[k]->x), top = fmin(top, c[k]->y),
        bottom = fmax(bottom, c[k]->y);
        seen++;
    }
    const double more = spread + BESIDE * fmax(right - left, bottom - top);
    return seen && (seen < 4 || (right + more > r->left && left - more < r->right && bottom + more > r->top &&
                                 top - more < r->bottom));
}

static void set_most(struct layout *o, int i, int j)
{
    struct cell *own = &o->of[i][j];
    for (int k = 0; k < 9; k++) {
        const int l = j + k / 3 - 1;
        const struct cell *beside = l >= 0 && l < ACROSS ? &o->of[(i + k % 3 - 1 + ROUND) % ROUND][l] : own;
        own->most_u = fmax(own->most_u, 0.5 * (own->by_u + beside->by_u));
        own->most_l = fmax(own->most_l, 0.5 * (own->by_l + beside->by_l));
    }
}

/* True if one of these cells, or a neighbour of one, is in the picture. Neighbours count because choose_cells
 * averages over neighbours. */
static bool is_near_picture(const struct layout *o, int i, int j, int apart)
{
    for (int u = i - 1; u <= i + apart; u++)
        for (int l = j > 0 ? j - 1 : 0; l <= j + apart && l < ACROSS; l++)
            if (o->of[(u + ROUND) % ROUND][l].in_picture)
                return true;
    return false;
}

struct columns_of {
    struct layout *layout;
    int apart; /* side of the block of cells that one measurement represents */
};

static void measure_column(void *user, size_t item)
{
    const struct columns_of *c = user;
    const int i = (int)item * c->apart;
    for (int j = 0; j < ACROSS; j += c->apart)
        if (is_near_picture(c->layout, i, j, c->apart))
            measure(c->layout, i, j, c->apart);
}

static void look_at_cells(struct layout *o, const struct kd_scene *scene)
{
    struct corner corners[ROUND + 1][ACROSS + 1];
    const double side = kd_scene_side(scene);
    const struct rectangle picture = { 0, 0, side * scene->image.width, side * scene->image.height };
    see_corners(o, corners);
    for (int i = 0; i < ROUND; i++)
        for (int j = 0; j < ACROSS; j++) {
            const struct corner *c[] = { &corners[i][j], &corners[i + 1][j], &corners[i][j + 1],
                                         &corners[i + 1][j + 1] };
            o->of[i][j] = (struct cell) { .in_picture = may_light(c, &picture, SPREAD) };
        }
    /* a rim that winds slowly is measured in blocks of 2 x 2 cells */
    struct columns_of columns = { o, o->rim->winds < SLOW ? 2 : 1 };
    kd_parallel((size_t)(ROUND / columns.apart), measure_column, &columns);
    for (int k = 0; k < ROUND * ACROSS; k++)
        set_most(o, k / ACROSS, k % ACROSS);
}

/* The mean of nine cells decides, because on caustics a pixel shows no solid angle. */
static void choose_cells(struct layout *o, double faintest)
{
    for (int i = 0; i < ROUND; i++)
        for (int j = 0; j < ACROSS; j++) {
            double sum = 0;
            int n = 0;
            for (int k = 0; k < 9; k++) {
                const int there = j + k / 3 - 1;
                if (there < 0 || there >= ACROSS)
                    continue;
                sum += o->of[(i + k % 3 - 1 + ROUND) % ROUND][there].shown;
                n++;
            }
            o->of[i][j].wanted = o->of[i][j].in_picture && sum < faintest * n;
        }
}

/* Shrinks a part to the cells that are wanted. Returns false if no cell is wanted. */
static bool tighten(const struct layout *o, struct part *p)
{
    struct part t = { ROUND, 0, ACROSS, 0 };
    for (int i = p->u0; i < p->u1; i++)
        for (int j = p->l0; j < p->l1; j++)
            if (o->of[i][j].wanted) {
                t.u0 = i < t.u0 ? i : t.u0, t.u1 = i + 1;
                t.l0 = j < t.l0 ? j : t.l0, t.l1 = j + 1 > t.l1 ? j + 1 : t.l1;
            }
    *p = t;
    return t.u1 > 0;
}

/* Images with a share in the light lie from `low` to `high` along an axis, counted in rays. Returns the range of whole
 * tiles of the star search that contains the rays which find them. A ray finds images up to KD_RIM_REACH from it. */
static struct kd_rim_span shared_span(double low, double high, uint32_t rays)
{
    const double tile = KD_RIM_TILE_RAYS, first = floor(floor(low - KD_RIM_REACH + 1) / tile) * tile,
                 end = ceil(high + KD_RIM_REACH);
    return (struct kd_rim_span) { (uint32_t)fmax(first, 0), end < rays ? (uint32_t)end : rays };
}

static struct kd_rim_grid grid_of(const struct layout *o, const struct part *p)
{
    double by_u = 0, by_l = 0;
    for (int i = p->u0; i < p->u1; i++)
        for (int j = p->l0; j < p->l1; j++)
            if (o->of[i][j].wanted)
                by_u = fmax(by_u, o->of[i][j].most_u), by_l = fmax(by_l, o->of[i][j].most_l);
    struct kd_rim_grid g = {
        .du = fmin(o->step / by_u, 1),
        .dl = fmin(o->step / by_l, LONGEST_L),
        .low_u = p->u0 * o->du,
        .high_u = p->u1 * o->du,
        .high_l = p->l0 ? o->first - p->l0 * o->dl : INFINITY,
        .low_l = p->l1 < ACROSS ? o->first - p->l1 * o->dl : -INFINITY,
    };
    const double columns = ceil((g.high_u - g.low_u + 2 * KD_RIM_SHARED_U) / g.du) + 2 * KD_RIM_HALO + 1;
    const double rows = ceil(((p->l1 - p->l0) * o->dl + 2 * KD_RIM_SHARED_L) / g.dl) + 2 * KD_RIM_HALO + 1;
    g.u = g.low_u - KD_RIM_SHARED_U - KD_RIM_HALO * g.du;
    g.l = o->first - p->l0 * o->dl + KD_RIM_SHARED_L + KD_RIM_HALO * g.dl;
    g.columns = (uint32_t)fmin(columns, 1e4), g.rows = (uint32_t)fmin(rows, 1e4);
    g.x[0] = shared_span(KD_RIM_HALO, (g.high_u + KD_RIM_SHARED_U - g.u) / g.du, g.columns);
    const double above = fmin(g.high_l + KD_RIM_SHARED_L, o->first), below = g.low_l - KD_RIM_SHARED_L;
    g.y = shared_span((g.l - above) / g.dl, (g.l - below) / g.dl, g.rows);
    return g;
}

static double cost(const struct layout *o, const struct part *p)
{
    const struct kd_rim_grid g = grid_of(o, p);
    const double rays = (double)g.columns * g.rows;
    return OVERHEAD + rays + (rays > KD_RIM_GRID_RAYS ? 1e3 * rays : 0);
}

static double cost_of(const struct layout *o, struct part halves[2])
{
    double sum = 0;
    for (int k = 0; k < 2; k++)
        sum += tighten(o, &halves[k]) ? cost(o, &halves[k]) : 0;
    return sum;
}

/* Finds the best cut of a part in two. Returns false if no cut lowers the cost by a twentieth or more. */
static bool cut(const struct layout *o, const struct part *p, struct part best[2])
{
    double least = 0.95 * cost(o, p);
    bool found = false;
    for (int k = 1; k < p->u1 - p->u0 + p->l1 - p->l0 - 1; k++) {
        struct part halves[] = { *p, *p };
        if (k < p->u1 - p->u0)
            halves[0].u1 = halves[1].u0 = p->u0 + k;
        else
            halves[0].l1 = halves[1].l0 = p->l0 + k - (p->u1 - p->u0 - 1);
        const double is = cost_of(o, halves);
        if (is < least) {
            least = is;
            memcpy(best, halves, sizeof halves);
            found = true;
        }
    }
    return found;
}

static void divide(const struct layout *o, struct part p)
{
    struct part halves[2];
    if (!tighten(o, &p))
        return;
    if (cut(o, &p, halves)) {
        divide(o, halves[0]);
        divide(o, halves[1]);
        return;
    }
    const struct kd_rim_grid g = grid_of(o, &p);
    /* a part whose grid exceeds the limit counts as more rays than are permitted */
    o->out->rays += kd_rim_grid_rays(&g) <= KD_RIM_GRID_RAYS ? kd_rim_grid_rays(&g) : KD_RIM_RAYS + 1;
    if (o->out->n < KD_RIM_GRIDS)
        o->out->of[o->out->n] = g;
    o->out->n++;
}

/* Tries several initial divisions, because a single cut may gain nothing. */
static void divide_all(struct layout *o)
{
    double least = INFINITY;
    int best = 1;
    for (int last = 0; last < 2; last++)
        for (int pieces = last ? best : 1; pieces <= (last ? best : 8); pieces *= 2) {
            o->out->n = o->out->rays = 0;
            for (int k = 0; k < pieces; k++)
                divide(o, (struct part) { k * ROUND / pieces, (k + 1) * ROUND / pieces, 0, ACROSS });
            const double all = o->out->rays + OVERHEAD * o->out->n;
            if (all < least)
                least = all, best = pieces;
        }
}

static uint32_t aligned(uint32_t number) { return (number + KD_RIM_ALIGN - 1) / KD_RIM_ALIGN * KD_RIM_ALIGN; }

static void set_places(struct kd_rim_grids *o)
{
    uint32_t at = KD_RIM_EDGES;
    for (uint32_t i = 0; i < o->n; i++) {
        struct kd_rim_grid *g = &o->of[i];
        g->first = aligned(at);
        g->table = g->first + 3 * kd_rim_grid_rays(g);
        at = g->table + KD_RIM_TABLE + 4 * g->columns;
    }
    o->numbers = aligned(at);
}

static bool fits(const struct kd_rim_grids *o) { return o->n <= KD_RIM_GRIDS && o->rays <= KD_RIM_RAYS; }

static void begin(struct layout *o, const struct kd_scene *scene, const struct kd_rim *rim, struct kd_rim_grids *out)
{
    *o = (struct layout) { .rim = rim,
                           .rays = kd_sky_rays_of(scene),
                           .first = log(rim->none),
                           .du = (double)KD_RIM_ANGLES / ROUND,
                           .out = out };
    o->dl = (o->first - log(rim->last)) / ACROSS;
    look_at_cells(o, scene);
}

static bool fit(struct layout *o)
{
    o->step = o->out->step;
    choose_cells(o, o->out->faintest);
    divide_all(o);
    return fits(o->out);
}

bool kd_rim_is_thinned(const struct kd_scene *scene, const struct kd_rim *rim)
{
    struct kd_rim_grids coarsest = { .step = KD_RIM_STEP_MOST, .faintest = KD_RIM_FAINTEST };
    struct layout o;
    if (!rim->there || rim->winds < FEW)
        return false;
    begin(&o, scene, rim, &coarsest);
    return !fit(&o);
}

void kd_rim_grids_of(const struct kd_scene *scene, const struct kd_rim *rim, struct kd_rim_grids *out)
{
    struct layout o;
    *out = (struct kd_rim_grids) { .step = KD_RIM_STEP, .faintest = KD_RIM_FAINTEST, .numbers = KD_RIM_EDGES };
    if (!rim->there)
        return;
    begin(&o, scene, rim, out);
    while (!fit(&o)) {
        if (out->step < KD_RIM_STEP_MOST)
            out->step = fmin(1.1 * out->step, KD_RIM_STEP_MOST);
        else
            out->faintest *= 0.7;
    }
    set_places(out);
}

/* Corners of ACROSS cells along one line of constant u, from l to l + high. */
static void see_line(const struct kd_rim *rim, const struct kd_camera_exact *camera, double u, double l, double high,
                     struct corner line[ACROSS + 1])
{
    double point[2], look[3];
    kd_rim_place(rim, u, 0, point);
    for (int j = 0; j <= ACROSS; j++) {
        const double out = 1 + exp(l + high * j / ACROSS), place[] = { out * point[0], out * point[1] };
        kd_rim_look(rim, place, look);
        line[j].seen = kd_camera_seen(camera, look, &line[j].x, &line[j].y);
    }
}

/* The least range of whole tiles of the star search that contains the rays from `low` to `high`. */
static struct kd_rim_span span_of(double low, double high, uint32_t rays)
{
    const double tile = KD_RIM_TILE_RAYS, first = floor(fmax(low - 1, 0) / tile) * tile;
    return (struct kd_rim_span) { (uint32_t)first,
                                  (uint32_t)fmin(first + ceil((high + 2 - first) / tile) * tile, rays) };
}

/* Sets the columns to be searched to the lit ones. They are one range, or two ranges on both sides of the largest
 * gap. Two ranges occur if a grid goes all round the curve, because both ends of the grid may be in the picture. */
static void set_columns(struct kd_rim_grid *g, const bool lit[], int columns, double from, double wide)
{
    int left = 0, right = columns, gap = 0, gap_end = 0;
    while (!lit[left])
        left++;
    while (!lit[right - 1])
        right--;
    for (int i = left, dark = 0; i < right; i++) {
        dark = lit[i] ? 0 : dark + 1;
        if (dark > gap)
            gap = dark, gap_end = i + 1;
    }
    const double by = wide / columns / g->du, at = (from - g->u) / g->du;
    g->x[0] = span_of(at + by * left, at + by * right, g->columns);
    if (!gap)
        return;
    const struct kd_rim_span a = span_of(at + by * left, at + by * (gap_end - gap), g->columns),
                             b = span_of(at + by * gap_end, at + by * right, g->columns);
    if (a.end < b.first)
        g->x[0] = a, g->x[1] = b;
}

/* Sets the ranges of the grid's rays whose images may light some of the rectangle. Returns false if there are no such
 * rays. */
static bool set_spans(const struct kd_rim *rim, const struct kd_camera_exact *camera, const struct rectangle *r,
                      double spread, struct kd_rim_grid *g)
{
    const double outermost = log(rim->none), innermost = log(rim->last);
    const double u = g->low_u - KD_RIM_SHARED_U, wide = g->high_u + KD_RIM_SHARED_U - u;
    const double l = fmax(g->low_l - KD_RIM_SHARED_L, innermost),
                 high = fmin(g->high_l + KD_RIM_SHARED_L, outermost) - l;
    const int columns = (int)ceil(wide * ROUND / KD_RIM_ANGLES); /* at most ROUND + 1 */
    int low = ACROSS, up = 0;
    bool lit[ROUND + 1] = { false };
    struct corner lines[2][ACROSS + 1];
    see_line(rim, camera, u, l, high, lines[0]);
    for (int i = 0; i < columns; i++) {
        const struct corner *a = lines[i % 2], *b = lines[(i + 1) % 2];
        see_line(rim, camera, u + wide * (i + 1) / columns, l, high, lines[(i + 1) % 2]);
        for (int j = 0; j < ACROSS; j++)
            if (may_light((const struct corner *[]) { &a[j], &a[j + 1], &b[j], &b[j + 1] }, r, spread)) {
                lit[i] = true;
                low = j < low ? j : low, up = j + 1 > up ? j + 1 : up;
            }
    }
    if (!up)
        return false;
    set_columns(g, lit, columns, u, wide);
    g->y = span_of((g->l - l - high * up / ACROSS) / g->dl, (g->l - l - high * low / ACROSS) / g->dl, g->rows);
    return true;
}

/* True if light from beyond an edge of the picture may reach a tile. The map of an equirectangular picture continues
 * from the right edge to the left one, and over the poles (shaders/ray/around.glsl). */
static bool comes_around(const struct kd_camera_exact *c, const struct rectangle *tile, const struct rectangle *picture,
                         double spread)
{
    return c->sight == KD_SIGHT_SPHERE && (tile->left < spread || tile->right > picture->right - spread ||
                                           tile->top < spread || tile->bottom > picture->bottom - spread);
}

void kd_rim_grids_keep(const struct kd_scene *scene, const struct kd_rim *rim, struct kd_rim_grids *grids)
{
    const struct kd_sky_rays rays = kd_sky_rays_of(scene);
    const struct kd_window w = kd_scene_window(scene);
    const double side = kd_scene_side(scene);
    const struct rectangle tile = { side * w.left, side * w.top, side * ((double)w.left + w.width),
                                    side * ((double)w.top + w.height) };
    uint32_t n = 0;
    const struct rectangle picture = { 0, 0, side * scene->image.width, side * scene->image.height };
    if (comes_around(&rays.camera, &tile, &picture, SPREAD * side))
        return;
    grids->rays = 0;
    for (uint32_t i = 0; i < grids->n; i++)
        if (set_spans(rim, &rays.camera, &tile, SPREAD * side, &grids->of[i])) {
            grids->of[n] = grids->of[i];
            grids->rays += kd_rim_grid_rays(&grids->of[n++]);
        }
    grids->n = n;
    set_places(grids);
}
