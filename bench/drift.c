/* Measures how far the first integrals of an orbit drift in ten thousand loops. Compares the symplectic methods with
 * Runge-Kutta's on the same equations, at the same number of evaluations. Arithmetic is in double precision. Sums are
 * not compensated, because compensation would hide differences between the methods.
 *
 * There are two systems of equations. E and L are constants in each. The first is in Mino time, with w = 1/r and u =
 * cos theta, which move independently of each other:
 *   w'^2 = W(w) = E^2 - m + 2m w + (a^2 (E^2 - m) - L^2 - Q) w^2 + 2K w^3 - a^2 Q w^4,  K = Q + (L - aE)^2,
 *   u'^2 = U(u) = Q + (a^2 (E^2 - m) - L^2 - Q) u^2 - a^2 (E^2 - m) u^4,
 * with m = 1 for matter and 0 for light. The second is Hamilton's equations in Cartesian Kerr-Schild coordinates, of r
 * (p.p - E^2 - f (E + l.p)^2 + m)/2. This is the Hamiltonian of rays_kerr_schild.comp, which explains it, with a mass
 * added.
 *
 * Two errors are computed from position and momentum: the error of the invariant p.p + m, in units of E^2 = 1 or m = 1,
 * and the error of Carter's constant.
 *
 * There are two orbits. The orbit of matter has a = 0.9, p = 8, e = 0.5, and is inclined by 60 degrees. Outside the
 * horizon light has no stable bound orbit, and errors of unstable orbits grow by e^(2 pi) a turn with every method.
 * Below r = 1 - (1 - a^2)^(1/3), inside the inner horizon, light has stable orbits, and all equations above are regular
 * there. The orbit of light is at about r = 0.3 and oscillates through the plane. */
#include "physics/orbit/timelike.h"
#include "physics/spacetime/hole.h"

#include <cJSON.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const int marks[] = { 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000 };
enum { MARKS = sizeof marks / sizeof *marks };

struct orbit {
    const char *name;
    double a, mass2, energy, momentum, carter, k;
    double r;             /* position at the start: the pericentre, in the equatorial plane */
    double mino, regular; /* length of a loop, from pericentre to pericentre: in Mino time, and in the parameter s with
                             d(affine) = r ds */
};

/* Number of elements of a state: w, u, w', u' in Mino time; x and p in Kerr-Schild coordinates, twice for Tao's method.
 * */
struct state { double y[12]; };

static double power2(const struct orbit *o) { return o->a * o->a * (o->energy * o->energy - o->mass2); }

static void pull(const struct orbit *o, const double y[2], double f[2])
{
    double a2 = o->a * o->a, w = y[0], u = y[1], second = power2(o) - o->momentum * o->momentum - o->carter;
    f[0] = o->mass2 + w * (second + w * (3 * o->k - 2 * a2 * o->carter * w));
    f[1] = u * (second - 2 * power2(o) * u * u);
}

static double radial(const struct orbit *o, double w)
{
    double a2 = o->a * o->a, e2 = o->energy * o->energy - o->mass2;
    return e2 + w * (2 * o->mass2 +
                     w * (power2(o) - o->momentum * o->momentum - o->carter + w * (2 * o->k - a2 * o->carter * w)));
}

/* One leapfrog step: moves the position, then the momentum (one evaluation of the forces), then the position. */
static void leapfrog(const struct orbit *o, struct state *s, double h)
{
    double f[2];
    for (int i = 0; i < 2; i++)
        s->y[i] += h / 2 * s->y[2 + i];
    pull(o, s->y, f);
    for (int i = 0; i < 2; i++) {
        s->y[2 + i] += h * f[i];
        s->y[i] += h / 2 * s->y[2 + i];
    }
}

/* H. Yoshida 1990, Phys. Lett. A 150, 262, table 1, solution A: weights of seven symmetric steps of order 2. */
static const double yoshida[7] = { 0.784513610477560, 0.235573213359357, -1.17767998417887, 1.315186320683906,
                                   -1.17767998417887, 0.235573213359357, 0.784513610477560 };

