#include "quantity/define.h"

#include "physics/math/angle.h"
#include "physics/orbit/timelike.h"
#include "physics/spacetime/hole.h"

#define PARAMETERS(P) \
    KD_PARAMETER_SPIN(P) \
    KD_PARAMETER_HOLE_MORE(P) \
    P(inclination_deg, .unit = "degrees", .typed = "0", .least = 0, .most = 180, \
      .help = "inclination of the orbit to the equator, defined as in /v1/orbits; more than 90 is retrograde") \
    P(e, .unit = "1", .typed = "0", .least = 0, .most = 0.999999, .help = "eccentricity")
#define OUTPUTS(O) \
    O(p, .unit = "M", .help = "smallest semi-latus rectum of a stable bound orbit") \
    O(r_min, .unit = "M", .help = "radius at which a body on the separatrix whirls: its periapsis p/(1 + e)") \
    O(r_max, .unit = "M", .help = "apoapsis of this orbit, p/(1 - e)") \
    O(circle, .unit = "M", \
      .help = "radius of the photon orbit of this inclination; circular orbits exist above it, and are unstable " \
              "below the separatrix")
KD_QUANTITY_TABLES(PARAMETERS, OUTPUTS)

static const char *const sources[] = {
    "L. C. Stein & N. Warburton 2020, Phys. Rev. D 101, 064007 (the definition: two radial turning points "
    "coincide)",
    "W. Schmidt 2002, Class. Quantum Grav. 19, 2743 (constants of motion from p, e, inclination)",
    NULL,
};
static const char *const approximations[] = { NULL };

static enum kd_status evaluate(const double *in, double *out, void *memory, bool fresh, struct kd_error *error)
{
    const struct parameters *p = KD_QUANTITY_IN(in);
    const struct kd_hole *hole = KD_QUANTITY_HOLE(p);
    struct outputs *o = KD_QUANTITY_OUT(out);
    (void)memory, (void)fresh;
    if (kd_hole_check(hole, error))
        return KD_EINVAL;
    o->p = kd_orbit_separatrix(hole, p->e, kd_cos_deg(p->inclination_deg));
    o->r_min = o->p / (1 + p->e);
    o->r_max = o->p / (1 - p->e);
    o->circle = kd_orbit_least_circle(hole, kd_cos_deg(p->inclination_deg));
    return KD_OK;
}

KD_QUANTITY(separatrix, "separatrix",
            "separatrix of bound orbits: the smallest p of a stable one, by eccentricity and inclination", .along = 1,
            .point_us = 60)
