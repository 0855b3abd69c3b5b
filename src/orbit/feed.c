#include "orbit/feed.h"

#define STEPS 65536u          /* number of steps in a piece, which takes some 25 ms */
#define SEEN 4                /* number of samples in a piece if there is an observer; the piece takes some 8 ms */
#define STEPS_A_LINE 1000000u /* number of steps between two lines of progress, which takes some 0.4 s */

enum kd_status kd_orbit_feed_init(struct kd_orbit_feed *feed, const struct kd_orbit_request *request,
                                  enum kd_orbit_format format, struct kd_error *error)
{
    feed->request = request;
    feed->format = format;
    feed->stage = KD_FEED_START;
    feed->told = 0;
    feed->batch = (struct kd_orbit_batch) { 0 };
    if (!request->many)
        return kd_orbit_run_init(&feed->run, request, 0, error);
    if (format == KD_ORBIT_NDJSON)
        return kd_error_field(error, "/orbits",
                              "application/x-ndjson cannot be used with a list of orbits, because it streams one "
                              "orbit; a list needs JSON, CSV or NPY");
    return kd_orbit_batch_init(&feed->batch, request, error);
}

void kd_orbit_feed_finish(struct kd_orbit_feed *feed) { kd_orbit_batch_finish(&feed->batch); }

static enum kd_status out_of_memory(enum kd_status status, struct kd_error *error)
{
    return status ? kd_error_set(error, status, "out of memory for the answer") : KD_OK;
}

static enum kd_status more_of_one(struct kd_orbit_feed *feed, struct kd_buffer *out, struct kd_error *error)
{
    struct kd_orbit_run *run = &feed->run;
    enum kd_status status = KD_OK;
    if (feed->stage == KD_FEED_START) {
        if ((status = kd_orbit_run_prepare(&run, 1, error)))
            return status;
        feed->stage = KD_FEED_SERIES;
        return out_of_memory(kd_orbit_answer_begin(run, feed->format, out), error);
    }
    size_t first = run->sampled, n = kd_orbit_run_advance(run, STEPS, feed->samples,
                                                          kd_orbit_is_seen(run->params) ? SEEN : KD_ORBIT_FEED_SAMPLES);
    if (n)
        status = kd_orbit_answer_samples(run->params, feed->format, feed->samples, n, first, out);
    if (!status && feed->format == KD_ORBIT_NDJSON && run->done - feed->told >= STEPS_A_LINE) {
        feed->told = run->done;
        status = kd_orbit_answer_progress(run, out);
    }
    if (!status && kd_orbit_run_done(run)) {
        feed->stage = KD_FEED_DONE;
        status = kd_orbit_answer_end(run, feed->format, out);
    }
    return out_of_memory(status, error);
}

static enum kd_status more_of_many(struct kd_orbit_feed *feed, struct kd_buffer *out, struct kd_error *error)
{
    struct kd_orbit_batch *batch = &feed->batch;
    kd_orbit_batch_turn(batch);
    if (!kd_orbit_batch_done(batch))
        return KD_OK;
    feed->stage = KD_FEED_DONE;
    if (batch->failed)
        return batch->error.status == KD_EINVAL
                   ? kd_error_field(error, batch->error.pointer, "%s", batch->error.message)
                   : kd_error_set(error, batch->error.status, "%s", batch->error.message);
    return out_of_memory(kd_orbit_answer_many(batch->runs, batch->n, batch->samples, feed->format, out), error);
}

enum kd_status kd_orbit_feed_more(struct kd_orbit_feed *feed, struct kd_buffer *out, struct kd_error *error)
{
    return feed->request->many ? more_of_many(feed, out, error) : more_of_one(feed, out, error);
}

bool kd_orbit_feed_done(const struct kd_orbit_feed *feed) { return feed->stage == KD_FEED_DONE; }

double kd_orbit_feed_fraction(const struct kd_orbit_feed *feed)
{
    if (!feed->request->many)
        return kd_orbit_run_fraction(&feed->run);
    return (double)atomic_load(&feed->batch.finished) / (double)feed->batch.n;
}

bool kd_orbit_feed_help(struct kd_orbit_feed *feed) { return kd_orbit_batch_turn(&feed->batch); }
