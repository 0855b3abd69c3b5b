#include "observe/simulate.h"

#include "base/pause.h"
#include "observe/uvfits.h"

#include <math.h>
#include <string.h>

/* Hash function: the finaliser of SplitMix64 (G. L. Steele, D. Lea & C. H. Flood 2014, OOPSLA, 453). */
static uint64_t mix(uint64_t x)
{
    x = (x ^ x >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    x = (x ^ x >> 27) * UINT64_C(0x94d049bb133111eb);
    return x ^ x >> 31;
}

static double uniform(uint64_t x) { return ((double)(mix(x) >> 11) + 0.5) * 0x1p-53; }

/* Makes two independent normal numbers from one key (G. E. P. Box & M. E. Muller 1958). */
static void normal(uint64_t seed, uint64_t group, uint64_t item, double out[2])
{
    const uint64_t step = UINT64_C(0x9e3779b97f4a7c15), key = mix(mix(mix(seed + step) + group + step) + item + step);
    const double r = sqrt(-2 * log(uniform(key))), angle = 2 * M_PI * uniform(key + step);
    out[0] = r * cos(angle), out[1] = r * sin(angle);
}

static void put(uint8_t *at, bool is_double, double value)
{
    uint64_t word;
    if (is_double) {
        memcpy(&word, &value, sizeof word);
    } else {
        const float single = (float)value;
        uint32_t half;
        memcpy(&half, &single, sizeof half);
        word = half;
    }
    for (int n = is_double ? 8 : 4; n--; word >>= 8)
        at[n] = (uint8_t)word;
}

/* Replaces the data of one group by the model. model: NULL if the group is not part of the observation. */
static void fill_group(const struct kd_simulation *s, const struct groups *g, size_t group, uint8_t *data,
                       const double model[2])
{
    const size_t n = g->elements / 3;
    for (size_t i = 0; i < n; i++) {
        uint8_t *three = data + 3 * i * g->bytes;
        const size_t hand = 3 * i / g->hand_step % g->hands;
        const double w = kd_uvfits_number(three + 2 * g->bytes, g->bytes == 8);
        const bool is_used = model && hand < (g->circular ? 2u : 1u) && w > 0 && isfinite(w);
        double noise[2] = { 0 };
        if (is_used && s->noise)
            normal(s->seed, group, i, noise);
        for (size_t k = 0; k < 2; k++) {
            const double value = is_used ? model[k] + noise[k] / sqrt(w) : 0;
            put(three + k * g->bytes, g->bytes == 8, is_used ? (value - g->zero) / g->scale : 0);
        }
        if (!is_used && w > 0)
            put(three + 2 * g->bytes, g->bytes == 8, 0);
    }
}

/* Writes the visibilities of the groups that the observation contains, and empties all other groups. */
static void fill_file(const struct kd_simulation *s, const struct groups *g, const double (*model)[2], double (*out)[2])
{
    const struct kd_observation *o = s->observation;
    const size_t size = (g->parameters + g->elements) * g->bytes;
    uint8_t *first = s->file + g->hdu.begin + g->parameters * g->bytes;
    for (size_t i = 0; i < o->n; i++) {
        const struct kd_measured *m = &o->at[i];
        struct kd_measured read = { 0 };
        uint8_t *data = first + m->source * size;
        const double here[2] = { model[i][0], m->turned ? -model[i][1] : model[i][1] };
        if (kd_pause_every(i, 256))
            return;
        fill_group(s, g, m->source, data, here);
        kd_uvfits_light(g, data, &read);
        out[i][0] = read.re, out[i][1] = m->turned ? -read.im : read.im;
    }
}

/* Sets to zero the groups from which the observation has no visibility: repetitions of a time and baseline, and groups
 * without a positive weight. */
static void empty_others(const struct kd_simulation *s, const struct groups *g)
{
    const struct kd_observation *o = s->observation;
    const size_t size = (g->parameters + g->elements) * g->bytes;
    for (size_t i = 0; i < o->n; i++)
        s->marks[o->at[i].source / 8] |= (uint8_t)(1u << o->at[i].source % 8);
    for (size_t i = 0; i < g->n; i++) {
        if (kd_pause_every(i, 256))
            return;
        if (!(s->marks[i / 8] & 1u << i % 8))
            fill_group(s, g, i, s->file + g->hdu.begin + g->parameters * g->bytes + i * size, NULL);
    }
}

void kd_simulate(const struct kd_simulation *s, const double (*model)[2], double (*out)[2])
{
    const struct kd_observation *o = s->observation;
    struct groups groups;
    if (s->file && !kd_uvfits_open(&(struct file) { s->file, s->size, NULL }, &groups)) {
        empty_others(s, &groups);
        fill_file(s, &groups, model, out);
        return;
    }
    for (size_t i = 0; i < o->n; i++) {
        double noise[2] = { 0 };
        if (s->noise)
            normal(s->seed, i, 0, noise);
        for (int k = 0; k < 2; k++)
            out[i][k] = model[i][k] + noise[k] * o->at[i].sigma;
    }
}

enum kd_status kd_observation_write_csv(const struct kd_observation *o, const double (*visibility)[2],
                                        struct kd_buffer *out)
{
    char source[sizeof o->source];
    enum kd_status status;
    memcpy(source, o->source, sizeof source);
    for (char *c = source; *(c += strcspn(c, ",")); c++)
        *c = '_';
    KD_TRY(kd_buffer_printf(out,
                            "#SRC:%s,DATE(MJD):%.0f,FREQ:%.12gGHz\n"
                            "#time(UTC),T1,T2,U(lambda),V(lambda),Iamp(Jy),Iphase(d),Isigma(Jy)\n",
                            *source ? source : "UNKNOWN", o->mjd, o->frequency_hz * 1e-9));
    for (size_t i = 0; i < o->n; i++) {
        const struct kd_measured *m = &o->at[i];
        const double *v = visibility[i];
        KD_TRY(kd_pause_every(i, 256) ? KD_ECANCELLED : KD_OK);
        KD_TRY(kd_buffer_printf(out, "%.10f,%s,%s,%.4f,%.4f,%.12g,%.10f,%.12g\n", m->hour, o->station[m->station[0]],
                                o->station[m->station[1]], m->u, m->v, hypot(v[0], v[1]),
                                atan2(v[1], v[0]) * (180 / M_PI), m->sigma));
    }
done:
    return status;
}
