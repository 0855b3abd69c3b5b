#include "physics/disk/limb.h"

#include "physics/disk/scattering.h"

#include <math.h>
#include <pthread.h>

/* Table of the scattered light, with nodes in the fourth root of mu. In this variable the term mu ln(mu) of the H
 * functions is smooth enough for cubic interpolation. */
enum { CELLS = 160 };
/* values from one step below 0 to one step above 1: interpolation in the first and last cell needs one node outside */
static double table[CELLS + 3];
static pthread_once_t made = PTHREAD_ONCE_INIT;

static void make(void)
{
    double mu[CELLS + 1];
    struct kd_scattered light[CELLS + 1];
    for (int i = 0; i <= CELLS; i++)
        mu[i] = pow((double)i / CELLS, 4);
    kd_scattered_light(mu, CELLS + 1, light);
    for (int i = 0; i <= CELLS; i++)
        table[i + 1] = light[i].across + light[i].along;
    /* the value below 0 continues the cubic through the four nearest nodes */
    table[0] = 4 * table[1] - 6 * table[2] + 4 * table[3] - table[4];
    table[CELLS + 2] = 4 * table[CELLS + 1] - 6 * table[CELLS] + 4 * table[CELLS - 1] - table[CELLS - 2];
}

static double scattered(double mu)
{
    pthread_once(&made, make);
    const double at = CELLS * sqrt(sqrt(fmin(fmax(mu, 0), 1)));
    const int i = (int)fmin(at, CELLS - 1);
    const double x = at - i, *f = table + i;
    return f[0] * (-x * (x - 1) * (x - 2) / 6) + f[1] * ((x + 1) * (x - 1) * (x - 2) / 2) +
           f[2] * (-(x + 1) * x * (x - 2) / 2) + f[3] * ((x + 1) * x * (x - 1) / 6);
}

double kd_limb_at(enum kd_limb law, double mu)
{
    switch (law) {
    case KD_LIMB_LAOR: return 1 + 2.06 * mu;
    case KD_LIMB_HAARDT: return log1p(1 / fmax(mu, 1e-300));
    case KD_LIMB_SCATTERING: return scattered(mu);
    case KD_LIMB_ISOTROPIC: break;
    }
    return 1;
}

/* Only Laor's law needs a factor: for ln(1 + 1/mu) and for scattered light the integral is already 1/2. */
double kd_limb_scale(enum kd_limb law) { return law == KD_LIMB_LAOR ? 0.5 / (0.5 + 2.06 / 3) : 1; }
