/* The words of a Milky Way are kept in a file: it takes 0.4 s to make and 0.02 s to read. Any thread. */
#ifndef KD_RENDER_SKY_MILKY_WAY_FILE_H
#define KD_RENDER_SKY_MILKY_WAY_FILE_H

#include <stdbool.h>
#include <stdint.h>

/* Reads that of this seed into words, kd_panorama_words of its size. False: there is none, or of another seed, or it
 * is damaged, or this program makes another one: some rows of it are made anew, and compared. */
bool kd_milky_way_recall(const char *path, int32_t seed, uint32_t *words);
/* Writes it in place of what is there. What cannot be written costs one debug line. */
void kd_milky_way_keep(const char *path, int32_t seed, const uint32_t *words);

#endif
