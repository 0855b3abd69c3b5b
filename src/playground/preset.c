#include "playground/preset.h"

#include "base/random.h"
#include "playground/hole.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static enum kd_status add(struct kd_playground *p, const char *name, struct kd_playground_body body,
                          struct kd_error *error)
{
    snprintf(body.name, sizeof body.name, "%s", name);
    return kd_playground_add(p, &body, NULL, error);
}

/* A body on a circular orbit of radius r at the phase phi. The plane of the orbit is inclined about the line of nodes,
 * whose azimuth is `node`. */
static struct kd_playground_body circling(double r, double phi, double inclination, double node)
{
    const double v = kd_playground_circular(r), c = cos(inclination), s = sin(inclination);
    const double x[3] = { r * cos(phi), r * sin(phi) * c, r * sin(phi) * s },
                 u[3] = { -v * sin(phi), v * cos(phi) * c, v * cos(phi) * s };
    return (struct kd_playground_body) {
        .x = { cos(node) * x[0] - sin(node) * x[1], sin(node) * x[0] + cos(node) * x[1], x[2] },
        .v = { cos(node) * u[0] - sin(node) * u[1], sin(node) * u[0] + cos(node) * u[1], u[2] },
    };
}

/* A body on a parabolic orbit, at the distance r. The pericentre is the tidal radius divided by 1.2. */
static struct kd_playground_body passing(double mass, double radius, double temperature_k, double r)
{
    const double pericentre = radius * cbrt(1 / mass) / 1.2, l = pericentre * sqrt(2 / (pericentre - 2)),
                 across = l / r;
    return (struct kd_playground_body) { .mass = mass,
                                         .radius = radius,
                                         .temperature_k = temperature_k,
                                         .x = { r, 0, 0 },
                                         .v = { -sqrt(2 / (r - 2) - across * across), across, 0 } };
}

/* Settings for the Sun and a hole of a million solar masses. The tidal radius is 47 M. */
static void disruption_settings(struct kd_playground_params *s)
{
    s->h_max = 5; /* gives twenty pictures a second if time runs at 100 M a second */
    s->debris_per_body = 50000;
}

static enum kd_status disruption(struct kd_playground *p, struct kd_error *error)
{
    return add(p, "star", passing(1e-6, 0.47, 5800, 300), error);
}

/* Settings for a white dwarf of one solar mass and 5500 km radius, and a hole of a thousand solar masses. The parabola
 * is as deep as that of the sun-like star above. The tidal radius is 37 M. The most tightly bound debris comes back
 * after 16 000 M, which is 78 s. */
static void dwarf_settings(struct kd_playground_params *s)
{
    s->h_max = 5;
    s->debris_per_body = 50000;
}

static enum kd_status dwarf(struct kd_playground *p, struct kd_error *error)
{
    return add(p, "white dwarf", passing(1e-3, 3.7, 20000, 150), error);
}

static void system_settings(struct kd_playground_params *s)
{
    s->h_max = 5;
    s->softening = 0.01;
}

static enum kd_status planets(struct kd_playground *p, struct kd_error *error)
{
    static const struct {
        const char *name;
        double mass, radius, temperature_k, r, phi, inclination;
    } list[] = {
        { "first", 1e-6, 0.03, 9000, 14, 0.3, 0.05 }, { "second", 1e-5, 0.12, 6500, 24, 2.1, 0.12 },
        { "third", 3e-5, 0.25, 5200, 38, 4.0, 0.08 }, { "fourth", 1e-4, 0.4, 4300, 60, 5.5, 0.2 },
        { "fifth", 1e-3, 1, 3500, 100, 1.2, 0.15 },
    };
    enum kd_status status = KD_OK;
    struct kd_playground_body body = { 0 };
    for (size_t i = 0; !status && i < sizeof list / sizeof *list; i++) {
        body = circling(list[i].r, list[i].phi, list[i].inclination, 0.7 * (double)i);
        body.mass = list[i].mass;
        body.radius = list[i].radius;
        body.temperature_k = list[i].temperature_k;
        status = add(p, list[i].name, body, error);
    }
    if (status)
        return status;
    /* A moon of the planet that was added last. Its speed is that of a circular orbit in the softened field. */
    const double d = 3, e2 = p->params.softening * p->params.softening, v = d * sqrt(body.mass / pow(d * d + e2, 1.5));
    const double out = kd_playground_radius(body.x), speed = kd_playground_radius(body.v);
    struct kd_playground_body moon = { .mass = 1e-7, .radius = 0.1, .temperature_k = 2500 };
    for (int k = 0; k < 3; k++) {
        moon.x[k] = body.x[k] * (1 + d / out);
        moon.v[k] = body.v[k] * (1 + v / speed);
    }
    return add(p, "moon", moon, error);
}

