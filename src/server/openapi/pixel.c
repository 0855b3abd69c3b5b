#include "server/openapi/pixel.h"

#include "render/accuracy/engine.h"
#include "render/emit/emitter.h"
#include "render/explain/motion.h"
#include "render/rays/rays.h"
#include "server/openapi/strict.h"

#define NUMBER KD_SCHEMA_NUMBER
#define OR_NULL KD_SCHEMA_NUMBER_OR_NULL
#define COUNT KD_SCHEMA_COUNT
#define TEXT KD_SCHEMA_TEXT
#define BOOL KD_SCHEMA_BOOL
#define LIST KD_SCHEMA_LIST
#define REF KD_SCHEMA_REF
#define PAIR "{\"type\":\"array\",\"minItems\":2,\"maxItems\":2,\"items\":{\"type\":\"number\"}}"
/* The Stokes parameters I, Q and U, and for volumes also V. */
#define STOKES "{\"type\":\"array\",\"minItems\":3,\"maxItems\":4,\"items\":{\"type\":\"number\"}}"
/* Each member of the schemas below is described in docs/pixel.md. */
#define UNITS "lengths and times in M, angles in radians; frequencies relative to those that the observer measures"
#define ROWS LIST(LIST("{\"type\":[\"number\",\"null\",\"string\"]}"))

static const char *fate(size_t i) { return i <= KD_RAY_UNDECIDED ? kd_ray_fate_name((enum kd_ray_fate)i) : NULL; }

static const char *emitter(size_t i) { return i < KD_EMITTER_COUNT ? kd_emitters[i]->name : NULL; }
static const char *engine(size_t i) { return i < KD_ENGINE_COUNT ? kd_engine_name((enum kd_engine)i) : NULL; }
static const char *precision(size_t i)
{
    return i <= KD_PRECISION_F64 ? kd_precision_name((enum kd_precision)i) : NULL;
}

/* Writes the schemas of a ray's motion. */
static void add_motion(struct kd_json *json)
{
    static const struct kd_openapi_member constants[] = {
        { "alpha", NUMBER, false }, { "beta", NUMBER, false }, { "lambda", NUMBER, false }, { "eta", NUMBER, false },
        { "E", NUMBER, false },     { "L", NUMBER, false },    { "Q", NUMBER, false },      { "outward", BOOL, false },
    };
    static const struct kd_openapi_member radial[] = {
        { "case", NULL, false, kd_ray_radial_case },
        { "real_roots", COUNT, false },
        { "roots", LIST(LIST(NUMBER)), false },
        { "horizon_r", NUMBER, false },
        { "turning_r", OR_NULL, false },
    };
    static const struct kd_openapi_member polar[] = { { "case", NULL, false, kd_ray_polar_case },
                                                      { "roots", LIST(NUMBER), false },
                                                      { "theta", LIST(NUMBER), false } };
    KD_OPENAPI_TOLD(json, "RayConstants", UNITS, constants);
    KD_OPENAPI_TOLD(json, "RayRadial", UNITS, radial);
    KD_OPENAPI_TOLD(json, "RayPolar", UNITS, polar);
}

/* Writes the schemas of crossings, which are places where light is emitted or blocked. */
static void add_crossings(struct kd_json *json)
{
    static const struct kd_openapi_member glow[] = {
        { "name", NULL, false, emitter }, { "light", KD_SCHEMA_VECTOR, false }, { "seen", KD_SCHEMA_VECTOR, false },
        { "luminance", NUMBER, false },   { "luminance_seen", NUMBER, false },  { "opacity", NUMBER, true },
        { "points", BOOL, true },
    };
    static const struct kd_openapi_member pictured[] = { { "r", NUMBER, false },
                                                         { "g", NUMBER, false },
                                                         { "footprint", NUMBER, true } };
    static const struct kd_openapi_member crossing[] = {
        { "order", COUNT, false },
        { "r", OR_NULL, false },
        { "phi", OR_NULL, false },
        { "azimuth", OR_NULL, false },
        { "delay", OR_NULL, false },
        { "g", OR_NULL, false },
        { "seen", BOOL, false },
        { "temperature", NUMBER, true },
        { "emission_angle", NUMBER, true },
        { "speed", OR_NULL, true },
        { "approach", OR_NULL, true },
        { "evpa", OR_NULL, true },
        { "polarization_fraction", OR_NULL, true },
        { "picture", REF("PixelPictured"), true },
        { "through", NUMBER, true },
        { "emitters", LIST(REF("PixelGlow")), true },
        { "optical_depth", OR_NULL, true },
    };
    KD_OPENAPI_STRICT(json, "PixelGlow", glow);
    KD_OPENAPI_TOLD(json, "PixelPictured", UNITS, pictured);
    KD_OPENAPI_TOLD(json, "PixelCrossing", UNITS, crossing);
}

