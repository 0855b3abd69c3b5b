#include "render/device/panoramas.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Looks for the bytes of an asset. */
static enum kd_status take(const struct kd_assets *assets, const char *hash, struct kd_asset_bytes *out, struct kd_error *error)
{
    if (assets && assets->take(assets->user, hash, out))
        return KD_OK;
    return kd_error_field(error, "/sky/image", "sky.image is \"%s\", and the bytes of this asset are not here; allowed are %s", hash,
                          assets ? assets->allowed : "none where there are no assets");
}

/* Bytes of a hash never change: what is no sound picture never will be one. */
static enum kd_status refuse(struct kd_panoramas *all, const char *hash, const struct kd_error *why, struct kd_error *error)
{
    if (why->status == KD_EINVAL) {
        memcpy(all->broken, hash, sizeof all->broken);
        all->why = *why;
    }
    if (error)
        *error = *why;
    return why->status;
}

static enum kd_status fill(struct kd_panorama *p, struct kd_sky_picture *picture, struct kd_error *error)
{
    p->columns = picture->width;
    p->rows = picture->height;
    p->words = malloc(kd_panorama_words(p->columns, p->rows) * sizeof *p->words);
    return p->words ? kd_panorama_fill(picture, p->words, error) : kd_error_set(error, KD_ENOMEM, "out of memory for a panorama");
}

/* The place of the one that was asked for longest ago, emptied. */
static struct kd_panorama *room(struct kd_panoramas *all)
{
    struct kd_panorama *oldest = all->at;
    for (int i = 1; i < KD_PANORAMAS; i++)
        if (all->at[i].used < oldest->used)
            oldest = &all->at[i];
    free(oldest->words);
    *oldest = (struct kd_panorama) { 0 };
    return oldest;
}

static const struct kd_panorama *kept(struct kd_panoramas *all, const char *of)
{
    for (int i = 0; i < KD_PANORAMAS; i++)
        if (!strcmp(all->at[i].of, of)) {
            all->at[i].used = ++all->used;
            return &all->at[i];
        }
    return NULL;
}

/* Puts a panorama of this picture into a place that is empty. */
static enum kd_status keep(struct kd_panoramas *all, const char *of, const char *credit, struct kd_sky_picture *picture, struct kd_panorama *place,
                           struct kd_error *error)
{
    struct kd_panorama made = { .used = ++all->used };
    enum kd_status status = fill(&made, picture, error);
    if (status) {
        free(made.words);
        return status;
    }
    snprintf(made.of, sizeof made.of, "%s", of);
    snprintf(made.credit, sizeof made.credit, "%s", credit);
    *place = made;
    return KD_OK;
}

/* Place is made for it before it is there: memory for four is not for three. */
static enum kd_status of_image(struct kd_panoramas *all, const char *hash, const struct kd_panorama **out, struct kd_error *error)
{
    struct kd_asset_bytes bytes;
    struct kd_sky_picture picture;
    struct kd_error why = { 0 };
    char credit[KD_SKY_CREDIT] = "";
    if (!strcmp(all->broken, hash))
        return refuse(all, hash, &all->why, error);
    enum kd_status status = take(all->assets, hash, &bytes, error);
    if (status)
        return status;
    struct kd_panorama *place = room(all);
    status = kd_sky_image(bytes.data, bytes.size, &picture, credit, &why);
    all->assets->give_back(all->assets->user, &bytes);
    status = status ? refuse(all, hash, &why, error) : keep(all, hash, credit, &picture, place, error);
    kd_sky_picture_finish(&picture);
    *out = place;
    return status;
}

enum kd_status kd_panorama_of(struct kd_panoramas *all, const struct kd_scene *scene, const struct kd_panorama **out, struct kd_error *error)
{
    char seed[KD_ASSET_NAME];
    struct kd_sky_picture picture = { 0 };
    snprintf(seed, sizeof seed, "seed %d", scene->sky.seed);
    if ((*out = kept(all, *scene->sky.image ? scene->sky.image : seed)))
        return KD_OK;
    if (*scene->sky.image)
        return of_image(all, scene->sky.image, out, error);
    struct kd_panorama *place = room(all);
    enum kd_status status = kd_milky_way(scene->sky.seed, &picture, error);
    if (!status)
        status = keep(all, seed, "", &picture, place, error);
    kd_sky_picture_finish(&picture);
    *out = place;
    return status;
}

void kd_panoramas_finish(struct kd_panoramas *all)
{
    for (int i = 0; i < KD_PANORAMAS; i++)
        free(all->at[i].words);
    *all = (struct kd_panoramas) { 0 };
}
