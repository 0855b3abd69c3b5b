#include "integral/table.h"

#include "image/fits.h"
#include "integral/image_cache.h"
#include "integral/integral_internal.h"
#include "integral/request.h"
#include "physics/disk/line_profile.h"
#include "physics/spacetime/kerr.h"
#include "document/number.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define REST_KEV 6.4 /* default energy of the line, keV: that of iron */
#define LEAST 0.05   /* default first edge divided by the line's energy; above 0, because it needs a logarithm */
#define ISCO "inner_isco"

/* Fields that may be axes, with their names in the file, which have at most twelve letters. The image of the disk
 * depends on the spin, on the hole's other parameters and on the inclination. */
static const struct {
    const char *field, *name;
} allowed[] = {
    { "spin", "spin" },
#define MORE(x, name, ...) { #name, #name },
    KD_HOLE_MORE(MORE, )
#undef MORE
        { "inclination_deg", "inclination" },
    { "inner", "inner" },
    { "outer", "outer" },
    { "index", "index" },
    { "outer_index", "outer_index" },
    { "break_r", "break_r" },
    { "height", "height" },
    { "photon_index", "photon_index" },
    { "corona_radius", "corona_radius" },
    { "corona_inner", "corona_inner" },
    { "corona_top", "corona_top" },
};
enum { IMAGE_AXES = 2 + KD_HOLE_MORE_COUNT };

/* Default axes, chosen so that interpolated profiles of r^-3 are within 0.3 % of the line (docs/xspec.md). All other
 * parameters of the emissivity have one value, unless the request gives them an axis. A table of this accuracy in
 * three dimensions would have at least 1e5 nodes. */
static const char *const defaults[KD_TABLE_DEFAULTS] = {
    "spin=0:0.6/11,0.64:0.8/5,0.82:0.9/5,0.91:0.95/5,0.955:0.98/6,0.9825:0.99/4,0.9916:0.998/5",
    "inclination_deg=5:25/41,25.3:40/50,40.2:50/50,50.16:65/93,65.13:80/115",
};

const char *const *kd_table_defaults(void) { return defaults; }

static const char *name_of(const struct kd_table_axis *axis)
{
    for (size_t i = 0; i < sizeof allowed / sizeof *allowed && !axis->isco; i++)
        if (!strcmp(allowed[i].field, axis->field->name))
            return allowed[i].name;
    return ISCO;
}

/* For an axis on which the image depends: number of such axes before it. For all other axes: IMAGE_AXES. */
static size_t rank_of(const struct kd_table_axis *axis)
{
    size_t i = 0;
    while (i < IMAGE_AXES && strcmp(allowed[i].field, axis->field->name))
        i++;
    return i;
}

static const char *given_name(const struct kd_table_axis *axis) { return axis->isco ? ISCO : axis->field->name; }

static double *field_at(struct kd_integral_request *request, const struct kd_table_axis *axis)
{
    return (double *)(void *)((char *)request + axis->field->offset);
}

/* The word of the bit mask `seen` that contains this field's bit. */
static uint64_t *seen_of(struct kd_integral_request *request, const struct kd_row *field)
{
    return &request->seen[(field - kd_integral_fields) / 64];
}

/* This field's bit in its word of `seen`. */
static uint64_t bit_of(const struct kd_row *field) { return UINT64_C(1) << (field - kd_integral_fields) % 64; }

static const struct kd_row *field_named(const struct kd_integral_request *request, const char *name)
{
    bool found = !strcmp(name, ISCO);
    for (size_t i = 0; i < sizeof allowed / sizeof *allowed; i++)
        found = found || !strcmp(name, allowed[i].field);
    return found ? kd_integral_field_named(request, strcmp(name, ISCO) ? name : "inner") : NULL;
}

/* Reads one number of an axis. Sets *rest to the text after the number. */
static enum kd_status read_number(const char *name, const char *text, double *out, const char **rest,
                                  struct kd_error *error)
{
    char pointer[40], copy[64];
    const size_t n = kd_number_span_typed(text, strlen(text));
    snprintf(pointer, sizeof pointer, "/%s", name);
    if (!n || n >= sizeof copy)
        return kd_error_field(error, pointer,
                              "the axis %s has \"%.40s\"; it must have numbers, as in %s=0,0.5,0.9 or %s=0:0.9/10",
                              name, text, name, name);
    snprintf(copy, sizeof copy, "%.*s", (int)n, text);
    *out = kd_number_parse(copy);
    *rest = text + n;
    return KD_OK;
}

