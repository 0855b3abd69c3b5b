#include "physics/disk/corona.h"

#include "base/pause.h"
#include "physics/math/quadrature.h"
#include "physics/null/null_course.h"
#include "physics/null/null_geodesic.h"
#include "physics/null/null_quartic.h"
#include "physics/spacetime/kerr.h"
#include "physics/spacetime/observer.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#define EXACT 1e-8    /* allowed error of ln r for a ray that meets a ring */
#define RIGHT 1e-4    /* relative change of epsilon below which no more angles are added */
#define CORRECT 1e-10 /* allowed error of a direction on the sky, in the chart below */
/* radius to which light is followed, M; a formula gives the time from there to infinity */
#define FAR 1e7
#define DIFFERENCE 1e-5 /* step for finite differences on the source's sky, radians */
enum { FEWEST = 16, PLACES = 2000, NEWTON = 60 };

bool kd_corona_source_of(const struct kd_hole *hole, double radius, double height, enum kd_corona_motion motion,
                         struct kd_corona_source *out)
{
    const double r = hypot(radius, height), u = height / r, s = radius / r;
    if (!(r >= KD_CORONA_LEAST * kd_kerr_ergosphere(hole, u)))
        return false;
    const struct kd_metric_scalars m = kd_metric_at(hole, r, u);
    const double gas = kd_kerr_omega(hole, fmax(radius, kd_kerr_isco(hole)));
    const double omega = motion == KD_CORONA_STATIC ? 0 : motion == KD_CORONA_ZAMO ? m.omega : gas;
    const double speed = s > 0 ? (omega - m.omega) / kd_kerr_rotation_reach(hole, r, u, s) : 0;
    if (!(fabs(speed) < 1))
        return false;
    const struct kd_observer_motion zamo = kd_observer_motion_of(KD_OBSERVER_ZAMO);
    const struct kd_vantage at = { .hole = *hole, .r = r, .u = u, .s = s };
    const double gamma = 1 / sqrt((1 - speed) * (1 + speed));
    *out = (struct kd_corona_source) { gamma / sqrt(m.lapse2), speed, gamma, kd_observer_tetrad(&zamo, &at) };
    return true;
}

/* Makes the ray of a photon that leaves along the unit vector m. Of the result only energy, momentum and solid are set.
 * null_geodesic.h traces arriving photons backwards, so the ray is that of a photon which arrives with the same E and L
 * and with opposite p_r and p_theta. The two paths are the same, because the metric does not change under (t, phi) ->
 * (-t, -phi). */
static struct kd_corona_photon send(const struct kd_corona_source *source, const double m[3], struct kd_null_ray *ray)
{
    const struct kd_vantage *at = &source->frame.at;
    const struct kd_covector p = kd_tetrad_covector(&source->frame, (const double[]) { 1, m[0], m[1], m[2] });
    const double energy = source->gamma * (1 - source->speed * m[2]);
    *ray = (struct kd_null_ray) { .hole = at->hole,
                                  .radius = at->r,
                                  .cos_theta = at->u,
                                  .sin_theta = at->s,
                                  .alpha = -p.momentum / p.energy,
                                  .beta = -p.polar / p.energy,
                                  .outward = p.radial > 0,
                                  .orders = 1 };
    return (struct kd_corona_photon) { .energy = p.energy / energy,
                                       .momentum = p.momentum * at->s / energy,
                                       .solid = 1 / (energy * energy) };
}

/* Follows a photon to the plane. trace: kd_null_trace_fast, or kd_null_trace_radii, which leaves p.delay NaN. */
static struct kd_corona_photon emit(const struct kd_corona_source *source, double x, double chi,
                                    struct kd_null_path (*trace)(const struct kd_null_ray *))
{
    const double sine = 1 / cosh(x), m[3] = { tanh(x), -sine * sin(chi), sine * cos(chi) };
    struct kd_null_ray ray;
    struct kd_corona_photon p = send(source, m, &ray);
    const struct kd_null_path path = trace(&ray);
    p.r = path.crossings ? path.crossing[0].r : path.fate == KD_NULL_ESCAPED ? INFINITY : 0;
    p.delay = path.crossings ? path.crossing[0].delay : NAN;
    return p;
}

