/* kerrd film: renders all frames of a job's request, and makes a film or another file from them. */
#include "base/program.h"
#include "cli/cli.h"
#include "cli/ending.h"
#include "cli/file.h"
#include "cli/film_state.h"
#include "cli/frames.h"
#include "cli/progress.h"
#include "cli/scene_command.h"
#include "cli/stats.h"
#include "job/exposure.h"
#include "job/frame.h"
#include "playground/show.h"
#include "scene/sha256.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { KEY_RATE = 256, KEY_STATE, KEY_SAMPLES, KEY_SHUTTER, KEY_ONLY };

struct arguments {
    struct kd_scene_command base; /* scene options; their document is the request of a film */
    const char *state;
    const struct kd_gather_format *kind; /* format of the film; NULL: only frames are made */
    unsigned rate, samples, first, last; /* first, last: numbers of the first and last frame to render */
    bool only;
    double shutter;
};

static const struct argp_option table[] = {
    { "output", 'o', "FILE", 0,
      "file to write: .mp4 (H.264) or .webm (VP9), which need the program ffmpeg, or .zip (numbered pictures); "
      "required without --only",
      0 },
    { "rate", KEY_RATE, "N", 0, "frames a second, 1 to 120 (default: 24)", 0 },
    { "samples", KEY_SAMPLES, "N", 0,
      "motion blur: the light of a frame is the mean of N pictures, 1 to 64 (default: motion_blur of the document, or "
      "none)",
      0 },
    { "shutter", KEY_SHUTTER, "PART", 0,
      "motion blur: open time of the shutter as a fraction of a frame's time, up to 1 (default: motion_blur of the "
      "document, or 0.5)",
      0 },
    { "state", KEY_STATE, "DIR", 0, "folder of finished frames; a run uses the frames that an earlier run left there",
      0 },
    { "only", KEY_ONLY, "FIRST:LAST", 0,
      "render only these frames into the folder of --state and write no film; other processes may render other frames",
      0 },
    KD_CLI_MEMORY,
    { "stats", 't', NULL, 0, "print frames, their exposure and seconds as one line of JSON on standard error", 0 },
    { 0 },
};

static const struct kd_gather_format *const kinds[] = { &kd_gather_mp4, &kd_gather_webm, &kd_gather_zip };

static const struct kd_gather_format *kind_of(const char *path, const struct argp_state *state)
{
    const char *name = kd_cli_ending_required(state, "--output", path, KD_ENDINGS("mp4", "webm", "zip"));
    size_t i = 0;
    while (strcmp(kinds[i]->name, name))
        i++;
    return kinds[i];
}

/* Parses a range of frames such as "3:17"; both ends are included. */
static void read_only(struct arguments *arguments, const char *text, const struct argp_state *state)
{
    int end = 0;
    if (strspn(text, "0123456789:") != strlen(text) ||
        sscanf(text, "%9u:%9u%n", &arguments->first, &arguments->last, &end) != 2 || text[end] ||
        arguments->first > arguments->last)
        argp_error(state, "--only is %s; it must be FIRST:LAST, two frame numbers counted from 0, as in 24:47", text);
    arguments->only = true;
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;
    char *end;
    switch (key) {
    case KEY_RATE: arguments->rate = kd_cli_number(state, "--rate", text, 1, KD_FILM_RATE_MAX); return 0;
    case KEY_SAMPLES: arguments->samples = kd_cli_number(state, "--samples", text, 1, KD_BLUR_SAMPLES); return 0;
    case KEY_SHUTTER:
        arguments->shutter = strtod(text, &end);
        if (*end || end == text || !(arguments->shutter > 0) || arguments->shutter > 1)
            argp_error(state, "--shutter is %s; it must be a number above 0, at most 1", text);
        return 0;
    case KEY_STATE: arguments->state = text; return 0;
    case KEY_ONLY: read_only(arguments, text, state); return 0;
    case ARGP_KEY_END:
        if (arguments->only && (arguments->base.output || arguments->rate))
            argp_error(state, "--only cannot be used with %s, because it makes frames and no film",
                       arguments->base.output ? "-o" : "--rate");
        else if (arguments->only && !arguments->state)
            argp_error(state, "--state is missing; --only needs it as the folder of its frames");
        else if (!arguments->only && !arguments->base.output)
            argp_error(state, "-o FILE is missing; it names the film");
        else if (!arguments->base.options.document)
            argp_error(state, "KEYFRAMES.json is missing; it must have keyframes, as in {\"scene\": {}, \"keyframes\": "
                              "[{\"frame\": 47, \"scene\": {\"camera\": {\"azimuth_deg\": 90}}}]}");
        if (!arguments->only)
            arguments->kind = kind_of(arguments->base.output, state);
        if (arguments->rate && arguments->kind && !arguments->kind->waits)
            argp_error(state, "--rate cannot be used with .zip, because numbered pictures have no frame rate");
        return 0;
    }
    return kd_scene_command_parse(key, text, state);
}

