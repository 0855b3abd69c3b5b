/* Parses the long array of a request, [[alpha, beta], ...], without building a tree. Private to src/render. */
#ifndef KD_RENDER_RAYS_LIST_H
#define KD_RENDER_RAYS_LIST_H

#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>

struct kd_rays_list {
    double *alpha_beta; /* malloc'd, 2 n numbers */
    size_t n, capacity; /* n: number of rays; capacity: number of rays for which there is room */
};

enum kd_status kd_rays_list_add(struct kd_rays_list *list, double alpha, double beta, struct kd_error *error);

/* Finds the value of the first member "rays" of the outermost object; returns false unless that value is an array. */
bool kd_rays_list_find(const char *text, size_t length, size_t *start);

/* Appends the array that begins at text[*at], and moves *at past it. text[length] must be NUL. Returns KD_EINVAL: with
 * a pointer if a ray is not two finite numbers, without one if the text is not JSON. */
enum kd_status kd_rays_list_read(struct kd_rays_list *list, const char *text, size_t length, size_t *at,
                                 struct kd_error *error);

#endif