/* Adds a value to an axis, rounded as the file stores it. The value must be in the range of the field and greater than
 * the value before. */
static enum kd_status add_value(struct kd_table_axis *axis, double value, struct kd_error *error)
{
    char pointer[40], text[KD_NUMBER_SIZE];
    const char *name = given_name(axis);
    const double stored = (double)(float)value, least = axis->isco ? 1 : axis->field->least;
    const bool open = axis->field->open && !axis->isco;
    snprintf(pointer, sizeof pointer, "/%s", name);
    kd_number_format(text, value);
    if (!(open ? stored > least && stored < axis->field->most : stored >= least && stored <= axis->field->most))
        return kd_error_field(error, pointer, "the axis %s has %s; it must be %s %.9g and %s %.9g", name, text,
                              open ? "above" : "at least", least, open ? "below" : "at most", axis->field->most);
    if (axis->log && !(stored > 0))
        return kd_error_field(error, pointer, "the axis %s has %s, which has no logarithm; it must be above 0", name,
                              text);
    if (axis->n && !(stored > axis->values[axis->n - 1]))
        return kd_error_field(error, pointer, "the axis %s has %s after %.9g; each must be larger than the one before",
                              name, text, axis->values[axis->n - 1]);
    if (axis->n == KD_TABLE_VALUES)
        return kd_error_field(error, pointer, "the axis %s has too many values (limit %d)", name, KD_TABLE_VALUES);
    axis->values[axis->n++] = stored;
    return KD_OK;
}

/* Reads one number, or a range START:STOP/COUNT, and adds its values to an axis. */
static enum kd_status read_values(struct kd_table_axis *axis, const char *text, const char **rest,
                                  struct kd_error *error)
{
    const char *const name = given_name(axis), *at;
    char pointer[40];
    double first, last, count = 0;
    enum kd_status status;
    snprintf(pointer, sizeof pointer, "/%s", name);
    KD_TRY(read_number(name, text, &first, &at, error));
    KD_TRY(add_value(axis, first, error));
    if (*at == ':') {
        KD_TRY(read_number(name, at + 1, &last, &at, error));
        if (*at == '/')
            KD_TRY(read_number(name, at + 1, &count, &at, error));
        if (!(count >= 2 && count <= KD_TABLE_VALUES && count == floor(count)))
            KD_TRY(kd_error_field(error, pointer,
                                  "the axis %s has \"%.60s\"; a range must be START:STOP/COUNT with a COUNT of 2 to %d",
                                  name, text, KD_TABLE_VALUES));
        if (axis->log && !(last > 0))
            KD_TRY(add_value(axis, last, error));
        for (int i = 1; i < (int)count; i++) {
            const double part = i / (count - 1);
            KD_TRY(add_value(axis,
                             i + 1 == (int)count ? last
                             : axis->log         ? first * pow(last / first, part)
                                                 : first + (last - first) * part,
                             error));
        }
    }
    if (*at && *at != ',')
        KD_TRY(kd_error_field(error, pointer,
                              "the axis %s has \"%.40s\" after a number; it must have numbers and ranges with commas",
                              name, at));
    *rest = at;
done:
    return status;
}

/* Reads an axis from the text FIELD=VALUES. VALUES are numbers and ranges separated by commas. The prefix "log:" makes
 * the axis logarithmic. */
static enum kd_status read_axis(const struct kd_integral_request *request, const char *text, struct kd_table_axis *axis,
                                struct kd_error *error)
{
    char name[32], pointer[40];
    enum kd_status status;
    const size_t length = strcspn(text, "=");
    snprintf(name, sizeof name, "%.*s", (int)length, text);
    snprintf(pointer, sizeof pointer, "/%s", name);
    *axis = (struct kd_table_axis) { .field = field_named(request, name), .isco = !strcmp(name, ISCO) };
    if (!axis->field)
        return kd_error_field(error, pointer,
                              "%s is no axis; it must be spin" KD_HOLE_MORE_NAMES
                              ", inclination_deg, inner, inner_isco, outer, index, "
                              "outer_index, break_r, height or photon_index",
                              name);
    const char *at = text + length + (text[length] == '=');
    axis->log = !strncmp(at, "log:", 4);
    at += axis->log ? 4 : 0;
    KD_TRY(read_values(axis, at, &at, error));
    while (*at == ',')
        KD_TRY(read_values(axis, at + 1, &at, error));
done:
    return status;
}