struct work {
    struct arguments *arguments;
    const struct kd_gather_format *kind;
    struct kd_assets assets;
    struct kd_buffer text; /* JSON text of the request */
    struct kd_job_spec spec;
    struct kd_renderer *renderer;
    struct kd_frames frames;
    struct kd_film_state state;
    struct kd_playground *bodies; /* the film's playground, in the state for the next frame; NULL if there is none */
    struct kd_encoder encoder;
    struct kd_progress progress;
    unsigned reused, measured, traced; /* reused: number of frames that were found in the folder */
};

static enum kd_status change(void *user, struct kd_scene *scene, struct kd_error *error)
{
    return kd_scene_options_set(user, scene, error);
}

/* Parses the request. --preset and --from give a base scene, onto which the request's scenes are merged. --set and
 * --size are applied last. */
static enum kd_status read_request(struct work *w, struct kd_error *error)
{
    struct kd_scene_options *options = &w->arguments->base.options, beneath = *options;
    struct kd_scene scene;
    enum kd_status status;
    options->assets.later = beneath.assets.later = true;
    beneath.document = NULL;
    beneath.n_set = 0;
    KD_TRY(kd_file_read(options->document, KD_JOB_FILM_MAX, &w->text, error));
    KD_TRY(kd_scene_options_load(&beneath, &scene, error));
    w->assets = kd_asset_options_assets(&options->assets);
    const struct kd_job_base base = { .scene = options->preset || options->from ? &scene : NULL,
                                      .samples = w->arguments->samples,
                                      .shutter = w->arguments->shutter,
                                      .change = change,
                                      .user = options };
    status = kd_job_spec_parse(w->text.data ? (const char *)w->text.data : "", w->text.size, &base, &w->assets,
                               &w->spec, error);
    KD_TRY(status ? kd_cli_prefix(error, strcmp(options->document, "-") ? options->document : "standard input")
                  : KD_OK);
    KD_TRY(kd_asset_options_check(&options->assets, error));
    if (w->arguments->only && w->spec.every > 0)
        KD_TRY(kd_error_field(
            error, "/playground",
            "--only cannot be used with a playground, because its frames depend on the frames before them"));
    if (w->arguments->only && w->arguments->last >= w->spec.frames)
        KD_TRY(kd_error_set(error, KD_EINVAL, "--only is %u:%u; its frames must be 0 to %u", w->arguments->first,
                            w->arguments->last, w->spec.frames - 1));
    if (!w->arguments->only) {
        w->arguments->first = 0;
        w->arguments->last = w->spec.frames - 1;
    }
    if (w->spec.series->frame != &kd_format_png)
        KD_TRY(kd_error_field(error, "/output", "output is \"%s\"; for a film it must be \"pictures\"",
                              w->spec.series->name));
done:
    return status;
}

/* Computes a hash of everything that determines the frames: the request, the options, and the contents of the files
 * that these name. */
