#include "scene/aim.h"

#include "physics/math/angle.h"
#include "physics/spacetime/kerr.h"

#include <math.h>

/* At a horizon, E, L and Delta p_r are no longer independent (tetrad.h). A camera nearer to the horizon than this
 * distance, in M, is therefore treated as if it were at this distance. */
static const double BESIDE = 1e-7;

static struct kd_vantage beside_horizon(struct kd_vantage at)
{
    const double horizon = at.hole.outer;
    if (fabs(at.r - horizon) < BESIDE)
        at.r = horizon + BESIDE;
    return at;
}

static void free_look(const struct kd_scene *scene, double look[3])
{
    const double yaw = scene->camera.yaw_deg, pitch = scene->camera.pitch_deg;
    look[0] = kd_cos_deg(pitch) * kd_sin_deg(yaw);
    look[1] = kd_sin_deg(pitch);
    look[2] = kd_cos_deg(pitch) * kd_cos_deg(yaw);
}

static struct kd_covector straight_out(const struct kd_vantage *at)
{
    const double a = at->hole.a;
    return (struct kd_covector) { 1, a * at->s, 0, at->r * at->r + a * a * at->u * at->u };
}

/* Makes the photon that arrives from a direction. The photon moves in the opposite direction. */
static bool arriving(const struct kd_aim *aim, const struct kd_scene *scene, const struct kd_vantage *at,
                     struct kd_covector *out)
{
    const bool falls = scene->camera.observer == KD_OBSERVER_INFALL;
    const struct kd_observer_motion by = kd_observer_motion_of(falls ? KD_OBSERVER_INFALL : KD_OBSERVER_ZAMO);
    const struct kd_tetrad frame = kd_observer_tetrad(&by, at);
    const double u = kd_cos_deg(aim->theta_deg), s = kd_sin_deg(aim->theta_deg),
                 phi = aim->phi_deg - scene->camera.azimuth_deg;
    const double far = isinf(aim->r) ? 1 : aim->r, here = isinf(aim->r) ? 0 : at->r;
    const double x = far * s * kd_cos_deg(phi) - here * at->s, y = far * s * kd_sin_deg(phi),
                 z = far * u - here * at->u, length = sqrt(x * x + y * y + z * z);
    const double m[4] = { 1, -(at->s * x + at->u * z) / length, -(at->u * x - at->s * z) / length, -y / length };
    *out = kd_tetrad_covector(&frame, m);
    return length > 1e-9 * fmax(far, here);
}

enum kd_status kd_aim_look(const struct kd_aim *aim, const struct kd_scene *scene, double look[3],
                           struct kd_error *error)
{
    if (aim->kind == KD_AIM_FREE) {
        free_look(scene, look);
        return KD_OK;
    }
    if (isinf(scene->camera.r))
        return kd_error_field(error, "/look_at",
                              "look_at cannot be used with camera.r \"infinity\"; camera.r must be finite");
    const struct kd_vantage at = kd_scene_vantage(scene), beside = beside_horizon(at);
    const struct kd_observer_motion motion = kd_scene_observer(scene);
    const struct kd_tetrad frame = kd_observer_tetrad(&motion, &beside);
    struct kd_covector photon = straight_out(&beside);
    if (aim->kind == KD_AIM_PLACE && !arriving(aim, scene, &beside, &photon))
        return kd_error_field(error, "/look_at", "look_at is the position of the camera; it must be another position");
    const struct kd_look seen = kd_tetrad_look(&frame, &photon);
    const double length = sqrt(seen.right * seen.right + seen.up * seen.up + seen.inwards * seen.inwards);
    look[0] = seen.right / length;
    look[1] = seen.up / length;
    look[2] = seen.inwards / length;
    return KD_OK;
}

void kd_aim_between(const double from[3], const double to[3], double t, double look[3])
{
    const double along = from[0] * to[0] + from[1] * to[1] + from[2] * to[2];
    double aside[3] = { to[0] - along * from[0], to[1] - along * from[1], to[2] - along * from[2] };
    double sine = sqrt(aside[0] * aside[0] + aside[1] * aside[1] + aside[2] * aside[2]);
    const double angle = t * atan2(sine, along), flat = hypot(from[0], from[2]);
    if (sine < 1e-9) { /* the directions are parallel or opposite */
        aside[0] = flat > 0 ? from[2] / flat : 1;
        aside[1] = 0;
        aside[2] = flat > 0 ? -from[0] / flat : 0;
        sine = 1;
    }
    for (int i = 0; i < 3; i++)
        look[i] = cos(angle) * from[i] + sin(angle) / sine * aside[i];
}

void kd_aim_turn(struct kd_scene *scene, const double look[3])
{
    const double degree = M_PI / 180;
    scene->camera.pitch_deg = atan2(look[1], hypot(look[0], look[2])) / degree;
    scene->camera.yaw_deg = look[0] == 0 && look[2] == 0 ? 0 : atan2(look[0], look[2]) / degree;
}
