#include "render/rays/looks.h"

#include "physics/math/angle.h"
#include "render/view/camera.h"
#include "scene/observer_fault.h"

#include <math.h>

static struct kd_vantage vantage(const struct kd_rays_params *p)
{
    return (struct kd_vantage) { kd_rays_hole(p), p->r, kd_cos_deg(p->inclination_deg),
                                 kd_sin_deg(p->inclination_deg) };
}

static struct kd_observer_motion motion_of(const struct kd_rays_params *p)
{
    return (struct kd_observer_motion) { .observer = (enum kd_observer)(p->observer - 1),
                                         .velocity = { p->velocity[0], p->velocity[1], p->velocity[2] },
                                         .fall_from = p->fall_from,
                                         .fall_energy = p->fall_energy,
                                         .fall_momentum = p->fall_momentum };
}

enum kd_status kd_rays_looks_check(const struct kd_rays_params *p, struct kd_error *error)
{
    static const struct kd_observer_names names = { "/observer", "", "r", "motion" };
    const struct kd_observer_motion motion = motion_of(p);
    if (isinf(p->r))
        return kd_error_field(error, "/observer/motion",
                              "motion is \"%s\" and r is \"infinity\"; r must be finite for an observer that moves",
                              kd_observers[motion.observer].word);
    const struct kd_vantage at = vantage(p);
    enum kd_status status = kd_observer_check_place(&names, motion.observer, &at, error);
    return status ? status : kd_observer_check_numbers(&names, &motion, &at, error);
}

void kd_rays_looks_label(const struct kd_rays_params *p, const double *directions, size_t n, double *alpha_beta,
                         bool *outward, double *energy)
{
    const struct kd_observer_motion motion = motion_of(p);
    const struct kd_vantage at = vantage(p);
    const struct kd_tetrad frame = kd_observer_tetrad(&motion, &at);
    for (size_t i = 0; i < n; i++) {
        double cy = kd_cos_deg(directions[2 * i]), sy = kd_sin_deg(directions[2 * i]),
               cp = kd_cos_deg(directions[2 * i + 1]), sp = kd_sin_deg(directions[2 * i + 1]);
        /* The camera looks along -e_r, with e_phi to the right and -e_theta up; light travels the other way. */
        const struct kd_covector p_i = kd_tetrad_covector(&frame, (double[4]) { 1, cp * cy, sp, -cp * sy });
        struct kd_camera_label label;
        kd_camera_label_of(p_i.energy, p_i.momentum, p_i.polar, p_i.radial < 0, &label);
        alpha_beta[2 * i] = label.alpha, alpha_beta[2 * i + 1] = label.beta;
        outward[i] = label.outward, energy[i] = label.energy;
    }
}

void kd_rays_looks_see(const struct kd_rays_params *p, const double *energy, size_t n,
                       struct kd_ray_crossing *crossings, struct kd_ray_end *ends)
{
    for (size_t i = 0; i < n; i++) {
        const double sense = energy[i] < 0 ? -1 : 1;
        ends[i].energy = energy[i];
        ends[i].phi *= sense;
        for (uint32_t k = 0; k < ends[i].n_crossings; k++) {
            struct kd_ray_crossing *c = &crossings[i * p->orders + k];
            c->phi *= sense, c->delay *= sense;
            c->g /= energy[i]; /* g and energy are both negative for light whose energy at infinity is negative */
        }
    }
}