static void add_along(struct kd_json *json)
{
    static const struct kd_openapi_member volume[] = { { "name", NULL, false, emitter },
                                                       { "seen", KD_SCHEMA_VECTOR, false },
                                                       { "luminance_seen", NUMBER, false },
                                                       { "optical_depth", OR_NULL, false } };
    static const struct kd_openapi_member stretch[] = {
        { "order", COUNT, false },           { "from_r", OR_NULL, false },        { "from_theta", NUMBER, false },
        { "from_delay", OR_NULL, false },    { "to_r", OR_NULL, false },          { "to_theta", NUMBER, false },
        { "to_delay", OR_NULL, false },      { "seen", KD_SCHEMA_VECTOR, false }, { "through", NUMBER, false },
        { "optical_depth", OR_NULL, false },
    };
    static const struct kd_openapi_member along[] = {
        { "names", LIST(TEXT), false },
        { "steps", COUNT, false },
        { "samples", COUNT, false },
        { "seen", KD_SCHEMA_VECTOR, false },
        { "luminance_seen", NUMBER, false },
        { "optical_depth", OR_NULL, false },
        { "delay", OR_NULL, false },
        { "volumes", LIST(REF("PixelVolume")), false },
        { "stretches", LIST(REF("PixelStretch")), true },
    };
    static const struct kd_openapi_member met[] = {
        { "name", NULL, false, emitter },    { "index", COUNT, false },
        { "order", COUNT, false },           { "r", NUMBER, false },
        { "theta", NUMBER, false },          { "phi", NUMBER, false },
        { "azimuth", OR_NULL, false },       { "g", NUMBER, false },
        { "emission_angle", NUMBER, false }, { "light", KD_SCHEMA_VECTOR, false },
        { "seen", KD_SCHEMA_VECTOR, false }, { "luminance_seen", NUMBER, false },
        { "through", NUMBER, false },
    };
    KD_OPENAPI_STRICT(json, "PixelVolume", volume);
    KD_OPENAPI_TOLD(json, "PixelStretch", UNITS, stretch);
    KD_OPENAPI_TOLD(json, "PixelAlong", UNITS, along);
    KD_OPENAPI_TOLD(json, "PixelMet", UNITS, met);
}

static void add_ends(struct kd_json *json)
{
    static const struct kd_openapi_member end[] = {
        { "fate", NULL, false, fate },       { "why", TEXT, false },     { "through", NUMBER, false },
        { "optical_depth", OR_NULL, false }, { "theta", OR_NULL, true }, { "phi", OR_NULL, true },
        { "azimuth", OR_NULL, true },        { "g", NUMBER, true },      { "emitters", LIST(REF("PixelGlow")), false },
    };
    static const struct kd_openapi_member path[] = {
        { "steps", COUNT, false },
        { "least_r", NUMBER, false },
        { "coordinates", "{\"enum\":[\"ingoing\",\"Boyer-Lindquist\"]}", false },
        { "whole", BOOL, false },
        { "columns", LIST(TEXT), false },
        { "points", LIST(LIST(OR_NULL)), false },
    };
    static const struct kd_openapi_member trace[] = {
        { "none", TEXT, true },
        { "engine", NULL, true, engine },
        { "precision", NULL, true, precision },
        { "steps_a_half_period", COUNT, true },
        { "fate", NULL, true, fate },
        { "crossings", COUNT, true },
        { "not_shown", COUNT, true },
        { "same_without_trace", BOOL, true },
        { "columns", LIST(TEXT), true },
        { "steps", ROWS, true },
    };
    static const struct kd_openapi_member accuracy[] = {
        { "engine", NULL, false, engine },
        { "precision", NULL, false, precision },
        { "steps", COUNT, false },
        { "closed_form", OR_NULL, false },
        { "picture", OR_NULL, false },
        { "path", OR_NULL, false },
        { "first_integrals", OR_NULL, false },
        { "sum", OR_NULL, false },
    };
    static const struct kd_openapi_member polarization[] = { { "stokes", STOKES, false },
                                                             { "evpa", OR_NULL, false },
                                                             { "polarization_fraction", OR_NULL, false } };
    KD_OPENAPI_TOLD(json, "PixelPolarization", UNITS, polarization);
    KD_OPENAPI_TOLD(json, "PixelEnd", UNITS, end);
    KD_OPENAPI_TOLD(json, "PixelPath", UNITS, path);
    KD_OPENAPI_STRICT(json, "PixelTrace", trace);
    KD_OPENAPI_STRICT(json, "PixelAccuracy", accuracy);
}

