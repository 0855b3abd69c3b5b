#include "render/view/critical_pixels.h"

#include "physics/null/critical.h"
#include "render/view/camera.h"
#include "scene/hole.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

enum { DEEPEST = 14, PIECES = 16, TILE = 64 };
static const double straight = 0.05; /* largest distance between the midpoint of a chord and the curve, in pixels */

struct tile { uint64_t rows[TILE]; }; /* one bit for each pixel; the lowest bit is the leftmost pixel */

/* Tiles of pixels exist only where the curve passes. So work and memory grow with the length of the curve and not with
 * the picture. */
struct work {
    struct kd_critical curve;
    struct kd_camera_exact camera;
    /* size of the rendered part: width and height in pixels, across and down in tiles */
    uint32_t width, height, across, down;
    uint32_t whole;      /* number of columns of the whole picture */
    struct tile **tiles; /* tiles, row by row; NULL: no pixel of the tile is marked */
    size_t n;            /* number of marked pixels */
    bool no_memory;
};

/* A point of the curve in the picture, in pixels. */
struct spot {
    double x, y;
    bool seen; /* true if the point is in front of the camera */
};

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* Place of a direction in the picture of a camera whose steps are angles (sphere or dome). right, up, ahead:
 * components of a unit vector. */
static struct spot turned(const struct kd_camera_exact *c, double right, double up, double ahead)
{
    const double quarter = 0.5 * M_PI, lateral = hypot(right, up), off = atan2(lateral, ahead) / (quarter * c->turn_x);
    if (c->sight == KD_SIGHT_SPHERE)
        return (struct spot) { c->middle_x + atan2(right, ahead) / (quarter * c->turn_x),
                               c->middle_y - atan2(up, hypot(right, ahead)) / (quarter * c->turn_y), true };
    if (!(lateral > 0))
        return (struct spot) { c->middle_x, c->middle_y, ahead > 0 };
    return (struct spot) { c->middle_x + off * right / lateral, c->middle_y - off * up / lateral, true };
}

/* The place of a point of the curve in the picture: the inverse of kd_camera_label. half: 1, the upper half of the
 * curve, or -1. */
static struct spot project(const struct work *w, double along, double half)
{
    struct kd_critical_point p = kd_critical_upper(&w->curve, along);
    const struct kd_camera_exact *c = &w->camera;
    const double right[] = { c->cxx, c->cxy, c->cxz }, up[] = { c->cyx, c->cyy, c->cyz };
    p.up *= half;
    kd_critical_see(&w->curve, &p);
    double d[3] = { -p.inwards, -p.up, p.right };
    if (isinf(w->curve.observer.radius)) {
        d[0] = p.alpha - c->c0x;
        d[1] = half * p.beta - c->c0y;
        d[2] = 0;
    } else {
        const double forward[] = { c->c0x, c->c0y, c->c0z };
        double depth = dot(d, forward);
        if (c->sight != KD_SIGHT_PINHOLE)
            return turned(c, dot(d, right), dot(d, up), depth);
        if (!(depth > 1e-6))
            return (struct spot) { .seen = false };
        for (int i = 0; i < 3; i++)
            d[i] /= depth;
    }
    return (struct spot) { c->middle_x + dot(d, right) / dot(right, right), c->middle_y - dot(d, up) / dot(up, up),
                           true };
}

static double clamp(double x, double least, double most) { return fmin(fmax(x, least), most); }

static void mark_pixel(struct work *w, uint32_t x, uint32_t y)
{
    struct tile **tile = &w->tiles[(size_t)(y / TILE) * w->across + x / TILE];
    const uint64_t bit = 1ull << (x % TILE);
    if (!*tile && !(*tile = calloc(1, sizeof **tile))) {
        w->no_memory = true;
        return;
    }
    w->n += !((*tile)->rows[y % TILE] & bit);
    (*tile)->rows[y % TILE] |= bit;
}

/* Marks the pixels near the straight line from a to b. */
static void mark(struct work *w, struct spot a, struct spot b)
{
    const double near = KD_CRITICAL_NEAR;
    double top = clamp(ceil(fmin(a.y, b.y) - near), 0, w->height),
           bottom = clamp(floor(fmax(a.y, b.y) + near), -1, w->height - 1.0);
    double left = clamp(ceil(fmin(a.x, b.x) - near), 0, w->width),
           right = clamp(floor(fmax(a.x, b.x) + near), -1, w->width - 1.0);
    double dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
    for (double y = top; y <= bottom; y++)
        for (double x = left; x <= right; x++) {
            double t = length2 > 0 ? clamp(((x - a.x) * dx + (y - a.y) * dy) / length2, 0, 1) : 0;
            double off_x = x - a.x - t * dx, off_y = y - a.y - t * dy;
            if (off_x * off_x + off_y * off_y <= near * near)
                mark_pixel(w, (uint32_t)x, (uint32_t)y);
        }
}

