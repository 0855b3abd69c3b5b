/* libFuzzer's entry point; the build defines which target it calls. */
#include "targets.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) { return KD_FUZZ_TARGET(data, size); }
