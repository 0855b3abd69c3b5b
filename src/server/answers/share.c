/* Handlers of /v1/share, which makes the address of a scene, and of /oembed, which describes a shared scene for
 * sites that embed it. */
#include "server/answers/share.h"

#include "base/json.h"
#include "image/text_code.h"
#include "scene/difference.h"
#include "scene/label.h"
#include "scene/link.h"
#include "server/http/cors.h"
#include "server/http/public_url.h"
#include "server/http/reply.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#define PLAIN_TITLE "Black hole"
#define PLAIN_ABOUT "A Kerr black hole with a thin disk of gas, ray-traced"

static enum kd_status tell_preset(const char *name, struct kd_shared *out)
{
    size_t i = 0;
    while (name && kd_scene_preset_name(i) && strcmp(kd_scene_preset_name(i), name))
        i++;
    const bool known = name && kd_scene_preset_name(i);
    enum kd_status status = kd_buffer_printf(&out->title, "%s", known ? kd_scene_preset_label(i) : PLAIN_TITLE);
    return status ? status : kd_buffer_printf(&out->about, "%s.", known ? kd_scene_preset_title(i) : PLAIN_ABOUT);
}

/* Describes the fields of a query in words. Writes nothing if there are none. */
static enum kd_status tell_changes(const struct kd_target *target, const char *before, struct kd_buffer *out)
{
    struct kd_scene_changed *changed = calloc(target->n_pairs + 1, sizeof *changed);
    size_t n = 0;
    enum kd_status status;
    KD_TRY(changed ? KD_OK : KD_ENOMEM);
    for (size_t i = 0; i < target->n_pairs; i++)
        if (strcmp(target->pairs[i].name, "preset"))
            changed[n++] = (struct kd_scene_changed) { target->pairs[i].name, target->pairs[i].value };
    if (!n)
        goto done;
    KD_TRY(kd_buffer_printf(out, "%s", before));
    KD_TRY(kd_scene_link_tell(changed, n, out));
    KD_TRY(kd_buffer_printf(out, "."));
done:
    free(changed);
    return status;
}

/* Describes the scene of a query in words. preset: true if the name of its preset is included. */
static enum kd_status tell_query(const char *query, bool preset, const char *before, struct kd_shared *out,
                                 struct kd_error *error)
{
    struct kd_buffer raw = { 0 };
    struct kd_target *target = calloc(1, sizeof *target);
    enum kd_status status;
    KD_TRY(target ? KD_OK : KD_ENOMEM);
    KD_TRY(kd_buffer_printf(&raw, "/?%s", query));
    KD_TRY(kd_target_parse(target, (const char *)raw.data, error));
    if (preset)
        KD_TRY(tell_preset(kd_target_value(target, "preset"), out));
    KD_TRY(tell_changes(target, before, &out->about));
done:
    if (target)
        kd_target_finish(target);
    free(target);
    kd_buffer_finish(&raw);
    return status;
}

/* Writes each field with the prefix of the right picture. fields: output of kd_scene_difference. */
static enum kd_status add_prefix(const char *fields, struct kd_buffer *out)
{
    enum kd_status status = kd_buffer_printf(out, "%s", "");
    for (const char *at = fields; *at && !status;) {
        const size_t n = strcspn(at, "&");
        status = kd_buffer_printf(out, "%s" KD_SHARED_PAIR ".%.*s", at == fields ? "" : "&", (int)n, at);
        at += n + (at[n] == '&');
    }
    return status;
}

static enum kd_status tell_right(const struct kd_shared_scenes *scenes, const char *fields, struct kd_shared *out,
                                 struct kd_error *error)
{
    struct kd_buffer link = { 0 };
    enum kd_status status;
    KD_TRY(kd_scene_link(&scenes->right, &link, error));
    KD_TRY(kd_text_code_write(link.data, link.size, &out->other, error));
    KD_TRY(kd_buffer_printf(&out->title, ", side by side"));
    KD_TRY(tell_query(fields, false, " Beside it the same with ", out, error));
done:
    kd_buffer_finish(&link);
    return status;
}

