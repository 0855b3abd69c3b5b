/* Reads uvfits: visibilities as random groups of the primary HDU, stations in the binary table "AIPS AN" (E. W. Greisen
 * 2020, AIPS Memo 117; FITS Standard 4.0, 6 and 7.3). The code does not use CFITSIO, because it needs only two HDUs of
 * FITS (docs/decisions/0020-observations-are-read-here.md).
 *
 * Stokes I is the mean of RR and LL, or one of them if the other has no weight. As in ehtim, channels and IFs are
 * averaged by their weights, and the mean is taken to be at the frequency in the table of stations. */
#include "observe/uvfits.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK = 2880, CARD = 80, CARDS = 100 * 36, AXES = 7, PARAMETERS = 32, ELEMENTS = 1 << 16, HDUS = 100, KEY = 20 };

/* Returns the value of a card, which is the text behind "= "; NULL if the HDU has no such card. */
static const char *find_card(const struct hdu *hdu, const char *key)
{
    char begin[11];
    snprintf(begin, sizeof begin, "%-8.8s= ", key);
    for (size_t i = 0; i < hdu->n_cards; i++)
        if (!memcmp(hdu->cards + i * CARD, begin, 10))
            return hdu->cards + i * CARD + 10;
    return NULL;
}

static bool read_number(const struct hdu *hdu, const char *key, double *out)
{
    const char *card = find_card(hdu, key);
    char text[CARD - 9], *end;
    if (!card)
        return false;
    memcpy(text, card, CARD - 10);
    text[CARD - 10] = 0;
    text[strcspn(text, "/")] = 0;
    for (char *c = text; *c; c++)
        *c = *c == 'D' || *c == 'd' ? 'E' : *c;
    *out = strtod(text, &end);
    return end != text && !end[strspn(end, " ")];
}

static double number_or(const struct hdu *hdu, const char *key, double otherwise)
{
    double x;
    return read_number(hdu, key, &x) ? x : otherwise;
}

/* Reads the quoted text of a card, without trailing blanks; "" if there is none. */
static void read_text(const struct hdu *hdu, const char *key, char *out, size_t size)
{
    const char *card = find_card(hdu, key);
    size_t n = 0;
    if (card && *card == '\'')
        for (size_t i = 1; i < CARD - 10 && card[i] != '\'' && n + 1 < size; i++)
            out[n++] = card[i] >= ' ' && card[i] <= '~' ? card[i] : '?';
    while (n && out[n - 1] == ' ')
        n--;
    out[n] = 0;
}

/* Makes a keyword that ends with a number, such as NAXIS2. Longer keywords are cut to eight letters, as find_card
 * compares only eight. */
static void numbered(char out[KEY], const char *key, int i) { snprintf(out, KEY, "%.6s%d", key, i); }

/* Reads a card whose value must be an integer from least to most. */
static enum kd_status read_whole(const struct file *f, const struct hdu *hdu, const char *key, double least,
                                 double most, size_t *out)
{
    double x;
    if (!read_number(hdu, key, &x))
        return kd_error_set(f->error, KD_EINVAL, "the uvfits has no number %s", key);
    if (!(x >= least && x <= most) || x != floor(x))
        return kd_error_set(f->error, KD_EINVAL, "%s of the uvfits is %.15g; it must be %.15g to %.15g", key, x, least,
                            most);
    *out = (size_t)x;
    return KD_OK;
}

/* Reads the header of the HDU that begins at `at`, up to the card END. The HDU's data begin at the next block. */
static enum kd_status read_header(const struct file *f, size_t at, struct hdu *hdu)
{
    *hdu = (struct hdu) { .cards = (const char *)f->data + at };
    for (size_t i = 0; i < CARDS && (i + 1) * CARD <= f->size - at; i++)
        if (!memcmp(hdu->cards + i * CARD, "END     ", 8)) {
            hdu->n_cards = i;
            hdu->begin = at + (i * CARD / BLOCK + 1) * BLOCK;
            return hdu->begin <= f->size
                       ? KD_OK
                       : kd_error_set(f->error, KD_EINVAL, "the uvfits ends in a header at %zu bytes", f->size);
        }
    return kd_error_set(f->error, KD_EINVAL, "the uvfits has no END in the header at byte %zu", at);
}

/* ---- the stations ---- */

struct column {
    size_t at, size; /* position and size of the column in a row; size 0: the table has no such column */
    char type;
};

static size_t width_of(char type)
{
    static const char types[] = "LXBIJKAEDCMPQ";
    static const uint8_t widths[] = { 1, 0, 1, 2, 4, 8, 1, 4, 8, 8, 16, 8, 16 };
    const char *is = type ? strchr(types, type) : NULL;
    return is ? widths[is - types] : 0;
}

