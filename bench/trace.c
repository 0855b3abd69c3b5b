/* Measures rays per second of the lens-map kernels and their error on the device at hand.
 *
 * Every method computes the same image: a = 0.9, i = 70 degrees, +-12 M, observer at infinity. Errors are measured for
 * a sample of rays, relative to the Kerr-Schild oracle of tests/oracle. Times are those of the device's trace pass. For
 * listed rays (delays) they are wall times of the host. With one lavapipe thread (LP_NUM_THREADS=1 taskset -c 0) the
 * result is the speed of one core. */
#include "base/clock.h"
#include "kerr_schild.h"
#include "physics/spacetime/kerr.h"
#include "render/render.h"
#include "scene/hole.h"

#include <argp.h>
#include <cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct options {
    const char *device, *json;
    int size, repeat, sample;
    double spin, inclination;
};

struct method {
    const char *name, *what;
    struct kd_needs needs;
    int orders, steps;
};
static const struct method methods[] = {
    { "closed form", "r of 3 crossings", { .quantities = KD_LENS_W }, 3, 0 },
    { "closed form", "r of 1 crossing", { .quantities = KD_LENS_W }, 1, 0 },
    { "closed form", "r, phi of 3 crossings", { .quantities = KD_LENS_W | KD_LENS_PHI }, 3, 0 },
    { "closed form", "r of 3, sky, fate", { .quantities = KD_LENS_W | KD_LENS_SKY }, 3, 0 },
    { "closed form", "r, phi, sky, fate", { .quantities = KD_LENS_W | KD_LENS_PHI | KD_LENS_SKY }, 3, 0 },
    { "closed form",
      "r, phi, sky, fate, delay",
      { .quantities = KD_LENS_W | KD_LENS_PHI | KD_LENS_SKY | KD_LENS_DELAY },
      3,
      0 },
    { "RKN6, 4 steps", "r of 3 crossings", { .quantities = KD_LENS_W }, 3, 4 },
    { "RKN6, 8 steps", "r of 3 crossings", { .quantities = KD_LENS_W }, 3, 8 },
    { "RKN6, 12 steps", "r of 3 crossings", { .quantities = KD_LENS_W }, 3, 12 },
    { "RKN6, 16 steps", "r of 3 crossings", { .quantities = KD_LENS_W }, 3, 16 },
    { "RKN6, 4 steps", "r, phi of 3 crossings", { .quantities = KD_LENS_W | KD_LENS_PHI }, 3, 4 },
    { "RKN6, 8 steps", "r, phi of 3 crossings", { .quantities = KD_LENS_W | KD_LENS_PHI }, 3, 8 },
    { "RKN6, 12 steps", "r, phi of 3 crossings", { .quantities = KD_LENS_W | KD_LENS_PHI }, 3, 12 },
    { "RKN6, 16 steps", "r, phi of 3 crossings", { .quantities = KD_LENS_W | KD_LENS_PHI }, 3, 16 },
    { "RKN6, 8 steps", "r, phi, sky, fate", { .quantities = KD_LENS_W | KD_LENS_PHI | KD_LENS_SKY }, 3, 8 },
};
enum { METHODS = sizeof methods / sizeof *methods };

struct figures {
    char method[64];
    double mray_s, r_median, r_worst, r1_median, phi_median, phi_worst, phi1_median;
    int rays[2];
};

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double quantile(double *values, int n, double q)
{
    if (!n)
        return NAN;
    qsort(values, (size_t)n, sizeof *values, by_value);
    int i = (int)(q * n);
    return values[i < n ? i : n - 1];
}

static double turn(double x) { return fabs(remainder(x, 2 * M_PI)); }

