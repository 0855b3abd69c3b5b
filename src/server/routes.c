/* The table of routes that http/route.h declares. */
#include "base/json.h"
#include "render/output/format.h"
#include "server/http/query.h"
#include "server/http/route.h"
#include "server/openapi/strict.h"
#include "server/playground/sessions.h"

#define JSON KD_JSON_TYPE
#define QUERIES(...) \
    (const struct kd_query[]) { __VA_ARGS__, { 0 } }

#define NATURAL "{\"type\":\"integer\",\"minimum\":0,\"maximum\":999999999999999999}" /* range of kd_target_number */
#define PART "{\"type\":\"number\",\"minimum\":" KD_SCHEMA_DIGITS(KD_MIN_SCALE_MIN) ",\"maximum\":1}"
#define PACE_MS \
    "{\"type\":\"number\",\"minimum\":" KD_SCHEMA_DIGITS(KD_MAX_FRAME_MS_MIN) ",\"maximum\":" KD_SCHEMA_DIGITS( \
        KD_MAX_FRAME_MS_MAX) "}"
#define ORDER \
    "order", "{\"type\":\"integer\",\"minimum\":1,\"maximum\":" KD_SCHEMA_DIGITS(KD_ORDER_MAX) "}", \
        "order of concurrent patches: the highest number counts, and a patch that arrives after a higher one has no " \
        "effect"
#define MIN_SCALE \
    "min_scale", PART, "smallest width of a frame while the scene changes, as a fraction of image.width; default 0.25"
#define MAX_FRAME_MS \
    "max_frame_ms", PACE_MS, "limit of a frame's time in ms: frames that take longer are made narrower than min_scale"
#define MOMENT "{\"type\":\"integer\",\"minimum\":0,\"maximum\":" KD_SCHEMA_DIGITS(KD_WAIT_MS_MAX) "}"

#define ROOM(least, most) \
    "{\"type\":\"integer\",\"minimum\":" KD_SCHEMA_DIGITS(least) ",\"maximum\":" KD_SCHEMA_DIGITS(most) "}"

#define FRAME \
    "Kerrd-Frame Kerrd-Revision Kerrd-Time Kerrd-Azimuth Kerrd-Accuracy Kerrd-Clock Kerrd-Flux Kerrd-Sentences " \
    "Kerrd-Approximations Kerrd-Quality Server-Timing Kerrd-Waited Kerrd-Patched"
#define SAME "Kerrd-Scene-Hash Kerrd-Approximations Kerrd-Clock"
#define PICTURE_HEADERS SAME " Content-Disposition"

_Static_assert(KD_PLAYGROUND_DEBRIS_MAX == 1000000 && KD_PLAY_DEBRIS == 20000, "the row of at_most says so");

#define ROUTE(handler, ...) { .handle = handler, .path = __VA_ARGS__ },
const struct kd_route kd_routes[] = {
#include "server/http/routes.def"
};
const size_t kd_n_routes = sizeof kd_routes / sizeof *kd_routes;
