#include "playground/geodesic.h"

#include "playground/body.h"

#include "physics/spacetime/kerr.h"

#include <math.h>
#include <string.h>

#define STEPS_A_TURN \
    256 /* steps in a radian of the fastest phase: an error of 1e-8 in position after a hundred orbits \
           (tests/unit/playground_kerr.c) */

/* The fastest phase velocity of the motion per Mino time. It follows from the slopes of both forces and, on unbound
 * motion, from the rate of w. */
static double pace(const struct kd_orbit *o)
{
    const double w[3] = { o->w_low, 0.5 * (o->w_low + o->w_high), o->w_high };
    double fastest = fmax(o->total + o->hole.a * o->hole.a * o->binding, o->total);
    for (int i = 0; i < 3; i++) {
        fastest = fmax(fastest, fabs(o->w[2] + w[i] * (3 * o->w[3] + w[i] * 6 * o->w[4])));
        fastest = fmax(fastest, kd_orbit_radial(o, w[i]) / (o->w_high * o->w_high));
    }
    return sqrt(fastest);
}

enum kd_status kd_geodesic_begin(struct kd_playground_geodesic *g, const struct kd_hole *hole, const double x[3],
                                 const double v[3], double t, struct kd_error *error)
{
    const struct kd_playground_spherical at = kd_playground_spherical(x, v);
    struct kd_orbit orbit;
    struct kd_orbit_state start;
    enum kd_status status =
        kd_orbit_from_state(hole, at.r, at.theta * 180 / M_PI, KD_OBSERVER_ZAMO, at.v, &orbit, &start, error);
    if (status) {
        if (error && strncmp(error->pointer, "/velocity", 9))
            strcpy(error->pointer, "/position");
        return status;
    }
    *g = (struct kd_playground_geodesic) { .from_t = t, .phi = at.phi, .h = 2 * M_PI / pace(&orbit) / STEPS_A_TURN };
    memcpy(g->from_x, x, sizeof g->from_x);
    memcpy(g->from_v, v, sizeof g->from_v);
    kd_orbit_path_init(&g->path, &orbit, &start, KD_ORBIT_YOSHIDA6);
    g->begun = g->path;
    return KD_OK;
}

/* Sets position and velocity from E, L and the rates in Mino time. With S = Sigma, D = Delta and gamma = (E - omega
 * L)/alpha, the observer of zero angular momentum measures v_r = r' (S/D)^(1/2)/(S gamma), v_theta = theta' S^(1/2)/(S
 * gamma) and v_phi = L/(g_phiphi^(1/2) gamma), where r' = dr/dlambda. */
static void tell(const struct kd_playground_geodesic *g, const struct kd_orbit_path *path, double x[3], double v[3])
{
    const struct kd_orbit *o = &path->orbit;
    const struct kd_orbit_place at = kd_orbit_path_place(path);
    const double r = at.r, c = cos(at.theta), s = sin(at.theta), phi = g->phi + at.phi;
    const struct kd_metric_scalars m = kd_metric_at(&o->hole, r, c);
    const double gamma = (o->energy - m.omega * o->momentum) / sqrt(m.lapse2);
    const double r_rate = -path->rate[KD_PATH_W].value * r * r, u_rate = sqrt(o->z) * path->rate[KD_PATH_Y].value;
    const double v_r = r_rate / (sqrt(m.sigma * m.delta) * gamma),
                 v_theta = s > 0 ? -u_rate / s / (sqrt(m.sigma) * gamma) : 0;
    const double v_phi = s > 0 ? o->momentum / (sqrt(m.area / m.sigma) * s * gamma) : 0;
    const double n[3][3] = { { s * cos(phi), s * sin(phi), c },
                             { c * cos(phi), c * sin(phi), -s },
                             { -sin(phi), cos(phi), 0 } };
    for (int k = 0; k < 3; k++) {
        x[k] = r * n[0][k];
        v[k] = v_r * n[0][k] + v_theta * n[1][k] + v_phi * n[2][k];
    }
}

