/* The structs of shaders/shared/interface.h on the C side. */
#ifndef KD_RENDER_VIEW_LAYOUT_H
#define KD_RENDER_VIEW_LAYOUT_H

#include "interface.h"

#include <math.h>
#include <stdint.h>

/* What is told from 0 on the device must stay so as a float, for whether a ray lies in the plane or on the axis depends on it; and
 * where denormal numbers count as zeros, so must its quotients and products with what else there is. An observer may be 2.5e-16 from
 * the plane: beside that a label of 1e-20 would move the node by 1e-5, this one moves it by 1e-7; a third of it, times 2.5e-16, would be denormal. */
#define KD_LEAST_FLOAT 1e-22
static inline double kd_lifted(double x) { return x != 0 && fabs(x) < KD_LEAST_FLOAT ? copysign(KD_LEAST_FLOAT, x) : x; }

#define F(name) float name;
#define U(name) uint32_t name;
struct kd_camera_push { KD_CAMERA_FIELDS_(F, U) };
struct kd_transfer_block { KD_TRANSFER_FIELDS_(F, U) };
struct kd_spot_block { KD_SPOT_FIELDS_(F, U) };
struct kd_guide { KD_GUIDE_FIELDS_(F, U) };
struct kd_particles_push { KD_PARTICLES_FIELDS_(F, U) };
struct kd_light_push { KD_LIGHT_FIELDS_(F, U) };
struct kd_post_push { KD_POST_FIELDS_(F, U) };
#undef F
#undef U

_Static_assert(sizeof(struct kd_camera_push) <= 128, "the push constants that every device has");
_Static_assert(sizeof(struct kd_transfer_block) <= 4 * KD_TRANSFER_HEADER, "the tables start behind the header");

#endif
