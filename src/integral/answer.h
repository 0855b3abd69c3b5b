/* Answers of integrals: computes them, and writes their numbers and columns. Any thread. */
#ifndef KD_INTEGRAL_ANSWER_H
#define KD_INTEGRAL_ANSWER_H

#include "base/buffer.h"
#include "integral/request.h"
#include "integral/sets.h"
#include "render/plan/plan.h"

enum { KD_INTEGRAL_COLUMNS = 12, KD_INTEGRAL_VALUES = 12 };

/* Contents of an integral's answer, except its parameters. */
struct kd_integral_column {
    const char *name, *unit, *help; /* unit NULL: the answer's unit of light */
    bool words;                     /* the column's numbers are codes of words: kd_integral_word */
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
    double map_jy;                     /* flux of the last map, computed from its scene; NaN: the scene's light has no
                                        * frequency */
    struct kd_alignment solved;        /* result of a comparison's search */
    const struct kd_integral_set *set; /* for a comparison of sets: the current set; otherwise NULL */
    double chi2[2][KD_PRODUCTS];       /* for a comparison: chi^2 of the map, and chi^2 of the finer map */
    size_t rows;
    double *columns[KD_INTEGRAL_COLUMNS]; /* each has `rows` numbers; all are in one allocation, at columns[0] */
    const char *light;                    /* unit of columns that are light */
    /* Approximations besides those that every integral of this kind has: sentences from the plans of its pictures. */
    const char *told[KD_PLAN_MAX_APPROXIMATIONS];
    size_t n_told;
};

/* Allocates the answer's columns for this many rows, all 0. */
enum kd_status kd_integral_make_columns(struct kd_integral_answer *answer, size_t rows, struct kd_error *error);

/* Computes an integral that needs no pictures (integral/run.h handles all). The request must have been checked. On
 * failure there is nothing to finish. Takes some 10 to 100 ms, less for a recently used spin and inclination, but up
 * to some seconds for a corona off the axis. */
enum kd_status kd_integral_compute(const struct kd_integral_request *request, struct kd_integral_answer *answer,
                                   struct kd_error *error);
/* The word that a number of a column of words stands for; NULL: none. */
const char *kd_integral_word(const struct kd_integral_answer *answer, size_t column, double number);
void kd_integral_answer_finish(struct kd_integral_answer *answer);

/* JSON: {"integral", "scene" if it has one, "parameters", "values", "columns", "units", "sources",
 * "approximations"}. CSV: a line of names, then the rows; for a simulated observation, the EHT's CSV. NPY: one record a
 * row. NPZ: an array for each column, and answer.json, the rest of the JSON. UVFITS: only for a simulated observation
 * whose request has a uvfits file. */
enum kd_integral_format { KD_INTEGRAL_JSON, KD_INTEGRAL_CSV, KD_INTEGRAL_NPY, KD_INTEGRAL_NPZ, KD_INTEGRAL_UVFITS };
/* Checks that the answer to a checked request exists in this format. */
enum kd_status kd_integral_check_format(const struct kd_integral_request *request, enum kd_integral_format format,
                                        struct kd_error *error);
enum kd_status kd_integral_write(const struct kd_integral_answer *answer, enum kd_integral_format format,
                                 struct kd_buffer *out);

/* Writes the strict schema of such a JSON answer as the member `name`. */
void kd_integral_answer_schema(struct kd_json *json, const char *name, enum kd_integral what);

#endif
