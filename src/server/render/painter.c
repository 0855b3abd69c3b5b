#include "server/render/painter.h"

#include "base/allocator.h"
#include "base/clock.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/nice.h"
#include "base/read.h"
#include "base/replace.h"
#include "render/output/format.h"
#include "server/render/pulse.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define NICE 10   /* niceness of the thread: it gets a tenth of the weight of live frames */
#define IDLE_S 10 /* number of seconds without requests after which the painter closes its device */
#define FILE_MAX_BYTES ((size_t)1 << 20)

struct kd_painter {
    struct kd_renderer_params params;
    const char *device_name;
    char *kept_at;
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    struct kd_painting *first, **end; /* pictures that wait */
    bool ending;
    _Atomic bool cancelled;
    struct kd_renderer *renderer; /* used only by the painter's thread; NULL while it is not open */
    _Atomic bool hangs;           /* true if the device hangs, so that it can be neither closed nor reopened */
    struct kd_pulse pulse;        /* watchdog of the present picture */
};

/* Header of a cached file; the picture follows. */
struct head {
    char magic[8];
    uint64_t bytes, hash;
    char mark[128];
};
static const char magic[8] = "kdsmall";

static struct head head_of(const struct kd_painting *work, const uint8_t *png, size_t bytes)
{
    struct head head = { .bytes = bytes, .hash = kd_hash(KD_HASH_BEGIN, png, bytes) };
    memcpy(head.magic, magic, sizeof magic);
    snprintf(head.mark, sizeof head.mark, "%s", work->mark);
    return head;
}

static char *path_of(const struct kd_painter *painter, const struct kd_painting *work)
{
    char *path = NULL;
    return painter->kept_at && asprintf(&path, "%s%s", painter->kept_at, work->name) >= 0 ? path : NULL;
}

static bool recall(const struct kd_painter *painter, struct kd_painting *work)
{
    char *path = path_of(painter, work);
    struct kd_buffer file = { 0 };
    bool good = path && kd_read_file(AT_FDCWD, path, 0, FILE_MAX_BYTES, &file) && file.size > sizeof(struct head);
    if (good) {
        const uint8_t *png = (const uint8_t *)file.data + sizeof(struct head);
        const struct head head = head_of(work, png, file.size - sizeof head);
        good = !memcmp(&head, file.data, sizeof head) && !kd_buffer_append(&work->png, png, head.bytes);
    }
    kd_buffer_finish(&file);
    free(path);
    return good;
}

static void keep(const struct kd_painter *painter, const struct kd_painting *work)
{
    char *path = path_of(painter, work);
    struct kd_buffer file = { 0 };
    const struct head head = head_of(work, work->png.data, work->png.size);
    if (path && !kd_buffer_append(&file, &head, sizeof head) &&
        !kd_buffer_append(&file, work->png.data, work->png.size) && !kd_replace_file(path, file.data, file.size))
        kd_log(KD_LOG_DEBUG, "cannot write %s: %s", path, strerror(errno));
    kd_buffer_finish(&file);
    free(path);
}

static bool go_on(void *user, double fraction)
{
    struct kd_painter *painter = user;
    (void)fraction;
    kd_pulse_beat(&painter->pulse);
    return !atomic_load(&painter->cancelled);
}

static enum kd_status open_device(struct kd_painter *painter, struct kd_error *error)
{
    if (painter->renderer)
        return KD_OK;
    if (atomic_load(&painter->hangs))
        return kd_error_set(error, KD_EDEVICE, "the device for small pictures hangs");
    return kd_renderer_create(&painter->params, &painter->renderer, error);
}

static void close_device(struct kd_painter *painter)
{
    if (!painter->renderer)
        return;
    kd_renderer_assets_stop(painter->renderer);
    if (!atomic_load(&painter->hangs))
        kd_renderer_destroy(painter->renderer);
    painter->renderer = NULL;
    kd_allocator_trim();
}

static enum kd_status paint_once(struct kd_painter *painter, struct kd_painting *work)
{
    struct kd_capacity capacity;
    struct kd_plan plan;
    struct kd_frame frame = { 0 };
    struct kd_error *error = &work->error;
    enum kd_status status;
    kd_buffer_finish(&work->png); /* discards the bytes of a failed attempt */
    KD_TRY(open_device(painter, error));
    kd_renderer_capacity(painter->renderer, &capacity);
    KD_TRY(kd_format_plan(kd_formats[0], &work->scene, &capacity, &plan, error));
    KD_TRY(kd_render(painter->renderer, &work->scene, &plan, go_on, painter, &frame, error));
    const struct kd_picture picture = { &frame, &work->scene, &plan, painter->device_name, 0 };
    KD_TRY(kd_encode(kd_formats[0], &picture, KD_EFFORT_KEEP, NULL, &work->png, error));
    work->painted = true;
    keep(painter, work);
done:
    kd_frame_finish(&frame);
    if (status == KD_EDEVICE && painter->renderer) {
        atomic_store(&painter->hangs, kd_renderer_hangs(painter->renderer));
        close_device(painter); /* paint() reopens the device if necessary */
    }
    return status;
}

