#include "render/sky/star_images.h"

#include "render/sky/star_root.h"

#include <math.h>
#include <stdlib.h>

/* distance in ray spacings. Roots of a star that are nearer to each other than this are one image, unless only one of
 * them is mirrored */
#define SAME 1e-3
#define FOLDED 0.2 /* size in rad of the largest cells in which folds are searched for */
/* fraction of a cell's size. Where the map folds, stars this near to a corner or the middle of the cell are searched
 * for */
#define REACH 0.5
#define BESIDE 0.35 /* distance from the fold, in rays, at which the search starts on both sides */
/* except at folds, an image is at most this many times as bright as an estimate from its triangle */
#define MARGIN 3.0

struct listed {
    struct kd_vec n;
    size_t star;
};
struct told {
    double x, y;
    bool mirrored;
    size_t before; /* index + 1 of the previous reported image of this star; 0: none */
};

struct search {
    const struct kd_sky_map *map;
    struct listed *stars; /* sorted by z, ascending */
    size_t n;
    size_t *near, n_near; /* indices of the stars that may be in the current cell and are bright enough */
    size_t *last;         /* index + 1 of each star's last reported image */
    struct told *told;
    size_t n_told, room;
    enum kd_status (*found)(void *user, const struct kd_star_image *image);
    void *user;
};

static int by_z(const void *a, const void *b)
{
    double p = ((const struct listed *)a)->n.z, q = ((const struct listed *)b)->n.z;
    return (p > q) - (p < q);
}

