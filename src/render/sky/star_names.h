/* Names of the bright stars of the catalogue: all down to V = 4.5 that have any (data/hipparcos.names,
 * scripts/pack-stars). Pure; any thread. */
#ifndef KD_RENDER_SKY_STAR_NAMES_H
#define KD_RENDER_SKY_STAR_NAMES_H

#include "base/error.h"

#include <stddef.h>

#define KD_STAR_NAMES 912
#define KD_STAR_NAME 40 /* bytes of UTF-8, with the 0 at the end */

struct kd_star_name {
    size_t place;                   /* in the catalogue: kd_catalogue_star */
    char name[KD_STAR_NAME];        /* "Vega"; "" where it has none of its own, */
    char designation[KD_STAR_NAME]; /* but then this: "α Lyr", of J. Bayer or J. Flamsteed */
};

/* Reads the next one, the brightest first. *text: NULL to begin with; NULL again behind the last one, when nothing
 * was read. */
void kd_star_name_next(const char **text, struct kd_star_name *out);

#endif