static enum kd_status find_column(const struct file *f, const struct hdu *hdu, const char *name, size_t row,
                                  struct column *out)
{
    size_t fields = 0, at = 0;
    enum kd_status status = read_whole(f, hdu, "TFIELDS", 1, 999, &fields);
    *out = (struct column) { 0 };
    for (int i = 1; !status && i <= (int)fields; i++) {
        char key[KEY], form[24], title[24], *type;
        numbered(key, "TFORM", i);
        read_text(hdu, key, form, sizeof form);
        numbered(key, "TTYPE", i);
        read_text(hdu, key, title, sizeof title);
        const unsigned long count = form[0] >= '0' && form[0] <= '9' ? strtoul(form, &type, 10) : (type = form, 1);
        const size_t size = count > row * 8 ? row + 1 : *type == 'X' ? (count + 7) / 8 : count * width_of(*type);
        if (size > row - at)
            return kd_error_set(f->error, KD_EINVAL,
                                "TFORM%d of the table AIPS AN is \"%s\"; it must fit into a row of %zu bytes", i, form,
                                row);
        if (!strcmp(title, name))
            *out = (struct column) { at, size, *type };
        at += size;
    }
    return status;
}

static uint64_t bits(const uint8_t *at, int n)
{
    uint64_t x = 0;
    while (n--)
        x = x << 8 | *at++;
    return x;
}

double kd_uvfits_number(const uint8_t *at, bool is_double)
{
    if (is_double) {
        const uint64_t word = bits(at, 8);
        double x;
        memcpy(&x, &word, sizeof x);
        return x;
    }
    const uint32_t word = (uint32_t)bits(at, 4);
    float x;
    memcpy(&x, &word, sizeof x);
    return (double)x;
}

struct stations { uint32_t number[KD_OBSERVATION_STATIONS]; /* number NOSTA of each station in the table */ };

static enum kd_status read_stations(const struct file *f, const struct hdu *hdu, struct kd_observation *o,
                                    struct stations *out)
{
    struct column name, number, sefd;
    double noise[KD_OBSERVATION_STATIONS] = { 0 };
    size_t row = 0, rows = 0;
    enum kd_status status;
    KD_TRY(read_whole(f, hdu, "NAXIS1", 1, 1 << 16, &row));
    KD_TRY(read_whole(f, hdu, "NAXIS2", 2, KD_OBSERVATION_STATIONS, &rows));
    if (row * rows > f->size - hdu->begin) /* the table's length follows from NAXIS and BITPIX, which may be wrong */
        return kd_error_set(f->error, KD_EINVAL,
                            "the table AIPS AN has %zu rows of %zu bytes; the uvfits must hold them all, but ends %zu "
                            "bytes after the table's header",
                            rows, row, f->size - hdu->begin);
    KD_TRY(find_column(f, hdu, "ANNAME", row, &name));
    KD_TRY(find_column(f, hdu, "NOSTA", row, &number));
    KD_TRY(find_column(f, hdu, "SEFD", row, &sefd));
    if (name.type != 'A' || !name.size || number.type != 'J' || number.size != 4)
        return kd_error_set(f->error, KD_EINVAL,
                            "the table AIPS AN must have the columns ANNAME, text, and NOSTA, one 32-bit integer");
    for (size_t i = 0; i < rows; i++) {
        const uint8_t *at = f->data + hdu->begin + i * row;
        size_t k = i;
        const double here = (sefd.type == 'D' && sefd.size == 8) || (sefd.type == 'E' && sefd.size == 4)
                                ? kd_uvfits_number(at + sefd.at, sefd.type == 'D')
                                : 0;
        /* inserts the station in order of noise; stations with equal noise stay in the order of the table */
        for (; k && noise[k - 1] > here; k--) {
            noise[k] = noise[k - 1], out->number[k] = out->number[k - 1];
            memcpy(o->station[k], o->station[k - 1], sizeof o->station[k]);
        }
        noise[k] = here, out->number[k] = (uint32_t)bits(at + number.at, 4);
        KD_TRY(kd_station_name(o->station[k], (const char *)at + name.at, name.size, f->error));
        o->stations++;
    }
done:
    return status;
}

