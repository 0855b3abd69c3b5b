#include "server/live_frame.h"

#include "physics/kerr.h"
#include "render/picture.h"
#include "server/reply.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void describe_quality(struct kd_live_frame *frame, const struct kd_render_job *job, const struct kd_live_note *note)
{
    const struct kd_plan *p = &job->plan;
    snprintf(frame->quality, sizeof frame->quality, "width=%u height=%u samples=%u orders=%u engine=%s precision=%s steps=%u final=%d",
             p->width, p->height, p->side, p->orders, kd_engine_name(p->setting.engine), kd_precision_name(p->setting.precision),
             p->setting.steps, note->final);
}

static void describe_timing(struct kd_live_frame *frame, const struct kd_render_job *job)
{
    size_t n = (size_t)snprintf(frame->timing, sizeof frame->timing, "queue;dur=%.3f%s", job->queue_ms,
                                job->frame.lens_reused ? ", trace;desc=\"reused\";dur=0" : "");
    for (size_t i = 0; i < job->frame.n_timings && n < sizeof frame->timing; i++)
        n += (size_t)snprintf(frame->timing + n, sizeof frame->timing - n, ", %s;dur=%.3f", job->frame.timings[i].name,
                              job->frame.timings[i].ms);
    if (n < sizeof frame->timing)
        snprintf(frame->timing + n, sizeof frame->timing - n, ", encode;dur=%.3f", job->encode_ms);
}

static cJSON *quality_json(const struct kd_render_job *job, const struct kd_live_note *note)
{
    const struct kd_plan *p = &job->plan;
    cJSON *o = cJSON_CreateObject();
    cJSON_AddNumberToObject(o, "width", p->width);
    cJSON_AddNumberToObject(o, "height", p->height);
    cJSON_AddNumberToObject(o, "samples", p->side);
    cJSON_AddNumberToObject(o, "orders", p->orders);
    cJSON_AddStringToObject(o, "engine", kd_engine_name(p->setting.engine));
    cJSON_AddStringToObject(o, "precision", kd_precision_name(p->setting.precision));
    cJSON_AddNumberToObject(o, "steps", p->setting.steps);
    cJSON_AddBoolToObject(o, "final", note->final);
    return o;
}

static cJSON *accuracy_json(const struct kd_accuracy_report *report, const struct kd_plan *plan)
{
    cJSON *o = cJSON_CreateObject();
    cJSON_AddNumberToObject(o, "rays", (double)plan->rays);
    cJSON_AddNumberToObject(o, "critical_rays", (double)(kd_plan_rays(plan) - plan->rays));
    cJSON_AddNumberToObject(o, "undecided", (double)report->undecided);
    cJSON_AddNumberToObject(o, "sampled", report->sampled);
    if (report->sampled) {
        cJSON_AddNumberToObject(o, "crossings", report->crossings);
        cJSON_AddNumberToObject(o, "differ", report->differ);
        cJSON_AddNumberToObject(o, "median", report->median);
        cJSON_AddNumberToObject(o, "worst", report->worst);
    }
    return o;
}

static void add_light(cJSON *o, const struct kd_light *light)
{
    const double at[] = { light->x, light->y };
    cJSON_AddNumberToObject(o, "flux", light->flux);
    cJSON_AddItemToObject(o, "centroid", isnan(light->x) ? cJSON_CreateNull() : cJSON_CreateDoubleArray(at, 2));
}

static cJSON *light_json(const struct kd_light_report *report)
{
    cJSON *o = cJSON_CreateObject(), *spots = cJSON_CreateObject();
    add_light(o, &report->all);
    add_light(spots, &report->spots);
    cJSON_AddItemToObject(o, "spots", spots);
    return o;
}

static void add_orbit(cJSON *o, double spin, double r)
{
    cJSON_AddNumberToObject(o, "r", r);
    cJSON_AddNumberToObject(o, "period", 2 * M_PI / kd_kerr_omega(spin, r));
}

static cJSON *isco_json(const struct kd_scene *scene)
{
    cJSON *o = cJSON_CreateObject();
    add_orbit(o, scene->spacetime.spin, kd_kerr_isco(scene->spacetime.spin));
    return o;
}

static cJSON *simulation_json(const struct kd_scene *scene)
{
    cJSON *o = cJSON_CreateObject();
    double wave;
    cJSON_AddNumberToObject(o, "time_rate", scene->motion.time_rate);
    cJSON_AddNumberToObject(o, "particles", scene->disk.model == KD_DISK_PARTICLES ? scene->disk.particles : 0);
    if (kd_scene_ringdown(scene, &wave))
        cJSON_AddNumberToObject(o, "ringdown", wave);
    return o;
}

