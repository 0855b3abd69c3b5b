/* The file film.json in the folder of a film's frames. It identifies the request, the version and the device with
 * which the frames were made. Main thread only. */
#ifndef KD_CLI_FILM_STATE_H
#define KD_CLI_FILM_STATE_H

#include "base/error.h"

#include <stdbool.h>

struct kd_film_state {
    char request[65]; /* SHA-256 of everything that determines the frames */
    unsigned frames;
    const char *device; /* see kd_renderer_device_name */
    double exposure;    /* measured common exposure of the frames, in stops; NAN: none */
};

/* If film.json exists, reads it and takes the exposure from it. Returns KD_EINVAL if the frames belong to another
 * film, version or device. */
enum kd_status kd_film_state_read(int folder, const char *path, struct kd_film_state *state, bool *there,
                                  struct kd_error *error);
enum kd_status kd_film_state_write(int folder, const struct kd_film_state *state, struct kd_error *error);

#endif
