#include "render/sky/rim_images.h"

#include "render/view/rim_sky.h"
#include "render/view/sky_ray.h"

#include <math.h>
#include <stdlib.h>

#define SLACK 0.05 /* images up to this many rays outside a grid's part are examined as well */
#define BESIDE 4.0 /* images up to this many pixels outside the picture are examined as well */

/* The rays of one grid's part and their neighbours, as a map that begins at the grid's `column` and `row`. */
struct rim_map {
    const struct kd_rim *rim;
    const struct kd_rim_grid *grid;
    struct kd_sky_rays rays;
    const float *sky;     /* directions from kd_rim_sky */
    double width, height; /* size of the picture, in rays of its camera */
    uint32_t column, row, columns, rows;
    enum kd_status (*found)(void *user, const struct kd_star_image *image);
    void *user;
};

static void row_of(const void *of, uint32_t y, struct kd_vec *out)
{
    const struct rim_map *m = of;
    const size_t rays = kd_rim_grid_rays(m->grid);
    const float *at = m->sky + m->grid->first + (size_t)(m->row + y) * m->grid->columns + m->column;
    for (size_t k = 0; k < m->columns; k++)
        out[k] = (struct kd_vec) { at[k], at[rays + k], at[2 * rays + k] };
}

/* Turn of a column of the map, and logarithm of a row. */
static double turn_at(const struct rim_map *m, double column)
{
    return m->grid->u + (m->column + column) * m->grid->du;
}
static double log_at(const struct rim_map *m, double row) { return m->grid->l - (m->row + row) * m->grid->dl; }

static void look_at(const struct rim_map *m, double column, double row, double look[3])
{
    double place[2];
    kd_rim_place(m->rim, turn_at(m, column), exp(log_at(m, row)), place);
    kd_rim_look(m->rim, place, look);
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

/* Derivatives of the place in the picture by column and by row. */
struct change { double xc, yc, xr, yr; };

static bool change_at(const struct rim_map *m, double column, double row, struct change *o)
{
    const double h = 1e-3;
    double x[4], y[4];
    if (!seen(m, column - h, row, &x[0], &y[0]) || !seen(m, column + h, row, &x[1], &y[1]) ||
        !seen(m, column, row - h, &x[2], &y[2]) || !seen(m, column, row + h, &x[3], &y[3]))
        return false;
    *o = (struct change) { (x[1] - x[0]) / (2 * h), (y[1] - y[0]) / (2 * h), (x[3] - x[2]) / (2 * h),
                           (y[3] - y[2]) / (2 * h) };
    return true;
}

/* Pixels per square of rays. Computed from the curve's points in the grid's table. This is five times as fast as the
 * exact computation, and accurate enough for an estimate. */
static double pixels(const void *of, double column, double row)
{
    const struct rim_map *m = of;
    const uint32_t k = m->column + (uint32_t)column;
    const double part = column - floor(column), off = exp(log_at(m, row)), h = 1e-2;
    const float *at = m->sky + m->grid->table + KD_RIM_TABLE + 4 * k;
    double x[3], y[3];
    for (int i = 0; i < 3; i++) {
        const double along = part + (i == 1 ? h : 0), out = 1 + off * (i == 2 ? 1 - h * m->grid->dl : 1),
                     place[] = { out * (at[0] + along * at[2]), out * (at[1] + along * at[3]) };
        double look[3];
        kd_rim_look(m->rim, place, look);
        if (!kd_camera_seen(&m->rays.camera, look, &x[i], &y[i]))
            return 0;
    }
    return fabs((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])) / (h * h);
}

/* At t, the weights of the cubic through four values at -1, 0, 1 and 2, and the derivatives of these weights. */
static void cubic(double t, double w[4], double by[4])
{
    const double a = t + 1, b = t, c = t - 1, d = t - 2;
    w[0] = b * c * d / -6, w[1] = a * c * d / 2, w[2] = a * b * d / -2, w[3] = a * b * c / 6;
    by[0] = (b * c + b * d + c * d) / -6, by[1] = (a * c + a * d + c * d) / 2, by[2] = (a * b + a * d + b * d) / -2,
    by[3] = (a * b + a * c + b * c) / 6;
}

/* Finds the ray before a place. Returns false unless the grid has one more ray before it and two after it. */
static bool cell_of(double place, uint32_t all, uint32_t *first, double *part)
{
    const double low = floor(place);
    *part = place - low;
    *first = (uint32_t)(low - 1);
    return low >= 1 && low + 3 <= all;
}

/* The tangent between rays by bicubic interpolation. Rays are KD_RIM_STEP apart, so the error is about 1e-5 rad. */
static bool between(const void *of, double column, double row, struct kd_sky_tangent *out)
{
    const struct rim_map *m = of;
    const size_t rays = kd_rim_grid_rays(m->grid);
    double p[2], w[2][4], by[2][4], sum[3][3] = { { 0 } };
    uint32_t x, y;
    if (!cell_of(m->column + column, m->grid->columns, &x, &p[0]) || !cell_of(m->row + row, m->grid->rows, &y, &p[1]))
        return false;
    cubic(p[0], w[0], by[0]);
    cubic(p[1], w[1], by[1]);
    for (int q = 0; q < 3; q++)
        for (uint32_t j = 0; j < 4; j++) {
            const float *at = m->sky + m->grid->first + q * rays + (size_t)(y + j) * m->grid->columns + x;
            const double n = w[0][0] * at[0] + w[0][1] * at[1] + w[0][2] * at[2] + w[0][3] * at[3];
            sum[0][q] += w[1][j] * n;
            sum[1][q] += w[1][j] * (by[0][0] * at[0] + by[0][1] * at[1] + by[0][2] * at[2] + by[0][3] * at[3]);
            sum[2][q] += by[1][j] * n;
        }
    out->n = (struct kd_vec) { sum[0][0], sum[0][1], sum[0][2] };
    out->across = (struct kd_vec) { sum[1][0], sum[1][1], sum[1][2] };
    out->down = (struct kd_vec) { sum[2][0], sum[2][1], sum[2][2] };
    return true;
}

