#include "base/json.h"

#include "base/decimal.h"

#include <math.h>
#include <string.h>

struct kd_json kd_json_begin(struct kd_buffer *out) { return (struct kd_json) { .out = out, .begun = out->size }; }

struct kd_json kd_json_begin_lines(struct kd_buffer *out)
{
    struct kd_json json = kd_json_begin(out);
    json.lines = true;
    return json;
}

static void put(struct kd_json *json, const char *text, size_t size)
{
    if (!json->status)
        json->status = kd_buffer_append(json->out, text, size);
}

static void new_line(struct kd_json *json)
{
    put(json, "\n", 1);
    for (unsigned i = 0; i < json->depth; i++)
        put(json, "  ", 2);
}

static void put_string(struct kd_json *json, const char *text)
{
    static const char digits[] = "0123456789abcdef";
    put(json, "\"", 1);
    for (; *text; text++) {
        size_t plain = 0;
        while ((unsigned char)text[plain] >= 0x20 && text[plain] != '"' && text[plain] != '\\')
            plain++;
        put(json, text, plain);
        text += plain;
        unsigned char c = (unsigned char)*text;
        if (!c)
            break;
        if (c >= 0x20)
            put(json, (const char[]) { '\\', (char)c }, 2);
        else
            put(json, (const char[]) { '\\', 'u', '0', '0', digits[c >> 4], digits[c & 15] }, 6);
    }
    put(json, "\"", 1);
}

/* Writes the comma and the member's name before a value. */
static void lead(struct kd_json *json, const char *name)
{
    if (!json->depth) {
        if (name || json->out->size != json->begun)
            json->status = json->status ? json->status : KD_EINVAL;
        return;
    }
    if (json->open[json->depth - 1].array == !!name)
        json->status = json->status ? json->status : KD_EINVAL;
    if (json->open[json->depth - 1].filled)
        put(json, ",", 1);
    json->open[json->depth - 1].filled = true;
    if (json->lines)
        new_line(json);
    if (name) {
        put_string(json, name);
        put(json, ": ", json->lines ? 2 : 1);
    }
}

static void enter(struct kd_json *json, const char *name, bool array)
{
    lead(json, name);
    if (json->depth == KD_JSON_DEPTH) {
        json->status = json->status ? json->status : KD_EINVAL;
        return;
    }
    put(json, array ? "[" : "{", 1);
    json->open[json->depth].array = array;
    json->open[json->depth++].filled = false;
}

void kd_json_object(struct kd_json *json, const char *name) { enter(json, name, false); }
void kd_json_array(struct kd_json *json, const char *name) { enter(json, name, true); }

void kd_json_end(struct kd_json *json)
{
    if (!json->depth) {
        json->status = json->status ? json->status : KD_EINVAL;
        return;
    }
    json->depth--;
    if (json->lines && json->open[json->depth].filled)
        new_line(json);
    put(json, json->open[json->depth].array ? "]" : "}", 1);
}

void kd_json_raw(struct kd_json *json, const char *name, const char *text, size_t length)
{
    lead(json, name);
    put(json, text, length);
}

void kd_json_members(struct kd_json *json, const char *text)
{
    if (!json->depth || json->open[json->depth - 1].array)
        json->status = json->status ? json->status : KD_EINVAL;
    else if (json->open[json->depth - 1].filled)
        put(json, ",", 1);
    put(json, text, strlen(text));
    if (json->depth)
        json->open[json->depth - 1].filled = true;
}

void kd_json_number(struct kd_json *json, const char *name, double value)
{
    char text[KD_JSON_NUMBER];
    if (!isfinite(value)) {
        kd_json_null(json, name);
        return;
    }
    value = value == 0 ? 0 : value; /* turns -0 into 0 */
    if (json->print)
        json->print(text, value);
    else
        kd_decimal_print(text, value);
    kd_json_raw(json, name, text, strlen(text));
}

void kd_json_string(struct kd_json *json, const char *name, const char *text)
{
    lead(json, name);
    put_string(json, text);
}

void kd_json_bool(struct kd_json *json, const char *name, bool value)
{
    kd_json_raw(json, name, value ? "true" : "false", value ? 4 : 5);
}

void kd_json_null(struct kd_json *json, const char *name) { kd_json_raw(json, name, "null", 4); }

enum kd_status kd_json_finish(struct kd_json *json)
{
    if (!json->status && (json->depth || json->out->size == json->begun))
        json->status = KD_EINVAL;
    if (json->status && json->out->data) {
        json->out->size = json->begun;
        json->out->data[json->begun] = 0;
    }
    return json->status;
}

enum kd_status kd_json_finish_line(struct kd_json *json)
{
    put(json, "\n", 1);
    return kd_json_finish(json);
}
