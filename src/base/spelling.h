/* Spelling suggestions: finds the known name that an unknown name probably stands for. Pure; any thread. */
#ifndef KD_BASE_SPELLING_H
#define KD_BASE_SPELLING_H

enum { KD_SPELLING_FAR = 1000 };

/* Damerau–Levenshtein distance: the swap of two neighbouring letters counts as one edit. `known` is lower case.
 * KD_SPELLING_FAR if one of the names is longer than 40 bytes, which no name in kerrd is. */
int kd_spelling_distance(const char *given, const char *known);

/* Like kd_spelling_distance, but KD_SPELLING_FAR if the distance is more than a third of the length of `given`. If
 * `given` lacks only the unit at the end of the name, the result is 1. */
int kd_spelling_score(const char *given, const char *known);

/* The nearest of all names that were offered so far. `name` is NULL if none of them is near. Initialise with { 0 }. */
struct kd_spelling_best {
    const char *name;
    int score;
};
void kd_spelling_offer(struct kd_spelling_best *best, const char *given, const char *known);

#endif