/* Adds an axis in order: axes on which the image depends come before the others. */
static enum kd_status add_axis(struct kd_table *table, const char *text, struct kd_error *error)
{
    struct kd_table_axis axis;
    size_t at = table->n_axes;
    const enum kd_status status = read_axis(&table->base, text, &axis, error);
    if (status)
        return status;
    char pointer[40];
    snprintf(pointer, sizeof pointer, "/%s", given_name(&axis));
    for (size_t i = 0; i < table->n_axes; i++)
        if (table->axes[i].field == axis.field)
            return kd_error_field(error, pointer, "%s has two axes; it must have one", axis.field->name);
    if (kd_integral_given(&table->base, axis.field->name))
        return kd_error_field(error, pointer, "%s has an axis and a value; it must have one of them", axis.field->name);
    for (size_t i = table->n_axes; i-- > 0;)
        if (rank_of(&table->axes[i]) > rank_of(&axis))
            at = i;
    memmove(table->axes + at + 1, table->axes + at, (table->n_axes++ - at) * sizeof *table->axes);
    table->axes[at] = axis;
    return KD_OK;
}

static enum kd_status add_defaults(struct kd_table *table, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    for (size_t k = 0; k < KD_TABLE_DEFAULTS; k++) {
        char name[32];
        bool there = false;
        snprintf(name, sizeof name, "%.*s", (int)strcspn(defaults[k], "="), defaults[k]);
        const struct kd_row *field = field_named(&table->base, name);
        for (size_t i = 0; i < table->n_axes; i++)
            there = there || table->axes[i].field == field;
        if (!there && !kd_integral_given(&table->base, field->name))
            KD_TRY(add_axis(table, defaults[k], error));
    }
done:
    return status;
}

/* Makes the checked request of a node. This request owns no memory. */
static enum kd_status node_of(const struct kd_table *table, size_t node, struct kd_integral_request *out,
                              struct kd_error *error)
{
    double over = 0;
    *out = table->base;
    for (size_t i = table->n_axes; i-- > 0; node /= table->axes[i].n) {
        const struct kd_table_axis *axis = &table->axes[i];
        const double value = axis->values[node % axis->n];
        if (axis->isco)
            over = value;
        else
            *field_at(out, axis) = value;
    }
    if (over > 0)
        out->inner = over * kd_kerr_isco(kd_integral_hole(out));
    return kd_integral_request_check(out, error);
}

/* Fields that define bins of equal widths, in place of the list `edges`. */
static const char *const even[] = { "energy_min", "energy_max", "bins" };

/* Sets the default energies, in keV. They begin above 0 and cover the range about the line of iron. */
static enum kd_status set_energies(struct kd_table *table, struct kd_error *error)
{
    struct kd_integral_request *base = &table->base;
    if (base->energy)
        return kd_error_field(error, "/counts",
                              "counts is energy; it must be photons, because an additive table has numbers of photons");
    if (!kd_integral_given(base, "rest_energy"))
        base->rest_energy = REST_KEV;
    if (!kd_integral_given(base, "energy_min"))
        base->energy_min = LEAST * base->rest_energy;
    struct kd_integral_request first = *base; /* a request with the values of the first node */
    enum kd_status status = node_of(table, 0, &first, error);
    base->edges = first.edges;
    if (status)
        return status;
    base->bins = first.bins;
    for (size_t i = 0; i < sizeof even / sizeof *even; i++)
        *seen_of(base, kd_integral_field_named(base, even[i])) &= ~bit_of(kd_integral_field_named(base, even[i]));
    for (size_t i = 0; i <= base->bins; i++)
        base->edges.at[i] = (double)(float)base->edges.at[i];
    if (!(base->edges.at[0] > 0))
        return kd_error_field(error, "/energy_min", "the first edge is %.9g; it must be above 0 in a table",
                              base->edges.at[0]);
    return kd_integral_check_growth(&base->edges, "edges", error);
}

