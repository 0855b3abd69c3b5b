#include "orbit/run.h"

#include "orbit/cases.h"
#include "physics/kerr.h"

#include <math.h>

#define DEFAULT_PERIODS 10
#define TRIAL_STEPS_MAX (1u << 20)

const char *kd_orbit_end_name(enum kd_orbit_end end)
{
    static const char *const names[] = { "duration", "horizon", "r_max" };
    return names[end];
}

enum kd_status kd_orbit_run_init(struct kd_orbit_run *run, const struct kd_orbit_request *request, size_t index,
                                 struct kd_error *error)
{
    *run = (struct kd_orbit_run) { .params = &request->params, .error_estimate = NAN, .mino_end = NAN, .aim = NAN, .first_phi = NAN };
    enum kd_status status = kd_orbit_request_solve(request, index, &run->orbit, &run->start, error);
    if (status)
        return status;
    run->phi = request->specs[index].form == KD_ORBIT_STATE ? request->specs[index].phi_deg * M_PI / 180 : 0;
    run->mass_msun = request->params.mass_msun;
    if (isnan(run->mass_msun) && request->specs[index].form == KD_ORBIT_CASE)
        run->mass_msun = kd_orbit_case_mass_msun(request->specs[index].named);
    run->samples = request->many && !request->params.series ? 0 : request->params.samples;
    run->closed = run->orbit.fate == KD_ORBIT_BOUND;
    run->period = NAN;
    if (run->closed) {
        run->bound = kd_orbit_bound_of(&run->orbit, &run->start);
        run->frequencies = kd_orbit_frequencies_of(&run->bound);
        run->period = 2 * M_PI / (run->orbit.circular ? fabs(run->frequencies.mino_phi) : run->frequencies.mino_r);
    }
    return KD_OK;
}

/* The fastest phase of the motion per Mino time, roughly: to choose a first step by. */
static double pace(const struct kd_orbit *o)
{
    double fastest = fmax(o->total + o->a * o->a * o->binding, o->total), w[3] = { o->w_low, 0.5 * (o->w_low + o->w_high), o->w_high };
    for (int i = 0; i < 3; i++) {
        fastest = fmax(fastest, fabs(o->w[2] + w[i] * (3 * o->w[3] + w[i] * 6 * o->w[4])));
        fastest = fmax(fastest, kd_orbit_radial(o, w[i]) / (o->w_high * o->w_high));
    }
    return sqrt(fastest);
}

/* Where t is `time`: t grows steadily. */
static double mino_at(const struct kd_orbit_run *run, double time)
{
    double low = 0, high = time / run->frequencies.mino_t + 2 * run->period;
    if (run->closed && kd_orbit_bound_at(&run->bound, high).t < time)
        high *= 2;
    for (int i = 0; i < 200 && high - low > 1e-15 * high; i++) {
        double middle = 0.5 * (low + high);
        if (kd_orbit_bound_at(&run->bound, middle).t < time)
            low = middle;
        else
            high = middle;
    }
    return high;
}

static enum kd_orbit_method method_of(const struct kd_orbit_run *run)
{
    return run->params->way == KD_WAY_RKN6 ? KD_ORBIT_RKN6 : KD_ORBIT_YOSHIDA6;
}

/* What is not bound ends at the horizon or far away, or when its time is over: found by following it once. */
static void find_end(struct kd_orbit_run *run)
{
    const struct kd_orbit *o = &run->orbit;
    struct kd_orbit_path path, before;
    double horizon = 1 / kd_kerr_horizon(o->a), h = 2 * M_PI / pace(o) / 128, far = 1 / run->params->r_max;
    double time = run->params->time, turns = isnan(run->params->periods) ? 1000 : run->params->periods;
    if (run->start.w <= far)
        far = run->start.w_rate > 0 ? run->start.w : 0.5 * run->start.w;
    kd_orbit_path_init(&path, o, &run->start, method_of(run));
    for (double steps = turns * 128; steps > 0; steps--) {
        before = path;
        kd_orbit_path_step(&path, h);
        double w = path.place[KD_PATH_W].value;
        bool falls = o->fate == KD_ORBIT_PLUNGE && w >= horizon;
        bool leaves = o->fate == KD_ORBIT_ESCAPE && w <= far && path.rate[KD_PATH_W].value < 0;
        if (falls || leaves) {
            run->end = falls ? KD_END_HORIZON : KD_END_FAR;
            run->aim = falls ? horizon : far;
            path = kd_orbit_path_to_radius(&before, h, run->aim);
            steps = 1;
        }
        double t = kd_orbit_path_place(&path).t;
        if (!isnan(time) && !(t < time)) {
            run->end = KD_END_DURATION;
            run->aim = time;
            path = kd_orbit_path_to_time(&before, path.mino.value - before.mino.value, time);
            break;
        }
    }
    run->mino_end = path.mino.value;
}

