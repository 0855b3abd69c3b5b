/* Durations of requests for /metrics, by route and first digit of the status. The number of series is bounded by the
 * number of routes, whatever clients ask for. Any thread. */
#ifndef KD_SERVER_HTTP_MEASURES_H
#define KD_SERVER_HTTP_MEASURES_H

#include "server/http/histogram.h"
#include "server/http/route.h"

struct kd_measures;

struct kd_measures *kd_measures_create(void);           /* NULL: no memory */
void kd_measures_destroy(struct kd_measures *measures); /* accepts NULL */

/* A request has been answered, or cut off before that: status 0. route NULL: its path leads nowhere. */
void kd_measures_add(struct kd_measures *measures, const struct kd_route *route, unsigned status, double ms);
/* kerrd_request_seconds: those that have happened. */
enum kd_status kd_measures_write(const struct kd_measures *measures, struct kd_buffer *out);

/* A route's path, and "none" for NULL: what /metrics and the log call it. */
const char *kd_measures_route(const struct kd_route *route);

#endif
