/* What the readers share. */
#ifndef KD_OBSERVE_INTERNAL_H
#define KD_OBSERVE_INTERNAL_H

#include "observe/observation.h"

/* csv.c, uvfits.c: fill all but the order; what they have made is the caller's to finish, also where they fail. */
enum kd_status kd_observation_read_csv(const char *text, size_t size, struct kd_observation *out,
                                       struct kd_error *error);
enum kd_status kd_observation_read_uvfits(const uint8_t *data, size_t size, struct kd_observation *out,
                                          struct kd_error *error);
/* Takes a name, cut at its trailing blanks; KD_EINVAL: it is empty, too long, or no plain text. */
enum kd_status kd_station_name(char out[KD_STATION_NAME], const char *text, size_t length, struct kd_error *error);

#endif
