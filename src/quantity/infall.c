#include "quantity/define.h"

#include "physics/math/angle.h"
#include "physics/spacetime/infall.h"
#include "physics/spacetime/kerr.h"
#include "physics/spacetime/scale.h"

#define PARAMETERS(P) \
    P(spin, .unit = "M", .typed = "0", .least = -1, .most = 1, .open = KD_OPEN, .help = "spin parameter a") \
    KD_PARAMETER_HOLE_MORE(P) \
    P(inclination_deg, .unit = "degrees", .typed = "90", .least = 0, .most = 180, \
      .help = "polar angle of the falling observer") \
    P(infall_from, .unit = "M", .typed = "infinity", .least = 1, .most = 1e7, .words = "infinity", .stands = INFINITY, \
      .help = "radius at which the fall begins, at rest except for the angular momentum") \
    P(infall_energy, .unit = "1", .typed = "rest", .least = -100, .most = 1e3, .words = "rest", .stands = INFINITY, \
      .help = "energy per mass of the falling observer; rest: the energy that follows from infall_from") \
    P(infall_momentum, .unit = "M", .typed = "0", .least = -1e4, .most = 1e4, \
      .help = "angular momentum per mass of the falling observer") \
    KD_PARAMETER_MASS(P) \
    P(r, .unit = "M", .typed = "0.2:20:100", .least = 0.001, .most = 1e7, .help = "radius of the falling observer")
#define OUTPUTS(O) \
    O(proper_time_to_horizon, .unit = "M", .help = "proper time from r to the outer horizon; null inside it") \
    O(proper_time_to_end, .unit = "M", \
      .help = \
          "proper time from r to the end of the model: the inner horizon, or without spin and charge the singularity") \
    O(proper_time_to_horizon_s, .unit = "s", \
      .help = "proper time from r to the outer horizon, in seconds; null inside it") \
    O(proper_time_to_end_s, .unit = "s", .help = "proper time from r to the end of the model, in seconds") \
    O(velocity, .unit = "1", \
      .help = "velocity towards the hole relative to the observer of zero angular momentum, in units of c; null " \
              "inside the horizon") \
    O(g_behind, .unit = "1", \
      .help = "frequency of starlight from straight behind as the falling observer measures it, over its frequency " \
              "at infinity") \
    O(azimuth_to_end_deg, .unit = "degrees", \
      .help = "change of the ingoing Kerr-Schild azimuth until the end of the model; camera.azimuth_deg is such an " \
              "azimuth") \
    O(time_to_end, .unit = "M", \
      .help = "coordinate time until the end of the model, in ingoing Kerr-Schild coordinates, which are regular at " \
              "the outer horizon") \
    O(energy, .unit = "1", .fixed = true, .help = "per mass") \
    O(end, .unit = "M", .fixed = true, .help = "radius where the model ends")
KD_QUANTITY_TABLES(PARAMETERS, OUTPUTS)

static const char *const sources[] = {
    "C. Doran 2000, Phys. Rev. D 61, 067503; J. Natario 2009, Gen. Rel. Grav. 41, 2579 (from rest at infinity)",
    "B. Carter 1968, Phys. Rev. 174, 1559 (the motion)",
    NULL,
};
static const char *const approximations[] = { NULL };

static enum kd_status check(const struct kd_observer_motion *motion, const struct kd_vantage *at,
                            struct kd_error *error)
{
    const double end = at->hole.inner;
    if (!(at->r > end))
        return kd_quantity_outside(error, "r", at->r, "; it must be more than %.9g M, where the model ends", end);
    if (kd_quantity_observer_exists(motion, at, error))
        return KD_EINVAL;
    if (!kd_infall_is_level(motion, at))
        return kd_quantity_outside(error, "inclination_deg", atan2(at->s, at->u) * (180 / M_PI),
                                   "; with spin it must be 0, 90 or 180, or the fall must begin at rest at infinity, "
                                   "because any other fall changes its latitude");
    return KD_OK;
}

static enum kd_status evaluate(const double *in, double *out, void *memory, bool fresh, struct kd_error *error)
{
    (void)memory, (void)fresh;
    const struct parameters *p = KD_QUANTITY_IN(in);
    struct outputs *o = KD_QUANTITY_OUT(out);
    const struct kd_vantage at = { kd_hole_in(p), p->r, kd_cos_deg(p->inclination_deg),
                                   kd_sin_deg(p->inclination_deg) };
    const struct kd_observer_motion motion = {
        .observer = KD_OBSERVER_INFALL,
        .fall_from = p->infall_from,
        .fall_energy = p->infall_energy,
        .fall_momentum = p->infall_momentum,
    };
    const double horizon = at.hole.outer, second = kd_scale_seconds(p->mass_msun);
    if (kd_hole_check(&at.hole, error) || check(&motion, &at, error))
        return KD_EINVAL;
    const struct kd_tetrad frame = kd_observer_tetrad(&motion, &at);
    bool within = at.r <= horizon;
    o->end = at.hole.inner;
    o->energy = kd_observer_energy(&motion, &at);
    o->proper_time_to_end = kd_infall_proper_time(&motion, &at, o->end);
    const struct kd_infall_way way = kd_infall_way(&motion, &at, o->end);
    o->azimuth_to_end_deg = way.azimuth * (180 / M_PI);
    o->time_to_end = way.time;
    o->proper_time_to_horizon = within ? NAN : kd_infall_proper_time(&motion, &at, horizon);
    o->proper_time_to_end_s = second * o->proper_time_to_end;
    o->proper_time_to_horizon_s = second * o->proper_time_to_horizon;
    o->g_behind = 1 / (frame.t.energy - frame.r.energy); /* redshift of light that flies inwards along -e_r */
    o->velocity = NAN;
    if (!within) {
        const struct kd_observer_motion zamo = kd_observer_motion_of(KD_OBSERVER_ZAMO);
        const struct kd_tetrad rest = kd_observer_tetrad(&zamo, &at);
        double gamma = (frame.t.energy - kd_kerr_dragging(&at.hole, at.r, at.u) * motion.fall_momentum) / rest.t.energy;
        o->velocity = -frame.t.radial / rest.r.radial / gamma;
    }
    return KD_OK;
}

KD_QUANTITY(infall, "infall", "free fall into the hole: proper time to the horizon and to the end", .along = 1,
            .point_us = 60)
