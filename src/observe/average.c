/* Averages visibilities within bins of time, each baseline separately. */
#include "observe/reduce.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MJD_1960 36934 /* modified Julian date from which bins are counted */

/* Index of the time bin of a visibility. The time is first rounded to 0.1 s, because uvfits stores it in single
 * precision. */
static double bin_of(const struct kd_observation *o, double hour, double seconds)
{
    return floor(((o->mjd - MJD_1960) * 86400 + rint(hour * 36000) / 10) / seconds);
}

struct keyed {
    double bin;
    struct kd_measured m;
};

static int by_bin(const void *a, const void *b)
{
    const struct keyed *x = a, *y = b;
    if (x->bin != y->bin)
        return x->bin < y->bin ? -1 : 1;
    if (x->m.station[0] != y->m.station[0])
        return x->m.station[0] - y->m.station[0];
    if (x->m.station[1] != y->m.station[1])
        return x->m.station[1] - y->m.station[1];
    return x->m.hour < y->m.hour ? -1 : x->m.hour > y->m.hour;
}

static bool is_together(const struct keyed *x, const struct keyed *y)
{
    return x->bin == y->bin && x->m.station[0] == y->m.station[0] && x->m.station[1] == y->m.station[1];
}

/* Mean of n visibilities with independent errors. */
static struct kd_measured mean_of(const struct keyed *at, size_t n)
{
    struct kd_measured mean = { .station = { at->m.station[0], at->m.station[1] } };
    double variance = 0;
    for (size_t i = 0; i < n; i++) {
        mean.u += at[i].m.u, mean.v += at[i].m.v, mean.re += at[i].m.re, mean.im += at[i].m.im;
        variance += at[i].m.sigma * at[i].m.sigma;
    }
    const double over = 1 / (double)n;
    mean.u *= over, mean.v *= over, mean.re *= over, mean.im *= over;
    mean.sigma = sqrt(variance) * over;
    return mean;
}

enum kd_status kd_average(const struct kd_observation *o, double seconds, struct kd_measured **out, size_t *n,
                          struct kd_error *error)
{
    struct kd_measured *mean = malloc(o->n * sizeof *mean);
    struct keyed *keyed = seconds > 0 ? malloc(o->n * sizeof *keyed) : NULL;
    *n = 0;
    if (!mean || (seconds > 0 && !keyed)) {
        free(mean), free(keyed);
        return kd_error_set(error, KD_ENOMEM, "out of memory for %zu visibilities", o->n);
    }
    *out = mean;
    if (!(seconds > 0)) {
        memcpy(mean, o->at, o->n * sizeof *mean);
        *n = o->n;
        return KD_OK;
    }
    for (size_t i = 0; i < o->n; i++)
        keyed[i] = (struct keyed) { bin_of(o, o->at[i].hour, seconds), o->at[i] };
    qsort(keyed, o->n, sizeof *keyed, by_bin);
    for (size_t i = 0, next; i < o->n; i = next) {
        for (next = i + 1; next < o->n && is_together(&keyed[i], &keyed[next]);)
            next++;
        mean[*n] = mean_of(&keyed[i], next - i);
        mean[(*n)++].hour = ((keyed[i].bin + 0.5) * seconds - (o->mjd - MJD_1960) * 86400) / 3600;
    }
    free(keyed);
    return KD_OK;
}
