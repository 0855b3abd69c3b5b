/* The base path is a prefix, such as "/some/prefix", that a proxy puts before every path of this server; it is "" if
 * there is none. Routes, and the documents that describe them, do not contain the base path. Pure; any thread. */
#ifndef KD_SERVER_HTTP_BASE_PATH_H
#define KD_SERVER_HTTP_BASE_PATH_H

#include "base/error.h"

#define KD_BASE_PATH_MOST 200 /* bytes */

struct kd_base_path {
    char path[KD_BASE_PATH_MOST + 1];
    /* Details of two 404 answers. outside: the path does not begin with the base path. unknown: no route has the
     * path. */
    char outside[KD_BASE_PATH_MOST + 160], unknown[KD_BASE_PATH_MOST + 100];
};

/* Parses the base path; text NULL: there is none. Returns KD_EINVAL unless text is a sequence of "/segment". A
 * segment consists of letters, digits and -._~@, and is not "." or "..". */
enum kd_status kd_base_path_init(struct kd_base_path *base, const char *text, struct kd_error *error);

/* Returns the part of a path after the base path: "/v1/render" for "/some/prefix/v1/render", and "" for
 * "/some/prefix". Returns NULL if the path is not below the base path. */
const char *kd_base_path_behind(const struct kd_base_path *base, const char *path);

#endif
