/* The targets of fuzzing share these: parts of an input, and what holds of every answer. One thread. */
#ifndef KD_FUZZ_FUZZ_H
#define KD_FUZZ_FUZZ_H

#include "base/buffer.h"
#include "base/error.h"
#include "render/plan/plan.h"
#include "scene/scene.h"
#include "targets.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Ends the process with a sentence where something does not hold. */
_Noreturn void kd_fuzz_fail(const char *file, int line, const char *format, ...) __attribute__((format(printf, 3, 4)));
#define CHECK(holds, ...) ((holds) ? (void)0 : kd_fuzz_fail(__FILE__, __LINE__, __VA_ARGS__))

/* A copy of bytes with a NUL behind them, of exactly that size, so that a reader which goes further is found out. */
struct kd_fuzz_text {
    char *at; /* malloc'd; never NULL */
    size_t size;
};
struct kd_fuzz_text kd_fuzz_copy(const uint8_t *data, size_t size);
/* The same without that NUL, for readers who are given a size. */
struct kd_fuzz_text kd_fuzz_bare(const uint8_t *data, size_t size);

/* Takes the next part of an input: up to a line "---", which is dropped, or its end. Empty when there is no more. */
struct kd_fuzz_text kd_fuzz_part(const uint8_t **data, size_t *size);
/* Takes the next line, up to LF, NUL or the end; false: there is no more. */
bool kd_fuzz_next(const uint8_t **data, size_t *size, struct kd_fuzz_text *out);

/* Checks a refusal: it has a status, a sentence of UTF-8 in one line, and a pointer that is one (RFC 6901), or none. */
void kd_fuzz_refused(enum kd_status status, const struct kd_error *error);

/* Checks that each field of the scene holds a value that its row of the table allows. */
void kd_fuzz_fields(const struct kd_scene *scene);
/* Checks that as well, that its canonical document reads back as the same scene, with the same hash, and that it has
 * a plan or a refusal. */
void kd_fuzz_sound(const struct kd_scene *scene);

/* A device to plan for, as there are many. */
struct kd_capacity kd_fuzz_device(void);

/* Checks that a text is one JSON document without NaN. */
void kd_fuzz_json(const struct kd_buffer *text);
/* Checks that a text is UTF-8 without control characters but for line feeds. */
void kd_fuzz_shown(const char *text);

/* A folder that exists as long as the process: its path, and in *out (NULL: not wanted) its descriptor. Puts a
 * regular file of these bytes in it, under one of up to four names. */
const char *kd_fuzz_folder(int *out);
void kd_fuzz_file(const char *name, const void *data, size_t size);

#endif
