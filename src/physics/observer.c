#include "physics/observer.h"

#include "physics/kerr.h"

#include <math.h>
#include <stdio.h>

static double delta_of(const struct kd_vantage *at)
{
    return (at->r - kd_kerr_horizon(at->spin)) * (at->r - kd_kerr_inner_horizon(at->spin));
}

/* Bardeen, Press & Teukolsky 1972, ApJ 178, 347, section III. */
static struct kd_tetrad frame_zamo(const struct kd_vantage *at)
{
    double a = at->spin, r = at->r, u = at->u, s = at->s;
    double sigma = r * r + a * a * u * u, delta = delta_of(at), w2 = r * r + a * a;
    double big = w2 * w2 - a * a * delta * s * s; /* g_phiphi = big sin^2 / sigma */
    double root = sqrt(big / sigma);
    return (struct kd_tetrad) {
        .t = { .energy = sqrt(sigma * delta / big) },
        .r = { .radial = sqrt(sigma) * sqrt(delta) },
        .theta = { .polar = sqrt(sigma) },
        .phi = { .energy = kd_kerr_dragging(a, r, u) * root * s, .momentum = root },
    };
}

/* The velocity is along the Killing vector d_t, and e_phi in the plane of d_t and d_phi: by g_tt and g_tphi. */
static struct kd_tetrad frame_static(const struct kd_vantage *at)
{
    double a = at->spin, r = at->r, u = at->u, s = at->s;
    double sigma = r * r + a * a * u * u, delta = delta_of(at);
    double lapse = sqrt((sigma - 2 * r) / sigma); /* sqrt(-g_tt) */
    return (struct kd_tetrad) {
        .t = { .energy = lapse, .momentum = -2 * a * r * s / (sigma * lapse) },
        .r = { .radial = sqrt(sigma) * sqrt(delta) },
        .theta = { .polar = sqrt(sigma) },
        .phi = { .momentum = sqrt(delta) / lapse },
    };
}

#define OUTSIDE(NAME, word, what, where, outside, ...)                                                         \
    static double outside_of_##word(double a, double u)                                                        \
    {                                                                                                          \
        (void)u;                                                                                               \
        return outside;                                                                                        \
    }
KD_OBSERVERS(OUTSIDE)

#define ROW(NAME, name, what, where, edge_r, edge_name, not_inside)                                            \
    [KD_OBSERVER_##NAME] = { #name, edge_name, not_inside, outside_of_##name, frame_##name },
const struct kd_observer_row kd_observers[] = { KD_OBSERVERS(ROW) };

#define FITS(NAME, word, ...) _Static_assert(sizeof #word <= 11, "room in KD_OBSERVER_TEXT for \"" #word "\", quoted, and \" or \"");
KD_OBSERVERS(FITS)

bool kd_observer_exists(enum kd_observer observer, const struct kd_vantage *at)
{
    return at->r > kd_observers[observer].outside(at->spin, at->u);
}

struct kd_tetrad kd_observer_tetrad(enum kd_observer observer, const struct kd_vantage *at)
{
    struct kd_tetrad frame = kd_observers[observer].tetrad(at);
    frame.at = *at;
    return frame;
}

const char *kd_observer_others(const struct kd_vantage *at, char out[KD_OBSERVER_TEXT])
{
    int used = 0;
    snprintf(out, KD_OBSERVER_TEXT, "none");
    for (int i = 0; i < KD_OBSERVER_COUNT; i++)
        if (kd_observer_exists((enum kd_observer)i, at))
            used += snprintf(out + used, (size_t)(KD_OBSERVER_TEXT - used), "%s\"%s\"", used ? " or " : "", kd_observers[i].word);
    return out;
}
