/* Limits guessing of access tokens. Each address may present a few wrong tokens at once, and one more every few
 * seconds. After more wrong tokens, the address is throttled: a token that is new to the address is rejected without
 * a check, so an attacker learns nothing. A token that was accepted from this address before still works, so that
 * one client behind a proxy cannot lock out the others. The same wrong token counts only once, because an open page
 * repeats it. Any thread. */
#ifndef KD_SERVER_HTTP_AUTH_THROTTLE_H
#define KD_SERVER_HTTP_AUTH_THROTTLE_H

#include "server/http/shares.h"

#include <stdint.h>

#define KD_GUESSES_MOST 20u  /* number of wrong tokens that an address may present at once */
#define KD_GUESSES_EACH_S 3u /* number of seconds after which an address may present one more wrong token */
/* number of owners of accepted tokens that are remembered for each address, the latest ones */
#define KD_GUESSES_NAMES 64u
/* number of addresses in the table. When it is full, the address with the fewest recent failures is evicted; of
 * several such addresses, the one that was not seen for the longest time. */
#define KD_GUESSES_CLIENTS 256u

struct kd_auth_throttle;

struct kd_auth_throttle *kd_auth_throttle_create(void);           /* returns NULL when out of memory */
void kd_auth_throttle_destroy(struct kd_auth_throttle *throttle); /* accepts NULL */

/* Reports a right token. whose: a pointer that identifies the token's owner. Returns 0 if the token is accepted;
 * otherwise the number of seconds until this address may present a new token. */
unsigned kd_auth_throttle_right(struct kd_auth_throttle *throttle, const char *client, const void *whose,
                                double now_ms);
/* Reports a wrong token by its hash. Returns 0 if the client gets the usual refusal, because this address may try more
 * tokens, or because the same wrong token was counted before. Otherwise returns the number of seconds until this
 * address may present another token. */
unsigned kd_auth_throttle_wrong(struct kd_auth_throttle *throttle, const char *client, uint64_t hash, double now_ms);

#endif
