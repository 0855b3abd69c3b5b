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

/* SPECTRUM becomes VOLUME when a scene is given, and COMPARE becomes SETS when sets are given. VOLUME and the kinds
 * after it are made of pictures (integral/run.h). */
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
    double inclination_deg, inner, outer; /* inner NaN: the ISCO */
    enum kd_line_emissivity emissivity;
    double index, outer_index, break_r, height, photon_index, tolerance;
    enum kd_limb limb;
    int energy;                                 /* the profile counts 0: photons, 1: energy */
    double rest_energy, energy_min, energy_max; /* energy_max NaN: 1.7 rest_energy */
    uint32_t bins;
    struct kd_number_list edges;
    enum kd_corona_motion motion; /* motion of a corona off the axis */
    double corona_radius, corona_inner, corona_top;
    double time_min, time_max; /* range of the bins of time of an impulse response */
    uint32_t times;
    /* members for lags; reference_min NaN: the reference is the continuum */
    double reflection, reference_min, reference_max, frequency_min, frequency_max;
    struct kd_number_list frequencies_m;
    struct kd_number_list radii, g_star; /* lists for a transfer function */
    uint32_t rings, g_stars;
    double mass_msun, distance_pc, mdot_edd, colour_correction; /* members for a spectrum */
    int returning;                                              /* enum kd_integral_returning */
    int polarized;                                              /* 1: the spectrum is polarised */
    double frequency_min_hz, frequency_max_hz;                  /* NaN: chosen by the hottest ring */
    uint32_t frequencies;
    struct kd_number_list frequencies_hz;
    struct kd_scene *scene; /* malloc'd; NULL: none given */
    /* Resolves names of assets while the scene is read. NULL: the caller resolves and validates the scene. */
    const struct kd_assets *assets;
    uint32_t pixels; /* pixels on the longer side of a picture; 0: the default */
    int unchecked;   /* 0: finer pictures estimate the error */
    struct kd_number_list u, v, lengths,
        /* For a visibility, in Gl (10^9 wavelengths): a list of baselines, or lists of lengths and angles, which are
         * expanded into baselines. */
        angles_deg;
    double length_max; /* NaN: half of the longest baseline that the pixels resolve */
    uint32_t baselines, orders;
    uint32_t digits;                    /* significant digits of the columns' numbers in text */
    struct kd_observation *observation; /* for a comparison or a simulation: malloc'd; NULL: none given */
    /* For a simulation from a uvfits file: the bytes of that file, malloc'd. The run replaces their visibilities by
     * simulated ones. */
    uint8_t *file;
    size_t file_size;
    uint32_t seed;
    int noiseless;
    /* malloc'd once a comparison's request has been checked. The run fills in the models. The baselines of the
     * comparison become the request's lists u and v. */
    struct kd_comparison *comparison;
    struct kd_integral_sets *sets; /* integral/sets.h: malloc'd; NULL: none given */
    double average_s, snr_cut, uv_min_gl, systematic_visibility, systematic_amplitude, systematic_closure_phase_deg;
    int measured, maximal;
    enum kd_pixel_shape pulse;
    int scattering;           /* 1: the scattering towards Sgr A* is applied, observe/scattering.h */
    double flux_jy;           /* NaN: the scene's own flux, or the best fit if the scene has none */
    uint32_t products, solve; /* bit masks: products of enum kd_product; solve: KD_ALIGN_... */
    uint64_t seen[2];         /* bit mask of the fields that the request gives */
};

/* The hole of a thin disk, for use as an argument. The value lives until the end of the enclosing block. */
#define kd_integral_hole(r) ((const struct kd_hole[]) { kd_hole_in(r) })

/* kd_integral_is_pictured: whether the integral needs pictures. kd_integral_is_mapped: whether these are maps of light
 * to be Fourier-transformed. */
static inline bool kd_integral_is_pictured(enum kd_integral what) { return what >= KD_INTEGRAL_VOLUME; }
static inline bool kd_integral_is_mapped(enum kd_integral what) { return what >= KD_INTEGRAL_VISIBILITY; }

/* True if fields of a checked request may be left open. An open field is NAN in the request, and a word in the
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

/* Upper bound of the number of times that the first map is transformed. If a shift is searched for, each transform
 * counts twice, because testing a grid of shifts takes as long as the transform. */
static inline double kd_integral_evaluations(const struct kd_integral_request *r)
{
    return kd_integral_is_searched(r) ? kd_align_evaluations(r->solve) * (r->solve & KD_ALIGN_SHIFT ? 2. : 1.) : 1;
}

/* Fields of requests (document/document.h), for the reader, the schema and the options. `of` has a bit for each kind of
 * integral. */
extern const struct kd_row kd_integral_fields[];
extern const size_t kd_n_integral_fields;

#endif
