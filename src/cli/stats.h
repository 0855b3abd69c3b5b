/* Output of `kerrd render --stats`: times and accuracy of one picture. Any thread. */
#ifndef KD_CLI_STATS_H
#define KD_CLI_STATS_H

#include "base/json.h"
#include "render/render.h"

struct kd_stats {
    const char *device;
    const struct kd_scene *scene;
    const struct kd_plan *plan;
    const struct kd_frame *frame;
    double render_ms, encode_ms; /* elapsed time */
    size_t bytes;                /* size of the file */
};

/* Appends one line of JSON. */
enum kd_status kd_stats_json(const struct kd_stats *stats, struct kd_buffer *out);

/* Ends a line of JSON and prints it on standard error, for --stats of sweeps and films. Frees the line in any case.
 * KD_ENOMEM. */
enum kd_status kd_stats_print(struct kd_json *json, struct kd_buffer *line, struct kd_error *error);

#endif
