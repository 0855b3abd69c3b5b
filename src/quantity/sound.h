/* Makes a quasi-normal mode heard: e^(-t/tau) cos(2 pi f t) for the mass of the hole, as a WAV file of 16 bits,
 * 48 kHz, one channel, from full scale until less than half a step is left, and silence up to a quarter of a second.
 * Transposing by shift_octaves s makes all of it 2^s times as fast; `stretch` then makes it fade that many times as
 * slowly, at the same pitch. The comment in the file says both, with the frequencies and times before and after. Any
 * thread. */
#ifndef KD_QUANTITY_SOUND_H
#define KD_QUANTITY_SOUND_H

#include "quantity/quantity.h"

#define KD_SOUND_HZ_MIN 20.0
#define KD_SOUND_HZ_MAX 20000.0
#define KD_SOUND_DAMPING_S 5.0           /* at most, in which it fades by e */
#define KD_SOUND_BYTES ((size_t)6 << 20) /* at most: a minute */

/* Called before anything is computed. KD_EINVAL where the quantity makes no sound, or the request is not for one
 * point or names a time. */
enum kd_status kd_quantity_sound_check(const struct kd_quantity_request *request, struct kd_error *error);
/* KD_EINVAL at /mass_msun, naming the frequency and which masses and shifts can be heard; at /stretch, naming the
 * longest. */
enum kd_status kd_quantity_sound(const struct kd_quantity_answer *answer, struct kd_buffer *out,
                                 struct kd_error *error);

#endif