/* True if a place is at a border or beyond it. From either side of the border, Newton's method finds slightly
 * different places for the same image. The tolerance exceeds their difference. */
static bool is_from(double place, double border) { return place > border - 1e-8; }

/* True if a place is in the grid's own part, and in the picture or close to it. */
static bool wanted(const void *of, double column, double row)
{
    const struct rim_map *m = of;
    const double u = turn_at(m, column), l = log_at(m, row), du = SLACK * m->grid->du, dl = SLACK * m->grid->dl;
    double x, y;
    return u > m->grid->low_u - du && u < m->grid->high_u + du && l > m->grid->low_l - dl && l < m->grid->high_l + dl &&
           seen(m, column, row, &x, &y) && x > -BESIDE && y > -BESIDE && x < m->width + BESIDE &&
           y < m->height + BESIDE;
}

/* Converts an image from the rim's columns and rows to the picture's. */
static enum kd_status hand_on(void *user, const struct kd_star_image *image)
{
    const struct rim_map *m = user;
    struct kd_star_image o = *image;
    struct change by;
    const double u = turn_at(m, image->x), l = log_at(m, image->y);
    if (!is_from(u, m->grid->low_u) || is_from(u, m->grid->high_u) || !is_from(l, m->grid->low_l) ||
        is_from(l, m->grid->high_l))
        return KD_OK; /* the image belongs to another grid */
    if (!seen(m, image->x, image->y, &o.x, &o.y) || !change_at(m, image->x, image->y, &by))
        return KD_OK;
    const double area = by.xc * by.yr - by.yc * by.xr;
    o.solid_angle /= fabs(area);
    o.by = (struct kd_star_stencil) { .x = o.x, .y = o.y };
    o.mirrored ^= area < 0;
    o.x_by_azimuth = by.xc * image->x_by_azimuth + by.xr * image->y_by_azimuth;
    o.y_by_azimuth = by.yc * image->x_by_azimuth + by.yr * image->y_by_azimuth;
    return m->found(m->user, &o);
}

static uint32_t rays_before(double at, double from, double by)
{
    return isfinite(at) ? (uint32_t)((at - from) / by) - 1 : KD_RIM_HALO - 1;
}
static uint32_t rays_until(double at, double from, double by, uint32_t all)
{
    return isfinite(at) ? (uint32_t)ceil((at - from) / by) + 2 : all - KD_RIM_HALO + 1;
}

static enum kd_status in_grid(struct rim_map *m, const struct kd_vec *stars, const double *most, size_t n)
{
    const struct kd_rim_grid *g = m->grid;
    m->column = rays_before(g->low_u, g->u, g->du);
    m->columns = rays_until(g->high_u, g->u, g->du, g->columns) - m->column;
    m->row = rays_before(g->high_l, g->l, -g->dl);
    m->rows = rays_until(g->low_l, g->l, -g->dl, g->rows) - m->row;
    const struct kd_sky_map map = {
        .width = m->columns,
        .height = m->rows,
        .coarse = KD_RIM_COARSE,
        .most = most,
        .pixels = pixels,
        .of = m,
        .row = row_of,
        .exact = exact,
        .between = between,
        .wanted = wanted,
    };
    return kd_star_images(&map, stars, n, hand_on, m);
}

enum kd_status kd_rim_images(const struct kd_scene *scene, const struct kd_rim *rim, const struct kd_vec *stars,
                             const double *most, size_t n,
                             enum kd_status (*found)(void *user, const struct kd_star_image *image), void *user,
                             struct kd_error *error)
{
    struct kd_rim_grids *grids = malloc(sizeof *grids);
    float *sky = NULL;
    enum kd_status status = KD_OK;
    if (!grids)
        KD_TRY(KD_ENOMEM);
    kd_rim_grids_of(scene, rim, grids);
    sky = malloc(grids->numbers * sizeof *sky);
    if (!sky)
        KD_TRY(KD_ENOMEM);
    struct rim_map m = { .rim = rim,
                         .rays = kd_sky_rays_of(scene),
                         .sky = sky,
                         .width = kd_scene_side(scene) * scene->image.width,
                         .height = kd_scene_side(scene) * scene->image.height,
                         .found = found,
                         .user = user };
    KD_TRY(kd_rim_sky(scene, rim, grids, sky, error));
    for (uint32_t i = 0; i < grids->n; i++) {
        m.grid = &grids->of[i];
        KD_TRY(in_grid(&m, stars, most, n));
    }
done:
    free(sky);
    free(grids);
    return status;
}
