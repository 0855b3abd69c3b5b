/* The accuracy table: cost and error of each engine, precision and number of steps on one device. `kerrd bench
 * accuracy` measures it, GET /v1/accuracy serves it, and accuracy.tolerance is looked up in it. Plain values; any
 * thread.
 *
 * An engine's errors are the differences between its results (render/rays/rays.h) and those of KD_ENGINE_CLOSED, on
 * named sets of rays (render/accuracy/sets.h). The statistics cover the crossings of all orders that both methods find
 * between the ISCO and KD_ACCURACY_FAR. Errors of r and g are relative. Errors of phi (radians) and delay (M) are
 * absolute. `differ` counts the rays whose fate or number of crossings differs from the closed form's. */
#ifndef KD_RENDER_ACCURACY_TABLE_H
#define KD_RENDER_ACCURACY_TABLE_H

#include "base/buffer.h"
#include "render/accuracy/sets.h"
#include "render/accuracy/engine.h"

#define KD_ACCURACY_ORDERS 3
/* Radius in M. Crossings further out are not compared: w = 1/r has an absolute error, so the relative error of r
 * grows with r. */
#define KD_ACCURACY_FAR 1e3
#define KD_ACCURACY_ROWS 64
/* The tolerance that a row meets is the larger of two errors. One is the 99th percentile over the crossings of the
 * bulk set. The other is the largest of the medians of the other sets. These sets count because an engine with few
 * steps loses more accuracy edge-on. The near-critical set does not count, because more steps do not help near the
 * critical curve. The table determines only the first setting. In a list of rays, each ray whose own error exceeds
 * the tolerance is then traced again (rays/hold.h). */
/* A row meets no tolerance if, in one of the sets that count, more than this fraction of the rays differ. */
#define KD_ACCURACY_STRAY 0.01

enum kd_accuracy_quantity { KD_ACCURACY_R, KD_ACCURACY_PHI, KD_ACCURACY_DELAY, KD_ACCURACY_G, KD_ACCURACY_QUANTITIES };
extern const char *const kd_accuracy_quantity_names[KD_ACCURACY_QUANTITIES]; /* "r", "phi", "delay", "g" */

struct kd_accuracy_errors { double median, p99, worst; }; /* NaN: the engine does not compute this quantity */

struct kd_accuracy_entry {
    double rays_per_s; /* rays per second, timed by the device's clock, or by the host's clock if the device has none */
    uint32_t rays, crossings, differ;
    struct kd_accuracy_errors of[KD_ACCURACY_QUANTITIES];
};

struct kd_accuracy_row {
    enum kd_engine engine; /* the row of KD_ENGINE_CLOSED has no errors, only a speed on one core of the host */
    enum kd_precision precision;
    uint32_t steps;
    struct kd_accuracy_entry sets[KD_ACCURACY_SETS];
};

struct kd_accuracy_table {
    char version[32], date[32]; /* version of kerrd; date in UTC, ISO 8601 */
    char command[256];
    char machine[256], device[800]; /* machine: processor and system; device: the Vulkan device with its driver */
    /* description of the tests that were skipped because of this device's limits; "" if there were none */
    char skipped[400];
    uint32_t cores; /* number of cores that the device computes on; 0 if it is not a CPU */
    bool device_clock, quick;
    /* requested device time of one speed measurement; a fast device needs less, because the rays are limited */
    double seconds;
    uint32_t n;
    struct kd_accuracy_row rows[KD_ACCURACY_ROWS];
};

struct kd_accuracy_choice {
    enum kd_engine engine;
    enum kd_precision precision;
    uint32_t steps;
    double error, rays_per_s; /* error: the tolerance that the row meets; rays_per_s: speed on the bulk set */
};

/* The tolerance that a row meets; INFINITY if none. */
double kd_accuracy_holds(const struct kd_accuracy_row *row);

/* Finds the fastest row that is within the limits (NULL: any row) and whose relative error of the crossing radius is
 * small enough. If there is no such row, returns KD_EINVAL at "/accuracy/tolerance"; the message states the best
 * error that this device can meet. */
struct kd_accuracy_limits { int engine, precision; /* -1: any */ };
enum kd_status kd_accuracy_choose(const struct kd_accuracy_table *table, double tolerance,
                                  const struct kd_accuracy_limits *limits, struct kd_accuracy_choice *out,
                                  struct kd_error *error);

/* The table used for tolerances until the device has a table of its own. It was measured on llvmpipe and comes from
 * bench/results. The errors in it are about right for any device, the speeds are not. Any thread; never freed; NULL
 * if out of memory. */
const struct kd_accuracy_table *kd_accuracy_built_in(void);

/* kd_accuracy_to_json appends the document of GET /v1/accuracy. kd_accuracy_from_json reads it back, and returns
 * KD_EINVAL for any other text. */
enum kd_status kd_accuracy_to_json(const struct kd_accuracy_table *table, struct kd_buffer *out);
enum kd_status kd_accuracy_from_json(const char *text, size_t length, struct kd_accuracy_table *out,
                                     struct kd_error *error);

/* Writes Markdown: the machine, then one table for each set. */
enum kd_status kd_accuracy_to_markdown(const struct kd_accuracy_table *table, struct kd_buffer *out);

#endif
