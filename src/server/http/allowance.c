#include "server/http/allowance.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#define MINUTE_S 60.0

static double most_ms(const struct kd_allowance *all) { return 1e3 * all->seconds; }

static double now_in(const struct kd_allowance *all, const struct kd_allowance_place *place, double now_ms)
{
    const double filled = all->seconds / MINUTE_S * fmax(now_ms - place->at_ms, 0);
    return place->at_ms > 0 ? fmin(place->ms + filled, most_ms(all)) : most_ms(all);
}

static size_t find(const struct kd_allowance *all, const char *client)
{
    size_t i = 0;
    while (i < KD_ALLOWANCE_CLIENTS && (!(all->places[i].at_ms > 0) || strcmp(all->places[i].client, client)))
        i++;
    return i;
}

/* Finds the client's bucket, or makes one. If there is no free place, a new client gets the place of the fullest
 * bucket, whose client has used the least. */
static struct kd_allowance_place *place_of(struct kd_allowance *all, const char *client, double now_ms)
{
    const size_t known = find(all, client);
    if (known < KD_ALLOWANCE_CLIENTS)
        return &all->places[known];
    struct kd_allowance_place *fullest = &all->places[0];
    for (size_t i = 1; i < KD_ALLOWANCE_CLIENTS; i++)
        if (now_in(all, &all->places[i], now_ms) > now_in(all, fullest, now_ms))
            fullest = &all->places[i];
    *fullest = (struct kd_allowance_place) { .ms = most_ms(all), .at_ms = now_ms };
    snprintf(fullest->client, sizeof fullest->client, "%s", client);
    return fullest;
}

double kd_allowance_left_ms(const struct kd_allowance *all, const char *client, double now_ms)
{
    if (!all->seconds || !*client)
        return INFINITY;
    const size_t i = find(all, client);
    return i < KD_ALLOWANCE_CLIENTS ? now_in(all, &all->places[i], now_ms) : most_ms(all);
}

void kd_allowance_charge(struct kd_allowance *all, const char *client, double ms, double now_ms)
{
    if (!all->seconds || !*client)
        return;
    struct kd_allowance_place *place = place_of(all, client, now_ms);
    place->ms = now_in(all, place, now_ms) - ms;
    place->at_ms = now_ms;
}

double kd_allowance_wait_ms(const struct kd_allowance *all, const char *client, double owed_ms, double now_ms)
{
    const double left = kd_allowance_left_ms(all, client, now_ms) - owed_ms;
    return left > 0 ? 0 : (1 - left) * MINUTE_S / all->seconds; /* time in ms until the bucket contains 1 ms */
}

struct kd_quota kd_allowance_quota(const struct kd_allowance *all, const char *client, double owed_ms, double now_ms)
{
    const double left_ms = fmin(kd_allowance_left_ms(all, client, now_ms) - owed_ms, most_ms(all)),
                 whole_in_s = 1e-3 * (most_ms(all) - left_ms) * MINUTE_S / all->seconds;
    return (struct kd_quota) { all->seconds, left_ms > 0 ? (unsigned)(1e-3 * left_ms) : 0,
                               (unsigned)ceil(fmin(whole_in_s, 1e6)) };
}

bool kd_allowance_may(const struct kd_allowance *all, const char *client, bool patient, double now_ms)
{
    return kd_allowance_left_ms(all, client, now_ms) > (patient ? most_ms(all) / 2 : 0);
}
