/* Parameter sets of a comparison: a scene for each set, ordered so that pictures and lens maps are shared. Private
 * to this module, and to the file that estimates the cost of the sets. */
#ifndef KD_INTEGRAL_SETS_H
#define KD_INTEGRAL_SETS_H

#include "integral/asked.h"

#include <cjson/cJSON.h>

#define KD_INTEGRAL_SETS_MOST 4096

struct kd_integral_set {
    struct kd_scene scene;
    double flux_jy, size, angle_deg; /* flux_jy NaN: the flux of the request */
    uint32_t row;                    /* index of the set in the request */
    uint64_t group;                  /* scenes with equal groups share a lens map */
};

struct kd_integral_sets {
    cJSON *tree;                /* the member "sets", as it was in the document */
    struct kd_integral_set *at; /* ordered by group; equal scenes are adjacent */
    size_t n;
    uint32_t *first; /* first set of each picture, followed by n */
    unsigned pictures;
};

/* Takes the member "sets" out of a document, whose integral becomes KD_INTEGRAL_SETS. */
enum kd_status kd_integral_read_sets(struct kd_integral_request *request, cJSON *root, struct kd_error *error);
/* Makes a valid scene for each set from the request's scene. Returns KD_EINVAL at /sets/N. */
enum kd_status kd_integral_make_sets(struct kd_integral_request *request, struct kd_error *error);
void kd_integral_drop_sets(struct kd_integral_request *request);

#endif
