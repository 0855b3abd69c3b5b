/* Bodies as an emitter: shaders/emit/bodies.glsl. */
#include "render/emit/bodies.h"

#include "physics/math/angle.h"
#include "physics/spacetime/kerr.h"
#include "physics/spacetime/observer.h"
#include "render/emit/emitter.h"
#include "render/emit/particles.h"
#include "scene/hole.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Computes a body's velocity relative to the observer of zero angular momentum at the body's position. Returns the
 * body's angular velocity. */
static double motion_of(const struct kd_body *body, const struct kd_vantage *at, double velocity[3])
{
    const struct kd_observer_motion zamo = kd_observer_motion_of(KD_OBSERVER_ZAMO), motion = kd_body_motion(body);
    const struct kd_tetrad frame = kd_observer_tetrad(&zamo, at), own = kd_observer_tetrad(&motion, at);
    double x[4];
    kd_tetrad_components(&frame, &own.t, x);
    for (int i = 0; i < 3; i++)
        velocity[i] = x[i + 1] / x[0];
    const int sense = kd_observer_sense(motion.observer);
    if (sense)
        return sense * kd_kerr_omega(kd_hole_turned(&at->hole, sense), at->r);
    return motion.observer == KD_OBSERVER_ZAMO ? kd_kerr_dragging(&at->hole, at->r, at->u) : 0;
}

static double omega_of(const struct kd_scene *scene, const struct kd_body *body)
{
    const struct kd_vantage at = kd_body_vantage(scene, body);
    double velocity[3];
    return motion_of(body, &at, velocity);
}

size_t kd_bodies_count(const struct kd_scene *scene)
{
    const struct kd_body *on[KD_SCENE_BODIES];
    return kd_scene_bodies(scene, on) + (scene->dynamic.at ? scene->dynamic.at->n : 0);
}

size_t kd_bodies_of(const struct kd_scene *scene, struct kd_seen_body *out)
{
    const struct kd_body *on[KD_SCENE_BODIES];
    const size_t n = kd_scene_bodies(scene, on), others = scene->dynamic.at ? scene->dynamic.at->n : 0;
    const double time = scene->top.time - kd_particle_delay(scene);
    for (size_t i = 0; i < n; i++) {
        const struct kd_vantage at = kd_body_vantage(scene, on[i]);
        struct kd_seen_body *b = &out[i];
        *b = (struct kd_seen_body) {
            .which = (uint32_t)(on[i] - scene->bodies.at),
            .r = at.r,
            .u = at.u,
            .s = at.s,
            .radius = on[i]->radius,
            .temperature_k = on[i]->temperature_k,
            .brightness = on[i]->brightness,
            .limb_darkening = on[i]->limb_darkening,
        };
        b->phi = on[i]->phase_deg * (M_PI / 180) + remainder(motion_of(on[i], &at, b->velocity) * time, 2 * M_PI);
    }
    if (others)
        memcpy(out + n, scene->dynamic.at->bodies, others * sizeof *out);
    for (size_t i = n; i < n + others; i++)
        out[i].which += KD_SCENE_BODIES;
    return n + others;
}

static bool present(const struct kd_scene *scene) { return kd_bodies_count(scene); }

static unsigned varies(const struct kd_scene *scene)
{
    const struct kd_body *on[KD_SCENE_BODIES];
    unsigned by = KD_MOVES_WITH_AZIMUTH;
    for (size_t i = kd_scene_bodies(scene, on); i; i--)
        by |= omega_of(scene, on[i - 1]) != 0 ? KD_MOVES_WITH_TIME : 0;
    return by;
}

/* Number of bodies of a playground that cannot be shown. */
static size_t unseen_of(const struct kd_scene *scene)
{
    size_t unseen = 0;
    for (size_t i = 0; scene->dynamic.at && i < scene->dynamic.at->n; i++)
        unseen += !kd_bodies_seen(&scene->dynamic.at->bodies[i], kd_scene_hole(scene));
    return unseen;
}

static void tell(const struct kd_scene *scene, char out[KD_EMIT_TOLD])
{
    const struct kd_body *on[KD_SCENE_BODIES];
    const size_t n = kd_scene_bodies(scene, on), others = kd_bodies_count(scene) - n;
    size_t used = n ? (size_t)snprintf(out, KD_EMIT_TOLD, "%s at ", n > 1 ? "Bodies" : "A body") : 0;
    for (size_t i = 0; i < n && used < KD_EMIT_TOLD; i++)
        used += (size_t)snprintf(out + used, KD_EMIT_TOLD - used, "%s%.6g M%s", i ? ", " : "", on[i]->r,
                                 i + 1 == n ? "." : "");
    if (others && used < KD_EMIT_TOLD)
        used += (size_t)snprintf(out + used, KD_EMIT_TOLD - used, "%s%zu %s of a playground at %.6g M of its time.",
                                 n ? " " : "", others, others > 1 ? "bodies" : "body", scene->dynamic.at->time);
    if (unseen_of(scene) && used < KD_EMIT_TOLD)
        snprintf(out + used, KD_EMIT_TOLD - used,
                 " Bodies that are not shown, because they have no radius or are at the horizon: %zu.",
                 unseen_of(scene));
}