/* Where the centre of each spot that is on stands at the frame's time. */
static cJSON *orbits_json(const struct kd_scene *scene)
{
    const struct kd_spot *spots[KD_SPOTS] = { &scene->spot1, &scene->spot2, &scene->spot3 };
    cJSON *list = cJSON_CreateArray();
    for (int i = 0; i < KD_SPOTS; i++) {
        if (!(spots[i]->brightness > 0))
            continue;
        cJSON *o = cJSON_CreateObject();
        double turned = remainder(kd_kerr_omega(scene->spacetime.spin, spots[i]->r) * scene->top.time, 2 * M_PI);
        cJSON_AddNumberToObject(o, "spot", i + 1);
        cJSON_AddNumberToObject(o, "phi_deg", remainder(spots[i]->phase_deg + turned * (180 / M_PI), 360));
        add_orbit(o, scene->spacetime.spin, spots[i]->r);
        cJSON_AddItemToArray(list, o);
    }
    return list;
}

static enum kd_status describe_event(struct kd_live_frame *frame, const struct kd_render_job *job, const struct kd_live_note *note)
{
    cJSON *o = cJSON_CreateObject(), *passes = cJSON_CreateObject();
    cJSON_AddNumberToObject(o, "frame", (double)note->number);
    cJSON_AddNumberToObject(o, "revision", note->revision);
    cJSON_AddNumberToObject(o, "time", job->scene.top.time);
    cJSON_AddNumberToObject(o, "azimuth_deg", job->scene.camera.azimuth_deg);
    cJSON_AddNumberToObject(o, "exposure", job->frame.exposure);
    cJSON_AddNumberToObject(o, "fps", note->fps);
    cJSON_AddNumberToObject(o, "bytes", (double)frame->png.size);
    cJSON_AddItemToObject(o, "quality", quality_json(job, note));
    cJSON_AddNumberToObject(passes, "queue", job->queue_ms);
    for (size_t i = 0; i < job->frame.n_timings; i++)
        cJSON_AddNumberToObject(passes, job->frame.timings[i].name, job->frame.timings[i].ms);
    cJSON_AddNumberToObject(passes, "encode", job->encode_ms);
    cJSON_AddItemToObject(o, "passes", passes);
    cJSON_AddBoolToObject(o, "lens_map_reused", job->frame.lens_reused);
    cJSON_AddItemToObject(o, "accuracy", accuracy_json(&job->frame.accuracy, &job->plan));
    cJSON_AddItemToObject(o, "simulation", simulation_json(&job->scene));
    cJSON_AddItemToObject(o, "isco", isco_json(&job->scene));
    cJSON_AddItemToObject(o, "orbits", orbits_json(&job->scene));
    if (job->frame.light.measured)
        cJSON_AddItemToObject(o, "light", light_json(&job->frame.light));
    char *text = cJSON_PrintUnformatted(o);
    enum kd_status status = text ? kd_buffer_printf(&frame->event, "%s", text) : KD_ENOMEM;
    cJSON_free(text);
    cJSON_Delete(o);
    return status;
}

struct kd_live_frame *kd_live_frame_make(struct kd_render_job *job, const struct kd_live_note *note)
{
    struct kd_live_frame *frame = calloc(1, sizeof *frame);
    if (!frame)
        return NULL;
    frame->references = 1;
    frame->number = note->number;
    frame->revision = note->revision;
    frame->time = job->scene.top.time;
    frame->png = job->png;
    job->png = (struct kd_buffer) { 0 };
    kd_accuracy_text(&job->frame.accuracy, &job->plan, frame->accuracy);
    describe_quality(frame, job, note);
    describe_timing(frame, job);
    enum kd_status status = describe_event(frame, job, note);
    for (size_t i = 0; i < job->plan.n_approximations && !status; i++)
        status = kd_reply_quote(&frame->approximations, job->plan.approximations[i]);
    if (!status)
        return frame;
    kd_live_frame_release(frame);
    return NULL;
}

struct kd_live_frame *kd_live_frame_share(struct kd_live_frame *frame)
{
    atomic_fetch_add(&frame->references, 1);
    return frame;
}

void kd_live_frame_release(struct kd_live_frame *frame)
{
    if (!frame || atomic_fetch_sub(&frame->references, 1) > 1)
        return;
    kd_buffer_finish(&frame->png);
    kd_buffer_finish(&frame->approximations);
    kd_buffer_finish(&frame->event);
    free(frame);
}
