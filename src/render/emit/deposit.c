#include "render/emit/deposit.h"

#include "render/emit/emitter.h"
#include "render/view/layout.h"

#include "density.spv.h"
#include "particles.spv.h"

#include <math.h>
#include <string.h>

#define SLICE_MS 40.0

/* Name under which commands are timed. */
static const char PASS[] = "particles";

static const struct kd_vk_pipeline_params particles = { "particles", kd_spv_particles, sizeof kd_spv_particles, 2,
                                                        sizeof(struct kd_particles_push) };
static const struct kd_vk_pipeline_params density = { "density", kd_spv_density, sizeof kd_spv_density, 3, 4 };

struct own {
    /* buffers that are made when first needed and then kept */
    struct kd_vk_buffer *guides, *staging, *grid, *density, *list;
    struct kd_scene of; /* the scene for which `guides` is filled */
    double time;        /* the time for which `guides` is filled; it does not change between slices of a list or while a
                         * frame is refined */
};

static enum kd_status guides(const struct kd_emitter_buffers_work *w, const struct kd_scene *scene,
                             const struct kd_particle_grid *grid, double time, struct kd_error *error)
{
    struct own *p = w->own;
    uint64_t bytes = kd_particle_tables_bytes(grid);
    enum kd_status status =
        kd_emitter_buffers_at_least(w, &p->guides, bytes, KD_VK_DEVICE, "orbits of particles", error);
    if (!status)
        status =
            kd_emitter_buffers_at_least(w, &p->staging, bytes, KD_VK_UPLOAD, "orbits of particles on the host", error);
    bool there = p->time == time && !memcmp(&p->of, scene, sizeof *scene);
    p->time = status ? NAN : time;
    if (status || there)
        return status;
    memcpy(&p->of, scene, sizeof *scene); /* includes padding, because scenes are compared by memcmp */
    kd_particle_tables_fill(kd_vk_buffer_map(p->staging), scene, grid, time);
    return kd_vk_copy(w->vk, "upload", p->guides, 0, p->staging, 0, bytes, error);
}

static void forget(void *own) { ((struct own *)own)->time = NAN; }

static uint32_t groups(uint32_t n) { return (n + KD_GROUP_SIZE - 1) / KD_GROUP_SIZE; }

/* Runs the kernel over the particles from push->first up to `end`. Either all of them fall or all of them orbit,
 * because in a kernel with both branches lavapipe would execute both. */
static enum kd_status share_out(const struct kd_emitter_buffers_work *w, const struct kd_scene *scene, bool plunge,
                                struct kd_particles_push *push, uint32_t end, struct kd_error *error)
{
    const struct own *p = w->own;
    const struct kd_vk_pipeline *kernel;
    const struct kd_spec_particles spec = { .SWING = scene->disk.epicycles > 0, .PLUNGE = plunge };
    enum kd_status status;
    double slice = fmax(KD_GROUP_SIZE, fmin(SLICE_MS * 1e6 / fmax(w->ns, 1e-3),
                                            (double)kd_vk_info(w->vk)->max_groups_x * KD_GROUP_SIZE));
    KD_TRY(kd_emitter_buffers_kernel(w, &particles, &spec.SWING, sizeof spec / 4, &kernel, error));
    for (; push->first < end; push->first += push->count) {
        uint32_t left = end - push->first;
        push->count = left < slice ? left : (uint32_t)slice;
        const struct kd_vk_dispatch d = {
            PASS, kernel, { { p->guides, 0, 0, false }, { p->grid, 0, 0, true } }, push, { groups(push->count) },
        };
        KD_TRY(kd_vk_dispatch(w->vk, &d, error));
        KD_TRY(kd_vk_submit(w->vk, NULL, error));
    }
done:
    return status;
}

/* Converts weights to densities on one grid. at: byte at which the grid starts in both buffers; expected: byte at
 * which the expected numbers of the grid's rows start. */
static enum kd_status divide(const struct kd_emitter_buffers_work *w, uint64_t at, uint64_t expected, uint32_t rows,
                             uint32_t columns, struct kd_error *error)
{
    const struct own *p = w->own;
    const struct kd_vk_pipeline *kernel;
    enum kd_status status = kd_emitter_buffers_kernel(w, &density, NULL, 0, &kernel, error);
    if (status)
        return status;
    const struct kd_vk_dispatch d = {
        PASS,
        kernel,
        { { p->grid, at, 0, false }, { p->guides, expected, 0, false }, { p->density, at, 0, true } },
        &columns,
        { groups(columns), rows + 1 },
    };
    return kd_vk_dispatch(w->vk, &d, error);
}

