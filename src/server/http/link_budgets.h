/* Stores, for each signed link with a budget, the device time that it has used, until the link expires. With a state
 * folder, these amounts are kept in a file there and survive a restart. Any thread. */
#ifndef KD_SERVER_HTTP_LINK_BUDGETS_H
#define KD_SERVER_HTTP_LINK_BUDGETS_H

#include "server/http/link.h"

#define KD_LINK_BUDGETS 16384u /* maximum number of links with a budget that are stored */
#define KD_LINK_BUDGETS_FILE "link-budgets"

struct kd_link_budgets;

struct kd_link_budgets *kd_link_budgets_create(void);      /* returns NULL when out of memory */
void kd_link_budgets_destroy(struct kd_link_budgets *all); /* accepts NULL */
/* Reads the file in the folder `state`, and writes all later changes to it. The file is created if it does not
 * exist. Returns KD_EINVAL if it cannot be read or is not a file of link budgets. Call this before the first
 * request. */
enum kd_status kd_link_budgets_open(struct kd_link_budgets *all, const char *state, struct kd_error *error);

enum kd_link_left { KD_LINK_LEFT, KD_LINK_SPENT, KD_LINK_CROWDED };
/* Tests whether the link has device time left. Returns KD_LINK_CROWDED if too many links with a budget are in use.
 * Never waits for the disk. */
enum kd_link_left kd_link_budget(struct kd_link_budgets *all, const struct kd_link *link, uint64_t now_s);
/* Adds device time that the link has used, and writes it to the file without waiting for the disk. The data survive
 * any end of the server, but not a crash of the system. Must not run on the HTTP thread. */
void kd_link_charge(struct kd_link_budgets *all, const struct kd_link *link, double ms, uint64_t now_s);

#endif
