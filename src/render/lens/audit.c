#include "render/lens/audit.h"

#include "render/view/layout.h"

#include "physics/spacetime/kerr.h"
#include "render/lens/label.h"
#include "render/lens/listed.h"
#include "scene/hole.h"

#include <math.h>
#include <stdlib.h>

enum { ROWS = 16, COLUMNS = KD_AUDIT_RAYS / ROWS };

struct sample {
    /* rows, columns: size of the sample; width, height: size of the grid of rays */
    uint32_t rows, columns, width, height;
    uint32_t planes;           /* number of planes of the map that are compared: radii and the fate */
    struct kd_vk_buffer *host; /* the sampled rows on the host: all planes of the first row, then all
                                * planes of the next, ... */
    double *rays;              /* alpha, beta */
    bool outward[ROWS * COLUMNS];
    struct kd_ray_crossing *crossings;
    struct kd_ray_end *ends;
    double *errors;
};

static uint32_t spread(uint32_t k, uint32_t n, uint32_t size) { return (uint32_t)((k + 0.5) / n * size); }

static enum kd_status read_rows(struct kd_renderer *r, const struct kd_plan *plan, const struct kd_lens_map *map,
                                const struct sample *s, struct kd_error *error)
{
    uint32_t band_rows = plan->picture.band_rows * plan->lens.side;
    uint64_t row = 4ull * s->width, stride = row * band_rows;
    enum kd_status status;
    for (uint32_t k = 0; k < s->rows; k++) {
        uint32_t y = spread(k, s->rows, s->height), band = y / band_rows;
        for (uint32_t n = 0; n < s->planes; n++) {
            uint32_t plane =
                n < plan->lens.orders ? n : kd_lens_plane(plan->lens.quantities, plan->lens.orders, KD_LENS_FATE);
            KD_TRY(kd_vk_copy(r->vk, "readback", s->host, (k * s->planes + n) * row, map->bands.buffers[band],
                              plane * stride + (y % band_rows) * row, row, error));
        }
    }
    KD_TRY(kd_vk_submit(r->vk, NULL, error));
    KD_TRY(kd_vk_wait(r->vk, 0, error));
done:
    return status;
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static bool other_fate(float fate, const struct kd_ray_end *end)
{
    return end->fate != KD_RAY_UNDECIDED && fate != (float)KD_FATE_UNDECIDED &&
           (fate == (float)KD_FATE_ESCAPED) != (end->fate == KD_RAY_ESCAPED);
}

/* Compares the map's radii and fates with those of the closed form. The planes hold w of `orders` crossings, and begin
 * `width` numbers apart. */
static void compare(const struct kd_plan_lens *lens, const struct sample *s, const uint32_t *place, uint32_t n,
                    double inner, struct kd_accuracy_report *out)
{
    const float *rows = kd_vk_buffer_map(s->host);
    uint32_t count = 0;
    for (uint32_t i = 0; i < n; i++) {
        const float *w = rows + place[i];
        for (uint32_t k = 0; k < lens->orders; k++, w += s->width) {
            bool has = k < s->ends[i].n_crossings;
            double r = has ? s->crossings[i * lens->orders + k].r : 1 / *w;
            if (!(r > inner && r < 1e3))
                continue;
            if (has && *w > 0)
                s->errors[count++] = fabs(1 / ((double)*w * r) - 1);
            else
                out->differ++;
        }
        out->differ += s->planes > lens->orders && other_fate(*w, &s->ends[i]);
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
    for (uint32_t j = 0; j < s->rows; j++)
        for (uint32_t i = 0; i < s->columns; i++, n++) {
            uint32_t x = spread(i, s->columns, s->width), y = spread(j, s->rows, s->height);
            struct kd_camera_label label;
            kd_lens_label(scene, &plan->lens, x, y, &label);
            s->rays[2 * n] = label.alpha;
            s->rays[2 * n + 1] = label.beta;
            s->outward[n] = label.outward;
            place[n] = j * s->planes * s->width + x;
        }
    const struct kd_ray_labels labels = { s->rays, s->outward, n };
    enum kd_status status;
    KD_TRY(read_rows(r, plan, map, s, error));
    KD_TRY(kd_lens_radii(scene, plan, &labels, s->crossings, s->ends, error));
    compare(&plan->lens, s, place, n, kd_kerr_isco(kd_scene_hole(scene)), out);
done:
    return status;
}

enum kd_status kd_audit(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                        const struct kd_lens_map *map, struct kd_accuracy_report *out, struct kd_error *error)
{
    struct sample s = { .width = plan->picture.width * plan->lens.side,
                        .height = plan->picture.height * plan->lens.side };
    *out = (struct kd_accuracy_report) { 0 };
    if (!plan->lens.audit)
        return KD_OK;
    s.rows = s.height < ROWS ? s.height : ROWS;
    s.columns = s.width < plan->lens.audit / ROWS ? s.width : plan->lens.audit / ROWS;
    s.planes = plan->lens.orders + kd_plan_holds(&plan->lens, KD_LENS_FATE);
    size_t n = (size_t)s.rows * s.columns;
    s.rays = malloc(2 * n * sizeof *s.rays);
    s.crossings = malloc(n * plan->lens.orders * sizeof *s.crossings);
    s.ends = malloc(n * sizeof *s.ends);
    s.errors = malloc(n * plan->lens.orders * sizeof *s.errors);
    enum kd_status status;
    if (!s.rays || !s.crossings || !s.ends || !s.errors)
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for the audit"));
    KD_TRY(kd_vk_buffer_create(renderer->vk, 4ull * s.rows * s.planes * s.width, KD_VK_READBACK, "audited rows",
                               &s.host, error));
    KD_TRY(run(renderer, scene, plan, map, &s, out, error));
done:
    kd_vk_buffer_destroy(renderer->vk, s.host);
    free(s.rays);
    free(s.crossings);
    free(s.ends);
    free(s.errors);
    return status;
}
