#include "render/rays/fields.h"

#include "render/rays/check.h"
#include "scene/fields.h"

#include <math.h>
#include <stdio.h>

#define AT(member) offsetof(struct kd_rays_request, member)

/* The schema requires only that an observer is further out than 1 M, because for any spin the horizon, at 1 + sqrt(1
 * - a^2), is further out than that (Bardeen, Press & Teukolsky 1972). check.c compares the radius with the horizon of
 * the given spin, and the steps with the limits of the engine. "auto" is stored as -1, and a motion that is not given
 * as 0. */
static const struct kd_row fields[] = {
    { .name = "spin",
      .kind = KD_KIND_REAL,
      .offset = AT(params.spin),
      .least = -1,
      .most = 1,
      .open = KD_OPEN,
      .help = "spin of the hole, a/M" },
#define MORE(x, name_, member, least_, most_, shown, unit_, card, what, bound, ...) \
    { .name = #name_, \
      .kind = KD_KIND_REAL, \
      .offset = AT(params.name_), \
      .least = -1, \
      .most = 1, \
      .open = KD_OPEN, \
      .unit = unit_, \
      .help = what "; " bound },
    KD_HOLE_MORE(MORE, )
#undef MORE
        { .object = "observer",
          .name = "r",
          .kind = KD_KIND_REAL,
          .offset = AT(params.r),
          .least = -INFINITY,
          .most = INFINITY,
          .open = KD_OPEN,
          .words = "infinity",
          .stands = INFINITY,
          .allowed = "a number or \"infinity\"",
          .schema =
              "\"anyOf\":[{\"type\":\"string\",\"enum\":[\"infinity\"]},{\"type\":\"number\",\"exclusiveMinimum\":1,"
              "\"maximum\":10000000}]",
          .help = "radius of the observer, M; outside the horizon" },
    { .object = "observer",
      .name = "inclination_deg",
      .kind = KD_KIND_REAL,
      .offset = AT(params.inclination_deg),
      .least = 0,
      .most = 180,
      .allowed = "0 to 180 degrees",
      .help = "polar angle of the observer, from the hole's axis" },
    { .object = "observer",
      .name = "motion",
      .kind = KD_KIND_WORD,
      .offset = AT(params.observer),
      .words = KD_OBSERVER_WORDS,
      .first = 1,
      .help = "motion of an observer at a finite r, as camera.observer of a scene; a ray is then a direction in the "
              "observer's "
              "frame, [yaw, pitch] in degrees" },
    { .object = "observer",
      .name = "velocity_r",
      .kind = KD_KIND_REAL,
      .offset = AT(params.velocity[0]),
      .least = -1,
      .most = 1,
      .help = "velocity outwards, as camera.velocity_r (motion: velocity)" },
    { .object = "observer",
      .name = "velocity_theta",
      .kind = KD_KIND_REAL,
      .offset = AT(params.velocity[1]),
      .least = -1,
      .most = 1,
      .help = "velocity away from the north pole, as camera.velocity_theta (motion: velocity)" },
    { .object = "observer",
      .name = "velocity_phi",
      .kind = KD_KIND_REAL,
      .offset = AT(params.velocity[2]),
      .least = -1,
      .most = 1,
      .help = "velocity along the disk's rotation, as camera.velocity_phi (motion: velocity)" },
    { .object = "observer",
      .name = "infall_from",
      .kind = KD_KIND_REAL,
      .offset = AT(params.fall_from),
      .least = 1,
      .most = 1e7,
      .words = "infinity",
      .stands = INFINITY,
      .allowed = "1 to 1e7 M, or \"infinity\"",
      .help = "radius at which the observer was at rest, as camera.infall_from, M (motion: infall)" },
    { .object = "observer",
      .name = "infall_energy",
      .kind = KD_KIND_REAL,
      .offset = AT(params.fall_energy),
      .least = -100,
      .most = 1000,
      .words = "rest",
      .stands = INFINITY,
      .help = "energy per mass, as camera.infall_energy (motion: infall)" },
    { .object = "observer",
      .name = "infall_momentum",
      .kind = KD_KIND_REAL,
      .offset = AT(params.fall_momentum),
      .least = -1e4,
      .most = 1e4,
      .allowed = "-10000 to 10000 M",
      .help = "angular momentum per mass, as camera.infall_momentum, M (motion: infall)" },
    { .name = "orders",
      .kind = KD_KIND_INT,
      .offset = AT(params.orders),
      .least = 1,
      .most = KD_RAYS_MAX_ORDERS,
      .help = "number of equatorial crossings in the answer" },
    { .object = "accuracy",
      .name = "profile",
      .kind = KD_KIND_WORD,
      .offset = AT(asked_accuracy.profile),
      .words = KD_PROFILE_WORDS,
      .help = "as accuracy.profile of a scene; without profile and engine, the closed form is used" },
    { .object = "accuracy",
      .name = "tolerance",
      .kind = KD_KIND_REAL,
      .offset = AT(asked_accuracy.tolerance),
      .least = 0,
      .most = 1,
      .open = KD_OPEN,
      .words = "profile",
      .stands = INFINITY,
      .help = "largest relative error of the crossing radii, instead of the profile" },
    { .object = "accuracy",
      .name = "engine",
      .kind = KD_KIND_WORD,
      .offset = AT(asked_accuracy.engine),
      .words = KD_ENGINE_WORDS,
      .first = -1,
      .help = "method that traces the rays; auto: by profile or tolerance" },
    { .object = "accuracy",
      .name = "precision",
      .kind = KD_KIND_WORD,
      .offset = AT(asked_accuracy.precision),
      .words = KD_PRECISION_WORDS,
      .first = -1,
      .help = "precision of the arithmetic; the closed form has only f64" },
    { .object = "accuracy",
      .name = "steps",
      .kind = KD_KIND_INT,
      .offset = AT(asked_accuracy.steps),
      .most = 1e9,
      .allowed = "a multiple of 4 up to 2048, or 0 for the engine's default",
      .schema = "\"type\":\"integer\",\"minimum\":0,\"maximum\":2048,\"multipleOf\":4",
      .help = "integrator steps for a half period of the radial motion; some engines take fewer" },
};
_Static_assert(KD_STEPS_MAX == 2048 && (int)KD_RAYS_FAR == 10000000, "the schemas say so");

const struct kd_document kd_rays_document = { fields, sizeof fields / sizeof *fields, 0, "rays", NULL };

enum kd_status kd_rays_field_check(const char *name, double value, struct kd_error *error)
{
    char pointer[64], allowed[KD_ALLOWED_SIZE];
    const struct kd_row *row = kd_document_find(&kd_rays_document, name);
    if (kd_row_holds(row, value))
        return KD_OK;
    kd_row_allowed(row, allowed);
    snprintf(pointer, sizeof pointer, "%s%s/%s", row->object ? "/" : "", row->object ? row->object : "", name);
    return kd_error_field(error, pointer, "%s is %.16g; it must be %s", name, value, allowed);
}