static void binary_settings(struct kd_playground_params *s)
{
    s->h_max = 5;
    s->softening = 0.01;
    s->waves = true;
    s->amplification = 1000;
    s->tides = false;
}

/* Two dark bodies of mass 0.01, 5 M apart, in free fall from rest at 1000 M from the hole. They meet long before
 * they have fallen far. */
static enum kd_status binary(struct kd_playground *p, struct kd_error *error)
{
    const double mass = 0.01, d = 5, v = 0.5 * sqrt(2 * mass / d);
    enum kd_status status =
        add(p, "one",
            (struct kd_playground_body) {
                .mass = mass, .radius = 0.2, .temperature_k = 20000, .x = { 1000, d / 2, 0 }, .v = { v, 0, 0 } },
            error);
    return status ? status
                  : add(p, "other",
                        (struct kd_playground_body) { .mass = mass,
                                                      .radius = 0.2,
                                                      .temperature_k = 12000,
                                                      .x = { 1000, -d / 2, 0 },
                                                      .v = { -v, 0, 0 } },
                        error);
}

static void emri_settings(struct kd_playground_params *s)
{
    s->waves = true;
    s->amplification = 20;
    s->tides = false;
}

static enum kd_status emri(struct kd_playground *p, struct kd_error *error)
{
    struct kd_playground_body body = circling(12, 0, 0, 0);
    body.mass = 1e-3;
    body.radius =
        /* large enough to be visible; the radius has no other effect, because the bodies touch nothing and tides
         * are off */
        0.3;
    body.temperature_k = 12000;
    return add(p, "companion", body, error);
}

static void swarm_settings(struct kd_playground_params *s)
{
    s->softening = 0.2;
    s->mergers = false;
    s->tides = false;
    s->h_max = 2;
}

static enum kd_status swarm(struct kd_playground *p, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    uint64_t *n = &p->random;
    for (int i = 0; !status && i < 400; i++) {
        /* drawn one by one, because C does not specify the order in which arguments of a call are evaluated */
        double drawn[5];
        for (int k = 0; k < 5; k++)
            drawn[k] = kd_random_drawn(p->params.seed, n);
        struct kd_playground_body body =
            circling(20 * pow(5, drawn[0]), 2 * M_PI * drawn[1], 0.3 * drawn[2], 2 * M_PI * drawn[3]);
        char name[KD_PLAYGROUND_NAME];
        snprintf(name, sizeof name, "swarm %d", i + 1);
        body.mass = 1e-7;
        body.radius = 0.1;
        body.temperature_k = 3000 + 9000 * drawn[4];
        status = add(p, name, body, error);
    }
    return status;
}

static void eight_settings(struct kd_playground_params *s)
{
    s->h_max = 100;
    s->tides = false;
    s->softening = 0.001;
}

/* The figure-eight orbit: A. Chenciner & R. Montgomery 2000, Ann. Math. 152, 881; initial values by C. Simo. It is
 * scaled to masses m = 0.1 and a length of 100 M. It is at rest 1e5 M from the hole, whose tide there is 1e-8 of the
 * bodies' mutual attraction. */
