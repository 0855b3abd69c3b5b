/* Named, fixed sets of rays on which engines are compared, so that tables of different days and devices are comparable.
 *
 * A set has one or more views; a view is one hole seen by one observer at infinity. Positions come from a
 * low-discrepancy sequence (M. Roberts 2018, "The unreasonable effectiveness of quasirandom sequences": multiples of
 * 1/g and 1/g^2 modulo 1, g the plastic number). None of them lies on an axis of symmetry. Positions are not rounded:
 * if an engine rounds them to single precision, that counts as the engine's error.
 *
 * Only the near-critical set has rays within 5 % of the critical curve. All crossings of order 2 belong to such rays.
 * Near the curve the error of any method is the rounding error times a condition number of several hundred. rho is the
 * distance in the image plane from the centre that physics/null/critical.h defines. rho_c is the value of rho on the
 * critical curve. Pure; any thread. */
#ifndef KD_RENDER_ACCURACY_SETS_H
#define KD_RENDER_ACCURACY_SETS_H

#include <stddef.h>
#include <stdint.h>

enum kd_accuracy_set {
    KD_ACCURACY_BULK,          /* a = 0.9, i = 70 degrees, positions within +-12 M */
    KD_ACCURACY_NEAR_CRITICAL, /* a = 0.9, i = 70 degrees: |rho/rho_c - 1| is 5e-2, 5e-3, ... 5e-6, alternately inside
                                  and outside the critical curve */
    KD_ACCURACY_NEAR_AXIS, /* a = 0.9: one view at i = 0.001 degrees, with positions within +-12 M; another at i = 70
                              degrees, with alpha = 0 or +-1e-12 to +-1e-2 */
    KD_ACCURACY_EDGE_ON,   /* a = 0.9, i = 90 and 89.99 degrees, positions within +-12 M */
    KD_ACCURACY_NEAR_EXTREMAL, /* a = 0.9999, i = 70 degrees, positions within +-12 M */
    KD_ACCURACY_SETS
};

extern const char *const kd_accuracy_set_names[KD_ACCURACY_SETS]; /* "bulk", "near-critical", ... */
extern const char *const kd_accuracy_set_rays[KD_ACCURACY_SETS];  /* description of each set's rays in words */

struct kd_accuracy_view { double spin, inclination_deg; };
#define KD_ACCURACY_VIEWS 2 /* maximum number of views in a set */

uint32_t kd_accuracy_views(enum kd_accuracy_set set, struct kd_accuracy_view out[KD_ACCURACY_VIEWS]);

/* Writes the n rays of one view of the set: 2 n numbers. */
void kd_accuracy_rays(enum kd_accuracy_set set, uint32_t view, size_t n, double *alpha_beta);

#endif
