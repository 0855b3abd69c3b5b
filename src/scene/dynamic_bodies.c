#include "scene/dynamic_bodies.h"

#include "scene/scene.h"

#include <stdlib.h>

static _Atomic uint64_t crowds;

static void destroy(struct kd_dynamic_bodies *dynamic)
{
    free(dynamic->bodies);
    free(dynamic->debris.nodes);
    free(dynamic);
}

enum kd_status kd_dynamic_bodies_create(size_t n, uint32_t rows, uint32_t columns, struct kd_dynamic_bodies **out,
                                        struct kd_error *error)
{
    const size_t nodes = (size_t)rows * columns;
    struct kd_dynamic_bodies *dynamic = calloc(1, sizeof *dynamic);
    if (!dynamic)
        return kd_error_set(error, KD_ENOMEM, "out of memory for the bodies of a playground");
    dynamic->bodies = calloc(n ? n : 1, sizeof *dynamic->bodies);
    dynamic->debris.nodes = calloc(nodes ? nodes : 1, KD_CROWD_NODE * sizeof(float));
    if (!dynamic->bodies || !dynamic->debris.nodes) {
        destroy(dynamic);
        return kd_error_set(error, KD_ENOMEM, "out of memory for %zu bodies and %zu nodes of debris", n, nodes);
    }
    dynamic->n = n;
    dynamic->debris.rows = rows;
    dynamic->debris.columns = columns;
    dynamic->generation = atomic_fetch_add(&crowds, 1) + 1;
    atomic_init(&dynamic->holders, 1);
    *out = dynamic;
    return KD_OK;
}

void kd_dynamic_bodies_keep(struct kd_dynamic_bodies *dynamic)
{
    if (dynamic)
        atomic_fetch_add(&dynamic->holders, 1);
}

void kd_dynamic_bodies_release(struct kd_dynamic_bodies *dynamic)
{
    if (dynamic && atomic_fetch_sub(&dynamic->holders, 1) == 1)
        destroy(dynamic);
}

void kd_scene_show(struct kd_scene *scene, const struct kd_dynamic_bodies *dynamic)
{
    scene->dynamic.at = dynamic;
    scene->dynamic.generation = dynamic ? dynamic->generation : 0;
}
