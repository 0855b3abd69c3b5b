#include "render/accuracy/engine.h"

#include "render/accuracy/table.h"

enum { PROFILES = KD_PROFILE_REFERENCE + 1 };

/* Default number of steps of each engine. docs/accuracy.md lists the errors of the engines. */
static const struct {
    const char *name;
    uint32_t steps[2]; /* number of steps for each precision, if the request names neither steps nor a profile */
    /* number of steps for each precision and each profile: draft, interactive, balanced, high, reference */
    uint32_t profile[2][PROFILES];
} engines[KD_ENGINE_COUNT] = {
    [KD_ENGINE_CLOSED] = { .name = "closed" },
    [KD_ENGINE_MINO_RKN4] = { "mino-rkn4", { 32, 256 }, { { 8, 8, 16, 32, 32 }, { 8, 16, 64, 128, 512 } } },
    [KD_ENGINE_MINO_RKN6] = { "mino-rkn6", { 16, 64 }, { { 4, 4, 8, 16, 16 }, { 4, 8, 16, 32, 64 } } },
    [KD_ENGINE_KS_EULER] = { "ks-euler", { 64, 64 }, { { 32, 64, 128, 256, 256 }, { 32, 64, 128, 256, 1024 } } },
    [KD_ENGINE_KS_RK4] = { "ks-rk4", { 64, 64 }, { { 8, 16, 32, 32, 32 }, { 8, 16, 32, 64, 256 } } },
    [KD_ENGINE_KS_TAO6] = { "ks-tao6", { 64, 64 }, { { 16, 32, 64, 64, 64 }, { 16, 32, 64, 128, 128 } } },
};

const char *kd_engine_name(enum kd_engine engine)
{
    return (unsigned)engine < KD_ENGINE_COUNT ? engines[engine].name : "unknown";
}

const char *kd_precision_name(enum kd_precision precision) { return precision == KD_PRECISION_F32 ? "f32" : "f64"; }

uint32_t kd_engine_steps(enum kd_engine engine, enum kd_precision precision)
{
    return engines[engine].steps[precision];
}

/* Largest number of steps that a request may name. llvmpipe silently ends the loops of a kernel after 65535 rounds,
 * counted over all loops together. With this limit every ray reaches its end before that. In Mino time a ray takes at
 * most 12 + KD_RAYS_MAX_ORDERS half periods, each of this many steps. For the Kerr-Schild engines,
 * rays_kerr_schild.comp counts the rounds. Tao's engine has a lower limit, because each of its steps contains an inner
 * loop. */
uint32_t kd_engine_most_steps(enum kd_engine engine)
{
    return engine == KD_ENGINE_KS_TAO6 ? 512 : engine >= KD_ENGINE_KS_EULER ? 1024 : KD_STEPS_MAX;
}

enum kd_status kd_engine_steps_error(enum kd_engine engine, uint32_t steps, struct kd_error *error)
{
    return kd_error_field(error, "/accuracy/steps",
                          "steps is %u; for %s it must be a multiple of 4 up to %u, or 0 for the engine's default",
                          steps, kd_engine_name(engine), kd_engine_most_steps(engine));
}

/* Each of these fields of a scene has "auto" as its first word. Its other words are the names of our enum's values, in
 * the same order (tests/unit/engine.c). */
struct kd_accuracy_request kd_accuracy_request_of(const struct kd_scene *scene)
{
    const struct kd_accuracy *a = &scene->accuracy;
    return (struct kd_accuracy_request) { a->profile, a->engine - 1, a->precision - 1, (uint32_t)a->steps,
                                          a->tolerance };
}

bool kd_accuracy_request_needs_device(const struct kd_accuracy_request *asked_accuracy)
{
    return asked_accuracy->engine > KD_ENGINE_CLOSED ||
           (asked_accuracy->engine < 0 && (asked_accuracy->profile >= 0 || isfinite(asked_accuracy->tolerance)));
}

