/* An integral is computed and written: a few numbers, and columns of them. Any thread. */
#ifndef KD_INTEGRAL_ANSWER_H
#define KD_INTEGRAL_ANSWER_H

#include "base/buffer.h"
#include "integral/request.h"
#include "render/plan/plan.h"

enum { KD_INTEGRAL_COLUMNS = 12, KD_INTEGRAL_VALUES = 8 };

/* What an integral's answer holds besides its parameters. */
struct kd_integral_column {
    const char *name, *unit, *help; /* unit NULL: that of the answer's light */
    bool words;                     /* its numbers stand for words: kd_integral_word */
};
struct kd_integral_kind_of {
    const char *title;
    struct kd_integral_column values[KD_INTEGRAL_VALUES], columns[KD_INTEGRAL_COLUMNS]; /* up to one without a name */
    const char *const *sources, *const *approximations;                                 /* sentences, up to a NULL */
};
const struct kd_integral_kind_of *kd_integral_kind_of(enum kd_integral what);

struct kd_integral_answer {
    const struct kd_integral_request *request;
    double values[KD_INTEGRAL_VALUES];
    double map_jy;               /* flux of the last map, as its scene has it; NaN: its light is of no frequency */
    double chi2[2][KD_PRODUCTS]; /* of a comparison: of the map, and of the finer one */
    size_t rows;
    double *columns[KD_INTEGRAL_COLUMNS]; /* rows of each; one allocation, that of the first */
    const char *light;                    /* unit of columns that are of light */
    const char
        *told[KD_PLAN_MAX_APPROXIMATIONS]; /* besides what its kind leaves out: sentences of the pictures' plan */
    size_t n_told;
};

/* Room for so many rows of the answer's columns, all 0. */
enum kd_status kd_integral_make_columns(struct kd_integral_answer *answer, size_t rows, struct kd_error *error);

/* Of one that is made of no pictures (integral/run.h is for all). The request has been checked. One that fails
 * leaves nothing to finish. Some 10 to 100 ms; of a spin and an inclination that were asked for lately, less. */
enum kd_status kd_integral_compute(const struct kd_integral_request *request, struct kd_integral_answer *answer,
                                   struct kd_error *error);
/* What a number of a column of words stands for; NULL: nothing. */
const char *kd_integral_word(const struct kd_integral_answer *answer, size_t column, double number);
void kd_integral_answer_finish(struct kd_integral_answer *answer);

/* JSON: {"integral", "scene" where it has one, "parameters", "values", "columns", "units", "sources",
 * "approximations"}; CSV: a line of names, then the rows; NPY: a record for each row. */
enum kd_integral_format { KD_INTEGRAL_JSON, KD_INTEGRAL_CSV, KD_INTEGRAL_NPY };
enum kd_status kd_integral_write(const struct kd_integral_answer *answer, enum kd_integral_format format,
                                 struct kd_buffer *out);

/* The strict schema of such an answer as JSON, as the member `name`. */
void kd_integral_answer_schema(struct kd_json *json, const char *name, enum kd_integral what);

#endif
