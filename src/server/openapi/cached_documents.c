#include "server/openapi/cached_documents.h"

#include "base/buffer.h"
#include "base/json.h"
#include "image/gzip.h"
#include "quantity/quantity.h"
#include "render/explain/approximations.h"
#include "scene/label.h"
#include "scene/scene.h"
#include "scene/sha256.h"
#include "server/openapi/openapi.h"
#include "server/openapi/route_table.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TAG = 64 + 2 + 1 };

struct document {
    struct kd_served served; /* its pointers point into the other members of this struct */
    char path[80], etags[2][TAG];
    struct kd_buffer plain, gzip;
};

struct kd_cached_documents {
    size_t n;
    struct document *documents;
};

static enum kd_status presets_json(struct kd_buffer *out)
{
    struct kd_json json = kd_json_begin(out);
    kd_json_object(&json, NULL);
    kd_json_array(&json, "presets");
    for (size_t i = 0; i < kd_scene_preset_count(); i++) {
        kd_json_object(&json, NULL);
        kd_json_string(&json, "name", kd_scene_preset_name(i));
        kd_json_string(&json, "label", kd_scene_preset_label(i));
        kd_json_string(&json, "title", kd_scene_preset_title(i));
        kd_json_end(&json);
    }
    kd_json_end(&json);
    kd_json_end(&json);
    return kd_json_finish_line(&json);
}

static const struct {
    const char *path, *type;
    enum kd_status (*make)(struct kd_buffer *out);
} makers[] = {
    { "/openapi.json", KD_JSON_TYPE, NULL /* made by kd_openapi_json, which has other parameters */ },
    { "/docs", KD_HTML_TYPE, kd_route_table_html },
    { "/v1/schema", "application/schema+json", kd_scene_schema },
    { "/v1/presets", KD_JSON_TYPE, presets_json },
    { "/v1/physics", KD_JSON_TYPE, kd_quantity_list_json },
    { "/v1/approximations", KD_JSON_TYPE, kd_approximations_json },
};
#define N_MAKERS (sizeof makers / sizeof *makers)

static void tag(const struct kd_buffer *bytes, char out[TAG])
{
    char hash[65];
    kd_sha256(bytes->data, bytes->size, hash);
    snprintf(out, TAG, "\"%s\"", hash);
}

static enum kd_status finish(struct document *d, const char *type)
{
    if (kd_buffer_append(&d->gzip, d->plain.data, d->plain.size))
        return KD_ENOMEM;
    bool packed = kd_gzip(&d->gzip, KD_GZIP_KEPT);
    tag(&d->plain, d->etags[0]);
    tag(&d->gzip, d->etags[1]);
    d->served = (struct kd_served) { d->path, type, { d->etags[0], d->plain.data, d->plain.size }, { 0 } };
    if (packed)
        d->served.gzip = (struct kd_served_form) { d->etags[1], d->gzip.data, d->gzip.size };
    return KD_OK;
}

static enum kd_status make(struct document *d, size_t i, const char *base_path, bool closed)
{
    struct kd_scene scene;
    struct kd_error error;
    if (i < N_MAKERS) {
        snprintf(d->path, sizeof d->path, "%s", makers[i].path);
        enum kd_status status =
            makers[i].make ? makers[i].make(&d->plain) : kd_openapi_json(base_path, closed, &d->plain);
        return status ? status : finish(d, makers[i].type);
    }
    const char *name = kd_scene_preset_name(i - N_MAKERS);
    snprintf(d->path, sizeof d->path, "/v1/presets/%s", name);
    if (kd_scene_preset(&scene, name, &error) || kd_scene_to_json(&scene, &d->plain))
        return KD_ENOMEM;
    return finish(d, KD_JSON_TYPE);
}

enum kd_status kd_cached_documents_create(const char *base_path, bool closed, struct kd_cached_documents **out,
                                          struct kd_error *error)
{
    struct kd_cached_documents *cache = calloc(1, sizeof *cache);
    size_t n = N_MAKERS + kd_scene_preset_count();
    enum kd_status status = KD_OK;
    if (cache)
        cache->documents = calloc(n, sizeof *cache->documents);
    if (!cache || !cache->documents)
        status = KD_ENOMEM;
    for (; !status && cache->n < n; cache->n++)
        status = make(&cache->documents[cache->n], cache->n, base_path, closed);
    if (!status)
        return *out = cache, KD_OK;
    kd_cached_documents_destroy(cache);
    return kd_error_set(error, KD_ENOMEM, "out of memory for the cached documents");
}

void kd_cached_documents_destroy(struct kd_cached_documents *cache)
{
    if (!cache)
        return;
    for (size_t i = 0; i < cache->n; i++) {
        kd_buffer_finish(&cache->documents[i].plain);
        kd_buffer_finish(&cache->documents[i].gzip);
    }
    free(cache->documents);
    free(cache);
}

const struct kd_served *kd_cached_documents_find(const struct kd_cached_documents *cache, const char *path)
{
    for (size_t i = 0; i < cache->n; i++)
        if (!strcmp(cache->documents[i].path, path))
            return &cache->documents[i].served;
    return NULL;
}
