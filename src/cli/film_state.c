#include "cli/film_state.h"

#include "base/json.h"
#include "base/read.h"
#include "base/replace.h"

#include <cjson/cJSON.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <string.h>

#define NAME "film.json"
#define FORMAT 1
#define BYTES_MAX 4096

static bool is_text(const cJSON *o, const char *name, const char *expected)
{
    const char *text = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(o, name));
    return text && !strcmp(text, expected);
}

static double number(const cJSON *o, const char *name)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(o, name);
    return cJSON_IsNumber(item) ? item->valuedouble : NAN;
}

static enum kd_status compare(const cJSON *o, const char *path, struct kd_film_state *state, struct kd_error *error)
{
    const char *version = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(o, "version")),
               *device = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(o, "device"));
    if (number(o, "format") != FORMAT || !version || !device)
        return kd_error_set(
            error, KD_EINVAL,
            "%.200s/" NAME
            " was not written by this version of kerrd: name another folder by --state, or remove this one",
            path);
    if (!is_text(o, "version", KD_VERSION) || !is_text(o, "device", state->device))
        return kd_error_set(error, KD_EINVAL,
                            "the frames in %.200s were made by kerrd %.40s on %.80s, and this is kerrd " KD_VERSION
                            " on %.80s, whose pictures may differ: name another folder by "
                            "--state, or remove this one",
                            path, version, device, state->device);
    if (!is_text(o, "request", state->request) || number(o, "frames") != state->frames)
        return kd_error_set(
            error, KD_EINVAL,
            "the frames in %.200s belong to another request: name another folder by --state, or remove this one", path);
    state->exposure = number(o, "exposure");
    return KD_OK;
}

enum kd_status kd_film_state_read(int folder, const char *path, struct kd_film_state *state, bool *there,
                                  struct kd_error *error)
{
    struct kd_buffer text = { 0 };
    cJSON *root = NULL;
    enum kd_status status = KD_OK;
    *there = kd_read_file(folder, NAME, O_NOFOLLOW, BYTES_MAX, &text);
    if (!*there && errno != ENOENT)
        status = kd_error_set(error, KD_EINVAL, "%.200s/" NAME " cannot be read: %s", path, strerror(errno));
    if (*there) {
        root = cJSON_ParseWithLength((const char *)text.data, text.size);
        status = compare(root, path, state, error);
    }
    cJSON_Delete(root);
    kd_buffer_finish(&text);
    return status;
}

enum kd_status kd_film_state_write(int folder, const struct kd_film_state *state, struct kd_error *error)
{
    struct kd_buffer text = { 0 };
    struct kd_json json = kd_json_begin_lines(&text);
    kd_json_object(&json, NULL);
    kd_json_number(&json, "format", FORMAT);
    kd_json_string(&json, "request", state->request);
    kd_json_number(&json, "frames", state->frames);
    kd_json_string(&json, "version", KD_VERSION);
    kd_json_string(&json, "device", state->device);
    kd_json_number(&json, "exposure", state->exposure);
    kd_json_end(&json);
    enum kd_status status = kd_json_finish(&json);
    if (status)
        kd_error_set(error, status, "out of memory for " NAME);
    else if (!kd_replace_file_at(folder, NAME, text.data, text.size))
        status = kd_error_set(error, KD_EIO, NAME " cannot be written: %s", strerror(errno));
    kd_buffer_finish(&text);
    return status;
}
