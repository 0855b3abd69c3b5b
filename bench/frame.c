/* Measures the cost of a whole frame, pass by pass. The scene is read from a file, so that it stays the same when the
 * default scene changes. Each repetition renders the scene with a new lens map ("cold"). It then renders the scene
 * again with the map reused, as when only the exposure or the palette changes. With --turn it renders the scene a third
 * time from another azimuth, which turns the sky. With --live, cold frames are rendered like those of a drag, and
 * reused ones like those of a session whose time runs. Prints one line of JSON with all runs, in ms. frame.py runs it
 * with one and two lavapipe threads and takes medians. */
#include "render/output/png.h"
#include "render/render.h"

#include <argp.h>
#include <cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

struct options {
    const char *device, *scene;
    int width, height, repeat;
    bool sky, particles, turn, live;
};

static double now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static enum kd_status encode(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                             const struct kd_frame *frame, int level, cJSON *run, const char *name,
                             struct kd_error *error)
{
    struct kd_buffer png = { 0 };
    double start = now_ms();
    const struct kd_picture picture = { frame, scene, plan, kd_renderer_device_name(renderer), 0 };
    enum kd_status status = kd_png_of_picture(&picture, level, &png, error);
    cJSON_AddNumberToObject(run, name, now_ms() - start);
    kd_buffer_finish(&png);
    return status;
}

/* dragged: true if the frame is rendered like a coarse one during a drag (render/live/governor.h). */
static enum kd_status one_frame(struct kd_renderer *renderer, const struct kd_scene *asked, bool dragged, cJSON *runs,
                                struct kd_error *error)
{
    struct kd_capacity capacity;
    struct kd_plan plan;
    struct kd_frame frame;
    struct kd_scene shown = *asked;
    const struct kd_scene *scene = &shown;
    shown.image.critical_factor = dragged ? 2 : shown.image.critical_factor;
    kd_renderer_capacity(renderer, &capacity);
    struct kd_needs needs = kd_needs_of(scene);
    needs.bright = dragged;
    enum kd_status status = kd_plan_make_for(scene, &needs, &capacity, &plan, error);
    if (status)
        return status;
    plan.lens.audit /= dragged ? 4 : 1;
    status = kd_render(renderer, scene, &plan, NULL, NULL, &frame, error);
    if (status)
        return status;
    cJSON *run = cJSON_CreateObject();
    for (size_t i = 0; i < frame.n_timings; i++)
        cJSON_AddNumberToObject(run, frame.timings[i].name, frame.timings[i].ms);
    cJSON_AddBoolToObject(run, "lens_reused", frame.lens_reused);
    /* Level 1 is used for live views, level 6 for files of the command line. */
    status = encode(renderer, scene, &plan, &frame, 1, run, "encode_1", error);
    if (!status)
        status = encode(renderer, scene, &plan, &frame, 6, run, "encode_6", error);
    kd_frame_finish(&frame);
    cJSON_AddItemToArray(runs, run);
    return status;
}

