/* The value of a WORDS field is some of its words in an order of their own, each once; a word that the field's row
 * has as "name_N" alone or with a number behind it, name_0, name_1, ... Any thread. */
#ifndef KD_SCENE_WORDS_H
#define KD_SCENE_WORDS_H

#include "scene/table.h"

enum { KD_WORD_SIZE = 40, KD_WORD_NUMBER_MAX = 99 };

/* One more word; false: it is none of the field's, or given twice, or there is no room. *words is then unchanged. */
bool kd_words_add(const struct kd_field *field, const char *text, size_t length, struct kd_words *words);
/* "a,b_1" from a command line or a link. False: as above, or there is none. */
bool kd_words_read(const struct kd_field *field, const char *text, struct kd_words *out);
/* Whether such a field may hold them. */
bool kd_words_hold(const struct kd_field *field, const struct kd_words *words);
/* How a word is spelt. */
void kd_words_spell(const struct kd_field *field, struct kd_numbered_word word, char out[KD_WORD_SIZE]);

/* Says of the field's words: how many letters one has without its "_N", and whether it has that. */
int kd_words_length(const struct kd_field *field, int index, bool *numbered);

#endif
