/* `kerrd render --stats` prints this: one picture's times and accuracy. Any thread. */
#ifndef KD_CLI_STATS_H
#define KD_CLI_STATS_H

#include "base/json.h"
#include "render/render.h"

struct kd_stats {
    const char *device;
    const struct kd_scene *scene;
    const struct kd_plan *plan;
    const struct kd_frame *frame;
    double render_ms, encode_ms; /* by the wall clock */
    size_t bytes;                /* of the PNG file */
};

/* One line of JSON. */
enum kd_status kd_stats_json(const struct kd_stats *stats, struct kd_buffer *out);

/* Ends a line of JSON and prints it on standard error, as --stats of sweeps and films does; frees it in any case.
 * KD_ENOMEM. */
enum kd_status kd_stats_print(struct kd_json *json, struct kd_buffer *line, struct kd_error *error);

#endif
