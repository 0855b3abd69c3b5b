/* Base path: the prefix, such as "/some/prefix", that a proxy puts before every path of this server; "" for none.
 * Routes and the documents that describe them do not contain it. Pure; any thread. */
#ifndef KD_SERVER_HTTP_BASE_PATH_H
#define KD_SERVER_HTTP_BASE_PATH_H

#include "base/error.h"

#define KD_BASE_PATH_MOST 200 /* bytes */

struct kd_base_path {
    char path[KD_BASE_PATH_MOST + 1];
    /* Details of the two 404 answers. outside: the path is outside the base path. unknown: no route has the path. */
    char outside[KD_BASE_PATH_MOST + 160], unknown[KD_BASE_PATH_MOST + 100];
};

/* Parses text; NULL: no base path. Returns KD_EINVAL unless text is a sequence of "/segment", each segment made of
 * letters, digits and -._~@ and neither "." nor "..". */
enum kd_status kd_base_path_init(struct kd_base_path *base, const char *text, struct kd_error *error);

/* Returns the rest of the path behind the base path: "/v1/render" of "/some/prefix/v1/render", and "" of
 * "/some/prefix". NULL if the path is not below the base path. */
const char *kd_base_path_behind(const struct kd_base_path *base, const char *path);

#endif
