#include "render/device/store.h"

#include "render/emit/emitter.h"
#include "render/device/rest.h"
#include "render/plan/photometry.h"
#include "render/view/layout.h"
#include "interface.h"

#include <stdlib.h>
#include <string.h>

static void bands_finish(struct kd_bands *bands, struct kd_vk *vk)
{
    for (uint32_t i = 0; i < bands->count; i++)
        kd_vk_buffer_destroy(vk, bands->buffers[i]);
    free(bands->buffers);
    *bands = (struct kd_bands) { 0 };
}

static enum kd_status bands_init(struct kd_bands *bands, struct kd_vk *vk, uint32_t count, uint64_t bytes,
                                 const char *name, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    if (bands->count == count && bands->band_bytes == bytes)
        return KD_OK;
    bands_finish(bands, vk);
    bands->buffers = calloc(count, sizeof *bands->buffers);
    if (!bands->buffers)
        return kd_error_set(error, KD_ENOMEM, "out of memory for %u bands", count);
    bands->count = count;
    bands->band_bytes = bytes;
    for (uint32_t i = 0; i < count; i++)
        KD_TRY(kd_vk_buffer_create(vk, bytes, KD_VK_DEVICE, name, &bands->buffers[i], error));
done:
    if (status)
        bands_finish(bands, vk);
    return status;
}

static uint64_t bytes_of_bands(const struct kd_bands *bands) { return bands->count * bands->band_bytes; }
static uint64_t bytes_of(const struct kd_vk_buffer *buffer) { return buffer ? kd_vk_buffer_size(buffer) : 0; }
static uint64_t bytes_of_map(const struct kd_lens_map *map)
{
    return bytes_of_bands(&map->bands) + bytes_of_bands(&map->critical) + bytes_of_bands(&map->star_light) +
           bytes_of(map->rim_lens);
}

/* Marks the light of stars and the rim as not computed. */
static void forget_stars(struct kd_lens_map *map)
{
    map->star_key.lens[0] = 0;
    map->rim_known = map->rim_traced = false;
    map->rim.there = false;
}

static void map_finish(struct kd_lens_map *map, struct kd_vk *vk)
{
    bands_finish(&map->bands, vk);
    bands_finish(&map->critical, vk);
    bands_finish(&map->star_light, vk);
    kd_critical_pixels_finish(&map->pixels);
    kd_vk_buffer_destroy(vk, map->rim_lens);
    map->rim_lens = NULL;
    forget_stars(map);
    map->key[0] = 0;
    map->used = 0;
}

/* Evicts cached maps, oldest first, until the plan fits and the cached maps are within their limit. */
static void make_room(struct kd_store *store, const struct kd_plan_cost *cost, const struct kd_lens_map *spare)
{
    for (;;) {
        uint64_t kept = 0;
        struct kd_lens_map *oldest = NULL;
        for (int i = 0; i < KD_LENS_MAPS_KEPT; i++) {
            struct kd_lens_map *m = &store->maps[i];
            if (m == spare || !m->bands.count)
                continue;
            kept += bytes_of_map(m);
            if (!oldest || m->used < oldest->used)
                oldest = m;
        }
        if (!oldest || (kept <= KD_KEPT_MAPS_BYTES && cost->device_bytes + kept <= store->memory_bytes))
            return;
        map_finish(oldest, store->vk);
    }
}

static uint64_t lens_band_bytes(const struct kd_plan *plan)
{
    return 4ull * plan->lens.planes * plan->picture.width * plan->lens.side * plan->lens.side *
               plan->picture.band_rows +
           16;
}

static bool is_of(const struct kd_lens_map *map, const struct kd_plan *plan)
{
    return plan->lens.cacheable && !strcmp(map->key, plan->lens.key) && map->bands.count == plan->picture.bands &&
           map->bands.band_bytes == lens_band_bytes(plan) && map->critical.count == kd_plan_critical_parts(&plan->lens);
}

bool kd_store_has(const struct kd_store *store, const struct kd_plan *plan)
{
    for (int i = 0; i < KD_LENS_MAPS_KEPT; i++)
        if (is_of(&store->maps[i], plan))
            return true;
    return false;
}

