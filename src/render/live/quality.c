#include "render/live/quality.h"

#include "render/emit/emitter.h"

#include <math.h>

void kd_quality_apply(const struct kd_quality *quality, const struct kd_scene *asked, struct kd_scene *out)
{
    *out = *asked;
    out->image.width = (int32_t)quality->width;
    out->image.height = (int32_t)quality->height;
    out->image.samples = quality->samples; /* 0 means as many rays as each pixel needs */
    if (quality->critical && out->image.critical_factor > quality->critical)
        out->image.critical_factor = quality->critical;
    out->accuracy.orders = quality->orders;
    if (quality->profile < 0)
        return;
    out->accuracy.profile = quality->profile;
    out->accuracy.tolerance = INFINITY;
    out->accuracy.precision = KD_PRECISION_WORD_AUTO;
    out->accuracy.steps = 0;
}

/* True if the profile alone determines how rays are traced. */
static bool by_profile(const struct kd_accuracy *a)
{
    return !isfinite(a->tolerance) && !a->steps && a->precision == KD_PRECISION_WORD_AUTO;
}

/* Estimated cost of a ray: the profile's steps, plus the transfer pass for each order. Only ratios matter, and the
 * governor corrects wrong ratios by measuring. The profile reference uses double precision. */
static double ray_cost(const struct kd_quality *quality, const struct kd_scene *asked)
{
    static const double profile[] = { 0.6, 0.7, 1, 1.6, 12 };
    bool named = quality->profile >= 0 || by_profile(&asked->accuracy);
    int32_t p = quality->profile >= 0 ? quality->profile : asked->accuracy.profile;
    return (named ? profile[p] : 2) * (2 + quality->orders);
}

#define ADAPTIVE_RAYS 2.5 /* approximate mean number of rays a pixel, if each pixel has the number that it needs */

static struct kd_rung make_rung(const struct kd_scene *asked, double scale, int32_t samples, int32_t orders,
                                int32_t profile)
{
    struct kd_rung r = { .quality = { .scale = scale, .samples = samples, .orders = orders, .profile = profile } };
    r.quality.width = (uint32_t)fmax(1, round(asked->image.width * scale));
    r.quality.height = (uint32_t)fmax(1, round(asked->image.height * scale));
    r.quality.final = scale == 1 && samples == asked->image.samples && orders == asked->accuracy.orders && profile < 0;
    r.pixels = (double)r.quality.width * r.quality.height;
    r.rays = r.pixels * (samples ? samples * samples : ADAPTIVE_RAYS) * ray_cost(&r.quality, asked);
    return r;
}

/* approximate time of a sketch relative to the march at the coarsest profile: 66 ms instead of 100 at 160 x 90 */
#define SKETCHED 0.6

/* The same rung, with volumes marched as a sketch. */
static struct kd_rung sketched(struct kd_rung r)
{
    r.quality.sketch = true;
    r.quality.final = false;
    r.rays *= SKETCHED;
    return r;
}

/* Adds a rung if it takes less work than the rung before it. */
static bool add_rung(struct kd_ladder *ladder, struct kd_rung rung)
{
    if (ladder->n_rungs == KD_LADDER_RUNGS || rung.rays >= ladder->rungs[ladder->n_rungs - 1].rays)
        return false;
    ladder->rungs[ladder->n_rungs++] = rung;
    return true;
}

static void make_rungs(const struct kd_scene *asked, const struct kd_ladder_bounds *bounds, struct kd_ladder *out)
{
    static const double scales[] = { 0.75, 0.625, 0.5, 0.375, 0.25 };
    double scale = 1;
    int32_t samples = asked->image.samples, orders = asked->accuracy.orders;
    out->rungs[0] = make_rung(asked, scale, samples, orders, -1);
    out->n_rungs = 1;
    if (!samples) /* 0 is "auto"; the next rung has one ray a pixel */
        add_rung(out, make_rung(asked, scale, samples = 1, orders, -1));
    while (samples > bounds->samples) {
        samples = samples / 2 > bounds->samples ? samples / 2 : bounds->samples;
        add_rung(out, make_rung(asked, scale, samples, orders, -1));
    }
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++)
        if (scales[i] >= bounds->scale && asked->image.width * scales[i] >= bounds->width &&
            add_rung(out, make_rung(asked, scales[i], samples, orders, -1)))
            scale = scales[i];
    /* a picture of stacked photon rings shows the higher orders, so they are kept */
    const int32_t least = asked->camera.projection == KD_PROJECTION_RING ? orders : bounds->orders;
    while (orders > least) {
        orders = (orders + 1) / 2 > least ? (orders + 1) / 2 : least;
        add_rung(out, make_rung(asked, scale, samples, orders, -1));
    }
    int32_t profile = by_profile(&asked->accuracy) ? asked->accuracy.profile : KD_PROFILE_BALANCED;
    while (--profile >= bounds->profile)
        add_rung(out, make_rung(asked, scale, samples, orders, profile));
    if (kd_emit_along(asked))
        add_rung(out, sketched(out->rungs[out->n_rungs - 1]));
}

static void make_steps(const struct kd_scene *asked, struct kd_ladder *out)
{
    const struct kd_accuracy *a = &asked->accuracy;
    bool dear = !by_profile(a) || a->profile > KD_PROFILE_BALANCED;
    int32_t profile = dear ? KD_PROFILE_BALANCED : -1;
    out->n_steps = 0;
    const int32_t most = asked->image.samples ? asked->image.samples + dear : 2;
    for (int32_t samples = 1; samples < most; samples *= 2)
        out->steps[out->n_steps++] = make_rung(asked, 1, samples, a->orders, profile);
    struct kd_rung last = make_rung(asked, 1, asked->image.samples, a->orders, -1);
    /* a request may name fewer steps than the profile */
    while (out->n_steps && out->steps[out->n_steps - 1].rays >= last.rays)
        out->n_steps--;
    out->steps[out->n_steps++] = last;
}

void kd_ladder_make(const struct kd_scene *asked, const struct kd_ladder_bounds *bounds, struct kd_ladder *out)
{
    make_rungs(asked, bounds, out);
    make_steps(asked, out);
}
