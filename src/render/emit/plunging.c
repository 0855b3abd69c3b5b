#include "render/emit/plunging.h"

#include "physics/math/root.h"
#include "physics/spacetime/kerr.h"
#include "scene/hole.h"

#include <math.h>

bool kd_plunging_is_on(const struct kd_scene *scene)
{
    const struct kd_disk *d = &scene->disk;
    return d->model == KD_DISK_PARTICLES && d->plunging > 0 && isinf(d->inner);
}

struct kd_plunging kd_plunging_of(const struct kd_scene *scene)
{
    const struct kd_hole *hole = kd_scene_hole(scene);
    struct kd_plunging o = { .curve = kd_plunge_of(hole) };
    double way = o.curve.isco - o.curve.hole.outer;
    o.start = o.curve.isco - way / 32;
    o.end = o.curve.hole.outer + way / 64;
    o.omega = kd_kerr_omega(hole, o.curve.isco);
    o.first = kd_plunge_at(&o.curve, o.start);
    o.time = kd_plunge_at(&o.curve, o.end).t - o.first.t;
    return o;
}

struct kd_plunging_place kd_plunging_at(const struct kd_plunging *o, double r)
{
    struct kd_plunge_event e = kd_plunge_at(&o->curve, r);
    double t = e.t - o->first.t;
    return (struct kd_plunging_place) { t / o->time, (e.phi - o->first.phi - o->omega * t) / (2 * M_PI) };
}

struct wanted {
    const struct kd_plunging *plunging;
    double phase;
};
static double off(const void *user, double r)
{
    const struct wanted *w = user;
    return kd_plunging_at(w->plunging, r).phase - w->phase;
}

void kd_plunging_path(const struct kd_plunging *o, struct kd_plunging_path *out)
{
    double above = o->start;
    for (int i = 0; i < KD_PLUNGING_POINTS; i++) {
        const struct wanted w = { o, (double)i / (KD_PLUNGING_POINTS - 1) };
        double r = i == 0 ? o->start : i == KD_PLUNGING_POINTS - 1 ? o->end : kd_root(off, &w, above, o->end);
        const struct kd_plunge_velocity u = kd_plunge_velocity(&o->curve, r);
        out->at[i].r = above = r;
        out->at[i].turns = kd_plunging_at(o, r).turns;
        out->at[i].r_slope = u.ur / u.ut * o->time / (KD_PLUNGING_POINTS - 1);
        out->at[i].turns_slope = (u.uphi / u.ut - o->omega) / (2 * M_PI) * o->time / (KD_PLUNGING_POINTS - 1);
    }
}

static double cubic(double y0, double d0, double y1, double d1, double x)
{
    double rise = y1 - y0;
    return y0 + x * (d0 + x * (3 * rise - 2 * d0 - d1 + x * (d0 + d1 - 2 * rise)));
}

double kd_plunging_radius(const struct kd_plunging_path *path, double phase, double *turns)
{
    double x = phase * (KD_PLUNGING_POINTS - 1);
    int i = (int)fmin(fmax(x, 0), KD_PLUNGING_POINTS - 2);
    *turns =
        cubic(path->at[i].turns, path->at[i].turns_slope, path->at[i + 1].turns, path->at[i + 1].turns_slope, x - i);
    return cubic(path->at[i].r, path->at[i].r_slope, path->at[i + 1].r, path->at[i + 1].r_slope, x - i);
}