static struct kd_orbit_place after(const struct kd_orbit_run *run, double mino, uint32_t steps)
{
    struct kd_orbit_path path;
    kd_orbit_path_init(&path, &run->orbit, &run->start, method_of(run));
    for (uint32_t i = 0; i < steps; i++)
        kd_orbit_path_step(&path, mino / steps);
    return kd_orbit_path_place(&path);
}

static double distance(const struct kd_orbit_place *a, const struct kd_orbit_place *b)
{
    double d = fmax(fabs(a->r / b->r - 1), fmax(fabs(a->theta - b->theta), fabs(a->phi - b->phi) / (1 + fabs(b->phi))));
    d = fmax(d, fmax(fabs(a->t / b->t - 1), fabs(a->proper / b->proper - 1)));
    return isnan(a->t) || isnan(a->r) ? INFINITY : d;
}

/* Twice as many steps until halving them moves the end, at the order of the method, by no more than the tolerance. The error of a
 * method of order 6 is a 63rd of that move. Stops where rounding, or a whirl that magnifies it, leaves nothing to gain. */
static double find_step(struct kd_orbit_run *run)
{
    /* not quite to the end, where t is infinite if it is the horizon */
    double span = run->closed ? fmin(run->period, run->mino_end) : 0.999 * run->mino_end, tolerance = run->params->tolerance;
    /* A fall is fast at its end, which little of the span shows, and a whirl magnifies what is not the step's. */
    double longest = run->closed ? span : 2 * M_PI / pace(&run->orbit) / 256;
    uint32_t n = (uint32_t)fmin(fmax(16, ceil(span * pace(&run->orbit) * 4)), TRIAL_STEPS_MAX / 4);
    struct kd_orbit_place coarse = after(run, span, n);
    double last = INFINITY;
    for (; n < TRIAL_STEPS_MAX; n *= 2) {
        struct kd_orbit_place fine = after(run, span, 2 * n);
        double error = distance(&coarse, &fine) / 63;
        if (error <= tolerance) {
            double fewer = fmax(pow(error / tolerance, 1.0 / 6), 0.5);
            run->error_estimate = fmax(error / pow(fewer, 6), 1e-16);
            return fmin(span / ceil(2 * n * fewer), longest);
        }
        if (last < 1e-9 && error > 0.25 * last)
            break;
        last = error;
        coarse = fine;
    }
    run->error_estimate = last;
    return fmin(span / n, longest);
}

static enum kd_status set_end(struct kd_orbit_run *run, struct kd_error *error)
{
    const struct kd_orbit_params *p = run->params;
    if (run->closed) {
        run->end = KD_END_DURATION;
        run->mino_end = isnan(p->time) ? (isnan(p->periods) ? DEFAULT_PERIODS : p->periods) * run->period : mino_at(run, p->time);
        return KD_OK;
    }
    if (!isnan(p->periods) && !run->orbit.circular)
        return kd_error_field(error, "/duration/periods", "periods belong to a bound orbit, and this one is to %s: leave the duration out to "
                              "follow it to its end, or give a time", kd_orbit_fate_name(run->orbit.fate));
    find_end(run);
    return KD_OK;
}

enum kd_status kd_orbit_run_prepare(struct kd_orbit_run *run, struct kd_error *error)
{
    const struct kd_orbit_params *p = run->params;
    if (p->way == KD_WAY_CLOSED && !run->closed)
        return kd_error_field(error, "/method", "method is \"closed\", which follows bound orbits only, and this one is to %s",
                              kd_orbit_fate_name(run->orbit.fate));
    enum kd_status status = set_end(run, error);
    if (status)
        return status;
    if (p->way == KD_WAY_CLOSED) {
        run->steps = run->samples ? run->samples - 1 : 1;
    } else {
        double whole = run->closed ? run->period : run->mino_end;
        double step = p->steps ? whole / p->steps : find_step(run), pieces = run->samples ? run->samples - 1 : 1;
        double each = fmax(ceil(run->mino_end / step / pieces * (1 - 1e-12)), 1);
        if (!(each * pieces <= KD_ORBIT_STEPS_MAX))
            return kd_error_field(error, "/duration", "the duration takes %.3g steps, allowed are %.0f", each * pieces, KD_ORBIT_STEPS_MAX);
        run->steps = (uint64_t)(each * pieces);
        run->h = run->mino_end / (double)run->steps;
    }
    kd_orbit_path_init(&run->path, &run->orbit, &run->start, method_of(run));
    if (run->start.w_rate == 0 && kd_orbit_radial_slope(&run->orbit, run->start.w) < 0 && !run->orbit.circular) {
        run->periastra = 1;
        run->first_phi = run->last_phi = 0;
    }
    return KD_OK;
}