static uint64_t device_bytes(const struct kd_scene *scene)
{
    return sizeof(float) * kd_bodies_words(kd_bodies_count(scene));
}

/* Lists all n bodies; the caller frees the list. NULL: out of memory. */
static struct kd_seen_body *listed(const struct kd_scene *scene, size_t *n)
{
    struct kd_seen_body *bodies = malloc((kd_bodies_count(scene) + 1) * sizeof *bodies);
    *n = bodies ? kd_bodies_of(scene, bodies) : 0;
    return bodies;
}

/* True if some bodies reflect light of the disk, and the scene has a disk. */
static bool is_lit(const struct kd_scene *scene)
{
    for (size_t i = 0; scene->dynamic.at && i < scene->dynamic.at->n; i++)
        if (scene->dynamic.at->bodies[i].albedo > 0)
            return kd_illumination_exists(scene);
    return false;
}

static uint32_t traits(const struct kd_scene *scene)
{
    return KD_TRAIT_AZIMUTH | (scene->disk.band == KD_BAND_VISIBLE ? KD_TRAIT_VISIBLE : 0) |
           (is_lit(scene) ? KD_TRAIT_LIT : 0);
}

static struct kd_bodies_view view_of(const struct kd_scene *scene)
{
    return (struct kd_bodies_view) { *kd_scene_hole(scene), scene->camera.azimuth_deg * (M_PI / 180),
                                     kd_disk_peak_temperature(scene) * scene->disk.hardening, NULL };
}

static void fill(struct kd_emission *out, const struct kd_scene *scene)
{
    const struct kd_bodies_view view = view_of(scene);
    size_t n;
    struct kd_seen_body *bodies = listed(scene, &n);
    /* out of memory: `prepare` fails as well, and reports it */
    out->bodies = (struct kd_bodies_block) { .least = 1, .leaves = 1 };
    if (bodies)
        kd_bodies_bound(bodies, n, &view, &out->bodies);
    free(bodies);
}

struct own {
    struct kd_vk_buffer *device, *staging;
    float *there; /* the numbers that were sent last; NULL: none */
    size_t words;
};

static void forget(void *own)
{
    struct own *o = own;
    free(o->there);
    o->there = NULL;
}

/* Uploads *words unless the device has the same words already. Keeps them for the next comparison. */
static enum kd_status send(const struct kd_emitter_buffers_work *work, float **words, size_t n, struct kd_error *error)
{
    struct own *o = work->own;
    const uint64_t bytes = n * sizeof **words;
    enum kd_status status;
    if (o->there && o->words == n && !memcmp(o->there, *words, bytes))
        return KD_OK;
    forget(o);
    KD_TRY(kd_emitter_buffers_at_least(work, &o->device, bytes, KD_VK_DEVICE, "bodies", error));
    KD_TRY(kd_emitter_buffers_at_least(work, &o->staging, bytes, KD_VK_UPLOAD, "bodies on the host", error));
    memcpy(kd_vk_buffer_map(o->staging), *words, bytes);
    KD_TRY(kd_vk_copy(work->vk, "upload", o->device, 0, o->staging, 0, bytes, error));
    KD_TRY(kd_vk_submit(work->vk, NULL, error));
    o->words = n;
    o->there = *words;
    *words = NULL;
done:
    return status;
}

static enum kd_status prepare(const struct kd_emitter_buffers_work *work, const struct kd_scene *scene,
                              struct kd_error *error)
{
    struct kd_bodies_view view = view_of(scene);
    struct kd_illumination lit;
    size_t n;
    struct kd_seen_body *bodies = listed(scene, &n);
    if (is_lit(scene) && kd_illumination_of(scene, &lit))
        view.lit = &lit;
    float *words = malloc(kd_bodies_words(n) * sizeof *words);
    enum kd_status status = bodies && words ? kd_bodies_pack(bodies, n, &view, words, error)
                                            : kd_error_set(error, KD_ENOMEM, "out of memory for bodies");
    if (!status)
        status = send(work, &words, kd_bodies_words(n), error);
    free(bodies);
    free(words);
    return status;
}

static void buffers(const void *own, struct kd_vk_buffer *out[KD_OWN_COUNT])
{
    out[KD_OWN_bodies] = ((const struct own *)own)->device;
}

