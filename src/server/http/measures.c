#include "server/http/measures.h"

#include <stdio.h>
#include <stdlib.h>

/* Number of classes of statuses, by first digit. Class 0: the connection was cut before a status was sent. */
#define CLASSES 6

struct kd_measures {
    size_t n; /* number of routes, plus one entry for requests without a route */
    /* histograms of each route; the last row is that of requests without a route */
    struct kd_histogram histograms[][CLASSES];
};

struct kd_measures *kd_measures_create(void)
{
    const size_t n = kd_n_routes + 1;
    struct kd_measures *measures = calloc(1, sizeof *measures + n * sizeof *measures->histograms);
    if (measures)
        measures->n = n;
    return measures;
}

void kd_measures_destroy(struct kd_measures *measures) { free(measures); }

void kd_measures_add(struct kd_measures *measures, const struct kd_route *route, unsigned status, double ms)
{
    kd_histogram_add(&measures->histograms[route ? (size_t)(route - kd_routes) : kd_n_routes][status / 100 % CLASSES],
                     ms);
}

const char *kd_measures_route(const struct kd_route *route) { return route ? route->path : "none"; }

enum kd_status kd_measures_write(const struct kd_measures *measures, struct kd_buffer *out)
{
    static const char name[] = "kerrd_request_seconds";
    enum kd_status status;
    KD_TRY(kd_histogram_head(
        out, name,
        "From the first line of a request to the last byte of its answer; a stream lasts as long as it is watched."));
    for (size_t i = 0; i < measures->n; i++)
        for (unsigned k = 0; k < CLASSES; k++) {
            const struct kd_histogram *one = &measures->histograms[i][k];
            char labels[160], class[8] = "none";
            if (kd_histogram_is_empty(one))
                continue;
            if (k)
                snprintf(class, sizeof class, "%uxx", k);
            snprintf(labels, sizeof labels, "route=\"%s\",status=\"%s\"",
                     kd_measures_route(i < kd_n_routes ? &kd_routes[i] : NULL), class);
            KD_TRY(kd_histogram_write(one, out, name, labels));
        }
done:
    return status;
}
