#include "image/npy.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MAGIC "\x93NUMPY"

static const struct {
    const char *code;
    size_t size;
} types[] = { [KD_NPY_F8] = { "<f8", 8 }, [KD_NPY_F4] = { "<f4", 4 },  [KD_NPY_U1] = { "|u1", 1 },
              [KD_NPY_U4] = { "<u4", 4 }, [KD_NPY_TEXT] = { "<U", 4 }, [KD_NPY_BYTES] = { "|S", 1 } };
enum { TYPES_READ = KD_NPY_U4 };

size_t kd_npy_item_size(const struct kd_npy *array)
{
    size_t size = 0;
    for (size_t i = 0; i < array->n_fields; i++) {
        const struct kd_npy_field *field = &array->fields[i];
        size += types[field->type].size * (field->count ? field->count : 1);
    }
    return size;
}

static enum kd_status write_type(const struct kd_npy *array, struct kd_buffer *text)
{
    if (array->fields[0].type >= KD_NPY_TEXT)
        return kd_buffer_printf(text, "'%s%u'", types[array->fields[0].type].code, array->fields[0].count);
    if (!array->fields[0].name[0])
        return kd_buffer_printf(text, "'%s'", types[array->fields[0].type].code);
    enum kd_status status;
    KD_TRY(kd_buffer_printf(text, "["));
    for (size_t i = 0; i < array->n_fields; i++) {
        const struct kd_npy_field *field = &array->fields[i];
        KD_TRY(kd_buffer_printf(text, "%s('%s', '%s'", i ? ", " : "", field->name, types[field->type].code));
        if (field->count)
            KD_TRY(kd_buffer_printf(text, ", (%u,)", field->count));
        KD_TRY(kd_buffer_printf(text, ")"));
    }
    KD_TRY(kd_buffer_printf(text, "]"));
done:
    return status;
}

enum kd_status kd_npy_write_header(const struct kd_npy *array, struct kd_buffer *out)
{
    struct kd_buffer text = { 0 };
    enum kd_status status;
    KD_TRY(kd_buffer_printf(&text, "{'descr': "));
    KD_TRY(write_type(array, &text));
    KD_TRY(kd_buffer_printf(&text, ", 'fortran_order': False, 'shape': ("));
    for (size_t i = 0; i < array->n_dimensions; i++)
        KD_TRY(kd_buffer_printf(&text, "%s%llu%s", i ? " " : "", (unsigned long long)array->shape[i],
                                i + 1 < array->n_dimensions || array->n_dimensions == 1 ? "," : ""));
    KD_TRY(kd_buffer_printf(&text, "), }"));
    size_t bare = sizeof MAGIC - 1 + 4 + text.size + 1, padded = (bare + 63) / 64 * 64;
    KD_TRY(kd_buffer_printf(&text, "%*s\n", (int)(padded - bare), ""));
    uint8_t start[10] = { [6] = 1, [8] = (uint8_t)text.size, [9] = (uint8_t)(text.size >> 8) };
    memcpy(start, MAGIC, sizeof MAGIC - 1);
    KD_TRY(kd_buffer_append(out, start, sizeof start));
    KD_TRY(kd_buffer_append(out, text.data, text.size));
done:
    kd_buffer_finish(&text);
    return status;
}

/* The header is a Python dict with three known keys. This parser accepts only such dicts, not other Python
 * expressions. */
struct reader {
    const char *at; /* position in the header, which ends with a NUL */
    struct kd_npy *array;
    struct kd_error *error;
    bool text; /* true if elements may be text */
};

static enum kd_status fail(struct reader *r, const char *what)
{
    return kd_error_set(r->error, KD_EINVAL, "not a usable NPY array: %s", what);
}

static void skip_blanks(struct reader *r) { r->at += strspn(r->at, " \t\n"); }

static bool take(struct reader *r, char c)
{
    skip_blanks(r);
    if (*r->at != c)
        return false;
    r->at++;
    return true;
}

