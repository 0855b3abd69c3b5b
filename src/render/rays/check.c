#include "render/rays/check.h"

#include "physics/math/angle.h"
#include "physics/spacetime/kerr.h"
#include "render/rays/fields.h"
#include "render/rays/looks.h"

#include <math.h>
#include <stdio.h>

static enum kd_status check_observer(const struct kd_rays_params *p, struct kd_error *error)
{
    enum kd_status status = kd_rays_field_check("spin", p->spin, error);
    if (status)
        return status;
    const struct kd_hole hole = kd_rays_hole(p);
    status = kd_hole_check(&hole, error);
    if (status)
        return status;
    double horizon = hole.outer;
    if (!isinf(p->r) && !(p->r > horizon && p->r <= KD_RAYS_FAR))
        return kd_error_field(error, "/observer/r",
                              "r is %.16g; it must be \"infinity\", or more than %.9g, the horizon, and at most %g",
                              p->r, horizon, KD_RAYS_FAR);
    if (!(p->r > 0))
        return kd_error_field(error, "/observer/r", "r is negative");
    status = kd_rays_field_check("inclination_deg", p->inclination_deg, error);
    return status || !p->observer ? status : kd_rays_looks_check(p, error);
}

static enum kd_status check_accuracy(const struct kd_rays_params *p, struct kd_error *error)
{
    bool closed = p->engine == KD_ENGINE_CLOSED;
    enum kd_status status = kd_rays_field_check("orders", p->orders, error);
    if (status)
        return status;
    if ((unsigned)p->engine >= KD_ENGINE_COUNT || (unsigned)p->precision > KD_PRECISION_F64)
        return kd_error_field(error, "/accuracy", "the engine or the precision does not exist");
    if (closed && p->precision != KD_PRECISION_F64)
        return kd_error_field(
            error, "/accuracy/precision",
            "with engine \"closed\" precision must be \"f64\", because that engine works in double precision");
    if (closed && p->steps)
        return kd_error_field(
            error, "/accuracy/steps",
            "steps cannot be used with engine \"closed\", because that engine takes no steps; steps must be 0");
    if (p->steps % 4 || p->steps > kd_engine_most_steps(p->engine))
        return kd_engine_steps_error(p->engine, p->steps, error);
    return KD_OK;
}

static enum kd_status check_number(double value, size_t ray, int component, struct kd_error *error)
{
    char pointer[64];
    if (fabs(value) <= KD_RAYS_FAR)
        return KD_OK;
    snprintf(pointer, sizeof pointer, "/rays/%zu/%d", ray, component);
    return kd_error_field(error, pointer, "%s of ray %zu is %.16g; it must be -1e7 to 1e7 M",
                          component ? "beta" : "alpha", ray, value);
}

static enum kd_status check_direction(const double *yaw_pitch, size_t ray, struct kd_error *error)
{
    static const struct {
        const char *name;
        double most;
    } angles[] = { { "yaw", 180 }, { "pitch", 90 } };
    char pointer[64];
    for (int i = 0; i < 2; i++) {
        if (fabs(yaw_pitch[i]) <= angles[i].most)
            continue;
        snprintf(pointer, sizeof pointer, "/rays/%zu/%d", ray, i);
        return kd_error_field(error, pointer,
                              "%s of ray %zu is %.16g; with an observer's motion a ray is [yaw, pitch], and %s must be "
                              "-%g to %g degrees",
                              angles[i].name, ray, yaw_pitch[i], angles[i].name, angles[i].most, angles[i].most);
    }
    return KD_OK;
}

enum kd_status kd_rays_check(const struct kd_rays_params *p, const double *alpha_beta, size_t n, struct kd_error *error)
{
    enum kd_status status;
    KD_TRY(check_observer(p, error));
    KD_TRY(check_accuracy(p, error));
    if (!n || n > KD_RAYS_MAX)
        KD_TRY(kd_error_field(error, "/rays", "there are %zu rays; there must be 1 to %d", n, KD_RAYS_MAX));
    for (size_t i = 0; i < n && p->observer; i++)
        KD_TRY(check_direction(alpha_beta + 2 * i, i, error));
    if (p->observer)
        return KD_OK;
    double s = kd_sin_deg(p->inclination_deg), u = kd_cos_deg(p->inclination_deg), u2 = u * u, a = p->spin, r = p->r;
    const struct kd_hole hole = kd_rays_hole(p);
    double delta = kd_hole_delta(&hole, r);
    for (size_t i = 0; i < n; i++) {
        double alpha = alpha_beta[2 * i], beta = alpha_beta[2 * i + 1];
        KD_TRY(check_number(alpha, i, 0, error));
        KD_TRY(check_number(beta, i, 1, error));
        if (isinf(r))
            continue;
        /* The radial potential at the observer. If it is negative, no light with these constants exists there. */
        double lambda = -alpha * s, eta = (alpha * alpha - a * a) * u2 + beta * beta, w = r * r + a * a - a * lambda;
        if (w > 0 && w * w >= delta * (eta + (lambda - a) * (lambda - a)))
            continue;
        char pointer[32];
        snprintf(pointer, sizeof pointer, "/rays/%zu", i);
        KD_TRY(kd_error_field(error, pointer,
                              "no light with the constants of ray %zu, alpha = %.9g and beta = %.9g, "
                              "reaches an observer at r = %.9g",
                              i, alpha, beta, r));
    }
done:
    return status;
}
