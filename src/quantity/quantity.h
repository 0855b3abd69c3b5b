/* Quantities are the numbers that GET /v1/physics/NAME and `kerrd physics NAME` give by name, and
 * docs/physics-quantities.md lists. Each is a table of parameters and outputs and one function; requests, JSON, CSV,
 * options, OpenAPI and the reference page follow from it. To add one: a file like kerr.c and a line in table.c.
 *
 * A parameter may be a range, first:last:count, of evenly spaced values with both ends. The answer then has a point
 * for each value; with several ranges for each combination, the last parameter of the table varying fastest.
 *
 *     struct kd_quantity_request request;
 *     struct kd_quantity_answer answer = { 0 };
 *     kd_quantity_request_init(&request, kd_quantity_find("kerr"));
 *     if (kd_quantity_request_set(&request, "spin", "0:0.998:100", &error) || kd_quantity_evaluate(&request,
 *       &answer, &error))
 *         ...
 *     kd_quantity_json(&answer, &out);
 *     kd_quantity_answer_finish(&answer);
 *
 * Pure functions and constant data, any thread; nothing here looks at a device. */
#ifndef KD_QUANTITY_QUANTITY_H
#define KD_QUANTITY_QUANTITY_H

#include "base/buffer.h"
#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>

enum {
    KD_QUANTITY_PARAMETERS = 16, /* at most, of one quantity */
    KD_QUANTITY_OUTPUTS = 40,
    KD_QUANTITY_POINTS = 100000, /* of one answer */
};

/* A number in its range, or `word` (INFINITY in the function), or one of `words` ("a|b|c": the index, no range). */
struct kd_parameter {
    const char *name, *unit, *help; /* unit "1": a pure number */
    const char *initial;            /* as a request writes it; may be a range */
    double minimum, maximum;        /* both included, unless open */
    bool open;
    bool whole; /* whole numbers alone */
    bool along; /* outputs that are `fixed` do not depend on it; these come last */
    const char *word, *words;
};

/* NaN where there is no such number (help says when): null in JSON, an empty field in CSV. */
struct kd_output {
    const char *name, *unit, *help;
    bool fixed; /* the same along the parameters that are `along` */
};

struct kd_quantity {
    const char *name, *summary;
    const struct kd_parameter *parameters;
    size_t n_parameters;
    const struct kd_output *outputs;
    size_t n_outputs;
    const char *const *sources, *const *approximations; /* sentences, up to a NULL */
    /* Evaluates one point. out[] and memory (zeroed at first, memory_size bytes) keep what the last call left;
     * `fresh` when a parameter that is not `along` has changed since. KD_EINVAL with the parameter's pointer for
     * what lies outside the domain. */
    enum kd_status (*evaluate)(const double *in, double *out, void *memory, bool fresh, struct kd_error *error);
    size_t memory_size;
    /* The longest time on one core of 2020, in microseconds, with the text of the answer: of each point, and of each
     * fresh one besides. */
    double point_us, fresh_us;
    bool sound; /* a point of it can be heard: quantity/sound.h */
};

extern const struct kd_quantity *const kd_quantities[];
extern const size_t kd_quantity_count;
const struct kd_quantity *kd_quantity_find(const char *name); /* NULL: none of that name */

/* "kerr, potential, ..." into out, cut if it must be. */
void kd_quantity_names(char *out, size_t size);

/* The first word of "a|b|c" into out; returns the others, "" after the last. */
enum { KD_WORD_TEXT = 40 };
const char *kd_parameter_word(const char *words, char out[KD_WORD_TEXT]);

/* What a parameter allows: "0 to 10 M, and \"isco\"". */
enum { KD_ALLOWED_TEXT = 200 };
void kd_parameter_allowed(const struct kd_parameter *parameter, char out[KD_ALLOWED_TEXT]);

struct kd_axis {
    double first, last;
    size_t count; /* 1: one value */
};
double kd_axis_at(const struct kd_axis *axis, size_t i);

struct kd_quantity_request {
    const struct kd_quantity *quantity;
    struct kd_axis axes[KD_QUANTITY_PARAMETERS]; /* in the order of the parameters */
    int digits; /* significant, of the numbers in lists and of all in CSV; KD_DECIMAL_DIGITS: all */
};

void kd_quantity_request_init(struct kd_quantity_request *request, const struct kd_quantity *quantity);
/* "digits" sets the digits. KD_EINVAL with "/name" for a name that is no parameter and a value that it does not
 * allow. */
enum kd_status kd_quantity_request_set(struct kd_quantity_request *request, const char *name, const char *text,
                                       struct kd_error *error);
size_t kd_quantity_points(const struct kd_quantity_request *request);  /* saturates at KD_QUANTITY_POINTS + 1 */
double kd_quantity_cost_ms(const struct kd_quantity_request *request); /* estimated, from the table alone */

struct kd_quantity_answer {
    struct kd_quantity_request request;
    size_t points;
    double *values; /* points x n_outputs; owned */
};

/* KD_EINVAL for more than KD_QUANTITY_POINTS points, and for what lies outside the domain at any of them. */
enum kd_status kd_quantity_evaluate(const struct kd_quantity_request *request, struct kd_quantity_answer *answer,
                                    struct kd_error *error);
void kd_quantity_answer_finish(struct kd_quantity_answer *answer);

/* Does the same a point at a time, for a caller that has other work in between: begin, then next until point is
 * answer.points. */
struct kd_quantity_run {
    struct kd_quantity_answer answer;
    size_t point; /* how many there are */
    /* its own */
    size_t at[KD_QUANTITY_PARAMETERS];
    double out[KD_QUANTITY_OUTPUTS];
    void *memory;
    bool fresh;
};
/* A failed begin leaves nothing to finish. */
enum kd_status kd_quantity_run_begin(struct kd_quantity_run *run, const struct kd_quantity_request *request,
                                     struct kd_error *error);
enum kd_status kd_quantity_run_next(struct kd_quantity_run *run, struct kd_error *error);
void kd_quantity_run_finish(struct kd_quantity_run *run);

/* {"quantity", "parameters", "values", "units", "sources", "approximations"}. A parameter that is a range is an
 * array of its values; values are then arrays too, one number a point, but for outputs that no range changes. With
 * several ranges they are flat, in row-major order, and "ranges" and "shape" say of what. */
enum kd_status kd_quantity_json(const struct kd_quantity_answer *answer, struct kd_buffer *out);
/* A line of names, then one line a point: every parameter, every output. */
enum kd_status kd_quantity_csv(const struct kd_quantity_answer *answer, struct kd_buffer *out);

/* What there is: every quantity with its parameters and outputs, as JSON; and docs/physics-quantities.md. */
enum kd_status kd_quantity_list_json(struct kd_buffer *out);
enum kd_status kd_quantity_reference(struct kd_buffer *out);

#endif
