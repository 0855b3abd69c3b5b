/* Prepares an observation for comparison, and computes chi^2 of a model (comparison.h). */
#include "observe/reduce.h"

#include <math.h>
#include <stdlib.h>

#define DEG (180 / M_PI)

const char *const kd_product_names[KD_PRODUCTS] = { "amplitude", "closure_phase", "log_closure_amplitude",
                                                    "visibility" };

unsigned kd_product_stations(enum kd_product product) { return product == KD_PRODUCT_VISIBILITY ? 2 : 2 + product; }

enum kd_status kd_comparison_add(struct kd_comparison *c, const struct kd_comparison_row *row, struct kd_error *error)
{
    if (c->rows == KD_COMPARISON_ROWS)
        return kd_error_set(error, KD_EINVAL,
                            "the observation has more than %d amplitudes and closures; a larger average_s or closures "
                            "\"minimal\" gives fewer",
                            KD_COMPARISON_ROWS);
    if (c->rows == c->room) {
        const size_t more = c->room ? 2 * c->room : 1024;
        struct kd_comparison_row *at = realloc(c->row, more * sizeof *at);
        if (!at)
            return kd_error_set(error, KD_ENOMEM, "out of memory for %zu closures", more);
        c->row = at, c->room = more;
    }
    c->row[c->rows++] = *row;
    c->of[row->product]++;
    return KD_OK;
}

/* Removes short baselines, and adds systematic errors to the others. */
static void prepare(struct kd_comparison *c, const struct kd_comparison_params *p)
{
    size_t n = 0;
    for (size_t i = 0; i < c->n; i++) {
        if (hypot(c->at[i].u, c->at[i].v) < p->uv_min_gl * 1e9)
            continue;
        struct kd_measured *m = &c->at[n++];
        *m = c->at[i];
        m->sigma = hypot(m->sigma, p->systematic_visibility * hypot(m->re, m->im));
    }
    c->too_short = c->n - n;
    c->n = n;
}

/* Amplitude of a visibility, debiased unless amplitudes are used as measured. */
static double amplitude_of(const struct kd_measured *m, const struct kd_comparison_params *p)
{
    const double measured = hypot(m->re, m->im);
    return p->measured ? measured : measured > m->sigma ? sqrt((measured - m->sigma) * (measured + m->sigma)) : 0;
}

static enum kd_status add_amplitude(struct kd_comparison *c, const struct kd_comparison_params *p, size_t i,
                                    struct kd_error *error)
{
    const struct kd_measured *m = &c->at[i];
    const double amplitude = amplitude_of(m, p);
    const struct kd_comparison_row row = { .product = KD_PRODUCT_AMPLITUDE,
                                           .hour = m->hour,
                                           .station = { m->station[0], m->station[1] },
                                           .at = { (uint32_t)i },
                                           .data = amplitude,
                                           .error = hypot(m->sigma, M_SQRT2 * p->systematic_amplitude * amplitude) };
    return amplitude / m->sigma >= p->snr_cut ? kd_comparison_add(c, &row, error) : KD_OK;
}

/* Adds two rows for a visibility: its real part and its imaginary part. The row's error is that of each part. The cut
 * by signal-to-noise ratio, and systematic_amplitude, use the same amplitude as add_amplitude. */
static enum kd_status add_visibility(struct kd_comparison *c, const struct kd_comparison_params *p, size_t i,
                                     struct kd_error *error)
{
    const struct kd_measured *m = &c->at[i];
    const double amplitude = amplitude_of(m, p);
    struct kd_comparison_row row = { .product = KD_PRODUCT_VISIBILITY,
                                     .hour = m->hour,
                                     .station = { m->station[0], m->station[1] },
                                     .at = { (uint32_t)i },
                                     .data = m->re,
                                     .error = hypot(m->sigma, M_SQRT2 * p->systematic_amplitude * amplitude) };
    enum kd_status status = KD_OK;
    if (amplitude / m->sigma < p->snr_cut)
        return KD_OK;
    KD_TRY(kd_comparison_add(c, &row, error));
    row.imaginary = true, row.data = m->im;
    KD_TRY(kd_comparison_add(c, &row, error));
done:
    return status;
}

static enum kd_status add_product(struct kd_comparison *c, const struct kd_observation *o,
                                  const struct kd_comparison_params *p, enum kd_product product, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    for (size_t i = 0, next; i < c->n; i = next) {
        if (product == KD_PRODUCT_AMPLITUDE || product == KD_PRODUCT_VISIBILITY) {
            next = i + 1;
            KD_TRY((product == KD_PRODUCT_AMPLITUDE ? add_amplitude : add_visibility)(c, p, i, error));
            continue;
        }
        for (next = i + 1; next < c->n && c->at[next].hour == c->at[i].hour;)
            next++;
        KD_TRY(kd_closures(c, o, p, product, i, next - i, error));
    }
done:
    return status;
}

