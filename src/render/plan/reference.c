/* This writes docs/approximations.md, from the sentences of emitters and plans. */
#include "render/emit/emitter.h"
#include "render/plan/plan.h"
#include "render/plan/reference.h"

#include <string.h>

static const char introduction[] =
    "# What is approximated\n"
    "\n"
    "A plan lists the sentences that are in force in its scene, and every picture carries them (`kerrd plan`, "
    "`Kerrd-Approximations`). These are\n"
    "all of them. This page is generated from the emitters (`src/render/emit/emitter.h`) and `src/render/plan/plan.c`; "
    "do not edit it.\n"
    "The chapters on the [physics](physics/README.md) say what stands behind them.\n"
    "\n"
    "Not modelled, and so not in the list of any picture: the motion of gas by its own forces, magnetic fields that "
    "are carried along by gas, light that is scattered on its way.\n";

static const char present[] = "in each scene that has it", sometimes[] = "in some scenes";

static enum kd_status add_table(struct kd_buffer *page, const char *of)
{
    return kd_buffer_printf(page, "\n## %s\n\n| sentence | in force |\n|---|---|\n", of);
}

static enum kd_status add_emitter(struct kd_buffer *page, const struct kd_emitter *emitter)
{
    enum kd_status status;
    KD_TRY(add_table(page, emitter->name));
    for (size_t i = 0; i < emitter->n_sentences; i++)
        KD_TRY(kd_buffer_printf(page, "| %s | %s |\n", emitter->sentences[i].text,
                                emitter->sentences[i].in_force ? sometimes : present));
    if (emitter->kind)
        KD_TRY(kd_buffer_printf(page, "\nThe sentences of the %s hold as well.\n", emitter->kind->name));
done:
    return status;
}

enum kd_status kd_plan_reference(struct kd_buffer *page)
{
    enum kd_status status;
    KD_TRY(kd_buffer_append(page, introduction, strlen(introduction)));
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        KD_TRY(add_emitter(page, kd_emitters[i]));
    KD_TRY(add_table(page, "any picture"));
    for (size_t i = 0; i < kd_plan_sentence_count(); i++)
        KD_TRY(kd_buffer_printf(page, "| %s | %s |\n", kd_plan_sentence(i), sometimes));
done:
    return status;
}
