/* Rate limit of device time: a token bucket for each client (--client-device-seconds). The bucket fills at a constant
 * rate and holds at most a minute's worth. Work that a client has done is charged to its bucket, which may go into
 * debt; the client then waits until the debt is paid. Pure: the caller supplies the time. One thread at a time. */
#ifndef KD_SERVER_HTTP_ALLOWANCE_H
#define KD_SERVER_HTTP_ALLOWANCE_H

#include "server/http/shares.h"

#define KD_ALLOWANCE_CLIENTS \
    256u /* with a bucket that is not full, told apart at once; one more is given the place of the one that is fullest \
          */

struct kd_allowance {
    unsigned seconds; /* of the device's time that a client may use in a minute; 0: as much as it likes. The rest is 0
                         to begin with */
    struct kd_allowance_place {
        char client[KD_CLIENT];
        double ms, at_ms; /* what the bucket held, and when; as full as may be where at_ms is 0 */
    } places[KD_ALLOWANCE_CLIENTS];
};

/* What the bucket holds, in ms of the device's time; below 0 it is owed. INFINITY without a limit, and for "":
 * nobody's, as jobs are that go on after a restart. */
double kd_allowance_left_ms(const struct kd_allowance *all, const char *client, double now_ms);
/* Takes what work of a client has used. */
void kd_allowance_charge(struct kd_allowance *all, const char *client, double ms, double now_ms);
/* In how many ms there is something in the bucket once so much more has been taken out of it; 0: there is now. */
double kd_allowance_wait_ms(const struct kd_allowance *all, const char *client, double owed_ms, double now_ms);
/* For people: what a client may use in a minute, what is left of that once so much more has been taken out, and when
 * all is there again; in seconds. Where there is a limit. */
struct kd_quota { unsigned seconds, left_s, whole_in_s; };
struct kd_quota kd_allowance_quota(const struct kd_allowance *all, const char *client, double owed_ms, double now_ms);
/* Whether work that waits may go on. patient: nobody sits before it, and it leaves half of the bucket to what
 * somebody asks for. */
bool kd_allowance_may(const struct kd_allowance *all, const char *client, bool patient, double now_ms);

#endif
