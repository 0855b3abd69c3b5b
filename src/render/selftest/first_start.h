/* A device, or a version of its driver or of kerrd, that has not been met before is tested when it is first started. */
#ifndef KD_RENDER_SELFTEST_FIRST_START_H
#define KD_RENDER_SELFTEST_FIRST_START_H

#include "render/device/verdict.h"

#include "base/error.h"

/* If nothing is known: test it and measure what passes cost. A check that fails is logged as an error, and tested
 * again at the next start; KD_OK all the same, since the user may know better. An error only where the device is
 * lost. For kd_renderer_params.prove. */
enum kd_status kd_first_start(struct kd_renderer *renderer, struct kd_error *error);

#endif
