#include "render/device/deposit.h"

#include "render/device/internal.h"
#include "render/view/layout.h"

#include <math.h>
#include <string.h>

#define SLICE_MS 40.0

static enum kd_status guides(struct kd_renderer *r, struct kd_particles *p, const struct kd_scene *scene,
                             const struct kd_particle_grid *grid, double time, struct kd_error *error)
{
    uint64_t bytes = kd_particle_tables_bytes(grid);
    enum kd_status status = kd_store_at_least(r->vk, &p->guides, bytes, KD_VK_DEVICE, "orbits of particles", error);
    if (!status)
        status = kd_store_at_least(r->vk, &p->staging, bytes, KD_VK_UPLOAD, "orbits of particles on the host", error);
    bool there = p->time == time && !memcmp(&p->of, scene, sizeof *scene);
    p->time = status ? NAN : time;
    if (status || there)
        return status;
    memcpy(&p->of, scene, sizeof *scene); /* padding too */
    kd_particle_tables_fill(kd_vk_buffer_map(p->staging), scene, grid, time);
    return kd_vk_copy(r->vk, "upload", p->guides, 0, p->staging, 0, bytes, error);
}

static void forget(struct kd_prepared *own) { own->particles.time = NAN; }

static uint32_t groups(uint32_t n) { return (n + KD_GROUP_SIZE - 1) / KD_GROUP_SIZE; }

/* The particles from push->first up to `end`, which fall or do not: lavapipe takes both ways where a kernel has two. */
static enum kd_status share_out(struct kd_renderer *r, struct kd_particles *p, const struct kd_scene *scene, bool plunge,
                                struct kd_particles_push *push, uint32_t end, double ns_per_particle, struct kd_error *error)
{
    const struct kd_vk_pipeline *kernel;
    const struct kd_spec_particles spec = { .SWING = scene->disk.epicycles > 0, .PLUNGE = plunge };
    enum kd_status status;
    double slice = fmax(KD_GROUP_SIZE, fmin(SLICE_MS * 1e6 / fmax(ns_per_particle, 1e-3), (double)kd_vk_info(r->vk)->max_groups_x * KD_GROUP_SIZE));
    KD_TRY(kd_kernels_get(&r->kernels, r->vk, KD_KERNEL_PARTICLES, &spec.SWING, sizeof spec / 4, &kernel, error));
    for (; push->first < end; push->first += push->count) {
        uint32_t left = end - push->first;
        push->count = left < slice ? left : (uint32_t)slice;
        const struct kd_vk_dispatch d = {
            kd_passes[KD_PASS_PARTICLES].name, kernel, { { p->guides, 0, 0, false }, { p->grid, 0, 0, true } }, push,
            { groups(push->count) },
        };
        KD_TRY(kd_vk_dispatch(r->vk, &d, error));
        KD_TRY(kd_vk_submit(r->vk, NULL, error));
    }
done:
    return status;
}

/* Makes densities of weights, on one of the grids: from byte `at` of both, what its rows expect from byte `expected`. */
static enum kd_status divide(struct kd_renderer *r, const struct kd_particles *p, uint64_t at, uint64_t expected, uint32_t rows,
                             uint32_t columns, struct kd_error *error)
{
    const struct kd_vk_pipeline *kernel;
    enum kd_status status = kd_kernels_get(&r->kernels, r->vk, KD_KERNEL_DENSITY, NULL, 0, &kernel, error);
    if (status)
        return status;
    const struct kd_vk_dispatch d = {
        kd_passes[KD_PASS_PARTICLES].name, kernel,
        { { p->grid, at, 0, false },
          { p->guides, expected, 0, false },
          { p->density, at, 0, true } },
        &columns, { groups(columns), rows + 1 },
    };
    return kd_vk_dispatch(r->vk, &d, error);
}

