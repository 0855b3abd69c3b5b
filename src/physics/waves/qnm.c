#include "physics/waves/qnm.h"

#include "physics/spacetime/hole.h"

#include <math.h>
#include <stdlib.h>

enum { S = -2, ITERATIONS = 40 };

/* Coefficients of a recurrence alpha_k a_{k+1} + beta_k a_k + gamma_k a_{k-1} = 0, with alpha_k = alpha[0] + alpha[1] k
 * + alpha[2] k^2, and so on. */
struct recurrence { double complex alpha[3], beta[3], gamma[3]; };

static double complex quadratic(const double complex c[3], double k) { return c[0] + k * (c[1] + k * c[2]); }

/* The recurrence's continued fraction, inverted at `row`. It is zero if a minimal solution a_k exists. terms: number of
 * terms of the infinite part. rest: value of -a_{K+1}/a_K with which these terms begin. In exact arithmetic every row
 * gives the same roots; numerically a root is best resolved from the row with its own index (Leaver 1985, after eq.
 * 14). */
static double complex fraction(const struct recurrence *r, int row, int terms, double complex rest)
{
    double complex below = rest;
    for (int k = row + terms; k > row; k--)
        below = quadratic(r->gamma, k) / (quadratic(r->beta, k) - quadratic(r->alpha, k) * below);
    double complex above = quadratic(r->beta, 0);
    for (int k = 1; k <= row; k++)
        above = quadratic(r->beta, k) - quadratic(r->alpha, k - 1) * quadratic(r->gamma, k) / above;
    return above - quadratic(r->alpha, row) * below;
}

/* Leaver's eq. 20 for c = a omega, sorted by powers of k. In this equation k1 + k2 = max(|m|, 2). */
static struct recurrence angular(int m, double complex c, double complex separation)
{
    double k1 = 0.5 * abs(m - S), k12 = k1 + 0.5 * abs(m + S);
    return (struct recurrence) {
        .alpha = { -2 * (2 * k1 + 1), -2 * (2 * k1 + 2), -2 },
        .beta = { k12 * (k12 + 1) - 2 * c * (2 * k1 + S + 1) - c * c - S * (S + 1) - separation,
                  2 * (k12 + 1 - 2 * c) - 1, 1 },
        .gamma = { 2 * c * (k12 + S), 2 * c, 0 },
    };
}

/* Leaver's eqs. 25 and 26 for M = 1 instead of his 2M = 1: omega stands for his omega/2, and a for his 2a. */
static struct recurrence radial(int m, double a, double complex omega, double complex separation)
{
    double b = sqrt((1 - a) * (1 + a));
    double complex w = 2 * omega, iw = I * w, turn = (omega - 0.5 * a * m) / b;
    double complex c0 = 1 - S - iw - 2 * I * turn, c1 = -4 + 2 * iw * (2 + b) + 4 * I * turn,
                   c2 = S + 3 - 3 * iw - 2 * I * turn,
                   c3 = w * w * (4 + 2 * b - 0.25 * a * a) - a * m * w - S - 1 + (2 + b) * iw - separation +
                        (4 * w + 2 * I) * turn,
                   c4 = S + 1 - 2 * w * w - (2 * S + 3) * iw - (4 * w + 2 * I) * turn;
    return (struct recurrence) {
        .alpha = { c0, c0 + 1, 1 },
        .beta = { c3, c1 + 2, -2 },
        .gamma = { c4 - c2 + 2, c2 - 3, 1 },
    };
}

struct problem {
    int l, m, n;
    double a, tolerance;
    double complex c, separation; /* a omega; and A_lm, first a guess, then the eigenvalue */
};

/* The minimal solution of the radial recurrence behaves as a_{k+1}/a_k = 1 + p/sqrt(k) + q/k + ..., with p^2 = -2 i
 * b w and Re(p) < 0, and q from the order after next (Nollert 1993). An error at the start of the fraction decays as
 * exp(4 Re(p) sqrt(k)). */
static double complex radial_fraction(const struct problem *problem, const struct recurrence *r, double complex omega)
{
    double a = problem->a, b = sqrt((1 - a) * (1 + a));
    double complex p = -csqrt(-4 * I * b * omega);
    double complex c0 = r->alpha[0], c2 = r->gamma[1] + 3, q = 0.5 * (p * p + c2 - c0 - 3.5);
    /* because of p and q fewer terms suffice than the tolerance alone would require; at most 1e5 terms are used */
    double root = fmin(-0.75 * log(fmin(problem->tolerance, 1e-9)) / (-4 * creal(p)), 316);
    int terms = 50 + (int)(root * root);
    double k = problem->n + terms;
    return fraction(r, problem->n, terms, -(1 + p / sqrt(k) + q / k));
}

static double complex angular_at(struct problem *p, double complex separation)
{
    struct recurrence r = angular(p->m, p->c, separation);
    int first = abs(p->m) > -S ? abs(p->m) : -S;
    /* The omitted part is of the order of (4c)^k/k!, which is below 1e-16 at this k. */
    return fraction(&r, p->l - first, 24 + (int)(14 * cabs(p->c)), 0);
}

typedef double complex (*function)(struct problem *p, double complex x);

/* The secant method from x and x + step. The only estimate of the error is the size of the last step. When steps are
 * below `settled`, the method continues until they stop shrinking. Near a = 1 this happens early. */
static const double settled = 1e-9;

static bool solve(function f, struct problem *p, double complex *x, double complex step)
{
    double complex x0 = *x, f0 = f(p, x0), x1 = x0 + step;
    double last = INFINITY;
    for (int i = 0; i < ITERATIONS && f0 != 0; i++) {
        double complex f1 = f(p, x1), by = -f1 * (x1 - x0) / (f1 - f0);
        double size = f1 == 0 ? 0 : cabs(by) / cabs(x1);
        if (!(size < last || last > settled))
            break;
        x0 = x1, f0 = f1, last = size;
        x1 += by;
        if (size < p->tolerance)
            break;
    }
    *x = f0 == 0 ? x0 : x1;
    return f0 == 0 || last < fmax(p->tolerance, settled);
}