/* Describes both sides of a pair, and writes the fields that differ. */
static enum kd_status tell_sides(const struct kd_shared_scenes *scenes, struct kd_shared *out, struct kd_error *error)
{
    struct kd_buffer fields = { 0 };
    enum kd_status status;
    KD_TRY(tell_query((const char *)out->link.data, true, " Here with ", out, error));
    KD_TRY(kd_buffer_printf(&fields, "%s", ""));
    if (scenes->measured) {
        KD_TRY(kd_buffer_printf(&fields, KD_SHARED_DATA "=1"));
        KD_TRY(kd_buffer_printf(&out->title, ", beside what was measured"));
        KD_TRY(kd_buffer_printf(&out->about, " Beside it what the Event Horizon Telescope measured of M87*."));
    } else {
        KD_TRY(kd_scene_difference(&scenes->left, &scenes->right, '&', &fields));
        if (fields.size)
            KD_TRY(tell_right(scenes, (const char *)fields.data, out, error));
    }
    KD_TRY(add_prefix((const char *)fields.data, &out->pair));
done:
    kd_buffer_finish(&fields);
    return status;
}

static enum kd_status make_code(struct kd_shared *out, struct kd_error *error)
{
    struct kd_buffer text = { 0 };
    enum kd_status status;
    KD_TRY(kd_buffer_printf(&text, "%s%s%s", (const char *)out->link.data, out->link.size && out->pair.size ? "&" : "",
                            (const char *)out->pair.data));
    KD_TRY(kd_text_code_write(text.data, text.size, &out->code, error));
done:
    kd_buffer_finish(&text);
    return status;
}

enum kd_status kd_shared_sign(const struct kd_request *request, const char *path, struct kd_buffer *out)
{
    struct kd_error ignored;
    if (!request->link.on)
        return kd_buffer_printf(out, "%s", "");
    const enum kd_status status = kd_buffer_printf(out, "?");
    return status ? status
                  : kd_link_sign(request->server->access, request->link.signer, path, NULL, &request->link.terms, out,
                                 &ignored);
}

/* Writes the address of a path on this server. */
static enum kd_status tell_address(const struct kd_request *request, const struct kd_shared *shared, const char *path,
                                   struct kd_buffer *out)
{
    const enum kd_status status = kd_buffer_printf(out, "%s%s", (const char *)shared->home.data, path);
    return status ? status : kd_shared_sign(request, path, out);
}

static enum kd_status tell_addresses(const struct kd_request *request, struct kd_shared *out)
{
    const char *code = (const char *)out->code.data;
    struct kd_buffer page = { 0 }, picture = { 0 }, other = { 0 };
    enum kd_status status;
    KD_TRY(kd_public_url_write(request, &out->home));
    KD_TRY(kd_buffer_printf(&page, "/s/%s", code));
    KD_TRY(kd_buffer_printf(&picture, "/v1/share/%s/picture.png", code));
    KD_TRY(tell_address(request, out, (const char *)page.data, &out->address));
    KD_TRY(tell_address(request, out, (const char *)picture.data, &out->picture));
    KD_TRY(kd_buffer_printf(&out->other_picture, "%s", ""));
    if (out->other.size) {
        KD_TRY(kd_buffer_printf(&other, "/v1/share/%s/picture.png", (const char *)out->other.data));
        KD_TRY(tell_address(request, out, (const char *)other.data, &out->other_picture));
    }
done:
    kd_buffer_finish(&page);
    kd_buffer_finish(&picture);
    kd_buffer_finish(&other);
    return status;
}

enum kd_status kd_shared_tell(const struct kd_request *request, const struct kd_shared_scenes *scenes,
                              struct kd_shared *out, struct kd_error *error)
{
    enum kd_status status;
    *out = (struct kd_shared) { 0 };
    KD_TRY(kd_scene_link(&scenes->left, &out->link, error));
    KD_TRY(tell_sides(scenes, out, error));
    KD_TRY(make_code(out, error));
    KD_TRY(tell_addresses(request, out));
done:
    return status == KD_ENOMEM ? kd_error_set(error, KD_ENOMEM, "out of memory") : status;
}

void kd_shared_finish(struct kd_shared *shared)
{
    struct kd_buffer *all[] = { &shared->link,  &shared->code,         &shared->title, &shared->about,
                                &shared->pair,  &shared->address,      &shared->home,  &shared->picture,
                                &shared->other, &shared->other_picture };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        kd_buffer_finish(all[i]);
}

enum kd_status kd_shared_fragment(const struct kd_shared *shared, struct kd_buffer *out)
{
    const char *text = (const char *)shared->link.data, *pair = (const char *)shared->pair.data;
    const char *plain = strncmp(text, "preset=", strlen("preset=")) ? "preset=default" : "";
    return kd_buffer_printf(out, "%s%s%s%s%s", plain, *plain && *text ? "&" : "", text, *pair ? "&" : "", pair);
}

