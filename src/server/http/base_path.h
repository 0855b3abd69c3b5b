/* Base path: the prefix, such as "/some/prefix", that a proxy puts before every path of this server; "" for none.
 * Routes and the documents that describe them do not contain it. Pure; any thread. */
#ifndef KD_SERVER_HTTP_BASE_PATH_H
#define KD_SERVER_HTTP_BASE_PATH_H

#include "base/error.h"

#define KD_BASE_PATH_MOST 200 /* bytes */

struct kd_base_path {
    char path[KD_BASE_PATH_MOST + 1];
    /* Sentences of a 404: of a path outside the base path, and of one that no route has. */
    char outside[KD_BASE_PATH_MOST + 160], unknown[KD_BASE_PATH_MOST + 100];
};

/* Takes it from text, NULL for none. KD_EINVAL unless it is segments of letters, digits and -._~@, each behind a
 * slash, none of which is "." or "..". */
enum kd_status kd_base_path_init(struct kd_base_path *base, const char *text, struct kd_error *error);

/* Gives what stands behind the base path: "/v1/render" of "/some/prefix/v1/render", "" of "/some/prefix"; NULL: the
 * path is not below it. */
const char *kd_base_path_behind(const struct kd_base_path *base, const char *path);

#endif