struct kd_corona_photon kd_corona_emit(const struct kd_corona_source *source, double x, double chi)
{
    return emit(source, x, chi, kd_null_trace_fast);
}

static double mismatch(const struct kd_corona_photon *p, double r) { return p->r > 0 ? log(p->r / r) : -INFINITY; }

/* Finds the x = ln tan(delta/2) for which the ray with this chi meets the ring. The search starts from guesses of x and
 * of d ln r/dx. Because r grows with x, the root can be bracketed, and the secant method is kept within the bracket. */
static bool find(const struct kd_corona_source *source, double chi, double r, double slope, double *found,
                 struct kd_corona_photon *photon)
{
    double low = -60, high = 40, x = *found, before = NAN, f_before = NAN, step = 0.25;
    bool below = false, above = false;
    for (int i = 0; i < 200; i++) {
        *photon = emit(source, x, chi, kd_null_trace_radii);
        const double f = mismatch(photon, r);
        if (fabs(f) < EXACT || high - low < 1e-15 * (1 + fabs(x))) {
            *found = x;
            *photon = kd_corona_emit(source, x, chi);
            return fabs(f) < 1e-6;
        }
        if (f < 0)
            low = x, below = true;
        else
            high = x, above = true;
        if (isfinite(f) && isfinite(f_before))
            slope = (f - f_before) / (x - before);
        double next = isfinite(f) && slope > 0 ? x - f / slope : NAN;
        before = x, f_before = f;
        if (!(next > low && next < high)) {
            next = below && above ? 0.5 * (low + high) : f < 0 ? x + step : x - step;
            step *= 2;
        }
        x = next;
    }
    return false;
}

static double node_of(const struct kd_corona_light *c, double log_r)
{
    return log_r + (c->width > 0 ? asinh((log_r - c->centre) / c->width) : 0);
}

/* The ln r that belongs to s: the inverse of node_of, by Newton's method. node_of is monotone, with slopes between 1
 * and 1 + 1/width. */
static double log_radius_of(const struct kd_corona_light *c, double s, double low, double high)
{
    double at = 0.5 * (low + high);
    for (int i = 0; i < 200 && high - low > 1e-14 * (1 + fabs(at)); i++) {
        const double off = node_of(c, at) - s, slope = 1 + (c->width > 0 ? 1 / hypot(c->width, at - c->centre) : 0);
        *(off < 0 ? &low : &high) = at;
        const double next = at - off / slope;
        at = next > low && next < high ? next : 0.5 * (low + high);
    }
    return at;
}

static struct kd_corona_light nodes_of(double centre, double width, double inner, double outer)
{
    struct kd_corona_light light = { .centre = centre, .width = width, .error = INFINITY };
    light.first = node_of(&light, log(inner));
    light.step = (node_of(&light, log(outer)) - light.first) / (KD_CORONA_RINGS - 1);
    return light;
}

static void fill_radii(const struct kd_corona_light *c, double radii[KD_CORONA_RINGS])
{
    const double last = c->first + (KD_CORONA_RINGS - 1) * c->step;
    /* The sign of s - ln r is the sign of ln r - centre. This gives a bracket of the root. */
    for (int k = 0; k < KD_CORONA_RINGS; k++)
        radii[k] = exp(log_radius_of(c, c->first + k * c->step, fmin(c->first, c->centre), fmax(last, c->centre)));
}

/* Derivative d(values)/dk at the node k, by the polynomial through STENCIL neighbouring values. */
enum { STENCIL = 7 };
static double slope_at(const double *values, int k)
{
    const int first = k < STENCIL / 2                         ? 0
                      : k > KD_CORONA_RINGS - 1 - STENCIL / 2 ? KD_CORONA_RINGS - STENCIL
                                                              : k - STENCIL / 2;
    double sum = 0;
    for (int i = first; i < first + STENCIL; i++)
        for (int j = first; j < first + STENCIL; j++) {
            double term =
                /* derivative of Lagrange's polynomial i: a sum of terms, each of which leaves out one factor j */
                1. / (i - j);
            for (int l = first; l < first + STENCIL && j != i; l++)
                term *= l == i || l == j ? 1 : (double)(k - l) / (i - l);
            sum += j == i ? 0 : term * values[i];
        }
    return sum;
}

