/* Formats with sums of their bytes refuse whatever a random change has made: these make the sums good again, so that
 * what lies behind is reached. */
#ifndef KD_FUZZ_MEND_H
#define KD_FUZZ_MEND_H

#include <stddef.h>
#include <stdint.h>

/* Writes the right CRC behind each chunk of a PNG file, as far as there are chunks; other bytes stay. */
void kd_fuzz_mend_png(uint8_t *data, size_t size);

#endif
