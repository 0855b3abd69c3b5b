/* What is asked of an integral, and the table of its fields. Any thread. */
#ifndef KD_INTEGRAL_ASKED_H
#define KD_INTEGRAL_ASKED_H

#include "observe/comparison.h"
#include "physics/disk/line_profile.h"
#include "scene/asset.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* VOLUME is what SPECTRUM becomes when a scene is given. It and those behind it are made of pictures (integral/run.h).
 */
enum kd_integral {
    KD_INTEGRAL_LINE,
    KD_INTEGRAL_TRANSFER,
    KD_INTEGRAL_SPECTRUM,
    KD_INTEGRAL_VOLUME,
    KD_INTEGRAL_VISIBILITY,
    KD_INTEGRAL_COMPARE,
    KD_INTEGRALS
};

struct kd_integral_list {
    double *at; /* malloc'd */
    size_t n;
};

struct kd_integral_request {
    enum kd_integral what;
    double spin, inclination_deg, inner, outer; /* inner: NaN: the ISCO */
    enum kd_line_emissivity emissivity;
    double index, outer_index, break_r, height, photon_index, tolerance;
    enum kd_line_limb limb;
    int energy;                                 /* 0: photons, 1: energy */
    double rest_energy, energy_min, energy_max; /* energy_max: NaN: 1.7 rest_energy */
    uint32_t bins;
    struct kd_integral_list edges;
    struct kd_integral_list radii, g_star; /* of a transfer function */
    uint32_t rings, g_stars;
    double mass_msun, distance_pc, mdot_edd, colour_correction; /* of a spectrum */
    double frequency_min_hz, frequency_max_hz;                  /* NaN: by the hottest ring */
    uint32_t frequencies;
    struct kd_integral_list frequencies_hz;
    struct kd_scene *scene;         /* malloc'd; NULL: none is given */
    const struct kd_assets *assets; /* by which its names of assets are resolved as it is read; NULL: whoever reads it
                                       resolves and validates it */
    uint32_t pixels;                /* of the longer side of a picture; 0: as many as are usual */
    int unchecked;                  /* 0: finer pictures tell the error */
    struct kd_integral_list u, v, lengths,
        angles_deg;    /* of a visibility, Gl: a list of baselines, or lengths by angles, which become one */
    double length_max; /* NaN: half of what the pixels resolve */
    uint32_t baselines, orders;
    struct kd_observation *observation; /* of a comparison: malloc'd; NULL: none is given */
    struct kd_comparison *comparison;   /* malloc'd, of a request that has been checked; its models are filled in by
                                           whoever runs it, its visibilities are u and v */
    double average_s, snr_cut, uv_min_gl, systematic_visibility, systematic_amplitude, systematic_closure_phase_deg;
    int measured, maximal;
    enum kd_pixel_shape pulse;
    double flux_jy;           /* NaN: the scene's own, or if it has none what fits best */
    uint32_t products, solve; /* a bit each: enum kd_product; 1: the flux */
    uint64_t seen;            /* which fields were given, a bit each */
};

/* Whether it is made of pictures, and of the maps of light that are transformed. */
static inline bool kd_integral_is_pictured(enum kd_integral what) { return what >= KD_INTEGRAL_VOLUME; }
static inline bool kd_integral_is_mapped(enum kd_integral what) { return what >= KD_INTEGRAL_VISIBILITY; }

/* Fields for whoever lists them. */
enum kd_integral_kind { KD_INTEGRAL_REAL, KD_INTEGRAL_WHOLE, KD_INTEGRAL_WORD, KD_INTEGRAL_WORDS, KD_INTEGRAL_NUMBERS };
struct kd_integral_field {
    const char *name, *unit, *help; /* a name with a dot is a member of an object: systematic.amplitude */
    enum kd_integral_kind kind;
    size_t offset;
    double least, most;
    bool open;         /* neither end is allowed */
    const char *words; /* "a|b": WORD; WORDS: some of them, at least `least`; REAL: a word that stands for NaN */
    unsigned of;       /* a bit for each integral that has it */
    bool lacks;        /* a request that has been checked may have no number for it */
};
extern const struct kd_integral_field kd_integral_fields[];
extern const size_t kd_n_integral_fields;

#endif
