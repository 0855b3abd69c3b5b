/* Shared by the fuzz targets: splitting of inputs, and checks of results. One thread. */
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

/* Aborts with a message if a condition does not hold. */
_Noreturn void kd_fuzz_fail(const char *file, int line, const char *format, ...) __attribute__((format(printf, 3, 4)));
#define CHECK(holds, ...) ((holds) ? (void)0 : kd_fuzz_fail(__FILE__, __LINE__, __VA_ARGS__))

/* A copy of bytes with a NUL at the end. The allocation has exactly that size, so that the sanitizer detects reads
 * beyond it. */
struct kd_fuzz_text {
    char *at; /* malloc'd; never NULL */
    size_t size;
};
struct kd_fuzz_text kd_fuzz_copy(const uint8_t *data, size_t size);
/* A copy of bytes without a NUL, for functions that are given the size. */
struct kd_fuzz_text kd_fuzz_bare(const uint8_t *data, size_t size);

/* Takes the next part of an input: up to a line "---", which is dropped, or to the end. Empty if nothing is left. */
struct kd_fuzz_text kd_fuzz_part(const uint8_t **data, size_t *size);
/* Takes the next line, up to LF, NUL or the end of the input. Returns false if no input is left. */
bool kd_fuzz_next(const uint8_t **data, size_t *size, struct kd_fuzz_text *out);

/* Checks an error: it has a status, a one-line message in UTF-8, and an optional JSON pointer (RFC 6901). */
void kd_fuzz_refused(enum kd_status status, const struct kd_error *error);

/* Checks that each field of the scene has a value that its row permits. */
void kd_fuzz_fields(const struct kd_scene *scene);
/* Like kd_fuzz_fields. Also checks that the canonical document reads back as the same scene with the same hash, and
 * that the scene has a plan or an error. */
void kd_fuzz_sound(const struct kd_scene *scene);

/* Capacity of a typical device, for plans. */
struct kd_capacity kd_fuzz_device(void);

/* Checks that a text is one JSON document without NaN. */
void kd_fuzz_json(const struct kd_buffer *text);
/* Checks that a text is UTF-8 without control characters except line feeds. */
void kd_fuzz_shown(const char *text);

/* A folder that exists as long as the process. Returns its path, and its descriptor in *out (may be NULL). kd_fuzz_file
 * writes these bytes to a regular file in the folder, under one of up to four names. */
const char *kd_fuzz_folder(int *out);
void kd_fuzz_file(const char *name, const void *data, size_t size);

#endif
