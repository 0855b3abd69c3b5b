/* Follows a ray of an observer inside the horizon, where closed forms do not apply. Uses the steps of
 * physics/null/null_course.h in ingoing coordinates. */
#include "render/explain/motion.h"

#include "physics/disk/thin_disk.h"
#include "physics/spacetime/kerr.h"

#include <math.h>
#include <stdlib.h>

/* fraction of the horizon's radius. If a ray from outside crosses the plane within this distance of the horizon, the
 * crossing counts as on the horizon */
#define NEAR 1e-4

/* Redshift factor at a crossing. outwards: true if the photon leaves the gas with p^r > 0. The traced-back ray moves
 * inwards there. */
static double redshift(const struct kd_ray_motion *m, double r, bool outwards)
{
    const struct kd_hole *hole = &m->ray.hole;
    return r >= kd_kerr_isco(hole) ? kd_disk_redshift(hole, r, m->lambda)
                                   : kd_disk_redshift_plunging(hole, r, m->lambda, m->eta, outwards);
}

/* Inside the horizon azimuth and time stay ingoing. A crossing there has no g, because there is no gas. */
static struct kd_ray_crossing crossing_of(const struct kd_ray_motion *m, bool reversed, const struct kd_null_place *p,
                                          bool inwards)
{
    const bool outside = p->r > m->horizon;
    const double twist = outside ? kd_kerr_twist(&m->ray.hole, p->r) : 0;
    return (struct kd_ray_crossing) {
        .r = p->r,
        .phi = p->phi + (reversed ? -twist : twist),
        .delay = p->delay,
        .g = outside ? redshift(m, p->r, inwards) : NAN,
    };
}

static void find_end(const struct kd_null_course *course, const struct kd_null_place *places, struct kd_ray_end *end)
{
    end->fate = course->end == KD_COURSE_ESCAPED    ? KD_RAY_ESCAPED
                : course->end == KD_COURSE_CAPTURED ? KD_RAY_CAPTURED
                                                    : KD_RAY_UNDECIDED;
    end->theta = end->fate == KD_RAY_ESCAPED ? acos(places[course->n - 1].u) : NAN;
    end->phi = end->fate == KD_RAY_ESCAPED ? remainder(places[course->n - 1].phi, 2 * M_PI) : NAN;
    end->error = NAN;
}

enum kd_status kd_ray_within(const struct kd_ray_motion *m, bool reversed, struct kd_ray_crossing *crossings,
                             struct kd_ray_end *end, struct kd_error *error)
{
    struct kd_null_place *places = malloc(KD_PATH_PLACES * sizeof *places);
    if (!places)
        return kd_error_set(error, KD_ENOMEM, "out of memory for the path of a ray");
    const struct kd_null_course course =
        kd_null_course_ingoing(&m->ray, reversed, INFINITY, NEAR * m->horizon, places, KD_PATH_PLACES);
    *end = (struct kd_ray_end) { 0 };
    for (size_t i = 0; i + 1 < course.n; i++)
        if (places[i].crossing >= 0 && places[i].crossing < m->ray.orders) {
            crossings[places[i].crossing] = crossing_of(m, reversed, &places[i], places[i + 1].r < places[i].r);
            end->n_crossings = (uint32_t)places[i].crossing + 1;
        }
    find_end(&course, places, end);
    free(places);
    return KD_OK;
}
