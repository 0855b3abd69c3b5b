/* Closure phases and log closure amplitudes of one time (A. E. E. Rogers et al. 1974, ApJ 193, 293; A. A. Chael et al.
 * 2018, ApJ 857, 23, eqs. 11 to 15). The sets of triangles and quadrangles are those of ehtim's c_phases and
 * c_amplitudes. */
#include "observe/reduce.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define DEG (180 / M_PI)

/* Table of the visibilities of one time, by their two stations. */
struct table { uint32_t at[KD_OBSERVATION_STATIONS][KD_OBSERVATION_STATIONS]; /* index plus 1; 0: there is none */ };

static bool find(const struct table *t, struct kd_comparison_row *row, int k, uint8_t first, uint8_t second)
{
    const uint8_t low = first < second ? first : second, high = first < second ? second : first;
    row->at[k] = t->at[low][high] - 1;
    row->conjugate[k] = first > second;
    return t->at[low][high] > 0;
}

static double snr_of(const struct kd_measured *m) { return hypot(m->re, m->im) / m->sigma; }

/* Phase of the bispectrum of three visibilities. Its variance is the sum of the variances of the three phases, each
 * with an error of 1/snr. */
static bool phase_of(const struct kd_comparison *c, const struct kd_comparison_params *p, struct kd_comparison_row *row)
{
    double phase = 0, variance = 0;
    for (int k = 0; k < 3; k++) {
        const struct kd_measured *m = &c->at[row->at[k]];
        const double snr = snr_of(m);
        phase += row->conjugate[k] ? -atan2(m->im, m->re) : atan2(m->im, m->re);
        variance += 1 / (snr * snr);
    }
    row->data = remainder(phase, 2 * M_PI) * DEG;
    row->error = hypot(sqrt(variance) * DEG, p->systematic_closure_phase_deg);
    return isfinite(variance) && 1 / sqrt(variance) >= p->snr_cut;
}

/* Log closure amplitude. Unless amplitudes are used as measured, two corrections are made for noise. First, noise
 * increases the mean of an amplitude, so the amplitude is debiased. Second, to second order, noise decreases the mean
 * of a debiased amplitude's logarithm by 1/(2 snr^2), so this number is added. */
static bool amplitude_of(const struct kd_comparison *c, const struct kd_comparison_params *p,
                         struct kd_comparison_row *row)
{
    double sum = 0, variance = 0;
    for (int k = 0; k < 4; k++) {
        const struct kd_measured *m = &c->at[row->at[k]];
        const double measured = hypot(m->re, m->im),
                     amplitude = p->measured           ? measured
                                 : measured > m->sigma ? sqrt((measured - m->sigma) * (measured + m->sigma))
                                                       : m->sigma,
                     over_snr2 = m->sigma / amplitude * (m->sigma / amplitude);
        sum += (k < 2 ? 1 : -1) * (log(amplitude) + (p->measured ? 0 : 0.5 * over_snr2));
        variance += over_snr2;
    }
    row->data = sum, row->error = sqrt(variance);
    return isfinite(sum) && isfinite(variance) && 1 / row->error >= p->snr_cut;
}

static enum kd_status add_triangle(struct kd_comparison *c, const struct table *t, const struct kd_comparison_params *p,
                                   struct kd_comparison_row *row, struct kd_error *error)
{
    const uint8_t *s = row->station;
    return find(t, row, 0, s[0], s[1]) && find(t, row, 1, s[1], s[2]) && find(t, row, 2, s[2], s[0]) &&
                   phase_of(c, p, row)
               ? kd_comparison_add(c, row, error)
               : KD_OK;
}

static enum kd_status add_quadrangle(struct kd_comparison *c, const struct table *t,
                                     const struct kd_comparison_params *p, struct kd_comparison_row *row,
                                     struct kd_error *error)
{
    const uint8_t *s = row->station;
    return find(t, row, 0, s[0], s[1]) && find(t, row, 1, s[2], s[3]) && find(t, row, 2, s[0], s[3]) &&
                   find(t, row, 3, s[1], s[2]) && amplitude_of(c, p, row)
               ? kd_comparison_add(c, row, error)
               : KD_OK;
}

