#include "render/device/grids.h"

#include "render/device/internal.h"
#include "scene/asset.h"
#include "scene/hole.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct own {
    struct kd_vk_buffer *nodes;
    char of[KD_ASSET_NAME]; /* hash of the asset whose grid is uploaded */
    bool there;             /* whether a grid is uploaded */
    bool texels;            /* whether kernels read it as texels */
};

static bool is_grid(const struct kd_scene *scene) { return scene->volume.model == KD_VOLUME_GRID; }

static enum kd_status read_asset(const struct kd_assets *assets, const char *hash, struct kd_matter_grid *out,
                                 struct kd_error *error)
{
    struct kd_asset_bytes bytes;
    struct kd_error why = { 0 };
    if (!assets || !assets->take(assets->user, hash, &bytes))
        return kd_error_field(error, "/volume/grid", "volume.grid is \"%s\", whose file is missing; it must be %s",
                              hash, assets ? assets->allowed : "null, because there are no assets");
    enum kd_status status = kd_matter_grid_read(bytes.data, bytes.size, out, &why);
    assets->give_back(assets->user, &bytes);
    if (status == KD_EINVAL)
        return kd_error_field(error, "/volume/grid", "volume.grid: %.400s", why.message);
    return status ? kd_error_set(error, status, "%s", why.message) : KD_OK;
}

static const char *hash_of(const struct kd_scene *scene) { return *scene->volume.grid ? scene->volume.grid : "none"; }

static struct kd_cached_documents_grid *kept_of(struct kd_grids *all, const char *hash)
{
    for (int i = 0; i < KD_GRIDS; i++)
        if (!strcmp(all->entries[i].of, hash))
            return &all->entries[i];
    return NULL;
}

/* Finds the scene's grid, with its nodes if requested, and reads it if it is not cached. */
static enum kd_status grid_of(struct kd_renderer *r, const struct kd_scene *scene, bool nodes,
                              struct kd_matter_grid **out, struct kd_error *error)
{
    struct kd_cached_documents_grid *at = kept_of(&r->grids, hash_of(scene));
    enum kd_status status = KD_OK;
    if (!at || (nodes && !at->grid.nodes)) {
        if (!at)
            at = &r->grids.entries[r->grids.n++ % KD_GRIDS];
        kd_matter_grid_finish(&at->grid);
        *at->of = 0;
        KD_TRY(*scene->volume.grid ? read_asset(r->panoramas.assets, scene->volume.grid, &at->grid, error)
                                   : kd_matter_grid_none(kd_scene_hole(scene), &at->grid, error));
        snprintf(at->of, sizeof at->of, "%s", hash_of(scene));
    }
    *out = &at->grid;
    if (*scene->volume.grid)
        KD_TRY(kd_asset_check_grid(at->grid.spin, scene, error));
done:
    return status;
}

static enum kd_status fits(const struct kd_vk *vk, bool texels, uint64_t bytes, struct kd_error *error)
{
    const struct kd_vk_info *info = kd_vk_info(vk);
    const uint64_t most = texels ? 16 * info->max_texels : info->max_binding_bytes;
    if (bytes <= most)
        return KD_OK;
    return kd_error_field(error, "/volume/grid",
                          "volume.grid needs %llu bytes in one binding; on this device it must be at most %llu",
                          (unsigned long long)bytes, (unsigned long long)most);
}

