/* Fuzz target: the scene arguments of a command line, one a line: PATH=VALUE, WIDTHxHEIGHT, WIDTHxHEIGHT+LEFT+TOP, and
 * after "axis " an axis of a sweep. The command line that describes the resulting scene must give the same scene. */
#include "fuzz.h"

#include "scene/difference.h"
#include "cli/scene_options.h"
#include "scene/sweep.h"
#include "scene/table.h"

enum { AXES = KD_SWEEP_AXES + 1, WORDS = 64 };

struct words {
    struct kd_fuzz_text texts[WORDS];
    size_t n;
    const char *axes[AXES];
    size_t n_axes;
    struct kd_scene_options options;
};

static void add(struct words *words, const char *text)
{
    if (!strncmp(text, "axis ", 5)) {
        if (words->n_axes < AXES)
            words->axes[words->n_axes++] = text + 5;
    } else if (strchr(text, '=') && *text != '=')
        CHECK(kd_scene_options_add_set(&words->options, text), "out of memory");
    else if (!kd_scene_options_add_tile(&words->options, text))
        kd_scene_options_add_size(&words->options, text);
}

static void read_axes(const struct words *words, const struct kd_scene *scene)
{
    struct kd_sweep *sweep = NULL;
    struct kd_scene one;
    struct kd_error error = { 0 };
    char name[KD_SWEEP_NAME];
    if (!words->n_axes || kd_scene_validate(scene, NULL))
        return;
    enum kd_status status = kd_sweep_typed(words->axes, words->n_axes, scene, NULL, &sweep, &error);
    if (status) {
        kd_fuzz_refused(status, &error);
        return;
    }
    CHECK(sweep->scenes >= 1 && sweep->scenes <= KD_SWEEP_MOST, "a sweep has %u scenes", sweep->scenes);
    for (unsigned k = 0; k < 2; k++) {
        const unsigned number = k ? sweep->scenes - 1 : 0;
        kd_sweep_name(sweep, number, name);
        CHECK(*name && !strpbrk(name, "/\n"), "\"%s\" is the name of a file", name);
        if ((status = kd_sweep_scene(sweep, number, &one, &error)))
            kd_fuzz_refused(status, &error);
        else
            kd_fuzz_fields(&one);
    }
    kd_sweep_free(sweep);
}

/* not split: an asset's name may contain blanks */
static bool has_name(const struct kd_scene *scene)
{
    for (size_t k = 0; k < KD_FIELD_COUNT; k++)
        if (kd_fields[k].kind == KD_KIND_ASSET && kd_field_get(scene, &kd_fields[k], 0))
            return true;
    return false;
}

static void tell(const struct kd_scene *scene)
{
    struct kd_buffer line = { 0 };
    struct kd_scene back;
    struct kd_error error = { 0 };
    char *rest;
    kd_scene_defaults(&back);
    if (has_name(scene))
        return;
    CHECK(!kd_scene_line(scene, &line), "a scene has no line");
    char *text = strdup((const char *)line.data);
    CHECK(text, "out of memory");
    /* the style is set first, because it sets other fields; a document does the same */
    for (int style = 1; style >= 0; style--) {
        strcpy(text, (const char *)line.data);
        for (char *word = strcmp(text, "the default scene") ? strtok_r(text, " ", &rest) : NULL; word;
             word = strtok_r(NULL, " ", &rest)) {
            char *value = strchr(word, '=');
            CHECK(value, "\"%s\" of a line has no value: %s", word, (char *)line.data);
            *value++ = 0;
            if ((strcmp(word, "style.name") == 0) == style)
                CHECK(!kd_scene_set(&back, word, value, &error), "%s=%s of a line: %s", word, value, error.message);
        }
    }
    CHECK(!memcmp(scene, &back, sizeof back), "the line \"%s\" makes another scene", (char *)line.data);
    free(text);
    kd_buffer_finish(&line);
}

int kd_fuzz_line(const uint8_t *data, size_t size)
{
    struct words words = { 0 };
    struct kd_scene scene, before;
    struct kd_error error = { 0 };
    while (words.n < WORDS && kd_fuzz_next(&data, &size, &words.texts[words.n]))
        add(&words, words.texts[words.n++].at);
    kd_scene_defaults(&scene);
    before = scene;
    const enum kd_status status = kd_scene_options_set(&words.options, &scene, &error);
    if (status)
        kd_fuzz_refused(status, &error);
    else {
        kd_fuzz_sound(&scene);
        tell(&scene);
        read_axes(&words, &scene);
    }
    CHECK(!kd_scene_options_merge(&(struct kd_scene_options) { 0 }, &before, &error), "no options change a scene: %s",
          error.message);
    for (size_t i = 0; i < words.n; i++)
        free(words.texts[i].at);
    kd_scene_options_finish(&words.options);
    return 0;
}