static void yoshida_6_mino(const struct orbit *o, struct state *s, double h)
{
    for (int i = 0; i < 7; i++)
        leapfrog(o, s, yoshida[i] * h);
}

/* J. Albrecht 1955, ZAMM 35, 100: the same method as in shaders/ray/nystroem.glsl. */
static void rkn_6(const struct orbit *o, struct state *s, double h)
{
    double k[5][2], y[2], *v = s->y + 2;
    pull(o, s->y, k[0]);
    for (int i = 0; i < 2; i++)
        y[i] = s->y[i] + h * (v[i] / 4 + h / 32 * k[0][i]);
    pull(o, y, k[1]);
    for (int i = 0; i < 2; i++)
        y[i] = s->y[i] + h * (v[i] / 2 + h / 24 * (4 * k[1][i] - k[0][i]));
    pull(o, y, k[2]);
    for (int i = 0; i < 2; i++)
        y[i] = s->y[i] + h * (0.75 * v[i] + h / 32 * (3 * k[0][i] + 4 * k[1][i] + 2 * k[2][i]));
    pull(o, y, k[3]);
    for (int i = 0; i < 2; i++)
        y[i] = s->y[i] + h * (v[i] + h / 14 * (6 * k[1][i] - k[2][i] + 2 * k[3][i]));
    pull(o, y, k[4]);
    for (int i = 0; i < 2; i++) {
        s->y[i] += h * (v[i] + h / 90 * (7 * k[0][i] + 24 * k[1][i] + 6 * k[2][i] + 8 * k[3][i]));
        v[i] += h / 90 * (7 * (k[0][i] + k[4][i]) + 32 * (k[1][i] + k[3][i]) + 12 * k[2][i]);
    }
}

static void flow_mino(const struct orbit *o, const double *y, double *d)
{
    d[0] = y[2];
    d[1] = y[3];
    pull(o, y, d + 2);
}

/* The error of the invariant p.p + m, and Carter's constant Q. */
static void integrals_mino(const struct orbit *o, const double *y, double *invariant, double *carter)
{
    double w = y[0], u = y[1], r = 1 / w, a = o->a, second = power2(o) - o->momentum * o->momentum;
    double swing =
        /* error of the equation u'^2 = U(u) */
        y[3] * y[3] - o->carter - u * u * (second - o->carter - power2(o) * u * u);
    double fall = r * r * r * r * (y[2] * y[2] - radial(o, w));
    *invariant = (fall / (r * (r - 2) + a * a) + swing / (1 - u * u)) / (r * r + a * a * u * u);
    *carter = o->carter + swing / (1 - u * u);
}

static double radius(double a, const double *x)
{
    double rho2 = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] - a * a, root = sqrt(rho2 * rho2 + 4 * a * a * x[2] * x[2]);
    return sqrt(rho2 > 0 ? 0.5 * (rho2 + root) : 2 * a * a * x[2] * x[2] / (root - rho2));
}

static double hamiltonian(const struct orbit *o, const double *x, const double *p) /* twice the Hamiltonian */
{
    double a = o->a, r = radius(a, x), q = r * r + a * a, f = 2 * r * r * r / (r * r * r * r + a * a * x[2] * x[2]);
    double s = o->energy + ((r * x[0] + a * x[1]) * p[0] + (r * x[1] - a * x[0]) * p[1]) / q + x[2] * p[2] / r;
    return p[0] * p[0] + p[1] * p[1] + p[2] * p[2] - o->energy * o->energy - f * s * s + o->mass2;
}