enum kd_status kd_comparison_make(const struct kd_observation *observation, const struct kd_comparison_params *params,
                                  struct kd_comparison *out, struct kd_error *error)
{
    enum kd_status status;
    *out = (struct kd_comparison) { 0 };
    KD_TRY(kd_average(observation, params->average_s, &out->at, &out->n, error));
    prepare(out, params);
    for (int product = 0; product < KD_PRODUCTS; product++)
        if (params->products & 1u << product)
            KD_TRY(add_product(out, observation, params, (enum kd_product)product, error));
    if (!out->rows)
        KD_TRY(kd_error_set(error, KD_EINVAL,
                            "none of the %zu visibilities can be compared, and %zu of them have too short baselines: "
                            "uv_min_gl or snr_cut must be lower",
                            out->n + out->too_short, out->too_short));
done:
    if (status)
        kd_comparison_finish(out);
    return status;
}

void kd_comparison_finish(struct kd_comparison *c)
{
    free(c->at);
    free(c->row);
    *c = (struct kd_comparison) { 0 };
}

static double amplitude(const double (*model)[2], uint32_t at) { return hypot(model[at][0], model[at][1]); }

static double model_of(const struct kd_comparison_row *row, const double (*model)[2])
{
    double sum = 0;
    switch (row->product) {
    case KD_PRODUCT_AMPLITUDE: return amplitude(model, row->at[0]);
    case KD_PRODUCT_CLOSURE_PHASE:
        for (int k = 0; k < 3; k++)
            sum += (row->conjugate[k] ? -1 : 1) * atan2(model[row->at[k]][1], model[row->at[k]][0]);
        return remainder(sum, 2 * M_PI) * DEG;
    case KD_PRODUCT_LOG_CLOSURE_AMPLITUDE:
        for (int k = 0; k < 4; k++)
            sum += (k < 2 ? 1 : -1) * log(amplitude(model, row->at[k]));
        return sum;
    case KD_PRODUCT_VISIBILITY: return model[row->at[0]][row->imaginary];
    case KD_PRODUCTS: break;
    }
    return NAN;
}

double kd_comparison_scale(const struct kd_comparison *c, const double (*model)[2])
{
    double of_data = 0, of_model = 0;
    for (size_t i = 0; i < c->rows; i++) {
        const struct kd_comparison_row *row = &c->row[i];
        if (row->product != KD_PRODUCT_AMPLITUDE && row->product != KD_PRODUCT_VISIBILITY)
            continue;
        const double m = model_of(row, model), weight = 1 / (row->error * row->error);
        of_data += row->data * m * weight, of_model += m * m * weight;
    }
    return of_model > 0 && of_data > 0 ? of_data / of_model : NAN;
}

double kd_comparison_residual(const struct kd_comparison_row *row)
{
    const double difference = row->data - row->model;
    return (row->product == KD_PRODUCT_CLOSURE_PHASE ? remainder(difference, 360) : difference) / row->error;
}

/* Contribution of a row to chi^2 (Chael et al. 2018, eqs. C1 to C4). For a phase it is computed from the chord between
 * data and model on the unit circle. */
static double share_of(const struct kd_comparison_row *row)
{
    const double residual = kd_comparison_residual(row), error = row->error / DEG;
    return row->product == KD_PRODUCT_CLOSURE_PHASE ? 2 * (1 - cos(residual * error)) / (error * error)
                                                    : residual * residual;
}

void kd_comparison_judge(struct kd_comparison *c, const double (*model)[2], double chi2[KD_PRODUCTS])
{
    double sum[KD_PRODUCTS] = { 0 };
    for (size_t i = 0; i < c->rows; i++) {
        struct kd_comparison_row *row = &c->row[i];
        row->model = model_of(row, model);
        sum[row->product] += share_of(row);
    }
    for (int i = 0; i < KD_PRODUCTS; i++)
        chi2[i] = c->of[i] ? sum[i] / (double)c->of[i] : NAN;
}

double kd_comparison_total(const struct kd_comparison *c, const double (*model)[2], double scale)
{
    double sum = 0;
    for (size_t i = 0; i < c->rows; i++) {
        struct kd_comparison_row row = c->row[i];
        row.model = model_of(&row, model);
        if (row.product == KD_PRODUCT_AMPLITUDE || row.product == KD_PRODUCT_VISIBILITY)
            row.model *= scale;
        sum += share_of(&row);
    }
    return sum;
}

/* Fourier transform of a pixel's shape along one axis. x: turns of the phase across one pixel. */
static double along(enum kd_pixel_shape pulse, double x)
{
    const double sinc = fabs(x) < 1e-9 ? 1 : sin(M_PI * x) / (M_PI * x);
    return pulse == KD_PULSE_POINT ? 1 : pulse == KD_PULSE_RECTANGLE ? sinc : sinc * sinc;
}

double kd_pulse_at(enum kd_pixel_shape pulse, double u_pixel, double v_pixel)
{
    return along(pulse, u_pixel) * along(pulse, v_pixel);
}
