#include "quantity/define.h"

#include "physics/disk/thin_disk.h"
#include "physics/math/angle.h"
#include "physics/null/ring_image.h"
#include "physics/spacetime/kerr.h"

#define PARAMETERS(P) \
    KD_PARAMETER_SPIN(P) \
    KD_PARAMETER_HOLE_MORE(P) \
    P(inclination_deg, .unit = "degrees", .typed = "60", .least = 0, .most = 180, \
      .help = "polar angle of the observer, at infinity; not within 0.1 of 90") \
    P(r, .unit = "M", .typed = "6", .least = 1, .most = 1e4, .words = "isco", .stands = INFINITY, \
      .help = "radius of the ring") \
    P(phi_deg, .unit = "degrees", .typed = "0:355:72", .least = -360, .most = 720, \
      .help = "azimuth on the ring relative to the observer's: 0 is the near side, at 90 the gas recedes")
#define OUTPUTS(O) \
    O(g, .unit = "1", .help = "redshift factor nu_observed/nu_emitted of the direct image") \
    O(g4, .unit = "1", .help = "g^4: bolometric intensity of the direct image over the emitted intensity") \
    O(alpha, .unit = "M", .help = "position of the direct image, to the right") \
    O(beta, .unit = "M", .help = "position of the direct image, along the projected spin") \
    O(delay, .unit = "M", \
      .help = "time of flight of the direct image's light, minus r_o + 2 ln r_o, with r_o the observer's radius") \
    O(images, .unit = "1", \
      .help = "number of direct images: 1, or 3 or more beyond a caustic, close to edge on; the answer has the first " \
              "from +alpha towards +beta") \
    O(g_1, .unit = "1", .help = "g of the image of order 1, whose light passes the other side of the hole") \
    O(g4_1, .unit = "1", .help = "g^4 of the image of order 1") \
    O(alpha_1, .unit = "M", .help = "position of the image of order 1, to the right") \
    O(beta_1, .unit = "M", .help = "position of the image of order 1, along the projected spin") \
    O(delay_1, .unit = "M", .help = "time of flight of the light of the image of order 1, minus r_o + 2 ln r_o") \
    O(images_1, .unit = "1", .help = "number of images of order 1") \
    O(g_flat, .unit = "1", \
      .help = "sqrt(1 - 3/r)/(1 - v.n), v = sqrt(1/(r - 2)), without lensing or spin; null for r <= 3") \
    O(g4_flat, .unit = "1", .help = "fourth power of g_flat")
KD_QUANTITY_TABLES(PARAMETERS, OUTPUTS)

static const char *const sources[] = {
    "C. T. Cunningham 1975, ApJ 202, 788 (g; inside the ISCO, gas plunges with the E and L of the ISCO)",
    "S. E. Gralla & A. Lupsasca 2020, Phys. Rev. D 101, 044032 (rays in closed form)",
    "J.-P. Luminet 1979, A&A 75, 228 (g_flat, except its straight rays)",
    NULL,
};
static const char *const approximations[] = {
    "g_flat has the speed of a circular orbit for a = 0, and straight rays",
    NULL,
};

struct memory {
    struct kd_ring_image rings[2];
    double r;
};

static double g_of(const struct parameters *p, double r, const struct kd_ring_image_point *at)
{
    const struct kd_hole *hole = KD_QUANTITY_HOLE(p);
    double s = kd_sin_deg(p->inclination_deg), c = kd_cos_deg(p->inclination_deg), lambda = -at->alpha * s;
    double eta = (at->alpha * at->alpha - p->spin * p->spin) * c * c + at->beta * at->beta;
    return r >= kd_kerr_isco(hole) ? kd_disk_redshift(hole, r, lambda)
                                   : kd_disk_redshift_plunging(hole, r, lambda, eta, at->sense > 0);
}

static enum kd_status not_found(const struct memory *m, struct kd_error *error)
{
    return kd_quantity_outside(error, "r", m->r,
                               "; it must be larger, because so close to the horizon no image of the ring is found");
}

static enum kd_status make_rings(const struct parameters *p, struct memory *m, struct kd_error *error)
{
    const struct kd_hole *hole = KD_QUANTITY_HOLE(p);
    /* An observer below the plane is reflected to above the plane, which changes only the sign of beta. */
    double i = p->inclination_deg, up = (i > 90 ? 180 - i : i) * (M_PI / 180);
    if (i > 89.9 && i < 90.1)
        return kd_quantity_outside(
            error, "inclination_deg", i,
            "; it must be 0 to 89.9 or 90.1 to 180, because from the equatorial plane the ring is a line");
    m->r = isinf(p->r) ? kd_kerr_isco(hole) : p->r;
    if (m->r <= hole->outer)
        return kd_quantity_outside(error, "r", m->r, "; it must be more than %.9g M, the horizon", hole->outer);
    bool found =
        kd_ring_image_init(&m->rings[0], hole, up, m->r, 0) && kd_ring_image_init(&m->rings[1], hole, up, m->r, 1);
    return found ? KD_OK : not_found(m, error);
}

static enum kd_status evaluate(const double *in, double *out, void *memory, bool fresh, struct kd_error *error)
{
    const struct parameters *p = KD_QUANTITY_IN(in);
    struct outputs *o = KD_QUANTITY_OUT(out);
    struct memory *m = memory;
    struct kd_ring_image_point at;
    if (fresh && (kd_hole_check(KD_QUANTITY_HOLE(p), error) || make_rings(p, m, error)))
        return KD_EINVAL;
    double phi = p->phi_deg * (M_PI / 180), side = p->inclination_deg > 90 ? -1 : 1, s = kd_sin_deg(p->inclination_deg);
    if (!kd_ring_image_find(&m->rings[0], phi, &at))
        return not_found(m, error);
    o->g = g_of(p, m->r, &at);
    o->alpha = at.alpha, o->beta = side * at.beta, o->delay = at.delay, o->images = at.images;
    if (!kd_ring_image_find(&m->rings[1], phi, &at))
        return not_found(m, error);
    o->g_1 = g_of(p, m->r, &at);
    o->alpha_1 = at.alpha, o->beta_1 = side * at.beta, o->delay_1 = at.delay, o->images_1 = at.images;
    o->g_flat = m->r > 3 ? sqrt(1 - 3 / m->r) / (1 + s * sin(phi) / sqrt(m->r - 2)) : NAN;
    o->g4 = pow(o->g, 4), o->g4_1 = pow(o->g_1, 4), o->g4_flat = pow(o->g_flat, 4);
    return KD_OK;
}

KD_QUANTITY(redshift, "redshift", "redshift factor g and g^4 along a ring of gas, with the ring's lensed images",
            .memory_size = sizeof(struct memory), .along = 1, .point_us = 100, .fresh_us = 3000)
