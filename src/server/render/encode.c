/* Encoder threads, which turn rendered frames into files. */
#include "base/clock.h"
#include "server/render/render_internal.h"

/* True if a frame takes long to encode. Only one encoder at a time accepts such frames, so that other frames need
 * not wait. */
static bool is_long(const struct kd_render_job *job)
{
    return job->claim.class == KD_CLASS_JOB || kd_render_frame_bytes(job) > KD_LONG_FRAME;
}

void kd_render_encode(struct kd_render_queue *queue, struct kd_render_job *job)
{
    kd_render_list_append(&queue->encoding, job);
    queue->frame_bytes += kd_render_frame_bytes(job);
    pthread_cond_broadcast(&queue->changed);
}

static struct kd_render_job *take_next(struct kd_render_queue *queue)
{
    struct kd_render_job **link = &queue->encoding.first;
    while (*link && queue->encoding_long && is_long(*link))
        link = &(*link)->next;
    return *link ? kd_render_list_take(&queue->encoding, link) : NULL;
}

static void encode(struct kd_render_queue *queue, struct kd_render_job *job, struct kd_encoder *encoder)
{
    double start = kd_clock_ms();
    const struct kd_picture picture = { &job->frame, &job->scene, &job->plan, kd_render_queue_device_name(queue),
                                        job->number, job->lossy,  job->hash };
    job->status = kd_encode(job->format, &picture, job->effort, encoder, &job->file, &job->error);
    job->encode_ms = kd_clock_ms() - start;
    kd_render_measures_encoded(&queue->measures, job->encode_ms);
    if (!job->keeps)
        kd_frame_drop_layers(&job->frame);
}

void *kd_render_encode_main(void *user)
{
    struct kd_render_queue *queue = user;
    struct kd_encoder encoder = { 0 };
    pthread_mutex_lock(&queue->lock);
    while (!queue->closing || queue->unfinished) {
        struct kd_render_job *job = take_next(queue);
        if (!job) {
            pthread_cond_wait(&queue->changed, &queue->lock);
            continue;
        }
        size_t bytes = kd_render_frame_bytes(job);
        bool takes_long = is_long(job);
        queue->encoding_long |= takes_long;
        pthread_mutex_unlock(&queue->lock);
        encode(queue, job, &encoder);
        pthread_mutex_lock(&queue->lock);
        queue->frame_bytes -= bytes;
        queue->encoding_long &= !takes_long;
        kd_render_next(queue); /* because jobs may have waited for the memory of this frame */
        pthread_mutex_unlock(&queue->lock);
        kd_render_finish(queue, job);
        pthread_mutex_lock(&queue->lock);
    }
    pthread_mutex_unlock(&queue->lock);
    kd_encoder_finish(&encoder);
    return NULL;
}
