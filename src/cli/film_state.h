/* What a folder of a film's frames says of them, film.json: of which request they are, and by what they were
 * rendered. Main thread only. */
#ifndef KD_CLI_FILM_STATE_H
#define KD_CLI_FILM_STATE_H

#include "base/error.h"

#include <stdbool.h>

struct kd_film_state {
    char request[65]; /* SHA-256 of all that frames depend on */
    unsigned frames;
    const char *device; /* as kd_renderer_device_name */
    double exposure;    /* of all frames, measured; NAN: none was */
};

/* Reads what the folder says, if it says something, and takes its exposure over. KD_EINVAL: its frames are of
 * another film, or were rendered by another version or device. */
enum kd_status kd_film_state_read(int folder, const char *path, struct kd_film_state *state, bool *there,
                                  struct kd_error *error);
enum kd_status kd_film_state_write(int folder, const struct kd_film_state *state, struct kd_error *error);

#endif
