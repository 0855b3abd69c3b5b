/* An observation is made ready to be compared with a model, and is compared. Definitions are those of ehtim 1.3.2
 * (A. A. Chael et al. 2018, ApJ 857, 23, 2.2 and appendix C): the same data, errors, sets of closures and chi^2. Any
 * thread.
 *
 *     kd_comparison_make(&observation, &params, &c, &error);
 *     ... the model's visibility, Jy, at each c.at[i]: model[i] ...
 *     kd_comparison_judge(&c, model, &told);       fills c.row[i].model
 *     kd_comparison_finish(&c); */
#ifndef KD_OBSERVE_COMPARISON_H
#define KD_OBSERVE_COMPARISON_H

#include "observe/observation.h"

enum kd_product { KD_PRODUCT_AMPLITUDE, KD_PRODUCT_CLOSURE_PHASE, KD_PRODUCT_LOG_CLOSURE_AMPLITUDE, KD_PRODUCTS };
extern const char *const kd_product_names[KD_PRODUCTS];

struct kd_comparison_params {
    unsigned products; /* a bit each */
    /* In this order: visibilities are averaged in bins of so many seconds, which are counted from 1960-01-01 (0: they
     * are not), those shorter than uv_min are left out, and of the others' amplitude this share is added to the error,
     * in quadrature. */
    double average_s, uv_min_gl, systematic_visibility;
    double systematic_amplitude;         /* of each station: sqrt 2 of it is added to an amplitude's error */
    double systematic_closure_phase_deg; /* added to the error of a closure phase */
    double snr_cut;                      /* what has less signal over noise is left out */
    bool measured; /* amplitudes as they are measured; else sqrt(|V|^2 - sigma^2), and what that makes of closures */
    bool maximal;  /* all triangles and quadrangles; else a minimal set about the first station */
};

/* One datum: |V|, the phase of V1 V2 V3, or log |V1| + log |V2| - log |V3| - log |V4|. */
struct kd_comparison_row {
    enum kd_product product;
    double hour;
    uint8_t station[4]; /* 2, 3 or 4 of them; V is of 12; of 12, 23, 31; of 12, 34, 14, 23 */
    uint32_t at[4];     /* the visibilities */
    bool conjugate[4];  /* whose stations are the other way round */
    double data, error, model;
};
unsigned kd_product_stations(enum kd_product product);

struct kd_comparison {
    struct kd_measured *at; /* visibilities: averaged, without those that are too short */
    size_t n, too_short;
    struct kd_comparison_row *row; /* products one after the other, each by time */
    size_t rows, room, of[KD_PRODUCTS];
};

enum { KD_COMPARISON_ROWS = 100000 };
/* KD_EINVAL: nothing is left to compare, or there are more rows than may be. *out is to be finished only where this
 * succeeds. */
enum kd_status kd_comparison_make(const struct kd_observation *observation, const struct kd_comparison_params *params,
                                  struct kd_comparison *out, struct kd_error *error);
void kd_comparison_finish(struct kd_comparison *comparison);

/* What amplitudes want a model to be multiplied by, so that their chi^2 is least: the sum of d m / sigma^2 over that of
 * m^2 / sigma^2. NaN: there are no amplitudes, or the model has no light. */
double kd_comparison_scale(const struct kd_comparison *comparison, const double (*model)[2]);
/* Fills the rows' models, and tells chi^2 over the number of data; NaN of a product without any. */
void kd_comparison_judge(struct kd_comparison *comparison, const double (*model)[2], double chi2[KD_PRODUCTS]);
/* Data less model, over the error; a phase's difference is within 180 degrees. */
double kd_comparison_residual(const struct kd_comparison_row *row);

/* How the image's pixels are seen at this baseline, whose length along each axis is so many turns a pixel: the Fourier
 * transform of a pixel. */
enum kd_pixel_shape { KD_PULSE_TRIANGLE, KD_PULSE_RECTANGLE, KD_PULSE_POINT };
double kd_pulse_at(enum kd_pixel_shape pulse, double u_pixel, double v_pixel);

#endif
