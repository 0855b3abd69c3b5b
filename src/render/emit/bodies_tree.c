/* Packs bodies for the device: their data, and a tree of bounding balls over them. */
#include "render/emit/bodies.h"

#include "physics/spacetime/kerr.h"
#include "physics/spacetime/observer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SINE 1e-4 /* lower bound of sin(theta): on the axis azimuth is undefined */

/* A body with its ball. */
struct ball {
    double at[3], reach;
    size_t body;
};

static uint32_t leaves_of(size_t n)
{
    uint32_t leaves = 1;
    while (leaves < n)
        leaves *= 2;
    return leaves;
}

size_t kd_bodies_words(size_t n) { return (8 + KD_BODY_WORDS) * (size_t)leaves_of(n); }

/* The metric at a body's centre (Bardeen, Press & Teukolsky 1972). lapse: the lapse; r, theta, phi: square roots of
 * g_rr, of g_thetatheta and of g_phiphi/sin^2(theta); omega: frame dragging. */
struct metric { double lapse, r, theta, phi, omega; };

static struct metric metric_at(const struct kd_hole *hole, const struct kd_seen_body *b)
{
    const double a = hole->a, r = b->r, sigma = r * r + a * a * b->u * b->u, delta = kd_hole_delta(hole, r);
    const double w2 = r * r + a * a, big = w2 * w2 - a * a * delta * b->s * b->s;
    return (struct metric) { sqrt(sigma * delta / big), sqrt(sigma / delta), sqrt(sigma), sqrt(big / sigma),
                             kd_kerr_dragging(hole, r, b->u) };
}

static double speed2(const struct kd_seen_body *b)
{
    return b->velocity[0] * b->velocity[0] + b->velocity[1] * b->velocity[1] + b->velocity[2] * b->velocity[2];
}

bool kd_bodies_seen(const struct kd_seen_body *b, const struct kd_hole *hole)
{
    return b->radius > 0 && b->r >= KD_BODIES_CLEAR * hole->outer && b->r <= 1e12 && fabs(b->u) <= 1 && b->s >= 0 &&
           b->s <= 1 && isfinite(b->phi) && speed2(b) < 1 && isfinite(b->radius) && b->albedo >= 0 && b->albedo <= 1 &&
           b->temperature_k >= 0 && b->brightness >= 0;
}

static double turn_of(const struct metric *g, const struct kd_seen_body *b)
{
    return g->phi * b->s * g->omega / g->lapse;
}

/* Bounding ball of a body. Azimuths are mirrored, as along the traced ray. A moving body appears longer than it is
 * wide, because the observer sees all of its light at one time. */
static struct ball ball_of(const struct kd_seen_body *b, size_t body, const struct kd_bodies_view *view)
{
    const struct metric g = metric_at(&view->hole, b);
    const double phi = b->phi - view->azimuth, v2 = speed2(b);
    const double longer = (1 + sqrt(v2)) / sqrt(fmax(1 - v2, 1e-12)) * (1 + fabs(turn_of(&g, b)));
    return (struct ball) { { b->r * b->s * cos(phi), -b->r * b->s * sin(phi), b->r * b->u },
                           fmin(b->radius * longer, 1e9),
                           body };
}

static void fill(float *w, const struct kd_seen_body *b, const struct kd_bodies_view *view)
{
    const struct metric g = metric_at(&view->hole, b);
    const double phi = b->phi - view->azimuth, c = cos(phi), s = sin(phi), sine = fmax(b->s, SINE);
    const double axes[3][3] = { { b->s * c, -b->s * s, b->u }, { b->u * c, -b->u * s, -b->s }, { -s, -c, 0 } };
    const double stretch[3] = { g.r, g.theta / b->r, g.phi / b->r }, *v = b->velocity,
                 gamma = 1 / sqrt(fmax(1 - speed2(b), 1e-12));
    const double rest[] = {
        v[0],
        v[1],
        v[2],
        gamma,
        turn_of(&g, b),
        fmin(b->radius, 1e9),
        b->limb_darkening,
        b->brightness,
        gamma / g.lapse,
        gamma * (g.omega / g.lapse + v[2] / (g.phi * sine)),
        gamma * v[0] / g.r,
        gamma * v[1] / g.theta,
        b->temperature_k / view->peak_k,
        b->which,
        0,
        0,
    };
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            w[4 * i + k] = (float)(stretch[i] * axes[i][k]);
        w[4 * i + 3] = i == 0 ? (float)(-stretch[0] * b->r) : 0;
    }
    for (int i = 0; i < 16; i++)
        w[12 + i] = (float)rest[i];
    kd_illumination_body(view->lit, b, g.lapse, w + 28);
}

static void swap(struct ball *a, struct ball *b)
{
    const struct ball was = *a;
    *a = *b;
    *b = was;
}

/* Moves the k balls with the least coordinate along the axis to the front (C. A. R. Hoare 1961, "Find", Commun. ACM
 * 4, 321). */