static void flow_at(const struct orbit *o, const double *x, const double *p, double *dx, double *dp)
{
    double a = o->a, r = radius(a, x), r2 = r * r, q = 1 / (r2 + a * a), den = 1 / (r2 * r2 + a * a * x[2] * x[2]);
    double f = 2 * r2 * r * den, l[3] = { (r * x[0] + a * x[1]) * q, (r * x[1] - a * x[0]) * q, x[2] / r };
    double dr[3] = { r2 * x[0] * r * den, r2 * x[1] * r * den, (r2 + a * a) * x[2] * r * den };
    double s = o->energy + l[0] * p[0] + l[1] * p[1] + l[2] * p[2], in_plane = x[0] * p[0] + x[1] * p[1];
    double along = in_plane * q - (l[0] * p[0] + l[1] * p[1]) * 2 * r * q - x[2] * p[2] / r2;
    double rest[3] = { (r * p[0] - a * p[1]) * q, (r * p[1] + a * p[0]) * q, p[2] / r };
    double h = 0.5 * (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] - o->energy * o->energy - f * s * s + o->mass2);
    for (int i = 0; i < 3; i++) {
        double df = (6 * r2 * dr[i] - f * (4 * r2 * r * dr[i] + (i == 2 ? 2 * a * a * x[2] : 0))) * den;
        dx[i] = r * (p[i] - f * s * l[i]);
        dp[i] = r * (0.5 * s * s * df + f * s * (dr[i] * along + rest[i])) - h * dr[i];
    }
}

static void flow_kerr_schild(const struct orbit *o, const double *y, double *d) { flow_at(o, y, y + 3, d, d + 3); }

/* M. Tao 2016, Phys. Rev. E 94, 043303: two copies of the phase space. Each copy is moved by the forces at the other
 * copy, and a rotation binds the two. Adjacent sub-steps of the first kind are merged. The value of omega used here is
 * the best for matter among 0.1, 0.15, 0.2, 0.3, 0.5, 1, 3 and 10. With a smaller omega the binding is too weak, and
 * the copies separate within a hundred loops. A larger omega costs accuracy. For light inside the inner horizon no
 * value is large enough. */
#define OMEGA 0.3

static void move(const struct orbit *o, double *x, double *p, double *other_x, double *other_p, double h)
{
    double dx[3], dp[3];
    flow_at(o, x, other_p, dx, dp);
    for (int i = 0; i < 3; i++) {
        p[i] += h * dp[i];
        other_x[i] += h * dx[i];
    }
}

static void tao_6(const struct orbit *o, struct state *s, double h)
{
    double *x = s->y, *p = s->y + 3, *x2 = s->y + 6, *p2 = s->y + 9;
    move(o, x, p, x2, p2, yoshida[0] * h / 2);
    for (int k = 0; k < 7; k++) {
        double c = cos(2 * OMEGA * yoshida[k] * h), n = sin(2 * OMEGA * yoshida[k] * h);
        move(o, x2, p2, x, p, yoshida[k] * h / 2);
        for (int i = 0; i < 3; i++) {
            double sx = (x[i] + x2[i]) / 2, sp = (p[i] + p2[i]) / 2, dx = (x[i] - x2[i]) / 2, dp = (p[i] - p2[i]) / 2;
            double rx = c * dx + n * dp, rp = c * dp - n * dx;
            x[i] = sx + rx, x2[i] = sx - rx, p[i] = sp + rp, p2[i] = sp - rp;
        }
        move(o, x2, p2, x, p, yoshida[k] * h / 2);
        move(o, x, p, x2, p2, (yoshida[k] + (k < 6 ? yoshida[k + 1] : 0)) * h / 2);
    }
}

static void integrals_kerr_schild(const struct orbit *o, const double *y, double *invariant, double *carter)
{
    const double *x = y, *p = y + 3;
    double a = o->a, r = radius(a, x), u = x[2] / r, s = sqrt((1 - u) * (1 + u)), l = x[0] * p[1] - x[1] * p[0];
    double p_theta = (x[0] * p[0] + x[1] * p[1]) * u / s - r * s * p[2];
    *invariant = hamiltonian(o, x, p);
    *carter = p_theta * p_theta + u * u * (l * l / (s * s) - power2(o));
}

