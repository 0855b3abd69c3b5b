/* Reads what is asked of the integrals over a thin disk, or over pictures of a scene: a JSON document, or
 * fields by name. The table of fields (fields.c) is the source of the reader, the options of the command line and
 * the schemas of openapi.json. Any thread.
 *
 *     {"spin": 0.9, "inclination_deg": 60, "emissivity": "power", "index": 3, "energy_min": 0.1, "energy_max": 1.5,
 *       "bins": 500}
 * / */
#ifndef KD_INTEGRAL_REQUEST_H
#define KD_INTEGRAL_REQUEST_H

#include "base/error.h"
#include "base/json.h"
#include "integral/asked.h"

#include <stddef.h>
#include <stdint.h>

#define KD_INTEGRAL_BODY_MAX ((size_t)1 << 20) /* bytes of a document */
#define KD_INTEGRAL_ROWS 20000u                /* of an answer */
#define KD_INTEGRAL_LIST 20001u                /* numbers of a list */
#define KD_INTEGRAL_TRANSFERS 5000u            /* rows of a transfer function: 0.1 ms each */
#define KD_INTEGRAL_FREQUENCIES 1000u
#define KD_INTEGRAL_PICTURES 200u /* frequencies of a spectrum that is made of pictures, */
#define KD_INTEGRAL_LEAST_HZ 1e3  /* from here ... */
#define KD_INTEGRAL_MOST_HZ 1e21  /* ... to here, as volume.frequency_ghz */
#define KD_INTEGRAL_FACE_ON 0.1   /* degrees off the axis, within which no ring has a transfer function */
#define KD_INTEGRAL_ORDERS 8u     /* image orders that are told apart */

void kd_integral_request_init(struct kd_integral_request *request, enum kd_integral what);
void kd_integral_request_finish(struct kd_integral_request *request);

/* What a document says, over what is there. KD_EINVAL without a pointer: this is no JSON document. */
enum kd_status kd_integral_request_read(struct kd_integral_request *request, const char *text, size_t length,
                                        struct kd_error *error);
/* The same, and kd_integral_request_check. */
enum kd_status kd_integral_request_json(struct kd_integral_request *request, const char *text, size_t length,
                                        struct kd_error *error);

/* One field by its name; lists as numbers with commas between them. */
enum kd_status kd_integral_request_set(struct kd_integral_request *request, const char *name, const char *text,
                                       struct kd_error *error);
/* Takes an observation, of a comparison, from the bytes of its file: KD_EINVAL at /observation. */
enum kd_status kd_integral_set_observation(struct kd_integral_request *request, const void *data, size_t size,
                                           struct kd_error *error);
/* After the last of them: fills in what follows from others, and checks what ties them together. */
enum kd_status kd_integral_request_check(struct kd_integral_request *request, struct kd_error *error);

/* The name as in /v1/NAME, and what such a path stands for. */
const char *kd_integral_name(enum kd_integral what);
enum kd_integral kd_integral_of_route(const char *path);

/* Rows of the answer to a request that has been checked. */
size_t kd_integral_rows(const struct kd_integral_request *request);

/* Writes the value of a field that is no list. */
void kd_integral_field_write(struct kd_json *json, const struct kd_integral_request *request,
                             const struct kd_integral_field *field);

/* The schema of a request's document, as the member `name`. */
void kd_integral_request_schema(struct kd_json *json, const char *name, enum kd_integral what);

#endif
