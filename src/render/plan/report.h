/* The report of a plan with its picture: approximations, the sources of its estimates, and a description of one pixel.
 * Plain data; any thread. */
#ifndef KD_RENDER_PLAN_REPORT_H
#define KD_RENDER_PLAN_REPORT_H

#include "render/emit/approximation.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define KD_PLAN_MAX_APPROXIMATIONS 136 /* a test compares this limit with the number of approximations */

struct kd_plan_report {
    bool measured, accuracy_measured; /* same meaning as in kd_capacity */
    struct kd_approximation approximations[KD_PLAN_MAX_APPROXIMATIONS];
    size_t n_approximations;
    /* The caller sets `on` to request a description of the light of this pixel's middle ray (frame/probe.h). The
     * caller sets `steps` to have the engine's steps recorded as well. */
    struct {
        bool on, steps;
        uint32_t x, y;
    } probe;
};

#endif
