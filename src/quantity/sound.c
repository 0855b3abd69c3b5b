#include "quantity/sound.h"

#include "base/pause.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define RATE 48000
#define SAMPLES_MIN (RATE / 4) /* least number of samples, because some players skip shorter files */

static size_t parameter(const struct kd_quantity *quantity, const char *name)
{
    size_t i = 0;
    while (strcmp(quantity->parameters[i].name, name))
        i++;
    return i;
}

static double output(const struct kd_quantity_answer *answer, const char *name)
{
    const struct kd_quantity *quantity = answer->request.quantity;
    size_t i = 0;
    while (strcmp(quantity->outputs[i].name, name))
        i++;
    return answer->values[i];
}

enum kd_status kd_quantity_sound_check(const struct kd_quantity_request *request, struct kd_error *error)
{
    const struct kd_quantity *quantity = request->quantity;
    char pointer[60];
    if (!quantity->sound)
        return kd_error_field(error, "/format", "format is \"wav\"; for %s it must be \"json\" or \"csv\"",
                              quantity->name);
    for (size_t i = 0; i < quantity->n_parameters; i++) {
        snprintf(pointer, sizeof pointer, "/%s", quantity->parameters[i].name);
        if (request->axes[i].count > 1)
            return kd_error_field(error, pointer, "%s is a range of %zu values; for a sound it must be one value",
                                  pointer + 1, request->axes[i].count);
    }
    double t = request->axes[parameter(quantity, "t")].first;
    if (t != 0)
        return kd_error_field(error, "/t", "t is %g; for a sound it must be 0, because a sound has all times", t);
    return KD_OK;
}

/* Rounds a bound inwards to four digits, so that the bound that a message names is itself accepted. */
static double four_digits(double x, bool up)
{
    double unit = pow(10, floor(log10(x)) - 3);
    return (up ? ceil(x / unit) : floor(x / unit)) * unit;
}

static enum kd_status audible(const struct kd_quantity_answer *answer, struct kd_error *error)
{
    const struct kd_quantity_request *request = &answer->request;
    double hz = output(answer, "sound_hz"), natural = output(answer, "frequency_hz");
    double mass = request->axes[parameter(request->quantity, "mass_msun")].first;
    double low = four_digits(mass * hz / KD_SOUND_HZ_MAX, true), high = four_digits(mass * hz / KD_SOUND_HZ_MIN, false);
    if (hz >= KD_SOUND_HZ_MIN && hz <= KD_SOUND_HZ_MAX)
        return KD_OK;
    return kd_error_field(error, "/mass_msun",
                          "mass_msun is %g, which rings at %.3g Hz with this shift_octaves; for an audible %g to %g Hz "
                          "it must be %.4g to %.4g solar masses, or shift_octaves %.0f to %.0f",
                          mass, hz, KD_SOUND_HZ_MIN, KD_SOUND_HZ_MAX, low, high, ceil(log2(KD_SOUND_HZ_MIN / natural)),
                          floor(log2(KD_SOUND_HZ_MAX / natural)));
}

static double parameter_of(const struct kd_quantity_answer *answer, const char *name)
{
    return answer->request.axes[parameter(answer->request.quantity, name)].first;
}

/* Checks that `stretch` does not make the sound too long. Without stretch every mode is short enough: the mode with the
 * highest quality factor, 285 (l = m = 4, a = 0.9999), decays by a factor e in 4.5 s at 20 Hz. */
static enum kd_status short_enough(const struct kd_quantity_answer *answer, struct kd_error *error)
{
    double fades = output(answer, "sound_damping_s"), stretch = parameter_of(answer, "stretch");
    if (fades <= KD_SOUND_DAMPING_S)
        return KD_OK;
    return kd_error_field(error, "/stretch",
                          "stretch is %g, which makes the sound fade by e in %.3g s; it must be 1 to %.4g, "
                          "which is %g s",
                          stretch, fades, four_digits(fmax(1, KD_SOUND_DAMPING_S * stretch / fades), false),
                          KD_SOUND_DAMPING_S);
}

static enum kd_status put(struct kd_buffer *out, uint64_t value, int bytes)
{
    uint8_t little[8];
    for (int i = 0; i < bytes; i++)
        little[i] = (uint8_t)(value >> 8 * i);
    return kd_buffer_append(out, little, (size_t)bytes);
}

/* Writes the 44 bytes before the samples, for one channel of 16 bits (IBM and Microsoft, Multimedia Programming
 * Interface 1.0, 1991). */
