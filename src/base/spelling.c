#include "base/spelling.h"

#include <ctype.h>
#include <string.h>

enum { NAME_MAX_BYTES = 40 };

static int least(int a, int b, int c)
{
    int m = a < b ? a : b;
    return m < c ? m : c;
}

int kd_spelling_distance(const char *given, const char *known)
{
    size_t na = strnlen(given, NAME_MAX_BYTES + 1), nb = strnlen(known, NAME_MAX_BYTES + 1);
    int row[NAME_MAX_BYTES + 1] = { 0 }, before[NAME_MAX_BYTES + 1] = { 0 }, two_before[NAME_MAX_BYTES + 1];
    if (na > NAME_MAX_BYTES || nb > NAME_MAX_BYTES)
        return KD_SPELLING_FAR;
    for (size_t j = 0; j <= nb; j++)
        row[j] = (int)j;
    for (size_t i = 1; i <= na; i++) {
        memcpy(two_before, before, sizeof before);
        memcpy(before, row, sizeof row);
        row[0] = (int)i;
        for (size_t j = 1; j <= nb; j++) {
            int differs = tolower((unsigned char)given[i - 1]) != known[j - 1];
            row[j] = least(before[j] + 1, row[j - 1] + 1, before[j - 1] + differs);
            if (i > 1 && j > 1 && tolower((unsigned char)given[i - 1]) == known[j - 2] &&
                tolower((unsigned char)given[i - 2]) == known[j - 1])
                row[j] = least(row[j], two_before[j - 2] + 1, row[j]);
        }
    }
    return row[nb];
}

int kd_spelling_score(const char *given, const char *known)
{
    size_t n = strnlen(given, NAME_MAX_BYTES + 1);
    int d = kd_spelling_distance(given, known);
    if (n >= 3 && n < strlen(known) && !strncmp(given, known, n) && known[n] == '_')
        return 1;
    return d <= (int)(n / 3) ? d : KD_SPELLING_FAR;
}

void kd_spelling_offer(struct kd_spelling_best *best, const char *given, const char *known)
{
    int score = kd_spelling_score(given, known);
    if (score < KD_SPELLING_FAR && (!best->name || score < best->score))
        *best = (struct kd_spelling_best) { known, score };
}
