#include "render/sky/star_root.h"

#define NUDGE 1e-3 /* step, in rays, over which the differences for the derivative are taken */
/* the iteration has converged after a step shorter than this, in rays; the next step would be 1e-10 */
#define EXACT 1e-7
#define BETWEEN 1e-4 /* the same for the interpolated map, which is not more accurate than this */
#define STEADY 0.02  /* after a step shorter than this, in rays, the derivative is not computed again */
/* The derivative is kept only if, in addition, the step is shorter than the step before by this factor. The next step
 * then shrinks by the same factor. */
#define SHRINKS 0.1
/* angle in rad. Next to a fold, a star may have an image if the interpolated map comes this near to the star. Such an
 * image is searched for */
#define DOUBTFUL 1e-3
#define STEPS 30

void kd_sky_steps_to(const struct kd_sky_tangent *from, struct kd_vec star, double *dx, double *dy)
{
    *dx = kd_vec_volume(from->n, star, from->down) / from->area;
    *dy = kd_vec_volume(from->n, from->across, star) / from->area;
}

/* The derivative from differences to rays: to both sides of a place if `both` is true, otherwise to one side. */
static bool set_slopes(const struct kd_sky_map *map, double x, double y, bool both, struct kd_sky_tangent *out)
{
    struct kd_vec across, down, left = out->n, up = out->n;
    if (!map->exact(map->of, x + NUDGE, y, &across) || !map->exact(map->of, x, y + NUDGE, &down))
        return false;
    if (both && (!map->exact(map->of, x - NUDGE, y, &left) || !map->exact(map->of, x, y - NUDGE, &up)))
        return false;
    out->across = kd_vec_times((both ? 0.5 : 1) / NUDGE, kd_vec_less(across, left));
    out->down = kd_vec_times((both ? 0.5 : 1) / NUDGE, kd_vec_less(down, up));
    out->area = kd_vec_volume(out->n, out->across, out->down);
    return true;
}

/* Takes a step of at most half a ray towards the star. Returns the length of the full step, which is not finite if
 * there is no direction. */
static double step(const struct kd_sky_tangent *at, struct kd_vec star, double *x, double *y)
{
    double dx, dy;
    kd_sky_steps_to(at, star, &dx, &dy);
    const double far = hypot(dx, dy), by = far > 0.5 ? 0.5 / far : 1;
    *x += by * dx, *y += by * dy;
    return far;
}

/* Newton's method on the interpolated map. NONE: no image is near. Next to a fold, this map and the true one may
 * disagree about a pair of images that is about to merge. Such a place is reported as worth searching. */
static enum kd_star_root root_between(const struct kd_sky_map *map, struct kd_vec star, double *x, double *y)
{
    const double x0 = *x, y0 = *y;
    double px = x0, py = y0, nearest = INFINITY, best_x = x0, best_y = y0;
    for (int k = 0; k < STEPS && hypot(px - x0, py - y0) < KD_STAR_ROOT_NEAR; k++) {
        struct kd_sky_tangent at;
        if (!map->between(map->of, px, py, &at))
            break;
        const double off = kd_vec_apart(star, kd_vec_times(1 / sqrt(kd_vec_dot(at.n, at.n)), at.n));
        if (off < nearest)
            nearest = off, best_x = px, best_y = py;
        at.area = kd_vec_volume(at.n, at.across, at.down);
        const double far = step(&at, star, &px, &py);
        if (!isfinite(far))
            break;
        if (far < BETWEEN && off < 1) {
            *x = px, *y = py;
            return KD_STAR_ROOT_FOUND;
        }
    }
    *x = best_x, *y = best_y;
    return nearest < DOUBTFUL ? KD_STAR_ROOT_FOUND : KD_STAR_ROOT_NONE;
}

enum kd_star_root kd_star_root(const struct kd_sky_map *map, struct kd_vec star, double *x, double *y,
                               struct kd_sky_tangent *at)
{
    if (map->between && root_between(map, star, x, y) == KD_STAR_ROOT_NONE)
        return KD_STAR_ROOT_NONE;
    if (map->wanted && !map->wanted(map->of, *x, *y))
        return KD_STAR_ROOT_UNWANTED;
    if (!map->exact)
        return KD_STAR_ROOT_UNKNOWN;
    const double x0 = *x, y0 = *y;
    double far = INFINITY;
    bool steady = false;
    for (int k = 0; k < STEPS && hypot(*x - x0, *y - y0) < KD_STAR_ROOT_NEAR; k++) {
        if (!map->exact(map->of, *x, *y, &at->n) || (!steady && !set_slopes(map, *x, *y, false, at)))
            return k ? KD_STAR_ROOT_NONE : KD_STAR_ROOT_UNKNOWN;
        at->area = kd_vec_volume(at->n, at->across, at->down);
        const double before = far;
        far = step(at, star, x, y);
        steady = far < STEADY && far < SHRINKS * before;
        if (!isfinite(far))
            return KD_STAR_ROOT_NONE;
        if (far < EXACT)
            return kd_vec_dot(star, at->n) > 0 && set_slopes(map, *x, *y, true, at) ? KD_STAR_ROOT_FOUND
                                                                                    : KD_STAR_ROOT_NONE;
    }
    return KD_STAR_ROOT_NONE;
}
