/* Sums over the bodies: mass, energy, momentum, gravitational-wave strain. */
#include "playground/hole.h"
#include "playground/playground.h"
#include "playground/wave.h"

#include <math.h>

static void add_body(struct kd_playground_totals *sum, const struct kd_playground_body *body, const double a[3])
{
    const double m = body->mass, *x = body->x, *v = body->v;
    sum->mass += m;
    sum->kinetic += 0.5 * m * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    sum->potential += m * kd_playground_potential(kd_playground_radius(x));
    for (int k = 0; k < 3; k++) {
        const int l = (k + 1) % 3, n = (k + 2) % 3;
        sum->momentum[k] += m * v[k];
        sum->angular[k] += m * (x[l] * v[n] - x[n] * v[l]);
    }
    /* The strain is h+ = I''_xx - I''_yy and hx = 2 I''_xy, with I''_ij = sum of m (2 v_i v_j + x_i a_j + a_i x_j) (M.
     * Maggiore 2008, eq. 3.72). */
    sum->h_plus += 2 * m * (v[0] * v[0] - v[1] * v[1] + x[0] * a[0] - x[1] * a[1]);
    sum->h_cross += 2 * m * (2 * v[0] * v[1] + x[0] * a[1] + x[1] * a[0]);
}

/* Sets the distance of a pair, and the frequency of its waves, which is twice the orbital frequency: |x v'|/(pi d^2).
 */
static void pair(struct kd_playground_totals *sum, const double x[3], const double v[3])
{
    const double c[3] = { x[1] * v[2] - x[2] * v[1], x[2] * v[0] - x[0] * v[2], x[0] * v[1] - x[1] * v[0] },
                 d = kd_playground_radius(x);
    sum->separation = d;
    sum->wave_frequency = kd_playground_radius(c) / (M_PI * d * d);
}

static void closest(const struct kd_playground *p, struct kd_playground_totals *sum)
{
    size_t partners[KD_WAVE_PAIRS_MAX];
    double least = INFINITY;
    const bool pairs = p->n <= KD_WAVE_PAIRS_MAX && p->params.gravity != KD_GRAVITY_KERR;
    sum->separation = sum->wave_frequency = NAN;
    if (pairs)
        kd_wave_partners(p->bodies, p->n, p->params.softening, partners);
    for (size_t i = 0; pairs && i < p->n; i++) {
        double x[3], v[3];
        for (int k = 0; partners[i] < p->n && k < 3; k++) {
            x[k] = p->bodies[i].x[k] - p->bodies[partners[i]].x[k];
            v[k] = p->bodies[i].v[k] - p->bodies[partners[i]].v[k];
        }
        if (partners[i] < p->n && kd_playground_radius(x) < least) {
            least = kd_playground_radius(x);
            pair(sum, x, v);
        }
    }
    for (size_t i = 0; isinf(least) && i < p->n; i++)
        if (isnan(sum->separation) || kd_playground_radius(p->bodies[i].x) < sum->separation)
            pair(sum, p->bodies[i].x, p->bodies[i].v);
}

struct kd_playground_totals kd_playground_totals(struct kd_playground *p)
{
    struct kd_playground_totals sum = { 0 };
    if (p->params.gravity == KD_GRAVITY_KERR) {
        for (size_t i = 0; i < p->n; i++) {
            sum.mass += p->bodies[i].mass;
            sum.energy += p->bodies[i].mass * p->geodesics[i].path.orbit.energy;
            sum.angular[2] += p->bodies[i].mass * p->geodesics[i].path.orbit.momentum;
        }
    } else {
        kd_playground_force(p);
        for (size_t i = 0; i < p->n; i++) {
            const struct kd_playground_body *body = &p->bodies[i];
            const double pull = kd_playground_pull(kd_playground_radius(body->x));
            add_body(&sum, body,
                     (const double[3]) { p->mutual.ax[i] + pull * body->x[0], p->mutual.ay[i] + pull * body->x[1],
                                         p->mutual.az[i] + pull * body->x[2] });
            sum.mutual += 0.5 * body->mass * p->mutual.potential[i];
        }
        sum.energy = sum.kinetic + sum.potential + sum.mutual;
    }
    closest(p, &sum);
    return sum;
}
