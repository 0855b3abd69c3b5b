#include "physics/null/ring_view.h"

#include "physics/null/null_geodesic.h"
#include "physics/null/null_plane.h"
#include "physics/spacetime/kerr.h"

#include <math.h>

struct kd_ring_view kd_ring_view_of(const struct kd_observer_motion *motion, const struct kd_vantage *at, double r,
                                    int order)
{
    const struct kd_observer_motion rain = kd_observer_motion_of(KD_OBSERVER_INFALL);
    return (struct kd_ring_view) { kd_observer_tetrad(&rain, at), kd_observer_tetrad(motion, at), r, order };
}

/* Components, in the rain frame, of the photon that is seen in the direction chi at the angle rho with tan(rho/2) =
 * e^h. */
static void photon_at(const struct kd_ring_view *view, double chi, double h, double x[4])
{
    const double right = cos(chi), up = fabs(view->rain.at.u) * sin(chi),
                 /* off: sin(rho), which is 1/cosh(h), divided by the length of (right, up) */
        off = 1 / (cosh(h) * hypot(right, up));
    x[0] = 1, x[1] = -tanh(h), x[2] = off * up, x[3] = -off * right;
}

/* ln(r_n/r), with r_n the radius of crossing n; -INFINITY if the ray is captured before that crossing, INFINITY if it
 * escapes before it. */
static double mismatch(const struct kd_ring_view *view, double chi, double h)
{
    double x[4];
    photon_at(view, chi, h, x);
    const struct kd_covector photon = kd_tetrad_covector(&view->rain, x);
    const double r = kd_null_plane_radius(&view->rain.at, &photon, view->order);
    return r > 0 ? log(r / view->radius) : -INFINITY;
}

/* Solves ln r_n = ln r along chi. From a guess it expands a range until the sign changes, bisects until both ends have
 * a crossing, and then uses the Illinois method. */
static bool solve(const struct kd_ring_view *view, double chi, double *h, double *residual)
{
    double at = log(view->radius / view->rain.at.r), f = mismatch(view, chi, at), other = at, g = f, miss = INFINITY;
    for (double step = 0.25; (f < 0) == (g < 0) && step < 100; step *= 2) {
        at = other, f = g;
        other += f < 0 ? step : -step;
        g = mismatch(view, chi, other);
    }
    for (int i = 0, side = 0; i < 200 && fabs(other - at) > 1e-16 * (1 + fabs(at)) && fabs(miss) > 1e-12; i++) {
        const bool linear = isfinite(f) && isfinite(g);
        *h = linear ? (at * g - other * f) / (g - f) : 0.5 * (at + other);
        miss = mismatch(view, chi, *h);
        const bool here = (miss < 0) == (f < 0);
        *(here ? &at : &other) = *h;
        *(here ? &f : &g) = miss;
        if (linear && side == (here ? 1 : 2))
            *(here ? &g : &f) *= 0.5;
        side = here ? 1 : 2;
    }
    *residual = miss;
    return fabs(miss) < 1e-6;
}

/* Sets phi and delay of a point, from the closed form. */
static void add_place(const struct kd_ring_view *view, const struct kd_covector *photon, struct kd_ring_view_point *out)
{
    const struct kd_vantage *at = &view->rain.at;
    out->phi = out->delay = NAN;
    if (!(photon->energy > 0) || !(at->r > at->hole.outer))
        return;
    const struct kd_null_ray ray = { .hole = at->hole,
                                     .radius = at->r,
                                     .cos_theta = at->u,
                                     .sin_theta = at->s,
                                     .alpha = out->alpha,
                                     .beta = out->beta,
                                     .outward = photon->radial < 0,
                                     .orders = view->order + 1 };
    const struct kd_null_path path = kd_null_trace_fast(&ray);
    if (path.crossings > view->order) {
        out->phi = path.crossing[view->order].phi;
        out->delay = path.crossing[view->order].delay;
    }
}

bool kd_ring_view_seen(const struct kd_ring_view *view, double chi, struct kd_ring_view_point *out)
{
    double h = 0, x[4];
    const bool found = solve(view, chi, &h, &out->residual);
    photon_at(view, chi, h, x);
    const struct kd_covector photon = kd_tetrad_covector(&view->rain, x);
    out->look = view->frame.falls ? kd_tetrad_look_past_rain(&view->frame, photon.energy, x)
                                  : kd_tetrad_look(&view->frame, &photon);
    out->alpha = -photon.momentum / photon.energy;
    out->beta = photon.polar / photon.energy;
    add_place(view, &photon, out);
    return found;
}