static void runge_kutta_4(const struct orbit *o, struct state *s, double h, int n,
                          void (*flow)(const struct orbit *, const double *, double *))
{
    double k[4][6], y[6];
    static const double at[4] = { 0, 0.5, 0.5, 1 };
    for (int stage = 0; stage < 4; stage++) {
        for (int i = 0; i < n; i++)
            y[i] = s->y[i] + (stage ? at[stage] * h * k[stage - 1][i] : 0);
        flow(o, y, k[stage]);
    }
    for (int i = 0; i < n; i++)
        s->y[i] += h / 6 * (k[0][i] + 2 * (k[1][i] + k[2][i]) + k[3][i]);
}
static void rk_4_mino(const struct orbit *o, struct state *s, double h) { runge_kutta_4(o, s, h, 4, flow_mino); }
static void rk_4_kerr_schild(const struct orbit *o, struct state *s, double h)
{
    runge_kutta_4(o, s, h, 6, flow_kerr_schild);
}

static const struct method {
    const char *name, *equations;
    int evaluations; /* evaluations of the forces per step */
    void (*step)(const struct orbit *, struct state *, double h);
    bool kerr_schild;
} methods[] = {
    { "Yoshida 6", "Mino", 7, yoshida_6_mino, false },
    { "RK4", "Mino", 4, rk_4_mino, false },
    { "RKN6", "Mino", 5, rkn_6, false },
    { "Tao, Yoshida 6", "Kerr-Schild", 22, tao_6, true },
    { "RK4", "Kerr-Schild", 4, rk_4_kerr_schild, true },
};
enum { METHODS = sizeof methods / sizeof *methods };

/* State at the start: the pericentre in the equatorial plane, with radial velocity 0 and decreasing theta. In
 * Kerr-Schild coordinates p_r = (2rE - aL)/Delta. */
static struct state start(const struct orbit *o, bool kerr_schild)
{
    struct state s = { { 1 / o->r, 0, 0, sqrt(o->carter) } };
    if (!kerr_schild)
        return s;
    double a = o->a, r = o->r, q = r * r + a * a, p_r = (2 * r * o->energy - a * o->momentum) / (r * (r - 2) + a * a);
    /* Differentials at (x, y, z) = (r, a, 0): dr = (1, a/r, 0), d(theta) = (0, 0, -1/r), d(phi) = (-a, r, 0)/q + a
     * dr/q. */
    double along = p_r + a * o->momentum / q;
    const double y[6] = {
        r, a, 0, along - a * o->momentum / q, along * a / r + r * o->momentum / q, sqrt(o->carter) / r
    };
    memcpy(s.y, y, sizeof y);
    memcpy(s.y + 6, y, sizeof y);
    return s;
}

/* Measures the length of a loop by an order-6 method in fine steps. In Mino time it is the time from pericentre to
 * pericentre. In s it is the mean of ds = Sigma/r dtau over many loops, because loops differ in latitude. */
static void measure_loop(struct orbit *o)
{
    enum { FINE = 4096, MANY = 64 };
    struct state s = start(o, false), last;
    double h = 1e-3 / sqrt(fabs(power2(o)) + o->momentum * o->momentum + o->carter), sum = 0, tau = 0;
    do {
        last = s;
        rkn_6(o, &s, h);
        tau += h;
    } while (!(last.y[2] > 0 && s.y[2] <= 0)); /* w = 1/r grows before a pericentre */
    o->mino = tau - h * s.y[2] / (s.y[2] - last.y[2]);
    s = start(o, false);
    for (int i = 0; i < FINE * MANY; i++) {
        double r = 1 / s.y[0];
        sum += r + o->a * o->a * s.y[1] * s.y[1] / r;
        rkn_6(o, &s, o->mino / FINE);
    }
    o->regular = o->mino * sum / (FINE * MANY);
}

static struct orbit matter(void)
{
    struct kd_orbit k;
    if (kd_orbit_from_shape(kd_hole(0.9), 8, 0.5, 0.5, &k, NULL))
        abort(); /* cannot happen, because this orbit exists */
    return (struct orbit) { .name = "matter",
                            .a = k.hole.a,
                            .mass2 = 1,
                            .energy = k.energy,
                            .momentum = k.momentum,
                            .carter = k.carter,
                            .k = k.k,
                            .r = 1 / k.w_high };
}

