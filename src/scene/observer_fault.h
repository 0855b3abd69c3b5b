/* Checks the place of an observer and the numbers of its motion, and reports what is wrong with them. Any thread. */
#ifndef KD_SCENE_OBSERVER_FAULT_H
#define KD_SCENE_OBSERVER_FAULT_H

#include "base/error.h"
#include "physics/spacetime/observer.h"

/* The names of these fields in the caller's document. */
struct kd_observer_names {
    const char *pointer;  /* JSON pointer of the object that holds the fields, such as "/camera" */
    const char *prefix;   /* prefix of the fields' names in messages, such as "camera." */
    const char *r, *kind; /* names of two fields, without the prefix */
};

/* Returns KD_EINVAL with the pointer of the radius if no observer of this kind can exist at this place. */
enum kd_status kd_observer_check_place(const struct kd_observer_names *names, enum kd_observer kind,
                                       const struct kd_vantage *at, struct kd_error *error);
/* Returns KD_EINVAL with the pointer of the first number that is not valid. */
enum kd_status kd_observer_check_numbers(const struct kd_observer_names *names, const struct kd_observer_motion *motion,
                                         const struct kd_vantage *at, struct kd_error *error);

#endif
