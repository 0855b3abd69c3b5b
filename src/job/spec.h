/* Job request: what to render. Pure; any thread.
 *
 *     {"scene": {...}}                                                one picture
 *     {"scenes": [{...}, ...]}                                        several pictures
 *     {"scene": {...}, "keyframes": [{"frame": 0, "scene": {patch}}, ...], "frames": 240, "interpolation":
 *     "smooth"}
 *     {"scene": {...}, "axes": {"spacetime.spin": [0, 0.5, 0.9], "camera.inclination_deg": "10:80:15"}}
 *     {"playground": {...}, "every": 20, "frames": 150, "scene": {...}, "keyframes": [...]}
 *
 * The last form is a film. Its frame k shows a playground (in the format of kerrd playground) at the time k times
 * `every`, or at an earlier time if the playground's budget of sub-steps ends before. "scene" is merged over the
 * default view of the playground, and keyframes move the camera. Keyframes are described in scene/timeline.h;
 * without a keyframe at frame 0, "scene" is the scene at frame 0. Axes are described in scene/sweep.h. With
 * "output": "light-curve" each frame is measured instead of drawn (render/output/series.h).
 *
 * "motion_blur": {"samples": N, "shutter": S}: the light of frame k is the mean of the light of N pictures, at k, k
 * + S/N, ..., k + S (N - 1)/N. The default of S is 0.5. It is permitted only for pictures between keyframes.
 *
 * "exposure" concerns pictures whose style.exposure is "auto". "one": they share one exposure, which is measured
 * before the first frame is rendered (job/exposure.h). "each": each picture has its own. The default is "one" for
 * frames of keyframes, and "each" for lists, axes and playgrounds. */
#ifndef KD_JOB_SPEC_H
#define KD_JOB_SPEC_H

#include "playground/playground.h"
#include "render/output/series.h"
#include "scene/asset.h"
#include "scene/dynamic_bodies.h"
#include "scene/sweep.h"
#include "scene/timeline.h"

#define KD_JOB_BODY_MAX (4u << 20)
#define KD_JOB_FILM_MAX (16u << 20) /* limit of a request with a playground: enough for 200 000 pieces of debris */
/* limit of the number of frames of all jobs except sweeps, whose limit is KD_SWEEP_MOST */
#define KD_JOB_FRAMES_MAX 10000

struct kd_job_spec {
    unsigned frames;
    struct kd_timeline timeline; /* if `listed` is true, a key for each frame; otherwise the keyframes of the request */
    bool listed;
    struct kd_sweep *sweep; /* NULL if the request has no axes */
    double every;           /* time between two frames of a film, in M; 0 if the request is not for a film */
    /* the bodies at the start of a film, which are used for planning; NULL afterwards */
    struct kd_dynamic_bodies *first;
    const struct kd_series *series; /* what the job makes of its frames: the member "output" of the request */
    bool one_exposure;              /* true if all frames whose exposure is "auto" share one exposure */
    struct {
        unsigned samples;
        double shutter;
    } blur; /* samples is 0 if there is no blur */
    /* The common exposure in stops. NAN if each frame has its own exposure, or if the common exposure is not
     * measured yet (job/exposure.h). */
    double exposure;
};

/* The base scene, onto which the request's scenes are merged, and values that replace parts of the request. */
struct kd_job_base {
    const char *preset; /* name of a preset that is the base scene; NULL or "": none */
    /* the base scene, if `preset` is not given; NULL: the defaults, or the default view of the playground */
    const struct kd_scene *scene;
    unsigned samples; /* number of samples of motion blur, which replaces that of the request; 0: that of the request */
    /* shutter as a fraction of a frame's time, which replaces that of the request; 0: that of the request */
    double shutter;
    /* Callback that changes the scene of a sequence, or each scene of a list, before keyframes are merged onto it.
     * NULL: no change. */
    enum kd_status (*change)(void *user, struct kd_scene *scene, struct kd_error *error);
    void *user;
};

/* Parses and validates a request. assets: the assets that scenes may use; NULL: hashes are not looked up. On
 * success, every scene of a list and every keyframe is valid. KD_EINVAL with a pointer into the request, or to
 * /preset. */
enum kd_status kd_job_spec_parse(const char *text, size_t length, const struct kd_job_base *base,
                                 const struct kd_assets *assets, struct kd_job_spec *out, struct kd_error *error);
void kd_job_spec_finish(struct kd_job_spec *spec);

/* Makes the playground of a film in its initial state. The request must be valid (kd_job_spec_parse). KD_EINVAL,
 * KD_ENOMEM. */
enum kd_status kd_job_spec_playground(const char *text, size_t length, struct kd_playground **out,
                                      struct kd_error *error);

/* Makes the scene of a frame, and validates it. For a film, the scene lacks the bodies. KD_EINVAL if the scene
 * between two keyframes is not valid. */
enum kd_status kd_job_spec_scene(const struct kd_job_spec *spec, unsigned frame, struct kd_scene *out,
                                 struct kd_error *error);
/* Like kd_job_spec_scene, for one sample of a frame with motion blur. Sample 0 has the frame's own scene. */
enum kd_status kd_job_spec_sample(const struct kd_job_spec *spec, unsigned frame, unsigned sample, struct kd_scene *out,
                                  struct kd_error *error);

#endif
