/* Reads the EHT's CSV of Stokes I (data product 2019-D01-01): a line about the observation, a line of column names, and
 * a line for each visibility:
 *
 *     #SRC:M87,DATE(MJD):57848,FREQ:227.0707GHz
 *     #time(UTC),T1,T2,U(lambda),V(lambda),Iamp(Jy),Iphase(d),Isigma(Jy)
 *     00.76805556,AA,PV,-4361512960.0000,-4470103552.0000,0.15033433,172.4572,0.00471922
 *
 * Stations are sorted alphabetically, as in the uvfits of the same data. */
#include "observe/observe_internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define COLUMNS "#time(UTC),T1,T2,U(lambda),V(lambda),Iamp(Jy),Iphase(d),Isigma(Jy)"
enum { FIELDS = 8, LINE_MAX_BYTES = 400, NUMBER = 40 };

struct line {
    const char *text;
    size_t length, number;
};

/* Reads the next line, without its line feed. Returns false at the end of the text. */
static bool next_line(const char **at, const char *end, struct line *line)
{
    if (*at == end)
        return false;
    const char *stop = memchr(*at, '\n', (size_t)(end - *at));
    line->text = *at;
    line->length = (size_t)((stop ? stop : end) - *at);
    line->number++;
    *at = stop ? stop + 1 : end;
    if (line->length && line->text[line->length - 1] == '\r')
        line->length--;
    return true;
}

/* Reads a number. The whole text must be that one number. */
static bool read_number(const char *text, size_t length, double *out)
{
    char copy[NUMBER], *end;
    if (!length || length >= sizeof copy)
        return false;
    memcpy(copy, text, length);
    copy[length] = 0;
    *out = strtod(copy, &end);
    return end == copy + length && copy[0] != ' ' && isfinite(*out);
}

/* Finds the text between a name and the next comma. */
static bool find_value(const struct line *line, const char *name, const char **value, size_t *length)
{
    const size_t n = strlen(name);
    for (size_t i = 0; i + n <= line->length; i++)
        if ((!i || line->text[i - 1] == ',' || line->text[i - 1] == '#') && !memcmp(line->text + i, name, n)) {
            *value = line->text + i + n;
            for (*length = 0; i + n + *length < line->length && (*value)[*length] != ',';)
                ++*length;
            return true;
        }
    return false;
}

static enum kd_status read_head(const struct line *line, struct kd_observation *o, struct kd_error *error)
{
    const char *value;
    size_t length;
    if (!find_value(line, "SRC:", &value, &length) || !length || length >= sizeof o->source)
        return kd_error_set(error, KD_EINVAL, "line 1 must name its source, as in #SRC:M87");
    for (size_t i = 0; i < length; i++)
        o->source[i] = value[i] >= ' ' && value[i] <= '~' ? value[i] : '?';
    if (!find_value(line, "DATE(MJD):", &value, &length) || !read_number(value, length, &o->mjd) || o->mjd < 0 ||
        o->mjd > 1e6 || o->mjd != floor(o->mjd))
        return kd_error_set(error, KD_EINVAL,
                            "line 1 must have a date, a whole number of days up to 1000000, as in "
                            "DATE(MJD):57848");
    if (!find_value(line, "FREQ:", &value, &length) || length < 4 || memcmp(value + length - 3, "GHz", 3) ||
        !read_number(value, length - 3, &o->frequency_hz) || !(o->frequency_hz > 0 && o->frequency_hz < 1e9))
        return kd_error_set(error, KD_EINVAL, "line 1 must have a frequency above 0, as in FREQ:227.0707GHz");
    o->frequency_hz *= 1e9;
    return KD_OK;
}

static enum kd_status place_of(struct kd_observation *o, const char *text, size_t length, uint8_t *out,
                               struct kd_error *error)
{
    char name[KD_STATION_NAME];
    enum kd_status status = kd_station_name(name, text, length, error);
    uint32_t i = 0;
    while (!status && i < o->stations && strcmp(o->station[i], name))
        i++;
    if (!status && i == KD_OBSERVATION_STATIONS)
        return kd_error_set(error, KD_EINVAL, "%s is station %u; there must be at most %u", name, i + 1,
                            KD_OBSERVATION_STATIONS);
    if (!status && i == o->stations)
        memcpy(o->station[o->stations++], name, sizeof name);
    *out = (uint8_t)i;
    return status;
}

