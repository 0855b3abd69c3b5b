#include "render/plan/pass.h"

#include "render/accuracy/table.h"
#include "render/emit/emitter.h"
#include "render/plan/plan.h"

#include <math.h>
#include <string.h>

/* Cost of the closed form in double on one thread of the CPU, for three orders, as the audit uses it. */
#define NS_PER_AUDIT 4000.0
#define NS_PER_CLOSED 3000.0

/* The time of listed rays comes from the accuracy table. For settings that are not in the table, the time is
 * estimated from the number of steps. */
static double ns_listed(const struct kd_setting *by, const struct kd_capacity *c)
{
    for (uint32_t i = 0; c->accuracy_measured && i < c->accuracy->n; i++) {
        const struct kd_accuracy_row *row = &c->accuracy->rows[i];
        double rate = row->sets[KD_ACCURACY_BULK].rays_per_s;
        if (row->engine == by->engine && row->precision == by->precision && row->steps == by->steps && rate > 0)
            return 1e9 / rate;
    }
    return c->ns[KD_NS_RAY_FULL] * by->steps * (by->engine >= KD_ENGINE_KS_EULER ? 10 : 0.5);
}

static struct kd_pass_cost trace(const struct kd_plan *plan, const struct kd_capacity *c)
{
    const struct kd_setting *by = &plan->lens.setting;
    const enum kd_figure_id figure = kd_plan_is_radii(&plan->lens) ? KD_NS_RAY_RADIUS : KD_NS_RAY_FULL;
    switch (plan->lens.path) {
    case KD_LENS_CLOSED: return (struct kd_pass_cost) { "lens_closed.comp", c->ns[figure], figure };
    case KD_LENS_MAP: return (struct kd_pass_cost) { "lens_map.comp", c->ns[figure], figure };
    case KD_LENS_LISTED: break;
    }
    if (by->engine == KD_ENGINE_CLOSED)
        return (struct kd_pass_cost) { "", NS_PER_CLOSED / (c->cores ? c->cores : 1), KD_NS_NONE };
    return (struct kd_pass_cost) { by->engine >= KD_ENGINE_KS_EULER ? "rays_kerr_schild.comp" : "rays.comp",
                                   ns_listed(by, c), KD_NS_NONE };
}

/* The number of pixels that need more rays depends on the content. For example, refinement takes fifteen times as
 * long for turbulent gas as for a smooth disk. So the figure is measured on earlier pictures. If there are volumes,
 * the time of their light is added. */
static struct kd_pass_cost refine(const struct kd_plan *plan, const struct kd_capacity *c)
{
    const double ns = c->ns[KD_NS_RAY_REFINED];
    return plan->light.march.steps
               ? (struct kd_pass_cost) { "transfer.comp", ns + kd_plan_light_ns(&plan->light, c), KD_NS_NONE }
               : (struct kd_pass_cost) { "transfer.comp", ns, KD_NS_RAY_REFINED };
}

static struct kd_pass_cost transfer(const struct kd_plan *plan, const struct kd_capacity *c)
{
    return (struct kd_pass_cost) { "transfer.comp", kd_plan_light_ns(&plan->light, c),
                                   kd_plan_light_figure(&plan->light) };
}

/* All volumes share one figure. So the figure is measured only on volumes of the usual weight. */
static struct kd_pass_cost march(const struct kd_plan *plan, const struct kd_capacity *c)
{
    const bool usual = fabs(plan->light.march.weight - 1) < 1e-9;
    return (struct kd_pass_cost) { "transfer.comp", kd_plan_light_ns(&plan->light, c),
                                   usual ? KD_NS_RAY_MARCH : KD_NS_NONE };
}

/* Each ray of the sample is followed as in the picture, and again with KD_MARCH_FINER times as many stretches. */
static struct kd_pass_cost march_error(const struct kd_plan *plan, const struct kd_capacity *c)
{
    return (struct kd_pass_cost) { "transfer.comp", (1 + KD_MARCH_FINER) * kd_plan_light_ns(&plan->light, c),
                                   KD_NS_NONE };
}

