#include "render/emit/describe.h"

#include "render/emit/emitter.h"

#define AT(number, name) [number] = "crossing",
#define NOWHERE(number, name) [number] = "",
#define END(number, name) [number] = "end",
#define ALONG(number, name) [number] = "along",
#define SURFACE(number, name) [number] = "met",
static const char *const places[KD_EMITTER_COUNT] = { KD_EMITTERS(AT, NOWHERE, NOWHERE, END, ALONG, SURFACE) };

static enum kd_status one(const struct kd_scene *scene, int number, bool first, struct kd_buffer *out)
{
    const struct kd_emitter *e = kd_emitters[number];
    char sentence[KD_EMIT_TOLD];
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "%s{\"name\":\"%s\",\"title\":\"%s\",\"at\":\"%s\",\"apart\":%s", first ? "" : ",",
                            e->name, e->title, places[number],
                            e->traits && e->traits(scene) & KD_TRAIT_SEPARATE_PHOTOMETRY ? "true" : "false"));
    if (e->tell) {
        e->tell(scene, sentence);
        KD_TRY(kd_buffer_printf(out, ",\"sentence\":\"%s\"", sentence));
    }
    KD_TRY(kd_buffer_printf(out, "}"));
done:
    return status;
}

enum kd_status kd_emit_to_json(const struct kd_scene *scene, struct kd_buffer *out)
{
    bool first = true;
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "["));
    for (int i = 0; i < KD_EMITTER_COUNT; i++) {
        if (!kd_emit_has(scene, kd_emitters[i]))
            continue;
        KD_TRY(one(scene, i, first, out));
        first = false;
    }
    KD_TRY(kd_buffer_printf(out, "]"));
done:
    return status;
}
