#include "physics/orbit/orbit_lanes.h"

#include "base/pause.h"
#include "physics/spacetime/kerr.h"

#include <math.h>
#include <string.h>

typedef double lane __attribute__((vector_size(8 * KD_ORBIT_LANES)));
typedef int64_t mask __attribute__((vector_size(8 * KD_ORBIT_LANES)));

/* Compiles a function for several vector widths. When the program is loaded, the version with the processor's widest
 * vectors is selected. */
#if defined(__x86_64__) && defined(__has_attribute)
#if __has_attribute(target_clones) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define WIDEST __attribute__((target_clones("avx512f", "avx2", "default")))
#endif
#endif
#ifndef WIDEST
#define WIDEST
#endif
#define INLINE inline __attribute__((always_inline))

enum { PIECE = 4096 }; /* number of steps between two preemption points */

struct exact { lane value, rest; };

struct spring { lane strength, centre, kick[4], drift[4]; };

struct state {
    lane a, a2, root, energy, momentum, binding, z, n, axis_gap, total, w_low, w_high, g[3], c[5], horizon;
    lane drag, four, near, nearer, twist, nu, stiff, mass[2], h; /* mass: coefficients of kd_hole_mass_line */
    struct spring spring[KD_PATH_PLACES];
    struct exact place[KD_PATH_PLACES], rate[KD_PATH_RATES], mino;
    mask half_turns;
    lane worst_energy, worst_carter, worst_mass, worst_binet;
};

static INLINE void add(struct exact *to, const lane *by)
{
    lane x = *by + to->rest, sum = to->value + x, part = sum - to->value;
    to->rest = (to->value - (sum - part)) + (x - part);
    to->value = sum;
}

static INLINE void keep_greater(lane *greatest, const lane *x, const mask *where)
{
    /* removes the sign: non-negative doubles have the same order as their bits as integers */
    mask size = (mask)*x & INT64_MAX & *where;
    mask greater = size > (mask)*greatest;
    *greatest = (lane)((size & greater) | ((mask)*greatest & ~greater));
}

/* Computes the same sums as orbit_path.c, in the same order. */
static INLINE void radial_force(const struct state *s, const lane *w, const lane *rest, lane *force)
{
    lane left = (*w - s->w_low) + *rest, right = (s->w_high - *w) - *rest;
    lane g = s->g[0] + *w * (s->g[1] + *w * s->g[2]), slope = s->g[1] + 2 * *w * s->g[2];
    *force = 0.5 * ((right - left) * g + left * right * slope);
}

static INLINE void kick(struct state *s, double weight)
{
    lane w = s->place[KD_PATH_W].value, y = s->place[KD_PATH_Y].value, rest = s->place[KD_PATH_W].rest,
         f[KD_PATH_RATES];
    lane w2 = w * w, a2w2 = s->a * s->a * w2, y2 = y * y, flat = s->a * s->a * s->binding, up = s->a * s->a * s->z * y2,
         far = 1 / w2;
    radial_force(s, &w, &rest, &f[KD_PATH_W]);
    f[KD_PATH_W] += s->spring[KD_PATH_W].strength * ((w - s->spring[KD_PATH_W].centre) + rest);
    f[KD_PATH_Y] = y * (2 * flat * s->z * y2 + s->stiff);
    f[KD_PATH_PROPER] = far + up;
    lane turn = s->twist * (1 - y2) / (1 - s->nu * y2), hole = 1 / KD_HOLE_DELTA_W(s->root, w);
    f[KD_PATH_CHI] = turn + s->a * (2 * s->energy * w - s->drag * w2) * hole;
    f[KD_PATH_T] =
        s->energy * (far + 2 * w * far + s->four + up) + (s->near * w - 4 * a2w2 * s->energy - s->nearer * w2) * hole;
    for (int i = 0; i < KD_PATH_RATES; i++) {
        lane move = weight * s->h * f[i];
        add(&s->rate[i], &move);
    }
}

