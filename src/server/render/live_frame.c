#include "server/render/live_frame.h"

#include "base/hash.h"
#include "base/json.h"
#include "physics/spacetime/kerr.h"
#include "render/output/clock.h"
#include "render/output/notes.h"
#include "scene/hole.h"
#include "server/http/reply.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Number of rays along a side of a pixel at the critical curve, divided by that number for other pixels. */
static unsigned critical_side(const struct kd_plan_lens *lens)
{
    return lens->critical ? (unsigned)lround(sqrt(lens->critical)) / lens->side : 1;
}

static void describe_quality(struct kd_live_frame *frame, const struct kd_render_job *job)
{
    const struct kd_plan *p = &job->plan;
    snprintf(frame->quality, sizeof frame->quality,
             "width=%u height=%u samples=%u critical=%u orders=%u engine=%s precision=%s steps=%u sketch=%d bright=%d "
             "exposure=%.6g",
             p->picture.width, p->picture.height, p->lens.side, critical_side(&p->lens), p->lens.orders,
             kd_engine_name(p->lens.setting.engine), kd_precision_name(p->lens.setting.precision),
             p->lens.setting.steps, p->light.march.sketched, p->light.bright, job->frame.exposure);
}

static void describe_timing(struct kd_live_frame *frame, const struct kd_render_job *job)
{
    size_t n = (size_t)snprintf(frame->timing, sizeof frame->timing, "queue;dur=%.3f%s", job->queue_ms,
                                job->frame.lens_reused ? ", trace;desc=\"reused\";dur=0" : "");
    for (size_t i = 0; i < job->frame.n_timings && n < sizeof frame->timing; i++)
        n += (size_t)snprintf(frame->timing + n, sizeof frame->timing - n, ", %s;dur=%.3f", job->frame.timings[i].name,
                              job->frame.timings[i].ms);
}

static void add_quality(struct kd_json *json, const struct kd_render_job *job, const struct kd_live_note *note)
{
    const struct kd_plan *p = &job->plan;
    kd_json_object(json, "quality");
    kd_json_number(json, "width", p->picture.width);
    kd_json_number(json, "height", p->picture.height);
    kd_json_number(json, "samples", p->lens.side);
    kd_json_number(json, "critical", critical_side(&p->lens));
    kd_json_number(json, "orders", p->lens.orders);
    kd_json_string(json, "engine", kd_engine_name(p->lens.setting.engine));
    kd_json_string(json, "precision", kd_precision_name(p->lens.setting.precision));
    kd_json_number(json, "steps", p->lens.setting.steps);
    kd_json_bool(json, "sketch", p->light.march.sketched);
    kd_json_bool(json, "bright", p->light.bright);
    kd_json_bool(json, "final", note->final);
    kd_json_end(json);
}

static void add_passes(struct kd_json *json, const struct kd_render_job *job)
{
    kd_json_object(json, "passes");
    kd_json_number(json, "queue", job->queue_ms);
    for (size_t i = 0; i < job->frame.n_timings; i++)
        kd_json_number(json, job->frame.timings[i].name, job->frame.timings[i].ms);
    kd_json_number(json, "encode", job->encode_ms);
    kd_json_end(json);
}

static void add_accuracy(struct kd_json *json, const struct kd_accuracy_report *report, const struct kd_plan_lens *lens)
{
    kd_json_object(json, "accuracy");
    kd_json_number(json, "rays", (double)lens->rays);
    kd_json_number(json, "critical_rays", (double)(kd_plan_rays(lens) - lens->rays));
    kd_accuracy_members(json, report, "median", "worst");
    kd_json_end(json);
}

static void add_stokes(struct kd_json *json, const struct kd_light *light, bool circular)
{
    kd_json_array(json, "stokes");
    kd_json_number(json, NULL, light->flux);
    kd_json_number(json, NULL, light->q);
    kd_json_number(json, NULL, light->u);
    if (circular)
        kd_json_number(json, NULL, light->v);
    kd_json_end(json);
    kd_json_number(json, "polarization_fraction", kd_light_fraction(light));
    kd_json_number(json, "evpa", kd_light_evpa(light));
}

static void add_light(struct kd_json *json, const struct kd_light_report *report, const struct kd_light *light)
{
    kd_json_number(json, "flux", light->flux);
    if (report->polarized)
        add_stokes(json, light, report->circular);
    if (isnan(light->x)) {
        kd_json_null(json, "centroid");
        return;
    }
    kd_json_array(json, "centroid");
    kd_json_number(json, NULL, light->x);
    kd_json_number(json, NULL, light->y);
    kd_json_end(json);
}

static void add_lights(struct kd_json *json, const struct kd_light_report *report)
{
    kd_json_object(json, "light");
    add_light(json, report, &report->all);
    kd_json_object(json, "spots");
    add_light(json, report, &report->spots);
    kd_json_end(json);
    kd_json_end(json);
}

