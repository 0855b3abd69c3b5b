/* Helpers shared by the tests of the playground. */
#ifndef PLAYGROUND_SUPPORT_H
#define PLAYGROUND_SUPPORT_H

#include "playground/hole.h"
#include "playground/json.h"
#include "playground/playground.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static inline struct kd_playground *playground_make(struct kd_playground_params params)
{
    struct kd_playground *p;
    struct kd_error error = { 0 };
    if (kd_playground_create(&params, &p, &error))
        fail_msg("%s", error.message);
    return p;
}

static inline struct kd_playground *playground_read(const char *text)
{
    struct kd_playground *p;
    struct kd_error error = { 0 };
    if (kd_playground_read(text, strlen(text), &p, &error))
        fail_msg("%s (at %s)", error.message, error.pointer);
    return p;
}

/* Parameters without tides, mergers and debris, and without a limit of sub-steps. */
static inline struct kd_playground_params playground_quiet(void)
{
    struct kd_playground_params params = kd_playground_defaults();
    params.tides = params.mergers = false;
    params.budget = 100000000;
    params.debris_capacity = 0;
    return params;
}

static inline void playground_put(struct kd_playground *p, struct kd_playground_body body)
{
    struct kd_error error = { 0 };
    if (kd_playground_add(p, &body, NULL, &error))
        fail_msg("%s (at %s)", error.message, error.pointer);
}

static inline void playground_advance(struct kd_playground *p, double time)
{
    struct kd_playground_progress progress;
    kd_playground_advance(p, time, &progress);
    assert_false(progress.slowed);
}

#endif
