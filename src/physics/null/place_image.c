#include "physics/null/place_image.h"

#include "physics/null/null_course.h"
#include "physics/spacetime/kerr.h"

#include <math.h>
#include <stddef.h>

enum { PLACES = 1500, GUESSES = 96, TRIES = 5, ITERATIONS = 14 };
#define FOUND 1e-9 /* relative change of the radius at which the search stops */
#define WRONG 1e-5
/* Distances (M) from the hole on the sky at which the search starts. All are beyond LEAST. Those from NEAR to FAR are
 * close to the critical curve. */
#define LEAST 0.01
#define NEAR 1.5
#define FAR 9
#define MOST \
    (1.4 * M_PI) /* maximum turn of the direct image's ray about the hole; without spin it would be half a \
                  * turn */

/* A vector with components along r, theta and phi, which are treated as flat spherical coordinates. This approximation
 * suffices for comparing distances. */
struct vector { double x[3]; };

static struct vector less(const struct vector *a, const struct vector *b)
{
    return (struct vector) { { a->x[0] - b->x[0], a->x[1] - b->x[1], a->x[2] - b->x[2] } };
}
static double dot(const struct vector *a, const struct vector *b)
{
    return a->x[0] * b->x[0] + a->x[1] * b->x[1] + a->x[2] * b->x[2];
}
static struct vector cross(const struct vector *a, const struct vector *b)
{
    return (struct vector) { { a->x[1] * b->x[2] - a->x[2] * b->x[1], a->x[2] * b->x[0] - a->x[0] * b->x[2],
                               a->x[0] * b->x[1] - a->x[1] * b->x[0] } };
}

static double angle(const struct vector *a, const struct vector *b)
{
    const struct vector c = cross(a, b);
    return atan2(sqrt(dot(&c, &c)), dot(a, b));
}

struct search {
    const struct kd_place_view *view;
    struct vector place;
    double r;
    struct kd_null_place *places; /* memory for the PLACES places of a ray */
};

/* The ray at a point of the chart. For an observer at infinity the chart's coordinates are alpha and beta. Otherwise
 * they are those of the direction, by stereographic projection about -r. */
static bool ray_of(const struct kd_place_view *view, const double at[2], struct kd_null_ray *ray, struct kd_look *look)
{
    const struct kd_vantage *v = &view->frame.at;
    *ray = (struct kd_null_ray) {
        .hole = v->hole, .radius = v->r, .cos_theta = v->u, .sin_theta = v->s, .alpha = at[0], .beta = at[1]
    };
    *look = (struct kd_look) { NAN, NAN, NAN, NAN };
    if (isinf(v->r))
        return true;
    const double n = at[0] * at[0] + at[1] * at[1], right = 2 * at[0] / (1 + n), up = 2 * at[1] / (1 + n),
                 inwards = (1 - n) / (1 + n);
    const double x[4] = { 1, inwards, up, -right };
    const struct kd_covector photon = kd_tetrad_covector(&view->frame, x);
    if (!(photon.energy > 0))
        return false;
    *look = (struct kd_look) { right, up, inwards, photon.energy };
    ray->alpha = -photon.momentum / photon.energy;
    ray->beta = photon.polar / photon.energy;
    ray->outward = photon.radial < 0;
    return true;
}

static struct vector at_place(const struct kd_null_place *p)
{
    const double across = p->r * sqrt(fmax(0, (1 - p->u) * (1 + p->u)));
    return (struct vector) { { across * cos(p->phi), across * sin(p->phi), p->r * p->u } };
}

