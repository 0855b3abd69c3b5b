/* Writes orbits as text and bytes. Pure; any thread.
 *
 * A document has a head (what is known before the first step), the series and a result (what integrating it showed):
 *
 *     JSON     {head, "series": {"columns": [...], "rows": [[...], ...]}, "result": {...}}; {"orbits": [...]} of
 *              many
 *     NDJSON   {"head": {...}}, {"columns": [...]}, {"rows": [[...], ...]} and {"progress": 0.25} in turns,
 *              {"result": {...}}
 *     CSV      the columns' names, then a line a sample; of many without series a line an orbit
 *     NPY      records with the columns' names; of many without series a record an orbit, with series of shape
 *              (orbits, samples)
 *
 * NAN is null in JSON and empty in CSV. */
#ifndef KD_ORBIT_ANSWER_H
#define KD_ORBIT_ANSWER_H

#include "base/buffer.h"
#include "orbit/run.h"

enum kd_orbit_format { KD_ORBIT_JSON, KD_ORBIT_NDJSON, KD_ORBIT_CSV, KD_ORBIT_NPY };

/* The parts of the answer for one orbit, in their order. */
enum kd_status kd_orbit_answer_begin(const struct kd_orbit_run *run, enum kd_orbit_format format,
                                     struct kd_buffer *out);
/* first: how many were written before. */
enum kd_status kd_orbit_answer_samples(const struct kd_orbit_params *params, enum kd_orbit_format format,
                                       const struct kd_orbit_sample *samples, size_t n, size_t first,
                                       struct kd_buffer *out);
enum kd_status kd_orbit_answer_progress(const struct kd_orbit_run *run, struct kd_buffer *out); /* NDJSON only */
enum kd_status kd_orbit_answer_end(const struct kd_orbit_run *run, enum kd_orbit_format format, struct kd_buffer *out);

/* The answer for many orbits, all of them done; not as NDJSON. samples: run->samples of each, or NULL. */
enum kd_status kd_orbit_answer_many(const struct kd_orbit_run *runs, size_t n, const struct kd_orbit_sample *samples,
                                    enum kd_orbit_format format, struct kd_buffer *out);

/* Columns of a series, in their order; the first ones are those of an orbit that nobody looks at. NULL past the
 * last. */
const char *kd_orbit_column(size_t index);

/* Sentences on what is approximated; NULL past the last. */
const char *kd_orbit_approximation(const struct kd_orbit_run *run, size_t index);

#endif