/* Finds the table of stations among the HDUs behind the groups. */
static enum kd_status find_stations(const struct file *f, size_t at, struct hdu *hdu)
{
    enum kd_status status = KD_OK;
    for (int i = 0; i < HDUS && at < f->size && f->size - at >= BLOCK; i++) {
        char kind[24];
        double size = 1, x;
        KD_TRY(read_header(f, at, hdu));
        read_text(hdu, "EXTNAME", kind, sizeof kind);
        const double axes = number_or(hdu, "NAXIS", 0);
        for (int axis = 1; axis <= axes && axis <= 999; axis++) {
            char key[KEY];
            numbered(key, "NAXIS", axis);
            size *= read_number(hdu, key, &x) && x >= 0 ? x : NAN;
        }
        size = (size + number_or(hdu, "PCOUNT", 0)) * fabs(number_or(hdu, "BITPIX", 8)) / 8;
        if (!(size >= 0 && size <= (double)(f->size - hdu->begin)))
            return kd_error_set(f->error, KD_EINVAL, "the uvfits ends at %zu bytes, within the HDU at byte %zu",
                                f->size, at);
        if (!strcmp(kind, "AIPS AN"))
            return KD_OK;
        at = hdu->begin + ((size_t)size + BLOCK - 1) / BLOCK * BLOCK;
    }
    return kd_error_set(f->error, KD_EINVAL, "the uvfits must have a table AIPS AN, which names its stations");
done:
    return status;
}

/* ---- the groups ---- */

static void find_parameter(const struct groups *g, const char *name, int which, struct parameter *out)
{
    for (int i = 1; i <= (int)g->parameters; i++) {
        char key[KEY], title[24];
        numbered(key, "PTYPE", i);
        read_text(&g->hdu, key, title, sizeof title);
        if (strcmp(title, name) || which--)
            continue;
        out->there = true, out->at = (size_t)i - 1;
        numbered(key, "PSCAL", i);
        out->scale = number_or(&g->hdu, key, 1);
        numbered(key, "PZERO", i);
        out->zero = number_or(&g->hdu, key, 0);
        return;
    }
}

static enum kd_status find_parameters(const struct file *f, struct groups *g)
{
    static const char *const u[] = { "UU---SIN", "UU", "UU--", "UU---NCP" }, *const v[] = { "VV---SIN", "VV", "VV--",
                                                                                            "VV---NCP" };
    for (int i = 0; i < 4 && !(g->u.there && g->v.there); i++)
        find_parameter(g, u[i], 0, &g->u), find_parameter(g, v[i], 0, &g->v);
    find_parameter(g, "BASELINE", 0, &g->baseline);
    find_parameter(g, "DATE", 0, &g->date[0]);
    find_parameter(g, "DATE", 1, &g->date[1]);
    if (!g->date[1].there)
        find_parameter(g, "_DATE", 0, &g->date[1]);
    return g->u.there && g->v.there && g->baseline.there && g->date[0].there
               ? KD_OK
               : kd_error_set(
                     f->error, KD_EINVAL,
                     "the groups of the uvfits must have the parameters UU---SIN, VV---SIN, BASELINE and DATE");
}

static enum kd_status read_axis(const struct file *f, struct groups *g, int axis)
{
    char key[KEY], kind[24];
    size_t size = 0;
    enum kd_status status;
    numbered(key, "CTYPE", axis);
    read_text(&g->hdu, key, kind, sizeof kind);
    numbered(key, "NAXIS", axis);
    KD_TRY(read_whole(f, &g->hdu, key, 1, 4096, &size));
    if (axis == 2 && (strcmp(kind, "COMPLEX") || size != 3))
        return kd_error_set(f->error, KD_EINVAL,
                            "axis 2 of the uvfits is %s of length %zu; it must be COMPLEX of length 3", kind, size);
    if (!strcmp(kind, "STOKES")) {
        numbered(key, "CRVAL", axis);
        const double first = number_or(&g->hdu, key, 0);
        if (first != -1 && first != 1)
            return kd_error_set(f->error, KD_EINVAL, "%s of the uvfits is %g; it must be -1 (RR, LL) or 1 (I)", key,
                                first);
        g->hands = size, g->hand_step = g->elements, g->circular = first < 0;
    } else if (!strcmp(kind, "FREQ")) {
        g->channels = size, g->channel_step = g->elements;
    } else if (!strcmp(kind, "IF")) {
        g->ifs = size, g->if_step = g->elements;
    } else if (axis > 2 && size != 1) {
        return kd_error_set(f->error, KD_EINVAL, "%s of the uvfits, %s, is %zu; it must be 1", key, kind, size);
    }
    g->elements *= size;
    if (g->elements > ELEMENTS)
        return kd_error_set(f->error, KD_EINVAL, "a group of the uvfits has %zu numbers; it must have at most %d",
                            g->elements, ELEMENTS);
done:
    return status;
}