enum kd_status kd_table_init(struct kd_table *table, struct kd_integral_request *request, const char *const *axes,
                             size_t n_axes, const char *name, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    struct kd_integral_request node;
    char pointer[40];
    *table = (struct kd_table) { .base = *request, .nodes = 1, .run = 1 };
    *request = (struct kd_integral_request) { .what = request->what };
    snprintf(table->name, sizeof table->name, "%s", name);
    if (!(table->axes = calloc(KD_TABLE_AXES + 1, sizeof *table->axes)))
        return kd_error_set(error, KD_ENOMEM, "out of memory for the axes of a table");
    for (size_t i = 0; i < n_axes && i < KD_TABLE_AXES; i++)
        KD_TRY(add_axis(table, axes[i], error));
    KD_TRY(add_defaults(table, error));
    if (!table->n_axes)
        KD_TRY(kd_error_set(error, KD_EINVAL, "each field has one value; a table must have an axis"));
    for (size_t i = 0; i < table->n_axes; i++) {
        const struct kd_table_axis *axis = &table->axes[i];
        if (axis->n < 2) {
            snprintf(pointer, sizeof pointer, "/%s", given_name(axis));
            KD_TRY(kd_error_field(error, pointer, "the axis %s has one value; it must have at least two",
                                  given_name(axis)));
        }
        *seen_of(&table->base, axis->field) |= bit_of(axis->field);
        table->nodes *= axis->n;
        table->run *= rank_of(axis) < IMAGE_AXES ? 1 : axis->n;
        if (table->nodes > KD_TABLE_NODES)
            KD_TRY(kd_error_set(error, KD_ETOOBIG, "the axes make too many nodes; a table must have at most %u",
                                KD_TABLE_NODES));
    }
    KD_TRY(set_energies(table, error));
    for (size_t i = 0; i < table->nodes; i++)
        KD_TRY(node_of(table, i, &node, error));
done:
    return status;
}

void kd_table_finish(struct kd_table *table)
{
    kd_integral_request_finish(&table->base);
    free(table->axes);
    *table = (struct kd_table) { 0 };
}

static enum kd_status no_memory(struct kd_error *error)
{
    return kd_error_set(error, KD_ENOMEM, "out of memory for a table");
}

static void put_word(uint8_t **at, uint32_t word)
{
    for (int i = 0; i < 4; i++)
        *(*at)++ = (uint8_t)(word >> (24 - 8 * i));
}

static void put_float(uint8_t **at, double value)
{
    const float number = (float)value;
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    put_word(at, bits);
}

/* Appends the FITS cards of one column. */
static enum kd_status put_column(struct kd_buffer *cards, unsigned number, const char *name, const char *form,
                                 const char *unit)
{
    char key[16];
    enum kd_status status;
    snprintf(key, sizeof key, "TTYPE%u", number);
    KD_TRY(kd_fits_text(cards, key, name, NULL));
    snprintf(key, sizeof key, "TFORM%u", number);
    KD_TRY(kd_fits_text(cards, key, form, NULL));
    snprintf(key, sizeof key, "TUNIT%u", number);
    if (unit)
        KD_TRY(kd_fits_text(cards, key, unit, NULL));
done:
    return status;
}

static enum kd_status put_class(struct kd_buffer *cards, const char *extension, const char *part)
{
    enum kd_status status = KD_OK;
    if (extension)
        KD_TRY(kd_fits_text(cards, "EXTNAME", extension, NULL));
    KD_TRY(kd_fits_text(cards, "HDUCLASS", "OGIP", "format conforms to OGIP standard"));
    KD_TRY(kd_fits_text(cards, "HDUCLAS1", "XSPEC TABLE MODEL", "model spectra for XSPEC"));
    if (part)
        KD_TRY(kd_fits_text(cards, "HDUCLAS2", part, NULL));
    KD_TRY(kd_fits_text(cards, "HDUVERS", "1.0.0", "version of format (OGIP memo 92-009)"));
done:
    return status;
}

