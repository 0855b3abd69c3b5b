/* Writes answers as JSON, CSV and NPY, and the schema of the JSON form. */
#include "base/decimal.h"
#include "base/pause.h"
#include "base/schema.h"
#include "image/npy.h"
#include "image/zip.h"
#include "integral/answer.h"
#include "integral/compare.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static size_t count(const struct kd_integral_column *list, size_t most)
{
    size_t n = 0;
    while (n < most && list[n].name)
        n++;
    return n;
}

/* Writes the sentences of a NULL-terminated list, then n further sentences. */
static void write_sentences(struct kd_json *json, const char *name, const char *const *sentences,
                            const char *const *more, size_t n)
{
    kd_json_array(json, name);
    for (; *sentences; sentences++)
        kd_json_string(json, NULL, *sentences);
    for (size_t i = 0; i < n; i++)
        kd_json_string(json, NULL, more[i]);
    kd_json_end(json);
}

static enum kd_status write_scene(struct kd_json *json, const struct kd_scene *scene)
{
    struct kd_buffer text = { 0 };
    enum kd_status status = kd_scene_to_json(scene, &text);
    if (!status)
        kd_json_raw(json, "scene", (const char *)text.data, text.size);
    kd_buffer_finish(&text);
    return status;
}

/* Writes the parameters, except lists, which are columns of the answer. */
static void write_parameters(struct kd_json *json, const struct kd_integral_request *request)
{
    const struct kd_document document = kd_integral_document(request->what);
    kd_json_object(json, "parameters");
    kd_document_write(json, &document, request);
    kd_json_end(json);
}

static void write_units(struct kd_json *json, const struct kd_integral_kind_of *kind, const char *light)
{
    kd_json_object(json, "units");
    for (size_t i = 0; i < count(kind->values, KD_INTEGRAL_VALUES); i++)
        kd_json_string(json, kind->values[i].name, kind->values[i].unit ? kind->values[i].unit : light);
    for (size_t i = 0; i < count(kind->columns, KD_INTEGRAL_COLUMNS); i++)
        kd_json_string(json, kind->columns[i].name, kind->columns[i].unit ? kind->columns[i].unit : light);
    kd_json_end(json);
}

/* Lists the sources that only some requests of a kind need. Returns the number of these sources. */
enum { MORE_SOURCES = 2 + KD_HOLE_MORE_COUNT };
static size_t more_sources(const struct kd_integral_request *r, const char *out[MORE_SOURCES])
{
    size_t n = 0;
    if (r->what == KD_INTEGRAL_SPECTRUM && (r->polarized || r->returning == KD_INTEGRAL_SCATTERED))
        out[n++] =
            "S. Chandrasekhar 1960, Radiative Transfer, 68 and 70; J. D. Schnittman & J. H. Krolik 2009, ApJ 701, "
            "1175 (polarisation, scattered light)";
    if (r->what == KD_INTEGRAL_SPECTRUM && r->returning == KD_INTEGRAL_ABSORBED)
        out[n++] = "C. T. Cunningham 1976, ApJ 208, 534 (returning light)";
#define MORE(x, name, member, least, most, shown, unit, card, what, bound, help, source, ...) \
    if (r->name != 0 || (r->scene && r->scene->spacetime.name != 0)) \
        out[n++] = source;
    KD_HOLE_MORE(MORE, )
#undef MORE
    return n;
}