/* On lavapipe, interpolating a ray takes a quarter of the time of tracing it if only radii are interpolated, and a
 * tenth if all quantities are. */
static struct kd_pass_cost interpolate(const struct kd_plan *plan, const struct kd_capacity *c)
{
    const double ns = kd_plan_is_radii(&plan->lens) ? 0.25 * c->ns[KD_NS_RAY_RADIUS] : 0.1 * c->ns[KD_NS_RAY_FULL];
    return (struct kd_pass_cost) { "lens_fill.comp", ns, KD_NS_NONE };
}

static struct kd_pass_cost audit(const struct kd_plan *plan, const struct kd_capacity *c)
{
    (void)plan, (void)c;
    return (struct kd_pass_cost) { "", NS_PER_AUDIT, KD_NS_NONE };
}

/* Bloom reads each pixel once and computes each cell of the grids. On lavapipe this takes 2.1 ns a pixel and 41 ns a
 * cell; for comparison, post takes 5.3 ns a pixel. */
static struct kd_pass_cost bloom(const struct kd_plan *plan, const struct kd_capacity *c)
{
    const double cells = kd_bloom_cells(&plan->picture.bloom, 0) / ((double)plan->picture.width * plan->picture.height);
    return (struct kd_pass_cost) { "bloom_bright.comp", (0.4 + 7.8 * cells) * c->ns[KD_NS_PIXEL_POST], KD_NS_NONE };
}

/* With bloom the post pass also reads cells, so its time does not update the figure. */
static struct kd_pass_cost post(const struct kd_plan *plan, const struct kd_capacity *c)
{
    const double more = !plan->picture.bloom.levels                                    ? 1
                        : kd_bloom_together(&plan->picture.bloom, plan->picture.width) ? 2
                                                                                       : 2.7;
    return (struct kd_pass_cost) { "post.comp", more * c->ns[KD_NS_PIXEL_POST],
                                   plan->picture.bloom.levels ? KD_NS_NONE : KD_NS_PIXEL_POST };
}

/* Measured with lavapipe: gathering and interpolation take three times as long as post. Each weight of the two blurs,
 * and of two more sums if cells are large, takes a seventh of post's time. */
static struct kd_pass_cost beam(const struct kd_plan *plan, const struct kd_capacity *c)
{
    const struct kd_beam_grid *b = &plan->picture.beam;
    const double weights =
        2.0 * (2 * b->reach + 1) * b->columns * b->rows + (b->cell > 1 ? 6.0 * b->columns * b->height : 0);
    return (struct kd_pass_cost) { "beam_gather.comp",
                                   (3.2 + 0.15 * weights / ((double)plan->picture.width * plan->picture.height)) *
                                       c->ns[KD_NS_PIXEL_POST],
                                   KD_NS_NONE };
}

#define INVOCATIONS(name, n) \
    static uint64_t name(const struct kd_plan *plan, const struct kd_scene *scene) \
    { \
        return (void)plan, (void)scene, n; \
    }
INVOCATIONS(traced, plan->lens.planes ? kd_plan_followed(&plan->lens) : 0)
INVOCATIONS(interpolated, plan->lens.interpolates > 0 ? plan->lens.rays : 0)
INVOCATIONS(footprints, kd_plan_has_footprints(&plan->lens) ? kd_plan_followed(&plan->lens) : 0)
INVOCATIONS(audited, plan->lens.audit)
INVOCATIONS(lit, plan->light.march.steps ? 0 : kd_plan_rays(&plan->lens))
INVOCATIONS(marched, plan->light.march.steps ? kd_plan_rays(&plan->lens) : 0)
INVOCATIONS(sampled, plan->light.march.steps ? plan->light.march.sample.columns * plan->light.march.sample.rows : 0)
INVOCATIONS(starred, plan->light.points ? plan->lens.rays / (plan->light.bright ? KD_PLAN_BRIGHT : 1) : 0)

/* True if the disk is streaked: turbulent gas or particles. */
static bool is_streaked(const struct kd_scene *scene)
{
    return scene->disk.model == KD_DISK_PARTICLES || (scene->disk.model != KD_DISK_NONE && scene->gas.amplitude > 0);
}

