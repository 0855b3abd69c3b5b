#include "quantity/define.h"

#include "physics/math/angle.h"
#include "physics/null/sky_view.h"

#define PARAMETERS(P) \
    KD_PARAMETER_SPIN(P) \
    KD_PARAMETER_HOLE_MORE(P) \
    P(inclination_deg, .unit = "degrees", .typed = "60", .least = 0, .most = 180, \
      .help = "polar angle of the observer") \
    KD_PARAMETER_OBSERVER(P) \
    P(yaw_deg, .unit = "degrees", .typed = "0:180:37", .least = -360, .most = 360, \
      .help = "direction of g: angle to the right of the hole, as camera.yaw_deg; 180 is away from the hole") \
    P(pitch_deg, .unit = "degrees", .typed = "0", .least = -90, .most = 90, \
      .help = "direction of g: angle upwards, as camera.pitch_deg")
#define OUTPUTS(O) \
    O(g, .unit = "1", \
      .help = \
          "measured frequency of starlight from that direction over its frequency at infinity; null in the dark disk") \
    O(g_ahead, .unit = "1", .fixed = true, .help = "g from straight ahead, towards the hole; null in the dark disk") \
    O(g_behind, .unit = "1", .fixed = true, \
      .help = "g from straight behind, away from the hole; null in the dark disk") \
    O(g_above, .unit = "1", .fixed = true, .help = "g from overhead, towards -theta; null in the dark disk") \
    O(g_below, .unit = "1", .fixed = true, .help = "towards +theta") \
    O(g_right, .unit = "1", .fixed = true, .help = "towards +phi") \
    O(g_left, .unit = "1", .fixed = true, .help = "towards -phi") \
    O(g_least, .unit = "1", .fixed = true, .help = "smallest g over the visible sky") \
    O(g_greatest, .unit = "1", .fixed = true, .help = "largest g over the visible sky") \
    O(dark_radius_deg, .unit = "degrees", .fixed = true, \
      .help = "angular radius of a round disk with the solid angle of the black disk") \
    O(dark_sr, .unit = "sr", .fixed = true, .help = "solid angle of the black disk") \
    O(dark_share, .unit = "1", .fixed = true, .help = "share of all directions in the black disk")
KD_QUANTITY_TABLES(PARAMETERS, OUTPUTS)

static const char *const sources[] = {
    "J. M. Bardeen, W. H. Press & S. A. Teukolsky 1972, ApJ 178, 347; C. Doran 2000, Phys. Rev. D 61, 067503 (frames "
    "of observers)",
    "J. M. Bardeen 1973, in Black Holes (Les Houches), p. 215 (the edge of the black disk)",
    NULL,
};
static const char *const approximations[] = { NULL };

struct memory { struct kd_sky_view view; };

/* At infinity the sky is undistorted, and the hole is a point. */
static void far_away(struct outputs *o) { *o = (struct outputs) { 1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0 }; }

static enum kd_status look_around(const struct parameters *p, struct kd_sky_view *view, struct outputs *o,
                                  struct kd_error *error)
{
    const struct kd_vantage at = { kd_hole_in(p), p->observer_r, kd_cos_deg(p->inclination_deg),
                                   kd_sin_deg(p->inclination_deg) };
    const struct kd_critical_observer observer = {
        .hole = at.hole,
        .radius = at.r,
        .cos_theta = at.u,
        .sin_theta = at.s,
        .motion = KD_QUANTITY_MOTION(p),
    };
    if (kd_quantity_observer_exists(&observer.motion, &at, error))
        return KD_EINVAL;
    *view = kd_sky_view_of(&observer);
    if (view->status)
        return kd_error_field(error, "/observer_r", "there is no critical curve for this observer");
    o->g_ahead = kd_sky_view_shift(view, (double[]) { 0, 0, 1 });
    o->g_behind = kd_sky_view_shift(view, (double[]) { 0, 0, -1 });
    o->g_above = kd_sky_view_shift(view, (double[]) { 0, 1, 0 });
    o->g_below = kd_sky_view_shift(view, (double[]) { 0, -1, 0 });
    o->g_right = kd_sky_view_shift(view, (double[]) { 1, 0, 0 });
    o->g_left = kd_sky_view_shift(view, (double[]) { -1, 0, 0 });
    o->g_least = view->least;
    o->g_greatest = view->greatest;
    o->dark_sr = view->dark;
    o->dark_share = view->dark / (4 * M_PI);
    o->dark_radius_deg = 2 * asin(sqrt(fmin(1, o->dark_share))) * (180 / M_PI);
    return KD_OK;
}

static enum kd_status evaluate(const double *in, double *out, void *memory, bool fresh, struct kd_error *error)
{
    const struct parameters *p = KD_QUANTITY_IN(in);
    struct outputs *o = KD_QUANTITY_OUT(out);
    struct kd_sky_view *view = &((struct memory *)memory)->view;
    if (kd_hole_check(KD_QUANTITY_HOLE(p), error))
        return KD_EINVAL;
    if (isinf(p->observer_r)) {
        far_away(o);
        return KD_OK;
    }
    if (fresh && look_around(p, view, o, error))
        return KD_EINVAL;
    const double up = kd_sin_deg(p->pitch_deg), level = kd_cos_deg(p->pitch_deg);
    o->g = kd_sky_view_shift(view, (double[]) { level * kd_sin_deg(p->yaw_deg), up, level * kd_cos_deg(p->yaw_deg) });
    return KD_OK;
}

KD_QUANTITY(sky, "sky", "the redshift of the sky for any observer, and the size of the hole's black disk",
            .memory_size = sizeof(struct memory), .along = 2, .point_us = 8, .fresh_us = 2500)