/* 1/r, the unit vector and the delay at a Mino time, by Lagrange's cubic through four places. */
static struct vector between(const struct kd_null_place *p, double mino, double *delay)
{
    double w = 0, n[3] = { 0 }, length = 0;
    *delay = 0;
    for (int i = 0; i < 4; i++) {
        double share = 1;
        for (int j = 0; j < 4; j++)
            if (j != i)
                share *= (mino - p[j].mino) / (p[i].mino - p[j].mino);
        const struct vector here = at_place(&p[i]);
        w += share / p[i].r;
        *delay += share * p[i].delay;
        for (int k = 0; k < 3; k++)
            n[k] += share * here.x[k] / p[i].r;
    }
    for (int k = 0; k < 3; k++)
        length += n[k] * n[k];
    const double size = 1 / (w * sqrt(length));
    return (struct vector) { { n[0] * size, n[1] * size, n[2] * size } };
}

/* The point of a ray that is closest to the place. */
struct miss {
    struct vector off, way;
    /* size: distance from the place. swept: angle about the hole that the ray has swept since the observer */
    double size, delay, swept;
};

/* Squared distance of the place from a segment of the ray. */
static double apart(const struct search *s, const struct vector *from, const struct vector *to)
{
    const struct vector along = less(to, from), there = less(&s->place, from);
    const double share = fmin(fmax(dot(&along, &there) / (dot(&along, &along) + 1e-300), 0), 1);
    const struct vector off = { { there.x[0] - share * along.x[0], there.x[1] - share * along.x[1],
                                  there.x[2] - share * along.x[2] } };
    return dot(&off, &off);
}

/* The closest point to the place, on the cubic between two Mino times. */
static struct miss nearest(const struct search *s, const struct kd_null_place *four, double low, double high)
{
    struct miss best = { .size = INFINITY };
    double step = high - low;
    for (int round = 0; round < 24; round++) { /* ternary search, because the distance has a single minimum there */
        double one, other;
        const double a = low + step / 3, b = high - step / 3;
        const struct vector at = between(four, a, &one), to = between(four, b, &other), u = less(&at, &s->place),
                            v = less(&to, &s->place);
        if (dot(&u, &u) < dot(&v, &v))
            high = b;
        else
            low = a;
        step = high - low;
    }
    const double middle = 0.5 * (low + high), h = 1e-4 * (four[2].mino - four[1].mino);
    double before, after;
    const struct vector from = between(four, middle - h, &before), to = between(four, middle + h, &after),
                        here = between(four, middle, &best.delay);
    best.off = less(&here, &s->place);
    best.way = less(&to, &from);
    /* The offset along the ray vanishes at the closest point, unless this point is an end of the ray. */
    const double along = dot(&best.off, &best.way) / dot(&best.way, &best.way);
    for (int k = 0; k < 3 && fabs(along) < 10; k++)
        best.off.x[k] -= along * best.way.x[k];
    best.delay -= fabs(along) < 10 ? along * (after - before) : 0;
    best.size = sqrt(dot(&best.off, &best.off));
    return best;
}

/* Removes crossings of the plane from a list of places. A crossing may be close to another place, and a cubic through
 * both would be ill-conditioned. */
static size_t apart_in_time(struct kd_null_place *p, size_t n)
{
    size_t kept = 0;
    for (size_t i = 0; i < n; i++)
        if (p[i].crossing < 0 && (!kept || p[i].mino > p[kept - 1].mino))
            p[kept++] = p[i];
    return kept;
}

static bool misses(const struct search *s, const double at[2], struct miss *out)
{
    struct kd_null_ray ray;
    struct kd_look look;
    *out = (struct miss) { .size = INFINITY };
    if (!ray_of(s->view, at, &ray, &look))
        return false;
    struct kd_null_course course = kd_null_course_of(&ray, 2 * s->r + 20, 1e-4, s->places, PLACES);
    course.n = apart_in_time(s->places, course.n);
    size_t best = 0;
    double least = INFINITY;
    if (course.n < 4)
        return false;
    struct vector from = at_place(&s->places[0]);
    const struct kd_vantage *v = &s->view->frame.at;
    const struct vector observer = { { v->s, 0, v->u } };
    double swept = angle(&observer, &from), swept_there = 0;
    for (size_t i = 0; i + 1 < course.n; i++) {
        const struct vector to = at_place(&s->places[i + 1]);
        const double d = apart(s, &from, &to);
        if (d < least && s->places[i + 1].mino > s->places[i].mino)
            least = d, best = i, swept_there = swept;
        swept += angle(&from, &to);
        from = to;
    }
    const size_t first = best < 1 ? 0 : best + 3 > course.n ? course.n - 4 : best - 1;
    *out = nearest(s, &s->places[first], s->places[best > 0 ? best - 1 : 0].mino,
                   s->places[best + 2 < course.n ? best + 2 : course.n - 1].mino);
    out->swept = swept_there;
    return isfinite(out->size);
}