static struct kd_orbit_sample sample_of(const struct kd_orbit_run *run, struct kd_orbit_place place, double energy_error)
{
    double a = run->orbit.a, across = sqrt(place.r * place.r + a * a) * sin(place.theta);
    place.phi += run->phi;
    return (struct kd_orbit_sample) { .place = place, .x = across * cos(place.phi), .y = across * sin(place.phi),
                                      .z = place.r * cos(place.theta), .energy_error = energy_error };
}

static void take_worst(struct kd_orbit_drift *worst, struct kd_orbit_drift now)
{
    worst->energy = fmax(worst->energy, fabs(now.energy));
    worst->carter = fmax(worst->carter, fabs(now.carter));
    worst->mass = fmax(worst->mass, fabs(now.mass)); /* fmax leaves a NAN out */
    worst->binet = isnan(now.binet) ? NAN : fmax(worst->binet, fabs(now.binet));
}

/* w grows until periastron and falls after it. */
static void note_periastron(struct kd_orbit_run *run)
{
    struct kd_orbit_path at = kd_orbit_path_to_apsis(&run->path, -run->h);
    run->last_phi = kd_orbit_path_place(&at).phi;
    if (!run->periastra++)
        run->first_phi = run->last_phi;
}

static size_t advance_closed(struct kd_orbit_run *run, uint64_t steps, struct kd_orbit_sample *samples, size_t room)
{
    size_t n = 0;
    for (; steps > 0 && !kd_orbit_run_done(run) && (n < room || !run->samples); steps--) {
        if (run->samples) {
            double mino = run->mino_end * ((double)run->sampled++ / (run->samples - 1));
            samples[n++] = sample_of(run, kd_orbit_bound_at(&run->bound, mino), NAN);
        }
        if (run->sampled > 1 || !run->samples)
            run->done++;
    }
    return n;
}

/* The last step of what is not bound, to where its end was found to be with another step: less than half a step off. */
static void step_to_the_end(struct kd_orbit_run *run)
{
    if (run->end == KD_END_DURATION)
        run->path = kd_orbit_path_to_time(&run->path, 1.5 * run->h, run->aim);
    else
        run->path = kd_orbit_path_to_radius(&run->path, 1.5 * run->h, run->aim);
}

size_t kd_orbit_run_advance(struct kd_orbit_run *run, uint64_t steps, struct kd_orbit_sample *samples, size_t room)
{
    size_t n = 0;
    if (run->params->way == KD_WAY_CLOSED)
        return advance_closed(run, steps, samples, room);
    uint64_t each = run->samples ? run->steps / (run->samples - 1) : 0;
    if (run->samples && !run->sampled && room) {
        samples[n++] = sample_of(run, kd_orbit_path_place(&run->path), kd_orbit_path_drift(&run->path).energy);
        run->sampled = 1;
    }
    while (steps-- > 0 && run->done < run->steps && (n < room || !run->samples)) {
        double before = run->path.rate[KD_PATH_W].value;
        if (!isnan(run->aim) && run->done + 1 == run->steps)
            step_to_the_end(run);
        else
            kd_orbit_path_step(&run->path, run->h);
        run->done++;
        struct kd_orbit_drift drift = kd_orbit_path_drift(&run->path);
        take_worst(&run->worst, drift);
        if (before > 0 && run->path.rate[KD_PATH_W].value <= 0)
            note_periastron(run);
        if (each && run->done % each == 0) {
            samples[n++] = sample_of(run, kd_orbit_path_place(&run->path), drift.energy);
            run->sampled++;
        }
    }
    return n;
}

bool kd_orbit_run_done(const struct kd_orbit_run *run)
{
    return run->done == run->steps && run->sampled == run->samples;
}

double kd_orbit_run_fraction(const struct kd_orbit_run *run)
{
    return run->steps ? (double)run->done / (double)run->steps : 0;
}

double kd_orbit_run_advance_measured(const struct kd_orbit_run *run)
{
    if (run->periastra < 2)
        return NAN;
    return fabs(run->last_phi - run->first_phi) / (double)(run->periastra - 1) - 2 * M_PI;
}
