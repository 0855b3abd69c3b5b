/* What is wrong with an observer, in words: with its place, and with the numbers of its motion. Any thread. */
#ifndef KD_SCENE_OBSERVER_FAULT_H
#define KD_SCENE_OBSERVER_FAULT_H

#include "base/error.h"
#include "physics/spacetime/observer.h"

/* How whoever asks calls the fields. */
struct kd_observer_names {
    const char *pointer;  /* of what holds them: "/camera" */
    const char *prefix;   /* of their names: "camera." */
    const char *r, *kind; /* without the prefix */
};

/* KD_EINVAL at the radius: there is no observer of this kind at this place. */
enum kd_status kd_observer_check_place(const struct kd_observer_names *names, enum kd_observer kind,
                                       const struct kd_vantage *at, struct kd_error *error);
/* KD_EINVAL at the number that is wrong. */
enum kd_status kd_observer_check_numbers(const struct kd_observer_names *names, const struct kd_observer_motion *motion,
                                         const struct kd_vantage *at, struct kd_error *error);

#endif
