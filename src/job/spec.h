/* Job request: what to render. Pure; any thread.
 *
 *     {"scene": {...}}                                                one picture
 *     {"scenes": [{...}, ...]}                                        several pictures
 *     {"scene": {...}, "keyframes": [{"frame": 0, "scene": {patch}}, ...], "frames": 240, "interpolation":
 *     "smooth"}
 *     {"scene": {...}, "axes": {"spacetime.spin": [0, 0.5, 0.9], "camera.inclination_deg": "10:80:15"}}
 *     {"playground": {...}, "every": 20, "frames": 150, "scene": {...}, "keyframes": [...]}
 *
 * The last one is a film. Its frame k shows a playground, in the format of kerrd playground, at the time k times
 * `every`, or earlier if the playground's budget of sub-steps does not reach that time. "scene" is merged over the
 * default view of the playground, and keyframes move the camera. Keyframes are described in scene/timeline.h; without a
 * keyframe at frame 0, "scene" is the scene at frame 0. Axes are described in scene/sweep.h. With "output":
 * "light-curve" each frame is measured instead of drawn (render/output/series.h).
 *
 * "motion_blur": {"samples": N, "shutter": S}: the light of frame k is the mean of the light of N pictures, at k, k +
 * S/N, ..., k + S (N - 1)/N. The default of S is 0.5. Only for pictures between keyframes.
 *
 * "exposure": "one" or "each": whether pictures whose style.exposure is "auto" share one exposure, measured before the
 * first frame is rendered (job/exposure.h), or each has its own. The default is "one" for frames of keyframes, and
 * "each" for lists, axes and playgrounds. */
#ifndef KD_JOB_SPEC_H
#define KD_JOB_SPEC_H

#include "playground/playground.h"
#include "render/output/series.h"
#include "scene/asset.h"
#include "scene/dynamic_bodies.h"
#include "scene/sweep.h"
#include "scene/timeline.h"

#define KD_JOB_BODY_MAX (4u << 20)
#define KD_JOB_FILM_MAX (16u << 20) /* for a request with a playground: enough for 200 000 pieces of debris */
#define KD_JOB_FRAMES_MAX 10000     /* limit for all jobs but sweeps, whose limit is KD_SWEEP_MOST */

struct kd_job_spec {
    unsigned frames;
    struct kd_timeline timeline; /* listed: a key for each frame; otherwise the keyframes of the request */
    bool listed;
    struct kd_sweep *sweep;          /* NULL: the request has no axes */
    double every;                    /* time between two frames of a film, in M; 0: not a film */
    struct kd_dynamic_bodies *first; /* the bodies at the beginning of a film, for planning; NULL afterwards */
    const struct kd_series *series;  /* the request's "output": the product that the job makes of its frames */
    bool one_exposure;               /* frames whose exposure is "auto" share one exposure */
    struct {
        unsigned samples;
        double shutter;
    } blur; /* samples 0: no blur */
    /* The common exposure in stops. NAN: each frame has its own exposure, or the common exposure is not measured yet
     * (job/exposure.h). */
    double exposure;
};

/* The scene over which a request's scenes are merged, and values that replace parts of the request. */
struct kd_job_base {
    const char *preset; /* name of a preset of scenes; NULL or "": none */
    /* a scene in place of a preset; NULL: the defaults, or the default view of the playground */
    const struct kd_scene *scene;
    unsigned samples; /* samples of motion blur, in place of the request's; 0: the request's */
    double shutter;   /* shutter as a fraction of a frame's time; 0: the request's */
    /* Callback that changes the scene of a sequence, or each scene of a list, before keyframes are merged over it.
     * NULL: no change. */
    enum kd_status (*change)(void *user, struct kd_scene *scene, struct kd_error *error);
    void *user;
};

/* Parses and validates a request. assets: the assets that scenes may use; NULL: hashes are not checked. After
 * success every scene of a list and every keyframe is valid. KD_EINVAL with a pointer into the request, or to
 * /preset. */
enum kd_status kd_job_spec_parse(const char *text, size_t length, const struct kd_job_base *base,
                                 const struct kd_assets *assets, struct kd_job_spec *out, struct kd_error *error);
void kd_job_spec_finish(struct kd_job_spec *spec);

/* Makes a film's playground in its initial state. The request must have been validated. KD_EINVAL, KD_ENOMEM. */
enum kd_status kd_job_spec_playground(const char *text, size_t length, struct kd_playground **out,
                                      struct kd_error *error);

/* Makes the valid scene of a frame. For a film the scene does not have the bodies. KD_EINVAL if the scene between two
 * keyframes is not valid. */
enum kd_status kd_job_spec_scene(const struct kd_job_spec *spec, unsigned frame, struct kd_scene *out,
                                 struct kd_error *error);
/* Like kd_job_spec_scene, for one sample of a frame with motion blur; sample 0 is the frame's own scene. */
enum kd_status kd_job_spec_sample(const struct kd_job_spec *spec, unsigned frame, unsigned sample, struct kd_scene *out,
                                  struct kd_error *error);

#endif