/* Index of the first star whose z is at least the given z. */
static size_t first_from(const struct search *s, double z)
{
    size_t low = 0, high = s->n;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (s->stars[middle].n.z < z)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Reports an image unless it was reported before. */
static enum kd_status tell(struct search *s, const struct listed *star, double x, double y,
                           const struct kd_sky_tangent *t, struct kd_star_stencil by)
{
    struct kd_star_image image = {
        .star = star->star, .x = x, .y = y, .solid_angle = fabs(t->area), .by = by, .mirrored = t->area < 0
    };
    for (size_t i = s->last[image.star]; i; i = s->told[i - 1].before) {
        const struct told *o = &s->told[i - 1];
        if (o->mirrored == image.mirrored && fabs(o->x - x) < SAME && fabs(o->y - y) < SAME)
            return KD_OK;
    }
    if (s->n_told == s->room) {
        const size_t room = s->room ? 2 * s->room : 256;
        struct told *more = realloc(s->told, room * sizeof *more);
        if (!more)
            return KD_ENOMEM;
        s->told = more;
        s->room = room;
    }
    s->told[s->n_told++] = (struct told) { x, y, image.mirrored, s->last[image.star] };
    s->last[image.star] = s->n_told;
    kd_sky_steps_to(t, (struct kd_vec) { star->n.y, -star->n.x, 0 }, &image.x_by_azimuth,
                    &image.y_by_azimuth); /* negated, because the sky turns the other way when the observer's azimuth
                                           * grows */
    return s->found(s->user, &image);
}

/* Corners of a triangle, clockwise as the picture is seen. The right angle is at the first corner. The second corner
 * lies along `across` from it, the third corner along `down`; `across` and `down` are +1 or -1. A star s = w0 a + w1
 * b + w2 c is inside if all w are positive (Cramer's rule). The volume of a, b, c is twice the solid angle of the
 * triangle. That is the solid angle of a pixel, because a pixel has two triangles. */
struct corner {
    double x, y;
    struct kd_vec n;
};

static struct kd_sky_tangent tangent_of(const struct corner *a, const struct corner *b, const struct corner *c)
{
    struct kd_sky_tangent t = { a->n, kd_vec_times(b->x - a->x, kd_vec_less(b->n, a->n)),
                                kd_vec_times(c->y - a->y, kd_vec_less(c->n, a->n)), 0 };
    t.area = kd_vec_volume(t.n, t.across, t.down);
    return t;
}

/* A cell of four rays, clockwise. folds: true if the map folds in the cell. */
struct cell {
    struct corner c[4];
    double side[4], across, size, pixels;
    bool folds;
    /* if the map folds in the cell. area: the cell's largest area; beside: one place on each side of the fold */
    double area, beside[2][2];
};

/* True if a star may be bright enough where the map takes a cell to a solid angle `area`. */
static bool is_seen(const struct search *s, const struct cell *cell, const struct listed *star, double area)
{
    return !s->map->most || fabs(area) < MARGIN * cell->pixels * s->map->most[star->star];
}

static enum kd_status triangle(struct search *s, const struct cell *cell, int first, int second, int third)
{
    const struct corner *a = &cell->c[first], *b = &cell->c[second], *c = &cell->c[third];
    const struct kd_vec p = a->n, q = b->n, r = c->n;
    const double all = kd_vec_volume(p, q, r),
                 size = cell->side[first] + cell->side[third] + cell->across; /* NAN if a ray does not escape */
    enum kd_status status = KD_OK;
    if (!isfinite(size) || fmax(cell->across, fmax(cell->side[first], cell->side[third])) > s->map->coarse || all == 0)
        return KD_OK;
    for (size_t k = 0; k < s->n_near; k++) {
        const struct listed *star = &s->stars[s->near[k]];
        const struct kd_vec n = star->n;
        const double w0 = kd_vec_volume(n, q, r) / all, w1 = kd_vec_volume(p, n, r) / all,
                     w2 = kd_vec_volume(p, q, n) / all, sum = w0 + w1 + w2;
        if (w0 < 0 || w1 < 0 || w2 < 0 || kd_vec_dot(n, p) <= 0)
            continue;
        if (!is_seen(s, cell, star, all))
            continue;
        const double fx = (w0 * a->x + w1 * b->x + w2 * c->x) / sum, fy = (w0 * a->y + w1 * b->y + w2 * c->y) / sum;
        double x = fx, y = fy;
        struct kd_sky_tangent t = { 0 };
        const enum kd_star_root root = kd_star_root(s->map, n, &x, &y, &t);
        if (root == KD_STAR_ROOT_FOUND) {
            KD_TRY(tell(s, star, x, y, &t, (struct kd_star_stencil) { .x = x, .y = y }));
        } else if (root == KD_STAR_ROOT_UNKNOWN || (root == KD_STAR_ROOT_NONE && !cell->folds)) {
            t = tangent_of(a, b, c);
            KD_TRY(tell(s, star, fx, fy, &t, (struct kd_star_stencil) { a->x, a->y, b->x - a->x, c->y - a->y }));
        }
    }
done:
    return status;
}

static bool is_near(const struct cell *cell, struct kd_vec star)
{
    const struct kd_vec a = cell->c[0].n, b = cell->c[2].n;
    double nearest = kd_vec_apart(star, (struct kd_vec) { 0.5 * (a.x + b.x), 0.5 * (a.y + b.y), 0.5 * (a.z + b.z) });
    for (int i = 0; i < 4; i++)
        nearest = fmin(nearest, kd_vec_apart(star, cell->c[i].n));
    return nearest < REACH * cell->size;
}

/* Searches stars near a fold from both sides of it. */
static enum kd_status fold(struct search *s, const struct cell *cell)
{
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < s->n_near; i++) {
        const struct listed *star = &s->stars[s->near[i]];
        for (int k = 0; k < 2 && is_near(cell, star->n) && is_seen(s, cell, star, cell->area); k++) {
            double x = cell->beside[k][0], y = cell->beside[k][1];
            struct kd_sky_tangent t;
            if (kd_star_root(s->map, star->n, &x, &y, &t) == KD_STAR_ROOT_FOUND)
                KD_TRY(tell(s, star, x, y, &t, (struct kd_star_stencil) { .x = x, .y = y }));
        }
    }
done:
    return status;
}

