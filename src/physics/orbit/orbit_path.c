#include "physics/orbit/orbit_path.h"

#include "physics/spacetime/kerr.h"

#include <math.h>

/* Compensated addition (T. J. Dekker 1971, Numer. Math. 18, 224). */
static inline void add(struct kd_exact *to, double x)
{
    x += to->rest;
    double sum = to->value + x, part = sum - to->value;
    to->rest = (to->value - (sum - part)) + (x - part);
    to->value = sum;
}

/* Half of W'. If both ends of the range of w are known, W' is computed from the distances of w to these ends. So a
 * circular orbit, whose ends coincide, stays circular for ever. */
static double radial_force(const struct kd_orbit_path *p, double w, double rest)
{
    const struct kd_orbit *o = &p->orbit;
    if (!p->factored)
        return 0.5 * kd_orbit_radial_slope(o, w + rest);
    double left = (w - o->w_low) + rest, right = (o->w_high - w) - rest;
    double g = p->g[0] + w * (p->g[1] + w * p->g[2]), slope = p->g[1] + 2 * w * p->g[2];
    return 0.5 * ((right - left) * g + left * right * slope);
}

static double pull_of_spring(const struct kd_spring *s, double q, double rest)
{
    return s->strength * ((q - s->centre) + rest);
}

/* The derivatives of `rate` at a place. 0, 1: forces on w and y without those of the springs. 2 to 4: rates of proper
 * time, t and chi. rest: rounding error of w. */
static void pull(const struct kd_orbit_path *p, const double *q, double rest, double *f)
{
    const struct kd_orbit *o = &p->orbit;
    double a = o->hole.a, w = q[KD_PATH_W], y = q[KD_PATH_Y], w2 = w * w, a2w2 = a * a * w2, y2 = y * y;
    double flat = a * a * o->binding, up = a * a * o->z * y2, far = 1 / w2;
    f[KD_PATH_W] = radial_force(p, w, rest) + pull_of_spring(&p->spring[KD_PATH_W], w, rest);
    f[KD_PATH_Y] = y * (2 * flat * o->z * y2 + p->stiff);
    f[KD_PATH_PROPER] = far + up;
    double turn = p->twist != 0 ? p->twist * (1 - y2) / (1 - p->nu * y2) : 0;
    if (p->ingoing) { /* (P - sqrt R)/Delta, computed as (r^2 + K)/(P + sqrt R), with P = E(r^2 + a^2) - aL */
        double speed = sqrt(fmax(kd_orbit_radial(o, w), 0)), past = o->energy * (1 + a2w2) - a * o->momentum * w2;
        double slow = (1 + o->k * w2) / (past + speed);
        f[KD_PATH_T] = (1 + a2w2) * far * slow + a * o->momentum - a * a * o->energy + o->energy * up;
        f[KD_PATH_CHI] = turn + a * slow - a * o->energy;
        return;
    }
    double hole = 1 / kd_hole_delta_w(&o->hole, w); /* r^2/Delta */
    f[KD_PATH_CHI] = turn + a * (2 * o->energy * w - o->drag * w2) * hole;
    f[KD_PATH_T] =
        o->energy * (far + 2 * w * far + o->four + up) + (o->near * w - 4 * a2w2 * o->energy - o->nearer * w2) * hole;
}

/* The weights w3, w2, w1, w0 of Yoshida's solution A, to 25 digits. They were computed from his three equations by
 * Newton's method. */
const double kd_orbit_kicks[4] = { 0.7845136104775572638194976, 0.2355732133593581336847932,
                                   -1.177679984178871006946416, 1.31518632068391121888425 };

static int kick_of(int stage) { return stage < 4 ? stage : 6 - stage; }

/* Duration of the drift between two stages: half of one leapfrog plus half of the next. */
static double drift_of(int stage)
{
    if (stage == 0 || stage == 7)
        return 0.5 * kd_orbit_kicks[0];
    return 0.5 * (kd_orbit_kicks[kick_of(stage)] + kd_orbit_kicks[kick_of(stage - 1)]);
}

/* Computes the rotation of an oscillator during each drift, as three shears. Shears conserve the area for any rounding
 * of their coefficients, so errors do not accumulate. */
void kd_orbit_set_turns(struct kd_spring *s, double h)
{
    double omega = sqrt(s->strength);
    for (int i = 0; i < 4; i++) {
        double time = drift_of(i) * h;
        s->turn[i].kick = -omega * tan(0.5 * omega * time);
        s->turn[i].drift = omega > 0 ? sin(omega * time) / omega : time;
    }
}

