#include "playground/params.h"

#include "playground/body.h"

#define AT(name) offsetof(struct kd_playground_params, name)
#define REAL(n, value, low, high, h) \
    { .name = #n, \
      .kind = KD_KIND_REAL, \
      .offset = AT(n), \
      .initial = value, \
      .least = low, \
      .most = high, \
      .help = h, \
      .fixed = AT(n) >= AT(spin) && AT(n) < AT(spin) + sizeof(struct kd_hole_given) }, /* hole rows are adjacent */
#define INT(n, value, low, high, h) \
    { .name = #n, .kind = KD_KIND_INT, .offset = AT(n), .initial = value, .least = low, .most = high, .help = h },
#define BOOL(n, value, h) { .name = #n, .kind = KD_KIND_BOOL, .offset = AT(n), .initial = value, .help = h },
#define WORD(n, value, w, h) \
    { .name = #n, \
      .kind = KD_KIND_WORD, \
      .offset = AT(n), \
      .initial = value, \
      .words = w, \
      .help = h, \
      .fixed = AT(n) == AT(gravity) },
static const struct kd_row settings[] = { KD_PLAYGROUND_SETTINGS(REAL, INT, BOOL, WORD) };
#undef AT
const struct kd_document kd_playground_settings = { .rows = settings, .n = sizeof settings / sizeof *settings };

#define AT(name) offsetof(struct kd_playground_body, name)
static const struct kd_row body_fields[] = {
    { .name = "mass",
      .kind = KD_KIND_REAL,
      .offset = AT(mass),
      .initial = 1e-6,
      .most = 1e12,
      .above_0 = KD_PLAYGROUND_LEAST,
      .help = "mass in units of the hole's mass, at least 1e-30; 0: a test body that attracts nothing" },
    { .name = "radius",
      .kind = KD_KIND_REAL,
      .offset = AT(radius),
      .most = 1e6,
      .above_0 = KD_PLAYGROUND_LEAST,
      .help = "radius in M, at least 1e-30; 0: a point without collisions and tides" },
    { .name = "temperature_k",
      .kind = KD_KIND_REAL,
      .offset = AT(temperature_k),
      .initial = 5800,
      .most = 1e10,
      .help = "temperature of the surface in K; 0: dark" },
};
#undef AT
const struct kd_document kd_playground_body_fields = { .rows = body_fields,
                                                       .n = sizeof body_fields / sizeof *body_fields };

struct kd_playground_params kd_playground_defaults(void)
{
    struct kd_playground_params params = { 0 };
    kd_document_defaults(&kd_playground_settings, &params);
    return params;
}
