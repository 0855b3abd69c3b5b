#include "render/selftest/accuracy_measure.h"

#include "physics/disk/thin_disk.h"
#include "physics/math/angle.h"
#include "physics/null/null_geodesic.h"
#include "physics/spacetime/kerr.h"
#include "render/device/device_internal.h"
#include "render/rays/closed.h"
#include "render/rays/device.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { ORDERS = KD_ACCURACY_ORDERS, WARM_UP = 64, RUNS = 5, BATCH = 1 << 18, RAYS = 4096, RAYS_QUICK = 256 };

/* The numbers of steps to be measured, which double from first to last. With fewer steps an engine is useless. With
 * more steps rounding dominates, or another engine is better at the same cost. */
static const struct span {
    enum kd_engine engine;
    uint32_t first, last;
} spans[] = {
    { KD_ENGINE_MINO_RKN4, 8, 256 },  { KD_ENGINE_MINO_RKN6, 4, 128 }, { KD_ENGINE_KS_RK4, 16, 256 },
    { KD_ENGINE_KS_EULER, 64, 1024 }, { KD_ENGINE_KS_TAO6, 32, 256 },
};

/* One view of a set, and the true end points of its rays. */
struct truth {
    struct kd_accuracy_view view;
    size_t n;
    double *rays;
    struct kd_ray_crossing *crossings;
    struct kd_ray_end *ends;
};

struct bench {
    struct kd_renderer *renderer;
    struct kd_accuracy_table *table;
    struct truth truths[KD_ACCURACY_SETS][KD_ACCURACY_VIEWS];
    uint32_t views[KD_ACCURACY_SETS];
    double *rays; /* room for BATCH rays, for measuring speed */
    struct kd_ray_crossing *crossings;
    struct kd_ray_end *ends;
    double *errors[KD_ACCURACY_QUANTITIES];
    struct kd_error *error;
};

