/* A feed: produces the bytes of an answer from a request in pieces of some 30 ms. Both POST /v1/orbits and `kerrd
 * orbit` use a feed. */
#ifndef KD_ORBIT_FEED_H
#define KD_ORBIT_FEED_H

#include "base/buffer.h"
#include "orbit/answer.h"
#include "orbit/batch.h"

#define KD_ORBIT_FEED_SAMPLES 256

struct kd_orbit_feed {
    const struct kd_orbit_request *request;
    enum kd_orbit_format format;
    enum { KD_FEED_START, KD_FEED_SERIES, KD_FEED_DONE } stage;
    struct kd_orbit_run run;     /* the run, if the request has one orbit */
    struct kd_orbit_batch batch; /* the batch, if the request has many orbits */
    uint64_t told;               /* number of steps done when progress was last written */
    struct kd_orbit_sample samples[KD_ORBIT_FEED_SAMPLES];
};

/* Makes a feed. The request must have been checked, and must outlive the feed. The function solves every orbit, and
 * returns KD_EINVAL where kd_orbit_run_init does. NDJSON is allowed for one orbit only. */
enum kd_status kd_orbit_feed_init(struct kd_orbit_feed *feed, const struct kd_orbit_request *request,
                                  enum kd_orbit_format format, struct kd_error *error);
void kd_orbit_feed_finish(struct kd_orbit_feed *feed);

/* Appends the next piece to `out`. If the request has many orbits, it appends nothing until all are done. It may return
 * KD_EINVAL before anything is written, as kd_orbit_run_prepare does. */
enum kd_status kd_orbit_feed_more(struct kd_orbit_feed *feed, struct kd_buffer *out, struct kd_error *error);
bool kd_orbit_feed_done(const struct kd_orbit_feed *feed);
double kd_orbit_feed_fraction(const struct kd_orbit_feed *feed);

/* Follows orbits of a batch. It is called on other threads than kd_orbit_feed_more. Returns false when no orbit is left
 * to begin.
 */
bool kd_orbit_feed_help(struct kd_orbit_feed *feed);

#endif
