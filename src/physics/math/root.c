#include "physics/math/root.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

struct point { double x, f; };

/* Place of the next evaluation, as a fraction of the way from a to b. It comes from inverse quadratic interpolation
 * through a, b and c if the inverse function is monotone there, and otherwise from bisection. */
static double fraction(struct point a, struct point b, struct point c)
{
    double xi = (a.x - b.x) / (c.x - b.x), phi = (a.f - b.f) / (c.f - b.f);
    if (!(1 - sqrt(1 - xi) < phi && phi < sqrt(xi)))
        return 0.5;
    return a.f / (b.f - a.f) * c.f / (b.f - c.f) + (c.x - a.x) / (b.x - a.x) * a.f / (c.f - a.f) * b.f / (c.f - b.f);
}

double kd_root(kd_root_fn f, const void *user, double low, double high)
{
    struct point a = { low, f(user, low) }, b = { high, f(user, high) };
    if (a.f == 0)
        return low;
    if (b.f == 0)
        return high;
    if (!(a.f < 0 ? b.f > 0 : b.f < 0))
        return NAN;
    /* floor: width of the smallest bracket, for roots at 0 */
    double floor = 0.01 * DBL_EPSILON * fmax(fabs(low), fabs(high)), t = 0.5;
    for (;;) {
        struct point x = { .x = a.x + t * (b.x - a.x) }, c;
        x.f = f(user, x.x);
        if ((x.f > 0) == (a.f > 0)) {
            c = a;
        } else {
            c = b;
            b = a;
        }
        a = x;
        struct point best = fabs(a.f) < fabs(b.f) ? a : b;
        double least = (DBL_EPSILON * fabs(best.x) + floor) / fabs(b.x - a.x);
        if (best.f == 0 || !(least < 0.5))
            return best.x;
        t = fmin(fmax(fraction(a, b, c), least), 1 - least);
    }
}
