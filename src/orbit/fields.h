/* Tables of the fields of a request for orbits (document/document.h). Private to src/orbit. */
#ifndef KD_ORBIT_FIELDS_H
#define KD_ORBIT_FIELDS_H

#include "document/document.h"
#include "orbit/asked.h"

/* The documents of a request. The member `of` of a row has a bit for each form of an orbit. */
/* document of the whole request, which fills a struct kd_orbit_params */
extern const struct kd_document kd_orbit_request_document;
extern const struct kd_document kd_orbit_document; /* document of one orbit, which fills a struct kd_orbit_spec */

#endif
