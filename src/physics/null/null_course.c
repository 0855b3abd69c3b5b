#include "physics/null/null_course.h"

#include "physics/null/null_quartic.h"
#include "physics/spacetime/kerr.h"

#include <math.h>
#include <string.h>

#define ANGLE 0.03 /* largest angle between neighbouring places */
#define SLOPE 0.02 /* largest change of w between neighbouring places; the rate of w is 1 on a straight ray */
#define SUBSTEPS 8 /* number of fourth-order steps between two places; the error is some 1e-12 of a turn */
#define POLE 0.02  /* largest step, relative to the distance to the horizon, where chi and t have a pole */

enum { W, DW, NX, NY, NZ, VX, VY, VZ, CHI, T, STATE };
struct state { double y[STATE]; };

struct course {
    struct kd_null_motion m;
    double horizon;        /* 1/r+ */
    double sense;          /* sign of lambda, also defined if lambda is 0 */
    double psi;            /* azimuth so far, without frame dragging, not reduced to a turn */
    double last_x, last_y; /* components x and y of n at the last update */
    double way;            /* s of the header's formula of the time: 1 on the way in, -1 on the way out */
    double ingoing;        /* sign of the energy if coordinates are ingoing; 0 if they are Boyer-Lindquist's */
    double edge;           /* value at the start of the part of the time that is a closed form instead of an integral */
    double first;          /* least 1/r at which places are recorded */
    struct state now;
    double mino;
    int order;
    struct kd_null_place *out;
    size_t most;
    struct kd_null_course *to;
};

/* G of the header comment, in the form that does not cancel. */
static double gone(const struct course *c, double w, double dw, double d)
{
    const struct kd_null_motion *m = &c->m;
    const double all = 1 + m->hole.a * (m->hole.a - m->lambda) * w * w, along = all + c->ingoing * dw,
                 against = all - c->ingoing * dw;
    return fabs(against) >= fabs(along) ? m->k * w * w / against : along / d;
}

static struct state rates(const struct course *c, const struct state *s)
{
    const struct kd_null_motion *m = &c->m;
    const double w = s->y[W], dw = s->y[DW], u = s->y[NZ], a = m->hole.a, a2 = a * a, d = kd_hole_delta_w(&m->hole, w);
    const double pull = m->eta + m->lambda * m->lambda + 2 * a2 * u * u;
    const struct kd_hole_rates n = kd_hole_rates_of(&m->hole, 1, m->lambda);
    const double g = c->ingoing != 0 && w != 0 ? gone(c, w, dw, d) : 0;
    return (struct state) { {
        [W] = dw,
        [DW] = w * (m->quadratic + w * (3 * m->k + 2 * m->constant * w)),
        [NX] = s->y[VX],
        [NY] = s->y[VY],
        [NZ] = s->y[VZ],
        [VX] = -pull * s->y[NX],
        [VY] = -pull * s->y[NY],
        [VZ] = (a2 - pull) * u,
        [CHI] = c->ingoing != 0 ? a * (g - 1) : a * w * (2 - n.drag * w) / d,
        [T] = c->ingoing != 0
                  ? w * (m->k + m->constant * w) + a2 * u * u + (w != 0 ? kd_hole_mass_w(&m->hole, w) / w * g : 0)
                  : w * (m->k + m->constant * w) * (1 + 2 * w / (1 + c->way * dw)) + n.four +
                        (n.near * w - (n.nearer + 4 * a2) * w * w) / d + a2 * u * u,
    } };
}

static struct state ahead(const struct state *s, const struct state *rate, double h)
{
    struct state o;
    for (int i = 0; i < STATE; i++)
        o.y[i] = s->y[i] + h * rate->y[i];
    return o;
}

/* Runge-Kutta step of fourth order. */
static struct state step(const struct course *c, const struct state *s, double h)
{
    const struct state k1 = rates(c, s), s2 = ahead(s, &k1, 0.5 * h), k2 = rates(c, &s2), s3 = ahead(s, &k2, 0.5 * h),
                       k3 = rates(c, &s3), s4 = ahead(s, &k3, h), k4 = rates(c, &s4);
    struct state o;
    for (int i = 0; i < STATE; i++)
        o.y[i] = s->y[i] + h / 6 * (k1.y[i] + 2 * (k2.y[i] + k3.y[i]) + k4.y[i]);
    return o;
}

/* The part of the time that has a closed form, at a state. It is 0 at infinity, because r_o + 2 ln r_o is left out. */
static double edge(const struct course *c, const struct state *s)
{
    const double w = s->y[W], dw = s->y[DW];
    if (!(w > 0))
        return 0;
    if (c->ingoing != 0)
        return -dw / w;
    return -dw / w - 2 * c->way * log(0.5 * (1 + c->way * dw) / w);
}

