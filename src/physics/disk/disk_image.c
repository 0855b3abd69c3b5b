#include "physics/disk/disk_image.h"

#include "base/pause.h"
#include "physics/null/null_polar.h"
#include "physics/null/null_quartic.h"
#include "physics/null/null_radial.h"
#include "physics/spacetime/kerr.h"

#include <math.h>
#include <string.h>

enum { POINTS = 6 }; /* number of nodes that an interpolation uses */
/* least distance, M, of the origin of the coordinate u (radius_of_node) from the ISCO. With a smaller distance, all
 * nodes for a > 0.9995 would lie at the horizon, where the image no longer changes */
#define NEAREST 0.1
#define NODES 1e-7  /* allowed error of ln r at the nodes */
#define PLACE 1e-12 /* allowed error of ln r at a single requested place */
#define BENDS 10.   /* largest relative change of a slope per unit of ln r */
/* relative error of a slope: this much if only the slope of flat space is known; otherwise this fraction of the error
 * of the extrapolation from the preceding rings */
#define DRIFTS 0.2
#define FLATTEST 0.1  /* every slope that occurs is between this number and its inverse */
#define MOVED 0.3     /* largest correction of a guess of R by the errors of the guesses at the preceding angles */
enum { HISTORY = 5 }; /* number of preceding rings from which the slope at a ring is computed */

struct ellipse { double x0, y0, a, b; };

/* Height of the centre above the origin, as a fraction of the difference between the far side's height and the near
 * side's depth. Near edge-on the image of the far side is a hump with low wings. If the centre lies below all tangents
 * of the hump, each line from the centre meets a ring only once. With the centre midway between both sides (0.5), lines
 * met some rings three times at inclinations above 86.5 degrees. */
#define LIFTED 0.1

/* Approximate ellipse of the ring's image. The near side is as in flat space. The far side is lifted as by a thin lens,
 * b (b - r cos i) = 4 r. A factor sin(i)^4 makes the lift vanish face-on. */
static struct ellipse around(const struct kd_disk_image *image, double r)
{
    double flat = r * image->cos_i, s2 = image->sin_i * image->sin_i;
    double up = 1 + 0.5 * (flat + sqrt(flat * flat + 16 * r * s2 * s2)), down = 1 + flat;
    return (struct ellipse) { image->hole.a * image->sin_i, LIFTED * (up - down), r + 1, 0.5 * (up + down) };
}

static double radius_of_node(const struct kd_disk_image *image, int k)
{
    double u = (double)k / KD_DISK_IMAGE_RINGS, u2 = u * u;
    return image->origin + (image->isco - image->origin) / (u2 * u2);
}

static double node_of_radius(const struct kd_disk_image *image, double r)
{
    return KD_DISK_IMAGE_RINGS * sqrt(sqrt((image->isco - image->origin) / (r - image->origin)));
}

double kd_disk_image_radius(const struct kd_disk_image *image, double alpha, double beta)
{
    struct kd_null_motion m = kd_null_motion_of(&image->hole, image->cos_i, image->sin_i, alpha, beta);
    if (!(m.eta > 0))
        return m.k > 27 ? INFINITY : 0; /* a vortical ray never meets the plane */
    struct kd_null_roots roots = kd_null_roots_of(&m);
    return kd_null_radius_after(&m, &roots, kd_null_polar_first(&m));
}

static double mismatch(const struct kd_disk_image *image, const struct ellipse *e, double x, double y,
                       double log_stretch, double r)
{
    double stretch = exp(log_stretch), found = kd_disk_image_radius(image, e->x0 + stretch * x, e->y0 + stretch * y);
    return found > 0 ? log(found / r) : -INFINITY;
}

/* The slope d ln r/d ln R at the starting point of a search. drift, bend: the slope's relative error is drift + bend
 * times the error of ln r at that point. */
struct slope { double value, drift, bend; };

/* Finds the ln R for which the ray meets the plane at r: it solves ln(r_0/r) = 0, where r_0 is the radius at which the
 * ray meets the plane. It starts from a guess, and uses the secant method within a bracket. slope: on entry the slope
 * for the first step, which is 1 in flat space; on return slope->value is the slope of the last secant. No ray verifies
 * the last step if the remaining error, estimated from the change of the slope, is below `exact`. */
