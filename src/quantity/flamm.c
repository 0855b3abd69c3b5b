#include "quantity/define.h"

#include "physics/math/angle.h"
#include "physics/spacetime/embedding.h"
#include "physics/spacetime/kerr.h"

#define PARAMETERS(P) \
    P(spin, .unit = "M", .typed = "0", .least = -1, .most = 1, .open = KD_OPEN, .help = "spin parameter a") \
    KD_PARAMETER_HOLE_MORE(P) \
    P(r, .unit = "M", .typed = "2:20:73", .least = 1, .most = 1e9, \
      .help = "Boyer-Lindquist radius, at or outside the horizon") \
    P(phi_deg, .unit = "degrees", .typed = "0", .least = -360, .most = 360, \
      .help = "azimuth; ranges of azimuth and r make a mesh")
#define OUTPUTS(O) \
    O(x, .unit = "M", .help = "x of the embedded surface: its radius times cos(phi)") \
    O(y, .unit = "M", .help = "y of the embedded surface: its radius times sin(phi)") \
    O(z, .unit = "M", .help = "z of the embedded surface: height over the horizon's circle") \
    O(radius, .unit = "M", .help = "circumference over 2 pi, sqrt(r^2 + a^2 + a^2 (2r - Q^2)/r^2)") \
    O(proper_distance, .unit = "M", .help = "proper distance from the horizon along r") \
    O(flamm, .unit = "M", .help = "Flamm's paraboloid, sqrt(8 (r - 2)), which is z for a = Q = 0; null for r < 2") \
    O(horizon, .unit = "M", .fixed = true, .help = "radius at which the surface begins")
KD_QUANTITY_TABLES(PARAMETERS, OUTPUTS)

static const char *const sources[] = {
    "L. Flamm 1916, Phys. Z. 17, 448; C. W. Misner, K. S. Thorne & J. A. Wheeler 1973, Gravitation, eq. 23.34b",
    "R. H. Boyer & R. W. Lindquist 1967, J. Math. Phys. 8, 265 (the metric of the equatorial plane)",
    NULL,
};
static const char *const approximations[] = { NULL };

struct memory { double r, z; };

static enum kd_status evaluate(const double *in, double *out, void *memory, bool fresh, struct kd_error *error)
{
    const struct parameters *p = KD_QUANTITY_IN(in);
    const struct kd_hole *hole = KD_QUANTITY_HOLE(p);
    struct outputs *o = KD_QUANTITY_OUT(out);
    struct memory *m = memory;
    if (kd_hole_check(hole, error) || kd_quantity_outside_horizon(hole, p->r, error))
        return KD_EINVAL;
    if (fresh || m->r != p->r)
        *m = (struct memory) { p->r, kd_embedding_height(hole, p->r) };
    o->horizon = hole->outer;
    o->radius = kd_embedding_radius(hole, p->r);
    o->x = o->radius * kd_cos_deg(p->phi_deg);
    o->y = o->radius * kd_sin_deg(p->phi_deg);
    o->z = m->z;
    o->proper_distance = kd_embedding_distance(hole, p->r);
    o->flamm = p->r >= 2 ? sqrt(8 * (p->r - 2)) : NAN;
    return KD_OK;
}

KD_QUANTITY(flamm, "flamm", "the equatorial plane embedded in flat space: Flamm's paraboloid, and Kerr's",
            .memory_size = sizeof(struct memory), .along = 2, .point_us = 4)