/* Allocates the light of stars; new buffers have no valid contents. */
static enum kd_status make_star_light(struct kd_store *store, const struct kd_plan *plan, struct kd_lens_map *map,
                                      struct kd_error *error)
{
    struct kd_bands *light = &map->star_light;
    if (!plan->light.points ||
        (light->count == plan->picture.bands && light->band_bytes == kd_plan_star_bytes(&plan->picture)))
        return KD_OK;
    map->star_key.lens[0] = 0;
    return bands_init(light, store->vk, plan->picture.bands, kd_plan_star_bytes(&plan->picture), "light of stars",
                      error);
}

/* Makes *buffer if it is NULL. The buffer is never resized. */
static enum kd_status once(struct kd_vk *vk, struct kd_vk_buffer **buffer, uint64_t size, enum kd_vk_memory memory,
                           const char *name, struct kd_error *error)
{
    return *buffer ? KD_OK : kd_vk_buffer_create(vk, size, memory, name, buffer, error);
}

/* Like kd_store_lens_map, but without the further buffers that rays need. */
static enum kd_status find_or_make(struct kd_store *store, const struct kd_plan *plan, struct kd_lens_map **out,
                                   bool *reused, struct kd_error *error)
{
    struct kd_lens_map *oldest = &store->maps[0];
    uint64_t bytes = lens_band_bytes(plan);
    *reused = false;
    for (int i = 0; i < KD_LENS_MAPS_KEPT; i++) {
        struct kd_lens_map *m = &store->maps[i];
        if (is_of(m, plan)) {
            m->used = ++store->clock;
            *out = m;
            *reused = true;
            make_room(store, &plan->cost, m);
            return make_star_light(store, plan, m, error);
        }
        if (m->used < oldest->used)
            oldest = m;
    }
    make_room(store, &plan->cost, oldest);
    oldest->key[0] = 0;
    kd_critical_pixels_finish(&oldest->pixels);
    forget_stars(oldest);
    oldest->used = ++store->clock;
    *out = oldest;
    enum kd_status status;
    KD_TRY(bands_init(&oldest->bands, store->vk, plan->lens.cacheable ? plan->picture.bands : 1, bytes, "lens map",
                      error));
    KD_TRY(bands_init(&oldest->critical, store->vk, kd_plan_critical_parts(&plan->lens),
                      kd_plan_critical_bytes(&plan->lens), "lens map at the critical curve", error));
    if (!plan->light.points)
        bands_finish(&oldest->star_light, store->vk);
    KD_TRY(make_star_light(store, plan, oldest, error));
done:
    return status;
}

enum kd_status kd_store_lens_map(struct kd_store *store, const struct kd_plan *plan, struct kd_lens_map **out,
                                 bool *reused, struct kd_error *error)
{
    /* The buffer for undecided rays is made even if the lens map was found: the map may come from another store, and
     * refine.c traces further rays. */
    const uint64_t bytes = 4 * (1 + kd_plan_open_most(plan));
    enum kd_status status =
        kd_store_at_least(store->vk, &store->undecided, bytes, KD_VK_DEVICE, "undecided rays", error);
    if (!status)
        status = kd_store_at_least(store->vk, &store->undecided_host, bytes, KD_VK_READBACK,
                                   "undecided rays on the host", error);
    return status ? status : find_or_make(store, plan, out, reused, error);
}

void kd_store_commit(struct kd_store *store, struct kd_lens_map *map, const struct kd_plan_lens *lens)
{
    (void)store;
    if (lens->cacheable)
        memcpy(map->key, lens->key, sizeof map->key);
}

void kd_store_hand_over(struct kd_store *from, struct kd_store *to, const struct kd_plan *plan)
{
    struct kd_lens_map *map = NULL, *oldest = &to->maps[0];
    for (int i = 0; i < KD_LENS_MAPS_KEPT; i++) {
        map = is_of(&from->maps[i], plan) ? &from->maps[i] : map;
        oldest = to->maps[i].used < oldest->used ? &to->maps[i] : oldest;
    }
    if (!map)
        return;
    map_finish(oldest, to->vk);
    *oldest = *map;
    oldest->used = ++to->clock;
    *map = (struct kd_lens_map) { 0 };
}

