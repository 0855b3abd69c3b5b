/* kerrd doctor --selftest prints what the self-test of a device finds. Main thread only. */
#ifndef KD_CLI_SELFTEST_H
#define KD_CLI_SELFTEST_H

#include "base/error.h"

#include <stdbool.h>

/* Runs the self-test on the device and prints its table, or with `json` one JSON document. KD_OK also when checks
 * failed: *failed counts them. */
enum kd_status kd_cli_selftest(const char *device, bool json, unsigned *failed, struct kd_error *error);

#endif
