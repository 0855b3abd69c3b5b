/* Quantities: the numbers that GET /v1/physics/NAME and `kerrd physics NAME` give, listed in
 * docs/physics-quantities.md. Each quantity is a table of parameters and outputs, and one function. Requests, JSON,
 * CSV, options, OpenAPI and the reference page are generated from the table. To add a quantity, write a file like
 * kerr.c, and add a line to table.c.
 *
 * A parameter may be a range first:last:count of evenly spaced values including both ends. The answer then has a point
 * for each value. With several ranges the answer has a point for each combination of values; the last parameter of the
 * table varies fastest.
 *
 *     struct kd_quantity_request request;
 *     struct kd_quantity_answer answer = { 0 };
 *     kd_quantity_request_init(&request, kd_quantity_find("kerr"));
 *     if (kd_quantity_request_set(&request, "spin", "0:0.998:100", &error) || kd_quantity_evaluate(&request,
 *         &answer, &error))
 *         ...
 *     kd_quantity_json(&answer, &out);
 *     kd_quantity_answer_finish(&answer);
 *
 * Pure functions and constant data, any thread; no device is used. */
#ifndef KD_QUANTITY_QUANTITY_H
#define KD_QUANTITY_QUANTITY_H

#include "base/buffer.h"
#include "base/error.h"
#include "document/document.h"

#include <stdbool.h>
#include <stddef.h>

enum {
    KD_QUANTITY_PARAMETERS = 16, /* largest number of parameters of a quantity */
    KD_QUANTITY_OUTPUTS = 40,
    KD_QUANTITY_POINTS = KD_RANGE_MOST, /* largest number of points of an answer */
};

/* A parameter is a row whose value is a number or a word. A number may be limited to whole numbers. A number may also
 * have a word as an alternative; for this word the function gets INFINITY. For a parameter with words the function gets
 * the index of the word. The default is the text `typed`. */

/* An output is NaN where the quantity is undefined (`help` says where). NaN is null in JSON, and an empty field in
 * CSV. */
struct kd_output {
    const char *name, *unit, *help;
    bool fixed; /* true if the output does not depend on the quantity's last `along` parameters */
};

struct kd_quantity {
    const char *name, *summary;
    /* Rows of the parameters. The last `along` parameters vary along a curve; outputs that are `fixed` do not depend on
     * them. */
    const struct kd_row *parameters;
    size_t n_parameters, along;
    const struct kd_output *outputs;
    size_t n_outputs;
    const char *const *sources, *const *approximations; /* NULL-terminated lists of sentences */
    /* Function that evaluates one point. out[] and memory (memory_size bytes, initially zero) keep their contents from
     * one call to the next. fresh: true if a parameter other than the last `along` ones has changed since the last
     * call. It returns KD_EINVAL with the parameter's pointer if a value is outside the domain. */
    enum kd_status (*evaluate)(const double *in, double *out, void *memory, bool fresh, struct kd_error *error);
    size_t memory_size;
    /* Largest times on a core of 2020, in microseconds, including the text of the answer. point_us: for each point.
     * fresh_us: in addition, for each fresh point. */
    double point_us, fresh_us;
    bool sound; /* true if an answer of one point can be played as sound (quantity/sound.h) */
};

extern const struct kd_quantity *const kd_quantities[];
extern const size_t kd_quantity_count;
const struct kd_quantity *kd_quantity_find(const char *name); /* returns NULL if there is no quantity of this name */

/* Writes the names, "kerr, potential, ...", to out, cut off at `size` bytes. */
void kd_quantity_names(char *out, size_t size);

/* True if parameter i is one of those that vary along a curve. */
bool kd_quantity_is_along(const struct kd_quantity *quantity, size_t i);

extern const struct kd_row kd_quantity_digits; /* row of the parameter `digits`, which all quantities have */
struct kd_quantity_request {
    const struct kd_quantity *quantity;
    struct kd_range axes[KD_QUANTITY_PARAMETERS]; /* value or range of each parameter, in the order of the table */
    /* significant digits of numbers in lists, and of all numbers in CSV; KD_DECIMAL_DIGITS means all */
    uint32_t digits;
};

void kd_quantity_request_init(struct kd_quantity_request *request, const struct kd_quantity *quantity);
/* Sets the parameter with this name, or the digits if the name is "digits". Returns KD_EINVAL with "/name" if the name
 * is unknown or the value is invalid. */
enum kd_status kd_quantity_request_set(struct kd_quantity_request *request, const char *name, const char *text,
                                       struct kd_error *error);
/* number of points, at most KD_QUANTITY_POINTS + 1 */
size_t kd_quantity_points(const struct kd_quantity_request *request);
/* estimate of the time, from the quantity's table alone */
double kd_quantity_cost_ms(const struct kd_quantity_request *request);

struct kd_quantity_answer {
    struct kd_quantity_request request;
    size_t points;
    double *values; /* values of all points, points x n_outputs; owned by the answer */
};

/* Evaluates all points. Returns KD_EINVAL if there are more than KD_QUANTITY_POINTS points, or if any point is outside
 * the domain. */
enum kd_status kd_quantity_evaluate(const struct kd_quantity_request *request, struct kd_quantity_answer *answer,
                                    struct kd_error *error);
void kd_quantity_answer_finish(struct kd_quantity_answer *answer);

/* State of an evaluation one point at a time, which allows other work in between: call begin, then next until point
 * equals answer.points. */
struct kd_quantity_run {
    struct kd_quantity_answer answer;
    size_t point; /* number of points that have been evaluated */
    /* private */
    size_t at[KD_QUANTITY_PARAMETERS];
    double out[KD_QUANTITY_OUTPUTS];
    void *memory;
    bool fresh;
};
/* Begins an evaluation. After a failure the run need not be finished. */
enum kd_status kd_quantity_run_begin(struct kd_quantity_run *run, const struct kd_quantity_request *request,
                                     struct kd_error *error);
enum kd_status kd_quantity_run_next(struct kd_quantity_run *run, struct kd_error *error);
void kd_quantity_run_finish(struct kd_quantity_run *run);

/* Writes {"quantity", "parameters", "values", "units", "sources", "approximations"}. A parameter with a range is
 * written as an array of its values. Each output is then an array with one number for each point, except outputs that
 * do not depend on a range. With several ranges the arrays are flat, in row-major order; "ranges" and "shape" describe
 * them. */
enum kd_status kd_quantity_json(const struct kd_quantity_answer *answer, struct kd_buffer *out);
/* Writes a line of names, then one line for each point: all parameters, then all outputs. */
enum kd_status kd_quantity_csv(const struct kd_quantity_answer *answer, struct kd_buffer *out);

/* Write all quantities with their parameters and outputs. The first function writes JSON. The second writes the
 * document docs/physics-quantities.md. */
enum kd_status kd_quantity_list_json(struct kd_buffer *out);
enum kd_status kd_quantity_reference(struct kd_buffer *out);

#endif
