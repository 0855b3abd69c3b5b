#include "physics/disk/returning.h"

#include "base/parallel.h"
#include "base/pause.h"
#include "physics/disk/thin_disk.h"
#include "physics/math/quadrature.h"
#include "physics/null/null_geodesic.h"
#include "physics/null/null_plane.h"
#include "physics/spacetime/kerr.h"

#include <math.h>
#include <pthread.h>
#include <stdint.h>
#include <string.h>

enum {
    N = KD_RETURNING_RINGS,
    ORDERS = 5, /* number of crossings of the plane that are computed. Without spin, each further crossing has e^-pi
                 * of the light of the one before; next to a = 1 it has more: at a = 0.998 the sixth has 1e-5 of the
                 * ISCO's light. */
    SIDES = 16, /* number of Gauss points in chi, in each of at most PANELS panels */
    PANELS = 3,
    DEPTH = 12, /* number of Gauss points along each chi */
};

/* A ray is traced by series if the ratio of its E at infinity to its energy in the frame of zero angular momentum is
 * below this. For E -> 0 the labels L/E and Q/E^2 of the closed form grow without bound. */
#define SLOW 1e-3

/* Gas on a circular orbit at r, and the frame of zero angular momentum there. */
struct ring { double r, ut, omega, energy, momentum, lapse, drag, girth; };

static struct ring ring_of(const struct kd_hole *hole, double r)
{
    const struct kd_metric_scalars m = kd_metric_at(hole, r, 0);
    return (struct ring) { .r = r,
                           .ut = kd_kerr_ut(hole, r),
                           .omega = kd_kerr_omega(hole, r),
                           .energy = kd_kerr_energy(hole, r),
                           .momentum = kd_kerr_momentum(hole, r),
                           .lapse = sqrt(m.lapse2),
                           .drag = m.omega,
                           .girth = sqrt(m.area / m.sigma) };
}

/* A photon whose energy is 1 in the frame of zero angular momentum. energy, momentum, polar: E, L and |p_theta|. seen:
 * energy in the gas's frame. */
struct light { double energy, momentum, polar, seen; };

static struct light light_of(const struct ring *o, double sin_rho, double cos_chi)
{
    const double along = sin_rho * cos_chi, l = o->girth * along;
    return (struct light) { .energy = o->lapse + o->drag * l,
                            .momentum = l,
                            .polar = o->r * sin_rho * sqrt((1 - cos_chi) * (1 + cos_chi)),
                            .seen = o->ut * (o->lapse + (o->drag - o->omega) * l) };
}

/* sin(rho) from x = ln tan(rho/2). The variable x resolves rho near 0 and near pi. This is needed because the dark disk
 * round the hole is a small part of the sky for rings at large r, and nearly all of the sky for rings close to the
 * hole. */
static double sine(double x) { return 1 / cosh(x); }

/* The radii of a ray with E > 0, in closed form. */
static struct kd_null_path path_of(const struct kd_hole *hole, const struct ring *o, const struct light *p, double x,
                                   int n)
{
    const struct kd_null_ray ray = { .hole = *hole,
                                     .radius = o->r,
                                     .sin_theta = 1,
                                     .alpha = -p->momentum / p->energy,
                                     .beta = p->polar / p->energy,
                                     .outward = x > 0,
                                     .orders = n + 1 };
    return kd_null_trace_radii(&ray);
}

/* 1/r of crossing n; INFINITY if the ray is captured before that crossing, -INFINITY if it escapes before it. */
static double follow(const struct kd_hole *hole, const struct ring *o, double cos_chi, double x, int n)
{
    const struct light p = light_of(o, sine(x), cos_chi);
    if (p.energy < SLOW) {
        const struct kd_vantage at = { .hole = *hole, .r = o->r, .u = 0, .s = 1 };
        const struct kd_covector photon = { p.energy, p.momentum, p.polar,
                                            -tanh(x) * o->r * sqrt(kd_hole_delta(hole, o->r)) };
        const double r = kd_null_plane_radius(&at, &photon, n);
        return isfinite(r) ? 1 / r : -r;
    }
    const struct kd_null_path path = path_of(hole, o, &p, x, n);
    return n < path.crossings ? 1 / path.crossing[n].r : path.fate == KD_NULL_ESCAPED ? -INFINITY : INFINITY;
}

