/* Impulse responses and lags of an echo. */
#include "integral/answer.h"
#include "integral/integral_internal.h"
#include "physics/disk/echo.h"
#include "physics/spacetime/scale.h"

#include <math.h>
#include <stdlib.h>

enum { ISCO, STRENGTH, DIRECT_FLUX, DIRECT_G, DIRECT_TIME, UNIT, AFTER };
enum { INSIDE = AFTER, MEAN, ERROR }; /* index of each value that only an impulse response has */
enum { WORST = AFTER };               /* index of each value that only lags have */

/* Parameters of the echo. The source exists, because the request has been checked. */
static struct kd_echo_params params_of(const struct kd_integral_request *r)
{
    struct kd_echo_params params = { r->inner, r->outer, r->photon_index, r->limb };
    kd_corona_source_of(kd_integral_hole(r), r->emissivity == KD_LINE_RING ? r->corona_radius : 0, r->height, r->motion,
                        &params.source);
    return params;
}

static double second_of(const struct kd_integral_request *r) { return kd_scale_seconds(r->mass_msun); }

static void fill_values(const struct kd_integral_request *r, const struct kd_disk_image *image,
                        const struct kd_echo *echo, double *values)
{
    values[ISCO] = image->isco;
    values[STRENGTH] = echo->strength;
    values[DIRECT_FLUX] = 4 * M_PI * echo->direct.flux;
    values[DIRECT_G] = echo->direct.g;
    values[DIRECT_TIME] = echo->direct.time;
    values[UNIT] = second_of(r);
}

/* Edges of the bins divided by rest_energy. The array has room for `more` further edges. */
static double *edges_of(const struct kd_integral_request *r, size_t more)
{
    double *edges = malloc((r->edges.n + more) * sizeof *edges);
    for (size_t i = 0; edges && i < r->edges.n; i++)
        edges[i] = r->edges.at[i] / r->rest_energy;
    return edges;
}

enum kd_status kd_integral_impulse(const struct kd_integral_request *r, const struct kd_disk_image *image,
                                   struct kd_integral_answer *answer, struct kd_error *error)
{
    enum { LOW, HIGH, FROM, TO, SHARE };
    const double step = (r->time_max - r->time_min) / r->times;
    double *edges = edges_of(r, 0), inside = 0;
    struct kd_echo echo;
    enum kd_status status;
    const struct kd_echo_params params = params_of(r);
    if (!edges)
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for %u bins", r->bins));
    KD_TRY(kd_integral_make_columns(answer, kd_integral_rows(r), error));
    double *const *c = answer->columns;
    KD_TRY(kd_echo_impulse(image, &params, edges, r->bins, r->time_min, step, r->times, c[SHARE], &echo, error));
    for (size_t i = 0; i < answer->rows; i++) {
        const size_t bin = i / r->times, time = i % r->times;
        c[LOW][i] = r->edges.at[bin], c[HIGH][i] = r->edges.at[bin + 1];
        c[FROM][i] = r->time_min + step * (double)time, c[TO][i] = r->time_min + step * (double)(time + 1);
        inside += c[SHARE][i];
    }
    fill_values(r, image, &echo, answer->values);
    answer->values[INSIDE] = fmin(inside, 1), answer->values[MEAN] = echo.mean, answer->values[ERROR] = echo.error;
done:
    free(edges);
    return status;
}

/* Number of photons of the power law between two energies. The spectrum is normalised to 1 at an energy of 1. */
static double continuum(double photon_index, double low, double high)
{
    const double power = 1 - photon_index;
    return fabs(power) < 1e-9 ? log(high / low) : (pow(high, power) - pow(low, power)) / power;
}

