/* Turns a quasi-normal mode into sound: e^(-t/tau) cos(2 pi f t), for the mass of the hole. The result is a WAV file of
 * 16 bits, 48 kHz, one channel. The sound begins at full scale, and lasts until the amplitude is less than half a step
 * of 16 bits. It is padded with silence to at least a quarter of a second. shift_octaves = s makes the whole sound 2^s
 * times as fast. stretch = k then makes the decay k times slower, at the same pitch. A comment in the file states s and
 * k, with frequencies and times before and after these changes. Any thread. */
#ifndef KD_QUANTITY_SOUND_H
#define KD_QUANTITY_SOUND_H

#include "quantity/quantity.h"

#define KD_SOUND_HZ_MIN 20.0
#define KD_SOUND_HZ_MAX 20000.0
#define KD_SOUND_DAMPING_S 5.0           /* longest time in which the sound may decay by a factor e, seconds */
#define KD_SOUND_BYTES ((size_t)6 << 20) /* largest size of a file, bytes, which is a minute of sound */

/* Checks a request before evaluation. Returns KD_EINVAL if the quantity has no sound, or if the request has more than
 * one point or names a time. */
enum kd_status kd_quantity_sound_check(const struct kd_quantity_request *request, struct kd_error *error);
/* Makes the sound. Returns KD_EINVAL at /mass_msun, whose message has the frequency, and the masses and shifts for
 * which the sound is audible. Returns KD_EINVAL at /stretch, whose message has the largest stretch. */
enum kd_status kd_quantity_sound(const struct kd_quantity_answer *answer, struct kd_buffer *out,
                                 struct kd_error *error);

#endif