/* Errors of image orders 0 and 1 for a sample of pixels. */
static void judge(const struct options *o, const struct kd_scene *scene, const struct kd_plan *plan,
                  const float *planes, struct figures *f)
{
    /* Compares only radii at which a disk can be, because the Boyer-Lindquist azimuth diverges at the horizon. */
    double isco = kd_kerr_isco(kd_scene_hole(scene));
    int n = o->sample, count[2] = { 0, 0 };
    double *r_error[2], *phi_error[2];
    for (int k = 0; k < 2; k++) {
        r_error[k] = malloc(sizeof(double) * (size_t)n * (size_t)n);
        phi_error[k] = malloc(sizeof(double) * (size_t)n * (size_t)n);
    }
    double field = scene->camera.field_m, u = cos(scene->camera.inclination_deg * M_PI / 180);
    for (int j = 0; j < n; j++) {
        for (int i = 0; i < n; i++) {
            int x = (int)((i + 0.5) * plan->picture.width / n), y = (int)((j + 0.5) * plan->picture.height / n);
            /* Computes the pixel's coordinates in the kernel's own arithmetic, so that only the tracing is compared. */
            float step = (float)(field / plan->picture.width), middle = 0.5f * (float)plan->picture.width - 0.5f;
            double alpha = ((float)x - middle) * step, beta = (middle - (float)y) * step;
            struct ks_path path = ks_trace(ks_from_infinity(scene->spacetime.spin, u, alpha, beta), 2);
            for (int k = 0; k < 2 && k < path.crossings && (uint32_t)k < plan->lens.orders; k++) {
                size_t at = (size_t)y * plan->picture.width + (size_t)x;
                float w = planes[(size_t)k * plan->lens.rays + at];
                if (!(w > 0) || path.r[k] > 1e3 || path.r[k] < isco)
                    continue;
                r_error[k][count[k]] = fabs(1 / (double)w / path.r[k] - 1);
                phi_error[k][count[k]++] =
                    kd_plan_holds(&plan->lens, KD_LENS_PHI)
                        ? turn(planes[(size_t)(k + (int)plan->lens.orders) * plan->lens.rays + at] - path.phi[k])
                        : NAN;
            }
        }
    }
    f->r_median = quantile(r_error[0], count[0], 0.5);
    f->r_worst = quantile(r_error[0], count[0], 1);
    f->r1_median = quantile(r_error[1], count[1], 0.5);
    f->phi_median = quantile(phi_error[0], count[0], 0.5);
    f->phi_worst = quantile(phi_error[0], count[0], 1);
    f->phi1_median = quantile(phi_error[1], count[1], 0.5);
    for (int k = 0; k < 2; k++) {
        f->rays[k] = count[k];
        free(r_error[k]);
        free(phi_error[k]);
    }
}

static enum kd_status measure(const struct options *o, struct kd_renderer *renderer, const struct method *m,
                              struct figures *out, struct kd_error *error)
{
    struct kd_scene scene;
    struct kd_capacity capacity;
    struct kd_plan plan;
    kd_scene_smooth(&scene);
    scene.spacetime.spin = o->spin;
    scene.camera.inclination_deg = o->inclination;
    scene.camera.field_m = 24;
    scene.image.width = scene.image.height = o->size;
    scene.accuracy.orders = m->orders;
    scene.accuracy.steps = m->steps; /* 0: the closed form */
    kd_renderer_capacity(renderer, &capacity);
    enum kd_status status = kd_plan_make_for(&scene, &m->needs, &capacity, &plan, error);
    if (status)
        return status;
    snprintf(out->method, sizeof out->method, "%s", m->name);
    if (plan.lens.path == KD_LENS_LISTED)
        snprintf(out->method, sizeof out->method, "listed, %s, %u steps, %s", kd_engine_name(plan.lens.setting.engine),
                 plan.lens.setting.steps, kd_precision_name(plan.lens.setting.precision));
    float *planes = malloc(sizeof(float) * plan.lens.planes * plan.lens.rays);
    double *ms = malloc(sizeof(double) * (size_t)o->repeat);
    if (!planes || !ms)
        return kd_error_set(error, KD_ENOMEM, "out of memory for the lens map");
    for (int k = -1; k < o->repeat && !status; k++) { /* the first run compiles the kernels */
        const double began = kd_clock_ms();
        double *out_ms = &ms[k < 0 ? 0 : k];
        status = kd_render_lens(renderer, &scene, &plan, planes, out_ms, error);
        /* wall time for listed rays, because the host computes a part of them and copies the map */
        if (plan.lens.path == KD_LENS_LISTED)
            *out_ms = kd_clock_ms() - began;
    }
    if (!status) {
        out->mray_s = (double)plan.lens.rays / quantile(ms, o->repeat, 0.5) * 1e-3;
        judge(o, &scene, &plan, planes, out);
    }
    free(planes);
    free(ms);
    return status;
}

