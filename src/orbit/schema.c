#include "orbit/schema.h"

#include "base/schema.h"
#include "orbit/fields.h"
#include "orbit/request.h"

#include <stdio.h>
#include <string.h>

static void add_range(struct kd_json *json, const struct kd_orbit_field *f)
{
    double least = f->bound == KD_BOUND_RADIUS ? 1 : f->bound == KD_BOUND_POSITIVE ? 0 : f->least;
    bool above = f->open == KD_OPEN || f->bound == KD_BOUND_RADIUS;
    kd_json_string(json, "type", f->kind == KD_FIELD_IS_INT ? "integer" : "number");
    kd_json_number(json, above ? "exclusiveMinimum" : "minimum", least);
    kd_json_number(json, f->open ? "exclusiveMaximum" : "maximum", f->most);
    if (f->bound == KD_BOUND_NOT_ONE)
        kd_schema_text(json, "not", "{\"const\":1}");
}

static void add_field(struct kd_json *json, const struct kd_orbit_field *f)
{
    kd_json_object(json, f->name);
    if (f->kind == KD_FIELD_IS_BOOL) {
        kd_json_string(json, "type", "boolean");
    } else if (f->kind == KD_FIELD_IS_WORD) {
        kd_json_array(json, "enum");
        for (int i = 0; kd_orbit_field_word(f, i); i++)
            kd_json_string(json, NULL, kd_orbit_field_word(f, i));
        kd_json_end(json);
    } else {
        add_range(json, f);
    }
    kd_json_string(json, "description", f->help);
    kd_json_end(json);
}

/* A selection of rows of a table. */
struct rows {
    const struct kd_orbit_field *fields;
    size_t n;
    enum kd_orbit_form form; /* rows of this form, and those of any; KD_ORBIT_FORMS: all */
};

static bool is_of(const struct rows *rows, const struct kd_orbit_field *f)
{
    return rows->form == KD_ORBIT_FORMS || f->form == KD_ORBIT_FORMS || f->form == rows->form;
}

/* True for the first selected row of its section; "" is the section of the document itself. */
static bool is_first_of_section(const struct rows *rows, const struct kd_orbit_field *f)
{
    for (const struct kd_orbit_field *g = rows->fields; g < f; g++)
        if (is_of(rows, g) && !strcmp(g->section, f->section))
            return false;
    return is_of(rows, f);
}

static bool needs(const struct rows *rows, const char *section)
{
    for (size_t i = 0; i < rows->n; i++)
        if (is_of(rows, &rows->fields[i]) && rows->fields[i].needed && !strcmp(rows->fields[i].section, section))
            return true;
    return false;
}

static void begin_object(struct kd_json *json, const char *name)
{
    kd_json_object(json, name);
    kd_json_string(json, "type", "object");
    kd_json_bool(json, "additionalProperties", false);
}

static void add_required(struct kd_json *json, const struct rows *rows, const char *section)
{
    if (!needs(rows, section) && *section)
        return;
    kd_json_array(json, "required");
    for (size_t i = 0; i < rows->n; i++) {
        const struct kd_orbit_field *f = &rows->fields[i];
        if (!strcmp(f->section, section) && is_of(rows, f) && f->needed)
            kd_json_string(json, NULL, f->name);
        else if (!*section && *f->section && is_first_of_section(rows, f) && needs(rows, f->section))
            kd_json_string(json, NULL, f->section);
    }
    kd_json_end(json);
}

static void add_members(struct kd_json *json, const struct rows *rows, const char *section)
{
    for (size_t i = 0; i < rows->n; i++)
        if (is_of(rows, &rows->fields[i]) && !strcmp(rows->fields[i].section, section))
            add_field(json, &rows->fields[i]);
}

/* Combinations of settings that a section forbids, as JSON Schema. A duration has one length; or_end is for
 * durations without periods. An observer needs a place. */
static const struct {
    const char *section, *not;
} apart[] = {
    { "duration", "{\"anyOf\":[{\"required\":[\"periods\",\"time\"]},{\"required\":[\"or_end\"],\"properties\":{\"or_"
                  "end\":{\"const\":true}},\"not\":{\"required\":[\"periods\"]}}]}" },
    { "seen",
      "{\"not\":{\"required\":[\"observer_inclination_deg\"]},\"anyOf\":[{\"required\":[\"observer_r\"]},"
      "{\"required\":[\"observer_azimuth_deg\"],\"properties\":{\"observer_azimuth_deg\":{\"not\":{\"const\":0}}}},"
      "{\"required\":[\"observer\"],\"properties\":{\"observer\":{\"not\":{\"const\":\"static\"}}}}]}" },
};

static void add_section(struct kd_json *json, const struct rows *rows, const char *section)
{
    begin_object(json, section);
    add_required(json, rows, section);
    for (size_t i = 0; i < sizeof apart / sizeof *apart; i++)
        if (!strcmp(apart[i].section, section))
            kd_schema_text(json, "not", apart[i].not);
    kd_json_object(json, "properties");
    add_members(json, rows, section);
    kd_json_end(json);
    kd_json_end(json);
}

static void add_sections(struct kd_json *json, const struct rows *rows)
{
    for (size_t i = 0; i < rows->n; i++)
        if (*rows->fields[i].section && is_first_of_section(rows, &rows->fields[i]))
            add_section(json, rows, rows->fields[i].section);
}

static const char *const forms[KD_ORBIT_FORMS] = { [KD_ORBIT_SHAPE] = "OrbitByShape",
                                                   [KD_ORBIT_CONSTANTS] = "OrbitByConstants",
                                                   [KD_ORBIT_STATE] = "OrbitByState",
                                                   [KD_ORBIT_CASE] = "OrbitByCase" };

void kd_orbit_schemas(struct kd_json *json)
{
    for (int form = 0; form < KD_ORBIT_FORMS; form++) {
        const struct rows rows = { kd_orbit_fields, KD_ORBIT_N_FIELDS, (enum kd_orbit_form)form };
        begin_object(json, forms[form]);
        add_required(json, &rows, "");
        kd_json_object(json, "properties");
        add_members(json, &rows, "");
        add_sections(json, &rows);
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
    const struct rows rows = { kd_orbit_settings, KD_ORBIT_N_SETTINGS, KD_ORBIT_FORMS };
    begin_object(json, name);
    /* A request has either orbit or orbits. This is not a oneOf, because client generators would turn that into a
     * union instead of a class with the fields. */
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
    add_members(json, &rows, "");
    add_sections(json, &rows);
    add_orbits(json, KD_SCHEMA_REF("Orbit"));
    kd_json_end(json);
    kd_json_end(json);
}
