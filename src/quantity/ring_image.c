#include "quantity/define.h"

#include "physics/math/angle.h"
#include "physics/null/ring_image.h"
#include "physics/null/ring_view.h"
#include "physics/spacetime/kerr.h"

#define PARAMETERS(P) \
    KD_PARAMETER_SPIN(P) \
    KD_PARAMETER_HOLE_MORE(P) \
    P(inclination_deg, .unit = "degrees", .typed = "60", .least = 0, .most = 180, \
      .help = "polar angle of the observer; not within 0.1 of 90") \
    KD_PARAMETER_OBSERVER(P) \
    P(r, .unit = "M", .typed = "6", .least = 1, .most = 1e4, .words = "isco", .stands = INFINITY, \
      .help = "radius of the ring") \
    P(order, .unit = "1", .typed = "0", .least = 0, .most = 1, .kind = KD_KIND_INT, \
      .help = "order of the image: 0 direct, 1 past the other side of the hole") \
    P(angle_deg, .unit = "degrees", .typed = "0:355:72", .least = -360, .most = 720, \
      .help = "angle psi in the image plane, uniform along an unlensed ring: the direction from the origin is (cos " \
              "psi, cos i sin psi); at a finite radius the origin is the direction -r on the sky of an observer that " \
              "falls from rest at infinity")
#define OUTPUTS(O) \
    O(alpha, .unit = "M", \
      .help = "coordinate on the image plane, to the right; at any distance it labels the constants of motion; null " \
              "where light has no energy at infinity") \
    O(beta, .unit = "M", \
      .help = "coordinate on the image plane, along the projected spin; null where light has no energy at infinity") \
    KD_RESULTS_DIRECTION(O) \
    O(phi_deg, .unit = "degrees", \
      .help = "azimuth of the visible point of the ring relative to the observer's, with whole turns; null for an " \
              "observer inside the horizon, and for light whose energy at infinity is not positive") \
    O(delay, .unit = "M", \
      .help = "time of flight; for an observer at infinity minus r_o + 2 ln r_o; null where phi_deg is null")
KD_QUANTITY_TABLES(PARAMETERS, OUTPUTS)

static const char *const sources[] = {
    "S. E. Gralla & A. Lupsasca 2020, Phys. Rev. D 101, 044032 (rays in closed form)",
    "B. Carter 1968, Phys. Rev. 174, 1559 (rays of observers at a finite radius, traced by Taylor series)",
    "J. M. Bardeen, W. H. Press & S. A. Teukolsky 1972, ApJ 178, 347; C. Doran 2000, Phys. Rev. D 61, 067503 (frames "
    "of observers)",
    NULL,
};
static const char *const approximations[] = { NULL };

struct memory {
    struct kd_ring_image far; /* image for an observer at infinity */
    struct kd_ring_view near; /* image for an observer at a finite radius */
};

static enum kd_status make(const struct parameters *p, double r, struct memory *m, struct kd_error *error)
{
    const double i = p->inclination_deg;
    const struct kd_vantage at = { kd_hole_in(p), p->observer_r, kd_cos_deg(i), kd_sin_deg(i) };
    const struct kd_observer_motion motion = KD_QUANTITY_MOTION(p);
    /* for an observer below the plane the ring looks the same, except that beta has the other sign */
    if (isinf(at.r)) {
        m->far = kd_ring_image_plain(KD_QUANTITY_HOLE(p), (i > 90 ? 180 - i : i) * (M_PI / 180), r, (int)p->order);
        return KD_OK;
    }
    if (kd_quantity_observer_exists(&motion, &at, error))
        return KD_EINVAL;
    m->near = kd_ring_view_of(&motion, &at, r, (int)p->order);
    return KD_OK;
}

static bool see_far(const struct parameters *p, const struct kd_ring_image *ring, struct outputs *o)
{
    const double side = p->inclination_deg > 90 ? -1 : 1;
    struct kd_ring_image_point at;
    const bool found = kd_ring_image_seen(ring, side * p->angle_deg * (M_PI / 180), &at);
    *o = (struct outputs) { at.alpha, side * at.beta, NAN, NAN, NAN, at.phi * (180 / M_PI), at.delay };
    return found;
}

static bool see_near(const struct parameters *p, const struct kd_ring_view *ring, struct outputs *o)
{
    struct kd_ring_view_point at;
    const bool found = kd_ring_view_seen(ring, p->angle_deg * (M_PI / 180), &at);
    *o = (struct outputs) { at.alpha, at.beta, at.look.right, at.look.up, at.look.inwards, at.phi * (180 / M_PI),
                            at.delay };
    return found;
}

static enum kd_status evaluate(const double *in, double *out, void *memory, bool fresh, struct kd_error *error)
{
    const struct parameters *p = KD_QUANTITY_IN(in);
    const struct kd_hole *hole = KD_QUANTITY_HOLE(p);
    struct outputs *o = KD_QUANTITY_OUT(out);
    struct memory *m = memory;
    const double i = p->inclination_deg, r = isinf(p->r) ? kd_kerr_isco(hole) : p->r;
    if (kd_hole_check(hole, error))
        return KD_EINVAL;
    if (i > 89.9 && i < 90.1)
        return kd_quantity_outside(
            error, "inclination_deg", i,
            "; it must be 0 to 89.9 or 90.1 to 180, because from the equatorial plane the ring is a line");
    if (kd_quantity_outside_horizon(hole, r, error) || (fresh && make(p, r, m, error)))
        return KD_EINVAL;
    if (!(isinf(p->observer_r) ? see_far(p, &m->far, o) : see_near(p, &m->near, o)))
        return kd_quantity_outside(
            error, "r", r, "; it must be larger, because so close to the horizon no image of the ring is found");
    return KD_OK;
}

KD_QUANTITY(ring_image, "ring-image",
            "images of a ring in the equatorial plane, direct or past the hole, from any distance",
            .memory_size = sizeof(struct memory), .along = 1, .point_us = 300, .fresh_us = 10)
