#include "orbit/run.h"

#include "base/pause.h"
#include "orbit/cases.h"
#include "orbit/step.h"
#include "physics/math/angle.h"
#include "physics/spacetime/kerr.h"

#include <math.h>

/* limit of the number of turns of an orbit that is followed to its end; a whirl next to an unstable circle may need
 * many */
#define LONGEST_TURNS 1000
#define DEFAULT_PERIODS 10
/* after this number of samples in a row without an image, only every SEARCH_EVERY-th sample gets a full search for an
 * image */
#define SEARCHES 3
#define SEARCH_EVERY 64
/* Largest number of times that the search for an orbit's end halves the step. Each halving reduces the error by a
 * factor of 64, from about 1e-10 down to rounding. */
#define HALVINGS 6

const char *kd_orbit_end_name(enum kd_orbit_end end)
{
    static const char *const names[] = { "duration", "horizon", "r_max" };
    return names[end];
}

/* Makes the observer's view, and checks that the observer can exist. */
static enum kd_status look(struct kd_orbit_run *run, struct kd_error *error)
{
    const struct kd_orbit_observer *o = &run->params->seen;
    const struct kd_vantage at = { run->orbit.hole, o->r, kd_cos_deg(o->inclination_deg),
                                   kd_sin_deg(o->inclination_deg) };
    const struct kd_observer_motion motion = kd_observer_motion_of(o->motion);
    char others[KD_OBSERVER_TEXT];
    run->image = (struct kd_place_image) { .off = NAN };
    if (isfinite(o->r) && !(o->r > run->orbit.hole.outer))
        return kd_error_field(error, "/seen/observer_r",
                              "observer_r is %.9g; it must be a radius outside the horizon, r = %.9g", o->r,
                              run->orbit.hole.outer);
    if (isfinite(o->r) && !kd_observer_exists(o->motion, &at))
        return kd_error_field(error, "/seen/observer_r",
                              "observer_r is %.9g, where no observer can be %s; observer must be %s there", o->r,
                              kd_observers[o->motion].word, kd_observer_others(&at, others));
    run->view = kd_place_view_of(&motion, &at);
    return KD_OK;
}

enum kd_status kd_orbit_run_init(struct kd_orbit_run *run, const struct kd_orbit_request *request, size_t index,
                                 struct kd_error *error)
{
    *run = (struct kd_orbit_run) {
        .params = &request->params, .error_estimate = NAN, .mino_end = NAN, .aim = NAN, .first_phi = NAN
    };
    enum kd_status status = kd_orbit_request_solve(request, index, &run->orbit, &run->start, &run->rounding, error);
    if (status)
        return status;
    run->phi = request->specs[index].form == KD_ORBIT_STATE ? request->specs[index].phi_deg * M_PI / 180 : 0;
    run->mass_msun = request->params.mass_msun;
    if (isnan(run->mass_msun) && request->specs[index].form == KD_ORBIT_CASE)
        run->mass_msun = kd_orbit_case_mass_msun(request->specs[index].named);
    run->samples = request->many && !request->params.series ? 0 : request->params.samples;
    run->closed = run->orbit.fate == KD_ORBIT_BOUND;
    run->period = NAN;
    if (kd_orbit_is_seen(run->params) && (status = look(run, error)))
        return status;
    if (run->closed) {
        run->bound = kd_orbit_bound_of(&run->orbit, &run->start);
        run->frequencies = kd_orbit_frequencies_of(&run->bound);
        run->period = 2 * M_PI / (run->orbit.circular ? fabs(run->frequencies.mino_phi) : run->frequencies.mino_r);
    }
    return KD_OK;
}

enum kd_orbit_method kd_orbit_run_method(const struct kd_orbit_run *run)
{
    return run->params->way == KD_WAY_RKN6 ? KD_ORBIT_RKN6 : KD_ORBIT_YOSHIDA6;
}

/* Finds the Mino time at which t(Mino time) = time, by bisection. t is monotonic. */
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

/* True if a step has left the range that the constants of motion allow: it went past a turning point, or back without
 * reaching one. With too long a step this happens close to a whirl. */