/* Four rows of rays; the cells are between the middle two. NULL: the row does not exist. */
struct rows { const struct kd_vec *of[4]; };

/* The difference between the two neighbours of a ray, which are two steps apart. If one neighbour is missing,
 * the result is twice the difference between the ray and the other neighbour. */
static struct kd_vec difference(struct kd_vec middle, const struct kd_vec *before, const struct kd_vec *after)
{
    const bool has_before = before && isfinite(before->x), has_after = after && isfinite(after->x);
    const struct kd_vec d = kd_vec_less(has_after ? *after : middle, has_before ? *before : middle);
    return has_before && has_after ? d : kd_vec_times(2, d);
}

/* Four times the area of the sky about a ray; negative where the sky is mirrored. */
static double area_at(const struct kd_sky_map *map, const struct rows *rows, int row, uint32_t x)
{
    const uint32_t width = map->width;
    const struct kd_vec *line = rows->of[row], *above = rows->of[row - 1], *below = rows->of[row + 1];
    const struct kd_vec *before = x ? &line[x - 1] : NULL, *after = x + 1 < width ? &line[x + 1] : NULL;
    return kd_vec_volume(line[x], difference(line[x], before, after),
                         difference(line[x], above ? above + x : NULL, below ? below + x : NULL));
}

/* Finds a fold in or next to a cell: where the area is 0, by a plane through the areas at the corners. */
static void find_fold(const struct kd_sky_map *map, const struct rows *rows, uint32_t x, struct cell *cell)
{
    const uint32_t next = x + 1;
    const double a = area_at(map, rows, 1, x), b = area_at(map, rows, 1, next), c = area_at(map, rows, 2, x),
                 d = area_at(map, rows, 2, next);
    const double mean = 0.25 * (a + b + c + d), gx = 0.5 * (b + d - a - c), gy = 0.5 * (c + d - a - b),
                 slope = hypot(gx, gy), off = -mean / slope;
    cell->folds = fabs(off) < KD_STAR_ROOT_NEAR; /* also false if any number is NAN */
    cell->area = 0.25 * fmax(fmax(fabs(a), fabs(b)), fmax(fabs(c), fabs(d)));
    for (int k = 0; k < 2; k++) {
        const double by = (off + (k ? BESIDE : -BESIDE)) / slope;
        cell->beside[k][0] = cell->c[0].x + 0.5 + by * gx;
        cell->beside[k][1] = cell->c[0].y + 0.5 + by * gy;
    }
}

/* Collects the stars that may be in a cell or near one of its corners, and are bright enough for the smaller of its
 * triangles. If one ray does not escape, one triangle is left. */
static void find_near(struct search *s, struct cell *cell, size_t first, double high)
{
    const struct kd_vec *a = &cell->c[0].n, *b = &cell->c[1].n, *c = &cell->c[2].n, *d = &cell->c[3].n;
    const struct kd_vec *end = isfinite(a->x) && isfinite(c->x) ? c : d, *start = end == c ? a : b,
                        middle = { 0.5 * (start->x + end->x), 0.5 * (start->y + end->y), 0.5 * (start->z + end->z) };
    const double area = fmin(fabs(kd_vec_volume(*a, *b, *d)), fabs(kd_vec_volume(*c, *d, *b)));
    double far = 0;
    for (int i = 0; i < 4; i++)
        far = fmax(far, kd_vec_apart(middle, cell->c[i].n));
    far += REACH * fmin(cell->size, s->map->coarse);
    cell->pixels = NAN;
    for (size_t i = first; i < s->n && s->stars[i].n.z <= high; i++) {
        const struct kd_vec off = kd_vec_less(s->stars[i].n, middle);
        if (!(kd_vec_dot(off, off) <= far * far))
            continue;
        if (isnan(cell->pixels))
            cell->pixels = s->map->pixels ? s->map->pixels(s->map->of, cell->c[0].x + 0.5, cell->c[0].y + 0.5) : 1;
        if (is_seen(s, cell, &s->stars[i], area))
            s->near[s->n_near++] = i;
    }
}