static enum kd_geodesic_fate fate_at(const struct kd_playground_geodesic *g, double r)
{
    return !(r > KD_GEODESIC_NEAR * g->path.orbit.hole.outer) ? KD_GEODESIC_CAPTURED
           : !(r < KD_GEODESIC_FAR)                           ? KD_GEODESIC_AWAY
                                                              : KD_GEODESIC_GOES;
}

bool kd_geodesic_approach(struct kd_playground_geodesic *g, double t, uint32_t *steps)
{
    for (;; (*steps)--) {
        if (fate_at(g, kd_orbit_path_place(&g->path).r) != KD_GEODESIC_GOES)
            return true;
        struct kd_orbit_path next = g->path;
        kd_orbit_path_step(&next, g->h);
        const double then = kd_orbit_path_place(&next).t;
        if (isnan(then) || !(next.place[KD_PATH_W].value > 0) ||
            g->from_t + then > t) /* true if the step would pass the horizon, infinity or t */
            return true;
        if (!*steps)
            return false;
        g->path = next;
    }
}

void kd_geodesic_back(struct kd_playground_geodesic *g) { g->path = g->begun; }

/* Number of steps per coordinate time, from dt/dlambda = A (E - omega L)/Delta. */
double kd_geodesic_pace(const struct kd_playground_geodesic *g)
{
    const struct kd_orbit *o = &g->path.orbit;
    const struct kd_orbit_place at = kd_orbit_path_place(&g->path);
    const struct kd_metric_scalars m = kd_metric_at(&o->hole, at.r, cos(at.theta));
    return m.delta / (g->h * m.area * (o->energy - m.omega * o->momentum));
}

enum kd_geodesic_fate kd_geodesic_at(struct kd_playground_geodesic *g, double t, double x[3], double v[3])
{
    const enum kd_geodesic_fate fate = fate_at(g, kd_orbit_path_place(&g->path).r);
    if (fate != KD_GEODESIC_GOES)
        return fate;
    const struct kd_orbit_path now = kd_orbit_path_to_time(&g->path, g->h, t - g->from_t);
    const double r = kd_orbit_path_place(&now).r;
    if (fate_at(g, r) == KD_GEODESIC_GOES) {
        tell(g, &now, x, v);
        g->begun = g->path;
        return KD_GEODESIC_GOES;
    }
    struct kd_orbit_path next = g->path;
    kd_orbit_path_step(&next, g->h);
    return fate_at(g, r) == KD_GEODESIC_CAPTURED && next.place[KD_PATH_W].value > 0 ? KD_GEODESIC_CAPTURED
                                                                                    : KD_GEODESIC_AWAY;
}

void kd_geodesic_save(const struct kd_playground_geodesic *g, double state[KD_GEODESIC_STATE])
{
    const struct kd_orbit_path *p = &g->begun;
    int n = 0;
    state[n++] = p->ingoing;
    state[n++] = p->entry_t;
    state[n++] = p->entry_phi;
    state[n++] = p->half_turns;
    state[n++] = p->mino.value;
    state[n++] = p->mino.rest;
    for (int i = 0; i < KD_PATH_PLACES; i++) {
        state[n++] = p->place[i].value;
        state[n++] = p->place[i].rest;
    }
    for (int i = 0; i < KD_PATH_RATES; i++) {
        state[n++] = p->rate[i].value;
        state[n++] = p->rate[i].rest;
    }
}

void kd_geodesic_restore(struct kd_playground_geodesic *g, const double state[KD_GEODESIC_STATE])
{
    struct kd_orbit_path *p = &g->path;
    int n = 0;
    p->ingoing = state[n++] != 0;
    p->entry_t = state[n++];
    p->entry_phi = state[n++];
    p->half_turns = (int)fmin(fmax(state[n++], -1e9), 1e9);
    p->mino.value = state[n++];
    p->mino.rest = state[n++];
    for (int i = 0; i < KD_PATH_PLACES; i++) {
        p->place[i].value = state[n++];
        p->place[i].rest = state[n++];
    }
    for (int i = 0; i < KD_PATH_RATES; i++) {
        p->rate[i].value = state[n++];
        p->rate[i].rest = state[n++];
    }
    g->begun = g->path;
}
_Static_assert(KD_GEODESIC_STATE == 6 + 2 * (KD_PATH_PLACES + KD_PATH_RATES), "as many numbers as are kept");