enum kd_status kd_store_at_least(struct kd_vk *vk, struct kd_vk_buffer **buffer, uint64_t size,
                                 enum kd_vk_memory memory, const char *name, struct kd_error *error)
{
    if (*buffer && kd_vk_buffer_size(*buffer) >= size && kd_vk_buffer_size(*buffer) <= 4 * size + (1 << 20))
        return KD_OK;
    kd_vk_buffer_destroy(vk, *buffer);
    *buffer = NULL;
    return kd_vk_buffer_create(vk, size, memory, name, buffer, error);
}

/* Buffers of fixed size, which all pictures need. */
static enum kd_status make_small(struct kd_store *store, struct kd_error *error)
{
    struct kd_vk *vk = store->vk;
    enum kd_status status;
    KD_TRY(once(vk, &store->transfer, sizeof(struct kd_emit_data), KD_VK_DEVICE, "transfer tables", error));
    KD_TRY(once(vk, &store->staging, sizeof(struct kd_emit_data), KD_VK_UPLOAD, "transfer tables on the host", error));
    KD_TRY(once(vk, &store->histogram, 4 * KD_HISTOGRAM_BINS, KD_VK_DEVICE, "histogram", error));
    KD_TRY(once(vk, &store->counts, 4 * KD_HISTOGRAM_BINS, KD_VK_READBACK, "histogram on the host", error));
done:
    return status;
}

/* Makes a beam's buffers. `beamed` is as large as the picture, so it is freed when a plan has no beam. */
static enum kd_status make_beam(struct kd_store *store, const struct kd_plan_picture *picture, struct kd_error *error)
{
    const struct kd_beam_grid *beam = &picture->beam;
    enum kd_status status;
    if (!beam->cell) {
        bands_finish(&store->beamed, store->vk);
        return KD_OK;
    }
    KD_TRY(bands_init(&store->beamed, store->vk, picture->bands,
                      kd_post_radiance_bytes((uint64_t)picture->width * picture->band_rows), "light by the beam",
                      error));
    KD_TRY(kd_store_at_least(store->vk, &store->beam_lines, kd_beam_lines_bytes(beam), KD_VK_DEVICE, "rows of cells",
                             error));
    KD_TRY(kd_store_at_least(store->vk, &store->beam_grids, kd_beam_grids_bytes(beam), KD_VK_DEVICE, "cells", error));
done:
    return status;
}

enum kd_status kd_store_frame(struct kd_store *store, const struct kd_plan *plan, int bit_depth, struct kd_error *error)
{
    struct kd_vk *vk = store->vk;
    const uint64_t pixels = (uint64_t)plan->picture.width * plan->picture.band_rows,
                   layers = kd_plan_readback_bytes(&plan->picture);
    const uint64_t words = kd_post_bytes(pixels, bit_depth) + 4 * KD_POST_COUNTS,
                   light = kd_plan_pixel_bytes(&plan->light) * pixels, read = kd_post_radiance_bytes(pixels);
    enum kd_status status;
    KD_TRY(make_small(store, error));
    KD_TRY(bands_init(&store->radiance, vk, plan->picture.bands,
                      (light > read ? light : read) + kd_plan_lost_bytes(kd_plan_lost_most(plan)), "radiance", error));
    KD_TRY(kd_store_at_least(vk, &store->words, words, KD_VK_DEVICE, "pixels", error));
    KD_TRY(kd_store_at_least(vk, &store->readback, layers > words ? layers : words, KD_VK_READBACK,
                             "pixels on the host", error));
    if (!plan->picture.n_layers)
        bands_finish(&store->layers, vk);
    else
        KD_TRY(bands_init(&store->layers, vk, plan->picture.bands,
                          plan->picture.n_layers * kd_plan_layer_bytes(&plan->picture), "layers", error));
    if (plan->picture.bloom.levels)
        KD_TRY(kd_store_at_least(vk, &store->bloom, plan->picture.bloom.bytes, KD_VK_DEVICE, "spread light", error));
    KD_TRY(make_beam(store, &plan->picture, error));
    if (plan->lens.listed_bytes)
        KD_TRY(kd_store_at_least(vk, &store->listed, plan->lens.listed_bytes, KD_VK_DEVICE, "lens map of listed pixels",
                                 error));
    if (plan->light.photometry) {
        KD_TRY(kd_store_at_least(vk, &store->light, kd_light_bytes(plan), KD_VK_DEVICE, "light", error));
        KD_TRY(kd_store_at_least(vk, &store->light_host, kd_light_bytes(plan), KD_VK_READBACK, "light on the host",
                                 error));
    }
    if (plan->light.points) {
        KD_TRY(kd_store_at_least(vk, &store->star_pairs, kd_plan_pair_bytes(), KD_VK_DEVICE, "pairs of rays and stars",
                                 error));
        KD_TRY(kd_store_at_least(vk, &store->star_rays, kd_plan_star_ray_bytes(plan), KD_VK_DEVICE,
                                 "rays that seek stars", error));
    }
done:
    return status;
}

