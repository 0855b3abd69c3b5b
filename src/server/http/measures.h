/* Durations of requests for /metrics, by route and by first digit of the status. The number of series depends only
 * on the number of routes, so that clients cannot increase it. Any thread. */
#ifndef KD_SERVER_HTTP_MEASURES_H
#define KD_SERVER_HTTP_MEASURES_H

#include "server/http/histogram.h"
#include "server/http/route.h"

struct kd_measures;

struct kd_measures *kd_measures_create(void);           /* NULL: no memory */
void kd_measures_destroy(struct kd_measures *measures); /* accepts NULL */

/* Adds the duration of a finished request. status 0: the connection was cut before an answer. route NULL: no route has
 * the path. */
void kd_measures_add(struct kd_measures *measures, const struct kd_route *route, unsigned status, double ms);
/* Writes the metric kerrd_request_seconds. Combinations that have occurred in no request are left out. */
enum kd_status kd_measures_write(const struct kd_measures *measures, struct kd_buffer *out);

/* Label of a route in /metrics and in the log: the path of the route, or "none" for NULL. */
const char *kd_measures_route(const struct kd_route *route);

#endif
