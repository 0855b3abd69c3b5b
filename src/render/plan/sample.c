#include "render/plan/sample.h"

#include "interface.h"

#include "scene/sha256.h"

#include <math.h>
#include <stdio.h>

/* Numbers along the side of a block. EVEN: number of even places; LAST: number of cells of the last level. */
enum { EVEN = KD_CELL_BLOCK / 2, LAST = KD_CELL_BLOCK / 8 };
#define MOST_COLUMNS (1u << KD_PLACE_BITS)
#define MOST_ROWS (1u << (32 - KD_PLACE_BITS))
/* rays sampled at once. All of them may be undecided, and one dispatch then has 16384 workgroups, a quarter of what any
 * device allows */
#define RAYS_AT_ONCE KD_GIVEN_MOST

/* Bytes that every device can bind as one storage buffer (Vulkan 1.2, 42.1: maxStorageBufferRange). */
#define BOUND_EVERYWHERE (UINT64_C(1) << 27)

/* First place of the block that contains a place. */
static int64_t block_of(int64_t place) { return place / KD_CELL_BLOCK * KD_CELL_BLOCK; }

static uint64_t least_of(uint64_t a, uint64_t b) { return a < b ? a : b; }

static uint32_t blocks(int64_t origin, int64_t end) { return (uint32_t)((end - origin - 1) / KD_CELL_BLOCK + 1); }

struct kd_sample_grid kd_sample_grid(const struct kd_plan *plan, uint32_t left, uint32_t top, uint32_t row0,
                                     uint32_t rows)
{
    const int64_t width = (int64_t)plan->picture.width * plan->lens.side, y = (int64_t)top + row0;
    struct kd_sample_grid grid = {
        .origin_x = (int32_t)(block_of(left) - left),
        .origin_y = (int32_t)(block_of(y) - top),
        .blocks_x = blocks(block_of(left), left + width),
        .blocks_y = blocks(block_of(y), y + rows),
    };
    const uint64_t n = (uint64_t)grid.blocks_x * grid.blocks_y,
                   even = (uint64_t)(EVEN * grid.blocks_x + 1) * (EVEN * grid.blocks_y + 1);
    grid.room = (uint32_t)(even + 2ull * LAST * LAST * n);
    grid.places = (uint32_t)(KD_SAMPLE_QUEUES + (KD_SAMPLE_QUEUED + 2 * KD_SAMPLE_UNITS) * n);
    grid.alone = grid.places + grid.room;
    grid.list_bytes = 4 * (grid.alone + (uint64_t)width * rows);
    grid.index_bytes = 4 * (even + 2ull * LAST * LAST * n);
    grid.node_bytes = 4ull * (plan->lens.planes + KD_NODE_OWN) * grid.room;
    return grid;
}

static struct kd_sample_grid largest(const struct kd_plan *plan, uint32_t rows)
{
    return kd_sample_grid(plan, KD_CELL_BLOCK - 1, KD_CELL_BLOCK - 1, 0, rows * plan->lens.side);
}

static bool fits(const struct kd_plan *plan, uint32_t rows, uint64_t bytes)
{
    const struct kd_sample_grid most = largest(plan, rows);
    return most.list_bytes <= bytes && most.index_bytes <= bytes && most.node_bytes <= bytes;
}

void kd_sample_fit(struct kd_plan *plan, uint64_t bytes)
{
    const uint64_t row = (uint64_t)plan->picture.width * plan->lens.side * plan->lens.side,
                   rows = RAYS_AT_ONCE / row > 1 ? RAYS_AT_ONCE / row : 1;
    /* largest number of rows that the bits of a place can count */
    const uint64_t held = (MOST_ROWS - 2 * KD_CELL_BLOCK) / plan->lens.side;
    plan->lens.sample_rows = (uint32_t)least_of(least_of(rows, held), plan->picture.band_rows);
    while (plan->lens.sample_rows > 1 && !fits(plan, plan->lens.sample_rows, bytes))
        plan->lens.sample_rows /= 2;
    if (!fits(plan, 1, BOUND_EVERYWHERE))
        plan->lens.interpolates = 0;
}

uint64_t kd_sample_bytes(const struct kd_plan *plan)
{
    if (!(plan->lens.interpolates > 0))
        return 0;
    const struct kd_sample_grid most = largest(plan, plan->lens.sample_rows);
    return most.list_bytes + most.index_bytes + most.node_bytes;
}

/* Error that interpolation can guarantee. For a smaller tolerance each ray is traced. */
#define HOLDS 1e-5

double kd_sample_tolerance(const struct kd_plan *plan, const struct kd_scene *scene)
{
    static const double by_profile[] = { [KD_PROFILE_DRAFT] = 1e-5,
                                         [KD_PROFILE_INTERACTIVE] = 1e-5,
                                         [KD_PROFILE_BALANCED] = 2e-6,
                                         [KD_PROFILE_HIGH] = 0,
                                         [KD_PROFILE_REFERENCE] = 0 };
    const struct kd_accuracy_request asked_accuracy = kd_accuracy_request_of(scene);
    if (plan->lens.path == KD_LENS_LISTED || !plan->lens.planes || asked_accuracy.engine >= 0 || asked_accuracy.steps ||
        asked_accuracy.precision >= 0 ||
        (uint64_t)plan->picture.width * plan->lens.side > MOST_COLUMNS - 2 * KD_CELL_BLOCK)
        return 0;
    if (isfinite(asked_accuracy.tolerance))
        return asked_accuracy.tolerance >= HOLDS ? by_profile[KD_PROFILE_BALANCED] : 0;
    return by_profile[asked_accuracy.profile];
}

void kd_plan_follow_all(struct kd_plan *plan)
{
    char text[96];
    if (!(plan->lens.interpolates > 0))
        return;
    plan->lens.interpolates = 0;
    const int n = snprintf(text, sizeof text, "%s, every ray followed", plan->lens.key);
    kd_sha256(text, (size_t)n, plan->lens.key);
    for (size_t i = 0; i < plan->cost.n_passes; i++)
        plan->cost.passes[i].figure = KD_NS_NONE;
}