/* Computes the parts of epsilon at one angle for all rings, from the innermost outwards. */
static bool make_angle(struct kd_corona *c, const struct kd_corona_source *source, double photon_index,
                       const double *radii, int j)
{
    const struct kd_hole *hole = &source->frame.at.hole;
    const int n = c->angles;
    const double chi = 2 * M_PI * j / n;
    double x[KD_CORONA_RINGS], guess = log(radii[0] / source->frame.at.r), slope = 1;
    struct kd_corona_photon photon[KD_CORONA_RINGS];
    for (int k = 0; k < KD_CORONA_RINGS; k++) {
        if (k > 1)
            slope = log(radii[k - 1] / radii[k - 2]) / (x[k - 1] - x[k - 2]);
        x[k] = k > 2 ? 3 * (x[k - 1] - x[k - 2]) + x[k - 3] : k > 1 ? 2 * x[1] - x[0] : guess;
        if (!find(source, chi, radii[k], slope, &x[k], &photon[k]))
            return false;
        guess = x[k];
    }
    for (int k = 0; k < KD_CORONA_RINGS; k++) {
        const double r = radii[k], sine = 1 / cosh(x[k]), turned = slope_at(x, k) / c->light.step,
                     per_s = 1 / (1 + (c->light.width > 0 ? 1 / hypot(c->light.width, log(r) - c->light.centre) : 0)),
                     solid = photon[k].solid * sine * sine * turned / (per_s * r),
                     g = kd_kerr_ut(hole, r) * (photon[k].energy - kd_kerr_omega(hole, r) * photon[k].momentum);
        const int at = k * n + j;
        if (!(turned > 0))
            return false;
        c->log_part[at] = log(solid / (4 * M_PI * n * r * source->ut)) + (photon_index - 1) * log(g);
        c->time[at] = photon[k].delay;
    }
    return true;
}

/* Sums the parts of all angles for each ring. Returns the largest relative change of a sum when every second angle is
 * left out. */
static double add_up(struct kd_corona *c)
{
    double worst = 0;
    for (int k = 0; k < KD_CORONA_RINGS; k++) {
        double sum[2] = { 0, 0 };
        for (int j = 0; j < c->angles; j++)
            sum[j & 1] += exp(c->log_part[k * c->angles + j]);
        c->light.log_epsilon[k] = log(sum[0] + sum[1]);
        worst = fmax(worst, c->angles > 1 ? fabs(sum[0] - sum[1]) / (sum[0] + sum[1]) : 0);
    }
    return worst;
}

void kd_corona_finish(struct kd_corona *c)
{
    free(c->log_part);
    free(c->time);
    c->log_part = c->time = NULL;
}

/* Computes the parts at n angles. If n exceeds the smallest number of angles, every second angle is known already. The
 * sum over a period converges so fast that, after a doubling of n, the error is about the square of the last change.
 * For safety the last change to the power 1.5 is reported as the error. */
static enum kd_status take_angles(struct kd_corona *c, const struct kd_corona_source *source, double photon_index,
                                  const double *radii, int n)
{
    struct kd_corona before = *c;
    c->angles = n;
    c->log_part = malloc(sizeof(double) * KD_CORONA_RINGS * (size_t)n);
    c->time = malloc(sizeof(double) * KD_CORONA_RINGS * (size_t)n);
    const bool room = c->log_part && c->time;
    bool made = room, stops = false;
    for (int j = 0; j < n && made && !(stops = kd_pause()); j++) {
        if (!before.log_part || j % 2) {
            made = make_angle(c, source, photon_index, radii, j);
            continue;
        }
        for (int k = 0; k < KD_CORONA_RINGS; k++) {
            c->log_part[k * n + j] = before.log_part[(k * n + j) / 2] - M_LN2;
            c->time[k * n + j] = before.time[(k * n + j) / 2];
        }
    }
    kd_corona_finish(&before);
    made &= !stops;
    c->light.error = made ? pow(add_up(c), 1.5) : INFINITY;
    return made ? KD_OK : stops ? KD_ECANCELLED : room ? KD_EINVAL : KD_ENOMEM;
}

