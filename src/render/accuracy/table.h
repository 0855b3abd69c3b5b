/* The accuracy table: what each engine, precision and number of steps costs on one device, and its error. `kerrd bench
 * accuracy` measures it, GET /v1/accuracy serves it, and accuracy.tolerance is looked up in it. Plain values; any
 * thread.
 *
 * Errors are those of render/rays/rays.h against KD_ENGINE_CLOSED on named sets of rays (render/accuracy/sets.h), all
 * orders together, over the crossings that both have from the ISCO to KD_ACCURACY_FAR: relative for r and g, absolute
 * for phi (radians) and delay (M). A ray with another fate or another number of crossings is counted in `differ`. */
#ifndef KD_RENDER_ACCURACY_TABLE_H
#define KD_RENDER_ACCURACY_TABLE_H

#include "base/buffer.h"
#include "render/accuracy/sets.h"
#include "render/accuracy/engine.h"

#define KD_ACCURACY_ORDERS 3
#define KD_ACCURACY_FAR 1e3 /* M: w = 1/r is what is computed, its error absolute, so that of r grows as r */
#define KD_ACCURACY_ROWS 64
/* What a row is said to hold: what 99 % of the crossings of the bulk set are within, or the median of any other set
 * if that is larger: few steps lose more edge-on. Near the critical curve no number of steps helps, so that set is
 * left out. It is the first choice only: of a list of rays, those that are beyond a tolerance by their own error are
 * followed again (rays/hold.h). */
#define KD_ACCURACY_STRAY 0.01 /* a row of which more rays than this differ in one of these sets holds nothing */

enum kd_accuracy_quantity { KD_ACCURACY_R, KD_ACCURACY_PHI, KD_ACCURACY_DELAY, KD_ACCURACY_G, KD_ACCURACY_QUANTITIES };
extern const char *const kd_accuracy_quantity_names[KD_ACCURACY_QUANTITIES]; /* "r", "phi", "delay", "g" */

struct kd_accuracy_errors { double median, p99, worst; }; /* NaN: the engine has no such quantity */

struct kd_accuracy_entry {
    double rays_per_s; /* by the device's clock, or the host's where it has none */
    uint32_t rays, crossings, differ;
    struct kd_accuracy_errors of[KD_ACCURACY_QUANTITIES];
};

struct kd_accuracy_row {
    enum kd_engine engine; /* KD_ENGINE_CLOSED: its speed alone, on one core of the host */
    enum kd_precision precision;
    uint32_t steps;
    struct kd_accuracy_entry sets[KD_ACCURACY_SETS];
};

struct kd_accuracy_table {
    char version[32], date[32]; /* of kerrd; UTC, ISO 8601 */
    char command[256];
    char machine[256], device[800]; /* the processor and system; the Vulkan device with its driver */
    char skipped[400];              /* what this device cannot do, "" if it can do all */
    uint32_t cores;                 /* that the device computes on, 0 where it is no CPU */
    bool device_clock, quick;
    double seconds; /* the device time over which a speed was measured; less where a million rays take less */
    uint32_t n;
    struct kd_accuracy_row rows[KD_ACCURACY_ROWS];
};

struct kd_accuracy_choice {
    enum kd_engine engine;
    enum kd_precision precision;
    uint32_t steps;
    double error, rays_per_s; /* what it holds; speed over the bulk */
};

/* The tolerance that a row is chosen for; INFINITY if none. */
double kd_accuracy_holds(const struct kd_accuracy_row *row);

/* The fastest row within the limits (NULL: all) that holds a relative error of the crossing radius. KD_EINVAL at
 * "/accuracy/tolerance", saying what this device can hold, if none does. */
struct kd_accuracy_limits { int engine, precision; /* -1: any */ };
enum kd_status kd_accuracy_choose(const struct kd_accuracy_table *table, double tolerance,
                                  const struct kd_accuracy_limits *limits, struct kd_accuracy_choice *out,
                                  struct kd_error *error);

/* The table that a tolerance is looked up in until this device has its own: of llvmpipe, from bench/results. Errors
 * are much the same everywhere, speeds are not. Any thread; never freed; NULL if memory is short. */
const struct kd_accuracy_table *kd_accuracy_built_in(void);

/* The document of GET /v1/accuracy, appended, and back: KD_EINVAL for text that is no such document. */
enum kd_status kd_accuracy_to_json(const struct kd_accuracy_table *table, struct kd_buffer *out);
enum kd_status kd_accuracy_from_json(const char *text, size_t length, struct kd_accuracy_table *out,
                                     struct kd_error *error);

/* Markdown: the machine, then a table a set. */
enum kd_status kd_accuracy_to_markdown(const struct kd_accuracy_table *table, struct kd_buffer *out);

#endif
