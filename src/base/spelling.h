/* Spelling suggestions: finds the known name that an unknown one is probably meant to be. Pure; any thread. */
#ifndef KD_BASE_SPELLING_H
#define KD_BASE_SPELLING_H

enum { KD_SPELLING_FAR = 1000 };

/* Edit distance of Damerau and Levenshtein: swapping two neighbouring letters is one edit. `known` is lower case.
 * KD_SPELLING_FAR if one of the names is longer than 40 bytes, which no name of kerrd is. */
int kd_spelling_distance(const char *given, const char *known);

/* Like kd_spelling_distance, but KD_SPELLING_FAR if the distance exceeds a third of given's length. If only the unit is
 * missing from a name, the distance is 1. */
int kd_spelling_score(const char *given, const char *known);

/* The nearest of the names that were offered. `name` is NULL if none of them is near. Initialise with { 0 }. */
struct kd_spelling_best {
    const char *name;
    int score;
};
void kd_spelling_offer(struct kd_spelling_best *best, const char *given, const char *known);

#endif
