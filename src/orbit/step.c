#include "orbit/step.h"

#include "base/pause.h"

#include <math.h>

#define STEPS_MAX (1u << 20)

double kd_orbit_pace(const struct kd_orbit *o)
{
    double fastest = fmax(o->total + o->hole.a * o->hole.a * o->binding, o->total),
           w[3] = { o->w_low, 0.5 * (o->w_low + o->w_high), o->w_high };
    for (int i = 0; i < 3; i++) {
        fastest = fmax(fastest, fabs(o->w[2] + w[i] * (3 * o->w[3] + w[i] * 6 * o->w[4])));
        fastest = fmax(fastest, kd_orbit_radial(o, w[i]) / (o->w_high * o->w_high));
    }
    return sqrt(fastest);
}

/* State of the search for a step. The search doubles the number of steps until the estimated error is within the
 * tolerance. The estimate follows from the change at the last doubling and the order of the method. */
struct trial {
    double span, longest, last, step;
    uint32_t n;
    struct kd_orbit_place coarse, fine;
    bool over;
};

static struct trial begin(const struct kd_orbit_run *run)
{
    struct trial t = { .last = INFINITY };
    /* the trial stops a little before the horizon, where t is infinite */
    t.span = run->closed ? fmin(run->period, run->mino_end) : (run->end == KD_END_HORIZON ? 0.999 : 1) * run->mino_end;
    /* On an unbound path the step has an upper limit, for two reasons. First, the motion becomes fast at the end of a
     * fall, which the rates at the start of the span do not show. Second, a whirl magnifies errors that do not come
     * from the step. */
    t.longest = run->closed ? t.span : 2 * M_PI / kd_orbit_pace(&run->orbit) / 256;
    t.n = (uint32_t)fmin(fmax(16, ceil(t.span * kd_orbit_pace(&run->orbit) * 4)), STEPS_MAX / 4);
    return t;
}

static double distance(const struct kd_orbit_place *a, const struct kd_orbit_place *b)
{
    double d = fmax(fabs(a->r / b->r - 1), fmax(fabs(a->theta - b->theta), fabs(a->phi - b->phi) / (1 + fabs(b->phi))));
    d = fmax(d, fmax(fabs(a->t / b->t - 1), fabs(a->proper / b->proper - 1)));
    return isnan(a->t) || isnan(a->r) ? INFINITY : d;
}

/* Judges a trial, for a method of order 6. When the step is halved, the remaining error is 1/63 of the change of the
 * result. The search stops when rounding, or a whirl that magnifies rounding, prevents a further gain.
 */
static void judge(struct kd_orbit_run *run, struct trial *t)
{
    double error = distance(&t->coarse, &t->fine) / 63, tolerance = fmax(run->params->tolerance, 0.1 * run->rounding);
    if (error <= tolerance) {
        double fewer = fmax(pow(error / tolerance, 1.0 / 6), 0.5);
        run->error_estimate = fmax(error / pow(fewer, 6), 1e-16);
        t->step = t->span / ceil(2 * t->n * fewer);
        t->over = true;
        return;
    }
    t->over = (t->last < 1e-9 && error > 0.25 * t->last) || 2 * t->n >= STEPS_MAX;
    if (!t->over) {
        t->last = error;
        t->coarse = t->fine;
        t->n *= 2;
        return;
    }
    run->error_estimate = fmin(t->last, error);
    t->step = t->span / t->n;
}

/* Follows each trial over its span. times: number of steps as a multiple of the trial's n. */
static void follow(struct kd_orbit_run *const *runs, struct trial *trials, int n, uint32_t times)
{
    struct kd_orbit_path paths[KD_ORBIT_LANES];
    struct kd_orbit_lanes lanes = { 0 };
    for (int i = 0; i < KD_ORBIT_LANES; i++) {
        bool idle = i >= n || trials[i].over;
        paths[i] = runs[idle ? 0 : i]->path;
        lanes.path[i] = &paths[i];
        lanes.steps[i] = idle ? 0 : times * trials[i].n;
        lanes.h[i] = idle ? 0 : trials[i].span / (double)lanes.steps[i];
    }
    if (n > 1)
        kd_orbit_lanes_run(&lanes);
    for (uint64_t k = 0; n == 1 && k < lanes.steps[0]; k++) {
        kd_pause_every(k, 1024);
        kd_orbit_path_step(&paths[0], lanes.h[0]);
    }
    for (int i = 0; i < n; i++)
        if (!trials[i].over)
            trials[i].fine = kd_orbit_path_place(&paths[i]);
}

void kd_orbit_choose_steps(struct kd_orbit_run *const *runs, int n)
{
    struct trial trials[KD_ORBIT_LANES];
    bool over = false;
    for (int i = 0; i < n; i++)
        trials[i] = begin(runs[i]);
    follow(runs, trials, n, 1);
    for (int i = 0; i < n; i++)
        trials[i].coarse = trials[i].fine;
    while (!over) {
        follow(runs, trials, n, 2);
        over = true;
        for (int i = 0; i < n; i++) {
            if (!trials[i].over)
                judge(runs[i], &trials[i]);
            over &= trials[i].over;
        }
    }
    for (int i = 0; i < n; i++)
        runs[i]->h = fmin(trials[i].step, trials[i].longest);
}