static bool find(const struct kd_disk_image *image, const struct ellipse *e, const double direction[2], double r,
                 double exact, double *log_stretch, struct slope *slope)
{
    double cosine = e->a * direction[0], sine = e->b * direction[1];
    double x = *log_stretch, low = -INFINITY, high = INFINITY, before = NAN, f_before = NAN, reach = 0.02;
    for (int i = 0; i < 60; i++) {
        double f = mismatch(image, e, cosine, sine, x, r);
        if (fabs(f) < exact || (high - low < 1e-13)) {
            *log_stretch = x;
            return fabs(f) < 1e-6;
        }
        *(f < 0 ? &low : &high) = x;
        bool met = isfinite(f) && isfinite(f_before);
        if (met)
            slope->value = (f - f_before) / (x - before);
        double next = x - f / (met || !i ? slope->value : 1);
        double left = met ? fabs(f * f_before) * BENDS
                      : i ? INFINITY
                          : fabs(f) * (slope->drift + slope->bend * fabs(f));
        if (next > low && next < high && left < exact) {
            *log_stretch = next;
            return true;
        }
        before = x, f_before = f;
        if (!(next > low && next < high) || !isfinite(next)) {
            bool both = isfinite(low) && isfinite(high);
            next = both ? 0.5 * (low + high) : isfinite(high) ? high - reach : low + reach;
            reach *= 2;
        }
        x = next;
    }
    *log_stretch = before; /* gives up, as rounding prevents convergence next to an extremal hole */
    return fabs(f_before) < 1e-6;
}

/* Extrapolates R to the next ring, at the same angle, by the polynomial through at most five preceding rings. */
static double guess(const struct kd_disk_image *image, int k, int j)
{
    double a = image->stretch[k - 1][j];
    if (k < 3)
        return a;
    double b = image->stretch[k - 2][j], c = image->stretch[k - 3][j];
    if (k < 4)
        return 3 * (a - b) + c;
    double d = image->stretch[k - 4][j];
    if (k < 5)
        return 4 * (a + c) - 6 * b - d;
    return 5 * (a - d) - 10 * (b - c) + image->stretch[k - 5][j];
}

/* Derivative of a ring's ellipse by ln r: relative for the half axes, in M for the centre. */
static struct ellipse growth_of(const struct kd_disk_image *image, double r)
{
    const double step = 1e-4;
    struct ellipse in = around(image, r * (1 - step)), out = around(image, r * (1 + step));
    return (struct ellipse) { 0, (out.y0 - in.y0) / (2 * step), (out.a - in.a) / (step * (out.a + in.a)),
                              (out.b - in.b) / (step * (out.b + in.b)) };
}

/* The slope d ln r/d ln R at a fixed direction from the centre of a ring's ellipse, from approximate values of the ring
 * and its neighbours. swells, turns: relative derivatives of R by ln r and by chi. The slope is d x p_chi/(p_L x
 * p_chi). Here p_L and p_chi are the derivatives of a place by ln r and by chi, and d = R (A cos chi, B sin chi). */
static double slope_at(const struct ellipse *e, const struct ellipse *growth, const double direction[2], double stretch,
                       double swells, double turns)
{
    double c = direction[0], s = direction[1];
    double across = (swells + growth->a) * c * (turns * s + c) -
                    (growth->y0 / (e->b * stretch) + (swells + growth->b) * s) * (turns * c - s);
    return 1 / across;
}

/* State while ring k of the nodes is made from the preceding rings. */
struct making {
    int k;
    double r, rate; /* r: radius of the ring. rate: dk/d ln r there */
    struct ellipse e, growth;
    double guessed[KD_DISK_IMAGE_ANGLES];
};

/* Weights that give the derivative at the last of several nodes. The weight of the last node comes first. They follow
 * from backward differences: the derivative is the sum of nabla^m/m for m from 1 to the order. */
static const double backward[HISTORY][HISTORY + 1] = {
    { 1, -1 },
    { 1.5, -2, 0.5 },
    { 11. / 6, -3, 1.5, -1. / 3 },
    { 25. / 12, -4, 3, -4. / 3, 0.25 },
    { 137. / 60, -5, 5, -10. / 3, 1.25, -0.2 },
};