enum kd_status kd_corona_init(struct kd_corona *c, const struct kd_corona_source *source, double photon_index,
                              double inner, double outer)
{
    const struct kd_vantage *at = &source->frame.at;
    double radii[KD_CORONA_RINGS];
    enum kd_status status = KD_OK;
    *c = (struct kd_corona) { .light = nodes_of(at->s > 0 ? log(at->r * at->s) : 0,
                                                at->s > 0 ? fmin(1, at->u / at->s) : 0, inner, outer) };
    fill_radii(&c->light, radii);
    if (!(at->s > 0))
        return take_angles(c, source, photon_index, radii, 1);
    for (int n = FEWEST; n <= KD_CORONA_ANGLES && c->light.error > RIGHT; n *= 2)
        KD_TRY(take_angles(c, source, photon_index, radii, n));
done:
    return status;
}

enum { POINTS = 4 }; /* number of nodes that an interpolation uses */

static int weigh(const struct kd_corona_light *c, double r, double weight[POINTS])
{
    const double at = (node_of(c, log(r)) - c->first) / c->step;
    const int first = (int)fmin(fmax(floor(at) - 1, 0), KD_CORONA_RINGS - POINTS);
    for (int i = 0; i < POINTS; i++) {
        weight[i] = 1;
        for (int j = 0; j < POINTS; j++)
            weight[i] *= j == i ? 1 : (at - first - j) / (i - j);
    }
    return first;
}

double kd_corona_light_at(const struct kd_corona_light *c, double r)
{
    double weight[POINTS], sum = 0;
    const int first = weigh(c, r, weight);
    for (int i = 0; i < POINTS; i++)
        sum += weight[i] * c->log_epsilon[first + i];
    return exp(sum);
}

void kd_corona_parts(const struct kd_corona *c, double r, double *part, double *time)
{
    double weight[POINTS];
    const int first = weigh(&c->light, r, weight);
    for (int j = 0; j < c->angles; j++) {
        part[j] = time[j] = 0;
        for (int i = 0; i < POINTS; i++) {
            part[j] += weight[i] * c->log_part[(first + i) * c->angles + j];
            time[j] += weight[i] * c->time[(first + i) * c->angles + j];
        }
        part[j] = exp(part[j]);
    }
}

/* Finds where the light of the direction m arrives at infinity. Directions at infinity have the coordinates
 * tan(theta/2) (cos phi, sin phi), where phi counts from the source. This chart is regular everywhere except at theta =
 * pi. A solid angle of the sky is 4/(1 + x^2 + y^2)^2 times the area in the chart. */
static bool arrive(const struct kd_corona_source *source, const double m[3], double out[2])
{
    struct kd_null_ray ray;
    send(source, m, &ray);
    const struct kd_null_path path = kd_null_trace_fast(&ray);
    if (path.fate != KD_NULL_ESCAPED || path.crossings)
        return false;
    const double far = sqrt((1 - path.sky_u) / (1 + path.sky_u));
    out[0] = far * cos(path.sky_phi), out[1] = far * sin(path.sky_phi);
    return isfinite(out[0]) && isfinite(out[1]);
}

/* Two unit vectors perpendicular to m. */
static void across(const double m[3], double axes[2][3])
{
    const int k = fabs(m[0]) < fabs(m[1]) ? (fabs(m[0]) < fabs(m[2]) ? 0 : 2) : (fabs(m[1]) < fabs(m[2]) ? 1 : 2);
    double size = 0;
    for (int i = 0; i < 3; i++)
        axes[0][i] = (i == k) - m[k] * m[i], size += axes[0][i] * axes[0][i];
    for (int i = 0; i < 3; i++)
        axes[0][i] /= sqrt(size);
    for (int i = 0; i < 3; i++)
        axes[1][i] = m[(i + 1) % 3] * axes[0][(i + 2) % 3] - m[(i + 2) % 3] * axes[0][(i + 1) % 3];
}

static void turn(const double m[3], double axes[2][3], double x, double y, double out[3])
{
    double size = 0;
    for (int i = 0; i < 3; i++)
        out[i] = m[i] + x * axes[0][i] + y * axes[1][i], size += out[i] * out[i];
    for (int i = 0; i < 3; i++)
        out[i] /= sqrt(size);
}

