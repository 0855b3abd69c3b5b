/* Two jets as an emitter: shaders/emit/jets.glsl. */
#include "render/emit/emitter.h"

#include "physics/spacetime/kerr.h"
#include "scene/hole.h"

#include <math.h>
#include <stdio.h>

/* least ratio of a jet's inner radius to the horizon's radius; gas that flows out from further in is not visible */
#define CLEAR 1.05

static bool present(const struct kd_scene *scene) { return scene->jets.brightness > 0; }

static double inner(const struct kd_scene *scene)
{
    return fmax(scene->jets.inner, CLEAR * kd_scene_hole(scene)->outer);
}

static void reach(const struct kd_scene *scene, double radii[2])
{
    radii[0] = inner(scene);
    radii[1] = scene->jets.outer;
}

static double hollow(const struct kd_scene *scene) { return cos(scene->jets.opening_deg * (M_PI / 180)); }

static void tell(const struct kd_scene *scene, char out[KD_EMIT_TOLD])
{
    snprintf(out, KD_EMIT_TOLD, "%s along the axis, %.4g degrees wide, with a Lorentz factor of %.4g.",
             scene->jets.counterjet ? "Two jets" : "A jet", 2 * scene->jets.opening_deg, scene->jets.lorentz);
}

static void fill(struct kd_emission *out, const struct kd_scene *scene)
{
    const struct kd_jets *j = &scene->jets;
    const double slope = tan(j->opening_deg * (M_PI / 180));
    out->jets = (struct kd_jets_block) {
        .inner = (float)inner(scene),
        .outer = (float)j->outer,
        .cot = (float)(1 / slope),
        .tan_ = (float)slope,
        .brightness = (float)log2(fmax(j->brightness, 1e-300)),
        .sheath = (float)j->sheath,
        .falloff = (float)j->falloff,
        .power = (float)(2 + j->spectral_index),
        .gamma = (float)j->lorentz,
        .gamma_beta = (float)sqrt((j->lorentz - 1) * (j->lorentz + 1)),
        .counter = j->counterjet ? 1 : 0,
        .temperature = (float)j->temperature_k,
    };
}

static const struct kd_sentence sentences[] = {
    { "jets.drawn",
      "jets: they are stylised cones of optically thin gas along the spin axis; the gas moves radially outwards at one "
      "speed relative to observers of zero angular momentum; there is no magnetic field and no synchrotron spectrum; "
      "brightness is proportional to g^(2 + index), and the colour is that of a chosen temperature, which is not "
      "shifted",
      NULL },
};

const struct kd_emitter kd_emit_jets = {
    .name = "jets",
    .title = "jets",
    .tell = tell,
    .present = present,
    .reach = reach,
    .hollow = hollow,
    .fill = fill,
    .depends = { KD_SCENE_PART(spacetime), KD_SCENE_PART(jets) },
    .sentences = sentences,
    .n_sentences = sizeof sentences / sizeof *sentences,
};
