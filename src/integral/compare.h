/* A comparison with an observation, as an integral. Private to this module. */
#ifndef KD_INTEGRAL_COMPARE_H
#define KD_INTEGRAL_COMPARE_H

#include "integral/answer.h"

/* What is known of the rows before a model is. */
void kd_integral_compare_lay_out(struct kd_integral_answer *answer);
/* Takes the model's visibilities, in Jy where the scene has them, and fills columns and chi^2; of a finer map chi^2 and
 * the error alone. */
void kd_integral_compare_judge(struct kd_integral_answer *answer, double (*model)[2], bool finer);
/* The members of an answer that no other integral has, and their schemas. */
void kd_integral_compare_write(struct kd_json *json, const struct kd_integral_answer *answer);
void kd_integral_compare_schema(struct kd_json *json);

#endif
