/* The light of a lamp on the axis for the flash: shaders/emit/lamp.glsl. */
#include "render/emit/emitter.h"

#include "physics/disk/lamppost.h"
#include "scene/hole.h"

#include <assert.h>
#include <math.h>

static bool present(const struct kd_scene *scene) { return scene->flash.brightness > 0; }

static void reach(const struct kd_scene *scene, double radii[2]) { (void)scene, radii[0] = INFINITY, radii[1] = 0; }

static double step_of(const struct kd_scene *scene)
{
    return log(scene->disk.outer / kd_disk_inner(scene)) / (KD_LAMP_TABLE - 1);
}

static void fill(struct kd_emission *out, const struct kd_scene *scene)
{
    out->lamp.first = (float)log(kd_disk_inner(scene));
    out->lamp.per_row = (float)(1 / step_of(scene));
}

static void tables(struct kd_emit_tables *out, const struct kd_scene *scene)
{
    const double inner = kd_disk_inner(scene), step = step_of(scene);
    double light[KD_LAMP_TABLE], late[KD_LAMP_TABLE], largest = 0;
    struct kd_lamppost lamp;
    const bool lit = kd_lamppost_init(&lamp, kd_scene_hole(scene), scene->flash.height, scene->flash.photon_index,
                                      inner, scene->disk.outer);
    assert(lit); /* the rules of scenes ensure this (tests/unit/physics_disk.c) */
    (void)lit;
    for (int i = 0; i < KD_LAMP_TABLE; i++) {
        const double r = inner * exp(i * step), received = kd_lamppost_at(&lamp, r);
        largest = fmax(largest, received);
        late[i] = kd_lamppost_time(&lamp, r) - r;
        light[i] = received * r * r * r;
    }
    for (int i = 0; i < KD_LAMP_TABLE; i++) {
        const int next = i + 1 < KD_LAMP_TABLE ? i + 1 : i;
        out->lamp[i][0] = (float)late[i];
        out->lamp[i][1] = (float)(late[next] - late[i]);
        out->lamp[i][2] = (float)(light[i] / largest);
        out->lamp[i][3] = (float)((light[next] - light[i]) / largest);
    }
}

static const struct kd_sentence sentences[] = {
    { "lamp.point",
      "lamp: it is a point at rest on the axis, and a second one lies below the disk, so that both faces are lit "
      "alike; it shines in all directions with a power-law spectrum, and is not shown itself; its light meets the disk "
      "once",
      NULL },
};

const struct kd_emitter kd_emit_lamp = {
    .name = "lamp",
    .title = "lamp",
    .present = present,
    .reach = reach,
    .fill = fill,
    .tables = tables,
    .depends = { KD_SCENE_PART(spacetime), KD_SCENE_PART(disk), KD_SCENE_PART(flash) },
    .sentences = sentences,
    .n_sentences = sizeof sentences / sizeof *sentences,
    .reads = &kd_emit_disk,
};
