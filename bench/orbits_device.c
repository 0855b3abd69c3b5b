/* Compares the step of the orbit integrator on the device with the same step on the processor, there for one orbit at a
 * time and for eight at once. The result shows whether a kernel for lists of orbits would be faster.
 *
 *     LP_NUM_THREADS=1 taskset -c 0 kd_bench_orbits [ORBITS [STEPS]]
 *
 * All three integrate the same orbits by the same number of steps. The device does not compensate its sums. It checks
 * only the energy, not Q, the rest mass or the periastra. */
#include "physics/orbit/orbit_lanes.h"
#include "physics/spacetime/hole.h"
#include "vk/vk.h"

#include "orbits_spv.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

struct orbit { /* as in orbits.comp */
    double a, energy, momentum, z, binding, w_low, w_high, g[3], c[5], by_energy;
    double twist, nu, stiff, strength_w, centre_w, h;
    double w, w_rate, y, y_rate, proper, t, chi, drift;
    double kick_w[4], drift_w[4], kick_y[4], drift_y[4];
};

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double between(double low, double high) { return low + (high - low) * drand48(); }

static struct orbit pack(const struct kd_orbit_path *p, double h)
{
    struct kd_orbit_path stepped = *p; /* a first step computes the rotations of the springs */
    const struct kd_orbit *k = &p->orbit;
    kd_orbit_path_step(&stepped, h);
    struct orbit o = { .a = k->hole.a,
                       .energy = k->energy,
                       .momentum = k->momentum,
                       .z = k->z,
                       .binding = k->binding,
                       .w_low = k->w_low,
                       .w_high = k->w_high,
                       .twist = p->twist,
                       .nu = p->nu,
                       .stiff = p->stiff,
                       .strength_w = p->spring[KD_PATH_W].strength,
                       .centre_w = p->spring[KD_PATH_W].centre,
                       .h = h,
                       .w = p->place[KD_PATH_W].value,
                       .w_rate = p->rate[KD_PATH_W].value,
                       .y = p->place[KD_PATH_Y].value,
                       .y_rate = p->rate[KD_PATH_Y].value };
    for (int i = 0; i < 3; i++)
        o.g[i] = p->g[i];
    for (int i = 0; i < 5; i++)
        o.c[i] = k->w[i];
    for (int i = 0; i < 4; i++) {
        o.kick_w[i] = stepped.spring[KD_PATH_W].turn[i].kick, o.drift_w[i] = stepped.spring[KD_PATH_W].turn[i].drift;
        o.kick_y[i] = stepped.spring[KD_PATH_Y].turn[i].kick, o.drift_y[i] = stepped.spring[KD_PATH_Y].turn[i].drift;
    }
    return o;
}

static double on_device(struct orbit *orbits, uint32_t n, uint32_t steps)
{
    struct kd_error error = { 0 };
    struct kd_vk *vk = NULL;
    struct kd_vk_pipeline *pipeline = NULL;
    struct kd_vk_buffer *buffer = NULL;
    const struct kd_vk_pipeline_params params = {
        .name = "orbits", .spirv = orbits_spv, .spirv_bytes = sizeof orbits_spv, .n_buffers = 1, .push_bytes = 8
    };
    uint32_t push[2] = { n, 1 };
    double seconds = NAN;
    if (kd_vk_create(&(struct kd_vk_params) { .device = "auto", .cache_dir = "" }, &vk, &error) ||
        kd_vk_pipeline_create(vk, &params, &pipeline, &error) ||
        kd_vk_buffer_create(vk, n * sizeof *orbits, KD_VK_UPLOAD, "orbits", &buffer, &error)) {
        fprintf(stderr, "%s\n", error.message);
        exit(1);
    }
    struct orbit *map = kd_vk_buffer_map(buffer);
    for (int round = 0; round < 2; round++) { /* the first round compiles the kernel */
        push[1] = round ? steps : 1;
        for (uint32_t i = 0; i < n; i++)
            map[i] = orbits[i];
        double begun = now();
        if (kd_vk_dispatch(vk,
                           &(struct kd_vk_dispatch) { .pass = "orbits",
                                                      .pipeline = pipeline,
                                                      .bindings = { { .buffer = buffer, .write = true } },
                                                      .push = push,
                                                      .groups = { (n + 63) / 64 } },
                           &error) ||
            kd_vk_submit(vk, NULL, &error) || kd_vk_wait(vk, 0, &error)) {
            fprintf(stderr, "%s\n", error.message);
            exit(1);
        }
        seconds = now() - begun;
    }
    for (uint32_t i = 0; i < n; i++)
        orbits[i] = map[i];
    kd_vk_buffer_destroy(vk, buffer);
    kd_vk_pipeline_destroy(vk, pipeline);
    kd_vk_destroy(vk);
    return seconds;
}