/* Largest error of the first integrals, relative to their terms. */
static double drift(const struct course *c, const struct state *s)
{
    const struct kd_null_motion *m = &c->m;
    const double *y = s->y, w = y[W], w2 = w * w, l2 = m->lambda * m->lambda, u2 = y[NZ] * y[NZ];
    const double terms[] = { 1, m->quadratic * w2, 2 * m->k * w2 * w, m->constant * w2 * w2 };
    double radial = -y[DW] * y[DW], size = y[DW] * y[DW];
    for (int i = 0; i < 4; i++)
        radial += terms[i], size += fabs(terms[i]);
    const double speed2 = y[VX] * y[VX] + y[VY] * y[VY] + y[VZ] * y[VZ],
                 polar = m->eta + l2 + m->hole.a * m->hole.a * u2 - speed2;
    const double moment = y[NX] * y[VY] - y[NY] * y[VX] - m->lambda,
                 about = sqrt(fabs(m->eta) + l2 + m->hole.a * m->hole.a);
    double worst = fmax(fabs(radial) / size, fabs(y[NX] * y[NX] + y[NY] * y[NY] + u2 - 1));
    if (about > 0)
        worst = fmax(worst, fmax(fabs(polar) / (about * about), fabs(moment) / about));
    return worst;
}

/* Advances the azimuth to a state. A ray that passes through the axis turns by pi there, towards -phi if alpha = 0. A
 * ray from an observer on the axis turns as neighbouring rays do, whose lambda has the sign of -alpha (null_polar.h).
 */
static void turn(struct course *c, const struct state *s)
{
    const double x = s->y[NX], y = s->y[NY], dot = c->last_x * x + c->last_y * y, cross = c->last_x * y - c->last_y * x;
    double by = c->m.lambda == 0 ? (dot < 0 ? c->sense * M_PI : 0) : atan2(cross, dot);
    if (fabs(by) > 0.5 * M_PI && by * c->m.lambda < 0)
        by += copysign(2 * M_PI, c->m.lambda);
    c->psi += by;
    c->last_x = x;
    c->last_y = y;
}

/* After a turning point, changes to the formula of the time for the other direction. */
static void take_way(struct course *c, struct state *s)
{
    const double way = s->y[DW] < 0 ? -1 : 1, before = edge(c, s);
    if (c->ingoing != 0 || way == c->way || !(s->y[W] > 0))
        return;
    c->way = way;
    s->y[T] += before - edge(c, s);
}

static bool put(struct course *c, const struct state *s, int crossing)
{
    c->to->drift = fmax(c->to->drift, drift(c, s));
    c->to->least_r = fmin(c->to->least_r, 1 / s->y[W]);
    if (c->to->n == c->most)
        return false;
    c->out[c->to->n++] = (struct kd_null_place) {
        .mino = c->mino,
        .r = 1 / s->y[W],
        .u = fmax(-1, fmin(1, s->y[NZ])),
        .phi = 0 - (c->psi + s->y[CHI]),
        .delay = s->y[T] + edge(c, s) - c->edge,
        .order = c->order,
        .crossing = crossing,
    };
    return true;
}

/* Finds the fraction of a step from `from` at which y[which] passes `value`, by bisection and the secant method. */
static double part_of(const struct course *c, const struct state *from, double h, int which, double value)
{
    double low = 0, high = h;
    struct state s = step(c, from, h);
    double f_low = from->y[which] - value, f_high = s.y[which] - value;
    for (int i = 0; i < 60 && f_high != 0 && high - low > 1e-17 * h; i++) {
        double middle = i % 3 == 2 ? 0.5 * (low + high) : low + (high - low) * f_low / (f_low - f_high);
        middle = fmin(fmax(middle, low), high);
        s = step(c, from, middle);
        const double f = s.y[which] - value;
        if ((f < 0) == (f_low < 0) && f != 0)
            low = middle, f_low = f;
        else
            high = middle, f_high = f;
    }
    return high;
}

static bool set_out(struct course *c, const struct kd_null_ray *ray)
{
    const double u = ray->cos_theta, s = ray->sin_theta > 0 ? ray->sin_theta : sqrt((1 - u) * (1 + u)),
                 w = isinf(ray->radius) ? 0 : 1 / ray->radius;
    const struct kd_null_motion *m = &c->m;
    const double all = 1 + w * w * (m->quadratic + w * (2 * m->k + m->constant * w));
    /* this form of the condition also rejects NaN */
    if (!(all >= -1e-12) || !isfinite(m->lambda) || !isfinite(m->eta))
        return false;
    c->now = (struct state) { {
        [W] = w,
        [DW] = (ray->outward ? -1 : 1) * sqrt(fmax(all, 0)),
        [NX] = s,
        [NZ] = u,
        [VX] = -ray->beta * u,
        [VY] = 0 - ray->alpha,
        [VZ] = ray->beta * s,
    } };
    c->sense = s > 0 || !(ray->alpha > 0) ? 1 : -1;
    c->last_x = s > 0 ? s : c->now.y[VX];
    c->last_y = s > 0 ? 0 : c->now.y[VY];
    c->psi = s > 0 ? 0 : atan2(c->now.y[VY], c->now.y[VX]);
    c->way = ray->outward ? -1 : 1;
    c->edge = edge(c, &c->now);
    return true;
}