/* Adds an address of this server. It is absolute if the public address is known. Otherwise it is relative to the
 * address of the request, like Location. */
static enum kd_status add_address(const struct kd_request *request, struct kd_json *json, const char *name,
                                  const char *path, const char *rest)
{
    struct kd_buffer url = { 0 };
    enum kd_status status =
        kd_buffer_printf(&url, "%s/%s%s", request->server->public_url ? request->server->public_url : "..", path, rest);
    if (!status)
        kd_json_string(json, name, (const char *)url.data);
    kd_buffer_finish(&url);
    return status;
}

/* Adds the address of a shared scene, signed with the server's key for shared scenes (--share-key). */
static enum kd_status add_signed(const struct kd_request *request, const char *code, struct kd_json *json)
{
    const struct kd_server *server = request->server;
    const struct kd_link_terms terms = { .expires_s = (uint64_t)time(NULL) + KD_SHARED_DAYS * 86400 };
    struct kd_buffer path = { 0 }, rest = { 0 };
    struct kd_error ignored;
    enum kd_status status;
    KD_TRY(kd_buffer_printf(&path, "/s/%s", code));
    KD_TRY(kd_buffer_printf(&rest, "%s?", code));
    KD_TRY(kd_link_sign(server->access, server->share_key, (const char *)path.data, NULL, &terms, &rest, &ignored));
    KD_TRY(add_address(request, json, "url", "s/", (const char *)rest.data));
    kd_json_number(json, "expires", (double)terms.expires_s);
done:
    kd_buffer_finish(&path);
    kd_buffer_finish(&rest);
    return status;
}

/* Adds the address to share, and, if there are origins that may embed it, the address for frames. If the server has
 * access tokens but no key for shared scenes, the address to share is that of the page itself, which asks the
 * visitor for a token. */
static enum kd_status add_addresses(const struct kd_request *request, const struct kd_shared *shared,
                                    struct kd_json *json)
{
    const char *code = (const char *)shared->code.data;
    struct kd_buffer fragment = { 0 };
    enum kd_status status;
    KD_TRY(kd_shared_fragment(shared, &fragment));
    KD_TRY(request->server->share_key ? add_signed(request, code, json)
           : request->server->access  ? add_address(request, json, "url", "#", (const char *)fragment.data)
                                      : add_address(request, json, "url", "s/", code));
    if (kd_cors_embedders(request->server->cors))
        KD_TRY(add_address(request, json, "embed", "embed/", code));
done:
    kd_buffer_finish(&fragment);
    return status;
}

static enum kd_status share_json(const struct kd_request *request, const struct kd_shared *shared,
                                 struct kd_buffer *out)
{
    struct kd_json json = kd_json_begin(out);
    kd_json_object(&json, NULL);
    enum kd_status status = add_addresses(request, shared, &json);
    kd_json_string(&json, "code", (const char *)shared->code.data);
    if (shared->other.size)
        kd_json_string(&json, "other", (const char *)shared->other.data);
    kd_json_string(&json, "title", (const char *)shared->title.data);
    kd_json_string(&json, "about", (const char *)shared->about.data);
    kd_json_end(&json);
    return status ? status : kd_json_finish_line(&json);
}

enum MHD_Result kd_handle_share(struct kd_request *request)
{
    struct kd_shared_scenes scenes;
    struct kd_problem problem;
    struct kd_error error = { 0 };
    struct kd_shared shared;
    struct kd_buffer body = { 0 };
    if (!kd_shared_of_request(request, &scenes, &problem, &error))
        return kd_reply_problem(request, &problem);
    enum kd_status status = kd_shared_tell(request, &scenes, &shared, &error);
    enum MHD_Result result = status ? kd_reply_error(request, &error)
                                    : kd_reply_json(request, share_json(request, &shared, &body), &body, KD_JSON_TYPE);
    kd_shared_finish(&shared);
    return result;
}

/* Returns the code (malloc'd) from the address of a shared scene on this server; query and fragment of the address
 * are ignored. Returns NULL for any other address, or when out of memory. */
static char *code_in(const struct kd_request *request, const char *url)
{
    struct kd_buffer home = { 0 };
    const enum kd_status status = kd_public_url_write(request, &home);
    const char *at = url;
    const bool ours = !status && !strncmp(at, (const char *)home.data, home.size) && !strncmp(at + home.size, "/s/", 3);
    at += ours ? home.size + 3 : 0;
    kd_buffer_finish(&home);
    return ours ? strndup(at, strcspn(at, "/?#")) : NULL;
}

