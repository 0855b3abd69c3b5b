/* A job renders one of these: listed scenes, one scene that keyframes change, or a scene with axes. Pure; any thread.
 *
 * {"scene": {...}}                one picture
 * {"scenes": [{...}, ...]}        a picture each
 * {"scene": {...}, "keyframes": [{"frame": 0, "scene": {patch}}, ...], "frames": 240, "interpolation": "smooth"}
 * {"scene": {...}, "axes": {"spacetime.spin": [0, 0.5, 0.9], "camera.inclination_deg": "10:80:15"}}
 *
 * Keyframes are those of scene/timeline.h; what holds at frame 0 without a keyframe there is "scene". Axes are those of scene/sweep.h.
 * With "output": "light-curve" each frame is measured instead of drawn (render/output/series.h). */
#ifndef KD_SERVER_JOB_SPEC_H
#define KD_SERVER_JOB_SPEC_H

#include "render/output/series.h"
#include "scene/asset.h"
#include "scene/sweep.h"
#include "scene/timeline.h"

#define KD_JOB_BODY_MAX (4u << 20)
#define KD_JOB_FRAMES_MAX 10000 /* but for a sweep: KD_SWEEP_MOST */

struct kd_job_spec {
    unsigned frames;
    struct kd_timeline timeline; /* listed: a key a frame; else the keyframes */
    bool listed;
    struct kd_sweep *sweep; /* NULL: it has no axes */
    const struct kd_series *series; /* "output": what it makes of its frames */
};

/* preset: what scenes are merged over instead of the defaults; "": those. assets: those that scenes may name; NULL: hashes are taken as they
 * are. Every scene of a list and every keyframe is valid afterwards. KD_EINVAL with the pointer into the request, or to /preset. */
enum kd_status kd_job_spec_parse(const char *text, size_t length, const char *preset, const struct kd_assets *assets, struct kd_job_spec *out,
                                 struct kd_error *error);
void kd_job_spec_finish(struct kd_job_spec *spec);

/* The scene of a frame, valid; KD_EINVAL where what lies between two keyframes is not. */
enum kd_status kd_job_spec_scene(const struct kd_job_spec *spec, unsigned frame, struct kd_scene *out, struct kd_error *error);

#endif
