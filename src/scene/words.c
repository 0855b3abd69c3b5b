#include "scene/words.h"

#include <stdio.h>
#include <string.h>

#define NUMBERED "_N"

int kd_words_length(const struct kd_field *field, int index, bool *numbered)
{
    struct kd_word word = kd_field_word(field, index);
    int mark = (int)strlen(NUMBERED);
    *numbered = word.length > mark && !memcmp(word.text + word.length - mark, NUMBERED, (size_t)mark);
    return word.length - (*numbered ? mark : 0);
}

/* Parses "_0" to "_99" without leading zeros; -1 if the text is something else. */
static int number_of(const char *text, size_t length)
{
    if (length < 2 || length > 3 || text[0] != '_' || (length == 3 && text[1] == '0'))
        return -1;
    int value = 0;
    for (size_t i = 1; i < length; i++) {
        if (text[i] < '0' || text[i] > '9')
            return -1;
        value = 10 * value + text[i] - '0';
    }
    return value;
}

static bool find(const struct kd_field *field, const char *text, size_t length, struct kd_numbered_word *out)
{
    for (int i = 0; i < kd_field_word_count(field); i++) {
        bool numbered;
        size_t n = (size_t)kd_words_length(field, i, &numbered);
        if (length < n || memcmp(text, kd_field_word(field, i).text, n))
            continue;
        int number = number_of(text + n, length - n);
        if (length == n || (numbered && number >= 0)) {
            *out = (struct kd_numbered_word) { (int16_t)i, (int16_t)number };
            return true;
        }
    }
    return false;
}

static bool holds(const struct kd_words *words, struct kd_numbered_word word, int count)
{
    for (int i = 0; i < count; i++)
        if (words->at[i].word == word.word && words->at[i].number == word.number)
            return true;
    return false;
}

bool kd_words_add(const struct kd_field *field, const char *text, size_t length, struct kd_words *words)
{
    struct kd_numbered_word word;
    if (words->count >= KD_WORDS_MOST || !find(field, text, length, &word) || holds(words, word, words->count))
        return false;
    words->at[words->count++] = word;
    return true;
}

bool kd_words_read(const struct kd_field *field, const char *text, struct kd_words *out)
{
    struct kd_words words = { 0 };
    for (;; text++) {
        size_t length = strcspn(text, ",");
        if (!kd_words_add(field, text, length, &words))
            return false;
        text += length;
        if (!*text)
            break;
    }
    *out = words;
    return true;
}

bool kd_words_hold(const struct kd_field *field, const struct kd_words *words)
{
    if (words->count < 1 || words->count > KD_WORDS_MOST)
        return false;
    for (int i = 0; i < words->count; i++) {
        struct kd_numbered_word word = words->at[i];
        bool numbered;
        if (word.word < 0 || word.word >= kd_field_word_count(field) || word.number < -1 ||
            word.number > KD_WORD_NUMBER_MAX)
            return false;
        kd_words_length(field, word.word, &numbered);
        if ((word.number >= 0 && !numbered) || holds(words, word, i))
            return false;
    }
    return true;
}

void kd_words_spell(const struct kd_field *field, struct kd_numbered_word word, char out[KD_WORD_SIZE])
{
    bool numbered;
    int length = kd_words_length(field, word.word, &numbered);
    int n = snprintf(out, KD_WORD_SIZE, "%.*s", length, kd_field_word(field, word.word).text);
    if (word.number >= 0 && n < KD_WORD_SIZE)
        snprintf(out + n, (size_t)(KD_WORD_SIZE - n), "_%d", word.number);
}
