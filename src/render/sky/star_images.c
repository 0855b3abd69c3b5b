#include "render/sky/star_images.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

struct ray { struct kd_vec n; bool there; };
struct listed { struct kd_vec n; size_t star; };

struct search {
    const struct listed *stars; /* by z, upwards */
    size_t n;
    enum kd_status (*found)(void *user, const struct kd_star_image *image);
    void *user;
};

static int by_z(const void *a, const void *b)
{
    double p = ((const struct listed *)a)->n.z, q = ((const struct listed *)b)->n.z;
    return (p > q) - (p < q);
}

static double dot(struct kd_vec a, struct kd_vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static double volume(struct kd_vec a, struct kd_vec b, struct kd_vec c)
{
    return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
}
static double apart(struct kd_vec a, struct kd_vec b) { return sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z)); }

/* The first star whose z is at least so much. */
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

static void row_of(const struct kd_sky_places *map, uint32_t y, struct ray *out)
{
    for (uint32_t x = 0; x < map->width; x++) {
        size_t o = (size_t)y * map->width + x;
        double theta = map->theta[o], phi = map->phi[o] - map->azimuth;
        out[x].there = isfinite(theta) && isfinite(phi);
        out[x].n = (struct kd_vec) { sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta) };
    }
}

/* Corners of a triangle in turn clockwise, as the picture is seen; the first has the right angle, the second lies along `across`, the third
 * along `down`, +1 or -1. A star s is w0 a + w1 b + w2 c with all w above 0 (Cramer's rule), and two triangles of a pixel's area have twice
 * the solid angle of one: the volume of a, b, c. */
struct corner { double x, y; struct ray ray; };

static enum kd_status triangle(const struct search *s, const struct corner *a, const struct corner *b, const struct corner *c)
{
    if (!a->ray.there || !b->ray.there || !c->ray.there)
        return KD_OK;
    const struct kd_vec p = a->ray.n, q = b->ray.n, r = c->ray.n;
    const double size = fmax(apart(p, q), fmax(apart(q, r), apart(r, p))), all = volume(p, q, r);
    if (size > KD_IMAGES_COARSE || all == 0)
        return KD_OK;
    for (size_t i = first_from(s, p.z - size); i < s->n && s->stars[i].n.z <= p.z + size; i++) {
        const struct kd_vec n = s->stars[i].n;
        const double w0 = volume(n, q, r) / all, w1 = volume(p, n, r) / all, w2 = volume(p, q, n) / all, sum = w0 + w1 + w2;
        if (w0 < 0 || w1 < 0 || w2 < 0 || dot(n, p) <= 0)
            continue;
        const struct kd_star_image image = {
            .star = s->stars[i].star, .x = (w0 * a->x + w1 * b->x + w2 * c->x) / sum, .y = (w0 * a->y + w1 * b->y + w2 * c->y) / sum,
            .solid_angle = fabs(all), .mirrored = all < 0,
        };
        enum kd_status status = s->found(s->user, &image);
        if (status)
            return status;
    }
    return KD_OK;
}

static enum kd_status between(const struct search *s, uint32_t y, const struct ray *upper, const struct ray *lower, uint32_t width)
{
    enum kd_status status = KD_OK;
    for (uint32_t x = 0; x + 1 < width && !status; x++) {
        const double left = x + 0.5, top = y + 0.5;
        const struct corner c[4] = { { left, top, upper[x] }, { left + 1, top, upper[x + 1] }, { left + 1, top + 1, lower[x + 1] }, { left, top + 1, lower[x] } };
        KD_TRY(triangle(s, &c[0], &c[1], &c[3]));
        KD_TRY(triangle(s, &c[2], &c[3], &c[1]));
    }
done:
    return status;
}

enum kd_status kd_star_images(const struct kd_sky_places *map, const struct kd_vec *stars, size_t n,
                              enum kd_status (*found)(void *user, const struct kd_star_image *image), void *user)
{
    struct listed *sorted = malloc((n + 1) * sizeof *sorted);
    struct ray *rows = malloc(2 * (map->width + 1) * sizeof *rows);
    const struct search search = { sorted, n, found, user };
    enum kd_status status = sorted && rows ? KD_OK : KD_ENOMEM;
    if (!status) {
        for (size_t i = 0; i < n; i++)
            sorted[i] = (struct listed) { stars[i], i };
        qsort(sorted, n, sizeof *sorted, by_z);
        row_of(map, 0, rows);
    }
    for (uint32_t y = 0; y + 1 < map->height && !status; y++) {
        struct ray *upper = rows + (y & 1) * map->width, *lower = rows + (~y & 1) * map->width;
        row_of(map, y + 1, lower);
        status = between(&search, y, upper, lower, map->width);
    }
    free(sorted);
    free(rows);
    return status;
}