/* Renders a picture. If the device fails, it is reopened once. */
static enum kd_status paint(struct kd_painter *painter, struct kd_painting *work)
{
    enum kd_status status = paint_once(painter, work);
    if (status == KD_EDEVICE && !atomic_load(&painter->hangs)) {
        kd_log(KD_LOG_WARN, "the device for small pictures has failed and is reopened: %s", work->error.message);
        status = paint_once(painter, work);
    }
    return status;
}

static void serve(struct kd_painter *painter, struct kd_painting *work)
{
    if (atomic_load(&painter->cancelled))
        work->status =
            kd_error_set(&work->error, KD_ECANCELLED, "the server is stopping and renders no more small pictures");
    else if (!recall(painter, work)) {
        kd_pulse_beat(&painter->pulse);
        work->status = paint(painter, work);
        kd_pulse_rest(&painter->pulse);
    }
    work->error.status = work->status;
    work->done(work);
}

/* Waits for the next picture. Returns NULL if none is requested for IDLE_S seconds, or at the end. Called with the
 * lock held. */
static struct kd_painting *await(struct kd_painter *painter)
{
    struct timespec until;
    clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_sec += IDLE_S;
    for (int late = 0; !painter->first && !painter->ending && !late;)
        late = painter->renderer ? pthread_cond_timedwait(&painter->changed, &painter->lock, &until)
                                 : pthread_cond_wait(&painter->changed, &painter->lock);
    struct kd_painting *work = painter->first;
    if (work && !(painter->first = work->next))
        painter->end = &painter->first;
    return work;
}

static void *painter_main(void *user)
{
    struct kd_painter *painter = user;
    kd_nice_thread(NICE);
    pthread_mutex_lock(&painter->lock);
    for (;;) {
        struct kd_painting *work = await(painter);
        const bool over = !work && painter->ending;
        pthread_mutex_unlock(&painter->lock);
        if (work)
            serve(painter, work);
        else
            close_device(painter);
        if (over)
            return NULL;
        pthread_mutex_lock(&painter->lock);
    }
}

enum kd_status kd_painter_create(const struct kd_renderer_params *params, const char *device_name, char *kept_at,
                                 struct kd_painter **out, struct kd_error *error)
{
    struct kd_painter *painter = calloc(1, sizeof *painter);
    if (!painter) {
        free(kept_at);
        return kd_error_set(error, KD_ENOMEM, "out of memory for the renderer of small pictures");
    }
    *painter = (struct kd_painter) { .params = *params, .device_name = device_name, .kept_at = kept_at };
    /* The painter's device is not tested, because the render queue has already tested this device. */
    painter->params.prove = NULL;
    painter->params.asset_read = NULL;
    painter->params.passing = true;
    if (!params->memory_bytes || params->memory_bytes > KD_PAINTER_BYTES)
        painter->params.memory_bytes = KD_PAINTER_BYTES;
    painter->end = &painter->first;
    pthread_mutex_init(&painter->lock, NULL);
    pthread_condattr_t steady;
    pthread_condattr_init(&steady);
    pthread_condattr_setclock(&steady, CLOCK_MONOTONIC);
    pthread_cond_init(&painter->changed, &steady);
    pthread_condattr_destroy(&steady);
    if (!pthread_create(&painter->thread, NULL, painter_main, painter))
        return *out = painter, KD_OK;
    pthread_cond_destroy(&painter->changed);
    pthread_mutex_destroy(&painter->lock);
    free(kept_at);
    free(painter);
    return kd_error_set(error, KD_ENOMEM, "the thread for small pictures could not be started");
}

void kd_painter_paint(struct kd_painter *painter, struct kd_painting *painting)
{
    painting->next = NULL;
    pthread_mutex_lock(&painter->lock);
    *painter->end = painting;
    painter->end = &painting->next;
    pthread_cond_signal(&painter->changed);
    pthread_mutex_unlock(&painter->lock);
}

bool kd_painter_hangs(struct kd_painter *painter)
{
    return atomic_load(&painter->hangs) || kd_pulse_missing_s(&painter->pulse, painter->params.deadline_ms) > 0;
}

void kd_painter_cancel(struct kd_painter *painter) { atomic_store(&painter->cancelled, true); }

void kd_painter_destroy(struct kd_painter *painter)
{
    if (!painter)
        return;
    kd_painter_cancel(painter);
    pthread_mutex_lock(&painter->lock);
    painter->ending = true;
    pthread_cond_signal(&painter->changed);
    pthread_mutex_unlock(&painter->lock);
    pthread_join(painter->thread, NULL);
    pthread_cond_destroy(&painter->changed);
    pthread_mutex_destroy(&painter->lock);
    free(painter->kept_at);
    free(painter);
}