/* Finds the x for which crossing n is at 1/r = w, from a guess. 1/r decreases with x. */
static double edge(const struct kd_hole *hole, const struct ring *o, double cos_chi, int n, double w, double guess)
{
    double low = -60, high = 40, x = guess, x0 = NAN, f0 = NAN, step = 0.25;
    bool below = false, above = false;
    for (int i = 0; i < 100 && high - low > 1e-11 * (1 + fabs(x)); i++) {
        const double f = follow(hole, o, cos_chi, x, n) - w;
        if (f > 0)
            low = x, below = true;
        else
            high = x, above = true;
        if (fabs(f) < 1e-10)
            break;
        const double slope = (f - f0) / (x - x0);
        double next = isfinite(f) && isfinite(f0) && slope < 0 ? x - f / slope : NAN;
        if (isfinite(f))
            x0 = x, f0 = f;
        if (!(next > low && next < high)) {
            next = below && above ? 0.5 * (low + high) : f > 0 ? x + step : x - step;
            step *= 2;
        }
        x = next;
    }
    return x;
}

/* Parts of the sky along one chi, as ranges of x. In order n the disk is seen from x = in[n] to x = out[n] < in[n - 1].
 * Light with x between out[n] and in[n - 1] escapes, and light with x below in[orders - 1] falls in. The second order
 * exists where a ray can pass between the ISCO and the hole. */
struct parts {
    int orders;
    double in[ORDERS], out[ORDERS];
};

static struct parts parts_of(const struct kd_hole *hole, const struct ring *o, double isco, double cos_chi,
                             const struct parts *guess)
{
    struct parts parts = *guess;
    parts.in[0] = edge(hole, o, cos_chi, 0, 1 / isco, guess->in[0]);
    parts.out[0] = edge(hole, o, cos_chi, 0, 0, guess->out[0]);
    parts.orders = 1;
    for (int n = 1; n < ORDERS && follow(hole, o, cos_chi, parts.in[n - 1], n) < 1 / isco; n++) {
        parts.in[n] = edge(hole, o, cos_chi, n, 1 / isco, guess->in[n]);
        parts.out[n] = fmin(edge(hole, o, cos_chi, n, 0, guess->out[n]), parts.in[n - 1]);
        parts.orders++;
    }
    return parts;
}

/* Gauss points on (0, 1) and their weights. side: for the integral over chi. depth: for the integral along one chi. */
struct rule { double side[SIDES], side_weight[SIDES], depth[DEPTH], depth_weight[DEPTH]; };

static struct rule rule_of(void)
{
    struct rule rule;
    kd_gauss_legendre(SIDES, rule.side, rule.side_weight);
    kd_gauss_legendre(DEPTH, rule.depth, rule.depth_weight);
    return rule;
}

/* 1/r of the second crossing, for the ray whose first crossing is at the ISCO. */
static double beyond(const struct kd_hole *hole, const struct ring *o, double isco, double cos_chi, double *guess)
{
    *guess = edge(hole, o, cos_chi, 0, 1 / isco, *guess);
    return follow(hole, o, cos_chi, *guess, 1);
}

/* The sky of a ring, which is processed one chi after the other. The limits of the parts of the sky are smooth
 * functions of chi within each panel. Panels end at the values of chi for which the second crossing (see `beyond`) is
 * at infinity, and for which it is at the ISCO. Integrands are smooth in chi up to the plane, where mu vanishes as
 * sin(chi). */
struct sky {
    int panels;
    double ends[PANELS + 1];
    struct parts parts; /* parts of the sky for the chi that was processed last */
};