static enum kd_status read_fields(const struct line *line, struct kd_observation *o, struct kd_measured *m,
                                  struct kd_error *error)
{
    static const char *const names[FIELDS] = { "time", "", "", "u", "v", "amplitude", "phase", "error" };
    const char *at = line->text, *end = line->text + line->length;
    double number[FIELDS] = { 0 };
    for (int i = 0; i < FIELDS; i++) {
        const char *comma = memchr(at, ',', (size_t)(end - at));
        const size_t length = (size_t)((comma ? comma : end) - at);
        if (!comma != (i + 1 == FIELDS))
            return kd_error_set(error, KD_EINVAL, "there must be %d fields, as " COLUMNS, FIELDS);
        if (i == 1 || i == 2) {
            enum kd_status status = place_of(o, at, length, &m->station[i - 1], error);
            if (status)
                return status;
        } else if (!read_number(at, length, &number[i])) {
            return kd_error_set(error, KD_EINVAL, "its %s is \"%.*s\"; it must be a number", names[i],
                                (int)(length < NUMBER ? length : NUMBER), at);
        }
        at = comma ? comma + 1 : end;
    }
    const double phase = number[6] * (M_PI / 180);
    m->hour = number[0], m->u = number[3], m->v = number[4], m->sigma = number[7];
    m->re = number[5] * cos(phase), m->im = number[5] * sin(phase);
    return KD_OK;
}

static enum kd_status read_row(const struct line *line, struct kd_observation *o, size_t *room, struct kd_error *error)
{
    if (o->n == KD_OBSERVATION_ROWS)
        return kd_error_set(error, KD_EINVAL, "it is visibility %zu; there must be at most %u", o->n + 1,
                            KD_OBSERVATION_ROWS);
    if (o->n == *room) {
        const size_t more = *room ? 2 * *room : 1024;
        struct kd_measured *at = realloc(o->at, more * sizeof *at);
        if (!at)
            return kd_error_set(error, KD_ENOMEM, "out of memory for %zu visibilities", more);
        o->at = at, *room = more;
    }
    o->at[o->n] = (struct kd_measured) { 0 };
    enum kd_status status = read_fields(line, o, &o->at[o->n], error);
    o->n += !status;
    return status;
}

static int by_name(const void *a, const void *b) { return strcmp(a, b); }

/* Sorts the stations alphabetically. */
static void sort_stations(struct kd_observation *o)
{
    char before[KD_OBSERVATION_STATIONS][KD_STATION_NAME];
    uint8_t now[KD_OBSERVATION_STATIONS] = { 0 };
    memcpy(before, o->station, sizeof before);
    qsort(o->station, o->stations, sizeof o->station[0], by_name);
    for (uint32_t i = 0; i < o->stations; i++)
        while (strcmp(o->station[now[i]], before[i]))
            now[i]++;
    for (size_t i = 0; i < o->n; i++)
        o->at[i].station[0] = now[o->at[i].station[0]], o->at[i].station[1] = now[o->at[i].station[1]];
}

enum kd_status kd_observation_read_csv(const char *text, size_t size, struct kd_observation *out,
                                       struct kd_error *error)
{
    const char *at = text, *end = text + size;
    struct line line = { 0 };
    bool columns = false;
    size_t room = 0;
    enum kd_status status = KD_OK;
    while (!status && next_line(&at, end, &line)) {
        if (line.length > LINE_MAX_BYTES)
            status = kd_error_set(error, KD_EINVAL, "it has %zu bytes; it must have at most %d", line.length,
                                  LINE_MAX_BYTES);
        else if (line.number == 1)
            status = read_head(&line, out, error);
        else if (line.length == sizeof COLUMNS - 1 && !memcmp(line.text, COLUMNS, line.length))
            columns = true;
        else if (line.length && *line.text == '#')
            status = columns ? KD_OK
                             : kd_error_set(error, KD_EINVAL, "the columns are \"%.*s\"; they must be " COLUMNS,
                                            (int)(line.length < 120 ? line.length : 120), line.text);
        else if (line.length)
            status = columns ? read_row(&line, out, &room, error)
                             : kd_error_set(error, KD_EINVAL, "a line of columns must come before it: " COLUMNS);
    }
    if (!status && room)
        sort_stations(out);
    if (status == KD_EINVAL && error) {
        struct kd_error inner = *error;
        kd_error_set(error, KD_EINVAL, "line %zu of the CSV: %s", line.number, inner.message);
    }
    return status;
}
