#include "physics/infall.h"

#include "physics/quadrature.h"

#include <math.h>

bool kd_infall_is_level(const struct kd_observer_motion *m, const struct kd_vantage *at)
{
    return at->spin == 0 || at->u == 0 || at->s == 0 || (m->fall_momentum == 0 && kd_observer_energy(m, at) == 1);
}

/* (Sigma r')^2 = c[4] r^4 + ... + c[0], in r; divided by fall_from - r where that is finite, since it vanishes there. */
struct fall {
    double c[5], spin, u, low, span, above; /* above: from the upper end to fall_from */
    bool from_rest;
};

static double pace(double x, double y, const void *user)
{
    const struct fall *f = user;
    double r = f->low + f->span * x, speed2 = 0;
    for (int i = f->from_rest ? 3 : 4; i >= 0; i--)
        speed2 = speed2 * r + f->c[i];
    if (f->from_rest)
        speed2 *= f->above + f->span * y;
    return f->span * (r * r + f->spin * f->spin * f->u * f->u) / sqrt(speed2);
}

double kd_infall_proper_time(const struct kd_observer_motion *m, const struct kd_vantage *at, double r)
{
    double a = at->spin, e = kd_observer_energy(m, at), l = m->fall_momentum, bound = (e - 1) * (e + 1);
    double ls = l == 0 ? 0 : l / at->s, q = at->u * at->u * (ls * ls - a * a * bound), rest = l - a * e;
    struct fall f = {
        .c = { -a * a * q, 2 * (q + rest * rest), a * a * bound - l * l - q, 2, bound },
        .spin = a, .u = at->u, .low = r, .span = at->r - r, .above = m->fall_from - at->r, .from_rest = isfinite(m->fall_from),
    };
    if (f.from_rest) /* from the lowest power on, of which the first vanish exactly without spin */
        for (int i = 0; i < 4; i++)
            f.c[i] = (f.c[i] + (i ? f.c[i - 1] : 0)) / m->fall_from;
    return f.span > 0 ? kd_quadrature(pace, &f) : 0;
}
