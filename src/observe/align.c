#include "observe/align.h"

#include "base/pause.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STARTS = 3, SIMPLEX_STEPS = 90, SHIFT_CELLS = KD_ALIGN_SHIFTS / 2, NEWTON_STEPS = 30 };
#define SPREAD 1e-9 /* largest relative spread of chi^2 in a simplex at which the search ends */

struct search {
    const struct kd_comparison *c;
    const struct kd_align_params *p;
    double given_scale, longest; /* longest: largest u or v of the compared visibilities, in wavelengths */
    double (*model)[2];
    double *cell; /* values at the cells of the grid of shifts */
    struct kd_alignment best;
    double best_total;
};

void kd_align_shift(const struct kd_comparison *c, double east, double north, double (*model)[2])
{
    for (size_t i = 0; i < c->n && (east != 0 || north != 0); i++) {
        const double turns = c->at[i].u * east + c->at[i].v * north, angle = 2 * M_PI * (turns - rint(turns)),
                     re = model[i][0], im = model[i][1], cosine = cos(angle), sine = sin(angle);
        model[i][0] = re * cosine - im * sine, model[i][1] = re * sine + im * cosine;
    }
}

unsigned kd_align_evaluations(unsigned solve)
{
    const unsigned size = solve & KD_ALIGN_SIZE ? KD_ALIGN_SIZES : 1,
                   angle = solve & KD_ALIGN_ANGLE ? KD_ALIGN_ANGLES : 1;
    return size * angle == 1 ? 1 : size * angle + STARTS * 2 * SIMPLEX_STEPS + 1;
}

/* Agreement of a shifted model with the visibilities: its value, and its first and second derivatives along both axes.
 */
struct agreement { double value, slope[2], bend[3]; };

static struct agreement agree(const struct search *s, double east, double north)
{
    struct agreement a = { 0 };
    for (size_t i = 0; i + 1 < s->c->rows; i++) {
        const struct kd_comparison_row *row = &s->c->row[i];
        if (row->product != KD_PRODUCT_VISIBILITY || row->imaginary)
            continue;
        const struct kd_measured *at = &s->c->at[row->at[0]];
        const double *m = s->model[row->at[0]], weight = 1 / (row->error * row->error), im = row[1].data,
                     real = (row->data * m[0] + im * m[1]) * weight, cross = (row->data * m[1] - im * m[0]) * weight,
                     turns = at->u * east + at->v * north, angle = 2 * M_PI * (turns - rint(turns)),
                     value = real * cos(angle) - cross * sin(angle), slope = -real * sin(angle) - cross * cos(angle),
                     ku = 2 * M_PI * at->u, kv = 2 * M_PI * at->v;
        a.value += value;
        a.slope[0] += ku * slope, a.slope[1] += kv * slope;
        a.bend[0] -= ku * ku * value, a.bend[1] -= ku * kv * value, a.bend[2] -= kv * kv * value;
    }
    return a;
}

/* Computes the agreement at each cell of a grid of shifts. From one cell to the next, a phase turns by a constant
 * angle. */
static void fill_cells(const struct search *s, double cell, int cells)
{
    const int side = 2 * cells + 1;
    memset(s->cell, 0, sizeof(double) * (size_t)(side * side));
    for (size_t k = 0; k + 1 < s->c->rows; k++) {
        const struct kd_comparison_row *row = &s->c->row[k];
        if (row->product != KD_PRODUCT_VISIBILITY || row->imaginary)
            continue;
        const struct kd_measured *at = &s->c->at[row->at[0]];
        const double *m = s->model[row->at[0]], weight = 1 / (row->error * row->error), im = row[1].data,
                     real = (row->data * m[0] + im * m[1]) * weight, cross = (row->data * m[1] - im * m[0]) * weight,
                     turn = 2 * M_PI * at->u * cell, c = cos(turn), d = sin(turn);
        if (kd_pause())
            return;
        for (int j = -cells; j <= cells; j++) {
            const double start = 2 * M_PI * cell * (at->v * j - at->u * cells);
            double x = real * cos(start) - cross * sin(start), y = real * sin(start) + cross * cos(start);
            for (double *out = s->cell + (j + cells) * side, *end = out + side; out < end; out++) {
                const double next = x * c - y * d;
                *out += x, y = x * d + y * c, x = next;
            }
        }
    }
}

/* Finds the shift of the current model that gives the best agreement. It takes the best cell of a grid, whose spacing
 * is a quarter of the shortest fringe, and refines it by Newton's method. */
