#include "physics/waves/ringdown.h"

#include "physics/spacetime/hole.h"

#include <math.h>

double kd_ringdown_quality(double complex omega) { return creal(omega) / (-2 * cimag(omega)); }

double kd_ringdown_wave(double complex omega, double t) { return exp(cimag(omega) * t) * cos(creal(omega) * t); }

double kd_ringdown_quality_cubic(const struct kd_hole *hole)
{
    const double a = hole->a;
    return 2.1 + 11.3 * a * a * a;
}

struct kd_ringdown_fit kd_ringdown_fit(int n, const struct kd_hole *hole)
{
    const double a = hole->a;
    static const struct {
        double f[3], q[3];
    } table[] = {
        { { 1.5251, -1.1568, 0.1292 }, { 0.7000, 1.4187, -0.4990 } },
        { { 1.3673, -1.0260, 0.1628 }, { 0.1000, 0.5436, -0.4731 } },
        { { 1.3223, -1.0257, 0.1860 }, { -0.1000, 0.4206, -0.4256 } },
    };
    if (n < 0 || n > 2 || !(a >= 0 && a < 1))
        return (struct kd_ringdown_fit) { NAN, NAN };
    const double *f = table[n].f, *q = table[n].q;
    return (struct kd_ringdown_fit) { f[0] + f[1] * pow(1 - a, f[2]), q[0] + q[1] * pow(1 - a, q[2]) };
}