static enum kd_status put_header(struct kd_buffer *out, size_t samples, size_t behind)
{
    enum kd_status status;
    KD_TRY(kd_buffer_append(out, "RIFF", 4));
    KD_TRY(put(out, 36 + 2 * samples + behind, 4));
    KD_TRY(kd_buffer_append(out, "WAVEfmt ", 8));
    KD_TRY(put(out, 16, 4));
    KD_TRY(put(out, 1, 2)); /* PCM */
    KD_TRY(put(out, 1, 2));
    KD_TRY(put(out, RATE, 4));
    KD_TRY(put(out, 2 * RATE, 4));
    KD_TRY(put(out, 2, 2));
    KD_TRY(put(out, 16, 2));
    KD_TRY(kd_buffer_append(out, "data", 4));
    KD_TRY(put(out, 2 * samples, 4));
done:
    return status;
}

/* Writes a chunk of text with its NUL, padded to an even length. */
static enum kd_status put_text(struct kd_buffer *out, const char *kind, const char *text)
{
    const size_t n = strlen(text) + 1;
    enum kd_status status;
    KD_TRY(kd_buffer_append(out, kind, 4));
    KD_TRY(put(out, n, 4));
    KD_TRY(kd_buffer_append(out, text, n));
    if (n % 2)
        KD_TRY(put(out, 0, 1));
done:
    return status;
}

/* Writes a description of the sound as texts that players show. */
static enum kd_status describe(const struct kd_quantity_answer *answer, struct kd_buffer *out)
{
    const struct kd_quantity *quantity = answer->request.quantity;
    char text[700];
    size_t n = 0;
    for (size_t i = 0; i < quantity->n_parameters && n < sizeof text; i++)
        n += (size_t)snprintf(text + n, sizeof text - n, "%s%s=%.10g", i ? " " : "", quantity->parameters[i].name,
                              answer->request.axes[i].first);
    if (n < sizeof text)
        n += (size_t)snprintf(text + n, sizeof text - n,
                              "; the hole rings at %.6g Hz and fades by e in %.6g s; this sound is %g octaves higher, "
                              "at %.6g Hz, and fades "
                              "by e in %.6g s, %g times as slowly as it would at that pitch",
                              output(answer, "frequency_hz"), output(answer, "damping_s"),
                              parameter_of(answer, "shift_octaves"), output(answer, "sound_hz"),
                              output(answer, "sound_damping_s"), parameter_of(answer, "stretch"));
    for (size_t i = 0; quantity->approximations[i] && n < sizeof text; i++)
        n += (size_t)snprintf(text + n, sizeof text - n, "; %s", quantity->approximations[i]);
    struct kd_buffer list = { 0 };
    enum kd_status status;
    KD_TRY(put_text(&list, "INAM", quantity->summary));
    KD_TRY(put_text(&list, "ICMT", text));
    KD_TRY(kd_buffer_append(out, "LIST", 4));
    KD_TRY(put(out, 4 + list.size, 4));
    KD_TRY(kd_buffer_append(out, "INFO", 4));
    KD_TRY(kd_buffer_append(out, list.data, list.size));
done:
    kd_buffer_finish(&list);
    return status;
}

static size_t samples_of(double damping_s) { return (size_t)fmax(SAMPLES_MIN, ceil(16 * M_LN2 * damping_s * RATE)); }

static enum kd_status put_samples(struct kd_buffer *out, size_t n, double hz, double damping_s)
{
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < n; i++) {
        kd_pause_every(i, 4096);
        const double t = (double)i / RATE;
        KD_TRY(put(out, (uint16_t)(int16_t)lrint(INT16_MAX * exp(-t / damping_s) * cos(2 * M_PI * hz * t)), 2));
    }
done:
    return status;
}

enum kd_status kd_quantity_sound(const struct kd_quantity_answer *answer, struct kd_buffer *out, struct kd_error *error)
{
    struct kd_buffer texts = { 0 };
    enum kd_status status = audible(answer, error);
    if (!status)
        status = short_enough(answer, error);
    if (status)
        return status;
    const double damping_s = output(answer, "sound_damping_s");
    const size_t n = samples_of(damping_s);
    KD_TRY(describe(answer, &texts));
    KD_TRY(put_header(out, n, texts.size));
    KD_TRY(put_samples(out, n, output(answer, "sound_hz"), damping_s));
    KD_TRY(kd_buffer_append(out, texts.data, texts.size));
done:
    kd_buffer_finish(&texts);
    return status ? kd_error_set(error, KD_ENOMEM, "out of memory for the sound") : KD_OK;
}
