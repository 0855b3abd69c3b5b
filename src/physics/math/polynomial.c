#include "physics/math/polynomial.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

double kd_polynomial_at(const double *c, int degree, double x)
{
    double sum = c[degree];
    for (int i = degree - 1; i >= 0; i--)
        sum = sum * x + c[i];
    return sum;
}

/* True if the polynomial's value at x is zero within rounding. */
static bool vanishes(const double *c, int degree, double x)
{
    double size = fabs(c[degree]);
    for (int i = degree - 1; i >= 0; i--)
        size = size * fabs(x) + fabs(c[i]);
    return fabs(kd_polynomial_at(c, degree, x)) <= 8 * DBL_EPSILON * size;
}

/* Finds the root between two points where the polynomial has opposite signs and is monotone, by Newton's method within
 * this bracket. */
static double between(const double *c, int degree, double low, double high)
{
    bool rising = kd_polynomial_at(c, degree, low) < 0;
    double x = 0.5 * (low + high);
    for (int i = 0; i < 200; i++) {
        double f = c[degree], slope = 0;
        for (int k = degree - 1; k >= 0; k--) {
            slope = slope * x + f;
            f = f * x + c[k];
        }
        if (f == 0)
            return x;
        if ((f < 0) == rising)
            low = x;
        else
            high = x;
        double next = slope != 0 ? x - f / slope : low;
        if (next == x)
            return x;
        if (!(next > low && next < high))
            next = 0.5 * (low + high);
        if (!(next > low && next < high))
            return next;
        x = next;
    }
    return x;
}

int kd_polynomial_roots(const double *c, int degree, double low, double high, double *roots)
{
    double slope[KD_POLYNOMIAL_DEGREE], turns[KD_POLYNOMIAL_DEGREE + 1];
    int n = 0, n_turns = 0;
    while (degree > 0 && c[degree] == 0)
        degree--;
    if (degree < 1)
        return 0;
    for (int i = 1; i <= degree; i++)
        slope[i - 1] = i * c[i];
    if (degree > 1)
        n_turns = kd_polynomial_roots(slope, degree - 1, low, high, turns);
    turns[n_turns++] = high;
    double left = low;
    bool touched = false; /* true if the left end of the interval is a root that has been counted */
    for (int i = 0; i < n_turns && n < degree; i++) {
        double right = turns[i], f_left = kd_polynomial_at(c, degree, left),
               f_right = kd_polynomial_at(c, degree, right);
        bool touches = i + 1 < n_turns && vanishes(c, degree, right);
        if (touches && (i + 2 == n_turns || turns[i + 1] != right)) {
            roots[n++] = right;
            if (n < degree)
                roots[n++] = right;
        } else if (!touches && !touched && (f_left == 0 || (f_left < 0) != (f_right < 0))) {
            roots[n++] = f_left == 0 ? left : between(c, degree, left, right);
        }
        touched = touches;
        left = right;
    }
    return n;
}
