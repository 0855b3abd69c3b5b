/* Illumination of bodies by the disk. The disk is taken as smooth and thin, with KD_LIT_RINGS rings of KD_LIT_PLACES
 * places each, evenly spaced in ln r and azimuth. Light travels from the disk to a body on straight lines, and nothing
 * casts shadows. A place of area dA and brightness I, seen at distance d in the direction n from the centre of a body
 * at height z over the plane, contributes
 *
 *   dF = I g^4 (z/d) dA/d^2 / D^2,   g = D (lapse there/lapse here)/(gamma' (1 + v'.n)),   D = gamma (1 + v.n),
 *
 * where v' and v are the velocities of gas and body relative to observers of zero angular momentum, whose frames are
 * taken as parallel. In the body's frame the source has a solid angle smaller by D^2, in the direction n' = (n + gamma
 * v (1 + gamma/(gamma + 1) v.n))/D. The numbers of a body are the sums of dF, dF n' and dF n'n', and the mean of g
 * times the temperature, weighted by dF. The sums determine the illumination of each side to second order
 * (shaders/emit/bodies.glsl). */
#include "render/emit/bodies.h"

#include "physics/spacetime/kerr.h"
#include "render/emit/emitter.h"
#include "scene/hole.h"

#include <math.h>
#include <string.h>

bool kd_illumination_exists(const struct kd_scene *scene)
{
    return scene->disk.model != KD_DISK_NONE && !(scene->disk.height > 0);
}

bool kd_illumination_of(const struct kd_scene *scene, struct kd_illumination *out)
{
    const struct kd_hole *const hole = kd_scene_hole(scene);
    const double inner = kd_disk_inner(scene), outer = scene->disk.outer, step = log(outer / inner) / KD_LIT_RINGS;
    double radii[KD_LIT_RINGS], heats[KD_LIT_RINGS];
    if (!kd_illumination_exists(scene))
        return false;
    for (int i = 0; i < KD_LIT_RINGS; i++)
        radii[i] = inner * exp(step * (i + 0.5));
    kd_disk_heats(scene, KD_LIT_RINGS, radii, heats);
    for (int i = 0; i < KD_LIT_RINGS; i++) {
        const double r = radii[i], t = heats[i];
        const struct kd_metric_scalars m = kd_metric_at(hole, r, 0);
        const double along = sqrt(m.area) / r, lapse = sqrt(m.lapse2);
        out->rings[i] = (struct kd_illumination_ring) {
            .r = r,
            .t = t,
            .light = t * t * t * t * r * r * step * (2 * M_PI / KD_LIT_PLACES),
            .lapse = lapse,
            .velocity = (kd_kerr_omega(hole, r) - m.omega) * along / lapse,
        };
    }
    return true;
}

/* Adds the light of a place, in components along r, theta, phi of the body. */
static void add(const struct kd_illumination_ring *ring, double turn, const struct kd_seen_body *b, double lapse,
                float out[12])
{
    const double c = cos(turn), s = sin(turn), x = ring->r * c, y = ring->r * s, height = b->r * b->u;
    /* Vector from the body to the place, Cartesian; the body is at azimuth 0. */
    const double to[3] = { x - b->r * b->s, y, -height },
                 d2 = fmax(to[0] * to[0] + y * y + height * height, b->radius * b->radius), d = sqrt(d2);
    double n[3] = { (b->s * to[0] + b->u * to[2]) / d, (b->u * to[0] - b->s * to[2]) / d, y / d };
    const double v2 =
        b->velocity[0] * b->velocity[0] + b->velocity[1] * b->velocity[1] + b->velocity[2] * b->velocity[2];
    const double nears = b->velocity[0] * n[0] + b->velocity[1] * n[1] + b->velocity[2] * n[2],
                 comes = -ring->velocity * (-s * to[0] + c * y) / d;
    const double gamma = 1 / sqrt(1 - v2), doppler = gamma * (1 + nears),
                 more = gamma * (1 + gamma / (gamma + 1) * nears);
    const double g = doppler * ring->lapse / lapse * sqrt(1 - ring->velocity * ring->velocity) / (1 - comes),
                 g2 = g * g / doppler;
    const double f = g2 * g2 * ring->light * fabs(height) / (d * d2);
    for (int i = 0; i < 3; i++)
        n[i] = (n[i] + more * b->velocity[i]) / doppler;
    const double sums[12] = { f,
                              f * n[0],
                              f * n[1],
                              f * n[2],
                              f * n[0] * n[0],
                              f * n[1] * n[1],
                              f * n[2] * n[2],
                              f * g * ring->t,
                              f * n[0] * n[1],
                              f * n[0] * n[2],
                              f * n[1] * n[2],
                              0 };
    for (int i = 0; i < 12; i++)
        out[i] += (float)sums[i];
}

void kd_illumination_body(const struct kd_illumination *lit, const struct kd_seen_body *b, double lapse, float out[12])
{
    memset(out, 0, 12 * sizeof *out);
    if (!lit || !(b->albedo > 0))
        return;
    for (int i = 0; i < KD_LIT_RINGS; i++)
        for (int k = 0; k < KD_LIT_PLACES; k++)
            add(&lit->rings[i], (k + 0.5) * (2 * M_PI / KD_LIT_PLACES), b, lapse, out);
    const float mean = out[0] > 0 ? out[7] / out[0] : 0;
    for (int i = 0; i < 12; i++) /* a Lambertian surface reflects 1/pi of the flux into each direction */
        out[i] *= (float)(b->albedo / M_PI);
    out[7] = mean;
}
