#include "quantity/define.h"

#include "physics/angle.h"
#include "physics/kerr.h"
#include "physics/ring_image.h"

#define PARAMETERS(P)                                                                                                  \
    KD_PARAMETER_SPIN(P)                                                                                               \
    P(inclination_deg, .unit = "degrees", .initial = "60", .minimum = 0, .maximum = 180,                               \
      .help = "polar angle of the observer; not within 0.1 of 90")                                                     \
    KD_PARAMETER_OBSERVER(P)                                                                                           \
    P(r, .unit = "M", .initial = "6", .minimum = 1, .maximum = 1e4, .word = "isco", .help = "radius of the ring")      \
    P(order, .unit = "1", .initial = "0", .minimum = 0, .maximum = 1, .whole = true,                                   \
      .help = "of the image: 0 direct, 1 past the other side of the hole")                                             \
    P(angle_deg, .unit = "degrees", .initial = "0:355:72", .minimum = -360, .maximum = 720, .along = true,             \
      .help = "direction of the image plane from its origin, as (cos, cos i sin) of it: even round a ring seen unlensed")
#define OUTPUTS(O)                                                                                                     \
    O(alpha, .unit = "M", .help = "the image on the image plane, to the right; at any distance it labels the constants of motion") \
    O(beta, .unit = "M", .help = "the image on the image plane, along the projected spin; likewise")                   \
    O(right, .unit = "1", .help = "direction in which it is seen at a finite radius, a unit vector: towards +phi; null at infinity") \
    O(up, .unit = "1", .help = "its component up, towards -theta")                                                     \
    O(inwards, .unit = "1", .help = "its component inwards, towards -r")                                               \
    O(phi_deg, .unit = "degrees", .help = "which point of the ring is seen there: its azimuth less the observer's, not reduced to a turn") \
    O(delay, .unit = "M", .help = "time of flight; of an observer at infinity less r_o + 2 ln r_o")
KD_QUANTITY_TABLES(PARAMETERS, OUTPUTS)

static const char *const sources[] = {
    "S. E. Gralla & A. Lupsasca 2020, Phys. Rev. D 101, 044032 (rays in closed form)",
    "J. M. Bardeen, W. H. Press & S. A. Teukolsky 1972, ApJ 178, 347 (frames of observers at a finite radius)",
    NULL,
};
static const char *const approximations[] = { NULL };

struct memory {
    struct kd_ring_image ring;
    struct kd_tetrad frame; /* of an observer at a finite radius */
};

static enum kd_status make_frame(const struct parameters *p, struct memory *m, struct kd_error *error)
{
    const struct kd_vantage at = { p->spin, p->observer_r, kd_cos_deg(p->inclination_deg), kd_sin_deg(p->inclination_deg) };
    const struct kd_observer_motion motion = KD_QUANTITY_MOTION(p);
    if (isinf(at.r))
        return KD_OK;
    if (kd_quantity_observer_exists(&motion, &at, error))
        return KD_EINVAL;
    if (at.r <= kd_kerr_horizon(at.spin))
        return kd_quantity_outside(error, "observer_r", at.r, "not outside the horizon at %.9g M", kd_kerr_horizon(at.spin));
    m->frame = kd_observer_tetrad(&motion, &at);
    return KD_OK;
}

static enum kd_status evaluate(const double *in, double *out, void *memory, bool fresh, struct kd_error *error)
{
    const struct parameters *p = KD_QUANTITY_IN(in);
    struct outputs *o = KD_QUANTITY_OUT(out);
    struct memory *m = memory;
    struct kd_ring_image_point at;
    const double i = p->inclination_deg, r = isinf(p->r) ? kd_kerr_isco(p->spin) : p->r, side = i > 90 ? -1 : 1;
    if (i > 89.9 && i < 90.1)
        return kd_quantity_outside(error, "inclination_deg", i, "where the ring is a line; allowed are 0 to 89.9 and 90.1 to 180");
    if (kd_quantity_outside_horizon(p->spin, r, error) || (fresh && make_frame(p, m, error)))
        return KD_EINVAL;
    if (fresh) /* from below the plane it looks the same but for beta */
        m->ring = kd_ring_image_plain(p->spin, (i > 90 ? 180 - i : i) * (M_PI / 180), p->observer_r, r, (int)p->order);
    if (!kd_ring_image_seen(&m->ring, side * p->angle_deg * (M_PI / 180), &at))
        return kd_quantity_outside(error, "r", r, "too large for this observer, or too near the horizon: its light does not come from "
                                                  "further in; allowed are rings well inside observer_r");
    struct kd_look look = { NAN, NAN, NAN, NAN };
    if (!isinf(p->observer_r)) {
        const struct kd_covector photon = kd_tetrad_outgoing(&m->frame.at, at.alpha, side * at.beta);
        look = kd_tetrad_look(&m->frame, &photon);
    }
    o->alpha = at.alpha, o->beta = side * at.beta, o->right = look.right, o->up = look.up, o->inwards = look.inwards;
    o->phi_deg = at.phi * (180 / M_PI), o->delay = at.delay;
    return KD_OK;
}

KD_QUANTITY(ring_image, "ring-image", "a ring in the equatorial plane as it is seen, direct or past the hole, from any distance",
            .memory_size = sizeof(struct memory), .point_us = 200, .fresh_us = 10)