/* Moves the path exactly as the springs alone move it, for one drift. */
static void drift(struct kd_orbit_path *p, int stage)
{
    for (int i = 0; i < KD_PATH_PLACES; i++) {
        const struct kd_spring *s = &p->spring[i];
        double kick = s->turn[stage < 4 ? stage : 7 - stage].kick;
        add(&p->rate[i], kick * (p->place[i].value - s->centre));
        add(&p->place[i], s->turn[stage < 4 ? stage : 7 - stage].drift * p->rate[i].value);
        add(&p->rate[i], kick * (p->place[i].value - s->centre));
    }
}

static void yoshida(struct kd_orbit_path *p, double h)
{
    if (h != p->turn_h)
        for (int i = 0; i < KD_PATH_PLACES; i++)
            kd_orbit_set_turns(&p->spring[i], h);
    p->turn_h = h;
    for (int stage = 0; stage < 7; stage++) {
        double q[KD_PATH_PLACES], f[KD_PATH_RATES];
        drift(p, stage);
        for (int i = 0; i < KD_PATH_PLACES; i++)
            q[i] = p->place[i].value;
        pull(p, q, p->place[KD_PATH_W].rest, f);
        for (int i = 0; i < KD_PATH_RATES; i++)
            add(&p->rate[i], kd_orbit_kicks[kick_of(stage)] * h * f[i]);
    }
    drift(p, 7);
}

/* The total force at the time `at` * h. The place is that to which the present rates lead by this time, displaced by
 * h^2 `sum`. */
static void stage_of(const struct kd_orbit_path *p, double at, double h, const double *sum, double *f)
{
    double q[KD_PATH_PLACES], rest = 0;
    for (int i = 0; i < KD_PATH_PLACES; i++) {
        struct kd_exact to = p->place[i];
        add(&to, at * h * p->rate[i].value + h * h * sum[i]);
        q[i] = to.value;
        if (i == KD_PATH_W)
            rest = to.rest;
    }
    pull(p, q, rest, f);
    f[KD_PATH_W] -= pull_of_spring(&p->spring[KD_PATH_W], q[KD_PATH_W], rest);
    f[KD_PATH_Y] -= pull_of_spring(&p->spring[KD_PATH_Y], q[KD_PATH_Y], 0);
}

static void albrecht(struct kd_orbit_path *p, double h)
{
    double k[5][KD_PATH_RATES], sum[KD_PATH_PLACES] = { 0 };
    stage_of(p, 0, h, sum, k[0]);
    for (int i = 0; i < KD_PATH_PLACES; i++)
        sum[i] = k[0][i] / 32;
    stage_of(p, 0.25, h, sum, k[1]);
    for (int i = 0; i < KD_PATH_PLACES; i++)
        sum[i] = (4 * k[1][i] - k[0][i]) / 24;
    stage_of(p, 0.5, h, sum, k[2]);
    for (int i = 0; i < KD_PATH_PLACES; i++)
        sum[i] = (3 * k[0][i] + 4 * k[1][i] + 2 * k[2][i]) / 32;
    stage_of(p, 0.75, h, sum, k[3]);
    for (int i = 0; i < KD_PATH_PLACES; i++)
        sum[i] = (6 * k[1][i] - k[2][i] + 2 * k[3][i]) / 14;
    stage_of(p, 1, h, sum, k[4]);
    for (int i = 0; i < KD_PATH_PLACES; i++)
        add(&p->place[i], h * p->rate[i].value + h * h * (7 * k[0][i] + 24 * k[1][i] + 6 * k[2][i] + 8 * k[3][i]) / 90);
    for (int i = 0; i < KD_PATH_RATES; i++)
        add(&p->rate[i], h * (7 * (k[0][i] + k[4][i]) + 32 * (k[1][i] + k[3][i]) + 12 * k[2][i]) / 90);
}

/* Ingoing time minus t, Int (r^2 + a^2)/Delta dr, and ingoing azimuth minus phi, Int a/Delta dr. */
static void ahead(const struct kd_orbit *o, double w, double *t, double *phi)
{
    double plus = o->hole.outer, minus = o->hole.inner, gap = plus - minus, r = 1 / w;
    double near = log(r - plus), inner = log(r - minus);
    if (kd_hole_is_close(&o->hole)) { /* computes the difference of the logarithms by log1p, which keeps its digits */
        const double apart = log1p(gap / (r - plus)) / gap;
        *t = r + 2 * near - kd_hole_mass(&o->hole, minus) * apart;
        *phi = -o->hole.a * apart;
        return;
    }
    *t = r + (kd_hole_mass(&o->hole, plus) * near - kd_hole_mass(&o->hole, minus) * inner) / gap;
    *phi = o->hole.a * (near - inner) / gap;
}

/* Changes to ingoing coordinates when the fall is final. The fall is final when there is no turning point further in,
 * and W is no longer small, so that sqrt(W) is smooth. */
