/* An answer holds what kd_rays_trace found and is written as JSON, NPY or CSV, as a stream of bytes that is made
 * while it is read. A million rays in JSON are half a gigabyte; nobody holds it. Any thread, one at a time.
 *
 * JSON  {"spin", "observer", "orders", "accuracy": {engine, precision, steps, rays, undecided, tolerance,
 * followed_again, beyond, holds, worst_error, median_error},
 *       "approximations": [...], "rays": [{"fate", "crossings": [{order, r, phi, delay, g}], "sky": {theta, phi},
 *         "energy", "error"}]}
 *       A number that does not exist is left out, a sky too for a ray that does not escape.
 * NPY   records, in the order of the rays: fate (u1: 0 captured, 1 escaped, 2 undecided), n_crossings (u1), error,
 *       sky_theta, sky_phi (f8), r, phi, delay, g (f8, one a wanted order); NaN where there is none.
 *       Of an observer whose motion is told, `energy` (f8) comes last.
 * CSV   one line a ray: alpha, beta (of such an observer yaw_deg, pitch_deg), then as NPY, the wanted orders as r0,
 * phi0, delay0, g0, r1, ...; empty where there is none. */
#ifndef KD_RENDER_RAYS_ANSWER_H
#define KD_RENDER_RAYS_ANSWER_H

#include "base/buffer.h"
#include "render/emit/approximation.h"
#include "render/rays/rays.h"

enum kd_rays_format { KD_RAYS_JSON, KD_RAYS_NPY, KD_RAYS_CSV };

struct kd_rays_answer {
    struct kd_rays_params params;
    size_t n;
    double *alpha_beta; /* these three are malloc'd */
    struct kd_ray_crossing *crossings;
    struct kd_ray_end *ends;
    size_t undecided; /* these by kd_rays_answer_summarise */
    /* With a tolerance: rays that were followed again for it; those, the undecided among them, that are not within
     * it after all. */
    size_t followed_again, beyond;
    double worst_error, median_error; /* over the rays that have one; NaN if none has */
};

/* Room for n rays; takes alpha_beta over, also on failure. */
enum kd_status kd_rays_answer_init(struct kd_rays_answer *answer, const struct kd_rays_params *params,
                                   double *alpha_beta, size_t n, struct kd_error *error);
void kd_rays_answer_finish(struct kd_rays_answer *answer);
/* Bytes that init would allocate, the rays' own included. */
size_t kd_rays_answer_bytes(const struct kd_rays_params *params, size_t n);

enum kd_status kd_rays_answer_summarise(struct kd_rays_answer *answer, struct kd_error *error);

/* Approximations in force, in order: false after the last. params NULL: all there are. */
bool kd_rays_approximation(const struct kd_rays_params *params, size_t index, struct kd_approximation *out);

enum { KD_RAYS_ROW_MAX = 4096 };

struct kd_rays_stream {
    const struct kd_rays_answer *answer; /* summarised; must outlive the stream */
    enum kd_rays_format format;
    struct kd_buffer head;
    size_t head_at, next, row_size, row_at;
    bool tail_done;
    char row[KD_RAYS_ROW_MAX];
};

enum kd_status kd_rays_stream_init(struct kd_rays_stream *stream, const struct kd_rays_answer *answer,
                                   enum kd_rays_format format, struct kd_error *error);
void kd_rays_stream_finish(struct kd_rays_stream *stream);
/* Up to `size` more bytes; 0 at the end. Cannot fail. */
size_t kd_rays_stream_read(struct kd_rays_stream *stream, void *to, size_t size);
/* The bytes of the whole stream, which are known beforehand for NPY alone; else 0. */
size_t kd_rays_stream_size(const struct kd_rays_stream *stream);

#endif
