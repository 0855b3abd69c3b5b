#include "render/plan/cost_class.h"

#include "base/hash.h"
#include "scene/table.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Fields, and whole sections, that do not count, and those of which only the power of two does. ".time" is a member of
 * the document itself. */
static const char *const left_out[] = { "image.",
                                        "tile.",
                                        "motion.",
                                        "bodies.",
                                        ".time",
                                        "camera.azimuth_deg",
                                        "camera.inclination_deg",
                                        "camera.yaw_deg",
                                        "camera.pitch_deg",
                                        "camera.roll_deg",
                                        "style.exposure" };
static const char *const roughly[] = { "camera.r", "camera.fov_deg", "camera.field_m" };

static bool is_among(const char *const *names, size_t n, const char *path, size_t section)
{
    for (size_t i = 0; i < n; i++)
        if (!strcmp(names[i], path) || (strlen(names[i]) == section && !strncmp(names[i], path, section)))
            return true;
    return false;
}
#define AMONG(names, path, section) is_among(names, sizeof(names) / sizeof *(names), path, section)

static uint64_t add_field(uint64_t hash, const struct kd_scene *scene, const struct kd_field *field, size_t index)
{
    char path[2 * KD_PATH_SIZE];
    const size_t section = strlen(field->section) + 1;
    snprintf(path, sizeof path, "%s.%s", field->section, field->name);
    if (AMONG(left_out, path, section))
        return hash;
    double value = kd_field_get(scene, field, index);
    if (AMONG(roughly, path, section))
        value = round(log2(value));
    if (field->kind == KD_FIELD_ASSET)
        return kd_hash(hash, kd_field_asset(scene, field, index), strlen(kd_field_asset(scene, field, index)));
    return kd_hash(hash, &value, sizeof value);
}

uint64_t kd_cost_class(const struct kd_plan *plan, const struct kd_scene *scene)
{
    const uint32_t way[] = { plan->quantities,       plan->orders,      plan->bright,        plan->light,
                             plan->interpolates > 0, plan->march.steps, (uint32_t)plan->path };
    uint64_t hash = kd_hash(KD_HASH_BEGIN, way, sizeof way);
    for (size_t s = 0; s < KD_SECTION_COUNT; s++) {
        const size_t elements = kd_section_size(scene, &kd_sections[s]);
        hash = kd_hash(hash, &elements, sizeof elements);
        for (size_t k = 0; k < elements; k++)
            for (size_t i = 0; i < kd_sections[s].count; i++)
                hash = add_field(hash, scene, &kd_fields[kd_sections[s].first + i], k);
    }
    return hash ? hash : 1; /* 0 is a class that is not there */
}

double kd_cost_known(const struct kd_capacity *capacity, uint64_t class, enum kd_pass_id pass)
{
    for (int i = 0; i < KD_COST_CLASSES; i++)
        if (capacity->classes[i].class == class)
            return capacity->classes[i].ns[pass];
    return 0;
}

/* Finds the place of a class, which is that of the class learned from longest ago where it has none yet. */
static struct kd_class_cost *place_of(struct kd_capacity *capacity, uint64_t class)
{
    struct kd_class_cost *oldest = capacity->classes;
    for (int i = 0; i < KD_COST_CLASSES; i++) {
        if (capacity->classes[i].class == class)
            return &capacity->classes[i];
        if (capacity->classes[i].learned < oldest->learned)
            oldest = &capacity->classes[i];
    }
    *oldest = (struct kd_class_cost) { .class = class };
    return oldest;
}

void kd_cost_learn(struct kd_capacity *capacity, uint64_t class, enum kd_pass_id pass, double ns)
{
    struct kd_class_cost *cost = place_of(capacity, class);
    cost->learned = ++capacity->learned;
    cost->ns[pass] = kd_cost_mean(cost->ns[pass], ns);
}