enum kd_status kd_uvfits_open(const struct file *f, struct groups *g)
{
    size_t axes = 0;
    double bitpix;
    enum kd_status status;
    *g = (struct groups) { .elements = 1, .channels = 1, .ifs = 1 };
    KD_TRY(read_header(f, 0, &g->hdu));
    const char *groups = find_card(&g->hdu, "GROUPS");
    if (!groups || groups[strspn(groups, " ")] != 'T' || number_or(&g->hdu, "NAXIS1", -1) != 0)
        return kd_error_set(
            f->error, KD_EINVAL,
            "this FITS file is not uvfits: GROUPS must be T and NAXIS1 0 (an image is not an observation)");
    if (!read_number(&g->hdu, "BITPIX", &bitpix) || (bitpix != -32 && bitpix != -64))
        return kd_error_set(f->error, KD_EINVAL, "BITPIX of the uvfits must be -32 or -64");
    g->bytes = bitpix == -64 ? 8 : 4;
    KD_TRY(read_whole(f, &g->hdu, "NAXIS", 4, AXES, &axes));
    for (int axis = 2; axis <= (int)axes; axis++)
        KD_TRY(read_axis(f, g, axis));
    if (!g->hands)
        return kd_error_set(f->error, KD_EINVAL, "the uvfits must have an axis STOKES");
    KD_TRY(read_whole(f, &g->hdu, "PCOUNT", 4, PARAMETERS, &g->parameters));
    KD_TRY(read_whole(f, &g->hdu, "GCOUNT", 1, KD_OBSERVATION_ROWS, &g->n));
    KD_TRY(find_parameters(f, g));
    g->scale = number_or(&g->hdu, "BSCALE", 1), g->zero = number_or(&g->hdu, "BZERO", 0);
    if (!isfinite(g->scale) || g->scale == 0 || !isfinite(g->zero))
        return kd_error_set(f->error, KD_EINVAL,
                            "BSCALE and BZERO of the uvfits are %g and %g; BSCALE must be a number other than 0, and "
                            "BZERO a number",
                            g->scale, g->zero);
    /* This product, and the one below, cannot overflow: the size is at most 2^19, and there are at most 2^20 groups. */
    const size_t group = (g->parameters + g->elements) * g->bytes;
    if ((uint64_t)group * g->n > f->size - g->hdu.begin)
        return kd_error_set(
            f->error, KD_EINVAL,
            "the uvfits has %zu groups of %zu bytes from byte %zu on; it must have %llu bytes, but has %zu", g->n,
            group, g->hdu.begin, (unsigned long long)((uint64_t)group * g->n + g->hdu.begin), f->size);
    g->hdu.size = group * g->n;
done:
    return status;
}

double kd_uvfits_parameter(const struct groups *g, const uint8_t *group, const struct parameter *p)
{
    return p->there ? kd_uvfits_number(group + p->at * g->bytes, g->bytes == 8) * p->scale + p->zero : 0;
}

/* Mean of one polarization over the channels, weighted by their weights. Returns the sum of the weights, which is 0 if
 * there are no data. */
static double mean_of(const struct groups *g, const uint8_t *data, size_t hand, double mean[2])
{
    double weight = 0;
    mean[0] = mean[1] = 0;
    for (size_t i = 0; i < g->ifs * g->channels; i++) {
        const size_t at = hand * g->hand_step + i / g->channels * g->if_step + i % g->channels * g->channel_step;
        const uint8_t *three = data + at * g->bytes;
        const double w = kd_uvfits_number(three + 2 * g->bytes, g->bytes == 8);
        if (!(w > 0 && isfinite(w)))
            continue;
        weight += w;
        for (size_t k = 0; k < 2; k++)
            mean[k] += w * (kd_uvfits_number(three + k * g->bytes, g->bytes == 8) * g->scale + g->zero);
    }
    for (size_t k = 0; k < 2 && weight > 0; k++)
        mean[k] /= weight;
    return weight;
}

/* Error that belongs to a weight. As in ehtim, it is computed in single precision, in which weights are stored. The
 * precision matters: where an amplitude is about as large as its error, sqrt(|V|^2 - sigma^2) depends on rounding of
 * the error. */
static double error_of(double weight) { return (double)(1 / sqrtf((float)weight)); }

