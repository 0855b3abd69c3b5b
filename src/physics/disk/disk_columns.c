#include "physics/disk/disk_columns.h"

#include "base/pause.h"
#include "physics/disk/transfer_function.h"
#include "physics/null/null_polar.h"
#include "physics/null/null_quartic.h"

#include "physics/null/null_radial.h"

#include <math.h>
#include <string.h>

/* Lengths (M) at which the spacing changes from even to geometric. HOLE: length for the spacing of columns. THIN:
 * length for the spacing of places along a column. */
#define HOLE 2.
#define THIN 0.2
#define BESIDE 1e-9 /* beta of the place next to the plane; not 0, because a ray at beta = 0 could lie in the plane */
enum {
    PLACES = 48,  /* number of places into which a column is first divided */
    DEEPEST = 16, /* number of times that a cell with an edge of the disk is halved; more for a narrow disk */
    NARROW = 8,   /* least number of cells across a narrow disk */
    SEARCHED = 24 /* number of steps of the golden section that searches the smallest radius of a column */
};
#define ASIDE 0.01 /* distance of the rays from which the slope of r is computed, as a fraction of a column's width */
#define SHORTER 0.61803398874989485

/* Values of `order` for a ray that shows no point of the disk. WITHIN: the ray passes within the inner edge. BEYOND: it
 * passes beyond the outer edge. */
enum { WITHIN = -1, BEYOND = -2 };

/* A place on a column. seen: the point of the disk that is seen there; its order is WITHIN or BEYOND if there is none.
 * first: radius of the first crossing of the plane; 0 if the ray is captured before it, INFINITY if it escapes. */
struct place {
    struct kd_disk_end seen;
    double first;
};

static struct place look(const struct kd_disk_image *image, const struct kd_disk_columns *c, double alpha, double beta)
{
    const struct kd_null_motion m = kd_null_motion_of(&image->hole, image->cos_i, image->sin_i, alpha, beta);
    struct place p = { { beta, 0, BEYOND }, INFINITY };
    if (!(m.eta > 0)) { /* vortical */
        p.seen.order = m.k > 27 ? BEYOND : WITHIN;
        return p;
    }
    const struct kd_null_roots roots = kd_null_roots_of(&m);
    const double tau = kd_null_polar_first(&m);
    p.first = p.seen.r = kd_null_radius_after(&m, &roots, tau);
    if (p.first > c->outer && !isinf(p.first))
        p.seen.r = kd_null_radius_after(&m, &roots, tau + kd_null_polar_half(&m));
    if (!(p.seen.r > c->outer))
        p.seen.order = p.seen.r < c->inner ? WITHIN : p.first > c->outer ? 1 : 0;
    return p;
}

struct column {
    const struct kd_disk_image *image;
    const struct kd_disk_columns *c;
    double alpha, width, step;
    int deepest;
};

static bool lit(const struct kd_disk_end *end) { return end->order >= 0; }

/* dr/dalpha at constant beta, from a second ray on one side; 0 if neither side shows the same face of the disk. */
static double slope_at(const struct column *column, const struct kd_disk_end *at)
{
    for (int k = -1; k <= 1; k += 2) {
        const double aside = k * ASIDE * column->width;
        const struct kd_disk_end end = look(column->image, column->c, column->alpha + aside, at->beta).seen;
        if (end.order == at->order)
            return (end.r - at->r) / aside;
    }
    return 0;
}

static void add(const struct column *column, const struct kd_disk_end *x, const struct kd_disk_end *middle,
                const struct kd_disk_end *y, double length)
{
    const struct kd_disk_cell cell = {
        column->alpha, column->width, length, slope_at(column, middle), { *x, *middle, *y }
    };
    column->c->add(column->c->user, &cell);
}

/* True if two places are on the same face of the disk and on the same side of the split, and ln r differs by at most a
 * step between them. */
static bool close_to(const struct column *column, const struct kd_disk_end *x, const struct kd_disk_end *y)
{
    const double split = column->c->split;
    return x->order == y->order && (x->r < split) == (y->r < split) && fabs(log(y->r / x->r)) < column->step;
}

/* Adds the part of a column between two places, as cells. Cells are halved until r changes little enough within each,
 * or until an edge is found to 2^-DEEPEST of the first division. The length of a cell with an edge is divided equally
 * between its two ends. */
