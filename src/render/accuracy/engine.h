/* Engines that trace rays, and the setting (engine, precision, steps) that an accuracy request resolves to. Plain
 * values, pure functions; any thread. */
#ifndef KD_RENDER_ACCURACY_ENGINE_H
#define KD_RENDER_ACCURACY_ENGINE_H

#include "base/error.h"
#include "scene/scene.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

enum kd_engine {
    KD_ENGINE_CLOSED, /* elliptic functions: in double on the CPU, the reference; in single on the device, outside the
                         orbits of light */
    KD_ENGINE_MINO_RKN4, /* Mino time on the device: Nystroem's method of order 4, */
    KD_ENGINE_MINO_RKN6, /* Albrecht's of order 6 */
    KD_ENGINE_KS_EULER,  /* the Kerr-Schild Hamiltonian on the device: symplectic Euler, */
    KD_ENGINE_KS_RK4,    /* classical Runge-Kutta, */
    KD_ENGINE_KS_TAO6,   /* Tao's extended phase space with Yoshida's order 6; no delay for these three */
    KD_ENGINE_COUNT
};
enum kd_precision { KD_PRECISION_F32, KD_PRECISION_F64 };

const char *kd_engine_name(
    enum kd_engine engine); /* "closed", "mino-rkn4", "mino-rkn6", "ks-euler", "ks-rk4", "ks-tao6" */
const char *kd_precision_name(enum kd_precision precision); /* "f32", "f64" */

#define KD_STEPS_MAX 2048 /* of any engine; some take fewer */

/* Steps of an engine that is not told how many. */
uint32_t kd_engine_steps(enum kd_engine engine, enum kd_precision precision);

uint32_t kd_engine_most_steps(enum kd_engine engine);
enum kd_status kd_engine_steps_error(enum kd_engine engine, uint32_t steps, struct kd_error *error);

struct kd_accuracy_table;

/* A wish for accuracy, as in accuracy.* of a scene and of a list of rays. */
struct kd_wish {
    int profile;      /* enum kd_profile; -1: none is named */
    int engine;       /* enum kd_engine; -1: whichever suits */
    int precision;    /* enum kd_precision; -1: whichever suits */
    uint32_t steps;   /* a half period, a multiple of 4; 0: of the profile, or the engine's */
    double tolerance; /* relative error of the crossing radii, by the table; INFINITY: none, the profile says */
};

struct kd_setting {
    enum kd_engine engine;
    enum kd_precision precision;
    uint32_t steps; /* closed: 0 */
    double holds;   /* relative error of crossing radii that the table says it holds; NaN: none was asked for */
};

/* The tolerance that 99 of 100 rays by the closed form are within by their own error (docs/accuracy.md); the closed
 * form is used where no row of the table holds a tolerance. */
#define KD_CLOSED_HOLDS 1e-12

#define KD_WISH_NONE { .profile = -1, .engine = -1, .precision = -1, .tolerance = INFINITY }

struct kd_wish kd_wish_of(const struct kd_scene *scene);

/* Whether the wish depends on the device; false: the closed form fulfils it, whatever the device. */
bool kd_wish_needs_device(const struct kd_wish *wish);

/* A tolerance gets the fastest row of the table that holds it, among the engines and precisions allowed, and no
 * steps may be named with it. Otherwise each of engine, precision and steps that is not named comes from the
 * profile; without a profile the closed form and double precision are meant. float64: whether the device has it; a
 * profile that means it gets the closed form where it has not, and so does a tolerance that no row holds. KD_EINVAL
 * at /accuracy/... for what contradicts itself, cannot be held, or is not to be had on this device. table may be
 * NULL if no tolerance is asked for. */
enum kd_status kd_setting_of(const struct kd_wish *wish, const struct kd_accuracy_table *table, bool float64,
                             struct kd_setting *out, struct kd_error *error);

#endif