/* Derivatives of the chart's coordinates by the direction at m, by central differences. */
static bool slopes(const struct kd_corona_source *source, const double m[3], double axes[2][3], double rate[2][2])
{
    for (int j = 0; j < 2; j++) {
        double ahead[3], behind[3], there[2], here[2];
        turn(m, axes, j ? 0 : DIFFERENCE, j ? DIFFERENCE : 0, ahead);
        turn(m, axes, j ? 0 : -DIFFERENCE, j ? -DIFFERENCE : 0, behind);
        if (!arrive(source, ahead, there) || !arrive(source, behind, here))
            return false;
        for (int i = 0; i < 2; i++)
            rate[i][j] = (there[i] - here[i]) / (2 * DIFFERENCE);
    }
    return true;
}

/* Finds the direction whose light arrives at `want`, by Newton's method from m. Sets m to that direction, and *solid to
 * the solid angle per area of the chart. */
static bool aim(const struct kd_corona_source *source, const double want[2], double m[3], double *solid)
{
    double at[2], axes[2][3], rate[2][2];
    if (!arrive(source, m, at))
        return false;
    for (int i = 0; i < NEWTON; i++) {
        const double off[2] = { want[0] - at[0], want[1] - at[1] }, size = hypot(off[0], off[1]);
        across(m, axes);
        if (!slopes(source, m, axes, rate))
            return false;
        const double det = rate[0][0] * rate[1][1] - rate[0][1] * rate[1][0];
        *solid = 1 / fabs(det);
        if (size < CORRECT)
            return true;
        double share = 1, step[2] = { (rate[1][1] * off[0] - rate[0][1] * off[1]) / det,
                                      (rate[0][0] * off[1] - rate[1][0] * off[0]) / det };
        const double long_step = hypot(step[0], step[1]);
        share = long_step > 0.3 ? 0.3 / long_step : 1;
        for (;; share *= 0.5) {
            double to[3], there[2];
            turn(m, axes, share * step[0], share * step[1], to);
            if (arrive(source, to, there) && hypot(want[0] - there[0], want[1] - there[1]) < size) {
                memcpy(m, to, sizeof to);
                memcpy(at, there, sizeof there);
                break;
            }
            if (share < 1e-6)
                return size < 1e3 * CORRECT;
        }
    }
    return false;
}

/* Coordinate time of the light from the source to infinity, minus r_o + 2 ln r_o. The time beyond FAR is computed to
 * first order in 1/FAR, from dt/dr = 1 + 2/r + (4 - q^2 + a^2 u^2 - A/2)/r^2 (null_radial.h; A is defined in
 * null_quartic.h). */
static double time_of(const struct kd_corona_source *source, const double m[3])
{
    struct kd_null_place places[PLACES];
    struct kd_null_ray ray;
    send(source, m, &ray);
    const struct kd_null_motion motion =
        kd_null_motion_of(&ray.hole, ray.cos_theta, ray.sin_theta, ray.alpha, ray.beta);
    const struct kd_null_course course = kd_null_course_of(&ray, FAR, 1e-4, places, PLACES);
    if (!course.n || course.end != KD_COURSE_ESCAPED)
        return NAN;
    const struct kd_null_place *last = &places[course.n - 1];
    const double a = ray.hole.a, four = kd_hole_rates_of(&ray.hole, 1, 0).four,
                 rest = four + a * a * last->u * last->u - 0.5 * motion.quadratic;
    return last->delay - last->r - 2 * log(last->r) + rest / last->r;
}

/* The direction in which light would leave the source towards (theta, azimuth) without bending. */
static void straight(const struct kd_corona_source *source, double cos_i, double azimuth, double m[3])
{
    const double sin_i = sqrt((1 - cos_i) * (1 + cos_i)), u = source->frame.at.u, s = source->frame.at.s;
    m[0] = sin_i * cos(azimuth) * s + cos_i * u;
    m[1] = sin_i * cos(azimuth) * u - cos_i * s;
    m[2] = sin_i * sin(azimuth);
}

/* Finds the direction in several steps, starting from m. The targets of the steps lead from the place where the light
 * of m arrives to the wanted place. */
