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
    /* closed form with elliptic functions: on the CPU in double precision (the reference), or on the device in single
     * precision for rays outside the photon orbits */
    KD_ENGINE_CLOSED,
    KD_ENGINE_MINO_RKN4, /* Mino time on the device: Nystroem's method of order 4 */
    KD_ENGINE_MINO_RKN6, /* Mino time on the device: Albrecht's Nystroem method of order 6 */
    KD_ENGINE_KS_EULER,  /* the Kerr-Schild Hamiltonian on the device: symplectic Euler */
    KD_ENGINE_KS_RK4,    /* the Kerr-Schild Hamiltonian on the device: classical Runge-Kutta */
    /* the Kerr-Schild Hamiltonian in Tao's extended phase space, on the device: Yoshida's method of order 6. None of
       the three Kerr-Schild engines computes the delay */
    KD_ENGINE_KS_TAO6,
    KD_ENGINE_COUNT
};
enum kd_precision { KD_PRECISION_F32, KD_PRECISION_F64 };

const char *kd_engine_name(
    enum kd_engine engine); /* returns "closed", "mino-rkn4", "mino-rkn6", "ks-euler", "ks-rk4" or "ks-tao6" */
const char *kd_precision_name(enum kd_precision precision); /* "f32", "f64" */

#define KD_STEPS_MAX 2048 /* largest number of steps of any engine; some engines have a lower limit */

/* Default number of steps of an engine. */
uint32_t kd_engine_steps(enum kd_engine engine, enum kd_precision precision);

uint32_t kd_engine_most_steps(enum kd_engine engine);
enum kd_status kd_engine_steps_error(enum kd_engine engine, uint32_t steps, struct kd_error *error);

struct kd_accuracy_table;

/* A request for accuracy, as given by accuracy.* of a scene or of a list of rays. */
struct kd_accuracy_request {
    int profile;    /* value of enum kd_profile; -1: the request names no profile */
    int engine;     /* value of enum kd_engine; -1: any engine */
    int precision;  /* value of enum kd_precision; -1: any precision */
    uint32_t steps; /* number of steps per half period, a multiple of 4; 0: the profile or the engine sets it */
    /* largest permitted relative error of the crossing radii, as the accuracy table lists it; INFINITY: the request
     * names no tolerance, so the profile decides */
    double tolerance;
};

struct kd_setting {
    enum kd_engine engine;
    enum kd_precision precision;
    uint32_t steps; /* number of steps; 0 for the closed form */
    /* relative error of the crossing radii that the table lists for this setting; NaN: no tolerance is requested */
    double holds;
};

/* Tolerance that the closed form meets: for 99 of 100 rays its own error estimate is smaller (docs/accuracy.md). The
 * closed form is used if no row of the table meets the requested tolerance. */
#define KD_CLOSED_HOLDS 1e-12

#define KD_WISH_NONE { .profile = -1, .engine = -1, .precision = -1, .tolerance = INFINITY }

struct kd_accuracy_request kd_accuracy_request_of(const struct kd_scene *scene);

/* True if the request needs a device. If not, the closed form on the CPU serves the request. */
bool kd_accuracy_request_needs_device(const struct kd_accuracy_request *asked_accuracy);

/* Resolves a request to a setting. Without a tolerance, the profile supplies the engine, the precision and the number
 * of steps, unless the request names them. If there is no profile either, the setting is the closed form in double
 * precision. With a tolerance, the function picks the fastest row of the table that meets the tolerance, among the
 * permitted engines and precisions. The request must then not name steps. The closed form is used in two cases: no
 * row meets the tolerance, or a profile needs double precision and the device lacks it. float64: true if the device
 * has double precision. Returns KD_EINVAL at /accuracy/... for a contradiction, a tolerance that cannot be met, or a
 * setting that this device does not support. table may be NULL if no tolerance is requested. */
enum kd_status kd_setting_of(const struct kd_accuracy_request *asked_accuracy, const struct kd_accuracy_table *table,
                             bool float64, struct kd_setting *out, struct kd_error *error);

#endif
