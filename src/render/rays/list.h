/* Reads the long array of a request, [[alpha, beta], ...], without a tree of nodes. Private to src/render. */
#ifndef KD_RENDER_RAYS_LIST_H
#define KD_RENDER_RAYS_LIST_H

#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>

struct kd_rays_list {
    double *alpha_beta; /* malloc'd, 2 n numbers */
    size_t n, capacity; /* in rays */
};

enum kd_status kd_rays_list_add(struct kd_rays_list *list, double alpha, double beta, struct kd_error *error);

/* Where the value of the first member "rays" of the outermost object starts, if that is an array. */
bool kd_rays_list_find(const char *text, size_t length, size_t *start);

/* Append the array that begins at text[*at], and move *at behind it. text[length] is NUL. KD_EINVAL with a pointer
 * where a ray is not two finite numbers, without one where the text is not JSON. */
enum kd_status kd_rays_list_read(struct kd_rays_list *list, const char *text, size_t length, size_t *at,
                                 struct kd_error *error);

#endif
