/* The table of format.h, in a file of its own so that a test can replace it. */
#include "render/output/format.h"

#define ENTRY(name) &kd_format_##name,
const struct kd_format *const kd_formats[] = { KD_FORMATS(ENTRY) };
_Static_assert(sizeof kd_formats / sizeof *kd_formats <= KD_FORMATS_MAX, "KD_FORMATS_MAX is too small");
const size_t kd_n_formats = sizeof kd_formats / sizeof *kd_formats;