static bool aim_by_steps(const struct kd_corona_source *source, const double want[2], int steps, double m[3],
                         double *solid)
{
    double from[2];
    if (!arrive(source, m, from))
        return false;
    for (int i = 1; i <= steps; i++) {
        const double share = (double)i / steps,
                     to[2] = { from[0] + share * (want[0] - from[0]), from[1] + share * (want[1] - from[1]) };
        if (!aim(source, to, m, solid))
            return false;
    }
    return true;
}

/* Finds the direction, starting from m. This may fail because the ray of m is bent down to the plane or into the hole.
 * The search then starts again from other directions, further and further from m. */
static bool aim_anew(const struct kd_corona_source *source, double cos_i, double azimuth, const double want[2],
                     double m[3], double *solid)
{
    const double last[3] = { m[0], m[1], m[2] };
    if (aim(source, want, m, solid))
        return true;
    for (int steps = 4; steps <= 64; steps *= 4) {
        memcpy(m, last, sizeof last);
        if (aim_by_steps(source, want, steps, m, solid))
            return true;
        for (double up = cos_i; up < 1; up += 0.15) {
            straight(source, up, -azimuth, m);
            if (aim_by_steps(source, want, steps, m, solid))
                return true;
        }
        memcpy(m, (const double[]) { 1, 0, 0 }, sizeof last);
        if (aim_by_steps(source, want, steps, m, solid))
            return true;
    }
    return false;
}

bool kd_corona_direct_of(const struct kd_corona_source *source, double photon_index, double cos_i,
                         struct kd_corona_direct *out)
{
    const double far = sqrt((1 - cos_i) / (1 + cos_i));
    double m[3];
    *out = (struct kd_corona_direct) { .n = source->frame.at.s > 0 ? KD_CORONA_AZIMUTHS : 1 };
    straight(source, cos_i, 0, m);
    for (int k = 0; k < out->n; k++) {
        const double azimuth = 2 * M_PI * k / out->n, want[2] = { far * cos(azimuth), far * sin(azimuth) };
        double solid;
        if (kd_pause() || !aim_anew(source, cos_i, azimuth, want, m, &solid))
            return false;
        struct kd_null_ray ray;
        const struct kd_corona_photon p = send(source, m, &ray);
        const double area = 0.25 * pow(1 + far * far, 2);
        out->part[k] = area * solid * p.solid * pow(p.energy, photon_index - 1) / (4 * M_PI * source->ut * out->n);
        out->part_time[k] = time_of(source, m);
        out->flux += out->part[k];
        out->g += out->part[k] * p.energy;
        out->time += out->part[k] * out->part_time[k];
    }
    out->g /= out->flux, out->time /= out->flux;
    return isfinite(out->time) && out->flux > 0;
}

/* Numbers of Gauss points. In rho: POINTS_A_HEIGHT for each height of the corona, limited to the range from FEWEST_RHO
 * to MOST_RHO. In z: POINTS_Z. */
#define POINTS_A_HEIGHT 2
enum { POINTS_Z = 3, FEWEST_RHO = 5, MOST_RHO = 20 };

int kd_corona_rings(const struct kd_corona_shape *shape, struct kd_corona_ring out[KD_CORONA_PARTS])
{
    double rho[MOST_RHO], rho_weight[MOST_RHO], z[POINTS_Z], z_weight[POINTS_Z], all = 0;
    const double wide = shape->outer - shape->inner, high = shape->top - shape->height;
    const int across =
                  wide > 0 ? (int)fmin(fmax(ceil(POINTS_A_HEIGHT * wide / shape->height), FEWEST_RHO), MOST_RHO) : 1,
              up = high > 0 ? POINTS_Z : 1;
    kd_gauss_legendre(across, rho, rho_weight);
    kd_gauss_legendre(up, z, z_weight);
    int n = 0;
    for (int i = 0; i < across; i++)
        for (int k = 0; k < up; k++, n++) {
            const double radius = shape->inner + wide * rho[i],
                         weight = (wide > 0 ? radius : 1) * rho_weight[i] * z_weight[k];
            out[n] = (struct kd_corona_ring) { radius, shape->height + high * z[k], weight };
            all += weight;
        }
    for (int i = 0; i < n; i++)
        out[i].weight /= all;
    return n;
}