void kd_table_axes_json(const struct kd_table *table, struct kd_json *json, const char *name)
{
    kd_json_object(json, name);
    for (size_t i = 0; i < table->n_axes; i++) {
        const struct kd_table_axis *axis = &table->axes[i];
        kd_json_object(json, given_name(axis));
        kd_json_string(json, "interpolation", axis->log ? "log" : "linear");
        kd_json_array(json, "values");
        for (size_t k = 0; k < axis->n; k++)
            kd_json_number(json, NULL, axis->values[k]);
        kd_json_end(json);
        kd_json_end(json);
    }
    kd_json_end(json);
}

/* Writes the request of the table as JSON: the fields with one given value, the energies, and the axes. All other
 * fields have the defaults of `kerrd line`. Without the axes, `kerrd line` accepts this document. */
static enum kd_status put_request(const struct kd_table *table, struct kd_buffer *cards)
{
    struct kd_buffer text = { 0 };
    struct kd_json json = kd_json_begin(&text);
    const bool edges = kd_integral_given(&table->base, "edges"); /* list of edges instead of even bins */
    kd_json_object(&json, NULL);
    for (size_t i = 0; i < kd_n_integral_fields; i++) {
        const struct kd_row *f = &kd_integral_fields[i];
        /* rest_energy is written in any case, because its default for a table differs from that of kerrd line */
        bool is_even = !strcmp(f->name, "rest_energy");
        for (size_t k = 0; !edges && k < sizeof even / sizeof *even; k++)
            is_even = is_even || !strcmp(f->name, even[k]);
        bool varies = !(f->of & 1u << KD_INTEGRAL_LINE) || f->kind == KD_KIND_LIST ||
                      !(is_even || kd_integral_given(&table->base, f->name));
        for (size_t k = 0; k < table->n_axes; k++)
            varies = varies || table->axes[k].field == f;
        if (!varies)
            kd_row_write(&json, f, &table->base);
    }
    if (edges)
        kd_json_array(&json, "edges");
    for (size_t i = 0; edges && i < table->base.edges.n; i++)
        kd_json_number(&json, NULL, table->base.edges.at[i]);
    if (edges)
        kd_json_end(&json);
    kd_table_axes_json(table, &json, "axes");
    kd_json_end(&json);
    enum kd_status status = kd_json_finish(&json);
    if (!status)
        status = kd_fits_text(cards, "KDTABLE", (const char *)text.data, NULL);
    kd_buffer_finish(&text);
    return status;
}

static enum kd_status put_primary(const struct kd_table *table, struct kd_buffer *out)
{
    static const char *const notes[] = {
        "Each spectrum is the profile of a line, in photons in each bin of energy. At norm 1",
        "the line has one photon/cm^2/s over all energies, also those outside the bins.",
        "KDTABLE is the request, as kerrd line has it, and the axes.",
    };
    const struct kd_fits_shape shape = { .primary = true, .n_axes = 0 };
    struct kd_buffer cards = { 0 };
    enum kd_status status;
    KD_TRY(kd_fits_text(&cards, "ORIGIN", "kerrd " KD_VERSION, NULL));
    KD_TRY(put_class(&cards, NULL, NULL));
    KD_TRY(kd_fits_text(&cards, "MODLNAME", table->name, "model name"));
    KD_TRY(kd_fits_text(&cards, "MODLUNIT", "photons/cm^2/s", "units of the model, of each bin"));
    KD_TRY(kd_fits_logical(&cards, "REDSHIFT", true, "redshift is a parameter"));
    KD_TRY(kd_fits_logical(&cards, "ADDMODEL", true, "additive model"));
    KD_TRY(kd_fits_real(&cards, "LOELIMIT", 0, "model below the lowest energy"));
    KD_TRY(kd_fits_real(&cards, "HIELIMIT", 0, "model above the highest energy"));
    KD_TRY(kd_fits_text(&cards, "LONGSTRN", "OGIP 1.0", "texts may go on: CONTINUE"));
    for (size_t i = 0; i < sizeof notes / sizeof *notes; i++)
        KD_TRY(kd_fits_comment(&cards, notes[i]));
    KD_TRY(put_request(table, &cards));
    KD_TRY(kd_fits_head(out, &shape, &cards, 0));
done:
    kd_buffer_finish(&cards);
    return status;
}