/* The members of each ray of the pixel. The light of the pixel is the mean over its rays. */
#define RAY \
    { "ray_at", PAIR, false }, { "weight", NUMBER, false }, { "constants", REF("RayConstants"), false }, \
        { "radial", REF("RayRadial"), false }, { "polar", REF("RayPolar"), false }, \
        { "crossings", LIST(REF("PixelCrossing")), false }, { "along", REF("PixelAlong"), true }, \
        { "met", REF("PixelMet"), true }, { "end", REF("PixelEnd"), false }, \
        { "polarization", REF("PixelPolarization"), true }, \
    { \
        "lost", COUNT, false \
    }

void kd_openapi_pixel_schemas(struct kd_json *json)
{
    static const struct kd_openapi_member colour[] = { { "shown", KD_SCHEMA_VECTOR, false },
                                                       { "pixel", KD_SCHEMA_VECTOR, false },
                                                       { "ray", KD_SCHEMA_VECTOR, false },
                                                       { "exposure", NUMBER, false } };
    static const struct kd_openapi_member ray[] = { RAY,
                                                    { "light", KD_SCHEMA_VECTOR, false },
                                                    { "luminance", NUMBER, false },
                                                    { "closed_form", OR_NULL, false },
                                                    { "picture", OR_NULL, false } };
    static const struct kd_openapi_member pixel[] = {
        RAY,
        { "pixel", PAIR, false },
        { "eye", "{\"enum\":[\"left\",\"right\"]}", true },
        { "rays", COUNT, false },
        { "colour", REF("PixelColour"), false },
        { "path", REF("PixelPath"), false },
        { "pixel_polarization", REF("PixelPolarization"), true },
        { "trace", REF("PixelTrace"), true },
        { "accuracy", REF("PixelAccuracy"), false },
        { "each_ray", LIST(REF("PixelRay")), false },
        { "approximations", LIST(TEXT), false },
    };
    static const struct kd_openapi_member image[] = {
        { "name", TEXT, false },
        { "designation", TEXT, false },
        { "magnitude", NUMBER, false },
        { "x", NUMBER, false },
        { "y", NUMBER, false },
        { "x_by_azimuth", NUMBER, false },
        { "y_by_azimuth", NUMBER, false },
        { "magnification", NUMBER, false },
        { "g", NUMBER, false },
        { "through", NUMBER, false },
        { "seen_magnitude", OR_NULL, false },
        { "mirrored", BOOL, false },
    };
    static const struct kd_openapi_member stars[] = {
        { "width", COUNT, false },
        { "height", COUNT, false },
        { "azimuth_deg", NUMBER, false },
        { "found", COUNT, false },
        { "images", LIST(REF("StarImage")), false },
    };
    add_motion(json);
    add_crossings(json);
    add_along(json);
    add_ends(json);
    KD_OPENAPI_STRICT(json, "PixelColour", colour);
    KD_OPENAPI_TOLD(json, "PixelRay", UNITS, ray);
    KD_OPENAPI_TOLD(json, "Pixel", UNITS, pixel);
    KD_OPENAPI_STRICT(json, "StarImage", image);
    KD_OPENAPI_STRICT(json, "Stars", stars);
}