static bool strays(const struct kd_orbit *o, const struct kd_orbit_path *before, const struct kd_orbit_path *path)
{
    /* the negation makes this true for NAN as well */
    bool fallen = !(path->place[KD_PATH_W].value < 1 / o->hole.outer);
    if (o->fate == KD_ORBIT_ESCAPE)
        return fallen;
    return !o->circular && !fallen && before->rate[KD_PATH_W].value > 0 && !(path->rate[KD_PATH_W].value > 0);
}

/* number of steps, about a second of work, after which the search for the end is given up. Far out, steps may be too
 * short for the path ever to arrive */
#define SEARCH_STEPS 5e6

/* Finds the end of an unbound path by following it once in steps of h. The end is where the path reaches the horizon or
 * r_max, or where its duration is over. Returns false if the path strays, or does not reach the requested end. */
static bool find_end(struct kd_orbit_run *run, double h)
{
    const struct kd_orbit *o = &run->orbit;
    struct kd_orbit_path path, before;
    double horizon = 1 / o->hole.outer, far = 1 / run->params->r_max;
    double time = run->params->time,
           turns = isnan(run->params->periods) || !o->circular ? LONGEST_TURNS : run->params->periods;
    double longest = turns * 2 * M_PI / kd_orbit_pace(o);
    if (run->start.w <= far)
        far = run->start.w_rate > 0 ? run->start.w : 0.5 * run->start.w;
    run->end = KD_END_DURATION;
    run->aim = NAN;
    kd_orbit_path_init(&path, o, &run->start, kd_orbit_run_method(run));
    double left = o->circular ? INFINITY : fmax(SEARCH_STEPS, 2 * run->mino_end / h);
    for (bool over = false; !over && path.mino.value < longest;) {
        if (!(left-- > 0))
            return false;
        kd_pause_every((uint64_t)left, 1024);
        before = path;
        kd_orbit_path_step(&path, h);
        if (strays(o, &before, &path))
            return false;
        double w = path.place[KD_PATH_W].value, rate = path.rate[KD_PATH_W].value;
        bool falls = o->fate == KD_ORBIT_PLUNGE && w >= horizon;
        /* the path turned within the step, or comes from infinity with E = 1 */
        bool back = before.rate[KD_PATH_W].value < 0 && rate >= 0;
        bool leaves = o->fate == KD_ORBIT_ESCAPE && ((w <= far && rate < 0) || back);
        if (falls || leaves) {
            run->end = falls ? KD_END_HORIZON : KD_END_FAR;
            run->aim = falls ? horizon : far;
            path = kd_orbit_path_to_radius(&before, h, run->aim);
            over = true;
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
    return !isnan(run->aim) || o->circular ||
           path.place[KD_PATH_W].value ==
               run->start.w; /* a body that starts on an unstable circle has its end at its start */
}

static enum kd_status no_end(const struct kd_orbit_run *run, struct kd_error *error)
{
    if (run->params->steps)
        return kd_error_field(error, "/steps", "steps is %u; it must be larger to find the end of this path",
                              run->params->steps);
    return kd_error_field(error, "/orbit", "double precision cannot follow this path to its end");
}

static enum kd_status set_end(struct kd_orbit_run *run, struct kd_error *error)
{
    const struct kd_orbit_params *p = run->params;
    if (run->closed) {
        run->end = KD_END_DURATION;
        run->mino_end =
            isnan(p->time) ? (isnan(p->periods) ? DEFAULT_PERIODS : p->periods) * run->period : mino_at(run, p->time);
        return KD_OK;
    }
    if (!isnan(p->periods) && !p->or_end && !run->orbit.circular)
        return kd_error_field(error, "/duration/periods",
                              "periods cannot be used with an orbit that will %s, because it has none; give a time, or "
                              "leave the duration out or add or_end to follow the orbit to its end",
                              kd_orbit_fate_name(run->orbit.fate));
    double h = 2 * M_PI / kd_orbit_pace(&run->orbit) / 128, before = NAN;
    bool found = false;
    for (int i = 0; i < HALVINGS; i++, h *= 0.5) {
        if (!find_end(run, h))
            continue;
        /* For a whirl the end is accurate enough if it changes by less than 1e-9. Steps are then tried up to this end,
         * beyond which is infinity */
        found = true;
        if (!(run->rounding > 1e-12) || fabs(run->mino_end - before) < 1e-9 * run->mino_end)
            return KD_OK;
        before = run->mino_end;
    }
    return found && isfinite(before) ? KD_OK : no_end(run, error);
}

/* Starts a run, without choosing its step. */
static enum kd_status begin(struct kd_orbit_run *run, struct kd_error *error)
{
    if (run->params->way == KD_WAY_CLOSED && !run->closed)
        return kd_error_field(error, "/method",
                              "method is \"closed\"; for an orbit that will %s it must be another, because \"closed\" "
                              "follows only bound orbits",
                              kd_orbit_fate_name(run->orbit.fate));
    enum kd_status status = set_end(run, error);
    kd_orbit_path_init(&run->path, &run->orbit, &run->start, kd_orbit_run_method(run));
    if (run->params->steps)
        run->h = (run->closed ? run->period : run->mino_end) / run->params->steps;
    return status;
}

/* Divides the path into equal steps of at most run->h, with a whole number of steps for each sample. */
static enum kd_status cut(struct kd_orbit_run *run, struct kd_error *error)
{
    double pieces = run->samples ? run->samples - 1 : 1,
           each = fmax(ceil(run->mino_end / run->h / pieces * (1 - 1e-12)), 1);
    if (run->params->way == KD_WAY_CLOSED)
        each = 1;
    if (!(each * pieces <= KD_ORBIT_STEPS_MAX))
        return kd_error_field(error, "/duration", "the duration takes %.3g steps; it must take at most %.0f",
                              each * pieces, KD_ORBIT_STEPS_MAX);
    run->steps = (uint64_t)(each * pieces);
    run->h = run->mino_end / (double)run->steps;
    return KD_OK;
}

/* Finds the end again with the steps that the run will use, because a whirl magnifies the error of the steps. */
static enum kd_status find_end_again(struct kd_orbit_run *run, struct kd_error *error)
{
    for (int i = 0; i < 6; i++) {
        double before = run->mino_end;
        enum kd_orbit_end end = run->end;
        if (!find_end(run, run->h)) {
            run->mino_end = before, run->end = end;
            if (run->params->steps)
                break;
            run->h *= 0.5;
            continue;
        }
        bool same = run->end == end && fabs(run->mino_end - before) < 0.25 * run->h;
        enum kd_status status = cut(run, error);
        if (status || same)
            return status;
    }
    return no_end(run, error);
}

static enum kd_status settle(struct kd_orbit_run *run, struct kd_error *error)
{
    enum kd_status status = cut(run, error);
    if (!status && !run->closed && !isnan(run->aim))
        status = find_end_again(run, error);
    if (run->rounding > 1e-12) /* smaller errors of rounding are negligible */
        run->error_estimate = fmax(run->error_estimate, run->rounding);
    if (run->start.w_rate == 0 && kd_orbit_radial_slope(&run->orbit, run->start.w) < 0 && !run->orbit.circular) {
        run->periastra = 1;
        run->first_phi = run->last_phi = 0;
    }
    double pace = sqrt(
        /* t grows as 1/w^2, so one step must not change w by a large part */
        fmax(kd_orbit_radial(&run->orbit, run->aim), 0));
    if (!status && run->rounding > 1e-12 && !run->params->steps && run->end == KD_END_FAR && run->h * pace > run->aim)
        return kd_error_field(error, "/r_max",
                              "r_max is %g; it must be smaller, because this path whirls near an unstable circular "
                              "orbit and needs short steps",
                              run->params->r_max);
    return status;
}

enum kd_status kd_orbit_run_prepare(struct kd_orbit_run *const *runs, size_t n, struct kd_error *error)
{
    struct kd_orbit_run *abreast[KD_ORBIT_LANES];
    int side = 0;
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < n && !status; i++) {
        bool tries = runs[i]->params->way != KD_WAY_CLOSED && !runs[i]->params->steps;
        status = begin(runs[i], error);
        if (!status && tries && n > 1 && kd_orbit_lanes_take(&runs[i]->path))
            abreast[side++] = runs[i];
        else if (!status && tries)
            kd_orbit_choose_steps(&runs[i], 1);
        if (side == KD_ORBIT_LANES || (side && i + 1 == n)) {
            kd_orbit_choose_steps(abreast, side);
            side = 0;
        }
    }
    for (size_t i = 0; i < n && !status; i++)
        status = settle(runs[i], error);
    return status;
}

static struct kd_orbit_sample sample_of(struct kd_orbit_run *run, struct kd_orbit_place place, double energy_error)
{
    struct kd_place_image image = { NAN, NAN, false, { NAN, NAN, NAN, NAN }, NAN, NAN, { NAN, NAN } };
    double a = run->orbit.hole.a, across = sqrt(place.r * place.r + a * a) * sin(place.theta);
    place.phi += run->phi;
    if (kd_orbit_is_seen(run->params)) {
        const double from = run->params->seen.azimuth_deg * (M_PI / 180);
        const bool searches = run->missed < SEARCHES || run->missed % SEARCH_EVERY == 0;
        const bool found =
            kd_place_image_seen(&run->view, place.r, cos(place.theta), place.phi - from, &run->image, searches, &image);
        run->missed = found ? 0 : run->missed + 1;
        if (found)
            run->image = image;
    }
    return (struct kd_orbit_sample) { .place = place,
                                      .x = across * cos(place.phi),
                                      .y = across * sin(place.phi),
                                      .z = place.r * cos(place.theta),
                                      .energy_error = energy_error,
                                      .image = image };
}

static void take_worst(struct kd_orbit_drift *worst, struct kd_orbit_drift now)
{
    worst->energy = fmax(worst->energy, fabs(now.energy));
    worst->carter = fmax(worst->carter, fabs(now.carter));
    worst->mass = fmax(worst->mass, fabs(now.mass)); /* fmax ignores NAN */
    worst->binet = isnan(now.binet) ? NAN : fmax(worst->binet, fabs(now.binet));
}

/* Records the azimuth of a periastron, where w has its maximum. */
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
        kd_pause_every(steps, 64);
        if (run->samples) {
            double mino = run->mino_end * ((double)run->sampled++ / (run->samples - 1));
            samples[n++] = sample_of(run, kd_orbit_bound_at(&run->bound, mino), NAN);
        }
        if (run->sampled > 1 || !run->samples)
            run->done++;
    }
    return n;
}