static void finish(void *own, struct kd_vk *vk)
{
    struct own *o = own;
    forget(o);
    kd_vk_buffer_destroy(vk, o->device);
    kd_vk_buffer_destroy(vk, o->staging);
    *o = (struct own) { 0 };
}

const struct kd_emitter_buffers kd_emitter_buffers_bodies = {
    .bytes = sizeof(struct own), .prepare = prepare, .buffers = buffers, .forget = forget, .finish = finish
};

/* True if a body has a velocity although its position does not depend on the time. */
static bool stands(const struct kd_scene *scene, const struct kd_setting *rays)
{
    const struct kd_body *on[KD_SCENE_BODIES];
    (void)rays;
    for (size_t i = kd_scene_bodies(scene, on); i; i--)
        if (on[i - 1]->motion == KD_OBSERVER_INFALL || on[i - 1]->motion == KD_OBSERVER_VELOCITY)
            return true;
    return false;
}

static bool large(const struct kd_scene *scene, const struct kd_setting *rays)
{
    const struct kd_body *on[KD_SCENE_BODIES];
    (void)rays;
    for (size_t i = kd_scene_bodies(scene, on); i; i--)
        if (on[i - 1]->radius > 0.1 * on[i - 1]->r)
            return true;
    for (size_t i = 0; scene->dynamic.at && i < scene->dynamic.at->n; i++)
        if (scene->dynamic.at->bodies[i].radius > 0.1 * scene->dynamic.at->bodies[i].r)
            return true;
    return false;
}

static bool shown(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, scene->dynamic.at && scene->dynamic.at->n;
}
static bool lit_ones(const struct kd_scene *scene, const struct kd_setting *rays) { return (void)rays, is_lit(scene); }
static bool dark(const struct kd_scene *scene, const struct kd_setting *rays) { return (void)rays, !is_lit(scene); }
static bool by_potential(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return shown(scene, rays) && scene->dynamic.at->approximate;
}

#define WHEN(name, condition) \
    static bool name(const struct kd_scene *scene, const struct kd_setting *rays) { return (void)rays, condition; }
WHEN(bolometric, scene->disk.band == KD_BAND_BOLOMETRIC)
WHEN(unseen, unseen_of(scene))

static const struct kd_sentence sentences[] = {
    { "bodies.flat",
      "bodies: they are opaque spheres in their own frames; near a body, space is taken as flat and rays as straight; "
      "tides, shadows and the gravity of bodies are ignored",
      NULL },
    { "bodies.unlit", "bodies: light of the disk that falls on them is ignored", dark },
    { "bodies.lit",
      "bodies: they scatter light of the disk equally in all directions; this light comes along straight lines from 16 "
      "rings of 24 points of a smooth, unobscured disk without limb darkening; only three moments of its direction are "
      "used",
      lit_ones },
    { "bodies.large",
      "bodies: a body whose radius exceeds a tenth of its distance from the hole has a wrong shape, because space near "
      "it is taken as flat",
      large },
    { "bodies.black-body",
      "bodies: each body shines as a black body of one temperature, with a chosen linear law of limb darkening", NULL },
    { "bodies.fast",
      "bodies: all are shown at one coordinate time, and the delay of their light is ignored (fast light)", NULL },
    { "bodies.still",
      "bodies: a falling body, or one with a chosen velocity, stays at its place; its velocity only shifts its light",
      stands },
    { "bodies.playground",
      "bodies: bodies of a playground are shown at its time, with velocities relative to observers of zero angular "
      "momentum",
      shown },
    { "bodies.potential",
      "bodies: bodies of a playground move in a potential; its r is taken as the Boyer-Lindquist radius, and a "
      "velocity in the potential as gamma v",
      by_potential },
    { "bodies.not-shown",
      "bodies: some bodies of a playground are not shown, because they have no radius or are at the horizon", unseen },
    { "bodies.bolometric", "bodies: brightness is bolometric (g^4), colour is that of the visible part of the spectrum",
      bolometric },
    { "bodies.small", "bodies: rays may miss a body that is smaller than a pixel", NULL },
};

const struct kd_emitter kd_emit_bodies = {
    .name = "bodies",
    .title = "bodies",
    .tell = tell,
    .present = present,
    .traits = traits,
    .varies = varies,
    .own = &kd_emitter_buffers_bodies,
    .device_bytes = device_bytes,
    .fill = fill,
    .depends = { KD_SCENE_PART(spacetime), KD_SCENE_PART(camera), KD_SCENE_PART(disk), KD_SCENE_PART(bodies),
                 KD_SCENE_PART(top), KD_SCENE_PART(dynamic) },
    .sentences = sentences,
    .n_sentences = sizeof sentences / sizeof *sentences,
    .reads = &kd_emit_disk,
};