static double seconds_of(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static struct kd_rays_params params_of(const struct kd_accuracy_row *row, const struct kd_accuracy_view *view)
{
    return (struct kd_rays_params) {
        .spin = view->spin,
        .r = INFINITY,
        .inclination_deg = view->inclination_deg,
        .orders = ORDERS,
        .engine = row->engine,
        .precision = row->precision,
        .steps = row->steps,
    };
}

/* Computes one ray in closed form, which shares only the constants of motion with the engines. */
static void end_in_closed_form(const struct kd_null_ray *ray, double s, struct kd_ray_crossing *crossings,
                               struct kd_ray_end *end)
{
    struct kd_null_path path = kd_null_trace(ray);
    *end = (struct kd_ray_end) { .n_crossings = (uint32_t)path.crossings };
    end->fate = path.status == KD_NULL_CRITICAL ? KD_RAY_UNDECIDED
                : path.fate == KD_NULL_ESCAPED  ? KD_RAY_ESCAPED
                                                : KD_RAY_CAPTURED;
    for (int k = 0; k < path.crossings; k++) {
        double r = path.crossing[k].r;
        bool sure = isfinite(path.crossing[k].error_r);
        crossings[k] = (struct kd_ray_crossing) { sure ? r : NAN, path.crossing[k].phi, path.crossing[k].delay,
                                                  kd_disk_redshift(&ray->hole, r, -ray->alpha * s) };
    }
}

/* Computes the true end points, as far as they can be known. *s: the time that one core takes. */
static void reference_of(const struct kd_accuracy_view *view, const double *rays, size_t n,
                         struct kd_ray_crossing *crossings, struct kd_ray_end *ends, double *s)
{
    double sine = kd_sin_deg(view->inclination_deg), begun = seconds_of(CLOCK_THREAD_CPUTIME_ID);
    struct kd_null_ray ray = { .hole = kd_hole_of(view->spin),
                               .radius = INFINITY,
                               .cos_theta = kd_cos_deg(view->inclination_deg),
                               .sin_theta = sine,
                               .orders = ORDERS };
    for (size_t k = 0; k < n; k++) {
        ray.alpha = rays[2 * k];
        ray.beta = rays[2 * k + 1];
        end_in_closed_form(&ray, sine, crossings + k * ORDERS, &ends[k]);
    }
    *s = seconds_of(CLOCK_THREAD_CPUTIME_ID) - begun;
}

/* *s: time of the kernels only. */
static enum kd_status trace(struct bench *b, const struct kd_accuracy_row *row, const struct kd_accuracy_view *view,
                            const double *rays, size_t n, double *s)
{
    struct kd_vk *vk = b->renderer->vk;
    struct kd_rays_params params = params_of(row, view);
    struct kd_vk_time times[KD_VK_MAX_PASSES];
    if (row->engine == KD_ENGINE_CLOSED) {
        reference_of(view, rays, n, b->crossings, b->ends, s);
        return KD_OK;
    }
    kd_vk_times_reset(vk);
    double begun = seconds_of(CLOCK_MONOTONIC);
    const struct kd_ray_labels labels = { rays, NULL, n };
    enum kd_status status = kd_rays_device(b->renderer, &params, &labels, b->crossings, b->ends, NULL, NULL, b->error);
    *s = seconds_of(CLOCK_MONOTONIC) - begun;
    if (!status)
        kd_rays_redshift(&params, &labels, b->crossings, b->ends);
    if (status || !b->table->device_clock)
        return status;
    *s = 0;
    for (size_t i = 0, found = kd_vk_times(vk, times); i < found; i++)
        if (!strcmp(times[i].pass, "rays"))
            *s += 1e-3 * times[i].ms;
    return KD_OK;
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Measures the time per ray in seconds. It is the shortest of several runs, because other work on the machine only
 * slows them. Each run has a share of the time, in which it traces the list repeatedly. A list that takes longer than
 * this share is shortened. *s: on entry, the time that the list takes. */
static enum kd_status time_view(struct bench *b, const struct kd_accuracy_row *row, const struct truth *t, double share,
                                double *s)
{
    double wanted = b->table->seconds * share, spent = *s, best = fmax(*s / (double)t->n, 1e-12), run;
    size_t filled = 0, least = b->table->quick ? RAYS_QUICK : RAYS / 4;
    for (int k = 0; k < RUNS && (spent < wanted || k < (b->table->quick ? 0 : 2)); k++) {
        size_t n = (size_t)fmin(fmax(wanted / RUNS / best, (double)least), BATCH);
        for (; filled < n; filled++)
            memcpy(b->rays + 2 * filled, t->rays + 2 * (filled % t->n), 2 * sizeof *b->rays);
        enum kd_status status = trace(b, row, &t->view, b->rays, n, &run);
        if (status)
            return status;
        spent += run;
        best = fmin(best, fmax(run / (double)n, 1e-12));
    }
    *s = best;
    return KD_OK;
}

static double value_of(const struct kd_ray_crossing *c, int quantity)
{
    return (const double[]) { c->r, c->phi, c->delay, c->g }[quantity];
}

static double error_of(double value, double truth, int quantity)
{
    switch (quantity) {
    case KD_ACCURACY_PHI: return fabs(remainder(value - truth, 2 * M_PI));
    case KD_ACCURACY_DELAY: return fabs(value - truth);
    default: return fabs(value / truth - 1);
    }
}

/* Appends the errors of one view to the errors already collected. */
static void judge(struct bench *b, const struct kd_accuracy_row *row, const struct truth *t,
                  struct kd_accuracy_entry *e, size_t counts[KD_ACCURACY_QUANTITIES])
{
    double inner = kd_kerr_isco(kd_hole(t->view.spin)); /* Boyer-Lindquist phi and t diverge at the horizon */
    bool delays = row->engine == KD_ENGINE_MINO_RKN4 || row->engine == KD_ENGINE_MINO_RKN6;
    for (size_t i = 0; i < t->n; i++) {
        const struct kd_ray_end *end = &b->ends[i], *true_end = &t->ends[i];
        bool differs = end->n_crossings != true_end->n_crossings ||
                       (end->fate != true_end->fate && true_end->fate != KD_RAY_UNDECIDED);
        uint32_t both = end->n_crossings < true_end->n_crossings ? end->n_crossings : true_end->n_crossings;
        for (uint32_t k = 0; k < both; k++) {
            const struct kd_ray_crossing *c = &b->crossings[i * ORDERS + k], *truth = &t->crossings[i * ORDERS + k];
            if (!(truth->r >= inner && truth->r <= KD_ACCURACY_FAR))
                continue;
            e->crossings++;
            for (int q = 0; q < KD_ACCURACY_QUANTITIES; q++) {
                double error = error_of(value_of(c, q), value_of(truth, q), q);
                if (isfinite(error))
                    b->errors[q][counts[q]++] = error;
                else if (q <= KD_ACCURACY_PHI || (q == KD_ACCURACY_DELAY && delays))
                    differs = true;
            }
        }
        e->differ += differs;
    }
    e->rays += (uint32_t)t->n;
}

static struct kd_accuracy_errors summary(double *errors, size_t n)
{
    if (!n)
        return (struct kd_accuracy_errors) { NAN, NAN, NAN };
    qsort(errors, n, sizeof *errors, by_value);
    return (struct kd_accuracy_errors) { errors[n / 2], errors[(size_t)(0.99 * (double)n)], errors[n - 1] };
}

static enum kd_status measure_set(struct bench *b, struct kd_accuracy_row *row, int set)
{
    struct kd_accuracy_entry *e = &row->sets[set];
    size_t counts[KD_ACCURACY_QUANTITIES] = { 0 };
    double seconds = 0, s;
    for (uint32_t v = 0; v < b->views[set]; v++) {
        const struct truth *t = &b->truths[set][v];
        enum kd_status status = trace(b, row, &t->view, t->rays, t->n, &s);
        if (status)
            return status;
        judge(b, row, t, e, counts);
        status = time_view(b, row, t, 1.0 / b->views[set], &s);
        if (status)
            return status;
        seconds += s * (double)t->n;
    }
    e->rays_per_s = seconds > 0 ? e->rays / seconds : NAN;
    for (int q = 0; q < KD_ACCURACY_QUANTITIES; q++)
        e->of[q] = summary(b->errors[q], row->engine == KD_ENGINE_CLOSED ? 0 : counts[q]);
    return KD_OK;
}

static enum kd_status prepare_view(struct bench *b, int set, uint32_t view, size_t n)
{
    struct truth *t = &b->truths[set][view];
    double s;
    t->n = n;
    t->rays = malloc(2 * n * sizeof *t->rays);
    t->crossings = malloc(n * ORDERS * sizeof *t->crossings);
    t->ends = malloc(n * sizeof *t->ends);
    if (!t->rays || !t->crossings || !t->ends)
        return kd_error_set(b->error, KD_ENOMEM, "out of memory for the rays");
    kd_accuracy_rays((enum kd_accuracy_set)set, view, n, t->rays);
    reference_of(&t->view, t->rays, n, t->crossings, t->ends, &s);
    return KD_OK;
}

static enum kd_status prepare(struct bench *b)
{
    size_t n = b->table->quick ? RAYS_QUICK : RAYS;
    enum kd_status status = KD_OK;
    b->rays = malloc(2 * BATCH * sizeof *b->rays);
    b->crossings = malloc((size_t)BATCH * ORDERS * sizeof *b->crossings);
    b->ends = malloc(BATCH * sizeof *b->ends);
    if (!b->rays || !b->crossings || !b->ends)
        return kd_error_set(b->error, KD_ENOMEM, "out of memory for the rays");
    for (int q = 0; q < KD_ACCURACY_QUANTITIES; q++) {
        b->errors[q] = malloc(n * ORDERS * sizeof **b->errors);
        if (!b->errors[q])
            return kd_error_set(b->error, KD_ENOMEM, "out of memory for the errors");
    }
    for (int set = 0; set < KD_ACCURACY_SETS && !status; set++) {
        struct kd_accuracy_view views[KD_ACCURACY_VIEWS];
        b->views[set] = kd_accuracy_views((enum kd_accuracy_set)set, views);
        for (uint32_t v = 0; v < b->views[set] && !status; v++) {
            b->truths[set][v].view = views[v];
            status = prepare_view(b, set, v, n / b->views[set]);
        }
    }
    return status;
}

static void finish(struct bench *b)
{
    for (int set = 0; set < KD_ACCURACY_SETS; set++)
        for (int v = 0; v < KD_ACCURACY_VIEWS; v++) {
            free(b->truths[set][v].rays);
            free(b->truths[set][v].crossings);
            free(b->truths[set][v].ends);
        }
    for (int q = 0; q < KD_ACCURACY_QUANTITIES; q++)
        free(b->errors[q]);
    free(b->rays);
    free(b->crossings);
    free(b->ends);
}

/* Lists the rows to be measured, without their results. */
static void list_rows(struct kd_accuracy_table *table, bool float64)
{
    table->rows[table->n++] = (struct kd_accuracy_row) { .engine = KD_ENGINE_CLOSED, .precision = KD_PRECISION_F64 };
    for (size_t i = 0; i < sizeof spans / sizeof *spans; i++)
        for (int wide = 0; wide <= float64; wide++)
            for (uint32_t steps = spans[i].first; steps <= spans[i].last; steps *= 2)
                table->rows[table->n++] = (struct kd_accuracy_row) {
                    .engine = spans[i].engine, .precision = wide ? KD_PRECISION_F64 : KD_PRECISION_F32, .steps = steps
                };
}

enum kd_status kd_accuracy_measure(struct kd_renderer *renderer, const struct kd_accuracy_params *params,
                                   kd_progress_fn progress, void *user, struct kd_accuracy_table *out,
                                   struct kd_error *error)
{
    struct bench b = { .renderer = renderer, .table = out, .error = error };
    *out = (struct kd_accuracy_table) { 0 };
    kd_accuracy_head(renderer, params, out);
    list_rows(out, kd_vk_info(renderer->vk)->float64);
    enum kd_status status;
    KD_TRY(prepare(&b));
    for (uint32_t i = 0; i < out->n; i++) {
        double s; /* the time of this run is not used, because the run compiles the kernel */
        const struct truth *first = &b.truths[KD_ACCURACY_BULK][0];
        KD_TRY(trace(&b, &out->rows[i], &first->view, first->rays, WARM_UP, &s));
        for (int set = 0; set < KD_ACCURACY_SETS; set++) {
            KD_TRY(measure_set(&b, &out->rows[i], set));
            if (progress && !progress(user, (i + (set + 1.0) / KD_ACCURACY_SETS) / out->n))
                KD_TRY(kd_error_set(error, KD_ECANCELLED, "the measurement was cancelled"));
        }
    }
done:
    finish(&b);
    return status;
}
