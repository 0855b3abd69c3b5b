#include "document/words.h"

#include <stdio.h>
#include <string.h>

#define NUMBERED "_N"

int kd_word_count(const char *words)
{
    int count = 1;
    for (const char *c = words; *c; c++)
        count += *c == '|';
    return count;
}

struct kd_word kd_word(const char *words, int i)
{
    for (; words && i > 0; i--)
        words = (words = strchr(words, '|')) ? words + 1 : NULL;
    return (struct kd_word) { words, words ? (int)strcspn(words, "|") : 0 };
}

bool kd_word_at(const char *words, int i, char out[KD_WORD_ROOM])
{
    const struct kd_word word = kd_word(words, i);
    if (word.text)
        snprintf(out, KD_WORD_ROOM, "%.*s", word.length, word.text);
    return word.text;
}

int kd_word_index(const char *words, const char *text)
{
    const size_t n = strlen(text);
    for (int i = 0; words; i++) {
        if (strcspn(words, "|") == n && !memcmp(words, text, n))
            return i;
        words = strchr(words, '|');
        words = words ? words + 1 : NULL;
    }
    return -1;
}

struct kd_word kd_words_root(const char *known, int i, bool *numbered)
{
    const struct kd_word word = kd_word(known, i);
    const int mark = (int)strlen(NUMBERED);
    *numbered = word.length > mark && !memcmp(word.text + word.length - mark, NUMBERED, (size_t)mark);
    return (struct kd_word) { word.text, word.length - (*numbered ? mark : 0) };
}

/* Parses "_0" to "_99" without leading zeros. Returns -1 for any other text. */
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

static bool find(const char *known, const char *text, size_t length, struct kd_numbered_word *out)
{
    for (int i = 0; i < kd_word_count(known); i++) {
        bool numbered;
        const struct kd_word root = kd_words_root(known, i, &numbered);
        const size_t n = (size_t)root.length;
        if (length < n || memcmp(text, root.text, n))
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

bool kd_words_add(const char *known, const char *text, size_t length, struct kd_words *words)
{
    struct kd_numbered_word word;
    if (words->count >= KD_WORDS_MOST || !find(known, text, length, &word) || holds(words, word, words->count))
        return false;
    words->at[words->count++] = word;
    return true;
}

bool kd_words_read(const char *known, const char *text, struct kd_words *out)
{
    struct kd_words words = { 0 };
    for (;; text++) {
        size_t length = strcspn(text, ",");
        if (!kd_words_add(known, text, length, &words))
            return false;
        text += length;
        if (!*text)
            break;
    }
    *out = words;
    return true;
}

bool kd_words_hold(const char *known, const struct kd_words *words)
{
    if (words->count < 1 || words->count > KD_WORDS_MOST)
        return false;
    for (int i = 0; i < words->count; i++) {
        struct kd_numbered_word word = words->at[i];
        bool numbered;
        if (word.word < 0 || word.word >= kd_word_count(known) || word.number < -1 || word.number > KD_WORD_NUMBER_MAX)
            return false;
        kd_words_root(known, word.word, &numbered);
        if ((word.number >= 0 && !numbered) || holds(words, word, i))
            return false;
    }
    return true;
}

void kd_words_spell(const char *known, struct kd_numbered_word word, char out[KD_WORD_ROOM])
{
    bool numbered;
    const struct kd_word root = kd_words_root(known, word.word, &numbered);
    const int n = snprintf(out, KD_WORD_ROOM, "%.*s", root.length, root.text);
    if (word.number >= 0 && n < KD_WORD_ROOM)
        snprintf(out + n, (size_t)(KD_WORD_ROOM - n), "_%d", word.number);
}
