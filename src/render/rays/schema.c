#include "render/rays/schema.h"

#include "render/rays/check.h"
#include "render/rays/fields.h"

#include <stdio.h>
#include <string.h>

static void begin_strict(struct kd_json *json, const char *name)
{
    kd_json_object(json, name);
    kd_json_string(json, "type", "object");
    kd_json_bool(json, "additionalProperties", false);
}

/* Adds the fields of one object. */
static void add_members(struct kd_json *json, const char *object)
{
    for (size_t i = 0; i < kd_rays_document.n; i++)
        if (kd_rays_document.rows[i].object && !strcmp(kd_rays_document.rows[i].object, object))
            kd_row_schema(json, kd_rays_document.rows[i].name, &kd_rays_document.rows[i]);
}

static void add_rays(struct kd_json *json)
{
    kd_json_object(json, "rays");
    kd_json_string(json, "type", "array");
    kd_json_number(json, "minItems", 1);
    kd_json_number(json, "maxItems", KD_RAYS_MAX);
    kd_json_string(json, "description", "pairs [alpha, beta], in M; with observer.motion [yaw, pitch], in degrees");
    kd_json_object(json, "items");
    kd_json_string(json, "type", "array");
    kd_json_number(json, "minItems", 2);
    kd_json_number(json, "maxItems", 2);
    kd_json_object(json, "items");
    kd_json_string(json, "type", "number");
    kd_json_number(json, "minimum", -KD_RAYS_FAR);
    kd_json_number(json, "maximum", KD_RAYS_FAR);
    kd_json_end(json);
    kd_json_end(json);
    kd_json_end(json);
}

void kd_rays_request_schema(struct kd_json *json, const char *name)
{
    begin_strict(json, name);
    kd_schema_text(json, "required", "[\"rays\"]");
    kd_json_object(json, "properties");
    kd_document_properties(json, &kd_rays_document);
    add_rays(json);
    kd_json_end(json);
    kd_json_end(json);
}

const char *kd_rays_field_name(size_t index, const char **help)
{
    if (index >= kd_rays_document.n)
        return NULL;
    *help = kd_rays_document.rows[index].help;
    return kd_rays_document.rows[index].name;
}

void kd_rays_field_schema(struct kd_json *json, size_t index)
{
    kd_row_schema(json, "schema", &kd_rays_document.rows[index]);
}

static const char *engine(size_t i) { return i < KD_ENGINE_COUNT ? kd_engine_name((enum kd_engine)i) : NULL; }
static const char *precision(size_t i)
{
    return i <= KD_PRECISION_F64 ? kd_precision_name((enum kd_precision)i) : NULL;
}
static const char *fate(size_t i) { return i <= KD_RAY_UNDECIDED ? kd_ray_fate_name((enum kd_ray_fate)i) : NULL; }

/* Adds the schema of the observer, which an answer repeats as it was requested, with all members. */
static void add_observer(struct kd_json *json)
{
    begin_strict(json, "RaysObserver");
    kd_schema_text(json, "required", "[\"r\",\"inclination_deg\"]");
    kd_json_object(json, "properties");
    add_members(json, "observer");
    kd_json_end(json);
    kd_json_end(json);
}

/* Units; docs/rays.md describes each member. */
#define UNITS "lengths and times in M, angles in radians"
void kd_rays_answer_schemas(struct kd_json *json)
{
    static const struct kd_schema_member accuracy[] = {
        { "engine", NULL, false, engine },
        { "precision", NULL, false, precision },
        { "steps", KD_SCHEMA_COUNT },
        { "rays", KD_SCHEMA_COUNT },
        { "undecided", KD_SCHEMA_COUNT },
        { "tolerance", KD_SCHEMA_NUMBER, true },
        { "followed_again", KD_SCHEMA_COUNT, true },
        { "beyond", KD_SCHEMA_COUNT, true },
        { "holds", KD_SCHEMA_NUMBER, true },
        { "worst_error", KD_SCHEMA_NUMBER, true },
        { "median_error", KD_SCHEMA_NUMBER, true },
    };
    static const struct kd_schema_member crossing[] = {
        { "order", KD_SCHEMA_COUNT },        { "r", KD_SCHEMA_NUMBER, true }, { "phi", KD_SCHEMA_NUMBER, true },
        { "delay", KD_SCHEMA_NUMBER, true }, { "g", KD_SCHEMA_NUMBER, true },
    };
    static const struct kd_schema_member sky[] = { { "theta", KD_SCHEMA_NUMBER }, { "phi", KD_SCHEMA_NUMBER, true } };
    static const struct kd_schema_member ray[] = {
        { "fate", NULL, false, fate },
        { "crossings", KD_SCHEMA_LIST(KD_SCHEMA_REF("RayCrossing")) },
        { "sky", KD_SCHEMA_REF("RaySky"), true },
        { "energy", KD_SCHEMA_NUMBER, true },
        { "error", KD_SCHEMA_NUMBER, true },
    };
    static const struct kd_schema_member answer[] = {
        { "spin", KD_SCHEMA_NUMBER },
#define MORE(x, name, ...) { #name, KD_SCHEMA_NUMBER, true },
        KD_HOLE_MORE(MORE, )
#undef MORE
            { "observer", KD_SCHEMA_REF("RaysObserver") },
        { "orders", KD_SCHEMA_COUNT },
        { "accuracy", KD_SCHEMA_REF("RaysAccuracy") },
        { "approximations", KD_SCHEMA_LIST(KD_SCHEMA_TEXT) },
        { "rays", KD_SCHEMA_LIST(KD_SCHEMA_REF("Ray")) },
    };
    add_observer(json);
    KD_SCHEMA_STRICT(json, "RaysAccuracy", accuracy);
    KD_SCHEMA_TOLD(json, "RayCrossing", UNITS, crossing);
    KD_SCHEMA_TOLD(json, "RaySky", UNITS, sky);
    KD_SCHEMA_TOLD(json, "Ray", UNITS, ray);
    KD_SCHEMA_STRICT(json, "RaysAnswer", answer);
}
