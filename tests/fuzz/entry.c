/* libFuzzer calls this for every input; the build says which target it is of. */
#include "targets.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) { return KD_FUZZ_TARGET(data, size); }