static enum kd_status prepare(const struct kd_emitter_buffers_work *w, const struct kd_scene *scene,
                              struct kd_error *error)
{
    struct own *p = w->own;
    const struct kd_particle_grid grid = kd_particle_grid(scene);
    const uint64_t words = kd_particle_words(&grid), bytes = 4 * (words + kd_particle_plunge_words(&grid));
    const uint64_t expected = kd_particle_guides_bytes(&grid);
    const double time = scene->top.time - kd_particle_delay(scene);
    struct kd_particles_push push = kd_particle_push(scene, &grid, time);
    enum kd_status status;
    KD_TRY(guides(w, scene, &grid, time, error));
    KD_TRY(kd_emitter_buffers_at_least(w, &p->grid, bytes, KD_VK_DEVICE, "particles", error));
    KD_TRY(kd_emitter_buffers_at_least(w, &p->density, bytes, KD_VK_DEVICE, "density of particles", error));
    KD_TRY(kd_vk_fill(w->vk, PASS, p->grid, 0, bytes, 0, error));
    if (grid.plunging)
        KD_TRY(share_out(w, scene, true, &push, grid.plunging, error));
    KD_TRY(share_out(w, scene, false, &push, grid.count, error));
    KD_TRY(divide(w, 0, expected, grid.rows, grid.columns, error));
    if (grid.plunging)
        KD_TRY(
            divide(w, 4 * words, expected + KD_PARTICLE_EXPECTED_BYTES, grid.plunge_rows, grid.plunge_columns, error));
    KD_TRY(kd_vk_submit(w->vk, NULL, error));
done:
    return status;
}

static void buffers(const void *own, struct kd_vk_buffer *out[KD_OWN_COUNT])
{
    out[KD_OWN_density] = ((const struct own *)own)->density;
}

static enum kd_status list_kernel(const struct kd_emitter_buffers_work *w, const struct kd_scene *scene,
                                  const struct kd_vk_pipeline **out, struct kd_error *error)
{
    const struct kd_spec_particles spec = { .SWING = scene->disk.epicycles > 0,
                                            .LIST = true,
                                            .PLUNGE = kd_particle_grid(scene).plunging > 0 };
    return kd_emitter_buffers_kernel(w, &particles, &spec.SWING, sizeof spec / 4, out, error);
}

enum kd_status kd_particles_ask(const struct kd_emitter_buffers_work *work, const struct kd_scene *scene)
{
    const struct kd_vk_pipeline *later;
    return list_kernel(work, scene, &later, NULL);
}

enum kd_status kd_particles_places(const struct kd_emitter_buffers_work *w, const struct kd_scene *scene,
                                   uint32_t first, uint32_t stride, size_t n, struct kd_particle_place *out,
                                   struct kd_error *error)
{
    struct own *p = w->own;
    const struct kd_particle_grid grid = kd_particle_grid(scene);
    const struct kd_vk_pipeline *kernel = NULL;
    struct kd_particles_push push = kd_particle_push(scene, &grid, scene->top.time);
    push.first = first;
    push.stride = stride;
    push.count = (uint32_t)n;
    enum kd_status status;
    KD_TRY(guides(w, scene, &grid, scene->top.time, error));
    KD_TRY(kd_emitter_buffers_at_least(w, &p->list, n * sizeof(struct kd_particle_listed), KD_VK_READBACK,
                                       "places of particles", error));
    KD_TRY(list_kernel(w, scene, &kernel, error));
    const struct kd_vk_dispatch d = {
        PASS, kernel, { { p->guides, 0, 0, false }, { p->list, 0, 0, true } }, &push, { groups(push.count) },
    };
    KD_TRY(kd_vk_dispatch(w->vk, &d, error));
    KD_TRY(kd_vk_submit(w->vk, NULL, error));
    KD_TRY(kd_vk_wait(w->vk, 0, error));
    kd_particle_places_of(scene, &grid, kd_vk_buffer_map(p->list), first, stride, n, out);
done:
    if (status)
        forget(p);
    return status;
}

static void finish(void *own, struct kd_vk *vk)
{
    struct own *p = own;
    struct kd_vk_buffer *buffers[] = { p->guides, p->staging, p->grid, p->density, p->list };
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
        kd_vk_buffer_destroy(vk, buffers[i]);
    memset(p, 0, sizeof *p);
}

const struct kd_emitter_buffers kd_emitter_buffers_particles = { sizeof(struct own), prepare, buffers, forget, finish };
