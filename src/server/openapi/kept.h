/* Cache of documents that are constant while the program runs. They are made at the start, plain and as gzip, each with
 * an ETag. Read-only afterwards: any thread. */
#ifndef KD_SERVER_OPENAPI_KEPT_H
#define KD_SERVER_OPENAPI_KEPT_H

#include "base/error.h"
#include "server/http/served.h"

#include <stdbool.h>

struct kd_kept;

/* base_path, closed: as in kd_openapi_json. */
enum kd_status kd_kept_create(const char *base_path, bool closed, struct kd_kept **out, struct kd_error *error);
void kd_kept_destroy(struct kd_kept *kept); /* accepts NULL */
/* Finds a document by the path of its route, such as "/v1/presets/gargantua"; NULL: none. */
const struct kd_served *kd_kept_find(const struct kd_kept *kept, const char *path);

#endif
