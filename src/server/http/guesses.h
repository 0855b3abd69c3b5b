/* Throttle against guessing of access tokens. Each address may present a few wrong tokens at once, and one more every
 * few seconds. Beyond that, tokens new to that address are rejected unseen, so that guessing learns nothing; a token
 * that was accepted from there before still works, so that one client cannot lock out another behind the same proxy.
 * Repeating the same wrong token, as an open page does, counts once. Any thread. */
#ifndef KD_SERVER_HTTP_GUESSES_H
#define KD_SERVER_HTTP_GUESSES_H

#include "server/http/shares.h"

#include <stdint.h>

#define KD_GUESSES_MOST 20u  /* wrong tokens of an address at once */
#define KD_GUESSES_EACH_S 3u /* after which one more is taken */
#define KD_GUESSES_NAMES 64u /* that have been right from an address, and stay in: the latest ones */
#define KD_GUESSES_CLIENTS \
    256u /* addresses told apart; one more has the place of one that has tried least, and of these the one that was \
            heard of longest ago */

struct kd_guesses;

struct kd_guesses *kd_guesses_create(void);          /* NULL: out of memory */
void kd_guesses_destroy(struct kd_guesses *guesses); /* accepts NULL */

/* A right token has come: whose, by an address that stays. 0: it is taken. Else in how many seconds one will be. */
unsigned kd_guesses_right(struct kd_guesses *guesses, const char *client, const void *whose, double now_ms);
/* A wrong one has come, of this hash. 0: it is counted, and told so. Else in how many seconds another one will be
 * looked at. */
unsigned kd_guesses_wrong(struct kd_guesses *guesses, const char *client, uint64_t hash, double now_ms);

#endif
