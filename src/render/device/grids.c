#include "render/device/grids.h"

#include "render/device/device_internal.h"
#include "scene/asset.h"
#include "scene/hole.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct own {
    struct kd_grids *all; /* grids of the renderer; set by the first `prepare` */
    struct kd_vk_buffer *nodes;
    char of[KD_ASSET_NAME]; /* hash of the asset whose grid is uploaded */
    bool there;             /* true if a grid is uploaded */
    bool texels;            /* true if kernels read the grid as texels */
};

static bool is_grid(const struct kd_scene *scene) { return scene->volume.model == KD_VOLUME_GRID; }

static bool has_one(const struct kd_scene *scene) { return is_grid(scene) && *scene->volume.grid; }

static enum kd_status make(void *owner, const struct kd_asset_request *request, bool *invalid, struct kd_error *error)
{
    static const struct kd_hole any = { 0 };
    struct kd_grids *all = owner;
    struct kd_asset_bytes bytes;
    struct kd_error why = { 0 };
    all->made = (struct kd_matter_grid) { 0 };
    if (all->blank)
        return kd_matter_grid_none(&any, &all->made, error);
    enum kd_status status =
        kd_asset_reader_take(all->assets, request->of, "/volume/grid", "volume.grid", &bytes, error);
    if (status)
        return status;
    status = kd_matter_grid_read(bytes.data, bytes.size, &all->made, &why);
    all->assets->give_back(all->assets->user, &bytes);
    *invalid = status == KD_EINVAL;
    if (*invalid)
        return kd_error_field(error, "/volume/grid", "volume.grid: %.400s", why.message);
    return status ? kd_error_set(error, status, "%s", why.message) : KD_OK;
}

static struct kd_cached_grid *cached(struct kd_grids *all, const char *hash)
{
    for (int i = 0; i < KD_GRIDS; i++)
        if (!strcmp(all->entries[i].of, hash))
            return &all->entries[i];
    return NULL;
}

/* Frees the nodes of the least recently used grids, so that at most n grids have nodes. */
static void free_nodes(struct kd_grids *all, int n)
{
    for (;;) {
        struct kd_cached_grid *oldest = NULL;
        int there = 0;
        for (struct kd_cached_grid *g = all->entries; g < all->entries + KD_GRIDS; g++) {
            there += g->grid.nodes != NULL;
            oldest = g->grid.nodes && (!oldest || g->used < oldest->used) ? g : oldest;
        }
        if (there <= n)
            return;
        kd_matter_grid_finish(&oldest->grid);
    }
}

/* Finds the slot for a grid: the grid's own slot, or that of the least recently used description without nodes. */
static struct kd_cached_grid *slot_of(struct kd_grids *all, const char *hash)
{
    struct kd_cached_grid *oldest = cached(all, hash);
    if (oldest)
        return oldest;
    for (struct kd_cached_grid *g = all->entries; g < all->entries + KD_GRIDS; g++)
        oldest = !g->grid.nodes && (!oldest || g->used < oldest->used) ? g : oldest;
    return oldest;
}

static void make_room(void *owner) { free_nodes(owner, KD_GRIDS_READ - 1); }

static void keep(void *owner, const struct kd_asset_request *request)
{
    struct kd_grids *all = owner;
    struct kd_cached_grid *slot = slot_of(all, request->of);
    kd_matter_grid_finish(&slot->grid);
    memcpy(slot->of, request->of, sizeof slot->of);
    slot->grid = all->made;
    slot->used = ++all->used;
}

static bool is_cached(void *owner, const struct kd_asset_request *request)
{
    const struct kd_cached_grid *at = cached(owner, request->of);
    return at && (!request->whole || at->grid.nodes);
}

static const struct kd_asset_maker maker = { is_cached, make_room, make, keep, NULL };

static struct kd_asset_request request_of(const char *hash, bool nodes)
{
    struct kd_asset_request request = { .whole = nodes };
    snprintf(request.of, sizeof request.of, "%s", hash);
    return request;
}