static bool take_word(struct reader *r, const char *word)
{
    skip_blanks(r);
    size_t n = strlen(word);
    if (strncmp(r->at, word, n))
        return false;
    r->at += n;
    return true;
}

/* Parses a string 'text' or "text" that contains no escapes. */
static bool take_string(struct reader *r, char *out, size_t size)
{
    skip_blanks(r);
    char quote = *r->at;
    if (quote != '\'' && quote != '"')
        return false;
    size_t n = strcspn(r->at + 1, "'\"\\\n");
    if (r->at[1 + n] != quote || n >= size)
        return false;
    memcpy(out, r->at + 1, n);
    out[n] = 0;
    r->at += n + 2;
    return true;
}

static bool take_number(struct reader *r, uint64_t *out)
{
    skip_blanks(r);
    const char *start = r->at;
    uint64_t value = 0;
    for (; *r->at >= '0' && *r->at <= '9'; r->at++)
        if (__builtin_mul_overflow(value, (uint64_t)10, &value) ||
            __builtin_add_overflow(value, (uint64_t)(*r->at - '0'), &value))
            return false;
    *out = value;
    return r->at > start && (*start != '0' || r->at == start + 1);
}

/* Parses a shape, such as (), (3,) or (3, 2). */
static enum kd_status take_shape(struct reader *r, uint64_t *shape, size_t most, size_t *n)
{
    bool comma = true;
    *n = 0;
    if (!take(r, '('))
        return fail(r, "the shape is not a tuple");
    while (!take(r, ')')) {
        if (!comma)
            return fail(r, "the shape is not a tuple of whole numbers");
        if (*n == most)
            return fail(r, "it has too many dimensions");
        if (!take_number(r, &shape[(*n)++]))
            return fail(r, "the shape is not a tuple of whole numbers below 2^64");
        comma = take(r, ',');
    }
    return *n == 1 && !comma ? fail(r, "the shape is not a tuple") : KD_OK;
}

/* True if a type code is one of text, such as "<U12" or "|S12". Sets the type and the count of *out. */
static bool is_text(const char *code, struct kd_npy_field *out)
{
    for (size_t i = KD_NPY_TEXT; i <= KD_NPY_BYTES; i++) {
        const char *digits = code + strlen(types[i].code);
        if (strncmp(code, types[i].code, strlen(types[i].code)) || !*digits || strlen(digits) > 6 ||
            digits[strspn(digits, "0123456789")])
            continue;
        out->type = (enum kd_npy_type)i;
        out->count = (uint32_t)strtoul(digits, NULL, 10);
        return out->count > 0;
    }
    return false;
}

static enum kd_status take_type(struct reader *r, enum kd_npy_type *out)
{
    char code[16], what[80];
    if (!take_string(r, code, sizeof code))
        return fail(r, "an element type is not a plain string");
    if (r->text && is_text(code, &r->array->fields[0]))
        return KD_OK;
    for (size_t i = 0; i < TYPES_READ; i++)
        if (!strcmp(code, types[i].code)) {
            *out = (enum kd_npy_type)i;
            return KD_OK;
        }
    for (char *p = code; *p; p++)
        if (*p < ' ' || *p > '~')
            *p = '?';
    snprintf(what, sizeof what, "the element type is %s; it must be <f8, <f4 or |u1", code);
    return fail(r, what);
}

