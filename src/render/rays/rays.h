/* Traces arbitrary rays to their end points by any engine, for POST /v1/rays and `kerrd rays`.
 *
 * A ray is a pair (alpha, beta) in M, labels of the constants of motion (Bardeen 1973): lambda = L/E = -alpha sin i,
 * eta = Q/E^2 = (alpha^2 - a^2) cos^2 i + beta^2; the arriving photon's p^theta has the sign of beta. The ray is
 * traced back from an observer at r, which is INFINITY or finite. From a finite r the ray starts inwards. Crossings
 * of the equatorial plane are counted from the observer. Azimuths are Boyer-Lindquist, source minus observer. delay
 * is t_observed - t_emitted, minus r_o + 2 ln r_o for an observer at infinity. g = E_infinity / (-p.u), where u is
 * the velocity of gas: on circular orbits outside the ISCO, plunging from the ISCO inside it (Cunningham 1975). For
 * an observer at a finite radius, this g is multiplied by nu/E_infinity, where nu is the measured frequency.
 *
 * If the observer's motion is given, a ray is instead a direction in the observer's frame, and g is the measured
 * energy divided by the energy in the gas's frame. */
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
    double r;               /* the observer's radius: INFINITY, or outside the horizon */
    double inclination_deg; /* 0 to 180 */
    uint32_t orders;        /* number of requested crossings, 1 to KD_RAYS_MAX_ORDERS */
    enum kd_engine engine;
    enum kd_precision precision; /* always F64 for the closed form */
    /* steps per half period, a multiple of 4; 0: the engine's default. Always 0 for the closed form */
    uint32_t steps;
    /* > 0: rays whose own error exceeds this are traced again more finely; 0: no ray is traced again */
    double tolerance;
    double holds; /* the tolerance that the setting meets according to the table, for the answer; 0: no tolerance was
                     requested */
    /* 0: rays are labels, for any observer at this place. Otherwise 1 + enum kd_observer: rays are directions in
     * this observer's frame, with the parameters of kd_observer_motion: */
    int observer;
    double velocity[3], fall_from, fall_energy, fall_momentum;
    KD_HOLE_MORE_MEMBERS
};

static inline struct kd_hole kd_rays_hole(const struct kd_rays_params *p) { return kd_hole_in(p); }

/* Rays by their labels. Rays of a request start inwards; those of a picture from a finite radius may start outwards. */
struct kd_ray_labels {
    const double *alpha_beta; /* 2 n */
    /* n values, true if the traced ray starts away from the hole; NULL: all rays start inwards */
    const bool *outward;
    size_t n;
};

enum kd_ray_fate { KD_RAY_CAPTURED, KD_RAY_ESCAPED, KD_RAY_UNDECIDED };
const char *kd_ray_fate_name(enum kd_ray_fate fate); /* "captured", "escaped", "undecided" */

struct kd_ray_crossing { double r, phi, delay, g; };

struct kd_ray_end {
    enum kd_ray_fate fate;
    uint32_t n_crossings; /* number of the requested orders that exist outside the horizon */
    double theta, phi;    /* direction of an escaping ray: polar angle and azimuth, source minus observer */
    /* Estimated relative error of the worst crossing radius; for a ray without a crossing, the error of its direction
     * in radians. It is an upper bound for at least 999 of 1000 rays. If a ray has neither a crossing nor a
     * direction, it is NaN with every engine. The meaning of a value of 1 or more depends on the engine. Mino engines
     * and closed form: next to the horizon or very far out, the number of crossings may be wrong by one. Kerr-Schild
     * engines: the number of crossings or the fate differs from the closed form's. */
    double error;
    /* energy at infinity, in units of the energy that the observer measures; only if the observer's motion is
     * given */
    double energy;
    bool again; /* true if the ray was traced again by a finer setting, to meet the tolerance */
};

/* True if two ends are equal bit for bit, ignoring padding. */
bool kd_ray_ends_equal(const struct kd_ray_end *a, const struct kd_ray_end *b);

/* Traces n rays: labels [alpha, beta], or directions [yaw, pitch] in degrees if params->observer is set. With a
 * tolerance, a ray is traced again if it is undecided or if its own error estimate exceeds the tolerance: first with
 * more steps in double precision, then in closed form. If a ray still exceeds the tolerance then, double precision
 * cannot meet it. rays: 2 n numbers. crossings: n * orders records, with those of one ray adjacent; unused records
 * are NaN. ends: n records. renderer may be NULL for KD_ENGINE_CLOSED, which any thread may call; other engines
 * belong to the render thread. Returns KD_EINVAL with a pointer such as "/observer/r" or "/rays/17/0" for bad input;
 * KD_EDEVICE if this device lacks the precision. */
enum kd_status kd_rays_trace(struct kd_renderer *renderer, const struct kd_rays_params *params, const double *rays,
                             size_t n, struct kd_ray_crossing *crossings, struct kd_ray_end *ends,
                             kd_progress_fn progress, void *user, struct kd_error *error);

/* Requests the kernels needed for n rays, for kd_kernels_note. Only the thread that owns the renderer may call this. */
enum kd_status kd_rays_ask_kernels(struct kd_renderer *renderer, const struct kd_rays_params *params, size_t n);

/* kd_rays_trace for labels that are known to be valid. */
enum kd_status kd_rays_follow(struct kd_renderer *renderer, const struct kd_rays_params *params,
                              const struct kd_ray_labels *rays, struct kd_ray_crossing *crossings,
                              struct kd_ray_end *ends, kd_progress_fn progress, void *user, struct kd_error *error);

#endif