enum kd_status kd_store_send(struct kd_store *store, const struct kd_emit_data *tables, struct kd_error *error)
{
    static const size_t ends[] = { 0, offsetof(struct kd_emit_data, tables), sizeof *tables };
    bool first = !store->sent || !store->sent_whole;
    if (!store->sent && !(store->sent = malloc(sizeof *tables)))
        return kd_error_set(error, KD_ENOMEM, "out of memory for the transfer tables");
    enum kd_status status = KD_OK;
    for (int part = 0; part < 2 && !status; part++) {
        size_t from = ends[part], n = ends[part + 1] - from;
        char *sent = (char *)store->sent + from;
        const char *now = (const char *)tables + from;
        if (!first && !memcmp(sent, now, n))
            continue;
        memcpy(sent, now, n);
        memcpy((char *)kd_vk_buffer_map(store->staging) + from, now, n);
        status = kd_vk_copy(store->vk, "upload", store->transfer, from, store->staging, from, n, error);
    }
    store->sent_whole = !status;
    return status;
}

static enum kd_status make_cameras(struct kd_store *store, struct kd_error *error)
{
    const uint64_t bytes = KD_CAMERAS * KD_CAMERA_BYTES;
    enum kd_status status;
    KD_TRY(once(store->vk, &store->cameras, bytes, KD_VK_DEVICE, "cameras", error));
    KD_TRY(once(store->vk, &store->cameras_host, bytes, KD_VK_UPLOAD, "cameras on the host", error));
done:
    return status;
}

enum kd_status kd_store_send_cameras(struct kd_store *store, const struct kd_camera_block cameras[KD_CAMERAS],
                                     struct kd_error *error)
{
    enum kd_status status = make_cameras(store, error);
    const size_t bytes = sizeof store->sent_cameras;
    if (status || (store->cameras_sent && !memcmp(store->sent_cameras, cameras, bytes)))
        return status;
    memcpy(store->sent_cameras, cameras, bytes);
    for (int i = 0; i < KD_CAMERAS; i++)
        memcpy((char *)kd_vk_buffer_map(store->cameras_host) + i * KD_CAMERA_BYTES, &cameras[i], sizeof cameras[i]);
    status =
        kd_vk_copy(store->vk, "upload", store->cameras, 0, store->cameras_host, 0, KD_CAMERAS * KD_CAMERA_BYTES, error);
    store->cameras_sent = !status;
    return status;
}

void kd_store_give_up(struct kd_store *store)
{
    store->sent_whole = false;
    store->cameras_sent = false;
    for (int i = 0; i < KD_LENS_MAPS_KEPT; i++)
        forget_stars(&store->maps[i]);
}

uint64_t kd_store_map_bytes(const struct kd_store *store)
{
    uint64_t sum = 0;
    for (int i = 0; i < KD_LENS_MAPS_KEPT; i++)
        sum += bytes_of_map(&store->maps[i]);
    return sum;
}

