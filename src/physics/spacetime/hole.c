#include "physics/spacetime/hole.h"

struct kd_metric_scalars kd_metric_at(const struct kd_hole *hole, double r, double cos_theta)
{
    double a = hole->a, w = r * r + a * a, s2 = (1 - cos_theta) * (1 + cos_theta);
    struct kd_metric_scalars m = { .sigma = r * r + a * a * cos_theta * cos_theta, .delta = kd_hole_delta(hole, r) };
    m.area = w * w - a * a * m.delta * s2;
    m.omega = a * (2 * r - hole->q * hole->q) / m.area;
    m.lapse2 = m.sigma * m.delta / m.area;
    return m;
}
