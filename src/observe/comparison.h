/* Prepares an observation for comparison with a model, and compares both. Data, errors, sets of closures and chi^2 are
 * defined as in ehtim 1.3.2 (A. A. Chael et al. 2018, ApJ 857, 23, 2.2 and appendix C). Any thread.
 *
 *     kd_comparison_make(&observation, &params, &c, &error);
 *     ... fill model[i] with the model's visibility, in Jy, at each c.at[i] ...
 *     kd_comparison_judge(&c, model, chi2);    also fills c.row[i].model
 *     kd_comparison_finish(&c); */
#ifndef KD_OBSERVE_COMPARISON_H
#define KD_OBSERVE_COMPARISON_H

#include "observe/observation.h"

enum kd_product {
    KD_PRODUCT_AMPLITUDE,
    KD_PRODUCT_CLOSURE_PHASE,
    KD_PRODUCT_LOG_CLOSURE_AMPLITUDE,
    KD_PRODUCT_VISIBILITY,
    KD_PRODUCTS
};
extern const char *const kd_product_names[KD_PRODUCTS];

struct kd_comparison_params {
    unsigned products; /* bit mask: one bit for each enum kd_product */
    /* Three steps of preparation, applied in this order. average_s: length in seconds of the bins in which visibilities
     * are averaged, counted from 1960-01-01; 0 means no averaging. uv_min_gl: baselines shorter than this are left out.
     * systematic_visibility: this fraction of the amplitude is added to the error in quadrature. */
    double average_s, uv_min_gl, systematic_visibility;
    /* fractional error of each station; sqrt 2 times this fraction of an amplitude is added to its error */
    double systematic_amplitude;
    double systematic_closure_phase_deg; /* systematic error of a closure phase, added to its error */
    double snr_cut;                      /* data with a smaller signal-to-noise ratio than this are left out */
    /* true if amplitudes are used as measured; otherwise they are debiased to sqrt(|V|^2 - sigma^2), and closures are
     * debiased too */
    bool measured;
    /* true if all triangles and quadrangles are used; otherwise a minimal set is used, whose sets contain the first
     * station */
    bool maximal;
};

/* One datum: |V|; the phase of V1 V2 V3; log |V1| + log |V2| - log |V3| - log |V4|; or the real or the imaginary part
 * of V. A visibility V has two rows, one for each part. */
struct kd_comparison_row {
    enum kd_product product;
    bool imaginary;
    double hour;
    /* indices of 2, 3 or 4 stations. 2 stations: V of the baseline 12. 3 stations: baselines 12, 23 and 31. 4 stations:
     * baselines 12, 34, 14 and 23 */
    uint8_t station[4];
    uint32_t at[4];    /* index of the visibility of each baseline, in `at` of struct kd_comparison */
    bool conjugate[4]; /* true if that visibility is stored for the opposite direction of the baseline */
    double data, error, model;
};
unsigned kd_product_stations(enum kd_product product);

struct kd_comparison {
    struct kd_measured *at; /* averaged visibilities, without the baselines that are too short */
    size_t n, too_short;
    struct kd_comparison_row *row; /* data, sorted by product, and within a product by time */
    size_t rows, room, of[KD_PRODUCTS];
};

enum { KD_COMPARISON_ROWS = 100000 };
/* Prepares the data. Returns KD_EINVAL if no data are left, or if there are too many rows. kd_comparison_finish is
 * needed only after success. */
enum kd_status kd_comparison_make(const struct kd_observation *observation, const struct kd_comparison_params *params,
                                  struct kd_comparison *out, struct kd_error *error);
void kd_comparison_finish(struct kd_comparison *comparison);

/* The factor of the model that minimises chi^2 of amplitudes and visibilities. With data d and model m, it is the sum
 * of d m / sigma^2 divided by the sum of m^2 / sigma^2. NaN if there are no such data, if the model has no light, or if
 * the factor is not above 0. */
double kd_comparison_scale(const struct kd_comparison *comparison, const double (*model)[2]);
/* Fills the member `model` of each row. Computes chi^2 divided by the number of data for each product; NaN for a
 * product without data. */
void kd_comparison_judge(struct kd_comparison *comparison, const double (*model)[2], double chi2[KD_PRODUCTS]);
/* Sum of chi^2 over all data, for the model times `scale`. Does not change the rows. */
double kd_comparison_total(const struct kd_comparison *comparison, const double (*model)[2], double scale);
/* (data - model) / error. The difference of two phases is first reduced to the range -180 to 180 degrees. */
double kd_comparison_residual(const struct kd_comparison_row *row);

/* Fourier transform of a pixel's shape at a baseline. turns: for each axis, turns of the phase across one pixel. */
enum kd_pixel_shape { KD_PULSE_TRIANGLE, KD_PULSE_RECTANGLE, KD_PULSE_POINT };
double kd_pulse_at(enum kd_pixel_shape pulse, double u_pixel, double v_pixel);

#endif
