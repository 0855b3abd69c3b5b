/* Tests a device when it is first started, and again with a new version of its driver or of kerrd. */
#ifndef KD_RENDER_SELFTEST_FIRST_START_H
#define KD_RENDER_SELFTEST_FIRST_START_H

#include "render/device/verdict.h"

#include "base/error.h"

/* If the device is unknown: tests it and measures the costs of passes. A failed check is logged as an error and run
 * again at the next start. The result is still KD_OK, so that the user may decide to use the device. Returns an
 * error only if the device is lost. For kd_renderer_params.prove. */
enum kd_status kd_first_start(struct kd_renderer *renderer, struct kd_error *error);

#endif