bool kd_grid_begin(struct kd_grids *all, const struct kd_scene *scene)
{
    if (!has_one(scene))
        return false;
    pthread_mutex_lock(&all->reader.lock);
    const struct kd_asset_request request =
        request_of(scene->volume.grid, strcmp(all->uploaded, scene->volume.grid) != 0);
    const bool in_progress = kd_asset_reader_begin(&all->reader, &request);
    pthread_mutex_unlock(&all->reader.lock);
    return in_progress;
}

/* Copies the description of the scene's grid. If nodes and places are requested, moves them to *out, and the caller
 * frees them. Waits for the grid if necessary. Render thread only. */
static enum kd_status take_grid(struct kd_grids *all, const struct kd_scene *scene, bool nodes,
                                struct kd_matter_grid *out, struct kd_error *error)
{
    const struct kd_asset_request request = request_of(scene->volume.grid, nodes);
    if (!*request.of)
        return kd_matter_grid_none(kd_scene_hole(scene), out, error);
    pthread_mutex_lock(&all->reader.lock);
    enum kd_status status = kd_asset_reader_wait(&all->reader, &request, error);
    if (!status) {
        struct kd_cached_grid *at = cached(all, request.of);
        at->used = ++all->used;
        *out = at->grid;
        if (nodes)
            at->grid.nodes = at->grid.places = NULL;
        else
            out->nodes = out->places = NULL;
    }
    pthread_mutex_unlock(&all->reader.lock);
    const struct kd_asset_grid made = kd_matter_grid_told(out);
    if (!status && !all->blank && (status = kd_asset_check_grid(&made, scene, error)))
        kd_matter_grid_finish(out);
    return status;
}

/* Records that a grid is on the device, so that its nodes are no longer needed on the host. */
static void note_uploaded(struct kd_grids *all, const char *hash)
{
    pthread_mutex_lock(&all->reader.lock);
    struct kd_cached_grid *at = *hash ? cached(all, hash) : NULL;
    if (at)
        kd_matter_grid_finish(&at->grid);
    snprintf(all->uploaded, sizeof all->uploaded, "%s", hash);
    pthread_mutex_unlock(&all->reader.lock);
}

static void note_gone(struct kd_grids *all, const char *hash)
{
    pthread_mutex_lock(&all->reader.lock);
    if (!strcmp(all->uploaded, hash))
        *all->uploaded = 0;
    pthread_mutex_unlock(&all->reader.lock);
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
    struct kd_matter_grid grid = { 0 };
    enum kd_status status = KD_OK;
    if (!is_grid(scene))
        return KD_OK;
    own->all = &work->renderer->grids;
    if (own->there && !strcmp(own->of, scene->volume.grid)) {
        note_uploaded(own->all, own->of);
        return KD_OK;
    }
    own->there = false;
    KD_TRY(take_grid(own->all, scene, true, &grid, error));
    const uint64_t nodes = kd_matter_grid_bytes(&grid), places = kd_matter_grid_places(&grid) * sizeof *grid.places,
                   bytes = nodes + places;
    own->texels = kd_kernels_map_as_texels(work->vk);
    KD_TRY(fits(work->vk, own->texels, bytes, error));
    KD_TRY(kd_emitter_buffers_at_least(work, &own->nodes, bytes, KD_VK_DEVICE, "matter on a grid", error));
    KD_TRY(kd_vk_buffer_create(work->vk, bytes, KD_VK_UPLOAD, "matter on a grid on the host", &staging, error));
    memcpy(kd_vk_buffer_map(staging), grid.nodes, nodes);
    if (places)
        memcpy((char *)kd_vk_buffer_map(staging) + nodes, grid.places, places);
    KD_TRY(kd_vk_copy(work->vk, "upload", own->nodes, 0, staging, 0, bytes, error));
    KD_TRY(kd_vk_submit(work->vk, NULL, error));
    memcpy(own->of, scene->volume.grid, sizeof own->of);
    own->there = true;
    note_uploaded(own->all, own->of);
done:
    kd_matter_grid_finish(&grid);
    kd_vk_buffer_destroy(work->vk, staging);
    return status;
}

