/* Writes the answers to requests for orbits. Pure; any thread.
 *
 * A document has a head (known before the first step), the series, and a result (from the integration):
 *
 *     JSON     {head, "series": {"columns": [...], "rows": [[...], ...]}, "result": {...}}; {"orbits": [...]} for
 *              many
 *     NDJSON   {"head": {...}}, {"columns": [...]}, then {"rows": [[...], ...]} and {"progress": 0.25} interleaved,
 *              {"result": {...}}
 *     CSV      the columns' names, then one line for each sample; for many orbits without series, one for each orbit
 *     NPY      records with the columns' names; for many orbits without series, one record for each; with series an
 *              array of shape (orbits, samples)
 *
 * NAN is null in JSON and empty in CSV. */
#ifndef KD_ORBIT_ANSWER_H
#define KD_ORBIT_ANSWER_H

#include "base/buffer.h"
#include "orbit/run.h"

enum kd_orbit_format { KD_ORBIT_JSON, KD_ORBIT_NDJSON, KD_ORBIT_CSV, KD_ORBIT_NPY };

/* Parts of the answer for one orbit, to be written in this order. */
enum kd_status kd_orbit_answer_begin(const struct kd_orbit_run *run, enum kd_orbit_format format,
                                     struct kd_buffer *out);
/* first: number of samples written before. */
enum kd_status kd_orbit_answer_samples(const struct kd_orbit_params *params, enum kd_orbit_format format,
                                       const struct kd_orbit_sample *samples, size_t n, size_t first,
                                       struct kd_buffer *out);
enum kd_status kd_orbit_answer_progress(const struct kd_orbit_run *run, struct kd_buffer *out); /* NDJSON only */
enum kd_status kd_orbit_answer_end(const struct kd_orbit_run *run, enum kd_orbit_format format, struct kd_buffer *out);

/* Writes the answer for many finished orbits; not for NDJSON. samples: run->samples of each orbit, or NULL. */
enum kd_status kd_orbit_answer_many(const struct kd_orbit_run *runs, size_t n, const struct kd_orbit_sample *samples,
                                    enum kd_orbit_format format, struct kd_buffer *out);

/* Name of a column of the series; NULL beyond the last. Without an observer a series has only the first ten columns. */
const char *kd_orbit_column(size_t index);

/* The sentence with this index about an approximation; NULL beyond the last. */
const char *kd_orbit_approximation(const struct kd_orbit_run *run, size_t index);

#endif