/* Sets everything in a cell except its corners. Returns false if no star is near. */
static bool measure(struct search *s, const struct rows *rows, uint32_t x, struct cell *cell)
{
    double low = INFINITY, high = -INFINITY;
    cell->size = 0;
    for (int i = 0; i < 4; i++) {
        const struct kd_vec n = cell->c[i].n;
        cell->side[i] = kd_vec_apart(n, cell->c[(i + 1) % 4].n);
        cell->size = fmax(cell->size, cell->side[i]);
        low = fmin(low, n.z), high = fmax(high, n.z);
    }
    cell->across = kd_vec_apart(cell->c[1].n, cell->c[3].n);
    cell->size = fmax(cell->size, cell->across);
    const double size = REACH * fmin(cell->size, s->map->coarse);
    const size_t first = first_from(s, low - size);
    s->n_near = 0;
    if (first < s->n && s->stars[first].n.z <= high + size)
        find_near(s, cell, first, high + size);
    if (s->n_near)
        find_fold(s->map, rows, x, cell);
    return s->n_near;
}

static enum kd_status between(struct search *s, uint32_t y, const struct rows *rows)
{
    const struct kd_vec *upper = rows->of[1], *lower = rows->of[2];
    enum kd_status status = KD_OK;
    for (uint32_t x = 0; x + 1 < s->map->width; x++) {
        const uint32_t next = x + 1;
        struct cell cell = { .c = { { x, y, upper[x] },
                                    { x + 1.0, y, upper[next] },
                                    { x + 1.0, y + 1.0, lower[next] },
                                    { x, y + 1.0, lower[x] } } };
        if (!measure(s, rows, x, &cell))
            continue;
        KD_TRY(triangle(s, &cell, 0, 1, 3));
        KD_TRY(triangle(s, &cell, 2, 3, 1));
        if (cell.folds && cell.size <= fmin(FOLDED, s->map->coarse) && s->map->exact)
            KD_TRY(fold(s, &cell));
    }
done:
    return status;
}

enum kd_status kd_star_images(const struct kd_sky_map *map, const struct kd_vec *stars, size_t n,
                              enum kd_status (*found)(void *user, const struct kd_star_image *image), void *user)
{
    enum { ROWS = 4 };
    const size_t width = map->width;
    struct kd_vec *rays = malloc(ROWS * (width + 1) * sizeof *rays);
    struct search s = { .map = map,
                        .stars = malloc((n + 1) * sizeof *s.stars),
                        .n = n,
                        .near = malloc((n + 1) * sizeof *s.near),
                        .last = calloc(n + 1, sizeof *s.last),
                        .found = found,
                        .user = user };
    enum kd_status status = s.stars && s.near && s.last && rays ? KD_OK : KD_ENOMEM;
    if (!status) {
        for (size_t i = 0; i < n; i++)
            s.stars[i] = (struct listed) { stars[i], i };
        qsort(s.stars, n, sizeof *s.stars, by_z);
        for (uint32_t y = 0; y < 2 && y < map->height; y++)
            map->row(map->of, y, rays + y * width);
    }
    for (uint32_t y = 0; y + 1 < map->height && !status; y++) {
        struct rows rows = { { NULL } };
        if (y + 2 < map->height)
            map->row(map->of, y + 2, rays + (y + 2) % ROWS * width);
        for (uint32_t i = 0; i < ROWS; i++)
            rows.of[i] = y + i >= 1 && y + i <= map->height ? rays + (y + i - 1) % ROWS * width : NULL;
        status = between(&s, y, &rows);
    }
    free(s.told);
    free(s.last);
    free(s.near);
    free(s.stars);
    free(rays);
    return status;
}
