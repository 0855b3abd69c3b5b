#include "null_series.h"

#include <float.h>
#include <math.h>

typedef long double number;

enum { ORDER = 30, STEPS_MAX = 4000 };

struct motion { number a, lambda, eta, A, K, C, horizon; };
struct place { number w, dw, n[3], dn[3], chi; };
struct series { number w[ORDER + 1], n[3][ORDER + 1], chi[ORDER + 1]; };

void series_angle(double degrees, long double *cosine, long double *sine)
{
    const number unit = 3.14159265358979323846264338327950288L / 180,
                 from = degrees > 90 ? 180.0L - degrees : (number)degrees;
    *cosine = from > 45 ? sinl((90 - from) * unit) : cosl(from * unit);
    *cosine = degrees > 90 ? -*cosine : *cosine;
    *sine = from > 45 ? cosl((90 - from) * unit) : sinl(from * unit);
}

static number product(const number *x, const number *y, int k)
{
    number sum = 0;
    for (int j = 0; j <= k; j++)
        sum += x[j] * y[k - j];
    return sum;
}

static void expand(const struct motion *m, const struct place *at, struct series *s)
{
    number w2[ORDER + 1], w3[ORDER + 1], z2[ORDER + 1], a2 = m->a * m->a, drag[ORDER + 1];
    s->w[0] = at->w, s->w[1] = at->dw, s->chi[0] = at->chi;
    for (int i = 0; i < 3; i++)
        s->n[i][0] = at->n[i], s->n[i][1] = at->dn[i];
    for (int k = 0; k < ORDER; k++) {
        w2[k] = product(s->w, s->w, k);
        w3[k] = product(w2, s->w, k);
        z2[k] = product(s->n[2], s->n[2], k);
        /* chi' = a w (2 - a lambda w)/(1 - 2w + a^2 w^2) */
        number rest = m->a * (2 * s->w[k] - m->a * m->lambda * w2[k]);
        for (int j = 1; j <= k; j++)
            rest -= (a2 * w2[j] - 2 * s->w[j]) * drag[k - j];
        drag[k] = rest / (1 - 2 * s->w[0] + a2 * w2[0]);
        s->chi[k + 1] = drag[k] / (k + 1);
        if (k == ORDER - 1)
            break;
        number share = 1.0L / ((k + 1) * (k + 2));
        s->w[k + 2] = (m->A * s->w[k] + 3 * m->K * w2[k] + 2 * m->C * w3[k]) * share;
        for (int i = 0; i < 3; i++)
            s->n[i][k + 2] = ((i == 2 ? a2 * s->n[2][k] : 0) - (m->eta + m->lambda * m->lambda) * s->n[i][k] -
                              2 * a2 * product(z2, s->n[i], k)) *
                             share;
    }
}

static number value(const number *c, number h)
{
    number sum = 0;
    for (int k = ORDER; k >= 0; k--)
        sum = sum * h + c[k];
    return sum;
}

static number slope(const number *c, number h)
{
    number sum = 0;
    for (int k = ORDER; k >= 1; k--)
        sum = sum * h + k * c[k];
    return sum;
}

/* The root of series = level in (0, h). The values at the two ends have different signs. */
static number root(const number *c, number level, number h)
{
    number low = 0, high = h, side = value(c, h) - level, x = 0.5L * h;
    for (int i = 0; i < 200; i++) {
        number f = value(c, x) - level, d = slope(c, x), next = x - f / d;
        if ((f > 0) == (side > 0))
            high = x;
        else
            low = x;
        if (!(next > low && next < high))
            next = 0.5L * (low + high);
        if (fabsl(next - x) <= LDBL_EPSILON * fabsl(x))
            return next;
        x = next;
    }
    return x;
}

/* Radius of convergence, estimated from the last coefficients. chi is not included while the ray falls in, because
 * azimuths end at the horizon. */