static enum kd_status identify(struct work *w, struct kd_error *error)
{
    const struct kd_scene_options *options = &w->arguments->base.options;
    struct kd_buffer all = { 0 };
    struct kd_scene scene;
    struct kd_scene_options beneath = *options;
    enum kd_status status;
    beneath.document = NULL;
    beneath.n_set = 0;
    KD_TRY(kd_scene_options_load(&beneath, &scene, error));
    KD_TRY(kd_scene_to_json(&scene, &all));
    KD_TRY(kd_buffer_printf(&all, "\n%d %u %.17g", options->preset || options->from, w->spec.blur.samples,
                            w->spec.blur.shutter));
    for (size_t i = 0; i < options->n_set; i++)
        KD_TRY(kd_buffer_printf(&all, "\n%s", options->set[i]));
    for (size_t i = 0; i < options->assets.n; i++)
        KD_TRY(kd_buffer_printf(&all, "\n%s=%s", options->assets.list[i].name, options->assets.list[i].found.hash));
    KD_TRY(kd_buffer_printf(&all, "\n"));
    KD_TRY(kd_buffer_append(&all, w->text.data, w->text.size));
    kd_sha256(all.data, all.size, w->state.request);
    w->state.frames = w->spec.frames;
    w->state.device = kd_renderer_device_name(w->renderer);
    w->state.exposure = NAN;
done:
    if (status == KD_ENOMEM)
        kd_error_set(error, status, "out of memory for the request");
    kd_buffer_finish(&all);
    return status;
}

/* Plans all frames, before any is rendered. */
static enum kd_status check(const struct work *w, struct kd_error *error)
{
    struct kd_capacity capacity;
    struct kd_scene scene;
    struct kd_plan plan;
    uint32_t width = 0, height = 0;
    enum kd_status status = KD_OK;
    kd_renderer_capacity(w->renderer, &capacity);
    for (unsigned i = 0; i < w->spec.frames && !status; i++) {
        status =
            kd_job_frame_plan(&w->spec, i, w->spec.first, i * w->spec.every, INFINITY, &capacity, &scene, &plan, error);
        if (!i) {
            width = kd_plan_shown_width(&plan.picture);
            height = kd_plan_shown_height(&plan.picture);
        }
        if (!status && w->kind && w->kind->waits &&
            (kd_plan_shown_width(&plan.picture) != width || kd_plan_shown_height(&plan.picture) != height))
            status =
                kd_error_set(error, KD_EINVAL,
                             "frame %u has %u x %u pixels and frame 0 has %u x %u; all frames of a film must have "
                             "one size; a .zip may have several",
                             i, kd_plan_shown_width(&plan.picture), kd_plan_shown_height(&plan.picture), width, height);
    }
    return status;
}

static enum kd_status open_frames(struct work *w, struct kd_error *error)
{
    const char *path = w->arguments->state;
    bool there;
    enum kd_status status;
    w->frames.n = w->spec.frames;
    w->frames.noun = "frame";
    w->frames.format = w->spec.series->frame;
    if (!path)
        return kd_frames_open(&w->frames, error);
    KD_TRY(kd_frames_open_folder(&w->frames, path, w->arguments->only, error));
    KD_TRY(kd_film_state_read(w->frames.folder, path, &w->state, &there, error));
    KD_TRY(kd_frames_find(&w->frames, &w->reused, error));
    if (w->reused && !there)
        KD_TRY(kd_error_set(
            error, KD_EINVAL,
            "%.200s has files named like frames, but no state of a film; --state must name another folder", path));
    w->spec.exposure = there ? w->state.exposure : NAN;
done:
    return status;
}

static bool go_on(void *progress) { return kd_progress_update(progress, 0); }

static enum kd_status measure(struct work *w, unsigned number, double *stops, struct kd_error *error)
{
    struct kd_capacity capacity;
    struct kd_scene scene;
    struct kd_plan plan;
    struct kd_frame frame = { 0 };
    enum kd_status status;
    kd_renderer_capacity(w->renderer, &capacity);
    KD_TRY(kd_job_exposure_plan(&w->spec, number, &capacity, &scene, &plan, error));
    KD_TRY(kd_render(w->renderer, &scene, &plan, kd_progress_update, &w->progress, &frame, error));
    *stops = frame.exposure;
done:
    kd_frame_finish(&frame);
    return status;
}

