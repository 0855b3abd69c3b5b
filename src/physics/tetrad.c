#include "physics/tetrad.h"

#include "physics/kerr.h"

#include <math.h>

static double delta_of(double a, double r)
{
    return (r - kd_kerr_horizon(a)) * (r - kd_kerr_inner_horizon(a));
}

struct kd_tetrad kd_tetrad_zamo(double a, double r, double u, double s)
{
    double sigma = r * r + a * a * u * u, delta = delta_of(a, r), w2 = r * r + a * a;
    double big = w2 * w2 - a * a * delta * s * s; /* g_phiphi = big sin^2 / sigma */
    double root = sqrt(big / sigma);
    return (struct kd_tetrad) { .e0 = sqrt(sigma * delta / big),
                                .e1 = kd_kerr_dragging(a, r, u) * root * s,
                                .l0 = 0,
                                .l1 = root,
                                .p = sqrt(sigma),
                                .root_delta = sqrt(delta) };
}

struct kd_tetrad kd_tetrad_static(double a, double r, double u, double s)
{
    double sigma = r * r + a * a * u * u, delta = delta_of(a, r);
    double lapse = sqrt((sigma - 2 * r) / sigma); /* sqrt(-g_tt) */
    return (struct kd_tetrad) { .e0 = lapse,
                                .e1 = 0,
                                .l0 = -2 * a * r * s / (sigma * lapse),
                                .l1 = sqrt(delta) / lapse,
                                .p = sqrt(sigma),
                                .root_delta = sqrt(delta) };
}

/* alpha = -L/(E sin(theta)) and beta = p_theta/E, with m_phi = -right and m_theta = up, solved for them. */
struct kd_look kd_tetrad_look(const struct kd_tetrad *frame, double alpha, double beta)
{
    double right = (frame->e0 * alpha + frame->l0) / (frame->l1 + frame->e1 * alpha), energy = frame->e0 - frame->e1 * right;
    double up = beta * energy / frame->p;
    return (struct kd_look) { right, up, sqrt(fmax(0, 1 - right * right - up * up)), energy };
}
