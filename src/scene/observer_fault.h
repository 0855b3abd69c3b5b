/* Checks an observer's place and the numbers of its motion, and explains what is wrong. Any thread. */
#ifndef KD_SCENE_OBSERVER_FAULT_H
#define KD_SCENE_OBSERVER_FAULT_H

#include "base/error.h"
#include "physics/spacetime/observer.h"

/* Names of the fields in the caller's document. */
struct kd_observer_names {
    const char *pointer;  /* of the object that holds them: "/camera" */
    const char *prefix;   /* of the names in messages: "camera." */
    const char *r, *kind; /* names without the prefix */
};

/* KD_EINVAL at the radius if there is no observer of this kind at this place. */
enum kd_status kd_observer_check_place(const struct kd_observer_names *names, enum kd_observer kind,
                                       const struct kd_vantage *at, struct kd_error *error);
/* KD_EINVAL at the invalid number. */
enum kd_status kd_observer_check_numbers(const struct kd_observer_names *names, const struct kd_observer_motion *motion,
                                         const struct kd_vantage *at, struct kd_error *error);

#endif
