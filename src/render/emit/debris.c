/* Debris of a playground as an emitter: shaders/emit/debris.glsl. */
#include "scene/dynamic_bodies.h"
#include "render/emit/emitter.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define REFERENCE 1000.0 /* the area in M^2 over which one body's debris has the optical depth `depth` */

static const struct kd_dynamic_bodies_debris *of(const struct kd_scene *scene) { return &scene->dynamic.at->debris; }

static bool present(const struct kd_scene *scene)
{
    return scene->dynamic.at && of(scene)->rows && of(scene)->depth > 0;
}
static uint32_t traits(const struct kd_scene *scene)
{
    return scene->disk.band == KD_BAND_VISIBLE ? KD_TRAIT_VISIBLE : 0;
}
static uint32_t needs(const struct kd_scene *scene) { return (void)scene, KD_LENS_W | KD_LENS_PHI | KD_LENS_SLOPE; }
static unsigned varies(const struct kd_scene *scene) { return (void)scene, KD_MOVES_WITH_AZIMUTH; }

static double radius(const struct kd_dynamic_bodies_debris *d, double row)
{
    return exp((d->first_row + row) * (2 * M_PI / d->turn));
}

static void reach(const struct kd_scene *scene, double radii[2])
{
    radii[0] = radius(of(scene), 0);
    radii[1] = radius(of(scene), of(scene)->rows - 1.0);
}

static void tell(const struct kd_scene *scene, char out[KD_EMIT_TOLD])
{
    snprintf(out, KD_EMIT_TOLD, "%u pieces of debris, from %.4g M to %.4g M.", of(scene)->pieces, radius(of(scene), 0),
             radius(of(scene), of(scene)->rows - 1.0));
}

static size_t words(const struct kd_dynamic_bodies_debris *d) { return KD_CROWD_NODE * (size_t)d->rows * d->columns; }
/* Two buffers: `numbers` on the device, and `staging`, through which they are uploaded. */
static uint64_t device_bytes(const struct kd_scene *scene) { return 2 * sizeof(float) * words(of(scene)); }

/* The area of a node is r^2 (2 pi/turn)^2, where `turn` is the number of nodes in a turn. */
static void fill(struct kd_emission *out, const struct kd_scene *scene)
{
    const struct kd_dynamic_bodies_debris *d = of(scene);
    const double cell = 2 * M_PI / d->turn;
    out->debris = (struct kd_debris_block) {
        .turn = d->turn,
        .rows = d->rows,
        .columns = d->columns,
        .first_row = (float)d->first_row,
        .first_column = (float)d->first_column,
        .rows_octave = (float)(M_LN2 / cell),
        .depth = (float)fmin(REFERENCE * d->depth / (cell * cell), 1e30),
        .temperature = (float)(d->temperature_k / (kd_disk_peak_temperature(scene) * scene->disk.hardening)),
    };
}

struct own {
    struct kd_vk_buffer *device, *staging;
    uint64_t generation; /* generation of the uploaded debris; 0: none is uploaded */
};

static void forget(void *own) { ((struct own *)own)->generation = 0; }

static enum kd_status prepare(const struct kd_emitter_buffers_work *work, const struct kd_scene *scene,
                              struct kd_error *error)
{
    struct own *o = work->own;
    const uint64_t bytes = sizeof(float) * words(of(scene));
    enum kd_status status;
    if (o->generation == scene->dynamic.generation)
        return KD_OK;
    forget(o);
    KD_TRY(kd_emitter_buffers_at_least(work, &o->device, bytes, KD_VK_DEVICE, "debris", error));
    KD_TRY(kd_emitter_buffers_at_least(work, &o->staging, bytes, KD_VK_UPLOAD, "debris on the host", error));
    memcpy(kd_vk_buffer_map(o->staging), of(scene)->nodes, bytes);
    KD_TRY(kd_vk_copy(work->vk, "upload", o->device, 0, o->staging, 0, bytes, error));
    KD_TRY(kd_vk_submit(work->vk, NULL, error));
    o->generation = scene->dynamic.generation;
done:
    return status;
}

static void buffers(const void *own, struct kd_vk_buffer *out[KD_OWN_COUNT])
{
    out[KD_OWN_debris] = ((const struct own *)own)->device;
}

static void finish(void *own, struct kd_vk *vk)
{
    struct own *o = own;
    kd_vk_buffer_destroy(vk, o->device);
    kd_vk_buffer_destroy(vk, o->staging);
    *o = (struct own) { 0 };
}

static const struct kd_emitter_buffers own = {
    .bytes = sizeof(struct own), .prepare = prepare, .buffers = buffers, .forget = forget, .finish = finish
};

#define WHEN(name, condition) \
    static bool name(const struct kd_scene *scene, const struct kd_setting *rays) { return (void)rays, condition; }
WHEN(thick, of(scene)->thick > 0.02)
WHEN(hidden, of(scene)->hidden)
WHEN(by_potential, scene->dynamic.at->approximate)
WHEN(bolometric, scene->disk.band == KD_BAND_BOLOMETRIC)

static const struct kd_sentence sentences[] = {
    { "debris.plane",
      "debris: it is projected onto the disk's plane and shown as a density on a grid of r and azimuth, so that a "
      "stream is at least one cell wide",
      NULL },
    { "debris.no-height", "debris: its mean distance from the disk's plane exceeds r/50; this height is not shown",
      thick },
    { "debris.black-body",
      "debris: it shines as a black body of one chosen temperature; its optical depth is a chosen number times its "
      "column density, at any angle",
      NULL },
    { "debris.mean",
      "debris: its light is shifted by the local mean velocity within the plane; heating by shocks and the spread of "
      "velocities are ignored",
      NULL },
    { "debris.fast",
      "debris: all of it is shown at one coordinate time, and the delay of its light is ignored (fast light)", NULL },
    { "debris.potential",
      "debris: it moves in a potential, whose r is taken as the Boyer-Lindquist radius; a velocity in the potential is "
      "taken as gamma v",
      by_potential },
    { "debris.not-shown", "debris: some pieces are outside the grid and not shown", hidden },
    { "debris.bolometric", "debris: brightness is bolometric (g^4), colour is that of the visible part of the spectrum",
      bolometric },
};

const struct kd_emitter kd_emit_debris = {
    .name = "debris",
    .title = "debris",
    .tell = tell,
    .present = present,
    .traits = traits,
    .needs = needs,
    .varies = varies,
    .own = &own,
    .device_bytes = device_bytes,
    .reach = reach,
    .fill = fill,
    .depends = { KD_SCENE_PART(spacetime), KD_SCENE_PART(disk), KD_SCENE_PART(dynamic) },
    .sentences = sentences,
    .n_sentences = sizeof sentences / sizeof *sentences,
    .reads = &kd_emit_disk,
};
