/* Writes the answers to requests for orbits. Pure; any thread.
 *
 * An answer has a head, which is known before the first step; the series; and a result, which follows from the
 * integration:
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

/* Write the parts of the answer for one orbit. Call them in this order. */
enum kd_status kd_orbit_answer_begin(const struct kd_orbit_run *run, enum kd_orbit_format format,
                                     struct kd_buffer *out);
/* first: number of samples that have already been written. */
enum kd_status kd_orbit_answer_samples(const struct kd_orbit_params *params, enum kd_orbit_format format,
                                       const struct kd_orbit_sample *samples, size_t n, size_t first,
                                       struct kd_buffer *out);
/* Writes the progress, only in NDJSON. */
enum kd_status kd_orbit_answer_progress(const struct kd_orbit_run *run, struct kd_buffer *out);
enum kd_status kd_orbit_answer_end(const struct kd_orbit_run *run, enum kd_orbit_format format, struct kd_buffer *out);

/* Writes the answer for many finished orbits; not in NDJSON. samples: for each orbit its run->samples samples, or NULL.
 */
enum kd_status kd_orbit_answer_many(const struct kd_orbit_run *runs, size_t n, const struct kd_orbit_sample *samples,
                                    enum kd_orbit_format format, struct kd_buffer *out);

/* Name of the column of the series with this index; NULL beyond the last column. Without an observer a series has only
 * the first ten columns. */
const char *kd_orbit_column(size_t index);

/* The sentence about the approximation with this index; NULL beyond the last approximation. */
const char *kd_orbit_approximation(const struct kd_orbit_run *run, size_t index);

#endif
