#include "quantity/define.h"

#include "physics/null/deflection.h"
#include "physics/spacetime/hole.h"

#define PARAMETERS(P) \
    KD_PARAMETER_SPIN(P) \
    KD_PARAMETER_HOLE_MORE(P) \
    P(b, .unit = "M", .typed = "10", .least = 1, .most = 1e12, \
      .help = "impact parameter of light in the equatorial plane, |L|/E")
#define OUTPUTS(O) \
    O(angle, .unit = "radians", \
      .help = "total bending towards +phi, whole turns included; null if captured, b < b_critical") \
    O(angle_retrograde, .unit = "radians", \
      .help = "total bending of light that turns towards -phi, whole turns included; null if captured") \
    O(weak, .unit = "radians", .help = "weak field, 4/b") \
    O(weak_second, .unit = "radians", \
      .help = "weak-field bending towards +phi to second order, 4/b + (15 pi/4 - 4a - 3 pi Q^2/4)/b^2") \
    O(weak_second_retrograde, .unit = "radians", .help = "weak-field bending towards -phi to second order") \
    O(strong, .unit = "radians", \
      .help = "strong-field limit of the bending towards +phi near b_critical, -rate ln(b/b_critical - 1) + offset; " \
              "null if " \
              "captured") \
    O(strong_retrograde, .unit = "radians", \
      .help = "strong-field limit of the bending towards -phi near b_critical_retrograde; null if captured") \
    O(closest, .unit = "M", .help = "closest approach r of the light towards +phi; null if captured") \
    O(closest_retrograde, .unit = "M", .help = "closest approach r of the light towards -phi; null if captured") \
    O(farthest, .unit = "M", \
      .help = "largest radius that light towards +phi reaches if it is emitted inside the photon orbit and falls " \
              "back; null if it escapes, or if no light inside has this b") \
    O(farthest_retrograde, .unit = "M", \
      .help = \
          "largest radius that light towards -phi reaches if it is emitted inside the photon orbit and falls back") \
    O(b_critical, .unit = "M", .fixed = true, .help = "impact parameter of the circular photon orbit towards +phi") \
    O(b_critical_retrograde, .unit = "M", .fixed = true, \
      .help = "impact parameter of the circular photon orbit towards -phi") \
    O(strong_rate, .unit = "1", .fixed = true, .help = "rate of the strong limit, 1 at spin 0") \
    O(strong_offset, .unit = "radians", .fixed = true, .help = "offset of the strong limit")
KD_QUANTITY_TABLES(PARAMETERS, OUTPUTS)

static const char *const sources[] = {
    "C. G. Darwin 1959, Proc. R. Soc. Lond. A 249, 180; S. V. Iyer & E. C. Hioki 2009, arXiv:0907.0352",
    "V. Bozza 2002, Phys. Rev. D 66, 103001 (strong limit)",
    "E. F. Eiroa, G. E. Romero & D. F. Torres 2002, Phys. Rev. D 66, 024010 (a charged hole)",
    NULL,
};
static const char *const approximations[] = {
    "angle is exact; weak, weak_second and strong are limits for comparison",
    NULL,
};

struct memory { struct kd_deflection_strong with, against; };

static double strong(struct kd_deflection_strong limit, double b, double critical)
{
    return b > critical ? limit.offset - limit.rate * log(b / critical - 1) : NAN;
}

static enum kd_status evaluate(const double *in, double *out, void *memory, bool fresh, struct kd_error *error)
{
    const struct parameters *p = KD_QUANTITY_IN(in);
    struct outputs *o = KD_QUANTITY_OUT(out);
    struct memory *m = memory;
    const struct kd_hole *hole = KD_QUANTITY_HOLE(p), *turned = kd_hole_turned(hole, -1);
    double b = p->b;
    if (kd_hole_check(hole, error))
        return KD_EINVAL;
    if (fresh) {
        *m = (struct memory) { kd_deflection_strong(hole), kd_deflection_strong(turned) };
        o->b_critical = kd_deflection_critical(hole), o->b_critical_retrograde = kd_deflection_critical(turned);
        o->strong_rate = m->with.rate, o->strong_offset = m->with.offset;
    }
    o->angle = kd_deflection(hole, b), o->angle_retrograde = kd_deflection(turned, b);
    o->weak = kd_deflection_weak(b);
    o->weak_second = kd_deflection_weak_second(hole, b);
    o->weak_second_retrograde = kd_deflection_weak_second(turned, b);
    o->strong = strong(m->with, b, o->b_critical);
    o->strong_retrograde = strong(m->against, b, o->b_critical_retrograde);
    o->closest = kd_deflection_closest(hole, b), o->closest_retrograde = kd_deflection_closest(turned, b);
    o->farthest = kd_deflection_farthest(hole, b), o->farthest_retrograde = kd_deflection_farthest(turned, b);
    return KD_OK;
}

KD_QUANTITY(deflection, "deflection", "bending of light in the equatorial plane, exact and in its limits",
            .memory_size = sizeof(struct memory), .along = 1, .point_us = 12, .fresh_us = 12)
