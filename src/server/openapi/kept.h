/* These documents stay the same as long as the program runs: they are made once, at the start, plain and as gzip,
 * each with an ETag. Read-only afterwards: any thread. */
#ifndef KD_SERVER_OPENAPI_KEPT_H
#define KD_SERVER_OPENAPI_KEPT_H

#include "base/error.h"
#include "server/http/served.h"

#include <stdbool.h>

struct kd_kept;

/* base_path, closed: as kd_openapi_json takes them. */
enum kd_status kd_kept_create(const char *base_path, bool closed, struct kd_kept **out, struct kd_error *error);
void kd_kept_destroy(struct kd_kept *kept); /* accepts NULL */
/* Finds a document by the path of its route, "/v1/presets/gargantua"; NULL: there is none. */
const struct kd_served *kd_kept_find(const struct kd_kept *kept, const char *path);

#endif