static struct sky sky_of(const struct kd_hole *hole, const struct ring *o, double isco)
{
    const double levels[] = { 0, 1 / isco }, near = 1e-3;
    double guess = log(2.6 / o->r), found[2];
    const double first = beyond(hole, o, isco, cos(near), &guess), last = beyond(hole, o, isco, -cos(near), &guess);
    struct sky sky = { .panels = 0 };
    for (int i = 0; i < 2; i++) {
        double low = 0, high = M_PI;
        if ((first < levels[i]) == (last < levels[i]))
            continue;
        for (int k = 0; k < 16; k++) {
            const double chi = 0.5 * (low + high);
            *((beyond(hole, o, isco, cos(chi), &guess) < levels[i]) == (first < levels[i]) ? &low : &high) = chi;
        }
        found[sky.panels++] = 0.5 * (low + high);
    }
    const bool swapped = sky.panels == 2 && found[1] < found[0];
    for (int i = 0; i < sky.panels; i++)
        sky.ends[i + 1] = found[swapped ? 1 - i : i];
    sky.ends[++sky.panels] = M_PI;
    for (int n = 0; n < ORDERS; n++)
        sky.parts.in[n] = sky.parts.out[n] = log(2.6 / o->r);
    return sky;
}

static int sides(const struct sky *sky) { return sky->panels * SIDES; }

/* Computes the parts for chi number i. Returns cos(chi) and sin(chi) dchi. */
struct side { double cos_chi, width; };

static struct side side_of(const struct kd_hole *hole, const struct ring *o, double isco, const struct rule *rule,
                           struct sky *sky, int i)
{
    const double *ends = sky->ends + i / SIDES, chi = ends[0] + (ends[1] - ends[0]) * rule->side[i % SIDES];
    sky->parts = parts_of(hole, o, isco, cos(chi), &sky->parts);
    return (struct side) { cos(chi), (ends[1] - ends[0]) * rule->side_weight[i % SIDES] * sin(chi) };
}

/* The part of one chi between two values of x. wide: true if the part is integrated in rho. Otherwise it is integrated
 * in t = cot(rho/2), because at large r the light of the disk arrives close to the dark disk. */
struct strip {
    struct side side;
    double from, to;
    bool wide;
};

static struct strip strip_of(struct side side, double from, double to)
{
    return (struct strip) { side, exp(-from), exp(-to), false };
}

static struct strip strip_wide(struct side side, double from, double to)
{
    return (struct strip) { side, 2 * atan(exp(from)), 2 * atan(exp(to)), true };
}

/* Value of mu dOmega for Gauss point k of a strip, and the x of that point. mu dOmega = sin^2(rho) drho dcos(chi), with
 * drho = -2 dt/(1 + t^2). */
static double point_of(const struct strip *s, const struct rule *rule, int k, double *x)
{
    const double place = s->from + (s->to - s->from) * rule->depth[k],
                 step = (s->to - s->from) * rule->depth_weight[k] * s->side.width;
    *x = s->wide ? log(tan(0.5 * place)) : -log(place);
    return pow(sine(*x), 2) * (s->wide ? step : -2 * step / (1 + place * place));
}

static double emitted(enum kd_limb limb, double mu) { return kd_limb_at(limb, mu) * kd_limb_scale(limb) / M_PI; }

/* Adds the light that a ring sends into a strip of its sky: the strip's shares of the photons, and of their energy at
 * infinity. */
static void add_strip(const struct ring *o, enum kd_limb limb, const struct rule *rule, struct strip strip,
                      double *photons, double *energy)
{
    for (int k = 0; k < DEPTH; k++) {
        double x;
        const double solid = point_of(&strip, rule, k, &x);
        const struct light p = light_of(o, sine(x), strip.side.cos_chi);
        const double part = solid / pow(p.seen, 3) * emitted(limb, p.polar / (o->r * p.seen));
        *photons += part;
        *energy += part * p.energy / (p.seen * o->energy);
    }
}

/* Adds the light along one chi to the sum for each destination. */
static void add_side(const struct ring *o, enum kd_limb limb, const struct rule *rule, const struct parts *parts,
                     struct side side, struct kd_returning_ring *sum)
{
    struct kd_returning_shares *p = &sum->photons, *e = &sum->energy;
    add_strip(o, limb, rule, strip_wide(side, parts->out[0], INFINITY), &p->escapes, &e->escapes);
    for (int n = 0; n < parts->orders; n++) {
        add_strip(o, limb, rule, strip_of(side, parts->in[n], parts->out[n]), &p->returns, &e->returns);
        if (n && parts->out[n] < parts->in[n - 1])
            add_strip(o, limb, rule, strip_wide(side, parts->out[n], parts->in[n - 1]), &p->escapes, &e->escapes);
    }
    add_strip(o, limb, rule, strip_wide(side, -INFINITY, parts->in[parts->orders - 1]), &p->falls_in, &e->falls_in);
}