static bool find_shift(const struct search *s, double *east, double *north)
{
    const double cell = 0.25 / s->longest, most = fmin(s->p->most_shift, SHIFT_CELLS * cell);
    const int cells = (int)fmin(ceil(most / cell), SHIFT_CELLS), side = 2 * cells + 1;
    double best = -INFINITY;
    fill_cells(s, cell, cells);
    for (int i = 0; i < side * side; i++)
        if (s->cell[i] > best)
            best = s->cell[i], *east = (i % side - cells) * cell, *north = (i / side - cells) * cell;
    for (int i = 0; i < NEWTON_STEPS; i++) {
        const struct agreement a = agree(s, *east, *north);
        const double determinant = a.bend[0] * a.bend[2] - a.bend[1] * a.bend[1];
        if (!(determinant > 0) || !(a.bend[0] < 0)) /* gives up, because there is no maximum near this place */
            return false;
        const double x = (a.bend[2] * a.slope[0] - a.bend[1] * a.slope[1]) / determinant,
                     y = (a.bend[0] * a.slope[1] - a.bend[1] * a.slope[0]) / determinant;
        *east -= x, *north -= y;
        if (hypot(x, y) < 1e-6 * cell)
            return fabs(*east) < most && fabs(*north) < most;
        if (fabs(*east) > most + cell || fabs(*north) > most + cell)
            return false;
    }
    return false;
}

static double clamp_size(double log_size)
{
    return exp(fmin(fmax(log_size, log(KD_ALIGN_LEAST_SIZE)), log(KD_ALIGN_MOST_SIZE)));
}

/* Computes chi^2 for a size and an angle, and stores them if chi^2 is the least so far. at: logarithm of the size;
 * angle in degrees. */
static double try_at(struct search *s, const double at[2])
{
    struct kd_alignment here = KD_ALIGNMENT_NONE;
    here.size = clamp_size(at[0]), here.angle_deg = at[1], here.scale = s->given_scale;
    s->p->model(s->p->user, here.size, here.angle_deg, s->model);
    if (s->p->solve & KD_ALIGN_SHIFT) {
        here.converged[3] = find_shift(s, &here.east, &here.north);
        kd_align_shift(s->c, here.east, here.north, s->model);
    }
    if (s->p->solve & KD_ALIGN_FLUX)
        here.scale = kd_comparison_scale(s->c, (const double (*)[2])s->model);
    here.converged[0] = isfinite(here.scale) && here.scale > 0;
    const double total = kd_comparison_total(s->c, (const double (*)[2])s->model, here.converged[0] ? here.scale : 1);
    here.evaluations = s->best.evaluations + 1;
    s->best.evaluations++;
    if (total < s->best_total)
        s->best_total = total, s->best = here;
    return isfinite(total) ? total : INFINITY;
}

static int by_value(const void *a, const void *b)
{
    const double x = ((const struct kd_align_vertex *)a)->value, y = ((const struct kd_align_vertex *)b)->value;
    return x < y ? -1 : x > y;
}

/* Point on the line from the worst vertex through the centre of the others. along: position on this line; -1 is the
 * mirror image of the worst vertex. */
static struct kd_align_vertex on_line(struct search *s, const struct kd_align_vertex *v, int n, double along)
{
    struct kd_align_vertex out = { 0 };
    for (int k = 0; k < 2; k++) {
        double centre = 0;
        for (int i = 0; i < n; i++)
            centre += v[i].at[k] / n;
        out.at[k] = centre + along * (v[n].at[k] - centre);
    }
    out.value = try_at(s, out.at);
    return out;
}

/* Refines a place in n dimensions by the simplex method, in which vertices are sorted by value. Returns true if the
 * simplex shrank to a point. */
static bool refine(struct search *s, const struct kd_align_vertex *from, const int *dimension, int n,
                   const double step[2])
{
    struct kd_align_vertex v[3] = { *from, *from, *from };
    const unsigned end = s->best.evaluations + 2 * SIMPLEX_STEPS;
    for (int i = 1; i <= n; i++) {
        v[i].at[dimension[i - 1]] += step[dimension[i - 1]] / 2;
        v[i].value = try_at(s, v[i].at);
    }
    while (s->best.evaluations + 2 + (unsigned)n <= end) { /* a step has at most 2 + n evaluations */
        qsort(v, (size_t)n + 1, sizeof *v, by_value);
        if (v[n].value - v[0].value <= SPREAD * (1 + fabs(v[0].value)) && fabs(v[n].at[0] - v[0].at[0]) < 1e-5 &&
            fabs(v[n].at[1] - v[0].at[1]) < 1e-3)
            return true;
        if (kd_pause())
            return false;
        const struct kd_align_vertex mirrored = on_line(s, v, n, -1);
        if (mirrored.value < v[0].value) {
            const struct kd_align_vertex further = on_line(s, v, n, -2);
            v[n] = further.value < mirrored.value ? further : mirrored;
        } else if (mirrored.value < v[n - 1].value) {
            v[n] = mirrored;
        } else {
            const struct kd_align_vertex nearer = on_line(s, v, n, mirrored.value < v[n].value ? -0.5 : 0.5);
            if (nearer.value < fmin(mirrored.value, v[n].value)) {
                v[n] = nearer;
                continue;
            }
            for (int k = 1; k <= n; k++) {
                for (int d = 0; d < 2; d++)
                    v[k].at[d] = (v[k].at[d] + v[0].at[d]) / 2;
                v[k].value = try_at(s, v[k].at);
            }
        }
    }
    return false;
}

