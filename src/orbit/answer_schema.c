/* JSON Schema of the answers that answer.c writes. */
#include "base/schema.h"
#include "orbit/answer.h"
#include "orbit/schema.h"

static const char *fate(size_t i) { return i <= KD_ORBIT_ESCAPE ? kd_orbit_fate_name((enum kd_orbit_fate)i) : NULL; }
static const char *end(size_t i) { return i <= KD_END_FAR ? kd_orbit_end_name((enum kd_orbit_end)i) : NULL; }
static const char *way(size_t i) { return i < KD_WAYS ? kd_orbit_way_name((enum kd_orbit_way)i) : NULL; }

/* docs/orbits.md explains each member. */
#define UNITS "per rest mass; lengths and times in M, angles in radians unless a name ends in _deg"
#define NUMBER KD_SCHEMA_NUMBER
#define OR_NULL KD_SCHEMA_NUMBER_OR_NULL

static void add_constants(struct kd_json *json)
{
    static const struct kd_schema_member constants[] = {
        { "energy", NUMBER }, { "binding", NUMBER },        { "angular_momentum", NUMBER },
        { "carter", NUMBER }, { "binet_c", OR_NULL, true },
    };
    static const struct kd_schema_member turning[] = {
        { "r_min", OR_NULL }, { "r_max", OR_NULL }, { "theta_min_deg", NUMBER }, { "theta_max_deg", OR_NULL }
    };
    static const struct kd_schema_member shape[] = { { "p", NUMBER }, { "e", NUMBER }, { "inclination_deg", NUMBER } };
    static const struct kd_schema_member advance[] = {
        { "periastron", OR_NULL },
        { "weak_field", OR_NULL },
        { "node", OR_NULL },
        { "periastron_arcsec_per_century", OR_NULL, true },
    };
    KD_SCHEMA_TOLD(json, "OrbitConstants", UNITS, constants);
    KD_SCHEMA_TOLD(json, "OrbitTurningPoints", UNITS, turning);
    KD_SCHEMA_TOLD(json, "OrbitShape", UNITS, shape);
    KD_SCHEMA_TOLD(json, "OrbitAdvance", UNITS, advance);
}

static void add_frequencies(struct kd_json *json)
{
    static const struct kd_schema_member mino[] = {
        { "r", OR_NULL }, { "theta", OR_NULL }, { "phi", OR_NULL }, { "t", OR_NULL }, { "tau_proper", OR_NULL }
    };
    static const struct kd_schema_member three[] = { { "r", OR_NULL }, { "theta", OR_NULL }, { "phi", OR_NULL } };
    static const struct kd_schema_member all[] = {
        { "mino", KD_SCHEMA_REF("OrbitMinoFrequencies") },
        { "coordinate", KD_SCHEMA_REF("OrbitThreeFrequencies") },
        { "proper", KD_SCHEMA_REF("OrbitThreeFrequencies") },
        { "hz", KD_SCHEMA_REF("OrbitThreeFrequencies"), true },
    };
    KD_SCHEMA_TOLD(json, "OrbitMinoFrequencies",
                   "in radians per Mino time, in radians per M, or in Hz, by the name of the member", mino);
    KD_SCHEMA_TOLD(json, "OrbitThreeFrequencies",
                   "in radians per Mino time, in radians per M, or in Hz, by the name of the member", three);
    KD_SCHEMA_STRICT(json, "OrbitFrequencies", all);
}

static void add_series(struct kd_json *json)
{
    kd_json_object(json, "OrbitSeries");
    kd_json_string(json, "type", "object");
    kd_json_bool(json, "additionalProperties", false);
    kd_schema_text(json, "required", "[\"columns\",\"rows\"]");
    kd_json_object(json, "properties");
    kd_json_object(json, "columns");
    kd_json_string(json, "type", "array");
    kd_schema_enum(json, "items", kd_orbit_column);
    kd_json_end(json);
    kd_schema_text(json, "rows", KD_SCHEMA_LIST(KD_SCHEMA_LIST(OR_NULL)));
    kd_json_end(json);
    kd_json_end(json);
}

static void add_result(struct kd_json *json)
{
    static const struct kd_schema_member drift[] = { { "energy", OR_NULL },
                                                     { "angular_momentum", NUMBER },
                                                     { "carter", OR_NULL },
                                                     { "mass", OR_NULL },
                                                     { "binet_c", OR_NULL, true } };
    static const struct kd_schema_member difference[] = {
        { "tau_proper", OR_NULL }, { "t", OR_NULL }, { "r", OR_NULL }, { "theta", OR_NULL }, { "phi", OR_NULL }
    };
    static const struct kd_schema_member result[] = {
        { "method", NULL, false, way },
        { "end", NULL, false, end },
        { "mino_end", OR_NULL },
        { "steps", KD_SCHEMA_COUNT, true },
        { "mino_step", OR_NULL, true },
        { "error_estimate", OR_NULL, true },
        { "drift", KD_SCHEMA_REF("OrbitDrift"), true },
        { "periastra", KD_SCHEMA_COUNT, true },
        { "periastron_advance_measured", OR_NULL, true },
        { "closed_form_difference", KD_SCHEMA_REF("OrbitDifference"), true },
        { "approximations", KD_SCHEMA_LIST(KD_SCHEMA_TEXT) },
    };
    KD_SCHEMA_STRICT(json, "OrbitDrift", drift);
    KD_SCHEMA_TOLD(json, "OrbitDifference", UNITS, difference);
    KD_SCHEMA_TOLD(json, "OrbitResult", UNITS, result);
}

void kd_orbit_answer_schemas(struct kd_json *json)
{
    static const struct kd_schema_member path[] = {
        { "spin", NUMBER },
#define MORE(x, name, ...) { #name, NUMBER, true },
        KD_HOLE_MORE(MORE, )
#undef MORE
            { "fate", NULL, false, fate },
        { "circular", KD_SCHEMA_BOOL },
        { "constants", KD_SCHEMA_REF("OrbitConstants") },
        { "turning_points", KD_SCHEMA_REF("OrbitTurningPoints") },
        { "shape", KD_SCHEMA_REF("OrbitShape"), true },
        { "frequencies", KD_SCHEMA_REF("OrbitFrequencies"), true },
        { "advance", KD_SCHEMA_REF("OrbitAdvance"), true },
        { "series", KD_SCHEMA_REF("OrbitSeries"), true },
        { "result", KD_SCHEMA_REF("OrbitResult") },
    };
    static const struct kd_schema_member many[] = { { "orbits", KD_SCHEMA_LIST(KD_SCHEMA_REF("OrbitPath")) } };
    add_constants(json);
    add_frequencies(json);
    add_series(json);
    add_result(json);
    KD_SCHEMA_TOLD(json, "OrbitPath", UNITS, path);
    KD_SCHEMA_STRICT(json, "OrbitPaths", many);
}