static double total(const struct kd_returning_shares *s) { return s->returns + s->falls_in + s->escapes; }

struct kd_returning_ring kd_returning_ring(const struct kd_hole *hole, enum kd_limb limb, double r)
{
    const struct rule rule = rule_of();
    const struct ring ring = ring_of(hole, r);
    const double isco = kd_kerr_isco(hole);
    struct kd_returning_ring sum = { .error = 0 };
    struct sky sky = sky_of(hole, &ring, isco);
    for (int j = 0; j < sides(&sky); j++) {
        const struct side side = side_of(hole, &ring, isco, &rule, &sky, j);
        add_side(&ring, limb, &rule, &sky.parts, side, &sum);
        if (kd_pause())
            break;
    }
    sum.error = fmax(fabs(total(&sum.photons) - 1), fabs(total(&sum.energy) - 1));
    return sum;
}

void kd_returning_rays(const struct kd_hole *hole, double r,
                       void (*each)(void *user, const struct kd_returning_ray *ray), void *user)
{
    const struct rule rule = rule_of();
    const struct ring ring = ring_of(hole, r);
    const double isco = kd_kerr_isco(hole);
    struct sky sky = sky_of(hole, &ring, isco);
    for (int j = 0; j < sides(&sky); j++) {
        const struct side side = side_of(hole, &ring, isco, &rule, &sky, j);
        for (int n = 0; n < sky.parts.orders; n++) {
            const struct strip strip = strip_of(side, sky.parts.in[n], sky.parts.out[n]);
            for (int k = 0; k < DEPTH; k++) {
                double x;
                const double solid = point_of(&strip, &rule, k, &x);
                const struct light p = light_of(&ring, sine(x), side.cos_chi);
                if (p.energy < SLOW)
                    continue;
                const struct kd_null_path path = path_of(hole, &ring, &p, x, n);
                if (n < path.crossings)
                    each(user, &(struct kd_returning_ray) { .from = fmax(path.crossing[n].r, isco),
                                                            .energy = p.energy,
                                                            .momentum = p.momentum,
                                                            .polar = p.polar,
                                                            .order = n,
                                                            .leaves = path.crossing[n].sense,
                                                            .arrives = x > 0 ? -1 : 1,
                                                            .solid = solid });
            }
        }
        if (kd_pause())
            return;
    }
}

/* Weights of Chebyshev's nodes for interpolation at s, by the barycentric formula (J.-P. Berrut & L. N. Trefethen 2004,
 * SIAM Review 46, 501). */
static void weights_at(const double *nodes, double s, double *weights)
{
    double sum = 0;
    for (int j = 0; j < N; j++) {
        const double gap = s - nodes[j];
        if (gap == 0) {
            memset(weights, 0, N * sizeof *weights);
            weights[j] = 1;
            return;
        }
        weights[j] = (j % 2 ? -1 : 1) * sin(M_PI * (j + 0.5) / N) / gap;
        sum += weights[j];
    }
    for (int j = 0; j < N; j++)
        weights[j] /= sum;
}

static double at_nodes(const double *nodes, const double *values, double s)
{
    double weights[N], sum = 0;
    weights_at(nodes, s, weights);
    for (int j = 0; j < N; j++)
        sum += weights[j] * values[j];
    return sum;
}

/* Light that the rings receive, times r^3. flux, deficit, energy: light from gas that emits no returned light. flux_of,
 * deficit_of: matrices that give F_ret and L F_ret - l for light that is described by `more`. */
struct kernel {
    double flux[N], deficit[N], energy[N]; /* at each ring, times r^3: F_ret, L F_ret - l, and energy at infinity */
    double flux_of[N][N], deficit_of[N][N];
    double stress_of[N][N]; /* matrix that gives r^3 F_t from the deficits L F_ret - l */
};