static enum kd_status by_tolerance(const struct kd_accuracy_request *asked_accuracy,
                                   const struct kd_accuracy_table *table, bool float64, struct kd_setting *out,
                                   struct kd_error *error)
{
    struct kd_accuracy_choice choice;
    if (asked_accuracy->steps)
        return kd_error_field(error, "/accuracy/steps",
                              "steps is %u; with a tolerance, which determines the steps, it must be 0",
                              asked_accuracy->steps);
    if (asked_accuracy->engine == KD_ENGINE_CLOSED)
        return kd_error_field(error, "/accuracy/tolerance",
                              "tolerance is %.9g; it cannot be used with the engine \"closed\", whose accuracy depends "
                              "only on its precision",
                              asked_accuracy->tolerance);
    const struct kd_accuracy_limits limits = { asked_accuracy->engine,
                                               float64 ? asked_accuracy->precision : KD_PRECISION_F32 };
    enum kd_status status = kd_accuracy_choose(table, asked_accuracy->tolerance, &limits, &choice, error);
    if (!status)
        *out = (struct kd_setting) { choice.engine, choice.precision, choice.steps, choice.error };
    if (status == KD_EINVAL && asked_accuracy->engine < 0 && asked_accuracy->precision != KD_PRECISION_F32 &&
        asked_accuracy->tolerance >= KD_CLOSED_HOLDS && asked_accuracy->tolerance < 1) {
        *out =
            (struct kd_setting) { .engine = KD_ENGINE_CLOSED, .precision = KD_PRECISION_F64, .holds = KD_CLOSED_HOLDS };
        return KD_OK;
    }
    return status;
}

static struct kd_setting by_profile(const struct kd_accuracy_request *asked_accuracy, bool float64)
{
    bool named = asked_accuracy->profile >= 0, fine = !named || asked_accuracy->profile == KD_PROFILE_REFERENCE;
    struct kd_setting s = { .holds = NAN };
    s.engine = asked_accuracy->engine >= 0 ? (enum kd_engine)asked_accuracy->engine
               : named                     ? KD_ENGINE_MINO_RKN6
                                           : KD_ENGINE_CLOSED;
    s.precision = asked_accuracy->precision >= 0         ? (enum kd_precision)asked_accuracy->precision
                  : s.engine == KD_ENGINE_CLOSED || fine ? KD_PRECISION_F64
                                                         : KD_PRECISION_F32;
    /* A precision or an engine that the profile chose may be replaced. One that the request names may not. */
    if (s.precision == KD_PRECISION_F64 && !float64 && asked_accuracy->precision < 0 && asked_accuracy->engine < 0 &&
        !asked_accuracy->steps)
        s.engine = KD_ENGINE_CLOSED;
    s.steps = asked_accuracy->steps ? asked_accuracy->steps
              : named               ? engines[s.engine].profile[s.precision][asked_accuracy->profile]
                                    : engines[s.engine].steps[s.precision];
    return s;
}

enum kd_status kd_setting_of(const struct kd_accuracy_request *asked_accuracy, const struct kd_accuracy_table *table,
                             bool float64, struct kd_setting *out, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    if (isfinite(asked_accuracy->tolerance))
        status = by_tolerance(asked_accuracy, table, float64, out, error);
    else
        *out = by_profile(asked_accuracy, float64);
    if (!status && out->precision == KD_PRECISION_F64 && !float64 && out->engine != KD_ENGINE_CLOSED)
        return kd_error_field(
            error, "/accuracy/precision",
            "precision is f64, which this device lacks; it must be f32, or the engine must be \"closed\"");
    if (!status && out->engine == KD_ENGINE_CLOSED && asked_accuracy->steps)
        return kd_error_field(
            error, "/accuracy/steps",
            "steps cannot be used with engine \"closed\", because that engine takes no steps; steps must be 0");
    if (!status && (asked_accuracy->steps % 4 || asked_accuracy->steps > kd_engine_most_steps(out->engine)))
        return kd_engine_steps_error(out->engine, asked_accuracy->steps, error);
    return status;
}
