/* The kinds of requests that http/route.h declares: name, limit, media types and schemas of each. */
#include "integral/request.h"
#include "orbit/request.h"
#include "playground/json.h"
#include "render/rays/request.h"
#include "server/asset/store.h"
#include "server/http/request.h"
#include "server/job/jobs.h"
#include "server/openapi/fields.h"
#include "server/openapi/integrals.h"
#include "server/openapi/jobs.h"
#include "server/openapi/lessons.h"
#include "server/openapi/playground.h"
#include "server/openapi/rays.h"
#include "server/openapi/sessions.h"
#include "server/openapi/strict.h"

#define REF KD_SCHEMA_REF

const struct kd_taken kd_taken[KD_TAKES] = {
    [KD_TAKES_NOTHING] = { .about = "nothing" },
    [KD_TAKES_SCENE] = { .about = "a scene",
                         .schema = REF("Scene"),
                         .changes = REF("Scene"),
                         .parameters = kd_openapi_scene_parameters },
    [KD_TAKES_PLAN] = { .about = "a scene, or a sweep",
                        .what = "a body of a job", /* a sweep has the same body as a job */
                        .most = KD_JOB_BODY_MAX,
                        .body = kd_openapi_plan_body,
                        .parameters = kd_openapi_preset_parameter },
    [KD_TAKES_RAYS] = { .about = "rays",
                        .what = "a body of rays",
                        .most = KD_RAYS_BODY_MAX,
                        .types = KD_JSON_TYPE " " KD_NPY_TYPE,
                        .schema = REF("RaysRequest"),
                        .parameters = kd_openapi_rays_parameters },
    [KD_TAKES_ORBITS] = { .about = "orbits",
                          .what = "a body of orbits",
                          .most = KD_ORBIT_BODY_MAX,
                          .schema = REF("OrbitsRequest") },
    [KD_TAKES_INTEGRAL] = { .about = "an integral",
                            .what = "a body of an integral",
                            .most = KD_INTEGRAL_BODY_MAX,
                            .body = kd_openapi_integral_body },
    [KD_TAKES_JOB] = { .about = "a job",
                       .what = "a body of a job with a playground",
                       .most = KD_JOB_FILM_MAX,
                       .body = kd_openapi_jobs_body,
                       .parameters = kd_openapi_preset_parameter },
    [KD_TAKES_ASSET] = { .about = "an asset",
                         .what = "an asset",
                         .most = KD_ASSET_BYTES,
                         .types = KD_PNG_TYPE " " KD_NPZ_TYPE " " KD_UVFITS_TYPE " " KD_CSV_TYPE },
    [KD_TAKES_LESSON] = { .about = "a lesson", .schema = REF("NewLesson"), .changes = REF("LessonChange") },
    [KD_TAKES_HAND] = { .about = "an answer of a pupil", .schema = kd_openapi_hand_schema },
    [KD_TAKES_STRIKE] = { .about = "an amplitude, or nothing", .may_lack = true, .body = kd_openapi_strike_body },
    [KD_TAKES_PATH] = { .about = "keyframes", .schema = kd_openapi_path_schema },
    [KD_TAKES_PARTICLES] = { .about = "a selection", .parameters = kd_openapi_particles_parameters },
    [KD_TAKES_PLAYGROUND] = { .about = "a playground",
                              .what = "a playground's document",
                              .most = KD_PLAYGROUND_JSON_MAX,
                              .schema = REF("Playground"),
                              .changes = REF("PlaygroundChange") },
    [KD_TAKES_STEP] = { .about = "a time", .schema = kd_openapi_step_schema },
    [KD_TAKES_TICK] = { .about = "nothing" },
    [KD_TAKES_LINK] = { .about = "a scene in the path" },
    [KD_TAKES_QUANTITY] = { .about = "parameters of the quantity" },
};
