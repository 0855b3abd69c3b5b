#include "quantity/define.h"

#include "physics/math/angle.h"
#include "physics/spacetime/kerr.h"

#define PARAMETERS(P) \
    KD_PARAMETER_SPIN(P) \
    KD_PARAMETER_HOLE_MORE(P) \
    P(theta_deg, .unit = "degrees", .typed = "90", .least = 0, .most = 180, .help = "polar angle") \
    P(r, .unit = "M", .typed = "10", .least = 1, .most = 1e9, .help = "radius")
#define OUTPUTS(O) \
    O(omega, .unit = "1/M", .help = "angular velocity of an observer of zero angular momentum, -g_tphi/g_phiphi") \
    O(far_field, .unit = "1/M", .help = "2J/r^3 with J = aM") \
    O(omega_least, .unit = "1/M", \
      .help = "smallest angular velocity of any observer at r; positive inside the ergosphere") \
    O(omega_most, .unit = "1/M", \
      .help = "largest angular velocity of any observer at r; this and the smallest are null on the axis") \
    O(horizon_omega, .unit = "1/M", .fixed = true, .help = "angular velocity of the horizon, a/(2 r+ - Q^2)") \
    O(ergosphere, .unit = "M", .fixed = true, .help = "static limit at theta_deg")
KD_QUANTITY_TABLES(PARAMETERS, OUTPUTS)

static const char *const sources[] = {
    "J. M. Bardeen, W. H. Press & S. A. Teukolsky 1972, ApJ 178, 347, eqs 2.3, 2.5",
    "J. Lense & H. Thirring 1918, Phys. Z. 19, 156 (far field)",
    NULL,
};
static const char *const approximations[] = { "far_field is the leading term at large r", NULL };

static enum kd_status evaluate(const double *in, double *out, void *memory, bool fresh, struct kd_error *error)
{
    const struct parameters *p = KD_QUANTITY_IN(in);
    struct outputs *o = KD_QUANTITY_OUT(out);
    const struct kd_hole *hole = KD_QUANTITY_HOLE(p);
    double a = hole->a, r = p->r, u = kd_cos_deg(p->theta_deg), s = kd_sin_deg(p->theta_deg);
    (void)memory;
    if (kd_hole_check(hole, error) || kd_quantity_outside_horizon(hole, r, error))
        return KD_EINVAL;
    if (fresh) {
        o->horizon_omega = a / kd_hole_mass(hole, hole->outer);
        o->ergosphere = kd_kerr_ergosphere(hole, u);
    }
    o->omega = kd_kerr_dragging(hole, r, u);
    o->far_field = 2 * a / (r * r * r);
    bool axis = p->theta_deg == 0 || p->theta_deg == 180;
    double reach = kd_kerr_rotation_reach(hole, r, u, s);
    o->omega_least = axis ? NAN : o->omega - reach;
    o->omega_most = axis ? NAN : o->omega + reach;
    return KD_OK;
}

KD_QUANTITY(frame_dragging, "frame-dragging", "angular velocity of the dragged frame, and its far field", .along = 1,
            .point_us = 1)
