/* Repairs checksums that mutations break, so that the code behind the check is reached. */
#ifndef KD_FUZZ_MEND_H
#define KD_FUZZ_MEND_H

#include <stddef.h>
#include <stdint.h>

/* Writes the correct CRC after each complete chunk of a PNG file. All other bytes are unchanged. */
void kd_fuzz_mend_png(uint8_t *data, size_t size);

#endif
