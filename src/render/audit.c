#include "render/audit.h"

#include "physics/kerr.h"
#include "render/camera.h"

#include <math.h>
#include <stdlib.h>

enum { ROWS = 16, COLUMNS = KD_AUDIT_RAYS / ROWS, STEPS = 32 }; /* double precision with 32 steps a half turn: 1e-10 */

struct sample {
    uint32_t rows, columns, width, height; /* of the grid of rays */
    struct kd_vk_buffer *host;             /* the sampled rows, all orders of one row together */
    double *rays;                          /* alpha, beta */
    struct kd_ray_crossing *crossings;
    struct kd_ray_end *ends;
    double *errors;
};

static uint32_t spread(uint32_t k, uint32_t n, uint32_t size) { return (uint32_t)((k + 0.5) / n * size); }

/* The labels of a pixel's ray, with the kernel's own arithmetic; false for a ray that starts outwards, which the list of rays does
 * not know. */
static bool labels(const struct kd_camera_push *c, bool finite, uint32_t px, uint32_t py, double *out)
{
    float x = (float)px - c->middle_x, y = c->middle_y - (float)py;
    float kx = c->c0x + x * c->cxx + y * c->cyx, ky = c->c0y + x * c->cxy + y * c->cyy;
    if (!finite) {
        out[0] = kx;
        out[1] = ky;
        return true;
    }
    float kz = c->c0z + x * c->cxz + y * c->cyz, n = 1 / sqrtf(kx * kx + ky * ky + kz * kz);
    double m_phi = -kz * n, energy = c->e0 + c->e1 * m_phi;
    out[0] = -(c->l0 + c->l1 * m_phi) / energy;
    out[1] = -c->cp * ky * n / energy;
    return kx < 0 && energy > 0;
}

static enum kd_status read_rows(struct kd_renderer *r, const struct kd_plan *plan, const struct kd_lens_map *map,
                                const struct sample *s, struct kd_error *error)
{
    uint32_t band_rows = plan->band_rows * plan->side;
    uint64_t row = 4ull * s->width, stride = row * band_rows;
    enum kd_status status = KD_OK;
    for (uint32_t k = 0; k < s->rows && !status; k++) {
        uint32_t y = spread(k, s->rows, s->height), band = y / band_rows;
        for (uint32_t n = 0; n < plan->orders && !status; n++)
            status = kd_vk_copy(r->vk, "audit", s->host, (k * plan->orders + n) * row, map->bands.buffers[band],
                                n * stride + (y % band_rows) * row, row, error);
    }
    if (!status)
        status = kd_vk_submit(r->vk, NULL, error);
    return status ? status : kd_vk_wait(r->vk, 0, error);
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Compare the map's radii (w of `orders` crossings at a distance of `width`) with the list's. */
static void compare(const struct kd_plan *plan, const struct sample *s, const uint32_t *place, uint32_t n, double inner,
                    struct kd_accuracy_report *out)
{
    const float *rows = kd_vk_buffer_map(s->host);
    uint32_t count = 0;
    for (uint32_t i = 0; i < n; i++) {
        const float *w = rows + place[i];
        for (uint32_t k = 0; k < plan->orders; k++, w += s->width) {
            bool has = k < s->ends[i].n_crossings;
            double r = has ? s->crossings[i * plan->orders + k].r : 1 / *w;
            if (!(r > inner && r < 1e3))
                continue;
            if (has && *w > 0)
                s->errors[count++] = fabs(1 / ((double)*w * r) - 1);
            else
                out->differ++;
        }
    }
    qsort(s->errors, count, sizeof *s->errors, by_value);
    out->sampled = n;
    out->crossings = count;
    out->median = count ? s->errors[count / 2] : 0;
    out->worst = count ? s->errors[count - 1] : 0;
}

static enum kd_status run(struct kd_renderer *r, const struct kd_scene *scene, const struct kd_plan *plan,
                          const struct kd_lens_map *map, struct sample *s, struct kd_accuracy_report *out,
                          struct kd_error *error)
{
    uint32_t place[ROWS * COLUMNS], n = 0;
    struct kd_camera_push camera = kd_camera_push(scene);
    bool finite = !isinf(scene->camera.r);
    for (uint32_t j = 0; j < s->rows; j++)
        for (uint32_t i = 0; i < s->columns; i++) {
            uint32_t x = spread(i, s->columns, s->width), y = spread(j, s->rows, s->height);
            if (labels(&camera, finite, x, y, &s->rays[2 * n]))
                place[n++] = j * plan->orders * s->width + x;
        }
    const struct kd_rays_params params = {
        .spin = scene->spacetime.spin, .r = scene->camera.r, .inclination_deg = scene->camera.inclination_deg,
        .orders = plan->orders, .engine = KD_ENGINE_MINO_RKN6, .precision = KD_PRECISION_F64, .steps = STEPS,
    };
    enum kd_status status = read_rows(r, plan, map, s, error);
    if (!status && n)
        status = kd_rays_device(r, &params, s->rays, n, s->crossings, s->ends, NULL, NULL, error);
    if (!status && n)
        compare(plan, s, place, n, kd_kerr_isco(scene->spacetime.spin), out);
    return status;
}

enum kd_status kd_audit(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                        const struct kd_lens_map *map, struct kd_accuracy_report *out, struct kd_error *error)
{
    struct sample s = { .width = plan->width * plan->side, .height = plan->height * plan->side };
    *out = (struct kd_accuracy_report){ 0 };
    if (!plan->audit)
        return KD_OK;
    s.rows = s.height < ROWS ? s.height : ROWS;
    s.columns = s.width < COLUMNS ? s.width : COLUMNS;
    size_t n = (size_t)s.rows * s.columns;
    s.rays = malloc(2 * n * sizeof *s.rays);
    s.crossings = malloc(n * plan->orders * sizeof *s.crossings);
    s.ends = malloc(n * sizeof *s.ends);
    s.errors = malloc(n * plan->orders * sizeof *s.errors);
    enum kd_status status = KD_OK;
    if (!s.rays || !s.crossings || !s.ends || !s.errors)
        status = kd_error_set(error, KD_ENOMEM, "out of memory for the audit");
    if (!status)
        status = kd_vk_buffer_create(renderer->vk, 4ull * s.rows * plan->orders * s.width, KD_VK_READBACK, "audited rows",
                                     &s.host, error);
    if (!status)
        status = run(renderer, scene, plan, map, &s, out, error);
    kd_vk_buffer_destroy(renderer->vk, s.host);
    free(s.rays);
    free(s.crossings);
    free(s.ends);
    free(s.errors);
    return status;
}
