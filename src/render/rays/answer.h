/* The results of kd_rays_trace as JSON, NPY or CSV: a stream of bytes that is generated while it is read, because a
 * million rays in JSON are half a gigabyte. Any thread, one at a time.
 *
 * JSON  {"spin", "observer", "orders", "accuracy": {engine, precision, steps, rays, undecided, tolerance,
 * followed_again, beyond, holds, worst_error, median_error},
 *       "approximations": [...], "rays": [{"fate", "crossings": [{order, r, phi, delay, g}], "sky": {theta, phi},
 *         "energy", "error"}]}
 *       Numbers that do not exist are left out, and "sky" for a ray that does not escape.
 * NPY   records, in the order of the rays: fate (u1: 0 captured, 1 escaped, 2 undecided), n_crossings (u1), error,
 *       sky_theta, sky_phi (f8), r, phi, delay, g (f8, one for each requested order); NaN if undefined.
 *       For an observer whose motion is given, `energy` (f8) comes last.
 * CSV   one line a ray: alpha, beta (for such an observer yaw_deg, pitch_deg), then as NPY, with the requested
 *       orders as r0, phi0, delay0, g0, r1, ...; empty if undefined. */
#ifndef KD_RENDER_RAYS_ANSWER_H
#define KD_RENDER_RAYS_ANSWER_H

#include "base/buffer.h"
#include "render/emit/approximation.h"
#include "render/rays/rays.h"

enum kd_rays_format { KD_RAYS_JSON, KD_RAYS_NPY, KD_RAYS_CSV };

struct kd_rays_answer {
    struct kd_rays_params params;
    size_t n;
    double *alpha_beta; /* this member and the next two are malloc'd */
    struct kd_ray_crossing *crossings;
    struct kd_ray_end *ends;
    size_t undecided; /* kd_rays_answer_summarise sets this member and all members below it */
    /* Members used with a tolerance. followed_again: number of rays that were traced again to meet the tolerance;
     * beyond: number of rays that exceed the tolerance nevertheless, including undecided rays. */
    size_t followed_again, beyond;
    /* largest and median error of the rays that have an error; NaN if no ray has one */
    double worst_error, median_error;
};

/* Allocates room for n rays; takes ownership of alpha_beta, also on failure. */
enum kd_status kd_rays_answer_init(struct kd_rays_answer *answer, const struct kd_rays_params *params,
                                   double *alpha_beta, size_t n, struct kd_error *error);
void kd_rays_answer_finish(struct kd_rays_answer *answer);
/* Bytes that init would allocate, including the rays. */
size_t kd_rays_answer_bytes(const struct kd_rays_params *params, size_t n);

enum kd_status kd_rays_answer_summarise(struct kd_rays_answer *answer, struct kd_error *error);

/* Gets the approximation of that index among those in force. If params is NULL, gets it among all approximations of
 * rays. Returns false if the index is too large. */
bool kd_rays_approximation(const struct kd_rays_params *params, size_t index, struct kd_approximation *out);

enum { KD_RAYS_ROW_MAX = 4096 };

struct kd_rays_stream {
    const struct kd_rays_answer *answer; /* a summarised answer, which must outlive the stream */
    enum kd_rays_format format;
    struct kd_buffer head;
    size_t head_at, next, row_size, row_at;
    bool tail_done;
    char row[KD_RAYS_ROW_MAX];
};

enum kd_status kd_rays_stream_init(struct kd_rays_stream *stream, const struct kd_rays_answer *answer,
                                   enum kd_rays_format format, struct kd_error *error);
void kd_rays_stream_finish(struct kd_rays_stream *stream);
/* Writes up to `size` further bytes; returns 0 at the end. Cannot fail. */
size_t kd_rays_stream_read(struct kd_rays_stream *stream, void *to, size_t size);
/* Size of the whole stream; known in advance for NPY only, otherwise 0. */
size_t kd_rays_stream_size(const struct kd_rays_stream *stream);

#endif