uint64_t kd_store_bytes(const struct kd_store *store)
{
    uint64_t sum = kd_store_map_bytes(store) + bytes_of_bands(&store->radiance) + bytes_of_bands(&store->layers);
    sum += bytes_of(store->words) + bytes_of(store->readback) + bytes_of(store->transfer) + bytes_of(store->staging);
    sum += bytes_of_bands(&store->beamed) + bytes_of(store->beam_lines) + bytes_of(store->beam_grids) +
           bytes_of(store->palette);
    sum += bytes_of(store->star_pairs) + bytes_of(store->star_rays);
    sum += bytes_of(store->sample) + bytes_of(store->sample_index) + bytes_of(store->nodes);
    return sum + bytes_of(store->listed) + bytes_of(store->bloom) + bytes_of(store->light) +
           bytes_of(store->light_host);
}

void kd_store_empty(struct kd_store *store)
{
    kd_store_finish(store);
    *store = (struct kd_store) { .vk = store->vk, .memory_bytes = store->memory_bytes };
}

/* Keeps the most recently used maps, as far as they fit. */
static void keep_maps(struct kd_store *store, uint64_t bytes)
{
    for (;;) {
        struct kd_lens_map *oldest = NULL;
        for (struct kd_lens_map *m = store->maps; m < store->maps + KD_LENS_MAPS_KEPT; m++)
            oldest = m->bands.count && (!oldest || m->used < oldest->used) ? m : oldest;
        if (!oldest || kd_store_map_bytes(store) <= bytes)
            return;
        map_finish(oldest, store->vk);
    }
}

static void finish_frame(struct kd_store *store);

void kd_store_rest(struct kd_store *store, uint64_t bytes)
{
    struct kd_store rested = { .vk = store->vk, .memory_bytes = store->memory_bytes, .clock = store->clock };
    keep_maps(store, bytes);
    finish_frame(store);
    memcpy(rested.maps, store->maps, sizeof rested.maps);
    *store = rested;
}

void kd_store_finish(struct kd_store *store)
{
    for (int i = 0; i < KD_LENS_MAPS_KEPT; i++)
        map_finish(&store->maps[i], store->vk);
    finish_frame(store);
}

/* Frees everything except the lens maps. */
static void finish_frame(struct kd_store *store)
{
    bands_finish(&store->radiance, store->vk);
    bands_finish(&store->layers, store->vk);
    bands_finish(&store->beamed, store->vk);
    kd_vk_buffer_destroy(store->vk, store->beam_lines);
    kd_vk_buffer_destroy(store->vk, store->beam_grids);
    kd_vk_buffer_destroy(store->vk, store->palette);
    kd_vk_buffer_destroy(store->vk, store->words);
    kd_vk_buffer_destroy(store->vk, store->readback);
    kd_vk_buffer_destroy(store->vk, store->transfer);
    kd_vk_buffer_destroy(store->vk, store->staging);
    kd_vk_buffer_destroy(store->vk, store->cameras);
    kd_vk_buffer_destroy(store->vk, store->cameras_host);
    free(store->sent);
    kd_vk_buffer_destroy(store->vk, store->histogram);
    kd_vk_buffer_destroy(store->vk, store->counts);
    kd_vk_buffer_destroy(store->vk, store->bloom);
    kd_vk_buffer_destroy(store->vk, store->light);
    kd_vk_buffer_destroy(store->vk, store->light_host);
    kd_vk_buffer_destroy(store->vk, store->star_pairs);
    kd_vk_buffer_destroy(store->vk, store->star_rays);
    kd_vk_buffer_destroy(store->vk, store->undecided);
    kd_vk_buffer_destroy(store->vk, store->undecided_host);
    kd_vk_buffer_destroy(store->vk, store->listed);
    kd_vk_buffer_destroy(store->vk, store->sample);
    kd_vk_buffer_destroy(store->vk, store->sample_index);
    kd_vk_buffer_destroy(store->vk, store->nodes);
    kd_vk_buffer_destroy(store->vk, store->sample_head);
}