static void enter(struct kd_orbit_path *p)
{
    const struct kd_orbit *o = &p->orbit;
    double w = p->place[KD_PATH_W].value, horizon = 1 / o->hole.outer;
    if (p->ingoing || o->fate != KD_ORBIT_PLUNGE || p->rate[KD_PATH_W].value <= 0 || w >= horizon)
        return;
    if (kd_orbit_radial(o, w) < 1e-3 * kd_orbit_radial(o, horizon))
        return;
    p->ingoing = true;
    ahead(o, w, &p->entry_t, &p->entry_phi);
}

/* N - a^2 b u^2, which gives y'^2 = (1 - y^2) steep. */
static double steep(const struct kd_orbit_path *p)
{
    const struct kd_orbit *o = &p->orbit;
    double y = p->place[KD_PATH_Y].value;
    return o->n - o->hole.a * o->hole.a * o->binding * o->z * y * y;
}

/* The part of the azimuth that changes fast next to the axis, for L > 0. */
static double swing(const struct kd_orbit_path *p)
{
    double turned = M_PI * p->half_turns;
    if (p->orbit.momentum == 0)
        return p->orbit.axis_gap == 0 ? turned : 0;
    return atan2(p->cc * p->place[KD_PATH_Y].value * steep(p), p->rate[KD_PATH_Y].value) + turned;
}

void kd_orbit_path_init(struct kd_orbit_path *p, const struct kd_orbit *o, const struct kd_orbit_state *start,
                        enum kd_orbit_method method)
{
    double flat = o->hole.a * o->hole.a * o->binding, sum = o->total + flat, root = sqrt(o->z), pull = -o->w[2];
    *p = (struct kd_orbit_path) { .orbit = *o, .method = method, .factored = o->turns_in && o->turns_out };
    if (p->factored)
        kd_orbit_factor(o, p->g);
    p->spring[KD_PATH_Y].strength = fmax(sum, 0);
    p->stiff = fmax(-sum, 0);
    if (!o->circular && 12 * o->k * o->w_high < pull)
        p->spring[KD_PATH_W] = (struct kd_spring) { .strength = pull, .centre = 1 / pull };
    p->cc = o->momentum != 0 ? fabs(o->momentum) / (o->n - flat) : 0;
    p->nu = -flat * p->cc * p->cc;
    p->twist = copysign(-flat * p->cc, -flat * o->momentum);
    p->place[KD_PATH_W].value = start->w;
    p->rate[KD_PATH_W].value = start->w_rate;
    p->place[KD_PATH_Y].value = o->z > 0 ? start->u / root : 0;
    p->rate[KD_PATH_Y].value = o->z > 0 ? start->u_rate / root : sqrt(fmax(o->n, 0));
    p->swing = swing(p);
    enter(p);
}

/* Counts the half turns that atan2 does not include. If Q >= 0, the azimuth grows steadily, and atan2 jumps at pi,
 * where y becomes negative. If Q < 0, atan2 jumps back by pi at a turning point next to the equator. If L = 0, the body
 * passes the axis where y turns. */
static void count(struct kd_orbit_path *p, double y, double rate, int way)
{
    double y_now = p->place[KD_PATH_Y].value, rate_now = p->rate[KD_PATH_Y].value;
    if (p->orbit.momentum == 0)
        p->half_turns += ((rate < 0) != (rate_now < 0)) * way;
    else if (p->orbit.carter < 0)
        p->half_turns += way > 0 ? rate < 0 && rate_now >= 0 : -(rate >= 0 && rate_now < 0);
    else if (way > 0)
        p->half_turns += 2 * (y >= 0 && y_now < 0);
    else
        p->half_turns -= 2 * (y < 0 && y_now >= 0 && rate_now < 0);
}

void kd_orbit_path_step(struct kd_orbit_path *p, double h)
{
    double y = p->place[KD_PATH_Y].value, rate = p->rate[KD_PATH_Y].value;
    (p->method == KD_ORBIT_YOSHIDA6 ? yoshida : albrecht)(p, h);
    add(&p->mino, h);
    count(p, y, rate, h < 0 ? -1 : 1);
    enter(p);
}

struct kd_orbit_place kd_orbit_path_place(const struct kd_orbit_path *p)
{
    const struct kd_orbit *o = &p->orbit;
    double w = p->place[KD_PATH_W].value, y = p->place[KD_PATH_Y].value, turned = swing(p) - p->swing;
    struct kd_orbit_place at = {
        .mino = p->mino.value,
        .proper = p->rate[KD_PATH_PROPER].value,
        .t = p->rate[KD_PATH_T].value,
        .r = 1 / w,
        .theta = atan2(sqrt(o->axis_gap + o->z * fmax((1 - y) * (1 + y), 0)), sqrt(o->z) * y),
        .phi = (o->momentum < 0 ? -turned : turned) + p->rate[KD_PATH_CHI].value,
    };
    if (p->ingoing) {
        double t = NAN, phi = NAN;
        if (at.r > o->hole.outer * (1 + 1e-14))
            ahead(o, w, &t, &phi);
        at.t -= t - p->entry_t;
        at.phi -= phi - p->entry_phi;
    }
    return at;
}