/* Errors of the guesses that were extrapolated from preceding rings. next: error expected at the present angle. last:
 * errors at the last three angles, the latest first. */
struct miss { double next, last[3]; };

static struct slope slope_of(const struct kd_disk_image *image, const struct making *m, int j,
                             const double direction[2], double stretch, const struct miss *off)
{
    int n = image->angles, back = m->k < HISTORY ? m->k : HISTORY;
    const double *weight = backward[back - 1], *g = m->guessed, per_radian = n / (2 * M_PI);
    double swells = weight[0] * stretch;
    for (int i = 1; i <= back; i++)
        swells += weight[i] * image->stretch[m->k - i][j];
    double turns = (8 * (g[(j + 1) % n] - g[(j + n - 1) % n]) - g[(j + 2) % n] + g[(j + n - 2) % n]) / 12 +
                   backward[1][0] * off->next + backward[1][1] * off->last[0] + backward[1][2] * off->last[1];
    double value =
        slope_at(&m->e, &m->growth, direction, stretch, swells * m->rate / stretch, turns * per_radian / stretch);
    if (!(value > FLATTEST && value < 1 / FLATTEST)) /* the slope is too inaccurate to be useful */
        return (struct slope) { 1, INFINITY, 0 };
    double drift = fabs(m->rate * off->next) + per_radian * fabs(off->next - 2 * off->last[0] + off->last[1]);
    return (struct slope) { value, DRIFTS * drift, BENDS + weight[0] * fabs(m->rate) };
}

static bool make_ring(struct kd_disk_image *image, int k)
{
    struct making m = { .k = k, .r = radius_of_node(image, k) };
    m.e = around(image, m.r), m.growth = growth_of(image, m.r), m.rate = -0.25 * k * m.r / (m.r - image->origin);
    for (int j = 0; j < image->angles; j++)
        m.guessed[j] = guess(image, k, j);
    struct miss off = { 0 };
    for (int j = 0; j < image->angles; j++) {
        if (kd_pause_every((uint64_t)j, 16))
            return false;
        off.next = fmin(fmax(3 * (off.last[0] - off.last[1]) + off.last[2], -MOVED), MOVED);
        double stretch = fmax(m.guessed[j] + off.next, 0.1), log_stretch = log(stretch);
        int at = j * (KD_DISK_IMAGE_ANGLES / image->angles);
        const double direction[2] = { image->cosine[at], image->sine[at] };
        struct slope slope = slope_of(image, &m, j, direction, stretch, &off);
        if (!find(image, &m.e, direction, m.r, NODES, &log_stretch, &slope))
            return false;
        image->stretch[k][j] = exp(log_stretch);
        off.last[2] = off.last[1], off.last[1] = off.last[0], off.last[0] = image->stretch[k][j] - m.guessed[j];
    }
    return true;
}

bool kd_disk_image_init(struct kd_disk_image *image, const struct kd_hole *hole, double inclination)
{
    /* pi/2 is rounded, so its cosine is not exactly 0 */
    const double cosine = fabs(cos(inclination)), c = cosine < 1e-15 ? 0 : cosine;
    memset(image, 0, sizeof *image);
    image->hole = *hole, image->cos_i = c, image->sin_i = sin(inclination);
    image->isco = kd_kerr_isco(hole), image->horizon = hole->outer;
    image->origin = fmin(image->horizon, image->isco - NEAREST);
    image->angles = c > 0.3 ? 64 : c > 0.15 ? 128 : c > 0.08 ? 256 : KD_DISK_IMAGE_ANGLES;
    if (!(c > sin(KD_DISK_IMAGE_EDGE_ON * M_PI / 180))) {
        image->angles = 0;
        return true;
    }
    for (int j = 0; j < KD_DISK_IMAGE_ANGLES; j++) {
        image->cosine[j] = cos(2 * M_PI * j / KD_DISK_IMAGE_ANGLES),
        image->sine[j] = sin(2 * M_PI * j / KD_DISK_IMAGE_ANGLES);
        image->stretch[0][j] = 1;
    }
    for (int k = 1; k <= KD_DISK_IMAGE_RINGS; k++)
        if (!make_ring(image, k))
            return false;
    return true;
}

