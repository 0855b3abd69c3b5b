#include "physics/spacetime/hole.h"
#include "quantity/define.h"

#include "physics/spacetime/potential.h"

#define PARAMETERS(P) \
    P(spin, .unit = "M", .typed = "0", .least = -1, .most = 1, .open = KD_OPEN, .help = "spin parameter a") \
    KD_PARAMETER_HOLE_MORE(P) \
    P(l, .unit = "M", .typed = "4", .least = -1e6, .most = 1e6, \
      .help = "angular momentum, positive towards +phi: per unit mass for matter, and of the photon for v_light") \
    P(r, .unit = "M", .typed = "2:30:281", .least = 1, .most = 1e9, .help = "radius")
#define OUTPUTS(O) \
    O(v_matter, .unit = "1", .help = "smallest specific energy of matter with L at r") \
    O(v_light, .unit = "1", .help = "smallest energy of light with L at r") \
    O(newton, .unit = "1", .help = "1 - 1/r + L^2/(2 r^2), the Newtonian counterpart of v_matter") \
    O(r_max_matter, .unit = "M", .fixed = true, .help = "unstable circular orbit of matter with L; null if none") \
    O(v_max_matter, .unit = "1", .fixed = true, .help = "v_matter there") \
    O(r_min_matter, .unit = "M", .fixed = true, .help = "stable circular orbit of matter with L; null if none") \
    O(v_min_matter, .unit = "1", .fixed = true, .help = "v_matter there") \
    O(r_max_light, .unit = "M", .fixed = true, .help = "circular photon orbit with the sense of L; null for L = 0") \
    O(v_max_light, .unit = "1", .fixed = true, .help = "v_light there, |L|/b_c")
KD_QUANTITY_TABLES(PARAMETERS, OUTPUTS)

static const char *const sources[] = {
    "J. M. Bardeen, W. H. Press & S. A. Teukolsky 1972, ApJ 178, 347, eqs 2.9-2.13",
    "C. W. Misner, K. S. Thorne & J. A. Wheeler 1973, Gravitation, sect. 25.5 and 33.5",
    NULL,
};
static const char *const approximations[] = {
    "newton is the sum of rest mass, Newtonian potential and centrifugal potential", NULL
};

static void fill_extrema(const struct parameters *p, struct outputs *o)
{
    const struct kd_hole *hole = KD_QUANTITY_HOLE(p);
    struct kd_potential_extrema matter = kd_potential_of_matter(hole, p->l), light = kd_potential_of_light(hole, p->l);
    o->r_max_matter = matter.r_max;
    o->v_max_matter = matter.v_max;
    o->r_min_matter = matter.r_min;
    o->v_min_matter = matter.v_min;
    o->r_max_light = light.r_max;
    o->v_max_light = light.v_max;
}

static enum kd_status evaluate(const double *in, double *out, void *memory, bool fresh, struct kd_error *error)
{
    const struct parameters *p = KD_QUANTITY_IN(in);
    const struct kd_hole *hole = KD_QUANTITY_HOLE(p);
    struct outputs *o = KD_QUANTITY_OUT(out);
    (void)memory;
    if (kd_hole_check(hole, error) || kd_quantity_outside_horizon(hole, p->r, error))
        return KD_EINVAL;
    if (fresh)
        fill_extrema(p, o);
    o->v_matter = kd_potential(hole, p->l, 1, p->r);
    o->v_light = kd_potential(hole, p->l, 0, p->r);
    o->newton = 1 - 1 / p->r + p->l * p->l / (2 * p->r * p->r);
    return KD_OK;
}

KD_QUANTITY(potential, "potential",
            "effective potential of light and of matter in the equatorial plane, with its extrema", .along = 1,
            .point_us = 1, .fresh_us = 5)
