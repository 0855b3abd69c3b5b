/* Parameter sets of a comparison, with a scene for each set. Sets are ordered so that they share pictures and lens
 * maps. Private to this module and to the file that estimates the cost of sets. */
#ifndef KD_INTEGRAL_SETS_H
#define KD_INTEGRAL_SETS_H

#include "integral/asked.h"

#include <cjson/cJSON.h>

#define KD_INTEGRAL_SETS_MOST 4096

struct kd_integral_set {
    struct kd_scene scene;
    double flux_jy, size, angle_deg; /* flux_jy is NaN for the flux of the request */
    uint32_t row;                    /* index of the set in the request */
    uint64_t group;                  /* group number of the scene; scenes with equal numbers share a lens map */
};

struct kd_integral_sets {
    cJSON *tree;                /* the member "sets" of the document, unchanged */
    struct kd_integral_set *at; /* sets ordered by group; sets with equal scenes are adjacent */
    size_t n;
    uint32_t *first; /* index of the first set of each picture; the last entry is n */
    unsigned pictures;
};

/* Moves the member "sets" from a document to the request, whose integral becomes KD_INTEGRAL_SETS. */
enum kd_status kd_integral_read_sets(struct kd_integral_request *request, cJSON *root, struct kd_error *error);
/* Makes a valid scene for each set, based on the request's scene. Returns KD_EINVAL at /sets/N. */
enum kd_status kd_integral_make_sets(struct kd_integral_request *request, struct kd_error *error);
void kd_integral_drop_sets(struct kd_integral_request *request);

#endif