static number radius_of(const struct series *s, bool with_chi)
{
    number least = INFINITY;
    for (int j = ORDER - 9; j <= ORDER; j += 9) {
        number most = 1e-4000L;
        for (int k = j - 1; k <= j; k++) {
            most = fmaxl(most, fabsl(s->w[k] * (k < ORDER)));
            if (with_chi)
                most = fmaxl(most, fabsl(s->chi[k]));
            for (int i = 0; i < 3; i++)
                most = fmaxl(most, fabsl(s->n[i][k] * (k < ORDER)));
        }
        least = fminl(least, powl(most, -1.0L / j));
    }
    return least;
}

/* The angle by which n turns about the axis in a step. */
static number turned(const struct series *s, number h)
{
    number x0 = s->n[0][0], y0 = s->n[1][0], x1 = value(s->n[0], h), y1 = value(s->n[1], h);
    return x0 != 0 || y0 != 0 ? atan2l(x0 * y1 - y0 * x1, x0 * x1 + y0 * y1) : atan2l(y1, x1);
}

static struct motion motion_of(const struct series_ray *r)
{
    struct motion m = { .a = r->spin, .lambda = -r->alpha * r->sine };
    m.eta = (r->alpha - r->spin) * (r->alpha + r->spin) * r->cosine * r->cosine + r->beta * r->beta;
    m.A = m.a * m.a - m.eta - m.lambda * m.lambda;
    m.K = m.eta + (m.lambda - m.a) * (m.lambda - m.a);
    m.C = -m.a * m.a * m.eta;
    m.horizon = 1 / (1 + sqrtl((1 - m.a) * (1 + m.a)));
    return m;
}

static struct place start_of(const struct series_ray *r, const struct motion *m)
{
    struct place p = { .n = { r->sine, 0, r->cosine }, .dn = { -r->beta * r->cosine, r->alpha, r->beta * r->sine } };
    if (r->sine == 0) { /* on the axis azimuths count from the direction in the image */
        p.dn[0] = hypotl(r->alpha, r->beta);
        p.dn[1] = p.dn[2] = 0;
    }
    p.w = isinf(r->radius) ? 0 : 1 / r->radius;
    p.dw = sqrtl(fmaxl(1 + p.w * p.w * (m->A + p.w * (2 * m->K + m->C * p.w)), 0)) * (r->outward ? -1 : 1);
    return p;
}

struct series_path series_trace(const struct series_ray *ray, int orders)
{
    const struct motion m = motion_of(ray);
    struct place p = start_of(ray, &m);
    struct series_path out = { .fate = SERIES_LOST };
    number phi = ray->sine == 0 ? atan2l(ray->alpha, -ray->beta * ray->cosine) : 0;
    number longest = 1 / sqrtl(1 + m.eta + m.lambda * m.lambda + m.a * m.a);
    for (int i = 0; i < STEPS_MAX; i++) {
        struct series s;
        expand(&m, &p, &s);
        bool falling = p.dw > 0 && p.w > m.horizon * 0.999999L, ends = false;
        number h = fminl(radius_of(&s, !falling) / 5, longest), end = value(s.w, h);
        if (end <= 0 || end >= m.horizon) {
            h = root(s.w, end <= 0 ? 0 : m.horizon, h);
            ends = true;
        }
        if (p.n[2] != 0 && p.n[2] * value(s.n[2], h) < 0) {
            number x = root(s.n[2], 0, h), w = value(s.w, x);
            if (w > 0 && w < m.horizon && out.crossings < orders && out.crossings < SERIES_CROSSINGS) {
                out.r[out.crossings] = 1 / w;
                out.phi[out.crossings++] = phi + turned(&s, x) - value(s.chi, x);
            }
        }
        phi += turned(&s, h);
        struct place next = { value(s.w, h), slope(s.w, h), { 0 }, { 0 }, value(s.chi, h) };
        for (int k = 0; k < 3; k++)
            next.n[k] = value(s.n[k], h), next.dn[k] = slope(s.n[k], h);
        p = next;
        if (ends) {
            out.fate = end <= 0 ? SERIES_ESCAPED : SERIES_CAPTURED;
            out.u = p.n[2];
            out.sky_phi = phi - p.chi;
            return out;
        }
    }
    return out;
}