/* Lagrange's weights of the nodes 0 ... POINTS - 1 for the place x. */
static void weigh(double x, double weight[POINTS])
{
    for (int i = 0; i < POINTS; i++) {
        weight[i] = 1;
        for (int j = 0; j < POINTS; j++)
            if (j != i)
                weight[i] *= (x - j) / (i - j);
    }
}

/* Values of R at the nodes' angles, for a ring between two rings of the table. */
static void between_rings(const struct kd_disk_image *image, double r, int skip, double *row)
{
    double at = node_of_radius(image, r) / skip, weight[POINTS];
    int last = KD_DISK_IMAGE_RINGS / skip, first = (int)fmin(fmax(floor(at) - POINTS / 2 + 1, 0), last - POINTS + 1);
    weigh(at - first, weight);
    for (int j = 0; j < image->angles; j++)
        row[j] = 0;
    for (int i = 0; i < POINTS; i++) {
        const double *from = image->stretch[(first + i) * skip];
        for (int j = 0; j < image->angles; j++)
            row[j] += weight[i] * from[j];
    }
}

double kd_disk_image_step(const struct kd_disk_image *image, double r, double share)
{
    return share * (r - image->horizon) / r;
}

bool kd_disk_image_place(const struct kd_disk_image *image, double r, double chi, double *alpha, double *beta)
{
    double row[KD_DISK_IMAGE_ANGLES], weight[POINTS], stretch = 0, turns = chi / (2 * M_PI),
                                                      at = (turns - floor(turns)) * image->angles;
    int n = image->angles, first = (int)floor(at) - POINTS / 2 + 1;
    const double direction[2] = { cos(chi), sin(chi) };
    struct ellipse e = around(image, r);
    between_rings(image, r, 1, row);
    weigh(at - first, weight);
    for (int i = 0; i < POINTS; i++)
        stretch += weight[i] * row[(first + i + n) % n];
    double log_stretch = log(fmax(stretch, 0.1));
    struct slope slope = { 1, DRIFTS, 0 };
    if (!find(image, &e, direction, r, PLACE, &log_stretch, &slope))
        return false;
    *alpha = e.x0 + exp(log_stretch) * e.a * direction[0];
    *beta = e.y0 + exp(log_stretch) * e.b * direction[1];
    return true;
}

void kd_disk_image_ring(const struct kd_disk_image *image, double r, int skip, int n, double *alpha, double *beta)
{
    double row[KD_DISK_IMAGE_ANGLES], round[KD_DISK_IMAGE_ANGLES + POINTS];
    int nodes = image->angles / skip < n ? image->angles / skip : n, every = image->angles / nodes, finer = n / nodes,
        apart = KD_DISK_IMAGE_ANGLES / n;
    struct ellipse e = around(image, r);
    between_rings(image, r, skip, row);
    for (int j = 0; j < nodes + POINTS; j++)
        round[j] = row[(j - POINTS / 2 + 1 + nodes) % nodes * every];
    for (int part = 0; part < finer; part++) {
        double weight[POINTS];
        weigh(POINTS / 2 - 1 + (double)part / finer, weight);
        for (int j = 0; j < nodes; j++) {
            double stretch = 0;
            int at = j * finer + part;
            for (int i = 0; i < POINTS; i++)
                stretch += weight[i] * round[j + i];
            alpha[at] = e.x0 + stretch * e.a * image->cosine[at * apart];
            beta[at] = e.y0 + stretch * e.b * image->sine[at * apart];
        }
    }
}

struct kd_disk_ring kd_disk_image_gas(const struct kd_disk_image *image, double r)
{
    return (struct kd_disk_ring) { r, kd_kerr_ut(&image->hole, r), kd_kerr_omega(&image->hole, r) };
}

struct kd_disk_light kd_disk_image_light(const struct kd_disk_image *image, const struct kd_disk_ring *gas,
                                         double alpha, double beta)
{
    double a = image->hole.a, c = image->cos_i, eta = (alpha - a) * (alpha + a) * c * c + beta * beta;
    double g = kd_disk_image_redshift(image, gas, alpha);
    return (struct kd_disk_light) { g, fmin(1, g * sqrt(fmax(eta, 0)) / gas->r) };
}