/* Appends a whole table of FITS, with `size` bytes. */
static enum kd_status put_table(const struct kd_fits_shape *shape, const struct kd_buffer *cards, const uint8_t *data,
                                size_t size, struct kd_buffer *out)
{
    static const uint8_t zeros[KD_FITS_BLOCK];
    enum kd_status status;
    KD_TRY(kd_fits_head(out, shape, cards, kd_fits_sum(0, data, size)));
    KD_TRY(kd_buffer_append(out, data, size));
    KD_TRY(kd_buffer_append(out, zeros, kd_fits_padding(size)));
done:
    return status;
}

/* The initial value of a parameter in a fit: the request's value if it lies between the ends of the axis, otherwise the
 * middle value. */
static double initial_of(const struct kd_table *table, const struct kd_table_axis *axis)
{
    struct kd_integral_request base = table->base;
    const double value = axis->isco ? 1 : *field_at(&base, axis);
    return value >= axis->values[0] && value <= axis->values[axis->n - 1] ? value : axis->values[axis->n / 2];
}

static void put_parameter(const struct kd_table *table, const struct kd_table_axis *axis, size_t most, uint8_t **at)
{
    const double first = axis->values[0], last = axis->values[axis->n - 1];
    char name[KD_TABLE_NAME + 1] = "";
    snprintf(name, sizeof name, "%s", name_of(axis));
    memcpy(*at, name, KD_TABLE_NAME);
    *at += KD_TABLE_NAME;
    put_word(at, axis->log);
    put_float(at, initial_of(table, axis));
    put_float(at, 0.01 * (last - first)); /* step of this parameter at the start of a fit */
    put_float(at, first), put_float(at, first), put_float(at, last), put_float(at, last);
    put_word(at, (uint32_t)axis->n);
    for (size_t i = 0; i < most; i++)
        put_float(at, i < axis->n ? axis->values[i] : 0);
}

static enum kd_status put_parameters(const struct kd_table *table, struct kd_buffer *out)
{
    static const char *const columns[][2] = { { "NAME", "12A" }, { "METHOD", "J" },  { "INITIAL", "E" },
                                              { "DELTA", "E" },  { "MINIMUM", "E" }, { "BOTTOM", "E" },
                                              { "TOP", "E" },    { "MAXIMUM", "E" }, { "NUMBVALS", "J" } };
    enum { COLUMNS = sizeof columns / sizeof *columns };
    struct kd_buffer cards = { 0 };
    char form[16];
    size_t most = 0;
    enum kd_status status;
    for (size_t i = 0; i < table->n_axes; i++)
        most = table->axes[i].n > most ? table->axes[i].n : most;
    const size_t row = KD_TABLE_NAME + 4 * (COLUMNS - 1 + most), size = row * table->n_axes;
    const struct kd_fits_shape shape = {
        .table = true, .columns = COLUMNS + 1, .n_axes = 2, .axes = { row, table->n_axes }
    };
    uint8_t *data = malloc(size), *at = data;
    if (!data)
        return KD_ENOMEM;
    for (size_t i = 0; i < table->n_axes; i++)
        put_parameter(table, &table->axes[i], most, &at);
    for (unsigned i = 0; i < COLUMNS; i++)
        KD_TRY(put_column(&cards, i + 1, columns[i][0], columns[i][1], NULL));
    snprintf(form, sizeof form, "%zuE", most);
    KD_TRY(put_column(&cards, COLUMNS + 1, "VALUE", form, NULL));
    KD_TRY(put_class(&cards, "PARAMETERS", "PARAMETERS"));
    KD_TRY(kd_fits_integer(&cards, "NINTPARM", (long long)table->n_axes, "number of interpolated parameters"));
    KD_TRY(kd_fits_integer(&cards, "NADDPARM", 0, "number of additional parameters"));
    KD_TRY(put_table(&shape, &cards, data, size, out));
done:
    free(data);
    kd_buffer_finish(&cards);
    return status;
}

