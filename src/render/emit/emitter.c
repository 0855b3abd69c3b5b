#include "render/emit/emitter.h"

#include "base/hash.h"
#include "physics/spacetime/kerr.h"
#include "render/emit/radio.h"
#include "scene/hole.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define DECLARE(number, name) extern const struct kd_emitter kd_emit_##name;
KD_EMITTERS(DECLARE, DECLARE, DECLARE, DECLARE, DECLARE, DECLARE)
#define ENTRY(number, name) [number] = &kd_emit_##name,
const struct kd_emitter *const kd_emitters[KD_EMITTER_COUNT] = { KD_EMITTERS(ENTRY, ENTRY, ENTRY, ENTRY, ENTRY,
                                                                             ENTRY) };

/* Kinds of emitters. The list of emitters has one argument for each kind. */
enum kind { AT_CROSSING = 1, HELPER = 2, MODULATE = 4, AT_END = 8, ALONG = 16, SURFACE = 32 };
#define IS_AT_CROSSING(number, name) [number] = AT_CROSSING,
#define IS_PART(number, name) [number] = HELPER,
#define IS_OVER(number, name) [number] = MODULATE,
#define IS_AT_END(number, name) [number] = AT_END,
#define IS_ALONG(number, name) [number] = ALONG,
#define IS_MET(number, name) [number] = SURFACE,
static const enum kind kinds[KD_EMITTER_COUNT] = { KD_EMITTERS(IS_AT_CROSSING, IS_PART, IS_OVER, IS_AT_END, IS_ALONG,
                                                               IS_MET) };

bool kd_emit_has(const struct kd_scene *scene, const struct kd_emitter *emitter)
{
    if (!emitter->present(scene))
        return false;
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        if (kd_emitters[i]->replaces == emitter && kd_emitters[i]->present(scene))
            return false;
    return true;
}

void kd_emit_traits(const struct kd_scene *scene, uint32_t out[KD_EMITTER_COUNT])
{
    for (int i = 0; i < KD_EMITTER_COUNT; i++) {
        const struct kd_emitter *e = kd_emitters[i];
        out[i] = !kd_emit_has(scene, e) ? 0 : KD_TRAIT_PRESENT | (e->traits ? e->traits(scene) : 0);
    }
}

void kd_emit_as_texels(uint32_t traits[KD_EMITTER_COUNT])
{
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        if (traits[i] & kd_emitters[i]->quads)
            traits[i] |= KD_TRAIT_TEXELS;
}

uint32_t kd_emit_needs(const struct kd_scene *scene)
{
    uint32_t needs = 0;
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        if (kd_emitters[i]->needs && kd_emit_has(scene, kd_emitters[i]))
            needs |= kd_emitters[i]->needs(scene);
    return needs;
}

static bool any(const struct kd_scene *scene, enum kind kind)
{
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        if (kinds[i] == kind && kd_emit_has(scene, kd_emitters[i]))
            return true;
    return false;
}

bool kd_emit_at_crossings(const struct kd_scene *scene) { return any(scene, AT_CROSSING); }

bool kd_emit_along(const struct kd_scene *scene) { return any(scene, ALONG); }

bool kd_emit_slow_along(const struct kd_scene *scene)
{
    uint32_t traits[KD_EMITTER_COUNT], all = 0;
    kd_emit_traits(scene, traits);
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        all |= kinds[i] == ALONG ? traits[i] : 0;
    return all & KD_TRAIT_SLOW;
}

bool kd_emit_met(const struct kd_scene *scene) { return any(scene, SURFACE); }

bool kd_emit_at_ends(const struct kd_scene *scene) { return any(scene, AT_END); }

static uint32_t all_traits(const struct kd_scene *scene)
{
    uint32_t traits[KD_EMITTER_COUNT], all = 0;
    kd_emit_traits(scene, traits);
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        all |= traits[i];
    return all;
}

bool kd_emit_separate_photometry(const struct kd_scene *scene)
{
    return all_traits(scene) & KD_TRAIT_SEPARATE_PHOTOMETRY;
}
bool kd_emit_points(const struct kd_scene *scene) { return all_traits(scene) & KD_TRAIT_POINTS; }

uint64_t kd_emit_device_bytes(const struct kd_scene *scene)
{
    uint64_t sum = 0;
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        if (kd_emitters[i]->device_bytes && kd_emitters[i]->present(scene))
            sum += kd_emitters[i]->device_bytes(scene);
    return sum;
}