/* Two unit vectors perpendicular to the ray. */
static void across(const struct miss *m, struct vector axes[2])
{
    const double *w = m->way.x;
    const int k = fabs(w[0]) < fabs(w[1]) ? (fabs(w[0]) < fabs(w[2]) ? 0 : 2) : (fabs(w[1]) < fabs(w[2]) ? 1 : 2);
    struct vector axis = { { k == 0, k == 1, k == 2 } };
    axes[0] = cross(&m->way, &axis);
    axes[1] = cross(&m->way, &axes[0]);
    for (int i = 0; i < 2; i++) {
        const double size = sqrt(dot(&axes[i], &axes[i]));
        for (int j = 0; j < 3; j++)
            axes[i].x[j] /= size;
    }
}

/* Takes a Newton step in the chart. Returns false where images of the place merge. */
static bool step_from(const struct search *s, const double at[2], const struct miss *m, double step[2])
{
    const double h = 1e-6 * (isinf(s->view->frame.at.r) ? fmax(1, hypot(at[0], at[1]))
                                                        : fmax(hypot(at[0], at[1]), 1 / s->view->frame.at.r));
    struct vector axes[2];
    double rate[2][2];
    across(m, axes);
    for (int j = 0; j < 2; j++) {
        const double to[2] = { at[0] + h * (j == 0), at[1] + h * (j == 1) };
        struct miss other;
        if (!misses(s, to, &other))
            return false;
        const struct vector change = less(&other.off, &m->off);
        for (int i = 0; i < 2; i++)
            rate[i][j] = dot(&change, &axes[i]) / h;
    }
    const double det = rate[0][0] * rate[1][1] - rate[0][1] * rate[1][0],
                 f[2] = { dot(&m->off, &axes[0]), dot(&m->off, &axes[1]) };
    step[0] = -(rate[1][1] * f[0] - rate[0][1] * f[1]) / det;
    step[1] = -(rate[0][0] * f[1] - rate[1][0] * f[0]) / det;
    return isfinite(step[0]) && isfinite(step[1]);
}

/* Finds the image by Newton's method from a guess. A step is halved until the distance decreases. */
static bool solve(const struct search *s, double at[2], struct miss *m)
{
    if (!misses(s, at, m))
        return false;
    for (int i = 0; i < ITERATIONS && m->size > FOUND * s->r; i++) {
        double step[2], share = 1;
        struct miss next = { .size = INFINITY };
        if (!step_from(s, at, m, step))
            break;
        for (; share > 1e-3; share *= 0.5) {
            const double to[2] = { at[0] + share * step[0], at[1] + share * step[1] };
            if (misses(s, to, &next) && next.size < m->size) {
                at[0] = to[0], at[1] = to[1];
                break;
            }
        }
        if (!(next.size < m->size))
            break;
        *m = next;
    }
    return m->size < WRONG * s->r;
}