/* Writes an answer as JSON. columns: true if the document has the columns. */
static enum kd_status write_json(const struct kd_integral_answer *answer, bool columns, struct kd_buffer *out)
{
    const struct kd_integral_kind_of *kind = kd_integral_kind_of(answer->request->what);
    const int digits = (int)answer->request->digits;
    struct kd_json json = kd_json_begin(out);
    kd_json_object(&json, NULL);
    kd_json_string(&json, "integral", kd_integral_name(answer->request->what));
    enum kd_status status = answer->request->scene ? write_scene(&json, answer->request->scene) : KD_OK;
    write_parameters(&json, answer->request);
    kd_json_object(&json, "values");
    for (size_t i = 0; i < count(kind->values, KD_INTEGRAL_VALUES); i++)
        kd_json_number(&json, kind->values[i].name, answer->values[i]);
    kd_json_end(&json);
    if (columns)
        kd_json_object(&json, "columns");
    for (size_t i = 0; columns && i < count(kind->columns, KD_INTEGRAL_COLUMNS); i++) {
        kd_json_array(&json, kind->columns[i].name);
        for (size_t row = 0; row < answer->rows; row++) {
            kd_pause_every(row, 1024);
            const char *word = kind->columns[i].words ? kd_integral_word(answer, i, answer->columns[i][row]) : NULL;
            if (word)
                kd_json_string(&json, NULL, word);
            else
                kd_json_number(&json, NULL, kd_decimal_round(answer->columns[i][row], digits));
        }
        kd_json_end(&json);
    }
    if (columns)
        kd_json_end(&json);
    if (answer->request->what == KD_INTEGRAL_COMPARE)
        kd_integral_compare_write(&json, answer);
    if (answer->request->what == KD_INTEGRAL_SETS)
        kd_integral_sets_write(&json, answer);
    if (kd_integral_is_observed(answer->request->what))
        kd_integral_observation_write(&json, answer->request);
    write_units(&json, kind, answer->light);
    const char *more[MORE_SOURCES];
    write_sentences(&json, "sources", kind->sources, more, more_sources(answer->request, more));
    write_sentences(&json, "approximations", kind->approximations, answer->told, answer->n_told);
    kd_json_end(&json);
    enum kd_status written = kd_json_finish_line(&json);
    return status ? status : written;
}

static enum kd_status write_csv(const struct kd_integral_answer *answer, struct kd_buffer *out)
{
    const struct kd_integral_kind_of *kind = kd_integral_kind_of(answer->request->what);
    size_t n = count(kind->columns, KD_INTEGRAL_COLUMNS);
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < n; i++)
        KD_TRY(kd_buffer_printf(out, "%s%s", i ? "," : "", kind->columns[i].name));
    for (size_t row = 0; row < answer->rows; row++)
        for (size_t i = 0; i < n; i++) {
            kd_pause_every(row, 1024);
            char number[1 + KD_DECIMAL_SIZE] = { i ? ',' : '\n' };
            double value = kd_decimal_round(answer->columns[i][row], (int)answer->request->digits);
            const char *word = kind->columns[i].words ? kd_integral_word(answer, i, value) : NULL;
            if (word) {
                KD_TRY(kd_buffer_printf(out, "%c%s", *number, word));
                continue;
            }
            KD_TRY(kd_buffer_append(out, number, 1 + (isfinite(value) ? kd_decimal_print(number + 1, value) : 0)));
        }
    KD_TRY(kd_buffer_printf(out, "\n"));
done:
    return status;
}

static enum kd_status write_npy(const struct kd_integral_answer *answer, struct kd_buffer *out)
{
    const struct kd_integral_kind_of *kind = kd_integral_kind_of(answer->request->what);
    struct kd_npy array = { .n_fields = count(kind->columns, KD_INTEGRAL_COLUMNS),
                            .shape = { answer->rows },
                            .n_dimensions = 1 };
    enum kd_status status;
    for (size_t i = 0; i < array.n_fields; i++)
        snprintf(array.fields[i].name, sizeof array.fields[i].name, "%s", kind->columns[i].name);
    KD_TRY(kd_npy_write_header(&array, out));
    for (size_t row = 0; row < answer->rows; row++)
        for (size_t i = 0; i < array.n_fields; i++)
            KD_TRY(kd_buffer_append(out, &answer->columns[i][row], sizeof(double)));
done:
    return status;
}

/* Length of the longest word of a column; 0 if the column has numbers. */
static size_t longest_word(const struct kd_integral_answer *answer, size_t column)
{
    size_t longest = 0;
    for (size_t row = 0; row < answer->rows; row++) {
        const char *word = kd_integral_word(answer, column, answer->columns[column][row]);
        longest = word && strlen(word) > longest ? strlen(word) : longest;
    }
    return longest;
}