/* Reads Stokes I and its error. Returns false if no weight is positive. */
bool kd_uvfits_light(const struct groups *g, const uint8_t *data, struct kd_measured *m)
{
    double value[2][2], weight[2] = { 0 };
    for (size_t hand = 0; hand < (g->circular ? 2u : 1u) && hand < g->hands; hand++)
        weight[hand] = mean_of(g, data, hand, value[hand]);
    if (!(weight[0] > 0) && !(weight[1] > 0))
        return false;
    if (weight[0] > 0 && weight[1] > 0) {
        m->re = 0.5 * (value[0][0] + value[1][0]), m->im = 0.5 * (value[0][1] + value[1][1]);
        m->sigma = 0.5 * hypot(error_of(weight[0]), error_of(weight[1]));
        return true;
    }
    const int hand = weight[0] > 0 ? 0 : 1;
    m->re = value[hand][0], m->im = value[hand][1], m->sigma = error_of(weight[hand]);
    return true;
}

static enum kd_status place_of(const struct file *f, const struct kd_observation *o, const struct stations *s,
                               size_t group, uint32_t number, uint8_t *out)
{
    for (uint32_t i = 0; i < o->stations; i++)
        if (s->number[i] == number) {
            *out = (uint8_t)i;
            return KD_OK;
        }
    return kd_error_set(f->error, KD_EINVAL,
                        "visibility %zu of the uvfits is of station %u; it must be of a station in the table AIPS AN",
                        group + 1, number);
}

static enum kd_status read_group(const struct file *f, const struct groups *g, const struct stations *s, size_t i,
                                 struct kd_observation *o)
{
    const uint8_t *group = f->data + g->hdu.begin + i * (g->parameters + g->elements) * g->bytes;
    struct kd_measured m = { .source = (uint32_t)i };
    const double baseline = kd_uvfits_parameter(g, group, &g->baseline);
    enum kd_status status = KD_OK;
    if (!kd_uvfits_light(g, group + g->parameters * g->bytes, &m)) {
        o->flagged++;
        return KD_OK;
    }
    if (!(baseline >= 257 && baseline < 65536))
        return kd_error_set(f->error, KD_EINVAL,
                            "BASELINE of visibility %zu of the uvfits is %g; it must be 256 times the number of one "
                            "station plus that of another",
                            i + 1, baseline);
    KD_TRY(place_of(f, o, s, i, (uint32_t)baseline / 256, &m.station[0]));
    KD_TRY(place_of(f, o, s, i, (uint32_t)baseline % 256, &m.station[1]));
    /* a Julian date at first, which count_hours converts */
    m.hour = kd_uvfits_parameter(g, group, &g->date[0]) + kd_uvfits_parameter(g, group, &g->date[1]);
    m.u = kd_uvfits_parameter(g, group, &g->u) * o->frequency_hz,
    m.v = kd_uvfits_parameter(g, group, &g->v) * o->frequency_hz;
    if (!(fabs(m.hour) < 1e7))
        return kd_error_set(f->error, KD_EINVAL, "DATE of visibility %zu of the uvfits is %g; it must be a Julian date",
                            i + 1, m.hour);
    o->at[o->n++] = m;
done:
    return status;
}

/* Converts Julian dates to hours since 0 h of the first day. */
static void count_hours(struct kd_observation *o)
{
    double first = INFINITY;
    for (size_t i = 0; i < o->n; i++)
        first = fmin(first, o->at[i].hour);
    o->mjd = isfinite(first) ? floor(first - 2400000.5) : 0;
    for (size_t i = 0; i < o->n; i++)
        o->at[i].hour = (o->at[i].hour - 2400000.5 - o->mjd) * 24;
}

enum kd_status kd_observation_read_uvfits(const uint8_t *data, size_t size, struct kd_observation *out,
                                          struct kd_error *error)
{
    const struct file f = { data, size, error };
    struct groups groups;
    struct stations stations = { 0 };
    struct hdu table;
    double frequency;
    enum kd_status status;
    KD_TRY(kd_uvfits_open(&f, &groups));
    KD_TRY(find_stations(&f, groups.hdu.begin + (groups.hdu.size + BLOCK - 1) / BLOCK * BLOCK, &table));
    KD_TRY(read_stations(&f, &table, out, &stations));
    read_text(&groups.hdu, "OBJECT", out->source, sizeof out->source);
    frequency = number_or(&table, "FREQ", NAN);
    if (!(frequency > 0 && frequency < 1e18))
        return kd_error_set(error, KD_EINVAL, "FREQ of the table AIPS AN is %g; it must be above 0 and below 1e18 Hz",
                            frequency);
    out->frequency_hz = frequency;
    if (!(out->at = malloc(groups.n * sizeof *out->at)))
        return kd_error_set(error, KD_ENOMEM, "out of memory for %zu visibilities", groups.n);
    for (size_t i = 0; i < groups.n; i++)
        KD_TRY(read_group(&f, &groups, &stations, i, out));
    count_hours(out);
done:
    return status;
}
