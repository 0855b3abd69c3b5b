/* Rules that concern several fields. Each rule has a sentence for the reference, and a function that checks it. Any
 * thread. */
#ifndef KD_SCENE_RULES_H
#define KD_SCENE_RULES_H

#include "scene/scene.h"

struct kd_rule {
    const char *text;
    enum kd_status (*check)(const struct kd_scene *scene, struct kd_error *error);
    /* For rules that a JSON Schema can express: the integer section.name must be a multiple of `multiple`, or the
     * number must be 0 or at least `above_0`. For all other rules these members are NULL, NULL, 0 and 0. */
    const char *section, *name;
    int32_t multiple;
    double above_0;
};
extern const struct kd_rule kd_rules[];
extern const size_t kd_rule_count;

#endif
