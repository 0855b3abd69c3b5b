/* Measures the cost of a disk's particles in a frame, from the computation of their places to the density on the grid,
 * for 1e3 to 1e7 particles. The picture is small and reuses its lens map. Times of the device's pass and of the whole
 * frame, in ms. Prints all runs in one line of JSON. */
#include "render/emit/particles.h"
#include "render/render.h"

#include <argp.h>
#include <cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct options {
    const char *device;
    int repeat;
};

static double timing(const struct kd_frame *frame, const char *pass)
{
    for (size_t i = 0; i < frame->n_timings; i++)
        if (!strcmp(frame->timings[i].name, pass))
            return frame->timings[i].ms;
    return 0;
}

static enum kd_status one_frame(struct kd_renderer *renderer, const struct kd_scene *scene, cJSON *device, cJSON *total,
                                struct kd_particle_grid *grid, struct kd_error *error)
{
    struct kd_capacity capacity;
    struct kd_plan plan;
    struct kd_frame frame;
    kd_renderer_capacity(renderer, &capacity);
    enum kd_status status = kd_plan_make(scene, &capacity, &plan, error);
    if (!status)
        status = kd_render(renderer, scene, &plan, NULL, NULL, &frame, error);
    if (status)
        return status;
    cJSON_AddItemToArray(device, cJSON_CreateNumber(timing(&frame, "particles")));
    cJSON_AddItemToArray(total, cJSON_CreateNumber(timing(&frame, "total")));
    *grid = kd_particle_grid(scene);
    kd_frame_finish(&frame);
    return KD_OK;
}

static enum kd_status measure(struct kd_renderer *renderer, double epicycles, int count, int repeat, cJSON *rows,
                              struct kd_error *error)
{
    struct kd_particle_grid grid = { 0 };
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.image.width = scene.image.height = 16;
    scene.style.exposure = 0;
    scene.disk.model = KD_DISK_PARTICLES;
    scene.disk.particles = count;
    scene.disk.epicycles = epicycles;
    cJSON *row = cJSON_CreateObject(), *device = cJSON_AddArrayToObject(row, "particles_ms");
    cJSON *total = cJSON_AddArrayToObject(row, "frame_ms");
    enum kd_status status = KD_OK;
    for (int k = 0; k <= repeat && !status; k++) {
        scene.top.time = 37.7 * k;
        status = one_frame(renderer, &scene, device, total, &grid, error);
        if (!k) { /* the first run compiles the kernels and traces the rays, so it does not count */
            cJSON_DeleteItemFromArray(device, 0);
            cJSON_DeleteItemFromArray(total, 0);
        }
    }
    cJSON_AddNumberToObject(row, "particles", count);
    cJSON_AddNumberToObject(row, "epicycles", epicycles);
    cJSON_AddNumberToObject(row, "rows", grid.rows);
    cJSON_AddNumberToObject(row, "columns", grid.columns);
    cJSON_AddNumberToObject(row, "bytes", (double)grid.bytes);
    cJSON_AddItemToArray(rows, row);
    return status;
}

static error_t option(int key, char *text, struct argp_state *state)
{
    struct options *o = state->input;
    switch (key) {
    case 'd': o->device = text; return 0;
    case 'r': o->repeat = atoi(text); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

int main(int argc, char **argv)
{
    static const struct argp_option table[] = {
        { "device", 'd', "DEVICE", 0, "auto, an index or part of a name", 0 },
        { "repeat", 'r', "N", 0, "frames of each kind (15)", 0 },
        { 0 },
    };
    struct options o = { "auto", 15 };
    struct argp parser = { table, option, NULL, "What the particles of a disk cost a frame.", NULL, NULL, NULL };
    argp_parse(&parser, argc, argv, 0, NULL, &o);

    struct kd_error error = { 0 };
    struct kd_renderer *renderer;
    if (kd_renderer_create(&(struct kd_renderer_params) { .device = o.device, .passing = true }, &renderer, &error)) {
        fprintf(stderr, "kd_bench_particles: %s\n", error.message);
        return 1;
    }
    cJSON *root = cJSON_CreateObject();
    cJSON_AddStringToObject(root, "device", kd_renderer_device_name(renderer));
    cJSON *rows = cJSON_AddArrayToObject(root, "rows");
    static const int counts[] = { 1000, 10000, 100000, 300000, 1000000, 3000000, 10000000 };
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < sizeof counts / sizeof *counts && !status; i++) {
        status = measure(renderer, 0.02, counts[i], o.repeat, rows, &error);
        if (!status)
            status = measure(renderer, 0, counts[i], o.repeat, rows, &error);
    }
    char *text = cJSON_PrintUnformatted(root);
    if (status)
        fprintf(stderr, "kd_bench_particles: %s\n", error.message);
    else if (text)
        puts(text);
    cJSON_free(text);
    cJSON_Delete(root);
    kd_renderer_destroy(renderer);
    return status != KD_OK;
}
