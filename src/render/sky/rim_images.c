#include "render/sky/rim_images.h"

#include "render/view/rim_sky.h"
#include "render/view/sky_ray.h"

#include <math.h>
#include <stdlib.h>

struct rim_map {
    const struct kd_rim *rim;
    struct kd_sky_rays rays;
    const float *sky; /* of rim_sky.h */
    enum kd_status (*found)(void *user, const struct kd_star_image *image);
    void *user;
};

static void row_of(const void *of, uint32_t y, struct kd_vec *out)
{
    const struct rim_map *m = of;
    const size_t rays = kd_rim_rays(m->rim);
    const float *at = m->sky + (size_t)y * KD_RIM_ANGLES;
    for (size_t k = 0; k < KD_RIM_ANGLES; k++)
        out[k] = (struct kd_vec) { at[k], at[rays + k], at[2 * rays + k] };
}

static void look_at(const struct rim_map *m, double column, double row, double look[3])
{
    double place[2];
    kd_rim_between(m->rim, column, row, place);
    kd_rim_look(m->rim, place[0], place[1], look);
}

static bool exact(const void *of, double column, double row, struct kd_vec *out)
{
    const struct rim_map *m = of;
    double look[3], n[3];
    look_at(m, column, row, look);
    if (!kd_sky_ray(&m->rays, look, n))
        return false;
    *out = (struct kd_vec) { n[0], n[1], n[2] };
    return true;
}

static bool seen(const struct rim_map *m, double column, double row, double *x, double *y)
{
    double look[3];
    look_at(m, column, row, look);
    return kd_camera_seen(&m->rays.camera, look, x, y);
}

/* How the place in the picture goes by with column and row. */
struct change { double xc, yc, xr, yr; };

static bool change_at(const struct rim_map *m, double column, double row, struct change *o)
{
    const double h = 1e-3;
    double x[4], y[4];
    if (!seen(m, column - h, row, &x[0], &y[0]) || !seen(m, column + h, row, &x[1], &y[1]) || !seen(m, column, row - h, &x[2], &y[2]) || !seen(m, column, row + h, &x[3], &y[3]))
        return false;
    *o = (struct change) { (x[1] - x[0]) / (2 * h), (y[1] - y[0]) / (2 * h), (x[3] - x[2]) / (2 * h), (y[3] - y[2]) / (2 * h) };
    return true;
}

static double pixels(const void *of, double column, double row)
{
    struct change o;
    return change_at(of, column, row, &o) ? fabs(o.xc * o.yr - o.yc * o.xr) : 0;
}

/* From the rim's columns and rows to the picture's. */
static enum kd_status hand_on(void *user, const struct kd_star_image *image)
{
    const struct rim_map *m = user;
    struct kd_star_image o = *image;
    struct change by;
    if (!seen(m, image->x, image->y, &o.x, &o.y) || !change_at(m, image->x, image->y, &by))
        return KD_OK;
    const double area = by.xc * by.yr - by.yc * by.xr;
    o.solid_angle /= fabs(area);
    o.mirrored ^= area < 0;
    o.x_by_azimuth = by.xc * image->x_by_azimuth + by.xr * image->y_by_azimuth;
    o.y_by_azimuth = by.yc * image->x_by_azimuth + by.yr * image->y_by_azimuth;
    return m->found(m->user, &o);
}

enum kd_status kd_rim_images(const struct kd_scene *scene, const struct kd_rim *rim, const struct kd_vec *stars, const double *most, size_t n,
                             enum kd_status (*found)(void *user, const struct kd_star_image *image), void *user, struct kd_error *error)
{
    float *sky = malloc((3 * kd_rim_rays(rim) + 1) * sizeof *sky);
    struct rim_map m = { rim, kd_sky_rays_of(scene), sky, found, user };
    enum kd_status status = KD_OK;
    if (!rim->rows)
        goto done;
    if (!sky)
        KD_TRY(KD_ENOMEM);
    KD_TRY(kd_rim_sky(scene, rim, sky, error));
    const struct kd_sky_map map = {
        .width = KD_RIM_ANGLES, .height = rim->rows, .round = true, .coarse = KD_RIM_COARSE, .most = most, .pixels = pixels, .of = &m, .row = row_of, .exact = exact,
    };
    status = kd_star_images(&map, stars, n, hand_on, &m);
done:
    free(sky);
    return status;
}
