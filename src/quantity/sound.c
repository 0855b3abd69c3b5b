#include "quantity/sound.h"

#include <math.h>
#include <sndfile.h>
#include <stdio.h>
#include <string.h>

#define RATE 48000
#define SAMPLES_MIN (RATE / 4) /* what is shorter, some players leave out */
#define BLOCK 4096

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
        return kd_error_field(error, "/format", "format is \"wav\", allowed for %s are \"json\" and \"csv\"",
                              quantity->name);
    for (size_t i = 0; i < quantity->n_parameters; i++) {
        snprintf(pointer, sizeof pointer, "/%s", quantity->parameters[i].name);
        if (request->axes[i].count > 1)
            return kd_error_field(error, pointer, "%s is a range of %zu values, allowed in a sound is one", pointer + 1,
                                  request->axes[i].count);
    }
    double t = request->axes[parameter(quantity, "t")].first;
    if (t != 0)
        return kd_error_field(error, "/t", "t is %g, allowed is 0: a sound holds all times", t);
    return KD_OK;
}

/* Bounds are rounded inwards to four digits, so that a value that the message names is accepted. */
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
    return kd_error_field(
        error, "/mass_msun",
        "mass_msun is %g, which rings at %.3g Hz with this shift_octaves; heard are %g to %g Hz: allowed are masses "
        "from %.4g to %.4g solar masses, or shift_octaves %.0f to %.0f for this one",
        mass, hz, KD_SOUND_HZ_MIN, KD_SOUND_HZ_MAX, low, high, ceil(log2(KD_SOUND_HZ_MIN / natural)),
        floor(log2(KD_SOUND_HZ_MAX / natural)));
}

static double parameter_of(const struct kd_quantity_answer *answer, const char *name)
{
    return answer->request.axes[parameter(answer->request.quantity, name)].first;
}

/* Every mode is short enough unstretched: the mode of the greatest quality, 285 (l = m = 4, a = 0.9999), fades by e
 * in 4.5 s at 20 Hz. */
static enum kd_status short_enough(const struct kd_quantity_answer *answer, struct kd_error *error)
{
    double fades = output(answer, "sound_damping_s"), stretch = parameter_of(answer, "stretch");
    if (fades <= KD_SOUND_DAMPING_S)
        return KD_OK;
    return kd_error_field(
        error, "/stretch",
        "stretch is %g, which makes the sound fade by e in %.3g s; allowed for this one is 1 to %.4g, "
        "which is %g s",
        stretch, fades, four_digits(fmax(1, KD_SOUND_DAMPING_S * stretch / fades), false), KD_SOUND_DAMPING_S);
}

/* A file in memory. */
struct memory {
    struct kd_buffer *out;
    size_t at;
};

static sf_count_t length(void *user) { return (sf_count_t)((struct memory *)user)->out->size; }

static sf_count_t tell(void *user) { return (sf_count_t)((struct memory *)user)->at; }

static sf_count_t seek(sf_count_t offset, int whence, void *user)
{
    struct memory *m = user;
    sf_count_t from = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? tell(m) : length(m);
    if (from + offset < 0 || from + offset > length(m))
        return -1;
    m->at = (size_t)(from + offset);
    return tell(m);
}

static sf_count_t put(const void *data, sf_count_t size, void *user)
{
    struct memory *m = user;
    size_t n = (size_t)size, over = m->out->size - m->at < n ? m->out->size - m->at : n;
    if (over)
        memcpy(m->out->data + m->at, data, over);
    if (n > over && kd_buffer_append(m->out, (const char *)data + over, n - over))
        return 0;
    m->at += n;
    return size;
}

static sf_count_t get(void *data, sf_count_t size, void *user)
{
    (void)data, (void)size, (void)user;
    return 0; /* it is written alone */
}

/* Writes what the sound is into the file, where players show it. */
static void describe(SNDFILE *file, const struct kd_quantity_answer *answer)
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
    sf_set_string(file, SF_STR_TITLE, quantity->summary);
    sf_set_string(file, SF_STR_COMMENT, text);
}

static bool write_samples(SNDFILE *file, double hz, double damping_s)
{
    size_t n = (size_t)fmax(SAMPLES_MIN, ceil(16 * M_LN2 * damping_s * RATE));
    double block[BLOCK];
    for (size_t i = 0; i < n; i += BLOCK) {
        size_t count = n - i < BLOCK ? n - i : BLOCK;
        for (size_t k = 0; k < count; k++) {
            double t = (double)(i + k) / RATE;
            block[k] = exp(-t / damping_s) * cos(2 * M_PI * hz * t);
        }
        if (sf_write_double(file, block, (sf_count_t)count) != (sf_count_t)count)
            return false;
    }
    return true;
}

enum kd_status kd_quantity_sound(const struct kd_quantity_answer *answer, struct kd_buffer *out, struct kd_error *error)
{
    SF_VIRTUAL_IO io = { .get_filelen = length, .seek = seek, .read = get, .write = put, .tell = tell };
    SF_INFO info = { .samplerate = RATE, .channels = 1, .format = SF_FORMAT_WAV | SF_FORMAT_PCM_16 };
    struct memory memory = { .out = out };
    enum kd_status status = audible(answer, error);
    if (!status)
        status = short_enough(answer, error);
    if (status)
        return status;
    SNDFILE *file = sf_open_virtual(&io, SFM_WRITE, &info, &memory);
    if (!file)
        return kd_error_set(error, KD_ENOMEM, "the sound could not be begun: %s", sf_strerror(NULL));
    describe(file, answer);
    bool written = write_samples(file, output(answer, "sound_hz"), output(answer, "sound_damping_s"));
    if (sf_close(file) || !written)
        return kd_error_set(error, KD_ENOMEM, "out of memory for the sound");
    return KD_OK;
}
