#include "server/render/shared.h"

#include "image/text_code.h"
#include "scene/link.h"
#include "server/render/scene_source.h"

#include <stdlib.h>
#include <string.h>

static bool refuse(struct kd_problem *problem, const struct kd_error *error)
{
    *problem = kd_problem_from(error);
    return false;
}

static bool nothing_there(struct kd_problem *problem, const struct kd_error *error)
{
    refuse(problem, error);
    if (error->status != KD_ENOMEM)
        problem->type = KD_PROBLEM_NOT_FOUND;
    return false;
}

/* Sets one field of the right picture. */
static enum kd_status set_right(struct kd_shared_scenes *scenes, const char *name, const char *value,
                                struct kd_error *error)
{
    static const char *const common[] = { "image.", "motion.", "accuracy." };
    bool both = !strcmp(name, "time");
    for (size_t i = 0; i < sizeof common / sizeof *common; i++)
        both |= !strncmp(name, common[i], strlen(common[i]));
    if (both)
        return kd_error_field(error, "/" KD_SHARED_PAIR,
                              "both pictures have the same %.100s; " KD_SHARED_PAIR " must not contain it", name);
    return kd_scene_set(&scenes->right, name, value, error);
}

static enum kd_status set_fields(struct kd_shared_scenes *scenes, const struct kd_target *fields,
                                 struct kd_error *error)
{
    /* the style is set first, because the order of parameters must not matter */
    for (size_t i = 0; i < 2 * fields->n_pairs; i++) {
        const struct kd_target_pair *pair = &fields->pairs[i % fields->n_pairs];
        const bool style = !strcmp(pair->name, "style.name");
        enum kd_status status =
            style == (i < fields->n_pairs) ? set_right(scenes, pair->name, pair->value, error) : KD_OK;
        if (status)
            return status;
    }
    return KD_OK;
}

/* Makes the right picture from the left one. fields: the fields that differ, as a query. */
static enum kd_status pair_up(struct kd_shared_scenes *scenes, const struct kd_target *fields, struct kd_error *error)
{
    const char *data = kd_target_value(fields, KD_SHARED_DATA);
    enum kd_status status;
    scenes->right = scenes->left;
    scenes->measured = data != NULL;
    KD_TRY(kd_scene_query_check(fields, true, NULL, error));
    if (data && (strcmp(data, "1") || fields->n_pairs > 1))
        KD_TRY(kd_error_set(error, KD_EINVAL,
                            KD_SHARED_PAIR "." KD_SHARED_DATA " is \"%.40s\"%s; it must be 1, without other fields",
                            data, fields->n_pairs > 1 ? " beside other fields" : ""));
    if (data)
        goto done;
    KD_TRY(set_fields(scenes, fields, error));
    KD_TRY(kd_scene_link_check(&scenes->right, error));
    KD_TRY(kd_scene_validate(&scenes->right, error));
done:
    if (status == KD_EINVAL && strcmp(error->pointer, "/" KD_SHARED_PAIR))
        kd_error_inside(error, "/" KD_SHARED_PAIR);
    return status;
}

/* Moves the parameters of the right picture to *right, without their prefix. */
static void part(struct kd_target *left, struct kd_target *right)
{
    static const char prefix[] = KD_SHARED_PAIR ".";
    size_t kept = 0;
    for (size_t i = 0; i < left->n_pairs; i++) {
        struct kd_target_pair pair = left->pairs[i];
        if (strncmp(pair.name, prefix, strlen(prefix))) {
            left->pairs[kept++] = pair;
        } else {
            pair.name += strlen(prefix);
            right->pairs[right->n_pairs++] = pair;
        }
    }
    left->n_pairs = kept;
}

static enum kd_status parse(const char *query, struct kd_target *target, struct kd_error *error)
{
    struct kd_buffer raw = { 0 };
    enum kd_status status;
    if (kd_buffer_printf(&raw, "/?%s", query))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory"));
    KD_TRY(kd_target_parse(target, (const char *)raw.data, error));
done:
    kd_buffer_finish(&raw);
    return status;
}

/* Parses the text as a query. */
static enum kd_status read_text(const char *text, struct kd_shared_scenes *scenes, struct kd_error *error)
{
    struct kd_target *left = calloc(1, sizeof *left), *right = calloc(1, sizeof *right);
    enum kd_status status;
    if (!left || !right)
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory"));
    KD_TRY(parse(text, left, error));
    part(left, right);
    KD_TRY(kd_scene_of_query(left, NULL, &scenes->left, error));
    KD_TRY(kd_scene_link_check(&scenes->left, error));
    KD_TRY(kd_scene_validate(&scenes->left, error));
    KD_TRY(pair_up(scenes, right, error));
done:
    if (left)
        kd_target_finish(left);
    free(left);
    free(right); /* frees only the struct, because its pointers point into the text of `left` */
    return status;
}

bool kd_shared_read(const char *code, struct kd_shared_scenes *scenes, struct kd_problem *problem,
                    struct kd_error *error)
{
    struct kd_buffer text = { 0 };
    if (kd_text_code_read(code, &text, error))
        return nothing_there(problem, error);
    const enum kd_status status = read_text((const char *)text.data, scenes, error);
    kd_buffer_finish(&text);
    return !status || refuse(problem, error);
}

bool kd_shared_of_request(const struct kd_request *request, struct kd_shared_scenes *scenes, struct kd_problem *problem,
                          struct kd_error *error)
{
    const char *text = kd_target_value(&request->target, KD_SHARED_PAIR);
    struct kd_target *fields;
    if (!kd_scene_of_request(request, &scenes->left, problem, error))
        return false;
    fields = calloc(1, sizeof *fields);
    enum kd_status status = fields ? parse(text ? text : "", fields, error) : KD_ENOMEM;
    if (!fields)
        kd_error_set(error, KD_ENOMEM, "out of memory");
    else if (status == KD_EINVAL)
        kd_error_inside(error, "/" KD_SHARED_PAIR);
    else if (!status)
        status = pair_up(scenes, fields, error);
    if (fields)
        kd_target_finish(fields);
    free(fields);
    return !status || refuse(problem, error);
}

bool kd_shared_preview(const struct kd_request *request, struct kd_scene *scene, struct kd_problem *problem,
                       struct kd_error *error)
{
    uint64_t width;
    if (!kd_target_whole(&request->target, KD_SHARED_WIDTH_NAME, KD_SHARED_WIDTH, KD_SHARED_WIDTH, &width) ||
        width < KD_SHARED_NARROWEST) {
        kd_error_field(error, "/" KD_SHARED_WIDTH_NAME, "width is \"%.40s\"; it must be %d to %d",
                       kd_target_value(&request->target, KD_SHARED_WIDTH_NAME), KD_SHARED_NARROWEST, KD_SHARED_WIDTH);
        refuse(problem, error);
        problem->type = KD_PROBLEM_INVALID_PARAMETERS;
        return false;
    }
    struct kd_shared_scenes *scenes = malloc(sizeof *scenes);
    if (!scenes) {
        kd_error_set(error, KD_ENOMEM, "out of memory");
        return refuse(problem, error);
    }
    const bool read = kd_shared_read(request->rest, scenes, problem, error);
    if (read) {
        *scene = scenes->left;
        kd_scene_link_preview(scene, (int32_t)width, kd_shared_height((int32_t)width));
    }
    free(scenes);
    return read;
}
