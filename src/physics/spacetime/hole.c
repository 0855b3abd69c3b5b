#include "physics/spacetime/hole.h"

struct kd_hole kd_hole_charged(double a, double q)
{
    double a2 = a * a, q2 = q * q;
    if (q2 == 0) {
        struct kd_hole hole = kd_hole_of(a);
        hole.q = q;
        return hole;
    }
    double lost = fma(a, a, -a2) + fma(q, q, -q2);
    double larger = fmax(a2, q2), smaller = fmin(a2, q2), first = 1 - larger, rest = (1 - first) - larger;
    double sum = first - smaller, part = sum - first, rest2 = (first - (sum - part)) - (smaller + part);
    double root = sqrt(sum + (rest + rest2 - lost)), outer = 1 + root;
    return (struct kd_hole) { a, q, root, outer, (a2 + q2) / outer };
}

enum kd_status kd_hole_check(const struct kd_hole *hole, struct kd_error *error)
{
    if (!(fabs(hole->a) < 1))
        return kd_error_field(error, "/spin", "spin is %.16g; it must be a number above -1 and below 1", hole->a);
    if (!kd_hole_exists(hole))
        return kd_error_field(error, "/charge", "charge is %.16g M; with spin %.16g its magnitude must be below %.9g M",
                              hole->q, hole->a, sqrt((1 - hole->a) * (1 + hole->a)));
    return KD_OK;
}

const struct kd_hole_sentence *kd_hole_sentence(struct kd_hole_given given, size_t index)
{
#define TELL(x, name_, member, least, most, shown, unit, card, what, bound, help, source, told, text_) \
    static const struct kd_hole_sentence of_##name_ = { .name = told, .text = text_ }; \
    if (given.name_ != 0 && !index--) \
        return &of_##name_;
    KD_HOLE_MORE(TELL, )
#undef TELL
    return NULL;
}

struct kd_hole_parameter kd_hole_largest(const struct kd_hole *hole)
{
    if (fabs(hole->q) > fabs(hole->a))
        return (struct kd_hole_parameter) { "charge", "/charge", hole->q };
    return (struct kd_hole_parameter) { "spin", "/spin", hole->a };
}

struct kd_metric_scalars kd_metric_at(const struct kd_hole *hole, double r, double cos_theta)
{
    double a = hole->a, w = r * r + a * a, s2 = (1 - cos_theta) * (1 + cos_theta);
    struct kd_metric_scalars m = { .sigma = r * r + a * a * cos_theta * cos_theta, .delta = kd_hole_delta(hole, r) };
    m.area = w * w - a * a * m.delta * s2;
    m.omega = a * kd_hole_mass(hole, r) / m.area;
    m.lapse2 = m.sigma * m.delta / m.area;
    return m;
}
