/* JSON Schema of members of a request that exclude one another. check.c, request.c and scene.c refuse the same
 * combinations. */
#ifndef KD_INTEGRAL_APART_H
#define KD_INTEGRAL_APART_H

#include "integral/request.h"

/* The schema that a request must not match: the value of "not" in the schema of a request. The spectra of a disk and of
 * a volume share one request schema (KD_INTEGRAL_SPECTRUM). */
const char *kd_integral_apart(enum kd_integral what);

#endif
