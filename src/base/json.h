/* Writes JSON documents. Errors are checked once, at the end. Only one thread at a time may use a document.
 *
 *     struct kd_json json = kd_json_begin(out);
 *     kd_json_object(&json, NULL);
 *     kd_json_number(&json, "spin", 0.9);
 *     kd_json_array(&json, "names");
 *     kd_json_string(&json, NULL, "a");
 *     kd_json_end(&json);
 *     kd_json_end(&json);
 *     return kd_json_finish(&json);
 *
 * After the first failure nothing more is written; kd_json_finish returns the status and removes the partial
 * document. `name` is the member's name within an object. Within an array, and for the outermost value, `name` is
 * NULL. */
#ifndef KD_BASE_JSON_H
#define KD_BASE_JSON_H

#include "base/buffer.h"
#include "base/media.h"

#include <stdbool.h>

enum { KD_JSON_DEPTH = 32, KD_JSON_NUMBER = 32 };

struct kd_json {
    struct kd_buffer *out;
    /* KD_ENOMEM: out of memory. KD_EINVAL: the caller's objects and arrays are not nested correctly. */
    enum kd_status status;
    size_t begun; /* size of *out before this document */
    unsigned depth;
    bool lines; /* each member is written on its own line, for human readers */
    /* Writes a finite number in a special format. NULL: numbers are written by kd_decimal_print. */
    void (*print)(char out[KD_JSON_NUMBER], double value);
    struct { bool array, filled; } open[KD_JSON_DEPTH];
};

/* Begins a document. The document is appended to out, and the earlier bytes of out stay. */
struct kd_json kd_json_begin(struct kd_buffer *out);
/* Like kd_json_begin, with each value on a line of its own. */
struct kd_json kd_json_begin_lines(struct kd_buffer *out);

void kd_json_object(struct kd_json *json, const char *name);
void kd_json_array(struct kd_json *json, const char *name);
void kd_json_end(struct kd_json *json); /* ends the innermost object or array */

/* Writes a number with the fewest digits that read back as the same double. Writes null if it is infinite or NaN. */
void kd_json_number(struct kd_json *json, const char *name, double value);
/* Writes a string. text is UTF-8. */
void kd_json_string(struct kd_json *json, const char *name, const char *text);
void kd_json_bool(struct kd_json *json, const char *name, bool value);
void kd_json_null(struct kd_json *json, const char *name);
/* Writes a value that already is JSON text. */
void kd_json_raw(struct kd_json *json, const char *name, const char *text, size_t length);

/* Writes members into the open object. The text is JSON: the members without the braces around them. */
void kd_json_members(struct kd_json *json, const char *text);

enum kd_status kd_json_finish(struct kd_json *json);
enum kd_status kd_json_finish_line(struct kd_json *json); /* like kd_json_finish, but also appends a line feed */

#endif
