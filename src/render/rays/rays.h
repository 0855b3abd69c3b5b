/* Finds the end points of arbitrary rays, by any engine: what POST /v1/rays and `kerrd rays` answer with.
 *
 * A ray is a pair (alpha, beta) in M, labels of the constants of motion (Bardeen 1973): lambda = L/E = -alpha sin i,
 * eta = Q/E^2 = (alpha^2 - a^2) cos^2 i + beta^2, the sign of the arriving photon's p^theta that of beta. It is
 * traced back from an observer at r (INFINITY, or finite: then inwards). Crossings of the equatorial plane are
 * counted from the eye; azimuths are Boyer-Lindquist, source minus observer; delay is t_observed - t_emitted, for an
 * observer at infinity less r_o + 2 ln r_o. g = E_infinity / (-p.u) of gas on circular orbits outside the ISCO,
 * plunging from it inside (Cunningham 1975); a finite observer multiplies by its own nu/E_infinity.
 *
 * Of an observer whose motion is told a ray is a direction in the observer's own frame instead, and g is the energy
 * that it measures over that for the gas. */
#ifndef KD_RENDER_RAYS_RAYS_H
#define KD_RENDER_RAYS_RAYS_H

#include "base/error.h"
#include "physics/spacetime/observer.h"
#include "render/accuracy/engine.h"
#include "render/device/renderer.h"

#include <stddef.h>
#include <stdint.h>

#define KD_RAYS_MAX 1000000
#define KD_RAYS_MAX_ORDERS 16

struct kd_rays_params {
    double spin;            /* |a| < 1 */
    double r;               /* of the observer, INFINITY or outside the horizon */
    double inclination_deg; /* 0 to 180 */
    uint32_t orders;        /* crossings wanted, 1 to KD_RAYS_MAX_ORDERS */
    enum kd_engine engine;
    enum kd_precision precision; /* closed: F64 only */
    uint32_t steps;              /* a half period, a multiple of 4; 0: the engine's default; closed: 0 */
    double tolerance;            /* > 0: rays whose own error is beyond it are followed again, finer; 0: none */
    double holds; /* what the table says that the setting holds, for the answer; 0: no tolerance was asked for */
    int observer; /* 0: rays are labels, of any observer there; else 1 + enum kd_observer: directions, of this one, and
                     its numbers as in kd_observer_motion: */
    double velocity[3], fall_from, fall_energy, fall_momentum;
};

/* Rays by their labels. A list from outside starts inwards; those of a picture from a finite radius may not. */
struct kd_ray_labels {
    const double *alpha_beta; /* 2 n */
    const bool *outward;      /* n: the traced ray starts away from the hole; NULL: none does */
    size_t n;
};

enum kd_ray_fate { KD_RAY_CAPTURED, KD_RAY_ESCAPED, KD_RAY_UNDECIDED };
const char *kd_ray_fate_name(enum kd_ray_fate fate); /* "captured", "escaped", "undecided" */

struct kd_ray_crossing { double r, phi, delay, g; };

struct kd_ray_end {
    enum kd_ray_fate fate;
    uint32_t n_crossings; /* how many of the wanted orders exist outside the horizon */
    double theta, phi;    /* direction of escape, if it escapes: polar angle and azimuth, source minus observer */
    /* Estimated relative error of the worst crossing radius; of the direction, in radians, if there is no crossing. It
     * bounds the true one for 999 of 1000 rays at least. NaN for a ray that gives neither, by every engine. 1 or more:
     * there may be another number of crossings, one next to the horizon or very far out (Mino engines, closed form), or
     * there is another number or fate than the closed form's (Kerr-Schild engines). */
    double error;
    double energy; /* at infinity, per unit that the observer measures; of an observer whose motion is told */
    bool again;    /* followed again by a finer setting, for the tolerance */
};

/* Whether two ends are equal bit for bit, but for what lies between the members. */
bool kd_ray_ends_equal(const struct kd_ray_end *a, const struct kd_ray_end *b);

/* Trace n rays: labels [alpha, beta], or, if params->observer is set, directions [yaw, pitch] in degrees. With a
 * tolerance each that is not within it by its own error, or undecided, is followed again by more steps in double
 * precision, then in closed form: what is beyond it after that no double holds. rays: 2 n numbers. crossings: n *
 * orders records, those of one ray together; unused ones are NaN. ends: n. renderer may be NULL for KD_ENGINE_CLOSED,
 * which any thread may call; other engines belong to the render thread. KD_EINVAL with a pointer such as "/observer/r"
 * or "/rays/17/0" for bad input; KD_EDEVICE if this device lacks the precision. */
enum kd_status kd_rays_trace(struct kd_renderer *renderer, const struct kd_rays_params *params, const double *rays,
                             size_t n, struct kd_ray_crossing *crossings, struct kd_ray_end *ends,
                             kd_progress_fn progress, void *user, struct kd_error *error);

/* Asks for the kernels that these take, for so many rays: for kd_kernels_note. By who has the renderer. */
enum kd_status kd_rays_ask_kernels(struct kd_renderer *renderer, const struct kd_rays_params *params, size_t n);

/* The same as kd_rays_trace of labels that are known to be sound. */
enum kd_status kd_rays_follow(struct kd_renderer *renderer, const struct kd_rays_params *params,
                              const struct kd_ray_labels *rays, struct kd_ray_crossing *crossings,
                              struct kd_ray_end *ends, kd_progress_fn progress, void *user, struct kd_error *error);

#endif