/* Writes a column as a .npy file: float64, or text in UTF-32. */
static enum kd_status column_npy(const struct kd_integral_answer *answer, size_t column, struct kd_buffer *out)
{
    const struct kd_integral_column *of = &kd_integral_kind_of(answer->request->what)->columns[column];
    const size_t longest = of->words ? longest_word(answer, column) + 1 : 0;
    const struct kd_npy array = { .n_fields = 1,
                                  .fields = { { .type = of->words ? KD_NPY_TEXT : KD_NPY_F8,
                                                .count = (uint32_t)longest } },
                                  .shape = { answer->rows },
                                  .n_dimensions = 1 };
    enum kd_status status;
    KD_TRY(kd_npy_write_header(&array, out));
    for (size_t row = 0; row < answer->rows; row++) {
        const double value = answer->columns[column][row];
        const char *word = of->words ? kd_integral_word(answer, column, value) : NULL;
        kd_pause_every(row, 1024);
        if (!of->words)
            KD_TRY(kd_buffer_append(out, &value, sizeof value));
        for (size_t i = 0; i < longest; i++) {
            const size_t length = word ? strlen(word) : 0;
            KD_TRY(kd_buffer_append(out, (const uint8_t[4]) { i < length ? (uint8_t)word[i] : 0 }, 4));
        }
    }
done:
    return status;
}

/* Writes a .npz file as numpy.savez does: an array for each column, and answer.json with the rest of the answer. */
static enum kd_status write_npz(const struct kd_integral_answer *answer, struct kd_buffer *out)
{
    const struct kd_integral_kind_of *kind = kd_integral_kind_of(answer->request->what);
    struct kd_buffer member = { 0 };
    struct kd_zip *zip = NULL;
    enum kd_status status;
    KD_TRY(kd_zip_create(out, true, &zip));
    for (size_t i = 0; i < count(kind->columns, KD_INTEGRAL_COLUMNS); i++) {
        char name[60];
        snprintf(name, sizeof name, "%s.npy", kind->columns[i].name);
        kd_buffer_finish(&member);
        KD_TRY(column_npy(answer, i, &member));
        KD_TRY(kd_zip_add(zip, name, member.data, member.size));
    }
    kd_buffer_finish(&member);
    KD_TRY(write_json(answer, false, &member));
    KD_TRY(kd_zip_add(zip, "answer.json", member.data, member.size));
    KD_TRY(kd_zip_close(zip));
done:
    kd_zip_destroy(zip);
    kd_buffer_finish(&member);
    return status;
}

enum kd_status kd_integral_check_format(const struct kd_integral_request *r, enum kd_integral_format format,
                                        struct kd_error *error)
{
    if (format != KD_INTEGRAL_UVFITS || r->file)
        return KD_OK;
    return kd_error_field(
        error, "/observation",
        "observation is a CSV, which has no positions of stations; for uvfits it must be a uvfits file");
}

enum kd_status kd_integral_write(const struct kd_integral_answer *answer, enum kd_integral_format format,
                                 struct kd_buffer *out)
{
    switch (format) {
    case KD_INTEGRAL_CSV:
        return answer->request->what == KD_INTEGRAL_OBSERVE ? kd_integral_observe_csv(answer, out)
                                                            : write_csv(answer, out);
    case KD_INTEGRAL_NPY: return write_npy(answer, out);
    case KD_INTEGRAL_NPZ: return write_npz(answer, out);
    case KD_INTEGRAL_UVFITS: return kd_buffer_append(out, answer->request->file, answer->request->file_size);
    case KD_INTEGRAL_JSON: break;
    }
    return write_json(answer, true, out);
}

#define SYSTEMATIC \
    "{\"type\":\"object\",\"additionalProperties\":false,\"properties\":{\"visibility\":{\"type\":\"number\"}," \
    "\"amplitude\":{\"type\":\"number\"},\"closure_phase_deg\":{\"type\":\"number\"}},\"required\":[" \
    "\"visibility\",\"amplitude\",\"closure_phase_deg\"]}"
