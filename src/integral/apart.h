/* Exclusive members of a request for integrals, in JSON Schema. check.c, request.c and scene.c refuse the same
 * combinations. */
#ifndef KD_INTEGRAL_APART_H
#define KD_INTEGRAL_APART_H

#include "integral/request.h"

/* The value of "not" in the schema of a request, which gives the spectrum of a disk and that of a volume as one
 * (KD_INTEGRAL_SPECTRUM). */
const char *kd_integral_apart(enum kd_integral what);

#endif
