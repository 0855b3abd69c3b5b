/* Recognises, reads and sorts observations (observation.h). */
#include "observe/observe_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum kd_observation_kind kd_observation_kind_of(const void *data, size_t size)
{
    static const char fits[] = "SIMPLE  =", csv[] = "#SRC:";
    return size >= sizeof fits - 1 && !memcmp(data, fits, sizeof fits - 1) ? KD_OBSERVATION_UVFITS
           : size >= sizeof csv - 1 && !memcmp(data, csv, sizeof csv - 1)  ? KD_OBSERVATION_CSV
                                                                           : KD_OBSERVATION_NONE;
}

enum kd_status kd_station_name(char out[KD_STATION_NAME], const char *text, size_t length, struct kd_error *error)
{
    while (length && (text[length - 1] == ' ' || !text[length - 1]))
        length--;
    for (size_t i = 0; i < length; i++)
        if (text[i] <= ' ' || text[i] > '~' || text[i] == ',' || text[i] == '"')
            return kd_error_set(
                error, KD_EINVAL,
                "the name of a station has the byte %u; it must be of letters, digits and signs of ASCII "
                "without blanks, commas and quotes",
                (unsigned char)text[i]);
    if (!length || length >= KD_STATION_NAME)
        return kd_error_set(error, KD_EINVAL, "the name of a station has %zu letters; it must have 1 to %u", length,
                            KD_STATION_NAME - 1);
    memcpy(out, text, length);
    out[length] = 0;
    return KD_OK;
}

static int by_time(const void *a, const void *b)
{
    const struct kd_measured *x = a, *y = b;
    if (x->hour != y->hour)
        return x->hour < y->hour ? -1 : 1;
    const int first = x->station[0] - y->station[0];
    return first ? first : x->station[1] - y->station[1];
}

static bool is_same(const struct kd_measured *x, const struct kd_measured *y) { return !by_time(x, y); }

/* Sorts by merging, which is stable: of two measurements with the same time and baseline, the first one in the file
 * remains first, and is kept. */
static enum kd_status sort(struct kd_measured *at, size_t n, struct kd_error *error)
{
    struct kd_measured *other = malloc(n * sizeof *other), *from = at, *to = other;
    if (!other)
        return kd_error_set(error, KD_ENOMEM, "out of memory for %zu visibilities", n);
    for (size_t width = 1; width < n; width *= 2) {
        for (size_t low = 0; low < n; low += 2 * width) {
            const size_t mid = low + width < n ? low + width : n, high = low + 2 * width < n ? low + 2 * width : n;
            for (size_t i = low, j = mid, k = low; k < high; k++)
                to[k] = i < mid && (j >= high || by_time(&from[i], &from[j]) <= 0) ? from[i++] : from[j++];
        }
        struct kd_measured *swap = from;
        from = to, to = swap;
    }
    if (from != at)
        memcpy(at, from, n * sizeof *at);
    free(other);
    return KD_OK;
}

/* Reverses the baseline if its first station comes after its second in the list. */
static void turn(struct kd_measured *m)
{
    if (m->station[0] <= m->station[1])
        return;
    const uint8_t first = m->station[0];
    m->station[0] = m->station[1], m->station[1] = first;
    m->turned = true;
    m->u = -m->u, m->v = -m->v, m->im = -m->im;
}

static enum kd_status put_in_order(struct kd_observation *o, struct kd_error *error)
{
    size_t n = 0;
    for (size_t i = 0; i < o->n; i++)
        turn(&o->at[i]);
    enum kd_status status = sort(o->at, o->n, error);
    for (size_t i = 0; !status && i < o->n; i++) {
        if (n && is_same(&o->at[n - 1], &o->at[i]))
            o->duplicate++;
        else
            o->at[n++] = o->at[i];
    }
    o->n = status ? o->n : n;
    return status;
}

static enum kd_status check(const struct kd_observation *o, struct kd_error *error)
{
    if (!o->n)
        return kd_error_set(error, KD_EINVAL,
                            "the observation has no visibility with a weight above 0; it must have at least one");
    for (size_t i = 0; i < o->n; i++) {
        const struct kd_measured *m = &o->at[i];
        const double numbers[] = { m->hour, m->u, m->v, m->re, m->im, m->sigma };
        static const char *const names[] = { "time", "u", "v", "real part", "imaginary part", "error" };
        static const double most[] = { 1e6, 1e18, 1e18, 1e12, 1e12, 1e12 };
        for (size_t k = 0; k < sizeof most / sizeof *most; k++)
            if (!(fabs(numbers[k]) <= most[k]))
                return kd_error_set(error, KD_EINVAL, "visibility %zu: its %s is %g; it must be a number up to %g",
                                    i + 1, names[k], numbers[k], most[k]);
        if (!(m->sigma > 0))
            return kd_error_set(error, KD_EINVAL, "visibility %zu: its error is %g; it must be above 0", i + 1,
                                m->sigma);
        if (m->station[0] == m->station[1])
            return kd_error_set(error, KD_EINVAL, "visibility %zu: both stations are %s; they must differ", i + 1,
                                o->station[m->station[0]]);
    }
    return KD_OK;
}

enum kd_status kd_observation_read(const void *data, size_t size, struct kd_observation *out, struct kd_error *error)
{
    const enum kd_observation_kind kind = kd_observation_kind_of(data, size);
    enum kd_status status = KD_OK;
    *out = (struct kd_observation) { 0 };
    if (kind == KD_OBSERVATION_NONE)
        return kd_error_set(error, KD_EINVAL,
                            "the file is not an observation; it must be uvfits, which begins with SIMPLE, or the EHT's "
                            "CSV, which begins with #SRC:");
    if (size > KD_OBSERVATION_BYTES)
        return kd_error_set(error, KD_EINVAL, "an observation has %zu bytes; it must have at most %zu", size,
                            KD_OBSERVATION_BYTES);
    KD_TRY((kind == KD_OBSERVATION_CSV) ? kd_observation_read_csv(data, size, out, error)
                                        : kd_observation_read_uvfits(data, size, out, error));
    KD_TRY(check(out, error));
    KD_TRY(put_in_order(out, error));
done:
    if (status)
        kd_observation_finish(out);
    return status;
}

void kd_observation_finish(struct kd_observation *observation)
{
    free(observation->at);
    *observation = (struct kd_observation) { 0 };
}
