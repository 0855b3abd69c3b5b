/* Lists of words such as "a|b|c", and series of such words. A series contains some of the words in any order, each
 * at most once. If a list contains "b_N", a series may contain b, b_0, b_1, ... Pure, any thread. */
#ifndef KD_DOCUMENT_WORDS_H
#define KD_DOCUMENT_WORDS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { KD_WORD_ROOM = 64, KD_WORD_NUMBER_MAX = 99, KD_WORDS_MOST = 16 };

/* A word that is not NUL-terminated; print it with %.*s. */
struct kd_word {
    const char *text; /* NULL if the list has no such word */
    int length;
};
int kd_word_count(const char *words);
struct kd_word kd_word(const char *words, int i);
/* Copies word i. Returns false if the list has fewer words. */
bool kd_word_at(const char *words, int i, char out[KD_WORD_ROOM]);
/* Returns the index of a word, or -1 if the list does not have it. */
int kd_word_index(const char *words, const char *text);

/* A series of words. number: the N of a word "b_N", or -1 if the word has no number. All entries from index count on
 * are 0, so that equal series have equal bytes. */
struct kd_words {
    int32_t count;
    struct kd_numbered_word { int16_t word, number; } at[KD_WORDS_MOST];
};

/* Returns word i without its "_N". *numbered: true if it has "_N". */
struct kd_word kd_words_root(const char *known, int i, bool *numbered);
/* Adds a word. Returns false, and leaves *words unchanged, if the word is unknown, already there, or does not fit. */
bool kd_words_add(const char *known, const char *text, size_t length, struct kd_words *words);
/* Reads a series such as "a,b_1" from a command line or a link. Returns false if the text is empty, or if
 * kd_words_add fails for a word. */
bool kd_words_read(const char *known, const char *text, struct kd_words *out);
bool kd_words_hold(const char *known, const struct kd_words *words);
/* Writes the name of a word, with its number. */
void kd_words_spell(const char *known, struct kd_numbered_word word, char out[KD_WORD_ROOM]);

#endif
