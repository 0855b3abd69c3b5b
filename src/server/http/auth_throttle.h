/* Throttle against guessing of access tokens. Each address may present a few wrong tokens at once, and one more
 * every few seconds. After more wrong tokens, the address is throttled: a token that is new to the address is
 * rejected without a check, so an attacker learns nothing. A token that was accepted from the address before still
 * works, so one client cannot lock out another behind the same proxy. Repeating the same wrong token, as an open
 * page does, counts once. Any thread. */
#ifndef KD_SERVER_HTTP_AUTH_THROTTLE_H
#define KD_SERVER_HTTP_AUTH_THROTTLE_H

#include "server/http/shares.h"

#include <stdint.h>

#define KD_GUESSES_MOST 20u  /* wrong tokens that an address may present in a burst */
#define KD_GUESSES_EACH_S 3u /* seconds after which the address may present one more wrong token */
#define KD_GUESSES_NAMES 64u /* owners of the latest accepted tokens that are remembered for each address */
/* addresses tracked; when the table is full, the address with the fewest recent failures is evicted, and among
 * several such addresses the one least recently seen */
#define KD_GUESSES_CLIENTS 256u

struct kd_auth_throttle;

struct kd_auth_throttle *kd_auth_throttle_create(void);           /* returns NULL when out of memory */
void kd_auth_throttle_destroy(struct kd_auth_throttle *throttle); /* accepts NULL */

/* Reports a right token. whose: a pointer that identifies its owner. Returns 0 if the token is accepted. Otherwise
 * returns the seconds until this address may present a new token. */
unsigned kd_auth_throttle_right(struct kd_auth_throttle *throttle, const char *client, const void *whose,
                                double now_ms);
/* Reports a wrong token by its hash. Returns 0 if the client gets the ordinary refusal, because the token is counted
 * now or was counted before. Otherwise returns the seconds until this address may present another token. */
unsigned kd_auth_throttle_wrong(struct kd_auth_throttle *throttle, const char *client, uint64_t hash, double now_ms);

#endif
