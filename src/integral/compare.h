/* Integrals that compare a scene with an observation, or simulate an observation. Private to this module. */
#ifndef KD_INTEGRAL_COMPARE_H
#define KD_INTEGRAL_COMPARE_H

#include "integral/answer.h"

/* Fills the columns that do not depend on the model. */
void kd_integral_compare_lay_out(struct kd_integral_answer *answer);
/* Processes the model's visibilities (in Jy if the scene has a flux): fills the columns and chi^2. For a finer map it
 * fills only chi^2 of that map, and the error. */
void kd_integral_compare_judge(struct kd_integral_answer *answer, double (*model)[2], bool finer);
/* Write, into an answer, the members that only comparisons have; and the schemas of these members. */
void kd_integral_compare_write(struct kd_json *json, const struct kd_integral_answer *answer);
void kd_integral_compare_schema(struct kd_json *json);
/* Processes one set of a comparison: fills the set's row from the model's visibilities. model: NULL if the picture is
 * dark. */
void kd_integral_sets_judge(struct kd_integral_answer *answer, double (*model)[2]);
void kd_integral_sets_write(struct kd_json *json, const struct kd_integral_answer *answer);
void kd_integral_sets_schema(struct kd_json *json);
/* Writes the member about the observation, which answers of comparisons and simulations have. */
void kd_integral_observation_write(struct kd_json *json, const struct kd_integral_request *request);
void kd_integral_observation_schema(struct kd_json *json, bool compared);

/* For a simulation (observe.c): processes the model's visibilities, and fills the columns. For a finer map it fills
 * only the error. */
void kd_integral_observe_lay_out(struct kd_integral_answer *answer);
void kd_integral_observe_take(struct kd_integral_answer *answer, uint8_t *marks, double (*model)[2],
                              double (*simulated)[2], bool finer);
/* Writes the observation in its own formats: the EHT's CSV, or uvfits. */
enum kd_status kd_integral_observe_csv(const struct kd_integral_answer *answer, struct kd_buffer *out);

#endif