static INLINE void drift(struct state *s, int which)
{
    for (int i = 0; i < KD_PATH_PLACES; i++) {
        const struct spring *spring = &s->spring[i];
        lane pull = spring->kick[which] * (s->place[i].value - spring->centre);
        add(&s->rate[i], &pull);
        lane move = spring->drift[which] * s->rate[i].value;
        add(&s->place[i], &move);
        pull = spring->kick[which] * (s->place[i].value - spring->centre);
        add(&s->rate[i], &pull);
    }
}

static INLINE void look(struct state *s)
{
    lane w = s->place[KD_PATH_W].value, v = s->rate[KD_PATH_W].value, y = s->place[KD_PATH_Y].value,
         u = s->rate[KD_PATH_Y].value;
    lane radial = v * v - (s->c[0] + w * (s->c[1] + w * (s->c[2] + w * (s->c[3] + w * s->c[4]))));
    lane by_energy = 2 * s->energy * (1 + s->a2 * w * w) -
                     2 * (s->mass[0] + s->mass[1] * w) * s->a * (s->momentum - s->a * s->energy) * w * w * w;
    lane steep = s->n - s->a2 * s->binding * s->z * y * y, polar = s->z * (u * u - (1 - y) * (1 + y) * steep);
    lane sine2 = s->axis_gap + s->z * (1 - y) * (1 + y), u2 = s->z * y * y;
    lane energy = radial / (by_energy * s->energy), carter = polar / s->total;
    lane delta = KD_HOLE_DELTA_W(s->root, w);
    lane mass = (radial / (w * w * delta) + polar / sine2) / (1 / (w * w) + s->a2 * u2);
    mask all = { -1, -1, -1, -1, -1, -1, -1, -1 }, regular = (w * s->horizon < 0.99) & (sine2 > 0.01);
    keep_greater(&s->worst_energy, &energy, &all);
    keep_greater(&s->worst_carter, &carter, &all);
    keep_greater(&s->worst_mass, &mass, &regular);
    keep_greater(&s->worst_binet, &radial, &all);
}

/* Takes up to `steps` steps of all lanes, and returns the number of steps left. It stops early, and sets *turned, after
 * a step in which w stopped growing in some lane. */
WIDEST static uint64_t go(struct state *s, uint64_t steps, bool looks, bool stops, mask *turned)
{
    const mask none = { 0 };
    *turned = none;
    while (steps > 0) {
        lane y = s->place[KD_PATH_Y].value, rate = s->rate[KD_PATH_W].value;
        for (int stage = 0; stage < 7; stage++) {
            drift(s, stage < 4 ? stage : 7 - stage);
            kick(s, kd_orbit_kicks[stage < 4 ? stage : 6 - stage]);
        }
        drift(s, 0);
        add(&s->mino, &s->h);
        s->half_turns -= 2 * ((y >= 0) & (s->place[KD_PATH_Y].value < 0));
        if (looks)
            look(s);
        steps--;
        if (stops) {
            *turned = (rate > 0) & (s->rate[KD_PATH_W].value <= 0);
            int64_t any = 0;
            for (int i = 0; i < KD_ORBIT_LANES; i++)
                any |= (*turned)[i];
            if (any)
                break;
        }
    }
    return steps;
}

static void put_exact(struct exact *to, int i, struct kd_exact from)
{
    to->value[i] = from.value, to->rest[i] = from.rest;
}

static struct kd_exact get_exact(const struct exact *from, int i)
{
    return (struct kd_exact) { from->value[i], from->rest[i] };
}