static void receive(struct kd_returning *table, struct kernel *kernel, int i, const struct ring *o,
                    const struct light *p, double solid, double from)
{
    const struct kd_hole *hole = &table->hole;
    const double left = kd_kerr_ut(hole, from) * (p->energy - kd_kerr_omega(hole, from) * p->momentum),
                 part = pow(o->r, 3) * solid * p->seen / pow(left, 4) * emitted(table->limb, p->polar / (from * left)),
                 deficit = o->momentum - p->momentum / p->seen;
    const double own = part * kd_disk_flux_page_thorne(hole, from);
    const double warmer = part * (p->seen / left) / pow(from, 3);
    double weights[N];
    kernel->flux[i] += own;
    kernel->deficit[i] += own * deficit;
    kernel->energy[i] += own * p->energy / p->seen;
    weights_at(table->s, sqrt(table->isco / from), weights);
    for (int j = 0; j < N; j++) {
        const double more = part / pow(from, 3) * weights[j];
        kernel->flux_of[i][j] += more;
        kernel->deficit_of[i][j] += more * deficit;
        table->warmth_of[i][j] += warmer * pow(from, -0.75) * weights[j];
        table->echo_of[i][j] += warmer * weights[j];
    }
}

static void receive_along(struct kd_returning *table, struct kernel *kernel, int i, const struct ring *o,
                          const struct rule *rule, struct strip strip, int order)
{
    for (int k = 0; k < DEPTH; k++) {
        double x;
        const double solid = point_of(&strip, rule, k, &x);
        const double w = follow(&table->hole, o, strip.side.cos_chi, x, order);
        const struct light p = light_of(o, sine(x), strip.side.cos_chi);
        if (w > 0 && isfinite(w))
            receive(table, kernel, i, o, &p, solid, fmax(1 / w, table->isco));
    }
}

/* Fills stress_of. The integral from the ISCO to a ring is the integral, from s to 1, of the polynomial through the
 * nodes. */
static void fill_stress(const struct kd_returning *table, const struct rule *rule, struct kernel *kernel)
{
    for (int i = 0; i < N; i++) {
        const double r = table->isco / pow(table->s[i], 2),
                     scale = -kd_kerr_shear(&table->hole, r) * pow(r * kd_kerr_ut(&table->hole, r), 2);
        for (int k = 0; k < DEPTH; k++) {
            const double s = table->s[i] + (1 - table->s[i]) * rule->depth[k];
            double weights[N];
            weights_at(table->s, s, weights);
            for (int j = 0; j < N; j++)
                kernel->stress_of[i][j] -= scale * (1 - table->s[i]) * rule->depth_weight[k] * weights[j] * 2 *
                                           table->s[j] / table->isco /
                                           kd_kerr_ut(&table->hole, table->isco / pow(table->s[j], 2));
        }
    }
}

static double times(const double *row, const double *x)
{
    double sum = 0;
    for (int j = 0; j < N; j++)
        sum += row[j] * x[j];
    return sum;
}

/* Iterates until the disk's flux converges. Each step adds one more scattering. */
static void converge(struct kd_returning *table, const struct kernel *kernel)
{
    double change = 1;
    for (table->steps = 0; change > 1e-12 && table->steps < 1000; table->steps++) {
        double deficit[N], next[N], largest = 0;
        change = 0;
        for (int i = 0; i < N; i++) {
            table->back[i] = kernel->flux[i] + times(kernel->flux_of[i], table->more);
            deficit[i] = kernel->deficit[i] + times(kernel->deficit_of[i], table->more);
        }
        for (int i = 0; i < N; i++) {
            next[i] = table->back[i] + times(kernel->stress_of[i], deficit);
            change = fmax(change, fabs(next[i] - table->more[i]));
            largest = fmax(largest, fabs(next[i]));
        }
        change /= largest;
        memcpy(table->more, next, sizeof next);
    }
}

/* Integrates the shares over the disk, with 4 pi r dr = 8 pi r_isco^2 ds/s^5, and divides them by the efficiency, which
 * is the integral of F_0 E. */
