/* Values of WORDS fields: some of the field's words in any order, each once. A word that the row spells "name_N" may
 * have a number: name, name_0, name_1, ... Any thread. */
#ifndef KD_SCENE_WORDS_H
#define KD_SCENE_WORDS_H

#include "scene/table.h"

enum { KD_WORD_SIZE = 40, KD_WORD_NUMBER_MAX = 99 };

/* Adds a word. False, and *words unchanged, if it is not a word of the field, is given twice, or exceeds the room. */
bool kd_words_add(const struct kd_field *field, const char *text, size_t length, struct kd_words *words);
/* Reads "a,b_1" from a command line or a link. False as above, or if it is empty. */
bool kd_words_read(const struct kd_field *field, const char *text, struct kd_words *out);
/* True if the field may hold these words. */
bool kd_words_hold(const struct kd_field *field, const struct kd_words *words);
/* Writes the name of a word, with its number. */
void kd_words_spell(const struct kd_field *field, struct kd_numbered_word word, char out[KD_WORD_SIZE]);

/* Length of a word without its "_N"; *numbered: whether it has that. */
int kd_words_length(const struct kd_field *field, int index, bool *numbered);

#endif
