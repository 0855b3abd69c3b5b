#include "physics/spacetime/worldline.h"

#include "physics/spacetime/infall.h"
#include "physics/spacetime/kerr.h"

#include <math.h>

bool kd_worldline_is_known(const struct kd_observer_motion *m, const struct kd_vantage *at)
{
    if (!isfinite(at->r))
        return false;
    switch (m->observer) {
    case KD_OBSERVER_STATIC:
    case KD_OBSERVER_ZAMO: return true;
    case KD_OBSERVER_INFALL: return kd_infall_is_level(m, at);
    default: return kd_observer_sense(m->observer) && at->u == 0;
    }
}

/* dt/dtau and dphi/dtau of an observer at constant radius. An observer of zero angular momentum has E = -p_t = lapse,
 * and u^t = 1/lapse. */
static void pace(const struct kd_observer_motion *m, const struct kd_vantage *at, double *time, double *azimuth)
{
    const int sense = kd_observer_sense(m->observer);
    if (sense) {
        *time = kd_kerr_ut(kd_hole_turned(&at->hole, sense), at->r);
        *azimuth = sense * kd_kerr_omega(kd_hole_turned(&at->hole, sense), at->r) * *time;
        return;
    }
    const struct kd_tetrad frame = kd_observer_tetrad(m, at);
    *time = 1 / frame.t.energy; /* for a static observer E = sqrt(-g_tt) = 1/u^t */
    *azimuth = m->observer == KD_OBSERVER_ZAMO ? kd_kerr_dragging(&at->hole, at->r, at->u) * *time : 0;
}

struct kd_worldline_place kd_worldline_after(const struct kd_observer_motion *m, const struct kd_vantage *at,
                                             double proper_time)
{
    if (m->observer == KD_OBSERVER_INFALL) {
        const struct kd_infall_way way = kd_infall_after(m, at, proper_time);
        return (struct kd_worldline_place) { way.r, way.azimuth, way.time, way.far_time, way.ended };
    }
    double time, azimuth;
    pace(m, at, &time, &azimuth);
    time *= proper_time;
    return (struct kd_worldline_place) { at->r, azimuth * proper_time, time, time, false };
}

bool kd_worldline_goes_on(const struct kd_observer_motion *m, const struct kd_vantage *at)
{
    return m->observer != KD_OBSERVER_INFALL || at->r > kd_infall_last(&at->hole);
}
