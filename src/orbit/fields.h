/* Tables of the fields of a request for orbits (document/document.h). Private to src/orbit. */
#ifndef KD_ORBIT_FIELDS_H
#define KD_ORBIT_FIELDS_H

#include "document/document.h"
#include "orbit/asked.h"

/* The member `of` of a row has a bit for each form of an orbit. */
extern const struct kd_document kd_orbit_request_document; /* the whole request, of struct kd_orbit_params */
extern const struct kd_document kd_orbit_document;         /* one orbit, of struct kd_orbit_spec */

#endif