/* Lists distances from the hole on the sky, in ascending order. Half of them are near the critical curve. */
static void distances(const struct search *s, double to[GUESSES])
{
    const double from = s->view->frame.at.r, most = isinf(from) ? 3 * s->r + 30 : 60 * from,
                 unit = isinf(from) ? 1 : 0.5 / from;
    double wide = LEAST, fine = NEAR;
    for (int i = 0; i < GUESSES; i++) {
        const bool take_fine = fine < wide && fine < FAR;
        to[i] = unit * (take_fine ? fine : wide);
        *(take_fine ? &fine : &wide) =
            take_fine ? fine + 2 * (FAR - NEAR) / GUESSES : wide * pow(most / LEAST, 2. / GUESSES);
    }
}

/* Searches along one direction on the place's side of the sky. It starts at the outermost distance where the closest
 * approach has a local minimum. */
static bool search_along(const struct search *s, double way, double turned, double at[2], struct miss *m)
{
    const double towards[2] = { cos(way + turned), sin(way + turned) }, side[2] = { cos(way), sin(way) };
    double near[GUESSES], where[GUESSES];
    struct miss guess;
    int tries = 0;
    distances(s, where);
    for (int i = 0; i < GUESSES; i++)
        near[i] =
            misses(s, (double[]) { where[i] * towards[0], where[i] * towards[1] }, &guess) ? guess.size : INFINITY;
    for (int i = GUESSES - 1; i >= 0 && tries < TRIES; i--) {
        if (!(near[i] < INFINITY) || (i > 0 && near[i] > near[i - 1]) || (i + 1 < GUESSES && near[i] > near[i + 1]))
            continue;
        tries++;
        at[0] = where[i] * towards[0], at[1] = where[i] * towards[1];
        if (solve(s, at, m) && at[0] * side[0] + at[1] * side[1] > 0 && m->swept < MOST)
            return true;
    }
    return false;
}

/* Searches in several directions, because a spinning hole drags the image round itself. */
static bool search(const struct search *s, double at[2], struct miss *m)
{
    static const double turns[] = { 0, 0.35, -0.35, 0.8, -0.8 };
    const struct kd_vantage *v = &s->view->frame.at;
    const double *p = s->place.x, right = p[1], up = p[2] * v->s - p[0] * v->u,
                 way = right == 0 && up == 0 ? 0 : atan2(up, right);
    for (size_t i = 0; i < sizeof turns / sizeof *turns; i++)
        if (search_along(s, way, turns[i], at, m))
            return true;
    return false;
}

struct kd_place_view kd_place_view_of(const struct kd_observer_motion *motion, const struct kd_vantage *at)
{
    if (isinf(at->r))
        return (struct kd_place_view) { { .at = *at } };
    return (struct kd_place_view) { kd_observer_tetrad(motion, at) };
}

bool kd_place_image_seen(const struct kd_place_view *view, double r, double u, double phi,
                         const struct kd_place_image *near, bool searches, struct kd_place_image *out)
{
    struct kd_null_place places[PLACES];
    const double off_axis = r * sqrt(fmax(0, (1 - u) * (1 + u)));
    const struct search s = { view, { { off_axis * cos(phi), off_axis * sin(phi), r * u } }, r, places };
    struct kd_null_ray ray;
    struct miss m = { .size = INFINITY };
    double at[2] = { 0, 0 };
    *out = (struct kd_place_image) { NAN, NAN, false, { NAN, NAN, NAN, NAN }, NAN, NAN, { NAN, NAN } };
    if (!(r > KD_PLACE_LEAST * view->frame.at.hole.outer) || !isfinite(u) || !isfinite(phi))
        return false;
    bool found = false;
    if (near && isfinite(near->off)) {
        at[0] = near->chart[0], at[1] = near->chart[1];
        found = solve(&s, at, &m) && m.swept < MOST;
    }
    if (!found && !(searches && search(&s, at, &m)))
        return false;
    if (!ray_of(view, at, &ray, &out->look))
        return false;
    *out = (struct kd_place_image) { ray.alpha, ray.beta, ray.outward, out->look, m.delay, m.size, { at[0], at[1] } };
    return true;
}