static enum kd_status put_energies(const struct kd_table *table, struct kd_buffer *out)
{
    const size_t size = 8 * (size_t)table->base.bins;
    const struct kd_fits_shape shape = { .table = true, .columns = 2, .n_axes = 2, .axes = { 8, table->base.bins } };
    struct kd_buffer cards = { 0 };
    uint8_t *data = malloc(size), *at = data;
    enum kd_status status;
    if (!data)
        return KD_ENOMEM;
    for (size_t i = 0; i < table->base.bins; i++)
        put_float(&at, table->base.edges.at[i]), put_float(&at, table->base.edges.at[i + 1]);
    KD_TRY(put_column(&cards, 1, "ENERG_LO", "E", "keV"));
    KD_TRY(put_column(&cards, 2, "ENERG_HI", "E", "keV"));
    KD_TRY(put_class(&cards, "ENERGIES", "ENERGIES"));
    KD_TRY(put_table(&shape, &cards, data, size, out));
done:
    free(data);
    kd_buffer_finish(&cards);
    return status;
}

size_t kd_table_row_bytes(const struct kd_table *table) { return 4 * (table->n_axes + table->base.bins); }

static enum kd_status put_spectra(const struct kd_table *table, uint32_t sum, struct kd_buffer *out)
{
    const struct kd_fits_shape shape = {
        .table = true, .columns = 2, .n_axes = 2, .axes = { kd_table_row_bytes(table), table->nodes }
    };
    struct kd_buffer cards = { 0 };
    char form[16];
    enum kd_status status;
    snprintf(form, sizeof form, "%zuE", table->n_axes);
    KD_TRY(put_column(&cards, 1, "PARAMVAL", form, NULL));
    snprintf(form, sizeof form, "%uE", table->base.bins);
    KD_TRY(put_column(&cards, 2, "INTPSPEC", form, "photons/cm^2/s"));
    KD_TRY(put_class(&cards, "SPECTRA", "MODEL SPECTRA"));
    KD_TRY(kd_fits_head(out, &shape, &cards, sum));
done:
    kd_buffer_finish(&cards);
    return status;
}

enum kd_status kd_table_head(const struct kd_table *table, uint32_t rows_sum, struct kd_buffer *out,
                             struct kd_error *error)
{
    const bool failed = put_primary(table, out) || put_parameters(table, out) || put_energies(table, out) ||
                        put_spectra(table, rows_sum, out);
    return failed ? no_memory(error) : KD_OK;
}

static enum kd_status row_of(const struct kd_table *table, const struct kd_integral_request *node,
                             const struct kd_disk_image *image, double *edges, double *share, double *worst,
                             struct kd_error *error)
{
    const struct kd_line_params params = kd_integral_line_params(node);
    struct kd_line_profile profile;
    for (uint32_t i = 0; i <= table->base.bins; i++)
        edges[i] = node->edges.at[i] / node->rest_energy;
    const enum kd_status status = kd_line_profile(image, &params, edges, (int)table->base.bins, share, &profile, error);
    if (!status)
        *worst = fmax(*worst, profile.error);
    return status;
}

/* Values of the axes at a node, in the order of the file. */
static void put_values(const struct kd_table *table, size_t node, uint8_t **at)
{
    double values[KD_TABLE_AXES + KD_TABLE_DEFAULTS];
    for (size_t i = table->n_axes; i-- > 0; node /= table->axes[i].n)
        values[i] = table->axes[i].values[node % table->axes[i].n];
    for (size_t i = 0; i < table->n_axes; i++)
        put_float(at, values[i]);
}

enum kd_status kd_table_rows(const struct kd_table *table, size_t first, size_t n, uint8_t *rows, double *worst,
                             struct kd_error *error)
{
    const uint32_t bins = table->base.bins;
    struct kd_disk_image *image = NULL;
    struct kd_integral_request node;
    enum kd_status status = KD_OK;
    double *edges = malloc((2 * (size_t)bins + 1) * sizeof *edges), *share = edges + bins + 1;
    if (!edges)
        return no_memory(error);
    for (size_t i = first; i < first + n; i++) {
        KD_TRY(node_of(table, i, &node, error));
        if (!image)
            KD_TRY(kd_cached_disk_image(kd_integral_hole(&node), node.inclination_deg, &image, error));
        KD_TRY(row_of(table, &node, image, edges, share, worst, error));
        put_values(table, i, &rows);
        for (uint32_t k = 0; k < bins; k++)
            put_float(&rows, share[k]);
    }
done:
    free(edges);
    free(image);
    return status;
}
