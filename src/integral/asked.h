/* A request for an integral, and the table of its fields. Any thread. */
#ifndef KD_INTEGRAL_ASKED_H
#define KD_INTEGRAL_ASKED_H

#include "document/document.h"
#include "observe/align.h"
#include "physics/disk/corona.h"
#include "physics/disk/line_profile.h"
#include "physics/spacetime/hole.h"
#include "scene/asset.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Kinds of integrals. SPECTRUM becomes VOLUME when a scene is given, and COMPARE becomes SETS when sets are given.
 * VOLUME and all later kinds are computed from pictures (integral/run.h). */
enum kd_integral {
    KD_INTEGRAL_LINE,
    KD_INTEGRAL_TRANSFER,
    KD_INTEGRAL_SPECTRUM,
    KD_INTEGRAL_IMPULSE,
    KD_INTEGRAL_LAGS,
    KD_INTEGRAL_VOLUME,
    KD_INTEGRAL_VISIBILITY,
    KD_INTEGRAL_COMPARE,
    KD_INTEGRAL_SETS,
    KD_INTEGRAL_OBSERVE,
    KD_INTEGRALS
};

enum kd_integral_returning { KD_INTEGRAL_IGNORED, KD_INTEGRAL_ABSORBED, KD_INTEGRAL_SCATTERED };

struct kd_integral_request {
    enum kd_integral what;
    KD_HOLE_MEMBERS
    double inclination_deg, inner, outer; /* edges of the disk, M; `inner` is NaN for the ISCO */
    enum kd_line_emissivity emissivity;
    double index, outer_index, break_r, height, photon_index, tolerance;
    enum kd_limb limb;
    int energy;                                 /* what the profile counts; 0: photons, 1: energy */
    double rest_energy, energy_min, energy_max; /* energy_max is NaN for 1.7 times rest_energy */
    uint32_t bins;
    struct kd_number_list edges;
    enum kd_corona_motion motion; /* for a corona off the axis: its motion */
    double corona_radius, corona_inner, corona_top;
    double time_min, time_max; /* for an impulse response: range of the bins of time */
    uint32_t times;
    /* for lags; reference_min is NaN if the continuum is the reference */
    double reflection, reference_min, reference_max, frequency_min, frequency_max;
    struct kd_number_list frequencies_m;
    struct kd_number_list radii, g_star; /* for a transfer function: radii, and values of g* */
    uint32_t rings, g_stars;
    double mass_msun, distance_pc, mdot_edd, colour_correction; /* for a spectrum: parameters of the disk */
    int returning;                                              /* value of enum kd_integral_returning */
    int polarized;                                              /* 1 if the spectrum is polarised, otherwise 0 */
    /* range of frequencies; NaN: determined by the hottest ring */
    double frequency_min_hz, frequency_max_hz;
    uint32_t frequencies;
    struct kd_number_list frequencies_hz;
    struct kd_scene *scene; /* scene, malloc'd; NULL if none is given */
    /* Assets by which names are resolved while the scene is read. If NULL, the caller resolves names and validates the
     * scene. */
    const struct kd_assets *assets;
    uint32_t pixels; /* pixels on the longer side of a picture; 0 for the default */
    int unchecked;   /* 1 if no finer pictures are made, which otherwise estimate the error */
    struct kd_number_list u, v, lengths,
        /* For a visibility, in Gl (10^9 wavelengths): a list of baselines (u, v), or lists of lengths and angles, which
         * are expanded into baselines. */
        angles_deg;
    double length_max; /* largest length; NaN: half of the longest baseline that the pixels resolve */
    uint32_t baselines, orders;
    uint32_t digits; /* in text: number of significant digits of the columns' numbers */
    /* for a comparison or a simulation: the observation, malloc'd; NULL if none is given */
    struct kd_observation *observation;
    /* For a simulation from a uvfits file: the bytes of that file, malloc'd. The run replaces the visibilities in these
     * bytes by simulated ones. */
    uint8_t *file;
    size_t file_size;
    uint32_t seed;
    int noiseless;
    /* For a comparison: the prepared data, malloc'd when the request has been checked. The run fills in the model's
     * values. The baselines of the comparison become the request's lists u and v. */
    struct kd_comparison *comparison;
    struct kd_integral_sets *sets; /* parameter sets (integral/sets.h), malloc'd; NULL if none are given */
    double average_s, snr_cut, uv_min_gl, systematic_visibility, systematic_amplitude, systematic_closure_phase_deg;
    int measured, maximal;
    enum kd_pixel_shape pulse;
    int scattering; /* 1 if the scattering towards Sgr A* is applied (observe/scattering.h) */
    /* flux of the model; NaN: the scene's own flux, or the best fit if the scene has none */
    double flux_jy;
    uint32_t products, solve; /* bit masks: products has a bit for each enum kd_product, solve is of KD_ALIGN_... */
    uint64_t seen[2];         /* bit mask of the fields that the request gives */
};

/* The hole of a request for a thin disk, for use as a function's argument. The value lives until the end of the
 * enclosing block. */
#define kd_integral_hole(r) ((const struct kd_hole[]) { kd_hole_in(r) })

/* kd_integral_is_pictured: true if the integral needs pictures. kd_integral_is_mapped: true if these pictures are maps
 * of light, to be Fourier-transformed. */
static inline bool kd_integral_is_pictured(enum kd_integral what) { return what >= KD_INTEGRAL_VOLUME; }
static inline bool kd_integral_is_mapped(enum kd_integral what) { return what >= KD_INTEGRAL_VISIBILITY; }

/* True if a checked request may have fields that are still open. An open field is NAN in the request, and a word in the
 * answer. */
static inline bool kd_integral_leaves_open(enum kd_integral what)
{
    return kd_integral_is_mapped(what) || what == KD_INTEGRAL_LAGS;
}

/* True if the maps are transformed at the baselines of an observation. */
static inline bool kd_integral_is_observed(enum kd_integral what) { return what >= KD_INTEGRAL_COMPARE; }

static inline bool kd_integral_is_compared(enum kd_integral what)
{
    return what == KD_INTEGRAL_COMPARE || what == KD_INTEGRAL_SETS;
}

/* True if a comparison searches for a size, an orientation or a position. */
static inline bool kd_integral_is_searched(const struct kd_integral_request *r)
{
    return kd_integral_is_compared(r->what) && r->solve & ~(uint32_t)KD_ALIGN_FLUX;
}

/* Upper bound of the number of transforms of the first map. A search for a shift counts each transform twice, because
 * testing a grid of shifts takes as long as the transform. */
static inline double kd_integral_evaluations(const struct kd_integral_request *r)
{
    return kd_integral_is_searched(r) ? kd_align_evaluations(r->solve) * (r->solve & KD_ALIGN_SHIFT ? 2. : 1.) : 1;
}

/* Fields of requests (document/document.h), for the reader, the schema and the options. The member `of` of a field has
 * a bit for each kind of integral. */
extern const struct kd_row kd_integral_fields[];
extern const size_t kd_n_integral_fields;

#endif