struct kd_orbit_drift kd_orbit_path_drift(const struct kd_orbit_path *p)
{
    const struct kd_orbit *o = &p->orbit;
    double a2 = o->hole.a * o->hole.a, w = p->place[KD_PATH_W].value, rate = p->rate[KD_PATH_W].value;
    double y = p->place[KD_PATH_Y].value, y_rate = p->rate[KD_PATH_Y].value, u2 = o->z * y * y;
    double radial = rate * rate - kd_orbit_radial(o, w);
    double polar = o->z * (y_rate * y_rate - (1 - y) * (1 + y) * steep(p)),
           sine2 = o->axis_gap + o->z * (1 - y) * (1 + y);
    struct kd_orbit_drift d = {
        .energy = radial / (kd_orbit_radial_by_energy(o, w) * o->energy),
        .carter = o->total > 0 ? polar / o->total : 0,
        .mass = NAN,
        .binet = a2 == 0 ? radial : NAN,
    };
    /* residual of mass^2 Sigma = (P^2 - r'^2)/Delta - u'^2/sin^2 theta - ...: the residuals of w and of u, each
     * weighted as its term in this equation */
    if (w * o->hole.outer < 0.99 && sine2 > 0.01)
        d.mass = -(radial / (w * w * kd_hole_delta_w(&o->hole, w)) + polar / sine2) / (1 / (w * w) + a2 * u2);
    return d;
}

static struct kd_orbit_path moved(const struct kd_orbit_path *path, double h)
{
    struct kd_orbit_path to = *path;
    kd_orbit_path_step(&to, h);
    return to;
}

/* Kinds of events on a path. An event is a zero of height(). */
enum event { APSIS, RADIUS, TIME };

static double height(const struct kd_orbit_path *p, enum event event, double aim)
{
    switch (event) {
    case APSIS: return p->rate[KD_PATH_W].value;
    case RADIUS: return (p->place[KD_PATH_W].value - aim) + p->place[KD_PATH_W].rest;
    case TIME: break;
    }
    double t = kd_orbit_path_place(p).t;
    return isnan(t) ? INFINITY : t - aim;
}

/* Finds an event within a step by regula falsi with the Illinois modification, until rounding stops it. */
static struct kd_orbit_path to_event(const struct kd_orbit_path *path, double h, enum event event, double aim)
{
    struct kd_orbit_path best = moved(path, h);
    double low = 0, high = h, f_low = height(path, event, aim), f_high = height(&best, event, aim);
    for (int i = 0; i < 100 && f_low != f_high; i++) {
        double at = isfinite(f_high) ? high - f_high * (high - low) / (f_high - f_low) : 0.5 * (low + high);
        if (!(at > fmin(low, high) && at < fmax(low, high)) || fabs(high - low) < 1e-15 * fabs(h)) {
            if (at == low) /* the event is at `low`, which may be the start of the step */
                best = low == 0 ? *path : moved(path, low);
            break;
        }
        best = moved(path, at);
        double f = height(&best, event, aim);
        if (f == 0)
            break;
        if ((f < 0) == (f_high < 0)) {
            f_low *= isfinite(f_high) ? 0.5 : 1;
        } else {
            low = high, f_low = f_high;
        }
        high = at, f_high = f;
    }
    return best;
}

struct kd_orbit_path kd_orbit_path_to_apsis(const struct kd_orbit_path *path, double h)
{
    return to_event(path, h, APSIS, 0);
}

struct kd_orbit_path kd_orbit_path_to_radius(const struct kd_orbit_path *path, double h, double w)
{
    struct kd_orbit_path end = moved(path, h);
    bool beyond = (height(path, RADIUS, w) < 0) != (height(&end, RADIUS, w) < 0);
    if (!beyond && (path->rate[KD_PATH_W].value < 0) != (end.rate[KD_PATH_W].value < 0))
        /* for E = 1, infinity counts as a turning point */
        h = kd_orbit_path_to_apsis(path, h).mino.value - path->mino.value;
    return to_event(path, h, RADIUS, w);
}

struct kd_orbit_path kd_orbit_path_to_time(const struct kd_orbit_path *path, double h, double t)
{
    return to_event(path, h, TIME, t);
}
