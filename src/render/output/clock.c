#include "render/output/clock.h"

#include <math.h>
#include <stdio.h>

void kd_fall_clock_json(const struct kd_fall_clock *clock, struct kd_json *json, const char *name)
{
    kd_json_object(json, name);
    kd_json_number(json, "proper_time_to_horizon", clock->to_horizon); /* NAN becomes null */
    kd_json_number(json, "proper_time_to_end", clock->to_end);
    kd_json_number(json, "proper_time_to_horizon_s", clock->second * clock->to_horizon);
    kd_json_number(json, "proper_time_to_end_s", clock->second * clock->to_end);
    kd_json_end(json);
}

void kd_fall_clock_text(const struct kd_scene *scene, char out[KD_CLOCK_TEXT])
{
    struct kd_fall_clock c;
    int n = 0;
    *out = 0;
    if (!kd_scene_clock(scene, &c))
        return;
    n += snprintf(out, KD_CLOCK_TEXT, "r=%.9g azimuth_deg=%.9g proper_time_to_end=%.9g proper_time_to_end_s=%.9g",
                  scene->camera.r, scene->camera.azimuth_deg, c.to_end, c.second * c.to_end);
    if (isfinite(c.to_horizon))
        snprintf(out + n, KD_CLOCK_TEXT - (size_t)n, " proper_time_to_horizon=%.9g proper_time_to_horizon_s=%.9g",
                 c.to_horizon, c.second * c.to_horizon);
}
