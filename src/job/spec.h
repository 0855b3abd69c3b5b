/* A job renders one of these: listed scenes, one scene that keyframes change, or a scene with axes. Pure; any
 * thread.
 *
 * {"scene": {...}}                one picture
 * {"scenes": [{...}, ...]}        a picture each
 * {"scene": {...}, "keyframes": [{"frame": 0, "scene": {patch}}, ...], "frames": 240, "interpolation": "smooth"}
 * {"scene": {...}, "axes": {"spacetime.spin": [0, 0.5, 0.9], "camera.inclination_deg": "10:80:15"}}
 * {"playground": {...}, "every": 20, "frames": 150, "scene": {...}, "keyframes": [...]}
 *
 * The last one is a film: frame k shows a playground, given as kerrd playground reads it, after k times `every`, as
 * far as its budget of sub-steps leads from the frame before. "scene" is merged over the one that shows it well, and
 * keyframes move the camera. Keyframes are those of scene/timeline.h; what holds at frame 0 without a keyframe there
 * is "scene". Axes are those of scene/sweep.h. With "output": "light-curve" each frame is measured instead of drawn
 * (render/output/series.h).
 *
 * "motion_blur": {"samples": N, "shutter": S}: the light of frame k is the mean of that of N pictures, at k, k +
 * S/N, ..., k + S (N - 1)/N. S: 0.5 where it is not given. Of frames of keyframes alone, as pictures.
 *
 * "exposure": "one" or "each" says of pictures whose style.exposure is "auto" whether all have the same, which is
 * measured before the first of them is drawn (job/exposure.h), or each has its own. Frames of keyframes have one
 * unless it says otherwise; those of a list, of axes and of a playground have each their own. */
#ifndef KD_JOB_SPEC_H
#define KD_JOB_SPEC_H

#include "playground/playground.h"
#include "render/output/series.h"
#include "scene/asset.h"
#include "scene/crowd.h"
#include "scene/sweep.h"
#include "scene/timeline.h"

#define KD_JOB_BODY_MAX (4u << 20)
#define KD_JOB_FILM_MAX (16u << 20) /* of one with a playground: 200 000 pieces of debris */
#define KD_JOB_FRAMES_MAX 10000     /* but for a sweep: KD_SWEEP_MOST */

struct kd_job_spec {
    unsigned frames;
    struct kd_timeline timeline; /* listed: a key a frame; else the keyframes */
    bool listed;
    struct kd_sweep *sweep;         /* NULL: it has no axes */
    double every;                   /* of a film, from a frame's time to the next; 0: it is none */
    struct kd_crowd *first;         /* of a film: what it begins with, to be planned by; NULL where that is over */
    const struct kd_series *series; /* "output": what it makes of its frames */
    bool one_exposure;              /* frames whose exposure is "auto" have the same one, */
    struct {
        unsigned samples;
        double shutter;
    } blur;          /* samples 0: none */
    double exposure; /* this; NAN: each has its own, or it has still to be measured (job/exposure.h) */
};

/* What scenes of a request are merged over, and what is changed in them afterwards. */
struct kd_job_base {
    const char *preset;           /* a preset of scenes; NULL or "": none */
    const struct kd_scene *scene; /* or this one; NULL: the defaults, or what shows the playground well */
    unsigned samples;             /* of motion blur, and */
    double shutter;               /* its part of a frame's time; 0: as the request says */
    /* Changes the scene of a sequence, and each of a list, before keyframes are merged over it; NULL: nothing is
     * changed. */
    enum kd_status (*change)(void *user, struct kd_scene *scene, struct kd_error *error);
    void *user;
};

/* assets: those that scenes may name; NULL: hashes are taken as they are. Every scene of a list and every keyframe
 * is valid afterwards. KD_EINVAL with the pointer into the request, or to /preset. */
enum kd_status kd_job_spec_parse(const char *text, size_t length, const struct kd_job_base *base,
                                 const struct kd_assets *assets, struct kd_job_spec *out, struct kd_error *error);
void kd_job_spec_finish(struct kd_job_spec *spec);

/* The playground of a film, as it begins, from the request that is known to be good. KD_EINVAL, KD_ENOMEM. */
enum kd_status kd_job_spec_playground(const char *text, size_t length, struct kd_playground **out,
                                      struct kd_error *error);

/* The scene of a frame, valid, of a film without its crowd; KD_EINVAL where what lies between two keyframes is not. */
enum kd_status kd_job_spec_scene(const struct kd_job_spec *spec, unsigned frame, struct kd_scene *out,
                                 struct kd_error *error);
/* The same of a sample of a frame with motion blur, from 0 on, which is the frame's own scene. */
enum kd_status kd_job_spec_sample(const struct kd_job_spec *spec, unsigned frame, unsigned sample, struct kd_scene *out,
                                  struct kd_error *error);

#endif
