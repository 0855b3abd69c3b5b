#include "render/frame/normalise.h"

#include "render/device/device_internal.h"
#include "render/emit/radio.h"
#include "render/frame/job.h"

#include <math.h>
#include <string.h>

/* FIRST, CLOSE: pixels along a side of the first and of the later pictures; MOST: largest number of pictures of one
 * size */
enum { FIRST = 48, CLOSE = 128, MOST = 60 };
/* relative error of the flux at which the search with 48 pixels ends: the flux of a picture of 128 pixels differs from
 * that of 48 by no more */
#define NEAR 1e-3
/* relative error of the flux at which the search with 128 pixels ends; a sum of floats is accurate to 1e-6 */
#define HELD 5e-5
/* First estimate of d ln(flux)/d ln(scale). Light is proportional to density times field. The field grows at least as
 * the square root of the density, so the slope is at least 1.5. */
#define THIN 2.0
#define LONGEST 6.9 /* largest step of ln scale: a factor of a thousand */
/* margin at both ends of a bracket, as a fraction of the bracket; an estimate inside the margin is replaced by the
 * bracket's middle */
#define MARGIN 0.05
#define DENSEST 1e30 /* largest density that a scene can have */

struct search {
    struct kd_renderer *r;
    struct kd_scene scene; /* the scene to be rendered; its density and size are set for each picture */
    double target, most;   /* target: the requested flux, Jy; most: ln of the largest scale */
    double slope;          /* d ln flux / d ln scale, from the last pictures */
    kd_progress_fn progress;
    void *user;
    struct kd_error *error;
};

static double *density_of(struct kd_scene *scene)
{
    struct kd_volume *v = &scene->volume;
    return v->model == KD_VOLUME_GOLD   ? &v->gold_emission
           : v->model == KD_VOLUME_GRID ? &v->grid_scale
                                        : &v->density_cm3;
}

/* Plans the picture that measures the flux. */
static enum kd_status plan_of(const struct search *s, int side, double log_scale, struct kd_scene *scene,
                              struct kd_plan *plan)
{
    const double w = s->scene.image.width, h = s->scene.image.height;
    struct kd_capacity c;
    *scene = s->scene;
    *density_of(scene) *= exp(log_scale);
    scene->image.width = (int32_t)fmax(rint(side * w / fmax(w, h)), 1);
    scene->image.height = (int32_t)fmax(rint(side * h / fmax(w, h)), 1);
    kd_renderer_capacity(s->r, &c);
    return kd_plan_make(scene, &c, plan, s->error);
}

static enum kd_status flux_at(struct search *s, int side, double log_scale, double *jy)
{
    struct kd_scene scene;
    struct kd_plan plan;
    struct kd_frame frame = { 0 };
    enum kd_status status;
    if (s->progress && !s->progress(s->user, 0))
        return kd_error_set(s->error, KD_ECANCELLED, "cancelled");
    KD_TRY(plan_of(s, side, log_scale, &scene, &plan));
    KD_TRY(kd_render(s->r, &scene, &plan, NULL, NULL, &frame, s->error));
    *jy = kd_radio_jansky(&scene, frame.light.all.flux);
done:
    kd_frame_finish(&frame);
    return status;
}

static enum kd_status refuse(const struct search *s, const char *why, double jy)
{
    return kd_error_field(s->error, "/volume/normalise_to_jy",
                          "volume.normalise_to_jy is %.9g Jy, but %s %.4g Jy; it must be 0, or a flux that this "
                          "matter has at some density",
                          s->target, why, jy);
}

/* The next estimate of ln scale, by the secant through the ends of a bracket or by the slope. If that estimate is too
 * near to an end of the bracket, the bracket's middle is used instead. */