uint64_t kd_emit_making_bytes(const struct kd_scene *scene)
{
    uint64_t sum = 0;
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        if (kd_emitters[i]->making_bytes && kd_emitters[i]->present(scene))
            sum += kd_emitters[i]->making_bytes(scene);
    return sum;
}

uint64_t kd_emit_invocations(const struct kd_scene *scene, enum kd_emitter_number number)
{
    const struct kd_emitter *e = kd_emitters[number];
    return e->invocations && e->present(scene) ? e->invocations(scene) : 0;
}

static float log2_of(uint64_t n) { return n ? (float)log2((double)n) : 0; }

struct kd_work kd_emit_work(const struct kd_scene *scene)
{
    const uint32_t needs = kd_emit_needs(scene);
    struct kd_work work = { 0 };
    uint32_t traits[KD_EMITTER_COUNT];
    kd_emit_traits(scene, traits);
    work.kind = kd_hash(kd_hash(KD_HASH_BEGIN, &needs, sizeof needs), traits, sizeof traits);
    for (int i = 0; i < KD_EMITTER_COUNT; i++) {
        const struct kd_emitter *e = kd_emitters[i];
        const bool there = e->present(scene);
        work.kind = kd_hash(work.kind, &there, sizeof there);
        work.log2_of[i][0] = there && e->device_bytes ? log2_of(e->device_bytes(scene)) : 0;
        work.log2_of[i][1] = there && e->invocations ? log2_of(e->invocations(scene)) : 0;
    }
    return work;
}

bool kd_work_alike(const struct kd_work *a, const struct kd_work *b)
{
    bool alike = a->kind == b->kind;
    for (int i = 0; i < KD_EMITTER_COUNT && alike; i++)
        for (int k = 0; k < 2; k++)
            alike &= fabsf(a->log2_of[i][k] - b->log2_of[i][k]) <= 1;
    return alike;
}

void kd_emit_sentences(const struct kd_scene *scene, const struct kd_setting *rays,
                       void (*take)(void *user, struct kd_approximation approximation), void *user)
{
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        for (const struct kd_emitter *e = kd_emit_has(scene, kd_emitters[i]) ? kd_emitters[i] : NULL; e; e = e->kind)
            for (size_t k = 0; k < e->n_sentences; k++)
                if (!e->sentences[k].in_force || e->sentences[k].in_force(scene, rays))
                    take(user, (struct kd_approximation) { e->sentences[k].name, e->sentences[k].text });
}

size_t kd_emit_sentence_count(void)
{
    size_t n = 0;
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        n += kd_emitters[i]->n_sentences;
    return n;
}

unsigned kd_emit_varies(const struct kd_scene *scene)
{
    unsigned sum = 0;
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        if (kd_emitters[i]->varies && kd_emit_has(scene, kd_emitters[i]))
            sum |= kd_emitters[i]->varies(scene);
    return sum;
}

static unsigned going_on(const struct kd_scene *scene)
{
    return (kd_emit_varies(scene) & ((kd_scene_time_goes_on(scene) ? KD_MOVES_WITH_TIME | KD_DIMS_WITH_TIME : 0) |
                                     (kd_scene_azimuth_goes_on(scene) ? KD_MOVES_WITH_AZIMUTH : 0))) |
           (kd_scene_falls(scene) ? KD_MOVES_BY_FALL : 0);
}

bool kd_emit_moves(const struct kd_scene *scene) { return going_on(scene); }
bool kd_emit_only_dims(const struct kd_scene *scene) { return going_on(scene) == KD_DIMS_WITH_TIME; }

static bool is_read(const struct kd_emitter *e, const struct kd_scene *scene)
{
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        for (const struct kd_emitter *of = kd_emit_has(scene, kd_emitters[i]) ? kd_emitters[i] : NULL; of;
             of = of->reads)
            if (of == e)
                return true;
    return false;
}

static bool is_current(const struct kd_emit_state *state, int i, const struct kd_scene *scene)
{
    const struct kd_scene_part *parts = kd_emitters[i]->depends;
    if (!state->filled[i])
        return false;
    for (int k = 0; k < KD_EMITTER_PARTS && parts[k].size; k++)
        if (memcmp((const char *)scene + parts[k].at, (const char *)&state->of[i] + parts[k].at, parts[k].size))
            return false;
    return true;
}

