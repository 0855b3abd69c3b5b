/* Helpers shared by the tests of the scene document. */
#ifndef KD_TESTS_SCENE_SUPPORT_H
#define KD_TESTS_SCENE_SUPPORT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "scene/table.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* xorshift64*: the same numbers on every machine. */
static inline uint64_t support_random(uint64_t *state)
{
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return *state * 0x2545f4914f6cdd1dull;
}

static inline double support_uniform(uint64_t *state) { return (double)(support_random(state) >> 11) * 0x1p-53; }

/* {"section":{"name":value}}, {"list":[{"name":value}]} or {"name":value} */
static inline void support_document(char out[256], const struct kd_row *field, const char *value)
{
    bool list = kd_section_find(field->object)->most;
    const char *dot = strchr(field->object, '.'); /* a section nested in another */
    if (dot)
        snprintf(out, 256, "{\"%.*s\":{\"%s\":{\"%s\":%s}}}", (int)(dot - field->object), field->object, dot + 1,
                 field->name, value);
    else if (*field->object)
        snprintf(out, 256, "{\"%s\":%s{\"%s\":%s}%s}", field->object, list ? "[" : "", field->name, value,
                 list ? "]" : "");
    else
        snprintf(out, 256, "{\"%s\":%s}", field->name, value);
}

static inline enum kd_status support_parse(struct kd_scene *scene, const char *text, struct kd_error *error)
{
    return kd_scene_from_json(scene, text, strlen(text), error);
}

/* The canonical text, malloc'd. */
static inline char *support_canonical(const struct kd_scene *scene)
{
    struct kd_buffer text = { 0 };
    assert_int_equal(kd_scene_to_json(scene, &text), KD_OK);
    return (char *)text.data;
}

static inline double support_value(const struct kd_row *field, uint64_t *state)
{
    bool words = field->kind == KD_KIND_WORD;
    double low = field->least, high = words ? kd_word_count(field->words) - 1 : field->most;
    double value = low + (high - low) * support_uniform(state);
    uint64_t pick = support_random(state) % 8;
    if (pick == 0)
        value = support_random(state) % 2 ? low : high;
    else if (pick == 1 && low < 0)
        value = 1e-300 * (support_uniform(state) - 0.5);
    else if (pick == 2 && field->kind != KD_KIND_WORD && field->words)
        value = INFINITY;
    if (field->kind >= KD_KIND_INT && isfinite(value))
        value = floor(value + 0.5);
    return value < low ? low : value > high && isfinite(value) ? high : value;
}

/* Sets every field to a random value: often an end of its range, sometimes tiny, sometimes its word. Lists get any
 * length. */
static inline void support_scene(struct kd_scene *scene, uint64_t *state)
{
    kd_scene_defaults(scene);
    for (size_t s = 0; s < KD_SECTION_COUNT; s++) {
        const struct kd_section *section = &kd_sections[s];
        if (section->most)
            kd_section_resize(scene, section, support_random(state) % (section->most + 1));
        for (size_t index = 0; index < kd_section_size(scene, section); index++)
            for (size_t i = section->first; i < section->first + section->count; i++)
                kd_field_put(scene, &kd_fields[i], index, support_value(&kd_fields[i], state));
    }
}

#endif
