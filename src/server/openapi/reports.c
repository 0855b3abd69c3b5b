#include "server/openapi/reports.h"

#include "render/accuracy/engine.h"
#include "render/device/renderer.h"
#include "render/plan/pass.h"
#include "server/openapi/strict.h"

#define TEXTS KD_SCHEMA_LIST(KD_SCHEMA_TEXT)

static const char *engine(size_t i) { return i < KD_ENGINE_COUNT ? kd_engine_name((enum kd_engine)i) : NULL; }
static const char *precision(size_t i)
{
    return i <= KD_PRECISION_F64 ? kd_precision_name((enum kd_precision)i) : NULL;
}
static const char *pass_name(size_t i) { return i < KD_PASS_COUNT ? kd_passes[i].name : NULL; }

static void add_device(struct kd_json *json)
{
    static const struct kd_openapi_member selftest[] = {
        { "result", "{\"enum\":[\"passed\",\"failed\",\"not run\"]}", false },
        { "checks", KD_SCHEMA_COUNT, true },
        { "failed", KD_SCHEMA_COUNT, true },
        { "seconds", KD_SCHEMA_NUMBER, true },
        { "now", KD_SCHEMA_BOOL, true },
        { "first_failure", KD_SCHEMA_TEXT, true },
    };
    static const struct kd_openapi_member limits[] = {
        { "heap_bytes", KD_SCHEMA_COUNT, false },       { "memory_bytes", KD_SCHEMA_COUNT, false },
        { "memory_by", KD_SCHEMA_TEXT, false },         { "binding_bytes", KD_SCHEMA_COUNT, false },
        { "allocation_bytes", KD_SCHEMA_COUNT, false }, { "workgroups", KD_SCHEMA_COUNT, false },
        { "subgroup_size", KD_SCHEMA_COUNT, false },
    };
    static const struct kd_openapi_member device[] = {
        { "kerrd", KD_SCHEMA_TEXT, false },
        { "name", KD_SCHEMA_TEXT, false },
        { "type", NULL, false, kd_renderer_type_name },
        { "driver", KD_SCHEMA_TEXT, false },
        { "driver_info", KD_SCHEMA_TEXT, false },
        { "vulkan", KD_SCHEMA_TEXT, false },
        { "index", KD_SCHEMA_COUNT, false },
        { "choice", KD_SCHEMA_TEXT, false },
        { "precision", KD_SCHEMA_LIST(KD_SCHEMA_REF("Precision")), false },
        { "float64_hardware", KD_SCHEMA_BOOL, false },
        { "timestamps", KD_SCHEMA_BOOL, false },
        { "selftest", KD_SCHEMA_REF("DeviceSelftest"), false },
        { "limits", KD_SCHEMA_REF("DeviceLimits"), false },
        { "ns_per_item", KD_SCHEMA_REF("DeviceFigures"), false },
    };
    struct kd_openapi_member figures[1 + KD_FIGURE_COUNT] = { { "basis", "{\"enum\":[\"measured\",\"guess\"]}",
                                                                false } };
    for (int i = 0; i < KD_FIGURE_COUNT; i++)
        figures[1 + i] = (struct kd_openapi_member) { kd_figures[i].word, KD_SCHEMA_NUMBER, false };
    kd_schema_enum(json, "Precision", precision);
    KD_OPENAPI_STRICT(json, "DeviceSelftest", selftest);
    KD_OPENAPI_STRICT(json, "DeviceLimits", limits);
    KD_OPENAPI_STRICT(json, "DeviceFigures", figures);
    KD_OPENAPI_STRICT(json, "Device", device);
}

