#include "render/plan/cost_class.h"

#include "base/hash.h"
#include "scene/table.h"

#include <math.h>
#include <string.h>

/* Names of fields, for two lists. One has the fields that the class ignores. The other has the fields that are
 * rounded to a power of two before they enter the class. name NULL: all fields of the section. section "": the
 * document itself. */
struct named { const char *section, *name; };
static const struct named left_out[] = {
    { "image", NULL },           { "image.tile", NULL },
    { "motion", NULL },          { "source", NULL },
    { "bodies", NULL },          { "", "time" },
    { "camera", "azimuth_deg" }, { "camera", "inclination_deg" },
    { "camera", "yaw_deg" },     { "camera", "pitch_deg" },
    { "camera", "roll_deg" },    { "style", "exposure" },
};
static const struct named roughly[] = {
    { "camera", "r" }, { "camera", "fov_deg" }, { "camera", "field_m" }, { "camera", "field_uas" }
};

static bool is_among(const struct named *names, size_t n, const char *section, const char *name)
{
    for (size_t i = 0; i < n; i++)
        if (!strcmp(names[i].section, section) && (!names[i].name || (name && !strcmp(names[i].name, name))))
            return true;
    return false;
}
#define AMONG(names, section, name) is_among(names, sizeof(names) / sizeof *(names), section, name)

static uint64_t add_field(uint64_t hash, const struct kd_scene *scene, const struct kd_row *field, size_t index)
{
    if (AMONG(left_out, field->object, field->name))
        return hash;
    if (field->kind == KD_KIND_ASSET) {
        const char *asset = kd_field_asset(scene, field, index);
        return kd_hash(hash, asset, strlen(asset));
    }
    double value = kd_field_get(scene, field, index);
    if (AMONG(roughly, field->object, field->name))
        value = round(log2(value));
    return kd_hash(hash, &value, sizeof value);
}

uint64_t kd_cost_class(const struct kd_plan *plan, const struct kd_scene *scene)
{
    const uint32_t way[] = { plan->lens.quantities,    plan->lens.orders,           plan->light.bright,
                             plan->light.photometry,   plan->lens.interpolates > 0, plan->light.march.steps,
                             (uint32_t)plan->lens.path };
    uint64_t hash = kd_hash(KD_HASH_BEGIN, way, sizeof way);
    for (size_t s = 0; s < KD_SECTION_COUNT; s++) {
        const size_t elements = kd_section_size(scene, &kd_sections[s]);
        hash = kd_hash(hash, &elements, sizeof elements);
        for (size_t k = 0; k < elements && !AMONG(left_out, kd_sections[s].name, NULL); k++)
            for (size_t i = 0; i < kd_sections[s].count; i++)
                hash = add_field(hash, scene, &kd_fields[kd_sections[s].first + i], k);
    }
    return hash ? hash : 1; /* 0 means no class */
}

double kd_cost_known(const struct kd_capacity *capacity, uint64_t class, enum kd_pass_id pass)
{
    for (int i = 0; i < KD_COST_CLASSES; i++)
        if (capacity->classes[i].class == class)
            return capacity->classes[i].ns[pass];
    return 0;
}

/* Returns the entry of a class. If the class has none, returns the entry of the class that was updated longest ago. */
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