/* The frame number of the present time is limited to +-1e9. For a time so far outside the series, the kernels need only
 * the sign of that number. */
static void fill_times(struct kd_plasma_block *to, const struct kd_matter_grid *g, const struct kd_scene *scene)
{
    const bool slow = kd_scene_is_slow_volume(scene);
    const double rate = g->frames > 1 ? (g->frames - 1) / (g->time[1] - g->time[0]) : 0,
                 time = scene->top.time - (slow ? kd_scene_lead(scene) : 0);
    to->grid_frames = g->frames;
    to->grid_now = (float)fmin(fmax(rate * (time - g->time[0]), -1e9), 1e9);
    to->grid_per_time = (float)rate;
    to->grid_late = slow && g->late;
}

/* Sets the location of the grid's nodes, and the range of radii that scene and grid have in common. */
static enum kd_status tell(struct kd_renderer *r, const struct kd_scene *scene, struct kd_emission *out, char *credit,
                           size_t size, struct kd_error *error)
{
    struct kd_matter_grid own = { 0 };
    const struct kd_matter_grid *g = &own;
    struct kd_plasma_block *to = &out->plasma;
    (void)credit, (void)size;
    if (!is_grid(scene))
        return KD_OK;
    const enum kd_status status = take_grid(&r->grids, scene, false, &own, error);
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
    fill_times(to, g, scene);
    to->grid_density = (float)g->least[0];
    to->grid_densities = (float)g->range[0];
    to->grid_heat = (float)g->least[1];
    to->grid_heats = (float)g->range[1];
    to->grid_speed = (float)g->speed;
    to->grid_scale = (float)(1 / KD_MATTER_FIELD);
    to->inner = (float)fmin(inner, outer);
    to->outer = (float)outer;
    /* if the scene has no other volume, the march can be limited to the grid's own radii */
    if (kd_scene_is_radio_alone(scene)) {
        out->frame.along_least = (float)(1 / outer);
        out->frame.along_most = (float)fmin(1 / fmin(inner, outer), 1e30);
    }
    kd_matter_grid_finish(&own);
    return KD_OK;
}

static void buffers(const void *own, struct kd_vk_buffer *out[KD_OWN_COUNT])
{
    const struct own *o = own;
    out[o->texels ? KD_OWN_plasma_texels : KD_OWN_plasma_grid] = o->nodes;
}

static void forget(void *state)
{
    struct own *own = state;
    if (own->there)
        note_gone(own->all, own->of);
    own->there = false;
}

static void finish(void *state, struct kd_vk *vk)
{
    struct own *own = state;
    forget(own);
    kd_vk_buffer_destroy(vk, own->nodes);
    *own = (struct own) { 0 };
}

static void begin(struct kd_renderer *r, const struct kd_scene *scene) { kd_grid_begin(&r->grids, scene); }

void kd_grids_init(struct kd_grids *all, const struct kd_assets *assets, void (*made)(void *user), void *user)
{
    *all = (struct kd_grids) { .assets = assets };
    kd_asset_reader_init(&all->reader, &maker, all, made, user);
}

void kd_grids_stop(struct kd_grids *all) { kd_asset_reader_stop(&all->reader); }

void kd_grids_rest(struct kd_grids *all)
{
    pthread_mutex_lock(&all->reader.lock);
    if (kd_asset_reader_is_idle(&all->reader))
        free_nodes(all, 0);
    pthread_mutex_unlock(&all->reader.lock);
}

void kd_grids_finish(struct kd_grids *all)
{
    kd_asset_reader_finish(&all->reader);
    for (int i = 0; i < KD_GRIDS; i++)
        kd_matter_grid_finish(&all->entries[i].grid);
}

const struct kd_emitter_buffers kd_emitter_buffers_plasma = {
    sizeof(struct own), prepare, buffers, forget, finish, begin, tell
};