/* Range of radii of all emitters whose kind is in `of`; radii[0] > radii[1] if there is no such emitter. */
static void reach_of_all(const struct kd_scene *scene, unsigned of, double radii[2])
{
    radii[0] = INFINITY;
    radii[1] = 0;
    for (int i = 0; i < KD_EMITTER_COUNT; i++) {
        double own[2] = { 0, INFINITY };
        if (!(kinds[i] & of) || !kd_emit_has(scene, kd_emitters[i]))
            continue;
        if (kd_emitters[i]->reach)
            kd_emitters[i]->reach(scene, own);
        radii[0] = fmin(radii[0], own[0]);
        radii[1] = fmax(radii[1], own[1]);
    }
}

/* The least |cos(theta)| at which a volume emits or absorbs. height_of_all gives the largest. */
static double hollow_of_all(const struct kd_scene *scene)
{
    double least = 1;
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        if (kinds[i] == ALONG && kd_emit_has(scene, kd_emitters[i]))
            least = fmin(least, kd_emitters[i]->hollow ? kd_emitters[i]->hollow(scene) : 0);
    return least < 1 ? least : 0;
}

static double height_of_all(const struct kd_scene *scene)
{
    double most = 0;
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        if (kinds[i] == ALONG && kd_emit_has(scene, kd_emitters[i]))
            most = fmax(most, kd_emitters[i]->height ? kd_emitters[i]->height(scene) : 1);
    return most >= 1 ? 2 : most; /* returns 2 if a volume reaches the axis, so that no ray stops at the axis */
}

/* 1/r of the outermost knot in a volume; 0: none. */
static double knot_of_all(const struct kd_scene *scene)
{
    double r = 0;
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        if (kinds[i] == ALONG && kd_emit_has(scene, kd_emitters[i]) && kd_emitters[i]->knot)
            r = fmax(r, kd_emitters[i]->knot(scene));
    return r > 0 ? 1 / r : 0;
}

void kd_emit_update(struct kd_emit_state *state, const struct kd_scene *scene, uint32_t band_pixels)
{
    struct kd_emission *numbers = &state->data.emission;
    double reach[2], along[2];
    reach_of_all(scene, AT_CROSSING | HELPER, reach);
    reach_of_all(scene, ALONG, along);
    if (!state->colours)
        kd_colour_tables(&state->data.tables);
    state->colours = true;
    if (!state->luminous && scene->disk.band == KD_BAND_VISIBLE) {
        kd_luminous_table(&state->data.tables);
        state->luminous = true;
    }
    numbers->frame = (struct kd_frame_block) {
        .pixels_x = kd_scene_window(scene).width,
        .band_pixels = band_pixels,
        .azimuth = (float)(scene->camera.azimuth_deg * (M_PI / 180)),
        .delay = (float)kd_scene_lead(scene),
        /* The range is widened by more than a float's rounding, because the emitter itself cuts off at the exact
         * edge. */
        .w_least = (float)fmax((1 - 1e-6) / reach[1], 1e-30), /* not 0, because 0 means no crossing */
        .w_most = (float)fmin((1 + 1e-6) / reach[0], 1e30),
        .along_least = (float)(1 / along[1]),
        .along_most = (float)fmin(1 / along[0], 1e30),
        .along_hollow = (float)hollow_of_all(scene),
        .along_knot = (float)knot_of_all(scene),
        .along_u = (float)height_of_all(scene),
        .kelvin = (float)kd_radio_kelvin(scene),
        .jansky = (float)fmin(kd_radio_jansky_steradian(scene), FLT_MAX),
        .jansky_pixel = isfinite(scene->camera.r) ? 0 : (float)fmin(kd_radio_jansky_pixel(scene), FLT_MAX),
        .r_isco = (float)kd_kerr_isco(kd_scene_hole(scene)),
        .one_minus_a = (float)(1 - scene->spacetime.spin),
        .inner = (float)kd_disk_inner(scene),
        .outer = (float)scene->disk.outer,
    };
    for (int i = 0; i < KD_EMITTER_COUNT; i++) {
        const struct kd_emitter *e = kd_emitters[i];
        if (!is_read(e, scene) || is_current(state, i, scene))
            continue;
        if (e->fill)
            e->fill(numbers, scene);
        if (e->tables)
            e->tables(&state->data.tables, scene);
        memcpy(&state->of[i], scene, sizeof *scene); /* includes padding, because scenes are compared by memcmp */
        state->filled[i] = true;
    }
}
