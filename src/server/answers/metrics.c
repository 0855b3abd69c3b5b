/* GET /metrics: counters, gauges and histograms in Prometheus's text format 0.0.4. */
#include "server/asset/store.h"
#include "server/http/measures.h"
#include "server/http/process.h"
#include "server/http/reply.h"
#include "server/render/queue.h"
#include "server/render/thumbnails.h"
#include "server/job/jobs.h"
#include "server/playground/sessions.h"
#include "server/session/sessions.h"

static enum kd_status add(struct kd_buffer *out, const char *name, const char *type, const char *help, double value)
{
    return kd_buffer_printf(out, "# HELP kerrd_%s %s\n# TYPE kerrd_%s %s\nkerrd_%s %.17g\n", name, help, name, type,
                            name, value);
}

static enum kd_status add_answers(struct kd_buffer *out, struct kd_server *server)
{
    enum kd_status status =
        kd_buffer_printf(out, "# HELP kerrd_answers_total Requests answered, by the first digit of the status.\n"
                              "# TYPE kerrd_answers_total counter\n");
    for (unsigned i = 1; i < KD_STATUS_CLASSES && !status; i++)
        status =
            kd_buffer_printf(out, "kerrd_answers_total{status=\"%uxx\"} %lu\n", i, atomic_load(&server->answers[i]));
    return status;
}

static enum kd_status add_jobs(struct kd_buffer *out, const struct kd_jobs_counts *jobs)
{
    return kd_buffer_printf(
        out,
        "# HELP kerrd_jobs Stored jobs, by state.\n# TYPE kerrd_jobs gauge\nkerrd_jobs{state=\"waiting\"} "
        "%u\nkerrd_jobs{state=\"running\"} %u\nkerrd_jobs{state=\"done\"} %u\nkerrd_jobs{state=\"failed\"} %u\n",
        jobs->waiting, jobs->running, jobs->done, jobs->failed);
}

struct counts {
    struct kd_sessions_counts sessions;
    struct kd_jobs_counts jobs;
    struct kd_playground_sessions_counts playgrounds;
};

/* Counts for the health routes, whose thread must not block. If another thread holds a lock for long, for example
 * while a job is written to a slow disk, the previous counts are reported. */
static struct counts count(struct kd_server *server)
{
    struct counts now;
    bool sessions = kd_sessions_counts(server->sessions, &now.sessions), jobs = kd_jobs_counts(server->jobs, &now.jobs);
    const bool playgrounds = kd_playground_sessions_counts(server->playgrounds, &now.playgrounds);
    pthread_mutex_lock(&server->lock);
    if (sessions)
        server->sessions_counts = now.sessions;
    if (jobs)
        server->jobs_counts = now.jobs;
    if (playgrounds)
        server->playgrounds_counts = now.playgrounds;
    now = (struct counts) { server->sessions_counts, server->jobs_counts, server->playgrounds_counts };
    pthread_mutex_unlock(&server->lock);
    return now;
}

enum MHD_Result kd_handle_metrics(struct kd_request *request)
{
    struct kd_server *s = request->server;
    struct kd_buffer text = { 0 };
    struct counts now = count(s);
    unsigned assets;
    uint64_t asset_bytes;
    kd_asset_store_count(s->assets, &assets, &asset_bytes);
    const struct {
        const char *name, *type, *help;
        double value;
    } rows[] = {
        { "requests", "gauge", "Requests in progress.", atomic_load(&s->requests) },
        { "renders_unfinished", "gauge", "Pictures and other device work that wait, are rendered or are encoded.",
          kd_render_queue_unfinished(s->renders) },
        { "device_reopened_total", "counter", "Number of times that the device failed and was reopened.",
          kd_render_queue_reopened(s->renders) },
        { "render_backlog_seconds", "gauge", "Estimated device time of the waiting work.",
          1e-3 * kd_render_queue_backlog_ms(s->renders) },
        { "rays_unfinished", "gauge", "Requests for rays in progress.", kd_scheduler_unfinished(s->rays) },
        { "turns_unfinished", "gauge", "Orbits, long quantities and checks of jobs in progress.",
          kd_scheduler_unfinished(s->scheduler) },
        { "sessions", "gauge", "Live sessions.", now.sessions.sessions },
        { "session_viewers", "gauge", "Requests and streams that wait for frames of sessions.", now.sessions.viewers },
        { "thumbnails_rendered_total", "counter", "Small pictures of presets rendered, each once.",
          kd_thumbnails_rendered(s->thumbnails) },
        { "session_frames_total", "counter", "Frames of sessions encoded.", (double)now.sessions.frames },
        { "session_bytes_total", "counter", "Bytes of these frames, independent of the number of viewers.",
          (double)now.sessions.bytes },
        { "playgrounds", "gauge", "Live playgrounds.", now.playgrounds.open },
        { "playground_watchers", "gauge", "Requests and streams that wait for changes of playgrounds.",
          now.playgrounds.watchers },
        { "playground_bytes", "gauge", "Reserved memory of the playgrounds.", (double)now.playgrounds.bytes },
        { "playground_steps_total", "counter", "Sub-steps of running playgrounds.", (double)now.playgrounds.steps },
        { "playground_events_total", "counter", "Events in playgrounds.", (double)now.playgrounds.events },
        { "job_frames_total", "counter", "Frames of jobs finished.", (double)now.jobs.frames },
        { "job_bytes", "gauge", "Bytes of the frames of all jobs on disk.", (double)now.jobs.bytes },
        { "assets", "gauge", "Stored assets.", assets },
        { "asset_bytes", "gauge", "Bytes of all assets.", (double)asset_bytes },
        { "bodies_bytes", "gauge", "Bodies being received.", (double)kd_bytes_held(s->bodies) },
        { "replies_bytes", "gauge", "Answers that their clients have not read.", (double)kd_bytes_held(s->replies) },
        { "serving", "gauge", "1 until the server has been asked to stop.", atomic_load(&s->phase) == KD_SERVING },
    };
    enum kd_status status;
    KD_TRY(add_answers(&text, s));
    KD_TRY(add_jobs(&text, &now.jobs));
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        KD_TRY(add(&text, rows[i].name, rows[i].type, rows[i].help, rows[i].value));
    KD_TRY(kd_render_queue_metrics(s->renders, &text));
    KD_TRY(kd_measures_write(s->measures, &text));
    KD_TRY(kd_process_write(&text));
done:
    return kd_reply_json(request, status, &text, request->route->answer);
}