static enum kd_status prepare(struct kd_renderer *r, struct kd_prepared *own, const struct kd_scene *scene, const struct kd_capacity *c,
                              struct kd_error *error)
{
    struct kd_particles *p = &own->particles;
    const struct kd_particle_grid grid = kd_particle_grid(scene);
    const uint64_t words = kd_particle_words(&grid), bytes = 4 * (words + kd_particle_plunge_words(&grid));
    const uint64_t expected = kd_particle_guides_bytes(&grid);
    const double time = scene->top.time - kd_particle_delay(scene), ns = c->ns[KD_NS_PARTICLE];
    struct kd_particles_push push = kd_particle_push(scene, &grid, time);
    enum kd_status status;
    KD_TRY(guides(r, p, scene, &grid, time, error));
    KD_TRY(kd_store_at_least(r->vk, &p->grid, bytes, KD_VK_DEVICE, "particles", error));
    KD_TRY(kd_store_at_least(r->vk, &p->density, bytes, KD_VK_DEVICE, "density of particles", error));
    KD_TRY(kd_vk_fill(r->vk, kd_passes[KD_PASS_PARTICLES].name, p->grid, 0, bytes, 0, error));
    if (grid.plunging)
        KD_TRY(share_out(r, p, scene, true, &push, grid.plunging, ns, error));
    KD_TRY(share_out(r, p, scene, false, &push, grid.count, ns, error));
    KD_TRY(divide(r, p, 0, expected, grid.rows, grid.columns, error));
    if (grid.plunging)
        KD_TRY(divide(r, p, 4 * words, expected + KD_PARTICLE_EXPECTED_BYTES, grid.plunge_rows, grid.plunge_columns, error));
    KD_TRY(kd_vk_submit(r->vk, NULL, error));
done:
    return status;
}

static void buffers(const struct kd_prepared *own, struct kd_vk_buffer *out[KD_OWN_COUNT]) { out[KD_OWN_density] = own->particles.density; }

enum kd_status kd_particles_places(struct kd_renderer *r, const struct kd_scene *scene, uint32_t first, uint32_t stride,
                                   size_t n, struct kd_particle_place *out, struct kd_error *error)
{
    struct kd_particles *p = &r->prepared.particles;
    const struct kd_particle_grid grid = kd_particle_grid(scene);
    const struct kd_vk_pipeline *kernel = NULL;
    const struct kd_spec_particles spec = { .SWING = scene->disk.epicycles > 0, .LIST = true, .PLUNGE = grid.plunging > 0 };
    struct kd_particles_push push = kd_particle_push(scene, &grid, scene->top.time);
    push.first = first;
    push.stride = stride;
    push.count = (uint32_t)n;
    enum kd_status status;
    KD_TRY(guides(r, p, scene, &grid, scene->top.time, error));
    KD_TRY(kd_store_at_least(r->vk, &p->list, n * sizeof(struct kd_particle_listed), KD_VK_READBACK, "places of particles", error));
    KD_TRY(kd_kernels_get(&r->kernels, r->vk, KD_KERNEL_PARTICLES, &spec.SWING, sizeof spec / 4, &kernel, error));
    const struct kd_vk_dispatch d = {
        kd_passes[KD_PASS_PARTICLES].name, kernel, { { p->guides, 0, 0, false }, { p->list, 0, 0, true } }, &push,
        { groups(push.count) },
    };
    KD_TRY(kd_vk_dispatch(r->vk, &d, error));
    KD_TRY(kd_vk_submit(r->vk, NULL, error));
    KD_TRY(kd_vk_wait(r->vk, 0, error));
    kd_particle_places_of(scene, &grid, kd_vk_buffer_map(p->list), first, stride, n, out);
done:
    if (status)
        forget(&r->prepared);
    return status;
}

static void finish(struct kd_prepared *own, struct kd_vk *vk)
{
    struct kd_particles *p = &own->particles;
    struct kd_vk_buffer *buffers[] = { p->guides, p->staging, p->grid, p->density, p->list };
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
        kd_vk_buffer_destroy(vk, buffers[i]);
    memset(p, 0, sizeof *p);
}

const struct kd_preparation kd_prepare_particles = { prepare, buffers, forget, finish };
