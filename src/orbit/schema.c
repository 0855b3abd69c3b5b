#include "orbit/schema.h"

#include "base/schema.h"
#include "orbit/fields.h"
#include "orbit/request.h"

#include <stdio.h>
#include <string.h>

static void begin_object(struct kd_json *json, const char *name)
{
    kd_json_object(json, name);
    kd_json_string(json, "type", "object");
    kd_json_bool(json, "additionalProperties", false);
}

static const char *const forms[KD_ORBIT_FORMS] = { [KD_ORBIT_SHAPE] = "OrbitByShape",
                                                   [KD_ORBIT_CONSTANTS] = "OrbitByConstants",
                                                   [KD_ORBIT_STATE] = "OrbitByState",
                                                   [KD_ORBIT_CASE] = "OrbitByCase" };

void kd_orbit_schemas(struct kd_json *json)
{
    for (int form = 0; form < KD_ORBIT_FORMS; form++) {
        struct kd_document document = kd_orbit_document;
        document.of = 1u << form;
        begin_object(json, forms[form]);
        kd_document_required(json, &document);
        kd_json_object(json, "properties");
        kd_document_properties(json, &document);
        kd_json_end(json);
        kd_json_end(json);
    }
    kd_json_object(json, "Orbit");
    kd_json_array(json, "oneOf");
    for (int form = 0; form < KD_ORBIT_FORMS; form++) {
        char to[60];
        snprintf(to, sizeof to, "#/components/schemas/%s", forms[form]);
        kd_json_object(json, NULL);
        kd_json_string(json, "$ref", to);
        kd_json_end(json);
    }
    kd_json_end(json);
    kd_json_end(json);
}

static void add_orbits(struct kd_json *json, const char *orbit)
{
    kd_schema_text(json, "orbit", orbit);
    kd_json_object(json, "orbits");
    kd_json_string(json, "type", "array");
    kd_json_number(json, "minItems", 1);
    kd_json_number(json, "maxItems", KD_ORBITS_MAX);
    kd_schema_text(json, "items", orbit);
    kd_json_end(json);
}

void kd_orbit_request_schema(struct kd_json *json, const char *name)
{
    begin_object(json, name);
    /* A request must have exactly one of orbit and orbits. The schema does not express this by oneOf, because client
     * generators would make a union of it instead of a class with the fields. */
    kd_schema_text(json, "if", "{\"required\":[\"orbits\"]}");
    kd_schema_text(json, "then",
                   "{\"not\":{\"anyOf\":[{\"required\":[\"orbit\"]},{\"required\":[\"seen\"],\"properties\":{\"seen\":{"
                   "\"type\":\"object\",\"required\":[\"observer_inclination_deg\"]}}}]}}");
    kd_schema_text(json, "else",
                   "{\"required\":[\"orbit\"],\"not\":{\"required\":[\"samples\",\"seen\"],\"properties\":{\"samples\":"
                   "{\"type\":\"number\",\"exclusiveMinimum\":20000},"
                   "\"seen\":{\"type\":\"object\",\"required\":[\"observer_inclination_deg\"]}}}}");
    _Static_assert(KD_ORBIT_SEEN_MAX == 20000, "the schema says so");
    kd_json_object(json, "properties");
    kd_document_properties(json, &kd_orbit_request_document);
    add_orbits(json, KD_SCHEMA_REF("Orbit"));
    kd_json_end(json);
    kd_json_end(json);
}