/* If the film has a common exposure that film.json does not contain yet, measures it. Writes film.json. */
static enum kd_status expose(struct work *w, struct kd_error *error)
{
    unsigned frames[KD_JOB_EXPOSURE_FRAMES];
    double stops[KD_JOB_EXPOSURE_FRAMES];
    enum kd_status status = KD_OK;
    const unsigned n = kd_job_exposure_frames(&w->spec, frames);
    for (; w->measured < n; w->measured++)
        KD_TRY(measure(w, frames[w->measured], &stops[w->measured], error));
    if (n)
        w->spec.exposure = w->state.exposure = kd_job_exposure_of(stops, n);
    if (w->frames.folder >= 0)
        KD_TRY(kd_film_state_write(w->frames.folder, &w->state, error));
done:
    return status;
}

/* Advances the playground from the previous frame to this one, as the server's jobs do, and returns its bodies. */
static enum kd_status move(struct work *w, unsigned number, double begin, struct kd_dynamic_bodies **out,
                           struct kd_error *error)
{
    struct kd_playground_run run;
    const double time = begin + number * w->spec.every - w->bodies->t;
    bool more = number && time > 0;
    if (more)
        kd_playground_begin(w->bodies, time, &run);
    while (more) {
        more = kd_playground_go_on(w->bodies, &run, 1);
        if (!go_on(&w->progress))
            return kd_error_set(error, KD_ECANCELLED, "stopped during the simulation of the bodies of frame %u",
                                number);
    }
    return kd_frames_has(&w->frames, number) ? KD_OK : kd_playground_show_named(w->bodies, out, error);
}

static enum kd_status render(struct work *w, unsigned number, const struct kd_dynamic_bodies *dynamic,
                             struct kd_error *error)
{
    const struct kd_blur blur = kd_job_frame_blur(&w->spec, number);
    struct kd_capacity capacity;
    struct kd_scene scene;
    struct kd_plan plan;
    struct kd_frame frame = { 0 };
    struct kd_buffer file = { 0 };
    enum kd_status status;
    kd_renderer_capacity(w->renderer, &capacity);
    KD_TRY(kd_job_frame_plan(&w->spec, number, dynamic, 0, INFINITY, &capacity, &scene, &plan, error));
    KD_TRY(blur.samples
               ? kd_render_blurred(&(struct kd_blurred) { w->renderer, &blur, &scene, &plan,
                                                          .progress = kd_progress_update, .user = &w->progress },
                                   &frame, error)
               : kd_render(w->renderer, &scene, &plan, kd_progress_update, &w->progress, &frame, error));
    w->traced += (!frame.lens_reused && plan.lens.planes) + frame.others_traced;
    const struct kd_picture picture = { &frame, &scene, &plan, kd_renderer_device_name(w->renderer), number };
    KD_TRY(kd_encode(w->frames.format, &picture, KD_EFFORT_KEEP, &w->encoder, &file, error));
    KD_TRY(kd_frames_put(&w->frames, number, &file, error));
done:
    kd_buffer_finish(&file);
    kd_frame_finish(&frame);
    return status;
}

static enum kd_status render_all(struct work *w, struct kd_error *error)
{
    struct kd_dynamic_bodies *dynamic = NULL;
    enum kd_status status;
    kd_progress_begin(&w->progress, w->arguments->last - w->arguments->first + 1);
    KD_TRY(expose(w, error));
    if (w->spec.every > 0 && w->reused < w->spec.frames)
        KD_TRY(kd_job_spec_playground((const char *)w->text.data, w->text.size, &w->bodies, error));
    const double begin = w->bodies ? w->bodies->t : 0;
    for (unsigned i = w->arguments->first; i <= w->arguments->last; i++, w->progress.done++) {
        if (w->bodies)
            KD_TRY(move(w, i, begin, &dynamic, error));
        if (!kd_frames_has(&w->frames, i))
            KD_TRY(render(w, i, dynamic, error));
        kd_dynamic_bodies_release(dynamic);
        dynamic = NULL;
    }
done:
    kd_dynamic_bodies_release(dynamic);
    return kd_progress_end(&w->progress, status, error);
}