static void add_lists(struct kd_json *json)
{
    static const struct kd_openapi_member preset[] = { { "name", KD_SCHEMA_TEXT, false },
                                                       { "label", KD_SCHEMA_TEXT, false },
                                                       { "title", KD_SCHEMA_TEXT, false } };
    static const struct kd_openapi_member presets[] = { { "presets", KD_SCHEMA_LIST(KD_SCHEMA_REF("PresetTold")),
                                                          false } };
    static const struct kd_openapi_member parameter[] = {
        { "name", KD_SCHEMA_TEXT, false },    { "unit", KD_SCHEMA_TEXT, true },  { "default", KD_SCHEMA_TEXT, false },
        { "allowed", KD_SCHEMA_TEXT, false }, { "help", KD_SCHEMA_TEXT, false },
    };
    static const struct kd_openapi_member output[] = { { "name", KD_SCHEMA_TEXT, false },
                                                       { "unit", KD_SCHEMA_TEXT, false },
                                                       { "help", KD_SCHEMA_TEXT, false } };
    static const struct kd_openapi_member quantity[] = {
        { "name", KD_SCHEMA_TEXT, false },
        { "summary", KD_SCHEMA_TEXT, false },
        { "parameters", KD_SCHEMA_LIST(KD_SCHEMA_REF("QuantityParameter")), false },
        { "outputs", KD_SCHEMA_LIST(KD_SCHEMA_REF("QuantityOutput")), false },
        { "sources", TEXTS, false },
        { "approximations", TEXTS, false },
    };
    static const struct kd_openapi_member quantities[] = { { "quantities",
                                                             KD_SCHEMA_LIST(KD_SCHEMA_REF("QuantityTold")), false } };
    static const struct kd_openapi_member approximation[] = { { "name", KD_SCHEMA_TEXT, false },
                                                              { "of", KD_SCHEMA_TEXT, false },
                                                              { "sentence", KD_SCHEMA_TEXT, false } };
    static const struct kd_openapi_member approximations[] = {
        { "approximations", KD_SCHEMA_LIST(KD_SCHEMA_REF("Approximation")), false }
    };
    KD_OPENAPI_STRICT(json, "Approximation", approximation);
    KD_OPENAPI_STRICT(json, "Approximations", approximations);
    KD_OPENAPI_STRICT(json, "PresetTold", preset);
    KD_OPENAPI_STRICT(json, "Presets", presets);
    KD_OPENAPI_STRICT(json, "QuantityParameter", parameter);
    KD_OPENAPI_STRICT(json, "QuantityOutput", output);
    KD_OPENAPI_STRICT(json, "QuantityTold", quantity);
    KD_OPENAPI_STRICT(json, "Quantities", quantities);
}

static void add_plan(struct kd_json *json)
{
    static const struct kd_openapi_member pass[] = {
        { "name", NULL, false, pass_name },
        { "kernel", KD_SCHEMA_TEXT, true },
        { "invocations", KD_SCHEMA_COUNT, false },
        { "estimate_ms", KD_SCHEMA_NUMBER, false },
    };
    static const struct kd_openapi_member constants[] = {
        { "orders", KD_SCHEMA_COUNT, false },  { "steps", KD_SCHEMA_COUNT, false },
        { "samples", KD_SCHEMA_COUNT, false }, { "radius_only", KD_SCHEMA_BOOL, false },
        { "phi", KD_SCHEMA_BOOL, false },      { "sky", KD_SCHEMA_BOOL, false },
    };
    static const struct kd_openapi_member accuracy[] = {
        { "engine", NULL, false, engine },
        { "precision", NULL, false, precision },
        { "steps", KD_SCHEMA_COUNT, false },
        { "holds", KD_SCHEMA_NUMBER, true },
        { "table", "{\"enum\":[\"measured\",\"built-in\"]}", false },
    };
    static const struct kd_openapi_member bytes[] = { { "lens_map", KD_SCHEMA_COUNT, false },
                                                      { "device", KD_SCHEMA_COUNT, false },
                                                      { "host", KD_SCHEMA_COUNT, false } };
    static const struct kd_openapi_member plan[] = {
        { "rays", KD_SCHEMA_COUNT, false },
        { "critical_pixels", KD_SCHEMA_COUNT, false },
        { "critical_rays", KD_SCHEMA_COUNT, false },
        { "width", KD_SCHEMA_COUNT, false },
        { "height", KD_SCHEMA_COUNT, false },
        { "eyes", KD_SCHEMA_COUNT, true },
        { "strips", KD_SCHEMA_COUNT, true },
        { "passes", KD_SCHEMA_LIST(KD_SCHEMA_REF("PlanPass")), false },
        { "specialisation", KD_SCHEMA_REF("PlanConstants"), false },
        { "accuracy", KD_SCHEMA_REF("PlanAccuracy"), false },
        { "bytes", KD_SCHEMA_REF("PlanBytes"), false },
        { "bands", KD_SCHEMA_COUNT, false },
        { "lens_map_cacheable", KD_SCHEMA_BOOL, false },
        { "lens_map_key", KD_SCHEMA_TEXT, false },
        { "kernels_ms", KD_SCHEMA_NUMBER, true },
        { "estimate_ms", KD_SCHEMA_NUMBER, false },
        { "estimate_basis", "{\"enum\":[\"measured\",\"guess\"]}", false },
        { "approximations", TEXTS, false },
    };
    static const struct kd_openapi_member sweep_bytes[] = { { "device", KD_SCHEMA_COUNT, false },
                                                            { "host", KD_SCHEMA_COUNT, false },
                                                            { "files", KD_SCHEMA_COUNT, true } };
    static const struct kd_openapi_member sweep[] = {
        { "scenes", KD_SCHEMA_COUNT, false },
        { "lens_maps", KD_SCHEMA_COUNT, false },
        { "rays", KD_SCHEMA_COUNT, false },
        { "bytes", KD_SCHEMA_REF("SweepBytes"), false },
        { "estimate_ms", KD_SCHEMA_NUMBER, false },
        { "shared_ms", KD_SCHEMA_NUMBER, false },
        { "estimate_basis", "{\"enum\":[\"measured\",\"guess\"]}", false },
        { "axes",
          "{\"type\":\"object\",\"additionalProperties\":" KD_SCHEMA_LIST(
              "{\"type\":[\"number\",\"string\",\"boolean\",\"array\"],\"items\":{\"type\":\"string\"}}") "}",
          false },
    };
    KD_OPENAPI_STRICT(json, "PlanPass", pass);
    KD_OPENAPI_STRICT(json, "PlanConstants", constants);
    KD_OPENAPI_STRICT(json, "PlanAccuracy", accuracy);
    KD_OPENAPI_STRICT(json, "PlanBytes", bytes);
    KD_OPENAPI_STRICT(json, "Plan", plan);
    KD_OPENAPI_STRICT(json, "SweepBytes", sweep_bytes);
    KD_OPENAPI_STRICT(json, "SweepPlan", sweep);
}

