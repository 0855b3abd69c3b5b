/* Prints the results of kerrd doctor --selftest. Main thread only. */
#ifndef KD_CLI_SELFTEST_H
#define KD_CLI_SELFTEST_H

#include "base/error.h"

#include <stdbool.h>

/* Runs the self-test on the device and prints its table, or a JSON document if `json` is true. *failed is the number
 * of failed checks. Failed checks alone do not change the result KD_OK. */
enum kd_status kd_cli_selftest(const char *device, bool json, unsigned *failed, struct kd_error *error);

#endif