static enum kd_status measure(const struct options *o, struct kd_renderer *renderer, cJSON *root,
                              struct kd_error *error)
{
    struct kd_scene scene;
    char text[1 << 16];
    FILE *file = fopen(o->scene, "re");
    size_t n = file ? fread(text, 1, sizeof text, file) : 0;
    if (file)
        fclose(file);
    kd_scene_smooth(&scene);
    if (!n)
        return kd_error_set(error, KD_EIO, "cannot read %s", o->scene);
    if (kd_scene_from_json(&scene, text, n, error))
        return KD_EINVAL;
    scene.image.width = o->width;
    scene.image.height = o->height;
    scene.sky.model = o->sky ? KD_SKY_GRID : scene.sky.model;
    scene.disk.model = o->particles ? KD_DISK_PARTICLES : scene.disk.model;
    cJSON *first = cJSON_AddArrayToObject(root, "first"), *cold = cJSON_AddArrayToObject(root, "cold");
    cJSON *reused = cJSON_AddArrayToObject(root, "reused"),
          *turned = o->turn ? cJSON_AddArrayToObject(root, "turned") : NULL;
    enum kd_status status = one_frame(renderer, &scene, o->live, first, error); /* compiles the kernels */
    for (int k = 0; k < o->repeat && !status; k++) {
        /* the inclination changes, so that the map must be traced again with the same amount of work */
        scene.camera.inclination_deg += 1e-3;
        status = one_frame(renderer, &scene, o->live, cold, error);
        if (!status && !o->live)
            status = one_frame(renderer, &scene, false, reused, error);
        scene.camera.azimuth_deg += 0.5;
        if (!status && o->turn)
            status = one_frame(renderer, &scene, o->live, turned, error);
    }
    for (int k = -1; o->live && k < o->repeat && !status; k++) {
        status = one_frame(renderer, &scene, false, k < 0 ? first : reused, error);
        kd_scene_pass(&scene, 0.2);
    }
    return status;
}

static error_t option(int key, char *text, struct argp_state *state)
{
    struct options *o = state->input;
    switch (key) {
    case 'd': o->device = text; return 0;
    case 'x': o->width = atoi(text); return 0;
    case 'y': o->height = atoi(text); return 0;
    case 'r': o->repeat = atoi(text); return 0;
    case 's': o->scene = text; return 0;
    case 'k': o->sky = true; return 0;
    case 'p': o->particles = true; return 0;
    case 't': o->turn = true; return 0;
    case 'l': o->live = true; return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

int main(int argc, char **argv)
{
    static const struct argp_option table[] = {
        { "device", 'd', "DEVICE", 0, "auto, an index or part of a name", 0 },
        { "width", 'x', "N", 0, "pixels (1280)", 0 },
        { "height", 'y', "N", 0, "pixels (720)", 0 },
        { "repeat", 'r', "N", 0, "frames of each kind (9)", 0 },
        { "scene", 's', "FILE", 0, "the scene (bench/scenes/frame.json)", 0 },
        { "sky", 'k', NULL, 0, "with a sky, which needs the integrator", 0 },
        { "particles", 'p', NULL, 0, "with a disk of particles", 0 },
        { "turn", 't', NULL, 0, "and with the observer half a degree further round the hole", 0 },
        { "live", 'l', NULL, 0, "cold frames are those of a drag, and reused ones those of a scene whose time goes on",
          0 },
        { 0 },
    };
    struct options o = { "auto", "bench/scenes/frame.json", 1280, 720, 9, false, false, false, false };
    struct argp parser = { table, option, NULL, "What a whole frame costs, pass by pass.", NULL, NULL, NULL };
    argp_parse(&parser, argc, argv, 0, NULL, &o);

    struct kd_error error = { 0 };
    struct kd_renderer *renderer;
    double start = now_ms();
    if (kd_renderer_create(&(struct kd_renderer_params) { .device = o.device, .passing = true }, &renderer, &error)) {
        fprintf(stderr, "kd_bench_frame: %s\n", error.message);
        return 1;
    }
    cJSON *root = cJSON_CreateObject();
    cJSON_AddStringToObject(root, "device", kd_renderer_device_name(renderer));
    cJSON_AddNumberToObject(root, "width", o.width);
    cJSON_AddNumberToObject(root, "height", o.height);
    cJSON_AddNumberToObject(root, "open_device_ms", now_ms() - start);
    enum kd_status status = measure(&o, renderer, root, &error);
    char *text = cJSON_PrintUnformatted(root);
    if (status)
        fprintf(stderr, "kd_bench_frame: %s\n", error.message);
    else if (text)
        puts(text);
    cJSON_free(text);
    cJSON_Delete(root);
    kd_renderer_destroy(renderer);
    return status != KD_OK;
}