static enum kd_status triangles(struct kd_comparison *c, const struct table *t, const struct kd_comparison_params *p,
                                const uint8_t *s, int n, struct kd_comparison_row *row, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    for (int i = 0; i < (p->maximal ? n : 1); i++)
        for (int j = i + 1; j < n; j++)
            for (int k = j + 1; k < n; k++) {
                row->station[0] = s[i], row->station[1] = s[j], row->station[2] = s[k];
                KD_TRY(add_triangle(c, t, p, row, error));
            }
done:
    return status;
}

/* Adds the maximal set of closure amplitudes: three for every four stations. */
static enum kd_status all_quadrangles(struct kd_comparison *c, const struct table *t,
                                      const struct kd_comparison_params *p, const uint8_t *s, int n,
                                      struct kd_comparison_row *row, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    for (int i = 0; i < n; i++)
        for (int j = i + 1; j < n; j++)
            for (int k = j + 1; k < n; k++)
                for (int l = k + 1; l < n; l++) {
                    const uint8_t of[3][4] = { { s[i], s[j], s[k], s[l] },
                                               { s[i], s[k], s[j], s[l] },
                                               { s[i], s[j], s[l], s[k] } };
                    for (int q = 0; q < 3; q++) {
                        memcpy(row->station, of[q], 4);
                        KD_TRY(add_quadrangle(c, t, p, row, error));
                    }
                }
done:
    return status;
}

/* Adds the minimal set of closure amplitudes. Each quadrangle has the first station, one station from the fourth on,
 * and two of the stations between these. */
static enum kd_status quadrangles(struct kd_comparison *c, const struct table *t, const struct kd_comparison_params *p,
                                  const uint8_t *s, int n, struct kd_comparison_row *row, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    if (p->maximal)
        return all_quadrangles(c, t, p, s, n, row, error);
    for (int i = 3; i < n; i++)
        for (int j = 1; j < i; j++) {
            row->station[0] = s[0], row->station[1] = s[i], row->station[2] = s[j];
            row->station[3] = s[j == i - 1 ? 1 : j + 1];
            KD_TRY(add_quadrangle(c, t, p, row, error));
        }
done:
    return status;
}

/* Lists the stations at one time: alphabetically for the maximal set, in the order of the observation for the minimal
 * set. */
static int stations_of(const struct kd_observation *o, const struct table *t, bool sorted,
                       uint8_t out[KD_OBSERVATION_STATIONS])
{
    int n = 0;
    for (uint32_t i = 0; i < o->stations; i++) {
        bool there = false;
        for (uint32_t j = 0; j < o->stations; j++)
            there |= t->at[i][j] || t->at[j][i];
        int k = n;
        for (; there && sorted && k && strcmp(o->station[out[k - 1]], o->station[i]) > 0; k--)
            out[k] = out[k - 1];
        if (there)
            out[k] = (uint8_t)i, n++;
    }
    return n;
}

enum kd_status kd_closures(struct kd_comparison *c, const struct kd_observation *o,
                           const struct kd_comparison_params *params, enum kd_product product, size_t first, size_t n,
                           struct kd_error *error)
{
    struct table *t = calloc(1, sizeof *t);
    struct kd_comparison_row row = { .product = product, .hour = c->at[first].hour };
    uint8_t s[KD_OBSERVATION_STATIONS];
    if (!t)
        return kd_error_set(error, KD_ENOMEM, "out of memory for closures");
    for (size_t i = first; i < first + n; i++)
        t->at[c->at[i].station[0]][c->at[i].station[1]] = (uint32_t)i + 1;
    const int stations = stations_of(o, t, params->maximal, s);
    enum kd_status status = product == KD_PRODUCT_CLOSURE_PHASE ? triangles(c, t, params, s, stations, &row, error)
                                                                : quadrangles(c, t, params, s, stations, &row, error);
    free(t);
    return status;
}
