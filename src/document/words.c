/* Lists of words such as "a|b|c". */
#include "document/internal.h"

#include <stdio.h>
#include <string.h>

bool kd_word_at(const char *words, int i, char out[KD_WORD_ROOM])
{
    for (; words && i > 0; i--)
        words = (words = strchr(words, '|')) ? words + 1 : NULL;
    if (words)
        snprintf(out, KD_WORD_ROOM, "%.*s", (int)strcspn(words, "|"), words);
    return words;
}

int kd_word_index(const char *words, const char *text)
{
    char word[KD_WORD_ROOM];
    for (int i = 0; kd_word_at(words, i, word); i++)
        if (!strcmp(word, text))
            return i;
    return -1;
}