static int ascending(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

/* Lists the edges of the bins and of the reference band in ascending order, each once. Returns their number. */
static size_t all_edges(const struct kd_integral_request *r, double *edges)
{
    size_t n = r->edges.n, kept = 1;
    if (!isnan(r->reference_min))
        edges[n++] = r->reference_min / r->rest_energy, edges[n++] = r->reference_max / r->rest_energy;
    qsort(edges, n, sizeof *edges, ascending);
    for (size_t i = 1; i < n; i++)
        if (edges[i] > edges[kept - 1])
            edges[kept++] = edges[i];
    return kept;
}

/* Fourier transform, at one frequency, of the light between two energies: light of the continuum, and light of the
 * line. The light of the line is summed over the bins between these energies. line: number of photons of the whole
 * line. */
struct band { double re, im; };

static struct band band_of(const double *edges, size_t n, const double *part, size_t stride, double photon_index,
                           double line, const double direct[2], double low, double high)
{
    const double of_source = continuum(photon_index, low, high);
    struct band band = { of_source * direct[0], of_source * direct[1] };
    for (size_t i = 0; i + 1 < n; i++)
        if (edges[i] >= low && edges[i + 1] <= high)
            band.re += line * part[2 * i * stride], band.im += line * part[2 * i * stride + 1];
    return band;
}

/* Time by which `a` lags behind `b`, from the phase of their cross spectrum. Transforms have the sign exp(2 pi i f t).
 */
static double lag_of(struct band a, struct band b, double frequency)
{
    return atan2(a.im * b.re - a.re * b.im, a.re * b.re + a.im * b.im) / (2 * M_PI * frequency);
}

/* Transforms of the line's light, one after the other by frequency. The frequency 0 is the first. */
struct lines {
    const double *edges;
    size_t n, stride;
    double *part, *coarse;
    double line;
};

static struct band light_of(const struct kd_integral_request *r, const struct lines *l, const double *part,
                            const double direct[2], size_t k, double low, double high)
{
    return band_of(l->edges, l->n, part + 2 * (k + 1), l->stride, r->photon_index, l->line, direct, low, high);
}

/* Light of the reference band. Without such a band it is the source's direct light. */
static struct band reference_of(const struct kd_integral_request *r, const struct lines *l, const double *part,
                                const double direct[2], size_t k)
{
    if (isnan(r->reference_min))
        return (struct band) { direct[0], direct[1] };
    return light_of(r, l, part, direct, k, r->reference_min / r->rest_energy, r->reference_max / r->rest_energy);
}

static void fill_lags(const struct kd_integral_request *r, const struct lines *l, const struct kd_echo *echo,
                      struct kd_integral_answer *answer)
{
    enum { FREQUENCY, HZ, LOW, HIGH, LAG, LAG_S, REFLECTED, LAG_ERROR };
    double *const *c = answer->columns;
    for (size_t k = 0; k < r->frequencies_m.n; k++) {
        const double frequency = r->frequencies_m.at[k], none[2] = { 0, 0 };
        double direct[2];
        kd_echo_direct(&echo->direct, frequency, direct);
        const struct band reference = reference_of(r, l, l->part, direct, k),
                          coarse = reference_of(r, l, l->coarse, direct, k);
        for (size_t bin = 0; bin < r->bins; bin++) {
            const size_t row = k * r->bins + bin;
            const double low = r->edges.at[bin] / r->rest_energy, high = r->edges.at[bin + 1] / r->rest_energy,
                         rough = lag_of(light_of(r, l, l->coarse, direct, k, low, high), coarse, frequency);
            const double line =
                band_of(l->edges, l->n, l->part, l->stride, r->photon_index, l->line, none, low, high).re;
            c[FREQUENCY][row] = frequency, c[HZ][row] = frequency / second_of(r);
            c[LOW][row] = r->edges.at[bin], c[HIGH][row] = r->edges.at[bin + 1];
            c[LAG][row] = lag_of(light_of(r, l, l->part, direct, k, low, high), reference, frequency);
            c[LAG_S][row] = c[LAG][row] * second_of(r);
            c[REFLECTED][row] = line / (line + continuum(r->photon_index, low, high));
            c[LAG_ERROR][row] = fabs(rough - c[LAG][row]);
            answer->values[WORST] = fmax(answer->values[WORST], c[LAG_ERROR][row]);
        }
    }
}

enum kd_status kd_integral_lags(const struct kd_integral_request *r, const struct kd_disk_image *image,
                                struct kd_integral_answer *answer, struct kd_error *error)
{
    const size_t stride = r->frequencies_m.n + 1;
    double *edges = edges_of(r, 2), *frequencies = calloc(stride, sizeof *frequencies), *part = NULL;
    struct kd_echo echo;
    enum kd_status status;
    const struct kd_echo_params params = params_of(r);
    const double first = r->edges.at[0] / r->rest_energy, last = r->edges.at[r->bins] / r->rest_energy;
    const size_t n = edges ? all_edges(r, edges) : 0;
    part = calloc(4 * n * stride, sizeof *part);
    if (!edges || !frequencies || !part)
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for %u bins and %u frequencies", r->bins, r->frequencies));
    for (size_t k = 0; k < r->frequencies_m.n; k++)
        frequencies[k + 1] = r->frequencies_m.at[k];
    KD_TRY(kd_integral_make_columns(answer, kd_integral_rows(r), error));
    const struct lines lines = {
        edges, n, stride, part, part + 2 * n * stride, r->reflection * continuum(r->photon_index, first, last)
    };
    KD_TRY(
        kd_echo_transform(image, &params, edges, n - 1, frequencies, stride, lines.part, lines.coarse, &echo, error));
    fill_values(r, image, &echo, answer->values);
    fill_lags(r, &lines, &echo, answer);
done:
    free(edges);
    free(frequencies);
    free(part);
    return status;
}
