/* Cache of documents that are constant while the program runs. They are made at the start, both uncompressed and
 * compressed by gzip, and each form has its own ETag. Afterwards they are read-only, so any thread may use them. */
#ifndef KD_SERVER_OPENAPI_CACHED_DOCUMENTS_H
#define KD_SERVER_OPENAPI_CACHED_DOCUMENTS_H

#include "base/error.h"
#include "server/http/served.h"

#include <stdbool.h>

struct kd_cached_documents;

/* base_path and closed are as for kd_openapi_json. */
enum kd_status kd_cached_documents_create(const char *base_path, bool closed, struct kd_cached_documents **out,
                                          struct kd_error *error);
void kd_cached_documents_destroy(struct kd_cached_documents *cache); /* accepts NULL */
/* Finds a document by the path of its route, such as "/v1/presets/gargantua". Returns NULL if there is none. */
const struct kd_served *kd_cached_documents_find(const struct kd_cached_documents *cache, const char *path);

#endif