/* Starts from the spherical orbit at r (Bardeen 1973, eqs. 48 and 49) and lowers Q, so that r oscillates. */
static struct orbit light(void)
{
    double a = 0.9, r = 0.3, low = 0.05, high = r;
    struct orbit o = { .name = "light", .a = a, .energy = 1 };
    o.momentum = (r * r * (3 - r) - a * a * (r + 1)) / (a * (r - 1));
    o.carter = 0.98 * r * r * r * (4 * a * a - r * (r - 3) * (r - 3)) / (a * a * (r - 1) * (r - 1));
    o.k = o.carter + (o.momentum - a) * (o.momentum - a);
    for (int i = 0; i < 100; i++) {
        double middle = (low + high) / 2;
        *(radial(&o, 1 / middle) > 0 ? &high : &low) = middle;
    }
    o.r = high;
    return o;
}

/* Measures one row: the largest values of the two errors up to each mark. lost: the loop in which the error of the
 * invariant reached its unit, or 0 if it did not. */
static void measure(const struct orbit *o, const struct method *m, int steps, cJSON *row)
{
    void (*integrals)(const struct orbit *, const double *, double *, double *) =
        m->kerr_schild ? integrals_kerr_schild : integrals_mino;
    struct state s = start(o, m->kerr_schild);
    double h = (m->kerr_schild ? o->regular : o->mino) / steps, worst[2] = { 0 }, invariant, carter;
    cJSON *lists[2] = { cJSON_AddArrayToObject(row, "invariant"), cJSON_AddArrayToObject(row, "carter") };
    int lost = 0;
    for (int loop = 1, mark = 0; mark < MARKS && !lost; loop++) {
        for (int k = 0; k < steps && !lost; k++) {
            m->step(o, &s, h);
            integrals(o, s.y, &invariant, &carter);
            worst[0] = fmax(worst[0], fabs(invariant));
            worst[1] = fmax(worst[1], fabs(carter / o->carter - 1));
            lost = fabs(invariant) < 1 ? 0 : loop;
        }
        if (loop == marks[mark] && !lost) {
            for (int q = 0; q < 2; q++)
                cJSON_AddItemToArray(lists[q], cJSON_CreateNumber(worst[q]));
            mark++;
        }
    }
    cJSON_AddNumberToObject(row, "lost", lost);
}

int main(void)
{
    static const int budgets[] = { 704, 2816 }; /* evaluations of the forces per loop, for each row */
    struct orbit orbits[2] = { matter(), light() };
    cJSON *root = cJSON_CreateObject(), *list = cJSON_AddArrayToObject(root, "loops"), *rows;
    for (int k = 0; k < MARKS; k++)
        cJSON_AddItemToArray(list, cJSON_CreateNumber(marks[k]));
    rows = cJSON_AddArrayToObject(root, "rows");
    for (int k = 0; k < 2 * 2 * METHODS; k++) {
        struct orbit *o = &orbits[k / (2 * METHODS)];
        const struct method *m = &methods[k % (2 * METHODS) / 2];
        int steps = (budgets[k % 2] + m->evaluations / 2) / m->evaluations;
        if (!o->mino)
            measure_loop(o);
        cJSON *row = cJSON_CreateObject();
        cJSON_AddStringToObject(row, "orbit", o->name);
        cJSON_AddStringToObject(row, "equations", m->equations);
        cJSON_AddStringToObject(row, "method", m->name);
        cJSON_AddNumberToObject(row, "steps", steps);
        cJSON_AddNumberToObject(row, "evaluations", steps * m->evaluations);
        measure(o, m, steps, row);
        cJSON_AddItemToArray(rows, row);
    }
    char *text = cJSON_Print(root);
    bool good = text && printf("%s\n", text) > 0;
    cJSON_free(text);
    cJSON_Delete(root);
    return !good;
}