static void divide(const struct column *column, const struct kd_disk_end *x, const struct kd_disk_end *y, int depth)
{
    const double length = y->beta - x->beta;
    if (x->order == y->order && !lit(x))
        return;
    if (depth == column->deepest) {
        if (lit(x))
            add(column, x, x, x, 0.5 * length);
        if (lit(y))
            add(column, y, y, y, 0.5 * length);
        return;
    }
    const struct kd_disk_end middle = look(column->image, column->c, column->alpha, 0.5 * (x->beta + y->beta)).seen;
    if (close_to(column, x, y) && close_to(column, x, &middle) && close_to(column, &middle, y)) {
        add(column, x, &middle, y, length);
        return;
    }
    divide(column, x, &middle, depth + 1);
    divide(column, &middle, y, depth + 1);
}

/* The place between two others whose ray crosses the plane first at the smallest radius. At the alpha of a ring's end
 * this place is on the ring. */
static struct place nearest(const struct column *column, double low, double high)
{
    double x = high - SHORTER * (high - low), y = low + SHORTER * (high - low);
    struct place at_x = look(column->image, column->c, column->alpha, x),
                 at_y = look(column->image, column->c, column->alpha, y);
    for (int i = 0; i < SEARCHED; i++) {
        if (at_x.first < at_y.first) {
            high = y, y = x, at_y = at_x;
            at_x = look(column->image, column->c, column->alpha, x = high - SHORTER * (high - low));
        } else {
            low = x, x = y, at_x = at_y;
            at_y = look(column->image, column->c, column->alpha, y = low + SHORTER * (high - low));
        }
    }
    return at_x.first < at_y.first ? at_x : at_y;
}

/* Half the height of the image. The far side is taken to be lifted as by a thin lens, b (b - r cos i) = 4 r. */
static double height_of(const struct kd_disk_image *image, double outer)
{
    const double flat = outer * image->cos_i;
    return 0.5 * (flat + sqrt(flat * flat + 16 * outer)) + 10;
}

static void add_column(const struct column *column)
{
    struct place places[PLACES + 2];
    const double all = asinh(height_of(column->image, column->c->outer) / THIN);
    int n = PLACES + 1, least = 0;
    for (int k = 0; k < n; k++) {
        const double beta = THIN * sinh(all * (2. * k / PLACES - 1));
        places[k] = look(column->image, column->c, column->alpha, 2 * k == PLACES ? BESIDE : beta);
        if (places[k].first < places[least].first)
            least = k;
    }
    /* At the ends of rings, the disk may be seen only within a cell and not at the cell's two ends. */
    if (least > 0 && least < PLACES && places[least].first > column->c->inner) {
        const struct place end = nearest(column, places[least - 1].seen.beta, places[least + 1].seen.beta);
        const int at = end.seen.beta < places[least].seen.beta ? least : least + 1;
        memmove(&places[at + 1], &places[at], (size_t)(n - at) * sizeof *places);
        places[at] = end;
        n++;
    }
    for (int k = 1; k < n; k++)
        divide(column, &places[k - 1].seen, &places[k].seen, 0);
}

/* Adds the columns between the ends of the inner ring and of the outer ring. They are evenly spaced in
 * asinh(alpha/HOLE), but denser towards both ends, where the light grows as the square root of the distance from the
 * end. */
static void add_columns(const struct kd_disk_image *image, const struct kd_disk_columns *c, double from, double to,
                        int n)
{
    const double low = asinh(from / HOLE), all = asinh(to / HOLE) - low, wide = log(c->outer / c->inner);
    struct column column = { image, c, .step = fmin(c->step, wide / NARROW), .deepest = DEEPEST };
    column.deepest += (int)fmax(0, ceil(-log2(wide)));
    for (int j = 0; j < n; j++) {
        const double edges[2] = { (double)j / n, (j + 1.) / n }, t = (j + 0.5) / n;
        double alpha[2];
        for (int k = 0; k < 2; k++)
            alpha[k] = HOLE * sinh(low + all * edges[k] * edges[k] * (3 - 2 * edges[k]));
        column.alpha = HOLE * sinh(low + all * t * t * (3 - 2 * t)), column.width = alpha[1] - alpha[0];
        if (kd_pause_every((uint64_t)j, 2))
            return;
        add_column(&column);
    }
}

bool kd_disk_columns(const struct kd_disk_image *image, const struct kd_disk_columns *c)
{
    struct kd_transfer_ring in, out;
    if (!kd_transfer_ring_of(image, c->inner, &in) || !kd_transfer_ring_of(image, c->outer, &out))
        return false;
    add_columns(image, c, out.alpha[1], in.alpha[1], c->columns);
    add_columns(image, c, in.alpha[1], in.alpha[0], c->columns);
    add_columns(image, c, in.alpha[0], out.alpha[0], c->columns);
    return true;
}