#define STRINGS "{\"type\":\"array\",\"items\":{\"type\":\"string\"}}"

static void raw(struct kd_json *json, const char *name, const char *text)
{
    kd_json_raw(json, name, text, strlen(text));
}

/* Writes an object schema that has a member of the given type for each item of the list. */
static void add_listed(struct kd_json *json, const char *name, const struct kd_integral_column *list, size_t n,
                       const char *type)
{
    const char *names[KD_INTEGRAL_COLUMNS];
    kd_schema_begin_strict(json, name);
    for (size_t i = 0; i < n; i++) {
        kd_json_object(json, names[i] = list[i].name);
        kd_json_string(json, "description", list[i].help);
        raw(json, "type", type);
        if (!strcmp(type, "\"array\""))
            raw(json, "items", list[i].words ? "{\"type\":[\"string\",\"null\"]}" : "{\"type\":[\"number\",\"null\"]}");
        kd_json_end(json);
    }
    kd_schema_end_strict(json, names, n);
}

static void add_parameters(struct kd_json *json, enum kd_integral what)
{
    const char *names[64];
    size_t n = 0;
    kd_schema_begin_strict(json, "parameters");
    for (size_t i = 0; i < kd_n_integral_fields && n < 64; i++) {
        const struct kd_row *f = &kd_integral_fields[i];
        if (!(f->of & 1u << what) || f->kind == KD_KIND_LIST)
            continue;
        if (f->object) {
            names[n] = f->object;
            if (!n || strcmp(names[n - 1], names[n]))
                raw(json, names[n], SYSTEMATIC), n++;
            continue;
        }
        raw(json, names[n++] = f->name,
            f->kind == KD_KIND_WORD                     ? "{\"type\":\"string\"}"
            : f->kind == KD_KIND_WORDS                  ? STRINGS
            : f->words && kd_integral_leaves_open(what) ? "{\"type\":[\"number\",\"string\"]}"
                                                        : "{\"type\":\"number\"}");
    }
    kd_schema_end_strict(json, names, n);
}

void kd_integral_answer_schema(struct kd_json *json, const char *name, enum kd_integral what)
{
    static const char *const members[] = { "integral", "parameters",     "values", "columns",     "units",
                                           "sources",  "approximations", "scene",  "observation", "n",
                                           "chi2",     "chi2_finer",     "solved" };
    const size_t without = what == KD_INTEGRAL_COMPARE     ? 0
                           : what == KD_INTEGRAL_SETS      ? 3
                           : what == KD_INTEGRAL_OBSERVE   ? 4
                           : kd_integral_is_pictured(what) ? 5
                                                           : 6;
    const size_t n = sizeof members / sizeof *members - without;
    const struct kd_integral_kind_of *kind = kd_integral_kind_of(what);
    size_t values = count(kind->values, KD_INTEGRAL_VALUES), columns = count(kind->columns, KD_INTEGRAL_COLUMNS);
    kd_schema_begin_strict(json, name);
    kd_json_object(json, "integral");
    kd_json_string(json, "const", kd_integral_name(what));
    kd_json_end(json);
    add_parameters(json, what);
    add_listed(json, "values", kind->values, values, "[\"number\",\"null\"]");
    add_listed(json, "columns", kind->columns, columns, "\"array\"");
    raw(json, "units", "{\"type\":\"object\",\"additionalProperties\":{\"type\":\"string\"}}");
    raw(json, "sources", STRINGS);
    raw(json, "approximations", STRINGS);
    if (kd_integral_is_pictured(what))
        raw(json, "scene", "{\"$ref\":\"#/components/schemas/Scene\"}");
    if (what == KD_INTEGRAL_COMPARE)
        kd_integral_compare_schema(json);
    if (kd_integral_is_observed(what))
        kd_integral_observation_schema(json, kd_integral_is_compared(what));
    if (what == KD_INTEGRAL_SETS)
        kd_integral_sets_schema(json);
    kd_schema_end_strict(json, members, n);
}