static bool good_name(const struct kd_npy *array, const char *name)
{
    for (size_t i = 0; i + 1 < array->n_fields; i++)
        if (!strcmp(array->fields[i].name, name))
            return false;
    return *name && !name[strspn(name, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_")];
}

/* Parses a field, such as ('name', '<f8') or ('name', '<f8', (3,)). */
static enum kd_status take_field(struct reader *r)
{
    struct kd_npy *array = r->array;
    uint64_t count;
    size_t n;
    if (array->n_fields == KD_NPY_FIELDS)
        return fail(r, "it has more than 20 fields");
    struct kd_npy_field *field = &array->fields[array->n_fields++];
    *field = (struct kd_npy_field) { 0 };
    if (!take(r, '(') || !take_string(r, field->name, sizeof field->name) || !take(r, ',') ||
        !good_name(array, field->name))
        return fail(r, "the names of its fields must differ, each of 1 to 31 letters, digits and _");
    enum kd_status status = take_type(r, &field->type);
    if (!status && take(r, ',')) {
        skip_blanks(r);
        if (*r->at != ')') {
            status = take_shape(r, &count, 1, &n);
            if (!status && (n != 1 || !count || count > UINT32_MAX / 64))
                status = fail(r, "the shape of a field has more than one dimension");
            field->count = status ? 0 : (uint32_t)count;
        }
    }
    return status || take(r, ')') ? status : fail(r, "a field does not end");
}

static enum kd_status take_descr(struct reader *r)
{
    struct kd_npy *array = r->array;
    if (!take(r, '[')) {
        array->fields[0] = (struct kd_npy_field) { 0 };
        array->n_fields = 1;
        return take_type(r, &array->fields[0].type);
    }
    bool comma = true;
    array->n_fields = 0;
    while (!take(r, ']')) {
        enum kd_status status = comma ? take_field(r) : fail(r, "its fields are not a list");
        if (status)
            return status;
        comma = take(r, ',');
    }
    return array->n_fields ? KD_OK : fail(r, "it has no fields");
}

static enum kd_status take_entry(struct reader *r, bool seen[3])
{
    static const char *const keys[] = { "descr", "fortran_order", "shape" };
    char key[16];
    int which = 0;
    if (!take_string(r, key, sizeof key) || !take(r, ':'))
        return fail(r, "its header is not a dictionary");
    while (which < 3 && strcmp(key, keys[which]))
        which++;
    if (which == 3 || seen[which])
        return fail(r, "its header must have the keys descr, fortran_order and shape, each once, and no other key");
    seen[which] = true;
    switch (which) {
    case 0: return take_descr(r);
    case 1:
        return take_word(r, "False")  ? KD_OK
               : take_word(r, "True") ? fail(r, "its order is Fortran; it must be C")
                                      : fail(r, "fortran_order is neither True nor False");
    default: return take_shape(r, r->array->shape, KD_NPY_DIMENSIONS_READ, &r->array->n_dimensions);
    }
}

static enum kd_status take_header(struct reader *r)
{
    bool seen[3] = { false }, comma = true;
    if (!take(r, '{'))
        return fail(r, "its header is not a dictionary");
    while (!take(r, '}')) {
        enum kd_status status = comma ? take_entry(r, seen) : fail(r, "its header is not a dictionary");
        if (status)
            return status;
        comma = take(r, ',');
    }
    skip_blanks(r);
    if (*r->at)
        return fail(r, "text follows its header");
    return seen[0] && seen[1] && seen[2] ? KD_OK : fail(r, "its header lacks descr, fortran_order or shape");
}

/* Returns the offset of the header and gets its length. Returns 0 if the data are not an NPY file of a known
 * version. */
static size_t find_header(const uint8_t *p, size_t size, size_t *length)
{
    if (size < 10 || memcmp(p, MAGIC, sizeof MAGIC - 1) || p[7] || p[6] < 1 || p[6] > 2 || (p[6] == 2 && size < 12))
        return 0;
    *length = p[8] | (size_t)p[9] << 8;
    if (p[6] == 2)
        *length |= (size_t)p[10] << 16 | (size_t)p[11] << 24;
    return p[6] == 1 ? 10 : 12;
}

static enum kd_status read_all(const void *data, size_t size, bool text, struct kd_npy *out, struct kd_error *error)
{
    char header[KD_NPY_HEADER_MAX + 1];
    struct reader r = { .at = header, .array = out, .error = error, .text = text };
    size_t length = 0, start = find_header(data, size, &length);
    *out = (struct kd_npy) { 0 };
    if (!start)
        return fail(&r, "it does not start like NPY of version 1.0 or 2.0");
    if (length > KD_NPY_HEADER_MAX || length > size - start)
        return fail(&r,
                    length > KD_NPY_HEADER_MAX ? "its header has more than 10000 bytes" : "it ends within its header");
    memcpy(header, (const char *)data + start, length);
    header[length] = 0;
    if (strlen(header) != length)
        return fail(&r, "its header holds a NUL");
    enum kd_status status = take_header(&r);
    if (status)
        return status;
    uint64_t items = 1, bytes;
    out->header_size = start + length;
    out->item_size = kd_npy_item_size(out);
    bool overflow = false; /* overflow is checked even if a later dimension is 0, as in NumPy */
    for (size_t i = 0; i < out->n_dimensions; i++)
        overflow |= __builtin_mul_overflow(items, out->shape[i], &items);
    if (overflow || __builtin_mul_overflow(items, (uint64_t)out->item_size, &bytes))
        return fail(&r, "its shape has more elements than memory can have");
    out->items = items;
    if (bytes != size - out->header_size)
        return kd_error_set(error, KD_EINVAL,
                            "not a usable NPY array: %zu bytes follow its header; for its shape there must be %llu",
                            size - out->header_size, (unsigned long long)bytes);
    return KD_OK;
}

enum kd_status kd_npy_read(const void *data, size_t size, struct kd_npy *out, struct kd_error *error)
{
    return read_all(data, size, false, out, error);
}

/* Encodes a UTF-32 character in UTF-8. Returns the number of bytes, 0 if the character is invalid. */
static size_t to_utf8(uint32_t c, char out[4])
{
    static const uint32_t least[] = { 0, 0x80, 0x800, 0x10000, 0x110000 };
    size_t n = 1;
    while (n < 5 && c >= least[n])
        n++;
    if (n > 4 || (c >= 0xd800 && c < 0xe000))
        return 0;
    out[0] = (char)(n == 1 ? c : (0xf00u >> n & 0xf0) | c >> 6 * (n - 1));
    for (size_t i = 1; i < n; i++)
        out[i] = (char)(0x80 | (c >> 6 * (n - 1 - i) & 0x3f));
    return n;
}

enum kd_status kd_npy_read_text(const void *data, size_t size, struct kd_buffer *out, struct kd_error *error)
{
    struct kd_npy array;
    struct reader r = { .error = error };
    enum kd_status status = read_all(data, size, true, &array, error);
    const enum kd_npy_type type = array.fields[0].type;
    if (status)
        return status;
    /* Computed only after the check above, because the data of an empty array may have no valid address. */
    const uint8_t *p = (const uint8_t *)data + array.header_size;
    if (array.n_fields != 1 || array.fields[0].name[0] ||
        !(type == KD_NPY_U1 ? array.n_dimensions == 1 : type >= KD_NPY_TEXT && array.n_dimensions == 0))
        return fail(&r, "it is not a text, neither one str nor a list of bytes");
    const size_t n = type == KD_NPY_U1 ? array.items : array.fields[0].count;
    for (size_t i = 0; i < n && !status; i++) {
        char c[4] = { 0 };
        const uint8_t *at = p + types[type].size * i;
        size_t bytes = type == KD_NPY_TEXT
                           ? to_utf8(at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24, c)
                           : 1;
        if (!bytes)
            return fail(&r, "its text has a code that is not a character");
        if (type != KD_NPY_TEXT)
            c[0] = (char)at[0];
        if (c[0]) /* NULs are padding */
            status = kd_buffer_append(out, c, bytes);
    }
    return status ? kd_error_set(error, status, "out of memory for a text") : KD_OK;
}
