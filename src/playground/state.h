/* The "state" of a snapshot: all data that determine the motion, except settings and bodies. Private to
 * src/playground. */
#ifndef KD_PLAYGROUND_STATE_H
#define KD_PLAYGROUND_STATE_H

#include "playground/playground.h"

#include <cjson/cJSON.h>

enum kd_status kd_state_write(const struct kd_playground *p, struct kd_json *json);
/* Reads the state. p must already have the settings and the bodies of the snapshot. */
enum kd_status kd_state_read(struct kd_playground *p, const cJSON *state, struct kd_error *error);

#endif
