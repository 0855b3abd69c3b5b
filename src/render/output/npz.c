/* Writes a frame's layers as numpy.savez does: kd_format_npz. The file has a member NAME.npy for each word of
 * image.layers: float32, of the shape (height, width), or (height, width, 3) for "rgb". The member notes.json has the
 * same metadata as the text of a PNG, and units. */
#include "render/output/format.h"

#include "base/json.h"
#include "image/npy.h"
#include "image/unzip.h"
#include "image/zip.h"
#include "render/output/notes.h"
#include "render/output/numbers.h"
#include "document/tree.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <string.h>

static enum kd_status put_array(struct kd_zip *zip, const struct kd_frame *frame, const struct kd_number_layer *layer)
{
    const uint32_t channels = layer->layer->channels;
    const struct kd_npy array = {
        .n_fields = 1,
        .fields = { { .type = KD_NPY_F4 } },
        .shape = { frame->height, frame->width, channels },
        .n_dimensions = channels > 1 ? 3 : 2,
    };
    struct kd_buffer file = { 0 };
    char name[KD_LAYER_NAME + 8];
    enum kd_status status;
    snprintf(name, sizeof name, "%s.npy", layer->name);
    KD_TRY(kd_npy_write_header(&array, &file));
    KD_TRY(kd_buffer_append(&file, layer->layer->data, 4ull * channels * frame->width * frame->height));
    KD_TRY(kd_zip_add(zip, name, file.data, file.size));
done:
    kd_buffer_finish(&file);
    return status;
}

static enum kd_status put_notes(struct kd_zip *zip, const struct kd_picture *picture, const struct kd_notes *notes,
                                const struct kd_numbers *numbers)
{
    struct kd_buffer text = { 0 };
    struct kd_approximation one;
    struct kd_json json = kd_json_begin(&text);
    kd_json_object(&json, NULL);
    kd_json_raw(&json, "scene", (const char *)notes->scene.data, notes->scene.size);
    kd_json_string(&json, "hash", notes->hash);
    kd_json_string(&json, "version", KD_VERSION);
    kd_json_string(&json, "device", picture->device);
    kd_json_string(&json, "accuracy", notes->accuracy);
    kd_json_array(&json, "approximations");
    for (size_t i = 0; kd_picture_approximation(&picture->plan->report, &picture->frame->accuracy, i, &one); i++)
        kd_json_string(&json, NULL, one.text);
    kd_json_end(&json);
    kd_json_object(&json, "units");
    for (size_t i = 0; i < numbers->n; i++)
        kd_json_string(&json, numbers->at[i].name, numbers->at[i].unit);
    kd_json_end(&json);
    if (*picture->frame->credit)
        kd_json_string(&json, "credit", picture->frame->credit);
    if (*notes->clock)
        kd_json_string(&json, "clock", notes->clock);
    if (*notes->flux)
        kd_json_string(&json, "flux", notes->flux);
    kd_json_end(&json);
    enum kd_status status = kd_json_finish(&json);
    if (!status)
        status = kd_zip_add(zip, "notes.json", text.data, text.size);
    kd_buffer_finish(&text);
    return status;
}

static enum kd_status encode(const struct kd_picture *picture, enum kd_effort effort, void **memory,
                             struct kd_buffer *out, struct kd_error *error)
{
    struct kd_numbers numbers;
    struct kd_notes notes = { 0 };
    struct kd_zip *zip = NULL;
    enum kd_status status;
    (void)effort, (void)memory;
    KD_TRY(kd_numbers_of(picture, &numbers, error));
    KD_TRY(kd_notes_of(picture, &notes, error));
    status = kd_zip_create(out, false, &zip);
    for (size_t i = 0; i < numbers.n && !status; i++)
        status = put_array(zip, picture->frame, &numbers.at[i]);
    status = status ? status : put_notes(zip, picture, &notes, &numbers);
    status = status ? status : kd_zip_close(zip);
    if (status)
        kd_error_set(error, status, "out of memory for an NPZ file of %zu layers", numbers.n);
done:
    kd_zip_destroy(zip);
    kd_notes_finish(&notes);
    return status;
}

static enum kd_status scene_in(const void *data, size_t size, struct kd_scene *out, struct kd_error *error)
{
    struct kd_buffer text = { 0 };
    struct kd_unzip zip;
    enum kd_status status = kd_unzip_open(data, size, &zip, NULL);
    const struct kd_unzip_member *member = status ? NULL : kd_unzip_find(&zip, "notes.json");
    if (member)
        status = kd_unzip_take(&zip, member, 2 * KD_SCENE_JSON_MAX, &text, NULL);
    kd_unzip_finish(&zip);
    bool starved = false;
    cJSON *notes = !text.size ? NULL : kd_tree_read((const char *)text.data, text.size, &starved);
    cJSON *scene = cJSON_GetObjectItemCaseSensitive(notes, "scene");
    char *printed = scene ? cJSON_PrintUnformatted(scene) : NULL;
    if (status == KD_ENOMEM || starved || (scene && !printed))
        status = kd_error_set(error, KD_ENOMEM, "out of memory for the notes of an NPZ file");
    else
        status = printed ? kd_notes_scene(printed, strlen(printed), out, error)
                         : kd_error_set(error, KD_EINVAL,
                                        "the NPZ file contains no scene: its notes.json is missing or has none");
    cJSON_free(printed);
    cJSON_Delete(notes);
    kd_buffer_finish(&text);
    return status;
}

const struct kd_format kd_format_npz = {
    .name = "npz",
    .media_type = KD_NPZ_TYPE,
    .magic = "PK\x03\x04",
    .carries = KD_CARRIES_LAYERS,
    .encode = encode,
    .scene = scene_in,
};