static void search_grid(struct search *s, struct kd_align_vertex *grid, int sizes, int angles, const double step[2])
{
    for (int i = 0; i < sizes; i++)
        for (int j = 0; j < angles; j++) {
            struct kd_align_vertex *v = &grid[i * angles + j];
            v->at[0] = sizes > 1 ? log(KD_ALIGN_LEAST_SIZE) + i * step[0] : 0;
            v->at[1] = j * step[1];
            v->value = try_at(s, v->at);
            if (kd_pause())
                return;
        }
}

static bool near(const struct kd_align_vertex *a, const struct kd_align_vertex *b, const double step[2])
{
    return fabs(a->at[0] - b->at[0]) < 1.5 * step[0] && fabs(remainder(a->at[1] - b->at[1], 360)) < 1.5 * step[1];
}

/* Refines the best places of the grid, except those next to a better place. */
static void refine_best(struct search *s, struct kd_align_vertex *grid, int n, const double step[2])
{
    const struct kd_align_vertex *from[STARTS];
    int starts = 0, dimension[2], dimensions = 0;
    bool shrank = false;
    if (s->p->solve & KD_ALIGN_SIZE)
        dimension[dimensions++] = 0;
    if (s->p->solve & KD_ALIGN_ANGLE)
        dimension[dimensions++] = 1;
    if (kd_pause()) /* stops, because the search was given up and the grid is incomplete */
        return;
    qsort(grid, (size_t)n, sizeof *grid, by_value);
    for (int i = 0; i < n && starts < STARTS; i++) {
        bool apart = true;
        for (int k = 0; k < starts; k++)
            apart &= !near(&grid[i], from[k], step);
        if (!apart)
            continue;
        from[starts++] = &grid[i];
        const double before = s->best_total;
        const bool small = refine(s, &grid[i], dimension, dimensions, step);
        shrank = s->best_total < before || starts == 1 ? small : shrank;
    }
    const bool within =
        s->best.size > KD_ALIGN_LEAST_SIZE * (1 + 1e-6) && s->best.size < KD_ALIGN_MOST_SIZE * (1 - 1e-6);
    s->best.converged[1] = shrank && within;
    s->best.converged[2] = shrank;
}

void kd_align(const struct kd_comparison *c, const struct kd_align_params *params, struct kd_align_room *room,
              double (*model)[2], struct kd_alignment *out)
{
    const int sizes = params->solve & KD_ALIGN_SIZE ? KD_ALIGN_SIZES : 1,
              angles = params->solve & KD_ALIGN_ANGLE ? KD_ALIGN_ANGLES : 1;
    const double step[2] = { log(KD_ALIGN_MOST_SIZE / KD_ALIGN_LEAST_SIZE) / (KD_ALIGN_SIZES - 1),
                             360. / KD_ALIGN_ANGLES };
    struct search s = { .c = c,
                        .p = params,
                        .given_scale = out->scale,
                        .longest = 1, /* at least one wavelength, so that the size of a cell stays finite */
                        .model = model,
                        .cell = room->shift,
                        .best = KD_ALIGNMENT_NONE,
                        .best_total = INFINITY };
    s.best.scale = s.given_scale;
    memset(s.best.converged, 0, sizeof s.best.converged); /* keeps this result if chi^2 is nowhere finite */
    for (size_t i = 0; i < c->n; i++)
        s.longest = fmax(s.longest, fmax(fabs(c->at[i].u), fabs(c->at[i].v)));
    search_grid(&s, room->grid, sizes, angles, step);
    if (sizes * angles > 1)
        refine_best(&s, room->grid, sizes * angles, step);
    s.best.angle_deg = remainder(s.best.angle_deg, 360);
    params->model(params->user, s.best.size, s.best.angle_deg, model);
    kd_align_shift(c, s.best.east, s.best.north, model);
    *out = s.best;
}