static void share_out(struct kd_returning *table, const struct kernel *kernel)
{
    enum { POINTS = 96 };
    double at[POINTS], weight[POINTS], arrives = 0;
    const struct kd_hole *hole = &table->hole;
    const double efficiency = kd_kerr_efficiency(hole);
    kd_gauss_legendre(POINTS, at, weight);
    for (int k = 0; k < POINTS; k++) {
        const double s = at[k], r = table->isco / (s * s),
                     area = weight[k] * 8 * M_PI * table->isco * table->isco / pow(s, 5) / efficiency,
                     own = area * kd_kerr_energy(hole, r) * kd_disk_flux_page_thorne(hole, r),
                     all = area * kd_kerr_energy(hole, r) * kd_returning_flux(table, r);
        const struct kd_returning_shares shares = kd_returning_shares_at(table, &table->energy, r);
        table->first.returns += own * shares.returns;
        table->first.falls_in += own * shares.falls_in;
        table->first.escapes += own * shares.escapes;
        table->lastly.falls_in += all * shares.falls_in;
        table->lastly.escapes += all * shares.escapes;
        arrives += area * at_nodes(table->s, kernel->energy, s) / (r * r * r);
    }
    table->error = fmax(fabs(arrives / table->first.returns - 1), fabs(total(&table->lastly) - 1));
}

/* Finds the largest F within 4 times the ISCO. It takes the largest value on a grid, and then a ternary search between
 * that value's neighbours. */
static void find_hottest(struct kd_returning *table)
{
    enum { CELLS = 256, THIRDS = 40 };
    const double cell = 3 * table->isco / CELLS;
    for (int i = 0; i <= CELLS; i++) {
        const double r = table->isco + cell * i, flux = kd_returning_flux(table, r);
        if (flux > table->largest)
            table->largest = flux, table->hottest = r;
    }
    double low = fmax(table->hottest - cell, table->isco), high = table->hottest + cell;
    for (int i = 0; i < THIRDS; i++) {
        const double third = (high - low) / 3;
        if (kd_returning_flux(table, low + third) < kd_returning_flux(table, high - third))
            low += third;
        else
            high -= third;
    }
    table->hottest = 0.5 * (low + high);
    table->largest = kd_returning_flux(table, table->hottest);
}

/* State for making rings in parallel. A ring's row of the kernel and its shares of light do not depend on other rings.
 */
struct making {
    struct kd_returning *table;
    struct kernel kernel;
    struct rule rule;
};

static void make_ring(void *user, size_t i)
{
    struct making *m = user;
    struct kd_returning *table = m->table;
    const struct kd_hole *hole = &table->hole;
    const struct ring ring = ring_of(hole, table->isco / pow(table->s[i], 2));
    struct sky sky = sky_of(hole, &ring, table->isco);
    struct kd_returning_ring shares = { .error = 0 };
    for (int j = 0; j < sides(&sky); j++) {
        const struct side side = side_of(hole, &ring, table->isco, &m->rule, &sky, j);
        const struct parts *parts = &sky.parts;
        add_side(&ring, table->limb, &m->rule, parts, side, &shares);
        for (int n = 0; n < parts->orders; n++)
            receive_along(table, &m->kernel, (int)i, &ring, &m->rule, strip_of(side, parts->in[n], parts->out[n]), n);
        if (kd_pause())
            return;
    }
    table->photons.returns[i] = shares.photons.returns, table->photons.falls_in[i] = shares.photons.falls_in;
    table->energy.returns[i] = shares.energy.returns, table->energy.falls_in[i] = shares.energy.falls_in;
}

/* Makes the table. Returns false if the result is no longer wanted (base/pause.h). */
static bool make(struct kd_returning *table, const struct kd_hole *hole, enum kd_limb limb)
{
    struct making m = { .table = table, .rule = rule_of() };
    *table = (struct kd_returning) { .hole = *hole, .limb = limb, .isco = kd_kerr_isco(hole) };
    for (int i = 0; i < N; i++)
        table->s[i] = 0.5 * (1 + cos(M_PI * (i + 0.5) / N));
    kd_parallel_idle(N, make_ring, &m);
    if (kd_pause())
        return false;
    memcpy(table->once, m.kernel.flux, sizeof table->once);
    for (int i = 0; i < N; i++)
        table->lacks[i] = m.kernel.deficit[i] * table->s[i];
    fill_stress(table, &m.rule, &m.kernel);
    converge(table, &m.kernel);
    share_out(table, &m.kernel);
    find_hottest(table);
    return true;
}