/* Takes the last step of an unbound path to its end. The end was found with another step size, and is less than half a
 * step away. */
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
        kd_pause_every(steps, 256);
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

bool kd_orbit_run_abreast(const struct kd_orbit_run *run)
{
    return run->params->way == KD_WAY_YOSHIDA6 && !run->samples && isnan(run->aim) && kd_orbit_lanes_take(&run->path);
}

static void note_periastron_of(void *user, int lane)
{
    struct kd_orbit_run *const *runs = user;
    note_periastron(runs[lane]);
}

void kd_orbit_run_advance_abreast(struct kd_orbit_run *const *runs, int n, uint64_t steps)
{
    struct kd_orbit_path idle[KD_ORBIT_LANES];
    struct kd_orbit_drift nothing = { 0 };
    struct kd_orbit_run *of_lane[KD_ORBIT_LANES] = { NULL };
    struct kd_orbit_lanes lanes = { .periastron = note_periastron_of, .user = of_lane };
    for (int i = 0; i < KD_ORBIT_LANES; i++) {
        if (i >= n) {
            idle[i] = runs[0]->path;
            lanes.path[i] = &idle[i], lanes.worst[i] = &nothing;
            continue;
        }
        uint64_t left = runs[i]->steps - runs[i]->done;
        of_lane[i] = runs[i];
        lanes.path[i] = &runs[i]->path, lanes.worst[i] = &runs[i]->worst, lanes.h[i] = runs[i]->h;
        lanes.steps[i] = left < steps ? left : steps;
        runs[i]->done += lanes.steps[i];
    }
    kd_orbit_lanes_run(&lanes);
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
