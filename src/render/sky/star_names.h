/* Names of the bright stars of the catalogue: all stars down to V = 4.5 that have a name (data/hipparcos.names,
 * scripts/pack-stars). Pure; any thread. */
#ifndef KD_RENDER_SKY_STAR_NAMES_H
#define KD_RENDER_SKY_STAR_NAMES_H

#include "base/error.h"

#include <stddef.h>

#define KD_STAR_NAMES 912
#define KD_STAR_NAME 40 /* bytes of UTF-8, with the terminating 0 */

struct kd_star_name {
    size_t place;                   /* index of the star in the catalogue: kd_catalogue_star */
    char name[KD_STAR_NAME];        /* "Vega"; "" if the star has no proper name */
    char designation[KD_STAR_NAME]; /* "α Lyr", by J. Bayer or J. Flamsteed; "" if the star has none */
};

/* Reads the next name, that of the brightest star first. *text: NULL at the first call; it becomes NULL after the last
 * name, and then *out is not set. */
void kd_star_name_next(const char **text, struct kd_star_name *out);

#endif