static void add_orbit(struct kd_json *json, const struct kd_hole *hole, double r)
{
    kd_json_number(json, "r", r);
    kd_json_number(json, "period", 2 * M_PI / kd_kerr_omega(hole, r));
}

static void add_isco(struct kd_json *json, const struct kd_scene *scene)
{
    kd_json_object(json, "isco");
    add_orbit(json, kd_scene_hole(scene), kd_kerr_isco(kd_scene_hole(scene)));
    kd_json_end(json);
}

static void add_simulation(struct kd_json *json, const struct kd_scene *scene)
{
    double wave;
    kd_json_object(json, "simulation");
    kd_json_number(json, "time_rate", scene->motion.time_rate);
    kd_json_number(json, "particles", scene->disk.model == KD_DISK_PARTICLES ? scene->disk.particles : 0);
    if (kd_scene_ringdown(scene, &wave))
        kd_json_number(json, "ringdown", wave);
    kd_json_end(json);
}

/* Adds the positions of the spots' centres at the time of the frame. */
static void add_orbits(struct kd_json *json, const struct kd_scene *scene)
{
    kd_json_array(json, "orbits");
    for (size_t i = 0; i < scene->spots.count; i++) {
        const struct kd_spot *spot = &scene->spots.at[i];
        if (!(spot->brightness > 0))
            continue;
        double turned = remainder(kd_kerr_omega(kd_scene_hole(scene), spot->r) * scene->top.time, 2 * M_PI);
        kd_json_object(json, NULL);
        kd_json_number(json, "spot", (double)i + 1);
        kd_json_number(json, "phi_deg", remainder(spot->phase_deg + turned * (180 / M_PI), 360));
        add_orbit(json, kd_scene_hole(scene), spot->r);
        kd_json_end(json);
    }
    kd_json_end(json);
}

static enum kd_status describe_event(struct kd_live_frame *frame, const struct kd_render_job *job,
                                     const struct kd_live_note *note)
{
    struct kd_json whole = kd_json_begin(&frame->event), *json = &whole;
    struct kd_fall_clock clock;
    kd_json_object(json, NULL);
    kd_json_number(json, "frame", (double)note->number);
    kd_json_number(json, "revision", note->revision);
    kd_json_number(json, "time", job->scene.top.time);
    kd_json_number(json, "azimuth_deg", job->scene.camera.azimuth_deg);
    kd_json_number(json, "r", job->scene.camera.r); /* infinity becomes null */
    if (kd_scene_clock(&job->scene, &clock))
        kd_fall_clock_json(&clock, json, "clock");
    kd_json_number(json, "exposure", job->frame.exposure);
    kd_json_number(json, "fps", note->fps);
    kd_json_number(json, "bytes", (double)frame->files[0].bytes.size);
    add_quality(json, job, note);
    add_passes(json, job);
    kd_json_bool(json, "lens_map_reused", job->frame.lens_reused);
    add_accuracy(json, &job->frame.accuracy, &job->plan.lens);
    add_simulation(json, &job->scene);
    add_isco(json, &job->scene);
    add_orbits(json, &job->scene);
    if (job->frame.light.measured && job->plan.light.apart)
        add_lights(json, &job->frame.light);
    if (!isnan(kd_flux_jy(&job->scene, &job->frame)))
        kd_json_number(json, "flux_jy", kd_flux_jy(&job->scene, &job->frame));
    if (job->scene.volume.normalise_to_jy > 0)
        kd_json_number(json, "density_scale", job->frame.density_scale);
    kd_json_end(json);
    return kd_json_finish(json);
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
    frame->azimuth_deg = job->scene.camera.azimuth_deg;
    frame->final = note->final;
    frame->last = note->last;
    frame->files[frame->n_files++] = (struct kd_live_file) { job->format, job->lossy, job->file, job->encode_ms };
    job->file = (struct kd_buffer) { 0 };
    kd_accuracy_text(&job->frame.accuracy, &job->plan.lens, frame->accuracy);
    kd_fall_clock_text(&job->scene, frame->clock);
    kd_flux_text(&job->scene, &job->frame, frame->flux);
    describe_quality(frame, job);
    describe_timing(frame, job);
    enum kd_status status;
    KD_TRY(describe_event(frame, job, note));
    struct kd_approximation one;
    for (size_t i = 0; kd_picture_approximation(&job->plan.report, &job->frame.accuracy, i, &one); i++)
        KD_TRY(kd_reply_item(&frame->approximations, one.name));
    frame->sentences = (uint32_t)kd_hash(KD_HASH_BEGIN, frame->approximations.data, frame->approximations.size);
done:
    if (!status && job->keeps) {
        frame->picture = job->frame;
        job->frame = (struct kd_frame) { 0 };
    }
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
    for (unsigned i = 0; i < frame->n_files; i++)
        kd_buffer_finish(&frame->files[i].bytes);
    kd_frame_finish(&frame->picture);
    kd_buffer_finish(&frame->approximations);
    kd_buffer_finish(&frame->event);
    free(frame);
}
