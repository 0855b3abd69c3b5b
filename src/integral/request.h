/* Reads requests for integrals over a thin disk, or over pictures of a scene. A request is a JSON document, or is set
 * field by field. The table of fields (fields.c) generates the reader, the options of the command line and the schemas
 * of openapi.json. Any thread.
 *
 *     {"spin": 0.9, "inclination_deg": 60, "emissivity": "power", "index": 3, "energy_min": 0.1, "energy_max": 1.5,
 *         "bins": 500} */
#ifndef KD_INTEGRAL_REQUEST_H
#define KD_INTEGRAL_REQUEST_H

#include "base/error.h"
#include "base/json.h"
#include "integral/asked.h"

#include <stddef.h>
#include <stdint.h>

#define KD_INTEGRAL_BODY_MAX ((size_t)1 << 20) /* largest size of a document, bytes */
#define KD_INTEGRAL_TIMES 4096u                /* largest number of time bins of an echo */
#define KD_INTEGRAL_ROWS 20000u                /* largest number of rows of an answer */
#define KD_INTEGRAL_LIST 20001u                /* largest length of a list */
#define KD_INTEGRAL_TRANSFERS 5000u            /* largest number of rows of a transfer function; each takes 0.1 ms */
#define KD_INTEGRAL_FREQUENCIES 1000u
#define KD_INTEGRAL_LAG_FREQUENCIES 200u /* largest number of frequencies of lags; each takes some 10 ms */
#define KD_INTEGRAL_PICTURES 200u        /* largest number of frequencies of a spectrum made of pictures */
#define KD_INTEGRAL_LEAST_HZ 1e3         /* lowest frequency; the same as for volume.frequency_ghz */
#define KD_INTEGRAL_MOST_HZ 1e21         /* highest frequency; the same as for volume.frequency_ghz */
/* least angle from the axis, degrees; closer to it no ring has a transfer function. INCLINATION of fields.c has the
 * same limit */
#define KD_INTEGRAL_FACE_ON 0.1
/* least angle from edge-on, degrees; closer to it there is no transfer function. fields.c has the same limit */
#define KD_INTEGRAL_EDGE_ON 0.01
#define KD_INTEGRAL_ORDERS 8u /* largest number of image orders that are distinguished */

void kd_integral_request_init(struct kd_integral_request *request, enum kd_integral what);
void kd_integral_request_finish(struct kd_integral_request *request);

/* Merges a document into the request. If the text is not a JSON document, it returns KD_EINVAL and leaves the error's
 * pointer empty. */
enum kd_status kd_integral_request_read(struct kd_integral_request *request, const char *text, size_t length,
                                        struct kd_error *error);
/* Calls kd_integral_request_read and then kd_integral_request_check. */
enum kd_status kd_integral_request_json(struct kd_integral_request *request, const char *text, size_t length,
                                        struct kd_error *error);

/* Sets one field by name. A list is given as numbers separated by commas. */
enum kd_status kd_integral_request_set(struct kd_integral_request *request, const char *name, const char *text,
                                       struct kd_error *error);
/* Sets the observation of a comparison from the bytes of a file. An error is KD_EINVAL at the pointer /observation. */
enum kd_status kd_integral_set_observation(struct kd_integral_request *request, const void *data, size_t size,
                                           struct kd_error *error);
/* Fills in the fields that follow from other fields, and checks the rules between fields. Call it after all fields are
 * set. */
enum kd_status kd_integral_request_check(struct kd_integral_request *request, struct kd_error *error);

/* kd_integral_name: the NAME of an integral, as in its path /v1/NAME. kd_integral_of_route: the integral that has the
 * given path. */
const char *kd_integral_name(enum kd_integral what);
enum kd_integral kd_integral_of_route(const char *path);

/* Number of rows in the answer to a checked request. */
size_t kd_integral_rows(const struct kd_integral_request *request);

/* The document whose fields fill a request for this kind of integral. */
struct kd_document kd_integral_document(enum kd_integral what);

/* Writes the schema of a request's document as the member `name`. */
void kd_integral_request_schema(struct kd_json *json, const char *name, enum kd_integral what);

#endif