/* Loads a path into a lane. A lane with h = 0 does not move. */
static void load(struct state *s, int i, const struct kd_orbit_path *p, double h)
{
    const struct kd_orbit *o = &p->orbit;
    s->a[i] = o->hole.a, s->a2[i] = o->hole.a * o->hole.a, s->root[i] = o->hole.root, s->energy[i] = o->energy,
    s->momentum[i] = o->momentum, s->binding[i] = o->binding;
    s->drag[i] = o->drag, s->four[i] = o->four, s->near[i] = o->near, s->nearer[i] = o->nearer;
    s->z[i] = o->z, s->n[i] = o->n, s->axis_gap[i] = o->axis_gap, s->total[i] = o->total;
    s->w_low[i] = o->w_low, s->w_high[i] = o->w_high, s->horizon[i] = o->hole.outer;
    double mass[2];
    kd_hole_mass_line(&o->hole, mass);
    for (int k = 0; k < 2; k++)
        s->mass[k][i] = mass[k];
    for (int k = 0; k < 3; k++)
        s->g[k][i] = p->g[k];
    for (int k = 0; k < 5; k++)
        s->c[k][i] = o->w[k];
    s->twist[i] = p->twist, s->nu[i] = p->nu, s->stiff[i] = p->stiff, s->h[i] = h;
    for (int k = 0; k < KD_PATH_PLACES; k++) {
        struct kd_spring spring = p->spring[k];
        kd_orbit_set_turns(&spring, h);
        s->spring[k].strength[i] = spring.strength, s->spring[k].centre[i] = spring.centre;
        for (int j = 0; j < 4; j++)
            s->spring[k].kick[j][i] = spring.turn[j].kick, s->spring[k].drift[j][i] = spring.turn[j].drift;
        put_exact(&s->place[k], i, p->place[k]);
    }
    for (int k = 0; k < KD_PATH_RATES; k++)
        put_exact(&s->rate[k], i, p->rate[k]);
    put_exact(&s->mino, i, p->mino);
    s->half_turns[i] = p->half_turns;
}

static void store(const struct state *s, int i, struct kd_orbit_path *p)
{
    for (int k = 0; k < KD_PATH_PLACES; k++)
        p->place[k] = get_exact(&s->place[k], i);
    for (int k = 0; k < KD_PATH_RATES; k++)
        p->rate[k] = get_exact(&s->rate[k], i);
    p->mino = get_exact(&s->mino, i);
    p->half_turns = (int)s->half_turns[i];
}

bool kd_orbit_lanes_take(const struct kd_orbit_path *p)
{
    return p->method == KD_ORBIT_YOSHIDA6 && p->orbit.fate == KD_ORBIT_BOUND && p->factored && p->orbit.momentum != 0;
}

static void note_worst(const struct kd_orbit_lanes *lanes, const struct state *s)
{
    for (int i = 0; i < KD_ORBIT_LANES; i++) {
        struct kd_orbit_drift *worst = lanes->worst[i];
        if (!worst || !lanes->steps[i])
            continue;
        worst->energy = fmax(worst->energy, s->worst_energy[i]);
        worst->carter = fmax(worst->carter, s->worst_carter[i]);
        worst->mass = fmax(worst->mass, s->worst_mass[i]);
        worst->binet = s->a[i] == 0 ? fmax(worst->binet, s->worst_binet[i]) : NAN;
    }
}

void kd_orbit_lanes_run(struct kd_orbit_lanes *lanes)
{
    struct state s;
    uint64_t left[KD_ORBIT_LANES], most = 0;
    memset(&s, 0, sizeof s);
    for (int i = 0; i < KD_ORBIT_LANES; i++) {
        left[i] = lanes->steps[i];
        load(&s, i, lanes->path[i], left[i] ? lanes->h[i] : 0);
        most = left[i] > most ? left[i] : most;
    }
    while (most > 0) {
        uint64_t steps = most;
        mask turned;
        for (int i = 0; i < KD_ORBIT_LANES; i++)
            steps = left[i] && left[i] < steps ? left[i] : steps;
        steps = steps < PIECE ? steps : PIECE;
        kd_pause();
        uint64_t gone = steps - go(&s, steps, lanes->worst[0] != NULL, lanes->periastron != NULL, &turned);
        most = 0;
        for (int i = 0; i < KD_ORBIT_LANES; i++) {
            if (!left[i])
                continue;
            left[i] -= gone;
            most = left[i] > most ? left[i] : most;
            if (turned[i] || !left[i])
                store(&s, i, lanes->path[i]);
            if (turned[i] && lanes->periastron)
                lanes->periastron(lanes->user, i);
            if (!left[i])
                load(&s, i, lanes->path[i], 0);
        }
    }
    note_worst(lanes, &s);
}
