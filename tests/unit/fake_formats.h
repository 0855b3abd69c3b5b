#ifndef KD_TESTS_UNIT_FAKE_FORMATS_H
#define KD_TESTS_UNIT_FAKE_FORMATS_H

#include "render/output/format.h"

extern const struct kd_format fake_format;
extern int fake_memories; /* number of memory blocks that the format was given and that it has not yet freed */

#endif
