/* Values of WORDS fields: some of the field's words in any order, each at most once. A word that is written "name_N" in
 * the row may have a number: name, name_0, name_1, ... Any thread. */
#ifndef KD_SCENE_WORDS_H
#define KD_SCENE_WORDS_H

#include "scene/table.h"

enum { KD_WORD_SIZE = 40, KD_WORD_NUMBER_MAX = 99 };

/* Adds a word. Returns false if it is not a word of the field, is there already, or exceeds the room; *words is then
 * unchanged. */
bool kd_words_add(const struct kd_field *field, const char *text, size_t length, struct kd_words *words);
/* Reads "a,b_1" from a command line or a link. Returns false if kd_words_add does, or if the text is empty. */
bool kd_words_read(const struct kd_field *field, const char *text, struct kd_words *out);
/* Whether the field may have these words. */
bool kd_words_hold(const struct kd_field *field, const struct kd_words *words);
/* Writes the name of a word, with its number. */
void kd_words_spell(const struct kd_field *field, struct kd_numbered_word word, char out[KD_WORD_SIZE]);

/* Length of a word without its "_N". *numbered: whether it has "_N". */
int kd_words_length(const struct kd_field *field, int index, bool *numbered);

#endif