static enum kd_status prepare(const struct kd_emitter_buffers_work *work, const struct kd_scene *scene,
                              struct kd_error *error)
{
    struct own *own = work->own;
    struct kd_vk_buffer *staging = NULL;
    struct kd_matter_grid *grid;
    enum kd_status status = KD_OK;
    if (!is_grid(scene))
        return KD_OK;
    if (own->there && !strcmp(own->of, scene->volume.grid)) {
        struct kd_cached_documents_grid *at = kept_of(&work->renderer->grids, hash_of(scene));
        if (at) /* `tell` has read the grid already */
            kd_matter_grid_finish(&at->grid);
        return KD_OK;
    }
    own->there = false;
    KD_TRY(grid_of(work->renderer, scene, true, &grid, error));
    const uint64_t nodes = kd_matter_grid_bytes(grid), places = kd_matter_grid_places(grid) * sizeof *grid->places,
                   bytes = nodes + places;
    own->texels = kd_kernels_map_as_texels(work->vk);
    KD_TRY(fits(work->vk, own->texels, bytes, error));
    KD_TRY(kd_emitter_buffers_at_least(work, &own->nodes, bytes, KD_VK_DEVICE, "matter on a grid", error));
    KD_TRY(kd_vk_buffer_create(work->vk, bytes, KD_VK_UPLOAD, "matter on a grid on the host", &staging, error));
    memcpy(kd_vk_buffer_map(staging), grid->nodes, nodes);
    if (places)
        memcpy((char *)kd_vk_buffer_map(staging) + nodes, grid->places, places);
    KD_TRY(kd_vk_copy(work->vk, "upload", own->nodes, 0, staging, 0, bytes, error));
    KD_TRY(kd_vk_submit(work->vk, NULL, error));
    memcpy(own->of, scene->volume.grid, sizeof own->of);
    own->there = true;
    kd_matter_grid_finish(grid);
done:
    kd_vk_buffer_destroy(work->vk, staging);
    return status;
}

/* Sets the location of the grid's nodes, and the range of radii common to scene and grid. */
static enum kd_status tell(struct kd_renderer *r, const struct kd_scene *scene, struct kd_emission *out, char *credit,
                           size_t size, struct kd_error *error)
{
    struct kd_matter_grid *g;
    struct kd_plasma_block *to = &out->plasma;
    (void)credit, (void)size;
    if (!is_grid(scene))
        return KD_OK;
    enum kd_status status = grid_of(r, scene, false, &g, error);
    if (status)
        return status;
    const double inner = fmax(kd_scene_volume_inner(scene), g->r[0]), outer = fmin(scene->volume.outer, g->r[1]);
    to->grid_rows = g->rows;
    to->grid_columns = g->columns;
    to->grid_layers = g->layers;
    to->grid_r = (float)log2(g->r[0]);
    to->grid_per_r = (float)((g->rows - 1) / log2(g->r[1] / g->r[0]));
    to->grid_theta = (float)g->theta[0];
    to->grid_per_theta = (float)((g->columns - 1) / (g->theta[1] - g->theta[0]));
    to->grid_steps = g->steps;
    to->grid_place_rows = g->place_rows;
    to->grid_phi = (float)g->phi;
    to->grid_per_phi = g->layers > 1 ? (float)(g->layers / g->turn) : 0;
    to->grid_fall = g->ingoing ? (float)scene->spacetime.spin : 0;
    to->grid_field = (float)log2(g->field);
    to->grid_packed = g->packed;
    to->grid_density = (float)g->least[0];
    to->grid_densities = (float)g->range[0];
    to->grid_heat = (float)g->least[1];
    to->grid_heats = (float)g->range[1];
    to->grid_speed = (float)g->speed;
    to->grid_scale = (float)(1 / KD_MATTER_FIELD);
    to->inner = (float)fmin(inner, outer);
    to->outer = (float)outer;
    if (kd_scene_is_radio_alone(scene)) { /* if the grid is the only volume, the march finds its edges */
        out->frame.along_least = (float)(1 / outer);
        out->frame.along_most = (float)fmin(1 / fmin(inner, outer), 1e30);
    }
    return KD_OK;
}

static void buffers(const void *own, struct kd_vk_buffer *out[KD_OWN_COUNT])
{
    const struct own *o = own;
    out[o->texels ? KD_OWN_plasma_texels : KD_OWN_plasma_grid] = o->nodes;
}

static void forget(void *own) { ((struct own *)own)->there = false; }

static void finish(void *own, struct kd_vk *vk)
{
    kd_vk_buffer_destroy(vk, ((struct own *)own)->nodes);
    *(struct own *)own = (struct own) { 0 };
}

void kd_grids_finish(struct kd_grids *grids)
{
    for (int i = 0; i < KD_GRIDS; i++)
        kd_matter_grid_finish(&grids->entries[i].grid);
    *grids = (struct kd_grids) { 0 };
}

const struct kd_emitter_buffers kd_emitter_buffers_plasma = {
    sizeof(struct own), prepare, buffers, forget, finish, NULL, tell
};
