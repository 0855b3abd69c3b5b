/* Writes the proper time of a falling observer, for answers. Any thread. */
#ifndef KD_RENDER_OUTPUT_CLOCK_H
#define KD_RENDER_OUTPUT_CLOCK_H

#include "base/json.h"
#include "scene/scene.h"

/* Writes {"proper_time_to_horizon", "proper_time_to_end", "proper_time_to_horizon_s", "proper_time_to_end_s"}: times
 * in M, and with _s in seconds. Inside the horizon the times to the horizon are null. */
void kd_fall_clock_json(const struct kd_fall_clock *clock, struct kd_json *json, const char *name);

/* One line: "r=6 azimuth_deg=0 proper_time_to_end=... proper_time_to_end_s=... proper_time_to_horizon=...
 * proper_time_to_horizon_s=...". The last two are left out inside the horizon. The line is "" if kd_scene_clock has
 * no clock. */
#define KD_CLOCK_TEXT 240
void kd_fall_clock_text(const struct kd_scene *scene, char out[KD_CLOCK_TEXT]);

#endif
