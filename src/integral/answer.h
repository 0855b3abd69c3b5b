/* Answers of integrals: functions that compute them, and that write their numbers and columns. Any thread. */
#ifndef KD_INTEGRAL_ANSWER_H
#define KD_INTEGRAL_ANSWER_H

#include "base/buffer.h"
#include "integral/request.h"
#include "integral/sets.h"
#include "render/plan/plan.h"

enum { KD_INTEGRAL_COLUMNS = 12, KD_INTEGRAL_VALUES = 12 };

/* Contents of an answer of one kind of integral, except its parameters. */
struct kd_integral_column {
    const char *name, *unit, *help; /* unit: NULL if the column is light, whose unit is that of the answer */
    bool words;                     /* true if the column's numbers stand for words (kd_integral_word) */
};
struct kd_integral_kind_of {
    const char *title;
    struct kd_integral_column values[KD_INTEGRAL_VALUES],
        columns[KD_INTEGRAL_COLUMNS];                   /* the list ends with a column without a name */
    const char *const *sources, *const *approximations; /* NULL-terminated lists of sentences */
};
const struct kd_integral_kind_of *kd_integral_kind_of(enum kd_integral what);

struct kd_integral_answer {
    const struct kd_integral_request *request;
    double values[KD_INTEGRAL_VALUES];
    /* flux of the last map, computed from its scene; NaN if the scene's light has no frequency */
    double map_jy;
    struct kd_alignment solved;        /* for a comparison: the result of the search */
    const struct kd_integral_set *set; /* for a comparison of sets: the current set; otherwise NULL */
    /* for a comparison: chi^2 of each product, for the map and for the finer map */
    double chi2[2][KD_PRODUCTS];
    size_t rows;
    /* each column has `rows` numbers; all are in one allocation, which begins at columns[0] */
    double *columns[KD_INTEGRAL_COLUMNS];
    const char *light; /* unit of columns that are light */
    /* Approximations of this answer, in addition to those that every integral of this kind has. They are sentences from
     * the plans of its pictures. */
    const char *told[KD_PLAN_MAX_APPROXIMATIONS];
    size_t n_told;
};

/* Allocates the answer's columns, with `rows` rows of zeros. */
enum kd_status kd_integral_make_columns(struct kd_integral_answer *answer, size_t rows, struct kd_error *error);

/* Computes an integral that needs no pictures; integral/run.h handles all integrals. The request must have been
 * checked. After a failure the answer need not be finished. The computation takes some 10 to 100 ms. It takes less for
 * a recently used spin and inclination, and up to some seconds for a corona off the axis. */
enum kd_status kd_integral_compute(const struct kd_integral_request *request, struct kd_integral_answer *answer,
                                   struct kd_error *error);
/* The word for a number of a column of words; NULL if the number stands for no word. */
const char *kd_integral_word(const struct kd_integral_answer *answer, size_t column, double number);
void kd_integral_answer_finish(struct kd_integral_answer *answer);

/* Formats of an answer. JSON: an object with the members "integral", "scene" (if there is one), "parameters", "values",
 * "columns", "units", "sources" and "approximations". CSV: a line of names, then the rows; for a simulated observation,
 * the EHT's CSV. NPY: an array with one record for each row. NPZ: an array for each column, and answer.json with the
 * other members of the JSON. UVFITS: only for a simulated observation whose request has a uvfits file. */
enum kd_integral_format { KD_INTEGRAL_JSON, KD_INTEGRAL_CSV, KD_INTEGRAL_NPY, KD_INTEGRAL_NPZ, KD_INTEGRAL_UVFITS };
/* Checks that the answer to a checked request can be written in this format. */
enum kd_status kd_integral_check_format(const struct kd_integral_request *request, enum kd_integral_format format,
                                        struct kd_error *error);
enum kd_status kd_integral_write(const struct kd_integral_answer *answer, enum kd_integral_format format,
                                 struct kd_buffer *out);

/* Writes, as the member `name`, the strict schema of an answer in JSON. */
void kd_integral_answer_schema(struct kd_json *json, const char *name, enum kd_integral what);

#endif
