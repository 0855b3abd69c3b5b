/* Rate limit of device time, with a token bucket for each client (--client-device-seconds). The bucket fills at a
 * constant rate, and holds at most the amount of one minute. Device time that a client has used is subtracted. If
 * the bucket becomes negative, the client waits until it is positive again. Pure: the caller supplies the time. One
 * thread at a time. */
#ifndef KD_SERVER_HTTP_ALLOWANCE_H
#define KD_SERVER_HTTP_ALLOWANCE_H

#include "server/http/shares.h"

/* number of buckets that are stored. A full bucket needs no place. If there is no free place, the fullest bucket is
 * dropped. */
#define KD_ALLOWANCE_CLIENTS 256u

struct kd_allowance {
    /* device time in seconds that a client may use in a minute */
    unsigned seconds;
    struct kd_allowance_place {
        char client[KD_CLIENT];
        double ms, at_ms; /* content of the bucket, in ms, at the time at_ms; at_ms 0: the bucket is full */
    } places[KD_ALLOWANCE_CLIENTS];
};

/* Content of the client's bucket in ms of device time; negative: debt. INFINITY if there is no limit, and for the
 * client "", which owns the jobs that continue after a restart. */
double kd_allowance_left_ms(const struct kd_allowance *all, const char *client, double now_ms);
/* Subtracts device time that a client's work has used. */
void kd_allowance_charge(struct kd_allowance *all, const char *client, double ms, double now_ms);
/* Number of milliseconds until the bucket contains at least 1 ms, if owed_ms is subtracted as well; 0 if the bucket
 * contains that much now. */
double kd_allowance_wait_ms(const struct kd_allowance *all, const char *client, double owed_ms, double now_ms);
/* Quota for display and headers, in seconds. seconds: device time that a client may use in a minute. left_s: what is
 * left of it after owed_ms is subtracted. whole_in_s: time until the bucket is full. Valid only if there is a limit. */
struct kd_quota { unsigned seconds, left_s, whole_in_s; };
struct kd_quota kd_allowance_quota(const struct kd_allowance *all, const char *client, double owed_ms, double now_ms);
/* True if waiting work of a client may run. patient: true for background work, which runs only while the bucket is
 * more than half full. The lower half is reserved for the client's interactive requests. */
bool kd_allowance_may(const struct kd_allowance *all, const char *client, bool patient, double now_ms);

#endif
