/* Repairs checksums that mutations break, so that the code behind the check is reached. */
#ifndef KD_FUZZ_MEND_H
#define KD_FUZZ_MEND_H

#include <stddef.h>
#include <stdint.h>

/* Writes the correct CRC after each chunk of a PNG file, as far as it has chunks; other bytes stay. */
void kd_fuzz_mend_png(uint8_t *data, size_t size);

#endif