static enum kd_status eight(struct kd_playground *p, struct kd_error *error)
{
    static const double x[3][2] = { { 0.97000436, -0.24308753 }, { -0.97000436, 0.24308753 }, { 0, 0 } };
    static const double v3[2] = { -0.93240737, -0.86473146 };
    const double mass = 0.1, length = 100, speed = sqrt(mass / length);
    static const char *const names[3] = { "one", "two", "three" };
    enum kd_status status = KD_OK;
    for (int i = 0; !status && i < 3; i++) {
        const double share = i == 2 ? 1 : -0.5;
        status = add(p, names[i],
                     (struct kd_playground_body) { .mass = mass,
                                                   .radius = 2,
                                                   .temperature_k = 4000 + 3000 * i,
                                                   .x = { 1e5 + length * x[i][0], length * x[i][1], 0 },
                                                   .v = { share * speed * v3[0], share * speed * v3[1], 0 } },
                     error);
    }
    return status;
}

const struct kd_playground_preset kd_playground_presets[] = {
    { "disruption",
      "A star on a pass so close that the tide tears it apart",
      100,
      { 0 },
      330,
      disruption_settings,
      disruption,
      "{\"spacetime\":{\"spin\":0},\"camera\":{\"inclination_deg\":60,\"field_m\":180},\"disk\":{\"outer\":22}}" },
    { "white-dwarf",
      "A white dwarf torn apart by a hole of a thousand suns: its debris comes back within a minute",
      300,
      { 0 },
      330,
      dwarf_settings,
      dwarf,
      "{\"spacetime\":{\"spin\":0},\"camera\":{\"inclination_deg\":30,\"field_m\":640,\"centre_beta\":-80},\"disk\":{"
      "\"outer\":20}}" },
    { "system",
      "Five planets round the hole, and a moon",
      100,
      { 0 },
      120,
      system_settings,
      planets,
      "{\"spacetime\":{\"spin\":0},\"camera\":{\"inclination_deg\":75,\"field_m\":90},\"disk\":{\"outer\":11}}" },
    { "binary",
      "Two bodies that spiral into each other; their loss to waves is exaggerated a thousand times",
      200,
      { 1000 },
      6,
      binary_settings,
      binary,
      "{\"spacetime\":{\"spin\":0},\"camera\":{\"inclination_deg\":20,\"field_m\":14,\"centre_beta\":-939},\"disk\":{"
      "\"outer\":20}}" },
    { "emri",
      "A light body that spirals into the hole; its loss to waves is exaggerated twenty times",
      400,
      { 0 },
      16,
      emri_settings,
      emri,
      "{\"spacetime\":{\"spin\":0},\"camera\":{\"inclination_deg\":75,\"field_m\":40},\"disk\":{\"model\":\"none\"}}" },
    { "swarm",
      "Four hundred bodies round the hole",
      100,
      { 0 },
      120,
      swarm_settings,
      swarm,
      "{\"spacetime\":{\"spin\":0},\"camera\":{\"inclination_deg\":75,\"field_m\":120},\"disk\":{\"outer\":18}}" },
    { "figure-eight",
      "Three bodies that follow one another along a figure of eight, far from the hole",
      3000,
      { 1e5 },
      130,
      eight_settings,
      eight,
      "{\"spacetime\":{\"spin\":0},\"camera\":{\"inclination_deg\":10,\"field_m\":400,\"centre_beta\":-98480.775},"
      "\"disk\":{\"outer\":20}}" },
};
const size_t kd_playground_n_presets = sizeof kd_playground_presets / sizeof *kd_playground_presets;

const struct kd_playground_preset *kd_playground_preset_of(const char *name)
{
    for (size_t i = 0; i < kd_playground_n_presets; i++)
        if (!strcmp(kd_playground_presets[i].name, name))
            return &kd_playground_presets[i];
    return NULL;
}