static double guess(const struct search *s, double x, double y, const double at[2], const double off[2])
{
    if (!isfinite(at[0]) || !isfinite(at[1]))
        return fmin(x - fmin(fmax(y / s->slope, -LONGEST), LONGEST), s->most);
    const double part = off[0] / (off[0] - off[1]);
    return at[0] + (part > MARGIN && part < 1 - MARGIN ? part : 0.5) * (at[1] - at[0]);
}

/* Finds *x, the ln of the scale, by regula falsi in ln flux over ln scale, starting from the given *x. When an end of
 * the bracket stays the same twice, the function value at that end is halved (Dowell & Jarratt 1971, BIT 11, 168). */
static enum kd_status find(struct search *s, int side, double within, double *x)
{
    double at[2] = { -INFINITY, INFINITY }, off[2] = { 0 }, last = NAN, before = NAN, jy = 0;
    int stays = -1;
    enum kd_status status;
    for (int n = 0; n < MOST; n++) {
        KD_TRY(flux_at(s, side, *x, &jy));
        const double y = jy > 0 ? log(jy / s->target) : -LONGEST * s->slope;
        const int end = y > 0;
        if (jy > 0 && fabs(y) < within)
            return KD_OK;
        if (!isfinite(jy) || (y < 0 && *x >= s->most))
            return refuse(s, "at its largest density this matter has", jy);
        if (isfinite(last) && jy > 0 && *x != before)
            s->slope = fmin(fmax((y - last) / (*x - before), 0.2), 8);
        before = *x;
        last = jy > 0 ? y : NAN;
        at[end] = *x;
        off[end] = y;
        if (stays == end)
            off[!end] *= 0.5;
        stays = end;
        *x = guess(s, *x, y, at, off);
    }
    status = refuse(s, "the nearest flux found with 60 pictures is", jy);
done:
    return status;
}

/* For a device that only compiles and gives no light: renders one picture of each size, to compile its kernels. */
static enum kd_status rehearse(struct search *s, double *scale)
{
    double none;
    enum kd_status status;
    KD_TRY(flux_at(s, FIRST, 0, &none));
    KD_TRY(flux_at(s, CLOSE, 0, &none));
    *scale = 1;
done:
    return status;
}

static enum kd_status search(struct search *s, double *scale)
{
    double x = 0;
    enum kd_status status;
    if (s->r->opening.compiles_only)
        return rehearse(s, scale);
    KD_TRY(find(s, FIRST, NEAR, &x));
    KD_TRY(find(s, CLOSE, HELD, &x));
    *scale = exp(x);
done:
    return status;
}

/* Reduces the scene to the parts that determine the flux. For a series of grids, the time is set to the middle of the
 * series, so that one density serves all times. For other matter seen from infinity, the time is 0. */
static struct kd_scene bare(const struct kd_scene *scene, const struct kd_plan_light *light)
{
    struct kd_scene bare = kd_scene_whole(scene), plain;
    kd_scene_defaults(&plain);
    bare.image = plain.image;
    bare.image.width = light->shape.width ? (int32_t)light->shape.width : scene->image.width;
    bare.image.height = light->shape.height ? (int32_t)light->shape.height : scene->image.height;
    bare.image.samples = bare.image.critical_factor = 1;
    bare.style = plain.style;
    bare.style.bloom = bare.style.beam_uas = 0;
    bare.motion = plain.motion;
    bare.camera.stereo = KD_STEREO_NONE;
    bare.volume.normalise_to_jy = 0;
    bare.volume.normalise_ghz = INFINITY;
    bare.volume.frequency_ghz =
        isfinite(scene->volume.normalise_ghz) ? scene->volume.normalise_ghz : scene->volume.frequency_ghz;
    bare.top.time = scene->matter.frames > 1    ? 0.5 * (scene->matter.first + scene->matter.last)
                    : isfinite(scene->camera.r) ? scene->top.time
                                                : 0;
    return bare;
}

/* Computes both keys. Each is a hash of the reduced scene and the flux. The first key includes the camera and the
 * picture's shape, the second does not. */
