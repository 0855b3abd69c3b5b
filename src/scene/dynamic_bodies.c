#include "scene/dynamic_bodies.h"

#include "scene/scene.h"

#include <stdlib.h>

static _Atomic uint64_t crowds;

static void destroy(struct kd_dynamic_bodies *crowd)
{
    free(crowd->bodies);
    free(crowd->debris.nodes);
    free(crowd);
}

enum kd_status kd_dynamic_bodies_create(size_t n, uint32_t rows, uint32_t columns, struct kd_dynamic_bodies **out,
                                        struct kd_error *error)
{
    const size_t nodes = (size_t)rows * columns;
    struct kd_dynamic_bodies *crowd = calloc(1, sizeof *crowd);
    if (!crowd)
        return kd_error_set(error, KD_ENOMEM, "out of memory for the bodies of a playground");
    crowd->bodies = calloc(n ? n : 1, sizeof *crowd->bodies);
    crowd->debris.nodes = calloc(nodes ? nodes : 1, KD_CROWD_NODE * sizeof(float));
    if (!crowd->bodies || !crowd->debris.nodes) {
        destroy(crowd);
        return kd_error_set(error, KD_ENOMEM, "out of memory for %zu bodies and %zu nodes of debris", n, nodes);
    }
    crowd->n = n;
    crowd->debris.rows = rows;
    crowd->debris.columns = columns;
    crowd->generation = atomic_fetch_add(&crowds, 1) + 1;
    atomic_init(&crowd->holders, 1);
    *out = crowd;
    return KD_OK;
}

void kd_dynamic_bodies_keep(struct kd_dynamic_bodies *crowd)
{
    if (crowd)
        atomic_fetch_add(&crowd->holders, 1);
}

void kd_dynamic_bodies_release(struct kd_dynamic_bodies *crowd)
{
    if (crowd && atomic_fetch_sub(&crowd->holders, 1) == 1)
        destroy(crowd);
}

void kd_scene_show(struct kd_scene *scene, const struct kd_dynamic_bodies *crowd)
{
    scene->crowd.at = crowd;
    scene->crowd.generation = crowd ? crowd->generation : 0;
}
