#include "render/device/panoramas.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static enum kd_status read_image(const struct kd_assets *assets, const char *hash, struct kd_sky_picture *out, char credit[KD_SKY_CREDIT],
                                 struct kd_error *error)
{
    struct kd_asset_bytes bytes;
    if (!assets || !assets->take(assets->user, hash, &bytes))
        return kd_error_field(error, "/sky/image", "sky.image is \"%s\", and the bytes of this asset are not here; allowed are %s", hash,
                              assets ? assets->allowed : "none where there are no assets");
    enum kd_status status = kd_sky_image(bytes.data, bytes.size, out, credit, error);
    assets->give_back(assets->user, &bytes);
    return status;
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

enum kd_status kd_panorama_of(struct kd_panoramas *all, const struct kd_scene *scene, const struct kd_panorama **out, struct kd_error *error)
{
    char of[KD_ASSET_NAME];
    struct kd_sky_picture picture = { 0 };
    struct kd_panorama made = { .used = ++all->used };
    enum kd_status status;
    snprintf(of, sizeof of, "%s", scene->sky.image);
    if (!*of)
        snprintf(of, sizeof of, "seed %d", scene->sky.seed);
    for (int i = 0; i < KD_PANORAMAS; i++)
        if (!strcmp(all->at[i].of, of)) {
            all->at[i].used = all->used;
            *out = &all->at[i];
            return KD_OK;
        }
    struct kd_panorama *place = room(all); /* before there is another one: memory for four is not for three */
    KD_TRY(*scene->sky.image ? read_image(all->assets, of, &picture, made.credit, error) : kd_milky_way(scene->sky.seed, &picture, error));
    KD_TRY(fill(&made, &picture, error));
    memcpy(made.of, of, sizeof of);
    *place = made;
    made.words = NULL;
    *out = place;
done:
    free(made.words);
    kd_sky_picture_finish(&picture);
    return status;
}

void kd_panoramas_finish(struct kd_panoramas *all)
{
    for (int i = 0; i < KD_PANORAMAS; i++)
        free(all->at[i].words);
    *all = (struct kd_panoramas) { 0 };
}