static enum kd_status keys_of(const struct search *s, struct kd_normal *out)
{
    struct kd_scene key = s->scene, plain;
    const double w = key.image.width, h = key.image.height;
    enum kd_status status;
    kd_scene_defaults(&plain);
    key.image.width = (int32_t)fmax(rint(4096 * w / fmax(w, h)), 1);
    key.image.height = (int32_t)fmax(rint(4096 * h / fmax(w, h)), 1);
    key.volume.normalise_to_jy = s->target;
    KD_TRY(kd_scene_hash(&key, out->hash));
    key.image = plain.image;
    key.camera = plain.camera;
    key.top.time = 0;
    KD_TRY(kd_scene_hash(&key, out->matter));
done:
    return status ? kd_error_set(s->error, status, "out of memory while hashing the scene") : KD_OK;
}

/* The latest scale that was found for this scene, or for this matter if `held` is true; 0 if there is none. */
static double known(const struct kd_normalised *cache, const struct kd_normal *wanted, bool held)
{
    const uint32_t n = cache->n < KD_NORMALISED ? cache->n : KD_NORMALISED;
    double of_matter = 0;
    for (uint32_t i = 1; i <= n; i++) {
        const struct kd_normal *at = &cache->entries[(cache->n - i) % KD_NORMALISED];
        if (!strcmp(at->hash, wanted->hash))
            return at->scale;
        if (held && !(of_matter > 0) && !strcmp(at->matter, wanted->matter))
            of_matter = at->scale;
    }
    return of_matter;
}

static struct search search_of(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                               struct kd_error *error)
{
    return (struct search) { .r = renderer,
                             .scene = bare(scene, &plan->light),
                             .target = scene->volume.normalise_to_jy,
                             .slope = THIN,
                             .error = error };
}

enum kd_status kd_frame_normalise_ask(struct kd_renderer *renderer, const struct kd_scene *scene,
                                      const struct kd_plan *plan, struct kd_error *error)
{
    static const int sides[] = { FIRST, CLOSE };
    if (!(scene->volume.normalise_to_jy > 0))
        return KD_OK;
    const struct search s = search_of(renderer, scene, plan, error);
    struct kd_normal wanted;
    enum kd_status status;
    KD_TRY(keys_of(&s, &wanted));
    for (size_t i = 0; i < 2 && !(known(&renderer->normalised, &wanted, plan->light.reuse_normalisation) > 0); i++) {
        struct kd_scene own;
        struct kd_plan by;
        KD_TRY(plan_of(&s, sides[i], 0, &own, &by));
        KD_TRY(kd_frame_ask_kernels(&(struct kd_frame_job) {
            .r = renderer, .store = &renderer->store, .scene = &own, .plan = &by, .error = error }));
    }
done:
    return status;
}

enum kd_status kd_frame_normalise(struct kd_renderer *renderer, struct kd_scene *scene, const struct kd_plan *plan,
                                  kd_progress_fn progress, void *user, double *scale, struct kd_error *error)
{
    struct kd_normalised *cache = &renderer->normalised;
    struct kd_normal found;
    *scale = 1;
    if (!(scene->volume.normalise_to_jy > 0))
        return KD_OK;
    struct search s = search_of(renderer, scene, plan, error);
    enum kd_status status;
    s.progress = progress;
    s.user = user;
    if (!(*density_of(scene) > 0))
        return refuse(&s, "there is no matter, and the flux is", 0);
    KD_TRY(keys_of(&s, &found));
    found.scale = known(cache, &found, plan->light.reuse_normalisation);
    if (!(found.scale > 0)) {
        s.most = log(DENSEST / *density_of(scene));
        KD_TRY(search(&s, &found.scale));
        cache->entries[cache->n++ % KD_NORMALISED] = found;
    }
    *scale = found.scale;
    *density_of(scene) *= found.scale;
done:
    return status;
}