/* Cache: the tables that were used last and, for more tables, their largest fluxes. used: 0 if the entry is empty. */
enum { KEPT = 8, LARGEST = 256 };
static struct kept {
    struct kd_returning table;
    uint64_t used;
} kept[KEPT];
static struct largest {
    struct kd_hole hole;
    enum kd_limb limb;
    double flux;
} largest[LARGEST];
static uint64_t uses;
static unsigned next_largest;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

static bool is_same(const struct kd_hole *a, enum kd_limb of_a, const struct kd_hole *b, enum kd_limb of_b)
{
    return a->a == b->a && a->q == b->q && of_a == of_b;
}

static bool recall(struct kd_returning *table, const struct kd_hole *hole, enum kd_limb limb)
{
    bool found = false;
    pthread_mutex_lock(&lock);
    for (int i = 0; i < KEPT && !found; i++)
        if (kept[i].used && is_same(&kept[i].table.hole, kept[i].table.limb, hole, limb))
            *table = kept[i].table, kept[i].used = ++uses, found = true;
    pthread_mutex_unlock(&lock);
    return found;
}

static void keep(const struct kd_returning *table)
{
    int oldest = 0;
    pthread_mutex_lock(&lock);
    for (int i = 1; i < KEPT; i++)
        if (kept[i].used < kept[oldest].used)
            oldest = i;
    kept[oldest] = (struct kept) { *table, ++uses };
    largest[next_largest++ % LARGEST] = (struct largest) { table->hole, table->limb, table->largest };
    pthread_mutex_unlock(&lock);
}

void kd_returning_init(struct kd_returning *table, const struct kd_hole *hole, enum kd_limb limb)
{
    if (recall(table, hole, limb))
        return;
    if (make(table, hole, limb))
        keep(table);
    else
        table->error = INFINITY;
}

double kd_returning_largest(const struct kd_hole *hole, enum kd_limb limb)
{
    double flux = 0;
    pthread_mutex_lock(&lock);
    for (int i = 0; i < LARGEST && !(flux > 0); i++)
        if (largest[i].flux > 0 && is_same(&largest[i].hole, largest[i].limb, hole, limb))
            flux = largest[i].flux;
    pthread_mutex_unlock(&lock);
    if (flux > 0)
        return flux;
    struct kd_returning table;
    kd_returning_init(&table, hole, limb);
    return table.largest;
}

double kd_returning_at(const struct kd_returning *table, const double list[N], double r)
{
    return at_nodes(table->s, list, sqrt(table->isco / r)) / (r * r * r);
}

struct kd_returning_shares kd_returning_shares_at(const struct kd_returning *table,
                                                  const struct kd_returning_list *list, double r)
{
    const double s = sqrt(table->isco / r), back = at_nodes(table->s, list->returns, s),
                 in = at_nodes(table->s, list->falls_in, s);
    return (struct kd_returning_shares) { back, in, 1 - back - in };
}

double kd_returning_flux(const struct kd_returning *table, double r)
{
    return kd_disk_flux_page_thorne(&table->hole, r) + kd_returning_at(table, table->more, r);
}

struct kd_reflected kd_reflection_at(const struct kd_reflection *reflection, const struct kd_returning *table, double r)
{
    const double all = kd_returning_flux(table, r),
                 flux = fmin(reflection->albedo * kd_returning_at(table, table->back, r), all);
    return (struct kd_reflected) { all - flux, flux, at_nodes(table->s, reflection->warm, sqrt(table->isco / r)) };
}

void kd_reflection_init(struct kd_reflection *reflection, const struct kd_returning *table, double albedo)
{
    *reflection = (struct kd_reflection) { .albedo = albedo };
    for (double change = 1; change > 1e-9;) {
        double own[N], again[N];
        change = 0;
        for (int j = 0; j < N; j++) {
            const double r = table->isco / pow(table->s[j], 2);
            const struct kd_reflected light = kd_reflection_at(reflection, table, r);
            own[j] = pow(r, 3.75) * pow(light.absorbed, 1.25);
            again[j] = pow(r, 3) * light.flux * reflection->warm[j];
        }
        for (int i = 0; i < N; i++) {
            const double warm = (times(table->warmth_of[i], own) + times(table->echo_of[i], again)) / table->back[i];
            change = fmax(change, fabs(warm / reflection->warm[i] - 1));
            reflection->warm[i] = warm;
        }
    }
}