static double complex radial_at(struct problem *p, double complex omega)
{
    p->c = p->a * omega;
    if (!solve(angular_at, p, &p->separation, 1e-6))
        return NAN;
    struct recurrence r = radial(p->m, p->a, omega, p->separation);
    return radial_fraction(p, &r, omega);
}

static const double precise = 4e-16, rough = 1e-5;

static bool improve(const struct kd_qnm_branch *branch, double a, double tolerance, struct kd_qnm *mode)
{
    struct problem p = { branch->l, branch->m, branch->n, a, tolerance, 0, mode->separation };
    if (!solve(radial_at, &p, &mode->omega, 1e-4 * cabs(mode->omega)))
        return false;
    mode->separation = p.separation;
    return true;
}

/* Dolan & Ottewill 2009 (spin 2 in Schwarzschild): omega in inverse powers of L = l + 1/2, N = n + 1/2. Its error is
 * less than a tenth of the distance to the next overtone for n <= 3, l >= 2. */
static double complex schwarzschild(int l, int n)
{
    double inverse = 1 / (l + 0.5), N = n + 0.5, N2 = N * N, beta = 1 - S * S;
    double complex sum =
        -beta * beta / 27 + beta * (204 * N2 + 211) / 3888 + (854160 * N2 * N2 - 1664760 * N2 - 776939) / 40310784;
    sum = sum * inverse - I * N * (beta / 9 + 235 * N2 / 3888 - 1415.0 / 15552);
    sum = sum * inverse + beta / 3 - 5 * N2 / 36 - 115.0 / 432;
    sum = sum * inverse - I * N;
    return (sum + l + 0.5) / sqrt(27);
}

/* Variable of the spin in which the curves of all modes are smooth: y = -ln(1 - a). */
static double stretched(double a) { return -log1p(-a); }

/* Stores a point for extrapolation, unless it is so close to a stored point that their difference would be noise. */
static void remember(struct kd_qnm_branch *b)
{
    double y = stretched(b->a);
    for (int i = 0; i < b->points; i++)
        if (fabs(y - b->y[i]) < 0.01)
            return;
    for (int i = 2; i > 0; i--)
        b->y[i] = b->y[i - 1], b->past[i] = b->past[i - 1];
    b->y[0] = y, b->past[0] = b->at;
    b->points += b->points < 3;
}

/* Extrapolates by the parabola through the last three points; with fewer points, by the polynomial through these. */
static struct kd_qnm extrapolated(const struct kd_qnm_branch *b, double y)
{
    struct kd_qnm sum = { 0, 0 };
    for (int i = 0; i < b->points; i++) {
        double weight = 1;
        for (int j = 0; j < b->points; j++)
            if (j != i)
                weight *= (y - b->y[j]) / (b->y[i] - b->y[j]);
        sum.omega += weight * b->past[i].omega;
        sum.separation += weight * b->past[i].separation;
    }
    return sum;
}

bool kd_qnm_start(struct kd_qnm_branch *branch, int l, int m, int n)
{
    if (l < KD_QNM_L_MIN || l > KD_QNM_L_MAX || abs(m) > l || n < 0 || n > KD_QNM_N_MAX)
        return false;
    *branch = (struct kd_qnm_branch) {
        .l = l,
        .m = m,
        .n = n,
        .step = 0.05,
        .at = { schwarzschild(l, n), l * (l + 1) - S * (S + 1) },
    };
    if (!improve(branch, 0, precise, &branch->at))
        return false;
    remember(branch);
    return true;
}

bool kd_qnm_move(struct kd_qnm_branch *branch, const struct kd_hole *hole)
{
    const double a = hole->a;
    if (!(a >= 0 && a <= KD_QNM_SPIN_MAX))
        return false;
    /* As a -> 1 overtones come as near as Im(omega)/(n + 1/2), and curves bend sharply where the undamped modes
     * separate from the damped ones (l = 2, m = 1, n = 1 at a = 0.995). A solution within a hundredth of that distance
     * from the prediction is the wanted mode and not a neighbouring one; a tenth would not be safe. Near a = 0 the
     * extrapolation has no parabola yet, but there is no close neighbour either. */
    const double apart = 1 / (branch->n + 0.5), target = stretched(a);
    while (branch->a != a) {
        double y = stretched(branch->a), left = target - y;
        double next = fabs(left) <= branch->step ? a : -expm1(-(y + copysign(branch->step, left)));
        struct kd_qnm guess = extrapolated(branch, stretched(next)), mode = guess;
        if (improve(branch, next, next == a ? precise : rough, &mode) &&
            cabs(mode.omega - guess.omega) < (branch->points < 3 ? 0.1 : 0.01) * apart * -cimag(mode.omega)) {
            branch->a = next, branch->at = mode;
            remember(branch);
            branch->step *= next == a ? 1 : 2;
        } else if ((branch->step = fmin(branch->step, fabs(left)) / 2) < 1e-6) {
            return false;
        }
    }
    return true;
}

bool kd_qnm_find(int l, int m, int n, const struct kd_hole *hole, struct kd_qnm *mode)
{
    const double a = hole->a;
    struct kd_qnm_branch branch;
    bool found = kd_qnm_start(&branch, l, a < 0 ? -m : m, n) && kd_qnm_move(&branch, kd_hole(fabs(a)));
    *mode = found ? branch.at : (struct kd_qnm) { NAN, NAN };
    return found;
}
