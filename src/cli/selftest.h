/* Prints the results of kerrd doctor --selftest. Main thread only. */
#ifndef KD_CLI_SELFTEST_H
#define KD_CLI_SELFTEST_H

#include "base/error.h"

#include <stdbool.h>

/* Runs the self-test on the device and prints its results, as a table or, if `json` is true, as a JSON document.
 * *failed: number of failed checks. The function returns KD_OK even if checks have failed. */
enum kd_status kd_cli_selftest(const char *device, bool json, unsigned *failed, struct kd_error *error);

#endif
