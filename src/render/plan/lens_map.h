/* The rays of a plan: their number, how they are traced, and the lens map that they fill. Plain data and pure
 * functions; any thread. */
#ifndef KD_RENDER_PLAN_LENS_MAP_H
#define KD_RENDER_PLAN_LENS_MAP_H

#include "lens.h"
#include "render/accuracy/engine.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

struct kd_plan_lens {
    uint32_t side; /* number of rays along each side of a pixel */
    uint64_t rays; /* number of rays of the grid */
    /* number of rays of each pixel at the critical curve (view/critical_pixels.h); 0: the same number as for any other
     * pixel */
    uint32_t critical;
    /* number of rays of each pixel at the critical curve after refinement (frame/refine.c); 0: no refinement there */
    uint32_t critical_dense;
    uint64_t critical_pixels; /* number of pixels at the critical curve */
    uint64_t critical_part;   /* number of these pixels that fit one buffer of their lens map */
    uint32_t adaptive;        /* number of rays of a refined pixel (frame/refine.c); 0: no refinement */
    uint64_t listed_bytes;    /* size of the buffer for the lens map of refined pixels, filled part by part */
    enum kd_lens_path {
        KD_LENS_CLOSED, /* lens_closed.comp: closed forms, for observers outside the photon orbits */
        KD_LENS_MAP,    /* lens_map.comp: by integration steps */
        KD_LENS_LISTED, /* listed rays (render/rays/rays.h), by any engine in either precision */
    } path;
    /* tolerated relative error of a map interpolated between nodes (plan/sample.h); 0: every ray is traced */
    double interpolates;
    uint32_t sample_rows;      /* largest number of rows of pixels whose map is interpolated at once */
    struct kd_setting setting; /* engine, precision and steps per half period (0: closed form) */
    bool ring;                 /* true if rays are listed in rings round the critical curve */
    bool ingoing;              /* true if the observer falls; coordinates are then regular at the outer horizon */
    bool ends;                 /* true if some emitters shine at the ends of rays; the lens map then holds these ends */
    uint32_t quantities;       /* KD_LENS_... quantities of the lens map */
    uint32_t orders;           /* number of crossings that are recorded for each ray */
    uint32_t planes;           /* number of 4-byte values of each ray in the lens map */
    bool cacheable;            /* true if the whole lens map fits in memory and can be cached */
    /* number of rays of the lens map that are traced again in closed form, at most KD_AUDIT_RAYS; 0: none */
    uint32_t audit;
    char key[65]; /* hash of everything that the lens map depends on */
};

#define KD_AUDIT_RAYS 768 /* largest number of audited rays, on a grid of 16 x 48 */

/* kd_plan_critical_parts: number of buffers for the lens map of the pixels at the critical curve.
 * kd_plan_critical_bytes: bytes of one such buffer. */
static inline uint32_t kd_plan_critical_parts(const struct kd_plan_lens *lens)
{
    return lens->critical ? (uint32_t)((lens->critical_pixels + lens->critical_part - 1) / lens->critical_part) : 0;
}
static inline uint64_t kd_plan_critical_bytes(const struct kd_plan_lens *lens)
{
    return 4ull * lens->critical_part * (lens->planes * lens->critical + 2);
}

/* If image.samples is "auto", a pixel may have KD_PLAN_ADAPTIVE_SIDE^2 rays. */
#define KD_PLAN_ADAPTIVE_SIDE 4
#define KD_PLAN_TRUTH_SIDE 8       /* side of the grid of rays that measure the remaining error of a pixel */
#define KD_PLAN_SAMPLED_OF_EACH 48 /* number of pixels, of each of four kinds, whose remaining error is measured */
#define KD_PLAN_SAMPLED (4 * KD_PLAN_SAMPLED_OF_EACH * KD_PLAN_TRUTH_SIDE * KD_PLAN_TRUTH_SIDE)
#define KD_PLAN_ROUNDS 6                            /* largest number of rounds in which pixels are chosen */
#define KD_PLAN_REFINING_LOOKS (1 + KD_PLAN_ROUNDS) /* number of times that the displayed picture is examined */
#define KD_PLAN_LISTED_BYTES (15u << 20)            /* chosen so that the listed rays fit in 65535 workgroups */

/* Number of pixels, with `rays` rays each, whose lens map fits the buffer of listed pixels. */
static inline uint64_t kd_plan_listed_most(const struct kd_plan_lens *lens, uint32_t rays)
{
    return lens->listed_bytes / (4ull * (lens->planes * rays + 2));
}

static inline bool kd_plan_holds(const struct kd_plan_lens *lens, uint32_t quantities)
{
    return (lens->quantities & quantities) == quantities;
}

static inline bool kd_plan_has_footprints(const struct kd_plan_lens *lens)
{
    return lens->quantities & (KD_LENS_FOOTPRINT | KD_LENS_SKY_FOOTPRINT);
}

/* True if the lens map is the cheapest kind: crossing radii only, by the closed form. */
static inline bool kd_plan_is_radii(const struct kd_plan_lens *lens)
{
    return lens->path == KD_LENS_CLOSED && !(lens->quantities & ~(uint32_t)KD_LENS_W);
}

/* Number of rays that are traced or interpolated. */
static inline uint64_t kd_plan_rays(const struct kd_plan_lens *lens)
{
    return lens->rays + lens->critical * lens->critical_pixels;
}

/* If the map is interpolated, the number of traced rays is KD_PLAN_FOLLOWED times the square root of the number of the
 * grid's rays. The traced rays lie along edges of orders and fates. Between these edges the traced rays lie at nodes.
 * The denser the rays of the picture, the smaller is the fraction of rays that are nodes. Measurements on four presets,
 * one of them from 320 x 180 to 4K, gave factors of 117 to 154 (docs/accuracy.md). */
#define KD_PLAN_FOLLOWED 130
static inline uint64_t kd_plan_followed(const struct kd_plan_lens *lens)
{
    const double rays = (double)lens->rays, most = fmin(rays, KD_PLAN_FOLLOWED * sqrt(rays));
    return lens->interpolates > 0 ? (uint64_t)most + lens->critical * lens->critical_pixels : kd_plan_rays(lens);
}

/* Limit for the rays traced by refinement: a quarter of the rays of a picture that has 16 in each pixel. */
static inline uint64_t kd_plan_followed_most(const struct kd_plan_lens *lens)
{
    const uint64_t uniform = lens->adaptive * lens->rays + lens->critical_dense * lens->critical_pixels;
    return uniform / 4 - lens->rays - lens->critical * lens->critical_pixels;
}

#endif