static error_t option(int key, char *text, struct argp_state *state)
{
    struct options *o = state->input;
    switch (key) {
    case 'd': o->device = text; return 0;
    case 'j': o->json = text; return 0;
    case 's': o->size = atoi(text); return 0;
    case 'r': o->repeat = atoi(text); return 0;
    case 'n': o->sample = atoi(text); return 0;
    case 'a': o->spin = atof(text); return 0;
    case 'i': o->inclination = atof(text); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static bool write_json(const char *name, const char *device, const struct options *o, const struct figures *f)
{
    cJSON *root = cJSON_CreateObject(), *list;
    cJSON_AddStringToObject(root, "device", device);
    cJSON_AddNumberToObject(root, "spin", o->spin);
    cJSON_AddNumberToObject(root, "inclination_deg", o->inclination);
    cJSON_AddNumberToObject(root, "field_m", 24);
    cJSON_AddNumberToObject(root, "rays", (double)o->size * o->size);
    list = cJSON_AddArrayToObject(root, "methods");
    for (int i = 0; i < METHODS; i++) {
        cJSON *m = cJSON_CreateObject();
        cJSON_AddStringToObject(m, "method", f[i].method);
        cJSON_AddStringToObject(m, "computes", methods[i].what);
        cJSON_AddNumberToObject(m, "mray_per_s", f[i].mray_s);
        cJSON_AddNumberToObject(m, "r_median", f[i].r_median);
        cJSON_AddNumberToObject(m, "r_worst", f[i].r_worst);
        cJSON_AddNumberToObject(m, "r_median_order_1", f[i].r1_median);
        cJSON_AddNumberToObject(m, "phi_median", f[i].phi_median); /* null if the error was not computed */
        cJSON_AddNumberToObject(m, "phi_worst", f[i].phi_worst);
        cJSON_AddNumberToObject(m, "phi_median_order_1", f[i].phi1_median);
        cJSON_AddItemToArray(list, m);
    }
    char *text = cJSON_Print(root);
    FILE *file = fopen(name, "w");
    bool ok = text && file && fprintf(file, "%s\n", text) > 0;
    ok = file && !fclose(file) && ok;
    cJSON_free(text);
    cJSON_Delete(root);
    return ok;
}

int main(int argc, char **argv)
{
    static const struct argp_option table[] = {
        { "device", 'd', "DEVICE", 0, "auto, an index or part of a name", 0 },
        { "json", 'j', "FILE", 0, "write the figures here as JSON", 0 },
        { "size", 's', "N", 0, "pixels a side (1024)", 0 },
        { "repeat", 'r', "N", 0, "counted runs of each (9); the median is shown", 0 },
        { "sample", 'n', "N", 0, "N x N rays are judged (64)", 0 },
        { "spin", 'a', "A", 0, "(0.9)", 0 },
        { "inclination", 'i', "DEG", 0, "(70)", 0 },
        { 0 },
    };
    struct options o = { "auto", NULL, 1024, 9, 64, 0.9, 70 };
    struct argp parser = { table, option, NULL, "Rays per second of the lens-map kernels against their error.",
                           NULL,  NULL,   NULL };
    argp_parse(&parser, argc, argv, 0, NULL, &o);

    struct kd_error error = { 0 };
    struct kd_renderer *renderer;
    struct figures figures[METHODS] = { 0 };
    if (kd_renderer_create(&(struct kd_renderer_params) { .device = o.device, .passing = true }, &renderer, &error)) {
        fprintf(stderr, "kd_bench_trace: %s\n", error.message);
        return 1;
    }
    printf("device: %s\na = %g, i = %g deg, +-12 M, %d x %d rays, median of %d runs\n\n",
           kd_renderer_device_name(renderer), o.spin, o.inclination, o.size, o.size, o.repeat);
    printf("| method | computes | Mray/s | r: median | worst | order 1 | phi: median | worst | order 1 |\n");
    printf("|---|---|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < METHODS; i++) {
        struct figures *f = &figures[i];
        if (measure(&o, renderer, &methods[i], f, &error)) {
            fprintf(stderr, "kd_bench_trace: %s\n", error.message);
            return 1;
        }
        printf("| %s | %s | %.2f | %.1e | %.1e | %.1e | %.1e | %.1e | %.1e |\n", f->method, methods[i].what, f->mray_s,
               f->r_median, f->r_worst, f->r1_median, f->phi_median, f->phi_worst, f->phi1_median);
        fflush(stdout);
    }
    if (o.json && !write_json(o.json, kd_renderer_device_name(renderer), &o, figures)) {
        perror(o.json);
        return 1;
    }
    kd_renderer_destroy(renderer);
    return 0;
}