static void part(struct ball *balls, size_t n, size_t k, int axis)
{
    size_t low = 0, high = n - 1;
    while (low < high) {
        const double middle = balls[(low + high) / 2].at[axis];
        size_t i = low, j = high;
        for (;;) {
            while (balls[i].at[axis] < middle)
                i++;
            while (balls[j].at[axis] > middle)
                j--;
            if (i >= j)
                break;
            swap(&balls[i++], &balls[j--]);
        }
        /* From here on no ball up to j is beyond `middle`, and no ball after j is before it. */
        if (k <= j)
            high = j;
        else
            low = j + 1;
    }
}

/* Bounding ball of some balls, round the centre of their bounding box. *axis: the longest axis of that box. */
static struct ball round_all(const struct ball *balls, size_t n, int *axis)
{
    struct ball all = { 0 };
    double longest = -1;
    for (int k = 0; k < 3; k++) {
        double low = INFINITY, high = -INFINITY;
        for (size_t i = 0; i < n; i++) {
            low = fmin(low, balls[i].at[k] - balls[i].reach);
            high = fmax(high, balls[i].at[k] + balls[i].reach);
        }
        all.at[k] = 0.5 * (low + high);
        if (high - low > longest) {
            longest = high - low;
            *axis = k;
        }
    }
    for (size_t i = 0; i < n; i++) {
        double x = balls[i].at[0] - all.at[0], y = balls[i].at[1] - all.at[1], z = balls[i].at[2] - all.at[2];
        all.reach = fmax(all.reach, sqrt(x * x + y * y + z * z) + balls[i].reach);
    }
    return all;
}

struct tree {
    const struct kd_seen_body *bodies;
    const struct kd_bodies_view *view;
    float *words;
    uint32_t leaves;
};

/* Distributes balls to the leaves below a node, half to either side. A leaf without a body is a ball of size 0 at the
 * hole, where no ray is near. */
static void grow(const struct tree *t, uint32_t node, struct ball *balls, size_t n)
{
    int axis = 0;
    if (!n)
        return;
    const struct ball all = n == 1 ? balls[0] : round_all(balls, n, &axis);
    for (int k = 0; k < 3; k++)
        t->words[4 * node + (uint32_t)k] = (float)all.at[k];
    t->words[4 * node + 3] = (float)(all.reach * (1 + 1e-6));
    if (node >= t->leaves) {
        fill(t->words + 8 * (size_t)t->leaves + (size_t)KD_BODY_WORDS * (node - t->leaves), &t->bodies[balls[0].body],
             t->view);
        return;
    }
    part(balls, n, (n + 1) / 2, axis);
    grow(t, 2 * node, balls, (n + 1) / 2);
    grow(t, 2 * node + 1, balls + (n + 1) / 2, n / 2);
}

/* Makes the balls of the visible bodies; returns their number. */
static size_t seen_of(const struct kd_seen_body *bodies, size_t n, const struct kd_bodies_view *view,
                      struct ball *balls)
{
    size_t seen = 0;
    for (size_t i = 0; i < n; i++)
        if (kd_bodies_seen(&bodies[i], &view->hole))
            balls[seen++] = ball_of(&bodies[i], i, view);
    return seen;
}

enum kd_status kd_bodies_pack(const struct kd_seen_body *bodies, size_t n, const struct kd_bodies_view *view,
                              float *words, struct kd_error *error)
{
    struct ball *balls = malloc((n ? n : 1) * sizeof *balls);
    const struct tree tree = { bodies, view, words, leaves_of(n) };
    if (!balls)
        return kd_error_set(error, KD_ENOMEM, "out of memory for bodies");
    memset(words, 0, kd_bodies_words(n) * sizeof *words);
    grow(&tree, 1, balls, seen_of(bodies, n, view, balls));
    free(balls);
    return KD_OK;
}

void kd_bodies_bound(const struct kd_seen_body *bodies, size_t n, const struct kd_bodies_view *view,
                     struct kd_bodies_block *out)
{
    double low[3] = { 0 }, high[3] = { 0 }, outermost = 1, reach = 0;
    size_t seen = 0;
    for (size_t i = 0; i < n; i++) {
        if (!kd_bodies_seen(&bodies[i], &view->hole))
            continue;
        const struct ball ball = ball_of(&bodies[i], i, view);
        for (int k = 0; k < 3; k++) {
            low[k] = seen ? fmin(low[k], ball.at[k] - ball.reach) : ball.at[k] - ball.reach;
            high[k] = seen ? fmax(high[k], ball.at[k] + ball.reach) : ball.at[k] + ball.reach;
        }
        outermost = fmax(outermost, bodies[i].r + ball.reach);
        seen++;
    }
    *out = (struct kd_bodies_block) { .least = (float)(1 / outermost), .leaves = leaves_of(n) };
    if (!seen)
        return;
    const double middle[3] = { 0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2]) };
    for (size_t i = 0; i < n; i++) {
        if (!kd_bodies_seen(&bodies[i], &view->hole))
            continue;
        const struct ball ball = ball_of(&bodies[i], i, view);
        reach = fmax(reach,
                     hypot(hypot(ball.at[0] - middle[0], ball.at[1] - middle[1]), ball.at[2] - middle[2]) + ball.reach);
    }
    out->x = (float)middle[0];
    out->y = (float)middle[1];
    out->z = (float)middle[2];
    out->reach = (float)(reach * (1 + 1e-6));
}