static double abreast(struct kd_orbit_path *paths, const double *h, uint32_t n, uint32_t steps)
{
    struct kd_orbit_drift worst = { 0 };
    double begun = now();
    for (uint32_t i = 0; i + KD_ORBIT_LANES <= n; i += KD_ORBIT_LANES) {
        struct kd_orbit_lanes lanes = { 0 };
        for (int k = 0; k < KD_ORBIT_LANES; k++)
            lanes.path[k] = &paths[i + k], lanes.h[k] = h[i + k], lanes.steps[k] = steps, lanes.worst[k] = &worst;
        kd_orbit_lanes_run(&lanes);
    }
    return now() - begun;
}

int main(int argc, char **argv)
{
    uint32_t n = argc > 1 ? (uint32_t)atoi(argv[1]) : 1024, steps = argc > 2 ? (uint32_t)atoi(argv[2]) : 1000;
    struct kd_orbit_path *paths = calloc(n, sizeof *paths);
    struct kd_orbit_path *again = calloc(n, sizeof *again);
    struct orbit *orbits = calloc(n, sizeof *orbits);
    double *h = calloc(n, sizeof *h), cpu_worst = 0, gpu_worst = 0, apart = 0;
    if (!paths || !again || !orbits || !h)
        return 1;
    srand48(1);
    for (uint32_t i = 0; i < n; i++) {
        struct kd_orbit orbit;
        double a = between(-0.99, 0.99), p = between(13, 30), e = between(0.01, 0.8), x = between(-1, 1);
        if (kd_orbit_from_shape(kd_hole(a), p, e, x, &orbit, NULL))
            return 1;
        struct kd_orbit_state start = kd_orbit_start(&orbit, NAN, true);
        struct kd_orbit_bound bound = kd_orbit_bound_of(&orbit, &start);
        h[i] = 2 * M_PI / kd_orbit_frequencies_of(&bound).mino_r / 400;
        kd_orbit_path_init(&paths[i], &orbit, &start, KD_ORBIT_YOSHIDA6);
        orbits[i] = pack(&paths[i], h[i]);
        again[i] = paths[i];
    }
    double begun = now();
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t k = 0; k < steps; k++) {
            kd_orbit_path_step(&paths[i], h[i]);
            cpu_worst = fmax(cpu_worst, fabs(kd_orbit_path_drift(&paths[i]).energy));
        }
    double cpu = now() - begun, lanes = abreast(again, h, n, steps), gpu = on_device(orbits, n, steps);
    for (uint32_t i = 0; i < n; i++) {
        double by_energy = kd_orbit_radial_by_energy(&paths[i].orbit, orbits[i].w) * paths[i].orbit.energy;
        gpu_worst = fmax(gpu_worst, orbits[i].drift / by_energy);
        apart = fmax(apart, fabs(orbits[i].t / paths[i].rate[KD_PATH_T].value - 1));
    }
    printf("%u orbits, %u steps of 1/400 period\none by one     %.1f ns a step, worst error of E %.1e\neight abreast  "
           "%.1f ns a "
           "step\ndevice         %.1f ns a step, worst error of E "
           "%.1e, t apart by %.1e\n",
           n, steps, 1e9 * cpu / n / steps, cpu_worst, 1e9 * lanes / n / steps, 1e9 * gpu / n / steps, gpu_worst,
           apart);
    free(paths);
    free(again);
    free(orbits);
    free(h);
    return 0;
}
