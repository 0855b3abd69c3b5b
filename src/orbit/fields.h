/* Tables of the fields of a request for orbits (document/document.h). Private to src/orbit. */
#ifndef KD_ORBIT_FIELDS_H
#define KD_ORBIT_FIELDS_H

#include "document/document.h"
#include "orbit/asked.h"

/* `of` has a bit for each form of an orbit. */
enum { KD_ORBIT_N_SETTINGS = 17, KD_ORBIT_N_FIELDS = 18 };
extern const struct kd_row kd_orbit_settings[KD_ORBIT_N_SETTINGS];            /* of struct kd_orbit_params */
extern const struct kd_row kd_orbit_fields[KD_ORBIT_N_FIELDS];                /* of struct kd_orbit_spec */
extern const struct kd_document kd_orbit_request_document, kd_orbit_document; /* the whole request; one orbit */

#endif