/* True if the curve between two spots may enter the picture. The piece of the curve must not be much longer than the
 * distance between the spots. */
static bool meets(const struct work *w, struct spot a, struct spot b)
{
    double room = KD_CRITICAL_NEAR + hypot(a.x - b.x, a.y - b.y);
    return fmax(a.x, b.x) + room >= 0 && fmin(a.x, b.x) - room <= w->width && fmax(a.y, b.y) + room >= 0 &&
           fmin(a.y, b.y) - room <= w->height;
}

/* Draws the curve between two parameters in short, straight pieces. They must be short because mark() examines their
 * bounding boxes. */
static void draw(struct work *w, double half, double from, struct spot a, double to, struct spot b, int depth)
{
    if (a.seen && b.seen && depth > 0 && !meets(w, a, b))
        return;
    double middle = 0.5 * (from + to);
    struct spot m = project(w, middle, half);
    bool whole = a.seen && m.seen && b.seen;
    if (depth == DEEPEST && whole && hypot(b.x - a.x, b.y - a.y) > 0.5 * w->whole)
        /* nothing is drawn, because the curve jumps here: from one edge of a sphere's picture to the other, or across
         * the part behind a dome */
        return;
    if (whole && (depth == DEEPEST || (fabs(m.x - 0.5 * (a.x + b.x)) < straight &&
                                       fabs(m.y - 0.5 * (a.y + b.y)) < straight && hypot(b.x - a.x, b.y - a.y) < 24))) {
        mark(w, a, m);
        mark(w, m, b);
    } else if (depth < DEEPEST && (a.seen || m.seen || b.seen || depth < 4)) {
        draw(w, half, from, a, middle, m, depth + 1);
        draw(w, half, middle, m, to, b, depth + 1);
    }
}

static void list_row(const struct work *w, const uint32_t *columns, uint32_t n, uint32_t y,
                     struct kd_critical_pixels *out)
{
    for (uint32_t i = 0; i < n; i++) {
        const struct tile *tile = w->tiles[(size_t)(y / TILE) * w->across + columns[i]];
        for (uint64_t left = tile->rows[y % TILE]; left; left &= left - 1)
            out->pixels[out->n++] = (struct kd_pixel) { TILE * columns[i] + (uint32_t)__builtin_ctzll(left), y };
    }
}

/* columns: room for the tiles of one row; filled with the columns that have tiles. */
static void list(const struct work *w, uint32_t *columns, struct kd_critical_pixels *out)
{
    for (uint32_t row = 0; row < w->down; row++) {
        uint32_t n = 0;
        for (uint32_t column = 0; column < w->across; column++)
            if (w->tiles[(size_t)row * w->across + column])
                columns[n++] = column;
        for (uint32_t y = TILE * row; n && y < TILE * (row + 1); y++)
            list_row(w, columns, n, y, out);
    }
}

static void mark_all(struct work *w)
{
    for (int half = -1; half <= 1; half += 2)
        for (int i = 0; i < PIECES; i++) {
            double from = (double)i / PIECES, to = (i + 1.0) / PIECES;
            draw(w, half, from, project(w, from, half), to, project(w, to, half), 0);
        }
}

static enum kd_status mark_and_list(struct work *w, struct kd_critical_pixels *out, struct kd_error *error)
{
    uint32_t *columns = malloc(w->across * sizeof *columns);
    w->tiles = calloc((size_t)w->across * w->down, sizeof *w->tiles);
    if (w->tiles && columns)
        mark_all(w);
    if (w->n && !w->no_memory)
        out->pixels = malloc(w->n * sizeof *out->pixels);
    bool good = w->tiles && columns && !w->no_memory && (out->pixels || !w->n);
    if (good)
        list(w, columns, out);
    for (size_t i = 0; w->tiles && i < (size_t)w->across * w->down; i++)
        free(w->tiles[i]);
    free(w->tiles);
    free(columns);
    return good ? KD_OK
                : kd_error_set(error, KD_ENOMEM, "out of memory for the pixels at the critical curve of %u x %u",
                               w->width, w->height);
}

static _Atomic uint64_t made;

uint64_t kd_critical_pixels_made(void) { return atomic_load(&made); }