/* Writes the schema of the accuracy table. In each set of rays, the errors are members with the names of the
 * quantities. */
static void add_accuracy(struct kd_json *json)
{
    static const struct kd_openapi_member errors[] = { { "median", KD_SCHEMA_NUMBER, true },
                                                       { "p99", KD_SCHEMA_NUMBER, true },
                                                       { "worst", KD_SCHEMA_NUMBER, true } };
    static const char entry[] =
        "{\"type\":\"object\",\"required\":[\"rays\",\"crossings\",\"differ\"],\"properties\":{\"rays_per_"
        "s\":" KD_SCHEMA_NUMBER ",\"rays_per_s_per_core\":" KD_SCHEMA_NUMBER ",\"rays\":" KD_SCHEMA_COUNT
        ",\"crossings\":" KD_SCHEMA_COUNT ",\"differ\":" KD_SCHEMA_COUNT
        "},\"additionalProperties\":" KD_SCHEMA_REF("AccuracyErrors") "}";
    static const struct kd_openapi_member row[] = {
        { "engine", NULL, false, engine },
        { "precision", NULL, false, precision },
        { "steps", KD_SCHEMA_COUNT, false },
        { "holds", KD_SCHEMA_NUMBER, true },
        { "sets", "{\"type\":\"object\",\"additionalProperties\":" KD_SCHEMA_REF("AccuracyEntry") "}", false },
    };
    static const struct kd_openapi_member table[] = {
        { "format", KD_SCHEMA_COUNT, false },
        { "kerrd", KD_SCHEMA_TEXT, false },
        { "date", KD_SCHEMA_TEXT, false },
        { "command", KD_SCHEMA_TEXT, false },
        { "machine", KD_SCHEMA_TEXT, false },
        { "device", KD_SCHEMA_TEXT, false },
        { "cores", KD_SCHEMA_COUNT, false },
        { "clock", "{\"enum\":[\"device\",\"host\"]}", false },
        { "quick", KD_SCHEMA_BOOL, false },
        { "seconds", KD_SCHEMA_NUMBER, true },
        { "skipped", KD_SCHEMA_TEXT, false },
        { "reference", KD_SCHEMA_TEXT, false },
        { "orders", KD_SCHEMA_COUNT, false },
        { "quantile", KD_SCHEMA_NUMBER, false },
        { "sets", "{\"type\":\"object\",\"additionalProperties\":" KD_SCHEMA_TEXT "}", false },
        { "rows", KD_SCHEMA_LIST(KD_SCHEMA_REF("AccuracyRow")), false },
    };
    KD_OPENAPI_STRICT(json, "AccuracyErrors", errors);
    kd_json_raw(json, "AccuracyEntry", entry, sizeof entry - 1);
    KD_OPENAPI_STRICT(json, "AccuracyRow", row);
    KD_OPENAPI_STRICT(json, "AccuracyTable", table);
}

void kd_openapi_report_schemas(struct kd_json *json)
{
    add_device(json);
    add_lists(json);
    add_plan(json);
    add_accuracy(json);
}