/* At the critical curve three pixels in four get denser rays. Elsewhere one pixel in 300 is at an edge and gets
 * traced rays. Where the map is smooth but light is not linear, rays are interpolated. The number of these pixels
 * depends on the content: one in three for streaked disks, otherwise one in thirty. At 1280 x 720 the presets
 * gargantua and default trace 0.59 and 1.09 million rays, estimated here as 0.79 and 0.91. They interpolate 34 000
 * and 308 000 pixels, estimated as 31 000 and 307 000. */
static uint64_t refined(const struct kd_plan *plan, const struct kd_scene *scene)
{
    const uint64_t curve = 3 * plan->lens.critical_pixels * plan->lens.critical_dense / 4,
                   elsewhere = plan->lens.rays / 300, between = plan->lens.rays / (is_streaked(scene) ? 3 : 30);
    return plan->lens.adaptive ? curve + elsewhere * plan->lens.adaptive +
                                     between * KD_PLAN_ADAPTIVE_SIDE * KD_PLAN_ADAPTIVE_SIDE + KD_PLAN_SAMPLED
                               : 0;
}

INVOCATIONS(pixels, (uint64_t)plan->picture.width * plan->picture.height)
INVOCATIONS(layered, plan->picture.n_layers *pixels(plan, scene))
INVOCATIONS(added_up, plan->light.photometry ? pixels(plan, scene) : 0)
INVOCATIONS(shown, plan->picture.no_image ? 0 : pixels(plan, scene))
/* The post pass also runs for refinement, which examines the whole picture before its first round and after each
 * round. */
INVOCATIONS(posted, shown(plan, scene) * (plan->lens.adaptive ? 1 + KD_PLAN_REFINING_LOOKS : 1))
INVOCATIONS(spread, plan->picture.bloom.levels ? shown(plan, scene) : 0)
INVOCATIONS(beamed, plan->picture.beam.cell ? shown(plan, scene) : 0)
INVOCATIONS(exposed, isinf(scene->style.exposure) ? shown(plan, scene) : 0)
#define KD_P(emitter, ...) INVOCATIONS(own_##emitter, kd_emit_invocations(scene, KD_EMITTER_##emitter))
KD_EMIT_PASSES
#undef KD_P

#define FIGURE(id, word, guess) [KD_NS_##id] = { word, guess },
#define KD_P(emitter, id, word, guess) FIGURE(id, word, guess)
const struct kd_figure kd_figures[KD_FIGURE_COUNT] = { KD_FIGURES(FIGURE) KD_EMIT_PASSES };
#undef KD_P

#define WHOLE(of, by_figure) .kernel = of, .figure = KD_NS_##by_figure, .share = 1, .whole = true
#define PART(of, by_figure, part) .kernel = of, .figure = KD_NS_##by_figure, .share = part
#define BY(function) .by = function
#define PASS(id, called, n, cost, grows_with, each) \
    [KD_PASS_##id] = { .name = called, .invocations = n, cost, .scale = KD_SCALE_##grows_with, .when = KD_EACH_##each },
#define KD_P(emitter, id, ...) PASS(OWN_##emitter, #emitter, own_##emitter, WHOLE(#emitter ".comp", id), FIXED, FRAME)
const struct kd_pass kd_passes[KD_PASS_COUNT] = { KD_PASSES(PASS) };
#undef KD_P

const struct kd_pass *kd_pass_find(const char *name)
{
    for (int i = 0; i < KD_PASS_COUNT; i++)
        if (!strcmp(kd_passes[i].name, name))
            return &kd_passes[i];
    return NULL;
}

struct kd_pass_cost kd_pass_cost(const struct kd_pass *pass, const struct kd_plan *plan, const struct kd_capacity *c)
{
    if (pass->by)
        return pass->by(plan, c);
    return (struct kd_pass_cost) { pass->kernel, pass->share * c->ns[pass->figure],
                                   pass->whole ? pass->figure : KD_NS_NONE };
}
