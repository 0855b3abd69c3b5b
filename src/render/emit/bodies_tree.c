#include "render/emit/bodies.h"

#include "physics/kerr.h"
#include "physics/observer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CLEAR 1.05   /* of the horizon's radius */
#define SINE 1e-4    /* on the axis azimuths stand for nothing */

/* A body with its ball. */
struct ball { double at[3], reach; size_t body; };

static uint32_t leaves_of(size_t n)
{
    uint32_t leaves = 1;
    while (leaves < n)
        leaves *= 2;
    return leaves;
}

size_t kd_bodies_words(size_t n) { return (8 + KD_BODY_WORDS) * (size_t)leaves_of(n); }

/* What the metric says at its centre (Bardeen, Press & Teukolsky 1972): lapse, sqrt of g_rr, g_thetatheta, g_phiphi/sin^2, and the dragging. */
struct metric { double lapse, r, theta, phi, omega; };

static struct metric metric_at(double a, const struct kd_seen_body *b)
{
    const double r = b->r, sigma = r * r + a * a * b->u * b->u, delta = (r - kd_kerr_horizon(a)) * (r - kd_kerr_inner_horizon(a));
    const double w2 = r * r + a * a, big = w2 * w2 - a * a * delta * b->s * b->s;
    return (struct metric) { sqrt(sigma * delta / big), sqrt(sigma / delta), sqrt(sigma), sqrt(big / sigma), kd_kerr_dragging(a, r, b->u) };
}

static double speed2(const struct kd_seen_body *b) { return b->velocity[0] * b->velocity[0] + b->velocity[1] * b->velocity[1] + b->velocity[2] * b->velocity[2]; }

static bool is_seen(const struct kd_seen_body *b, double spin)
{
    return b->radius > 0 && b->r >= CLEAR * kd_kerr_horizon(spin) && b->r <= 1e12 && fabs(b->u) <= 1 && b->s >= 0 && b->s <= 1 && isfinite(b->phi) &&
           speed2(b) < 1 && isfinite(b->radius) && b->temperature_k > 0 && b->brightness >= 0;
}

/* Where all is seen from: the hole's spin, the observer's azimuth, the disk's largest temperature. */
struct view { double spin, azimuth, peak_k; };

static double turn_of(const struct metric *g, const struct kd_seen_body *b) { return g->phi * b->s * g->omega / g->lapse; }

/* Azimuths are mirrored, as the path that is traced has them. What is met of a body at one time of the observer's is longer than it is wide. */
static struct ball ball_of(const struct kd_seen_body *b, size_t body, const struct view *view)
{
    const struct metric g = metric_at(view->spin, b);
    const double phi = b->phi - view->azimuth, v2 = speed2(b);
    const double longer = (1 + sqrt(v2)) / sqrt(fmax(1 - v2, 1e-12)) * (1 + fabs(turn_of(&g, b)));
    return (struct ball) { { b->r * b->s * cos(phi), -b->r * b->s * sin(phi), b->r * b->u }, fmin(b->radius * longer, 1e9), body };
}

static void fill(float *w, const struct kd_seen_body *b, const struct view *view)
{
    const struct metric g = metric_at(view->spin, b);
    const double phi = b->phi - view->azimuth, c = cos(phi), s = sin(phi), sine = fmax(b->s, SINE);
    const double axes[3][3] = { { b->s * c, -b->s * s, b->u }, { b->u * c, -b->u * s, -b->s }, { -s, -c, 0 } };
    const double stretch[3] = { g.r, g.theta / b->r, g.phi / b->r }, *v = b->velocity, gamma = 1 / sqrt(fmax(1 - speed2(b), 1e-12));
    const double rest[] = {
        v[0], v[1], v[2], gamma,
        turn_of(&g, b), fmin(b->radius, 1e9), b->limb_darkening, b->brightness,
        gamma / g.lapse, gamma * (g.omega / g.lapse + v[2] / (g.phi * sine)), gamma * v[0] / g.r, gamma * v[1] / g.theta,
        b->temperature_k / view->peak_k, b->which, 0, 0,
    };
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            w[4 * i + k] = (float)(stretch[i] * axes[i][k]);
        w[4 * i + 3] = i == 0 ? (float)(-stretch[0] * b->r) : 0;
    }
    for (int i = 0; i < 16; i++)
        w[12 + i] = (float)rest[i];
}

static int by_axis(const struct ball *a, const struct ball *b, int axis) { return (a->at[axis] > b->at[axis]) - (a->at[axis] < b->at[axis]); }
static int by_x(const void *a, const void *b) { return by_axis(a, b, 0); }
static int by_y(const void *a, const void *b) { return by_axis(a, b, 1); }
static int by_z(const void *a, const void *b) { return by_axis(a, b, 2); }

/* The box of some balls: its middle, and the axis along which it is longest. */
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

struct tree { const struct kd_seen_body *bodies; const struct view *view; float *words; uint32_t leaves; };

/* Balls go to the leaves below a node, half of them to either side. A leaf without a body is at the hole and of no size, where no ray is near. */
static void grow(const struct tree *t, uint32_t node, struct ball *balls, size_t n)
{
    static int (*const by[])(const void *, const void *) = { by_x, by_y, by_z };
    int axis = 0;
    if (!n)
        return;
    const struct ball all = n == 1 ? balls[0] : round_all(balls, n, &axis);
    for (int k = 0; k < 3; k++)
        t->words[4 * node + (uint32_t)k] = (float)all.at[k];
    t->words[4 * node + 3] = (float)(all.reach * (1 + 1e-6));
    if (node >= t->leaves) {
        fill(t->words + 8 * (size_t)t->leaves + (size_t)KD_BODY_WORDS * (node - t->leaves), &t->bodies[balls[0].body], t->view);
        return;
    }
    qsort(balls, n, sizeof *balls, by[axis]);
    grow(t, 2 * node, balls, (n + 1) / 2);
    grow(t, 2 * node + 1, balls + (n + 1) / 2, n / 2);
}

enum kd_status kd_bodies_pack(const struct kd_seen_body *bodies, size_t n, double spin, double azimuth, double peak_k, struct kd_bodies_block *out, float *words,
                              struct kd_error *error)
{
    const struct view view = { spin, azimuth, peak_k };
    struct ball *balls = malloc((n ? n : 1) * sizeof *balls);
    const struct tree tree = { bodies, &view, words, leaves_of(n) };
    size_t seen = 0;
    if (!balls)
        return kd_error_set(error, KD_ENOMEM, "out of memory for bodies");
    memset(words, 0, kd_bodies_words(n) * sizeof *words);
    for (size_t i = 0; i < n; i++)
        if (is_seen(&bodies[i], spin))
            balls[seen++] = ball_of(&bodies[i], i, &view);
    double outermost = 1;
    for (size_t i = 0; i < seen; i++)
        outermost = fmax(outermost, bodies[balls[i].body].r + balls[i].reach);
    grow(&tree, 1, balls, seen);
    *out = (struct kd_bodies_block) {
        .least = (float)(1 / outermost), .x = words[4], .y = words[5], .z = words[6], .reach = words[7], .leaves = tree.leaves,
    };
    free(balls);
    return KD_OK;
}
