#include "render/rays/fields.h"

#include "render/rays/check.h"

#include <math.h>
#include <string.h>

#define AT(member) offsetof(struct kd_rays_request, member)

/* The least radius of an observer: a horizon is above 1 M whatever the spin, 1 + sqrt(1 - a^2), Bardeen, Press &
 * Teukolsky 1972. */
const struct kd_rays_field kd_rays_fields[KD_RAYS_FIELDS] = {
    { "", "spin", "/spin", KD_RAYS_REAL, -1, 1, KD_RAYS_OPEN, 0, NULL, "a number above -1 and below 1",
      "spin of the hole, a/M", AT(params.spin) },
    { "observer", "r", "/observer/r", KD_RAYS_REAL_OR_WORD, 1, KD_RAYS_FAR, KD_RAYS_OPEN_BELOW, 0, "infinity",
      "a number or \"infinity\"", "radius of the observer, M; outside the horizon", AT(params.r) },
    { "observer", "inclination_deg", "/observer/inclination_deg", KD_RAYS_REAL, 0, 180, KD_RAYS_CLOSED, 0, NULL,
      "0 to 180 degrees", "polar angle of the observer, from the hole's axis", AT(params.inclination_deg) },
    { "observer", "motion", "/observer/motion", KD_RAYS_WORD_OR_NONE, 0, 0, KD_RAYS_CLOSED, 0, NULL, NULL,
      "motion of an observer at a finite r, as camera.observer of a scene; a ray is then a direction in the observer's "
      "frame, [yaw, pitch] in degrees",
      AT(params.observer) },
    { "observer", "velocity_r", "/observer/velocity_r", KD_RAYS_REAL, -1, 1, KD_RAYS_CLOSED, 0, NULL, "-1 to 1",
      "as camera.velocity_r (motion: velocity)", AT(params.velocity[0]) },
    { "observer", "velocity_theta", "/observer/velocity_theta", KD_RAYS_REAL, -1, 1, KD_RAYS_CLOSED, 0, NULL, "-1 to 1",
      "as camera.velocity_theta (motion: velocity)", AT(params.velocity[1]) },
    { "observer", "velocity_phi", "/observer/velocity_phi", KD_RAYS_REAL, -1, 1, KD_RAYS_CLOSED, 0, NULL, "-1 to 1",
      "as camera.velocity_phi (motion: velocity)", AT(params.velocity[2]) },
    { "observer", "infall_from", "/observer/infall_from", KD_RAYS_REAL_OR_WORD, 1, 1e7, KD_RAYS_CLOSED, 0, "infinity",
      "1 to 1e7 M, or \"infinity\"", "as camera.infall_from, M (motion: infall)", AT(params.fall_from) },
    { "observer", "infall_energy", "/observer/infall_energy", KD_RAYS_REAL_OR_WORD, -100, 1000, KD_RAYS_CLOSED, 0,
      "rest", "-100 to 1000, or \"rest\"", "as camera.infall_energy (motion: infall)", AT(params.fall_energy) },
    { "observer", "infall_momentum", "/observer/infall_momentum", KD_RAYS_REAL, -1e4, 1e4, KD_RAYS_CLOSED, 0, NULL,
      "-10000 to 10000 M", "as camera.infall_momentum, M (motion: infall)", AT(params.fall_momentum) },
    { "", "orders", "/orders", KD_RAYS_INT, 1, KD_RAYS_MAX_ORDERS, KD_RAYS_CLOSED, 0, NULL,
      "a whole number from 1 to 16", "number of equatorial crossings in the answer", AT(params.orders) },
    { "accuracy", "profile", "/accuracy/profile", KD_RAYS_PROFILE, 0, 0, KD_RAYS_CLOSED, 0, NULL, NULL,
      "as accuracy.profile of a scene; without profile and engine, the closed form is used",
      AT(asked_accuracy.profile) },
    { "accuracy", "tolerance", "/accuracy/tolerance", KD_RAYS_REAL_OR_WORD, 0, 1, KD_RAYS_OPEN, 0, "profile",
      "a number above 0 and below 1, or \"profile\"",
      "largest relative error of the crossing radii, instead of the profile", AT(asked_accuracy.tolerance) },
    { "accuracy", "engine", "/accuracy/engine", KD_RAYS_WORD_OR_AUTO, 0, 0, KD_RAYS_CLOSED, 0, NULL, NULL,
      "method that traces the rays; auto: by profile or tolerance", AT(asked_accuracy.engine) },
    { "accuracy", "precision", "/accuracy/precision", KD_RAYS_WORD_OR_AUTO, 0, 0, KD_RAYS_CLOSED, 0, NULL, NULL,
      "precision of the arithmetic; the closed form has only f64", AT(asked_accuracy.precision) },
    { "accuracy", "steps", "/accuracy/steps", KD_RAYS_INT, 0, KD_STEPS_MAX, KD_RAYS_CLOSED, 4, NULL,
      "a multiple of 4 up to 2048, or 0 for the engine's default",
      "integrator steps for a half period of the radial motion; some engines take fewer", AT(asked_accuracy.steps) },
};
_Static_assert(KD_RAYS_MAX_ORDERS == 16 && KD_STEPS_MAX == 2048, "the sentences say so");

const struct kd_rays_field *kd_rays_field_find(const char *name)
{
    for (size_t i = 0; i < KD_RAYS_FIELDS; i++)
        if (!strcmp(kd_rays_fields[i].name, name))
            return &kd_rays_fields[i];
    return NULL;
}

const struct kd_field *kd_rays_field_words(const struct kd_rays_field *field)
{
    return field->kind == KD_RAYS_WORD_OR_NONE ? kd_field_find("camera", "observer")
                                               : kd_field_find("accuracy", field->name);
}

enum kd_status kd_rays_field_check(const char *name, double value, struct kd_error *error)
{
    const struct kd_rays_field *f = kd_rays_field_find(name);
    bool above = f->open ? value > f->least : value >= f->least,
         below = f->open == KD_RAYS_OPEN ? value < f->most : value <= f->most;
    if (above && below)
        return KD_OK;
    return kd_error_field(error, f->pointer, "%s is %.16g; it must be %s", name, value, f->allowed);
}
