#include "render/explain/approximations.h"

#include "base/json.h"
#include "render/emit/emitter.h"
#include "render/output/notes.h"
#include "render/plan/plan.h"
#include "render/rays/answer.h"

#include <string.h>

static const char introduction[] =
    "# What is approximated\n"
    "\n"
    "Every plan (`kerrd plan`) and every picture lists the approximations of its scene. Those in force \"if there are "
    "such\" are\n"
    "found while a picture is rendered, so that only the picture has them. The header `Kerrd-Approximations` has "
    "their\n"
    "names, and `GET /v1/approximations` has the sentence for each name. This page has all sentences. It is generated "
    "from the\n"
    "emitters (`src/render/emit/emitter.h`), `src/render/plan/plan.c`, `src/render/output/notes.c` and\n"
    "`src/render/rays/answer.c`; do not edit it. The chapters on the [physics](physics/README.md) explain them.\n"
    "\n"
    "No scene models the following effects, so no list has them: the motion of gas by its own forces, magnetic fields "
    "that gas carries\n"
    "along, and scattering of light on its way.\n";

static const char present[] = "in each scene that has it", sometimes[] = "in some scenes";

#define OF_ANY "any picture"
#define OF_RAYS "lists of rays"

static enum kd_status add_table(struct kd_buffer *page, const char *of)
{
    return kd_buffer_printf(page, "\n## %s\n\n| name | sentence | in force |\n|---|---|---|\n", of);
}

static enum kd_status add_row(struct kd_buffer *page, const char *name, const char *text, const char *when)
{
    return kd_buffer_printf(page, "| `%s` | %s | %s |\n", name, text, when);
}

static enum kd_status add_emitter(struct kd_buffer *page, const struct kd_emitter *emitter)
{
    enum kd_status status;
    KD_TRY(add_table(page, emitter->name));
    for (size_t i = 0; i < emitter->n_sentences; i++)
        KD_TRY(add_row(page, emitter->sentences[i].name, emitter->sentences[i].text,
                       emitter->sentences[i].in_force ? sometimes : present));
    if (emitter->kind)
        KD_TRY(kd_buffer_printf(page, "\nThe sentences of the %s apply as well.\n", emitter->kind->name));
done:
    return status;
}

enum kd_status kd_approximations_page(struct kd_buffer *page)
{
    enum kd_status status;
    struct kd_approximation one;
    KD_TRY(kd_buffer_append(page, introduction, strlen(introduction)));
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        KD_TRY(add_emitter(page, kd_emitters[i]));
    KD_TRY(add_table(page, OF_ANY));
    for (size_t i = 0; i < kd_plan_sentence_count(); i++)
        KD_TRY(add_row(page, kd_plan_sentence(i).name, kd_plan_sentence(i).text, sometimes));
    for (size_t i = 0; kd_measured_approximation(NULL, i, &one); i++)
        KD_TRY(add_row(page, one.name, one.text, "if there are such"));
    KD_TRY(add_table(page, OF_RAYS));
    for (size_t i = 0; kd_rays_approximation(NULL, i, &one); i++)
        KD_TRY(add_row(page, one.name, one.text, "of some lists"));
done:
    return status;
}

static void add_object(struct kd_json *json, const char *name, const char *of, const char *text)
{
    kd_json_object(json, NULL);
    kd_json_string(json, "name", name);
    kd_json_string(json, "of", of);
    kd_json_string(json, "sentence", text);
    kd_json_end(json);
}

enum kd_status kd_approximations_json(struct kd_buffer *out)
{
    struct kd_json json = kd_json_begin(out);
    struct kd_approximation one;
    kd_json_object(&json, NULL);
    kd_json_array(&json, "approximations");
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        for (size_t k = 0; k < kd_emitters[i]->n_sentences; k++)
            add_object(&json, kd_emitters[i]->sentences[k].name, kd_emitters[i]->name,
                       kd_emitters[i]->sentences[k].text);
    for (size_t i = 0; i < kd_plan_sentence_count(); i++)
        add_object(&json, kd_plan_sentence(i).name, OF_ANY, kd_plan_sentence(i).text);
    for (size_t i = 0; kd_measured_approximation(NULL, i, &one); i++)
        add_object(&json, one.name, OF_ANY, one.text);
    for (size_t i = 0; kd_rays_approximation(NULL, i, &one); i++)
        add_object(&json, one.name, OF_RAYS, one.text);
    kd_json_end(&json);
    kd_json_end(&json);
    return kd_json_finish_line(&json);
}
