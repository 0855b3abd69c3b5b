/* Declarations shared by the readers of observations. */
#ifndef KD_OBSERVE_INTERNAL_H
#define KD_OBSERVE_INTERNAL_H

#include "observe/observation.h"

/* Readers of the two formats (csv.c, uvfits.c). They fill all members, with visibilities unsorted. The caller must
 * finish *out, even after a failure. */
enum kd_status kd_observation_read_csv(const char *text, size_t size, struct kd_observation *out,
                                       struct kd_error *error);
enum kd_status kd_observation_read_uvfits(const uint8_t *data, size_t size, struct kd_observation *out,
                                          struct kd_error *error);
/* Copies a station's name without trailing blanks. Returns KD_EINVAL if the name is empty, too long or not printable.
 */
enum kd_status kd_station_name(char out[KD_STATION_NAME], const char *text, size_t length, struct kd_error *error);

#endif