enum kd_status kd_critical_pixels_of(const struct kd_scene *scene, struct kd_critical_pixels *out,
                                     struct kd_error *error)
{
    const struct kd_scene camera = kd_critical_camera(scene, 1);
    const struct kd_window window = kd_scene_window(scene);
    struct work w = {
        .camera = kd_camera_exact(&camera),
        .width = window.width,
        .height = window.height,
        .whole = (uint32_t)scene->image.width,
    };
    const struct kd_critical_observer observer = {
        .hole = *kd_scene_hole(scene),
        .radius = scene->camera.r,
        .cos_theta = w.camera.u,
        .sin_theta = w.camera.s,
        .motion = kd_scene_observer(scene),
    };
    atomic_fetch_add(&made, 1);
    *out = (struct kd_critical_pixels) { 0 };
    w.curve = kd_critical_of(&observer);
    if (w.curve.status) /* cannot happen for a valid scene */
        return kd_error_set(error, KD_EINVAL, "there is no critical curve for spin %.16g and camera.r %.16g",
                            observer.hole.a, observer.radius);
    w.across = (w.width + TILE - 1) / TILE;
    w.down = (w.height + TILE - 1) / TILE;
    return mark_and_list(&w, out, error);
}

void kd_critical_pixels_finish(struct kd_critical_pixels *pixels)
{
    free(pixels->pixels);
    *pixels = (struct kd_critical_pixels) { 0 };
}

size_t kd_critical_pixels_above(const struct kd_critical_pixels *pixels, uint32_t y)
{
    size_t low = 0, high = pixels->n;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (pixels->pixels[middle].y < y)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

struct kd_scene kd_critical_camera(const struct kd_scene *scene, uint32_t rays)
{
    struct kd_scene camera = *scene;
    camera.image.samples = (int32_t)rays;
    return camera;
}

/* Squared distance between the two nearest points of the lattice, which continues periodically in all pixels. */
static uint32_t apart(uint32_t rays, uint32_t generator)
{
    uint32_t least = rays * rays;
    for (uint32_t k = 1; k < rays; k++) {
        uint32_t y = k * generator % rays, dx = k < rays - k ? k : rays - k, dy = y < rays - y ? y : rays - y;
        if (dx * dx + dy * dy < least)
            least = dx * dx + dy * dy;
    }
    return least;
}

static uint32_t common(uint32_t a, uint32_t b) { return b ? common(b, a % b) : a; }

struct kd_critical_lattice kd_critical_grid(uint32_t side)
{
    return (struct kd_critical_lattice) { .rays = side * side, .shift = side };
}

/* The shortest vector of the lattice that is not a multiple of (bx, by), or the shortest of all if (bx, by) is 0. */
static void shortest(const struct kd_critical_lattice *l, int32_t bx, int32_t by, int32_t *x, int32_t *y)
{
    const int32_t n = (int32_t)l->rays;
    int64_t least = INT64_MAX;
    for (int32_t dx = 0; dx <= n; dx++)
        for (int32_t dy = (int32_t)((int64_t)dx * l->generator % n) - n, last = dy + n; dy <= last; dy += n) {
            int64_t size = (int64_t)dx * dx + (int64_t)dy * dy;
            bool along = (bx || by) && (int64_t)dx * by == (int64_t)dy * bx;
            if (size && size < least && !along) {
                least = size;
                *x = dx;
                *y = dy;
            }
        }
}

struct kd_critical_neighbours kd_critical_neighbours(const struct kd_critical_lattice *lattice)
{
    struct kd_critical_neighbours n = { 0 };
    shortest(lattice, 0, 0, &n.to[0].x, &n.to[0].y);
    shortest(lattice, n.to[0].x, n.to[0].y, &n.to[1].x, &n.to[1].y);
    n.to[2].x = n.to[0].x + n.to[1].x;
    n.to[2].y = n.to[0].y + n.to[1].y;
    n.to[3].x = n.to[0].x - n.to[1].x;
    n.to[3].y = n.to[0].y - n.to[1].y;
    return n;
}

struct kd_critical_lattice kd_critical_lattice(uint32_t rays)
{
    struct kd_critical_lattice l = { .rays = rays, .generator = 1 };
    for (uint32_t g = 2; g < rays; g++)
        if (common(g, rays) == 1 && apart(rays, g) > apart(rays, l.generator))
            l.generator = g;
    if (rays) /* ray K - 1 - k is opposite to ray k */
        l.shift = (l.generator % 2 ? l.generator - 1 : l.generator - 1 + rays) / 2 % rays;
    return l;
}