static enum kd_status print_stats(const struct work *w, double render_s, double write_s, struct kd_error *error)
{
    struct kd_buffer line = { 0 };
    struct kd_json json = kd_json_begin(&line);
    kd_json_object(&json, NULL);
    kd_json_number(&json, "frames", w->spec.frames);
    kd_json_number(&json, "frames_kept", w->reused);
    kd_json_number(&json, "lens_maps_traced", w->traced);
    kd_json_number(&json, "exposure", w->spec.exposure);
    kd_json_number(&json, "exposure_frames", w->measured);
    kd_json_number(&json, "render_s", render_s);
    kd_json_number(&json, "write_s", write_s);
    kd_json_end(&json);
    return kd_stats_print(&json, &line, error);
}

static enum kd_status make(struct work *w, struct kd_error *error)
{
    struct kd_scene_command *base = &w->arguments->base;
    const struct arguments *arguments = w->arguments;
    enum kd_status status;
    KD_TRY(read_request(w, error));
    if (!arguments->only)
        KD_TRY(kd_file_check(base->output, error));
    if (w->kind && w->kind->waits && !kd_program_known("ffmpeg"))
        KD_TRY(kd_error_set(error, KD_EABSENT,
                            "the program ffmpeg, which encodes films, is not on the PATH: install it, or write "
                            "numbered pictures with -o FILE.zip"));
    KD_TRY(kd_scene_command_open(base, error));
    w->renderer = base->renderer;
    KD_TRY(check(w, error));
    KD_TRY(identify(w, error));
    KD_TRY(open_frames(w, error));
    const double began = kd_progress_clock();
    KD_TRY(render_all(w, error));
    const double rendered = kd_progress_clock();
    const struct kd_frames_whole whole = { .format = w->kind,
                                           .sweep = w->spec.sweep,
                                           .rate = arguments->rate ? arguments->rate : KD_FILM_RATE,
                                           .go_on = go_on,
                                           .user = &w->progress };
    if (!arguments->only)
        KD_TRY(kd_frames_save(&w->frames, &whole, base->output, error));
    if (base->stats)
        KD_TRY(print_stats(w, rendered - began, kd_progress_clock() - rendered, error));
done:
    return status;
}

static enum kd_status run(struct kd_scene_command *base, struct kd_error *error)
{
    struct arguments *arguments = (struct arguments *)base;
    struct work work = { .arguments = arguments, .kind = arguments->kind, .frames = KD_FRAMES_NONE };
    const enum kd_status status = make(&work, error);
    kd_encoder_finish(&work.encoder);
    kd_playground_destroy(work.bodies);
    kd_frames_finish(&work.frames);
    kd_job_spec_finish(&work.spec);
    kd_buffer_finish(&work.text);
    return status;
}

const struct argp *kd_cli_film_argp(void)
{
    static const struct argp argp = {
        .options = table,
        .parser = parse,
        .args_doc = "KEYFRAMES.json|-",
        .doc = "Make a film from a scene with keyframes, from a list of scenes, or from a playground. The document is "
               "the body of a job (docs/jobs.md), as in {\"scene\": {}, \"keyframes\": [{\"frame\": 47, \"scene\": "
               "{\"camera\": {\"azimuth_deg\": 90}}}]}.\vWith --preset or --from the document's scenes are merged over "
               "that scene; --set and --size change the scene that keyframes are merged over. A job of a server makes "
               "the same frames.",
        .children = kd_scene_device_children,
    };
    return &argp;
}

int kd_cli_film(int argc, char **argv)
{
    struct arguments arguments = { .base.options.document_is_over = true };
    return kd_scene_command_run(&arguments.base, kd_cli_film_argp(), argc, argv, run);
}
