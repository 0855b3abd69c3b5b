/* Caches the words of a Milky Way in a file: making it takes 0.4 s, reading it 0.02 s. Any thread. */
#ifndef KD_RENDER_SKY_MILKY_WAY_FILE_H
#define KD_RENDER_SKY_MILKY_WAY_FILE_H

#include <stdbool.h>
#include <stdint.h>

/* Reads the Milky Way of a seed into words (kd_panorama_words of its size). Returns false if the file is missing,
 * damaged or of another seed. Also returns false if this program would make another picture; to check this, some rows
 * are computed again and compared. */
bool kd_milky_way_recall(const char *path, int32_t seed, uint32_t *words);
/* Writes the file, replacing any older one. A failure is only logged, as one debug line. */
void kd_milky_way_keep(const char *path, int32_t seed, const uint32_t *words);

#endif