/* Largest length of the next step. Deep in the hole w changes at the rate sqrt(6 k w), whatever its present slope. */
static double length_of(const struct course *c)
{
    const struct kd_null_motion *m = &c->m;
    const double deep = c->ingoing != 0 ? 6 * m->k * fmax(c->now.y[W], 0) : 0;
    const double turning = sqrt(fabs(m->eta) + m->lambda * m->lambda + m->hole.a * m->hole.a + deep) + 1e-300;
    return fmin(ANGLE / turning, SLOPE) / SUBSTEPS;
}

/* True if the light of a ray in ingoing coordinates does not come from outside the hole. Traced back, such a ray
 * reaches the past horizon from within. */
static bool is_dark(const struct course *c)
{
    return c->ingoing * (1 + c->m.hole.a * (c->m.hole.a - c->m.lambda) * c->horizon * c->horizon) <= 0;
}

/* True if chi and t have a pole at the next horizon on the ray. */
static bool has_pole(const struct course *c)
{
    return c->ingoing == 0 || c->now.y[DW] > 0 || (c->now.y[W] > c->horizon && is_dark(c));
}

/* Takes a step of at most h. If the ray crosses the plane within the step, the step ends at the crossing, which becomes
 * a place. Returns false if no room is left. */
static bool go(struct course *c, double h)
{
    const double *y = c->now.y, left = fabs(c->horizon - y[W]), speed = fabs(y[DW]);
    if (has_pole(c) && speed * h > POLE * left)
        h = POLE * left / speed;
    struct state next = step(c, &c->now, h);
    const bool crosses = y[NZ] != 0 && (next.y[NZ] == 0 || (next.y[NZ] < 0) != (y[NZ] < 0));
    if (crosses) {
        h = part_of(c, &c->now, h, NZ, 0);
        next = step(c, &c->now, h);
    }
    c->mino += h;
    take_way(c, &next);
    c->now = next;
    turn(c, &next);
    if (!crosses)
        return true;
    /* from here on the ray counts as being on this side of the plane, regardless of rounding of u */
    const double side = next.y[VZ];
    c->now.y[NZ] = copysign(1e-300, side);
    const bool room = next.y[W] < c->first || put(c, &next, c->order);
    c->order++;
    return room;
}

/* True if the ray is next to the horizon and is about to enter it, or to reach the past horizon from within. */
static bool is_captured(const struct course *c, double near)
{
    const double w = c->now.y[W], dw = c->now.y[DW];
    if (c->ingoing == 0 || (dw > 0 && w < c->horizon))
        return w >= 1 / (1 / c->horizon + near);
    return dw < 0 && is_dark(c) && w <= 1 / fmax(1 / c->horizon - near, 1e-300);
}

static void run(struct course *c, double near)
{
    const double begun = c->now.y[W];
    struct kd_null_course *to = c->to;
    bool room = begun > 0 ? put(c, &c->now, -1) : true;
    for (size_t i = 1; room; i++) {
        const struct state before = c->now;
        const double way = c->way, h = length_of(c), begun_at = c->mino;
        room = go(c, h);
        to->steps = i;
        const double w = c->now.y[W], dw = c->now.y[DW];
        if (!isfinite(w)) { /* stops, because w has diverged and the loop would not end */
            to->end = KD_COURSE_NONE;
            return;
        }
        if (w < c->first && dw < 0) { /* the ray is far enough out: records the place at which it passed r = far */
            to->end = KD_COURSE_ESCAPED;
            if (before.y[W] > c->first && room) {
                c->way = way;
                const double part = part_of(c, &before, h, W, c->first);
                c->now = step(c, &before, part);
                c->mino = begun_at + part;
                turn(c, &c->now);
                put(c, &c->now, -1);
            }
            return;
        }
        if (is_captured(c, near)) {
            to->end = KD_COURSE_CAPTURED;
            put(c, &c->now, -1);
            return;
        }
        if (w >= c->first && room && (i % SUBSTEPS == 0 || before.y[W] < c->first))
            room = put(c, &c->now, -1);
    }
    to->end = KD_COURSE_LONG;
}

static struct kd_null_course follow(const struct kd_null_ray *ray, double ingoing, double far, double near,
                                    struct kd_null_place *out, size_t most)
{
    struct kd_null_course course = { .least_r = INFINITY };
    const double begun = isinf(ray->radius) ? 0 : 1 / ray->radius;
    struct course c = {
        .m = kd_null_motion_of(&ray->hole, ray->cos_theta, ray->sin_theta, ray->alpha, ray->beta),
        .horizon = 1 / ray->hole.outer,
        .ingoing = ingoing,
        .first = fmin(1 / far, begun > 0 ? begun : INFINITY),
        .out = out,
        .most = most,
        .to = &course,
    };
    if (set_out(&c, ray))
        run(&c, near);
    return course;
}

struct kd_null_course kd_null_course_of(const struct kd_null_ray *ray, double far, double near,
                                        struct kd_null_place *out, size_t most)
{
    return follow(ray, 0, far, near, out, most);
}

struct kd_null_course kd_null_course_ingoing(const struct kd_null_ray *ray, bool reversed, double far, double near,
                                             struct kd_null_place *out, size_t most)
{
    return follow(ray, reversed ? -1 : 1, far, near, out, most);
}
