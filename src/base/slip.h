/* Spelling suggestions: finds the known name that an unknown one was probably meant to be. Pure; any thread. */
#ifndef KD_BASE_SLIP_H
#define KD_BASE_SLIP_H

enum { KD_SLIP_FAR = 1000 };

/* Edit distance (Damerau and Levenshtein: two neighbours that have changed places are one edit) to a name of ours,
 * all lower case; KD_SLIP_FAR for names longer than any of ours. */
int kd_slip_distance(const char *given, const char *known);

/* The same, and KD_SLIP_FAR unless near enough to be a slip: one edit in three letters, or the name without its
 * unit. */
int kd_slip(const char *given, const char *known);

/* The nearest of the names offered; `name` stays NULL if none is near. Begin with { 0 }. */
struct kd_slip_best {
    const char *name;
    int score;
};
void kd_slip_offer(struct kd_slip_best *best, const char *given, const char *known);

#endif
