#include "server/render/shared.h"

#include "image/text_code.h"
#include "scene/link.h"
#include "server/render/scene_source.h"

#include <stdlib.h>

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

/* Parses the text as a query. */
static enum kd_status read_text(const char *text, struct kd_scene *scene, struct kd_error *error)
{
    static const char *const none[] = { NULL };
    struct kd_buffer raw = { 0 };
    struct kd_target *target = calloc(1, sizeof *target);
    enum kd_status status;
    if (!target || kd_buffer_printf(&raw, "/?%s", text))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory"));
    KD_TRY(kd_target_parse(target, (const char *)raw.data, error));
    KD_TRY(kd_scene_of_query(target, none, scene, error));
    KD_TRY(kd_scene_link_check(scene, error));
    KD_TRY(kd_scene_validate(scene, error));
done:
    if (target)
        kd_target_finish(target);
    free(target);
    kd_buffer_finish(&raw);
    return status;
}

bool kd_shared_read(const char *code, struct kd_scene *scene, struct kd_problem *problem, struct kd_error *error)
{
    struct kd_buffer text = { 0 };
    if (kd_text_code_read(code, &text, error))
        return nothing_there(problem, error);
    const enum kd_status status = read_text((const char *)text.data, scene, error);
    kd_buffer_finish(&text);
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
    if (!kd_shared_read(request->rest, scene, problem, error))
        return false;
    kd_scene_link_preview(scene, (int32_t)width, kd_shared_height((int32_t)width));
    return true;
}
