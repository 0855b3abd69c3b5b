/* Functions shared by the files of this module. */
#ifndef KD_INTEGRAL_INTERNAL_H
#define KD_INTEGRAL_INTERNAL_H

#include "base/error.h"
#include "integral/asked.h"

#include <cjson/cJSON.h>

#define KD_UAS_PER_RADIAN (180 * 3.6e9 / M_PI)

/* request.c */
const struct kd_row *kd_integral_field_named(const struct kd_integral_request *request,
                                             const char *name); /* The field of this name; NULL if there is none. */
/* Replaces a list by one with room for n numbers. */
enum kd_status kd_integral_make_room(struct kd_integral_request *request, const struct kd_row *f, size_t n,
                                     const char *pointer, struct kd_number_list **list, struct kd_error *error);

/* check.c */
bool kd_integral_given(const struct kd_integral_request *request, const char *name);
/* Checks that the numbers of a list are strictly increasing. */
enum kd_status kd_integral_check_growth(const struct kd_number_list *list, const char *name, struct kd_error *error);
/* Refuses a list together with fields that would generate the same list. */
enum kd_status kd_integral_check_beside(const struct kd_integral_request *request, const char *list,
                                        const char *const *others, size_t n, struct kd_error *error);
/* Fills a list with n numbers in geometric progression. If `first` is 0, the numbers are the midpoints of n equal parts
 * of the range from 0 to 1. */
enum kd_status kd_integral_fill_list(struct kd_integral_request *request, const char *name, uint32_t n, double first,
                                     double last, struct kd_error *error);
/* The corona of a request whose emissivity is ring, disk or slab. */
struct kd_corona_shape kd_integral_corona(const struct kd_integral_request *request);
enum kd_status kd_integral_check_frequencies(struct kd_integral_request *request, uint32_t most,
                                             struct kd_error *error);

/* echo.c: integrals of an echo. image: image of the request's disk. */
struct kd_disk_image;
struct kd_integral_answer;
enum kd_status kd_integral_impulse(const struct kd_integral_request *request, const struct kd_disk_image *image,
                                   struct kd_integral_answer *answer, struct kd_error *error);
enum kd_status kd_integral_lags(const struct kd_integral_request *request, const struct kd_disk_image *image,
                                struct kd_integral_answer *answer, struct kd_error *error);

/* compute.c: parameters of the line of a checked request. */
struct kd_line_params kd_integral_line_params(const struct kd_integral_request *request);

/* scene.c */
/* Reads the members "preset" and "scene" of a document. */
enum kd_status kd_integral_read_scene(struct kd_integral_request *request, const cJSON *root, struct kd_error *error);
/* Check that the scene's picture is such that visibilities can be computed from it. */
enum kd_status kd_integral_check_flat(const struct kd_scene *scene, struct kd_error *error);
enum kd_status kd_integral_check_visibility(struct kd_integral_request *request, struct kd_error *error);

/* compare.c */
enum kd_status kd_integral_read_observation(struct kd_integral_request *request, const cJSON *root,
                                            struct kd_error *error);
void kd_integral_drop_observation(struct kd_integral_request *request);
enum kd_status kd_integral_check_map(struct kd_integral_request *request, struct kd_error *error); /* scene.c */

/* observe.c */
enum kd_status kd_integral_check_observe(struct kd_integral_request *request, struct kd_error *error);
enum kd_status kd_integral_check_compare(struct kd_integral_request *request, struct kd_error *error);

enum kd_status kd_integral_check_volume(struct kd_integral_request *request, struct kd_error *error);

#endif