/* Chooses the width of the largest picture that fits within maxwidth and maxheight. */
static bool width_of(const struct kd_request *request, int32_t *width, struct kd_error *error)
{
    static const char *const names[] = { "maxwidth", "maxheight" };
    uint64_t most[2];
    for (int i = 0; i < 2; i++) {
        const int least = i ? kd_shared_height(KD_SHARED_NARROWEST) : KD_SHARED_NARROWEST;
        if (kd_target_whole(&request->target, names[i], KD_SHARED_WIDTH, 1000000, &most[i]) &&
            most[i] >= (uint64_t)least)
            continue;
        kd_error_set(error, KD_EINVAL, "%s is \"%.40s\"; it must be %d to 1000000", names[i],
                     kd_target_value(&request->target, names[i]), least);
        return false;
    }
    *width = most[0] < KD_SHARED_WIDTH ? (int32_t)most[0] : KD_SHARED_WIDTH;
    while (kd_shared_height(*width) > (int64_t)most[1])
        --*width;
    return true;
}

static enum kd_status oembed_json(const struct kd_shared *shared, int32_t width, struct kd_buffer *out)
{
    struct kd_buffer picture = { 0 };
    enum kd_status status = kd_buffer_printf(&picture, "%s", (const char *)shared->picture.data);
    struct kd_json json = kd_json_begin(out);
    if (!status && width < KD_SHARED_WIDTH)
        status = kd_buffer_printf(&picture, "?" KD_SHARED_WIDTH_NAME "=%d", (int)width);
    if (!status) {
        kd_json_object(&json, NULL);
        kd_json_string(&json, "version", "1.0");
        kd_json_string(&json, "type", "photo");
        kd_json_string(&json, "title", (const char *)shared->title.data);
        kd_json_string(&json, "provider_name", "kerrd");
        kd_json_string(&json, "provider_url", (const char *)shared->home.data);
        kd_json_string(&json, "url", (const char *)picture.data);
        kd_json_number(&json, "width", width);
        kd_json_number(&json, "height", kd_shared_height(width));
        kd_json_end(&json);
        status = kd_json_finish_line(&json);
    }
    kd_buffer_finish(&picture);
    return status;
}

static enum MHD_Result refuse(struct kd_request *request, enum kd_problem_type type, const char *detail,
                              const char *pointer)
{
    return kd_reply_problem(request, &(struct kd_problem) { .type = type, .detail = detail, .pointer = pointer });
}

static enum MHD_Result tell_oembed(struct kd_request *request, const char *code, int32_t width)
{
    struct kd_shared_scenes scenes;
    struct kd_problem problem;
    struct kd_error error = { 0 };
    struct kd_shared shared;
    struct kd_buffer body = { 0 };
    if (!kd_shared_read(code, &scenes, &problem, &error))
        return refuse(request, KD_PROBLEM_NOT_FOUND, error.message, NULL);
    enum kd_status status = kd_shared_tell(request, &scenes, &shared, &error);
    enum MHD_Result result = status ? kd_reply_error(request, &error)
                                    : kd_reply_json(request, oembed_json(&shared, width, &body), &body, KD_JSON_TYPE);
    kd_shared_finish(&shared);
    return result;
}

/* oEmbed 1.0, https://oembed.com. Answers 404 for addresses other than those of shared scenes. */
enum MHD_Result kd_handle_oembed(struct kd_request *request)
{
    struct kd_error error = { 0 };
    int32_t width;
    const char *url = kd_target_value(&request->target, "url"), *format = kd_target_value(&request->target, "format");
    if (!url)
        return refuse(request, KD_PROBLEM_INVALID_PARAMETERS,
                      "url is missing; it must be the address of a shared scene from /v1/share", "/url");
    if (format && strcmp(format, "json"))
        return refuse(request, KD_PROBLEM_INVALID_PARAMETERS, "format must be json", "/format");
    if (!width_of(request, &width, &error))
        return refuse(request, KD_PROBLEM_INVALID_PARAMETERS, error.message, NULL);
    char *code = code_in(request, url);
    enum MHD_Result result =
        code ? tell_oembed(request, code, width)
             : refuse(request, KD_PROBLEM_NOT_FOUND, "url must be the address of a shared scene of this server", NULL);
    free(code);
    return result;
}