/* Makes the table of a corona's light. A corona of a single ring has the nodes of that ring's table. For other coronas
 * the nodes are even in ln r. */
static enum kd_status make_light(const struct kd_hole *hole, const struct kd_corona_shape *shape, double photon_index,
                                 double inner, double outer, struct kd_corona_light *out)
{
    struct kd_corona_ring rings[KD_CORONA_PARTS];
    double radii[KD_CORONA_RINGS], sum[KD_CORONA_RINGS] = { 0 };
    const int n = kd_corona_rings(shape, rings);
    enum kd_status status = KD_OK;
    *out = nodes_of(0, 0, inner, outer);
    out->error = 0;
    fill_radii(out, radii);
    for (int i = 0; i < n && !status; i++) {
        struct kd_corona_source source;
        struct kd_corona corona = { 0 };
        if (!kd_corona_source_of(hole, rings[i].radius, rings[i].height, shape->motion, &source))
            return KD_EINVAL;
        status = kd_corona_init(&corona, &source, photon_index, inner, outer);
        for (int k = 0; !status && k < KD_CORONA_RINGS; k++)
            sum[k] += rings[i].weight * kd_corona_light_at(&corona.light, radii[k]);
        if (!status && n == 1)
            *out = corona.light;
        out->error = fmax(out->error, corona.light.error);
        kd_corona_finish(&corona);
    }
    for (int k = 0; n > 1 && k < KD_CORONA_RINGS; k++)
        out->log_epsilon[k] = log(sum[k]);
    return status;
}

enum { KEPT = 64 };
struct key {
    struct kd_hole_given hole;
    double inner, outer, photon_index, from, to, height, top, motion;
};
static struct entry {
    struct key key;
    unsigned long used; /* time of the last use; 0 if the entry is empty */
    struct kd_corona_light light;
} entries[KEPT];
static unsigned long uses;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

static bool look_up(const struct key *key, struct kd_corona_light *out)
{
    bool found = false;
    pthread_mutex_lock(&lock);
    for (int i = 0; i < KEPT && !found; i++)
        if ((found = entries[i].used && !memcmp(&entries[i].key, key, sizeof *key))) {
            entries[i].used = ++uses;
            *out = entries[i].light;
        }
    pthread_mutex_unlock(&lock);
    return found;
}

static void keep(const struct key *key, const struct kd_corona_light *light)
{
    pthread_mutex_lock(&lock);
    struct entry *oldest = entries;
    for (int i = 1; i < KEPT; i++)
        if (entries[i].used < oldest->used)
            oldest = &entries[i];
    *oldest = (struct entry) { *key, ++uses, *light };
    pthread_mutex_unlock(&lock);
}

enum kd_status kd_corona_light_of(const struct kd_hole *hole, const struct kd_corona_shape *shape, double photon_index,
                                  double inner, double outer, struct kd_corona_light *out)
{
    const struct key key = { kd_hole_told(hole), inner,         outer,      photon_index,         shape->inner,
                             shape->outer,       shape->height, shape->top, (double)shape->motion };
    if (look_up(&key, out))
        return KD_OK;
    const enum kd_status status = make_light(hole, shape, photon_index, inner, outer, out);
    if (!status)
        keep(&key, out);
    return status;
}

bool kd_corona_continuum_of(const struct kd_hole *hole, const struct kd_corona_shape *shape, double photon_index,
                            double cos_i, struct kd_corona_continuum *out)
{
    struct kd_corona_ring rings[KD_CORONA_PARTS];
    const int n = kd_corona_rings(shape, rings);
    *out = (struct kd_corona_continuum) { 0, 0 };
    for (int i = 0; i < n; i++) {
        struct kd_corona_source source;
        struct kd_corona_direct direct;
        if (!kd_corona_source_of(hole, rings[i].radius, rings[i].height, shape->motion, &source) ||
            !kd_corona_direct_of(&source, photon_index, cos_i, &direct))
            return false;
        out->flux += rings[i].weight * direct.flux;
        out->g += rings[i].weight * direct.flux * direct.g;
    }
    out->g /= out->flux;
    return true;
}
