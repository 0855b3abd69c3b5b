#include "orbit/answer.h"

#include "base/decimal.h"
#include "base/pause.h"
#include "image/npy.h"
#include "physics/math/constants.h"
#include "physics/spacetime/kerr.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define CENTURY_S (36525 * 86400.)

enum {
    PLAIN = 10,
    COLUMNS = 17,
    SUMMARY = 15
}; /* numbers of columns. PLAIN: series without an observer. COLUMNS: series with an observer. SUMMARY: summary */

static const char *const columns[COLUMNS] = { "mino",  "tau_proper", "t",     "r",  "theta",
                                              "phi",   "x",          "y",     "z",  "energy_error",
                                              "alpha", "beta",       "right", "up", "inwards",
                                              "delay", "off" };

const char *kd_orbit_column(size_t index) { return index < COLUMNS ? columns[index] : NULL; }

_Static_assert((int)COLUMNS <= (int)KD_NPY_FIELDS, "an array has room for them");
static int count_of(const struct kd_orbit_params *params) { return kd_orbit_is_seen(params) ? COLUMNS : PLAIN; }

static void columns_of(const struct kd_orbit_sample *s, double to[COLUMNS])
{
    const double all[COLUMNS] = { s->place.mino,
                                  s->place.proper,
                                  s->place.t,
                                  s->place.r,
                                  s->place.theta,
                                  s->place.phi,
                                  s->x,
                                  s->y,
                                  s->z,
                                  s->energy_error,
                                  s->image.alpha,
                                  s->image.beta,
                                  s->image.look.right,
                                  s->image.look.up,
                                  s->image.look.inwards,
                                  s->image.delay,
                                  s->image.off };
    memcpy(to, all, sizeof all);
}

/* An output stream that stores its first failure. After a failure nothing more is written. */
struct text {
    struct kd_buffer *out;
    enum kd_status status;
    int digits; /* number of significant digits; 0 means all digits */
};

static void put(struct text *t, const char *s)
{
    if (!t->status)
        t->status = kd_buffer_append(t->out, s, strlen(s));
}

static void number(struct text *t, double value, const char *otherwise)
{
    char text[KD_DECIMAL_SIZE];
    if (isfinite(value))
        kd_decimal_print(text, t->digits ? kd_decimal_round(value, t->digits) : value);
    put(t, isfinite(value) ? text : otherwise);
}

/* Writes the member "name":value. A comma precedes it, except for the first member of an object. */
static void member(struct text *t, const char *name, double value)
{
    if (t->status)
        return;
    bool first = t->out->size && t->out->data[t->out->size - 1] == '{';
    t->status = kd_buffer_printf(t->out, "%s\"%s\":", first ? "" : ",", name);
    number(t, value, "null");
}

static void open(struct text *t, const char *name)
{
    bool first = t->out->size && t->out->data[t->out->size - 1] == '{';
    if (!t->status)
        t->status = kd_buffer_printf(t->out, "%s\"%s\":{", first ? "" : ",", name);
}

static void close(struct text *t) { put(t, "}"); }

const char *kd_orbit_approximation(const struct kd_orbit_run *run, size_t index)
{
    const char *const all[] = {
        "the body is a test particle: it has no gravity of its own, does not radiate, and is not disrupted by tides",
        run->orbit.fate == KD_ORBIT_PLUNGE
            ? "Boyer-Lindquist t and phi grow without bound towards the horizon, at which a path ends"
            : NULL,
        kd_orbit_is_seen(run->params)
            ? "each point has one image, which continues the image of the point before; this is the direct image, "
              "except that close to a spinning hole seen nearly edge on it may become an image whose light has gone "
              "round the hole; points within 1.2 horizon radii have no image"
            : NULL,
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (all[i] && !index--)
            return all[i];
    const struct kd_hole_sentence *of_hole = kd_hole_sentence(kd_hole_told(&run->orbit.hole), index);
    return of_hole ? of_hole->text : NULL;
}

static void frequencies(struct text *t, const struct kd_orbit_run *run)
{
    const struct kd_orbit_frequencies *f = &run->frequencies;
    open(t, "frequencies");
    open(t, "mino");
    member(t, "r", f->mino_r);
    member(t, "theta", f->mino_theta);
    member(t, "phi", f->mino_phi);
    member(t, "t", f->mino_t);
    member(t, "tau_proper", f->mino_proper);
    close(t);
    open(t, "coordinate");
    member(t, "r", f->r);
    member(t, "theta", f->theta);
    member(t, "phi", f->phi);
    close(t);
    open(t, "proper");
    member(t, "r", f->mino_r / f->mino_proper);
    member(t, "theta", f->mino_theta / f->mino_proper);
    member(t, "phi", f->mino_phi / f->mino_proper);
    close(t);
    if (!isnan(run->mass_msun)) {
        open(t, "hz");
        double cycles = 1 / (2 * M_PI * KD_M_SUN_S * run->mass_msun);
        member(t, "r", f->r * cycles);
        member(t, "theta", f->theta * cycles);
        member(t, "phi", f->phi * cycles);
        close(t);
    }
    close(t);
}

/* Advance of the periastron. It is undefined for a circle, which has no periastron. The formula would give the advance
 * for infinitesimal oscillations about the circle, which is infinite at the ISCO. */
static double periastron_advance(const struct kd_orbit_run *run)
{
    return run->closed && !run->orbit.circular ? kd_orbit_periastron_advance(&run->bound) : NAN;
}

/* Writes advances per radial period. An orbit in the equatorial plane has no node. */
static void advances(struct text *t, const struct kd_orbit_run *run, double p)
{
    double advance = periastron_advance(run);
    open(t, "advance");
    member(t, "periastron", advance);
    member(t, "weak_field", run->orbit.circular ? NAN : kd_kerr_weak_advance(&run->orbit.hole, p));
    member(t, "node", run->orbit.z > 0 ? kd_orbit_nodal_advance(&run->bound) : NAN);
    if (!isnan(run->mass_msun)) {
        double period_s = 2 * M_PI / run->frequencies.r * KD_M_SUN_S * run->mass_msun;
        member(t, "periastron_arcsec_per_century", advance * 180 / M_PI * 3600 * CENTURY_S / period_s);
    }
    close(t);
}

static void head(struct text *t, const struct kd_orbit_run *run)
{
    const struct kd_orbit *o = &run->orbit;
    double swing = asin(fmin(sqrt(o->z), 1)) * 180 / M_PI;
    member(t, "spin", o->hole.a);
#define MORE(x, name, of, ...) \
    if (o->hole.of != 0) \
        member(t, #name, o->hole.of);
    KD_HOLE_MORE(MORE, )
#undef MORE
    put(t, ",\"fate\":\"");
    put(t, kd_orbit_fate_name(o->fate));
    put(t, o->circular ? "\",\"circular\":true" : "\",\"circular\":false");
    open(t, "constants");
    member(t, "energy", o->energy);
    member(t, "binding", o->binding);
    member(t, "angular_momentum", o->momentum);
    member(t, "carter", o->carter);
    if (o->hole.a == 0)
        member(t, "binet_c", -o->binding / o->total);
    close(t);
    open(t, "turning_points");
    member(t, "r_min", o->turns_in ? 1 / o->w_high : NAN);
    member(t, "r_max", o->turns_out ? 1 / o->w_low : NAN);
    member(t, "theta_min_deg", 90 - swing);
    member(t, "theta_max_deg", o->carter < 0 ? NAN : 90 + swing);
    close(t);
    if (!run->closed)
        return;
    double p = 2 / (o->w_low + o->w_high);
    open(t, "shape");
    member(t, "p", p);
    member(t, "e", (o->w_high - o->w_low) / (o->w_high + o->w_low));
    member(t, "inclination_deg", acos(copysign(fmin(sqrt(o->axis_gap), 1), o->momentum)) * 180 / M_PI);
    close(t);
    frequencies(t, run);
    advances(t, run, p);
}

static void drift(struct text *t, const struct kd_orbit_run *run)
{
    open(t, "drift"); /* drifts of E and Q; L is a parameter of the equations and does not drift */
    member(t, "energy", run->worst.energy);
    member(t, "angular_momentum", 0);
    member(t, "carter", run->worst.carter);
    member(t, "mass", run->worst.mass);
    if (run->orbit.hole.a == 0)
        member(t, "binet_c", run->worst.binet);
    close(t);
}

/* Writes the difference between the end of the integrated path and that of the closed form, which are independent
 * methods. */
static void against_closed(struct text *t, const struct kd_orbit_run *run)
{
    struct kd_orbit_place got = kd_orbit_path_place(&run->path),
                          want = kd_orbit_bound_at(&run->bound, run->path.mino.value);
    open(t, "closed_form_difference");
    member(t, "tau_proper", got.proper - want.proper);
    member(t, "t", got.t - want.t);
    member(t, "r", got.r - want.r);
    member(t, "theta", got.theta - want.theta);
    member(t, "phi", got.phi - want.phi);
    close(t);
}

static void result(struct text *t, const struct kd_orbit_run *run)
{
    bool closed = run->params->way == KD_WAY_CLOSED;
    const char *sentence;
    put(t, "\"method\":\"");
    put(t, kd_orbit_way_name(run->params->way));
    put(t, "\",\"end\":\"");
    put(t, kd_orbit_end_name(run->end));
    put(t, "\"");
    member(t, "mino_end", run->mino_end);
    if (!closed) {
        member(t, "steps", (double)run->steps);
        member(t, "mino_step", run->h);
    }
    if (!closed || !isnan(run->error_estimate))
        member(t, "error_estimate", run->error_estimate);
    if (!closed) {
        drift(t, run);
        if (run->closed && !run->orbit.circular) {
            member(t, "periastra", (double)run->periastra);
            member(t, "periastron_advance_measured", kd_orbit_run_advance_measured(run));
        }
        if (run->closed)
            against_closed(t, run);
    }
    put(t, ",\"approximations\":[");
    for (size_t i = 0; (sentence = kd_orbit_approximation(run, i)); i++) {
        put(t, i ? ",\"" : "\"");
        put(t, sentence);
        put(t, "\"");
    }
    put(t, "]");
}

static void column_names(struct text *t, int n)
{
    put(t, "\"columns\":[");
    for (int i = 0; i < n; i++) {
        put(t, i ? ",\"" : "\"");
        put(t, columns[i]);
        put(t, "\"");
    }
    put(t, "]");
}

static void json_row(struct text *t, const struct kd_orbit_sample *sample, int n, bool first)
{
    double values[COLUMNS];
    columns_of(sample, values);
    put(t, first ? "[" : ",[");
    for (int i = 0; i < n; i++) {
        put(t, i ? "," : "");
        number(t, values[i], "null");
    }
    put(t, "]");
}

static void csv_names(struct text *t, const char *const *names, int n)
{
    for (int i = 0; i < n; i++) {
        put(t, i ? "," : "");
        put(t, names[i]);
    }
    put(t, "\n");
}

static void csv_row(struct text *t, const double *values, int n)
{
    for (int i = 0; i < n; i++) {
        put(t, i ? "," : "");
        number(t, values[i], "");
    }
    put(t, "\n");
}

/* Appends doubles in little-endian order, on any machine. */
static void bytes(struct text *t, const double *values, int n)
{
    for (int i = 0; i < n && !t->status; i++) {
        uint64_t bits;
        uint8_t out[8];
        memcpy(&bits, &values[i], sizeof bits);
        for (int k = 0; k < 8; k++)
            out[k] = (uint8_t)(bits >> 8 * k);
        t->status = kd_buffer_append(t->out, out, sizeof out);
    }
}

static void npy_head(struct text *t, const char *const *names, int n, uint64_t first, uint64_t second)
{
    struct kd_npy array = { .n_fields = (size_t)n, .shape = { first, second }, .n_dimensions = second ? 2 : 1 };
    for (int i = 0; i < n; i++) {
        snprintf(array.fields[i].name, KD_NPY_NAME, "%s", names[i]);
        array.fields[i].type = KD_NPY_F8;
    }
    if (!t->status)
        t->status = kd_npy_write_header(&array, t->out);
}

enum kd_status kd_orbit_answer_begin(const struct kd_orbit_run *run, enum kd_orbit_format format, struct kd_buffer *out)
{
    struct text t = { .out = out };
    switch (format) {
    case KD_ORBIT_JSON:
        put(&t, "{");
        head(&t, run);
        if (run->samples) {
            put(&t, ",\"series\":{");
            column_names(&t, count_of(run->params));
            put(&t, ",\"rows\":[");
        }
        break;
    case KD_ORBIT_NDJSON:
        put(&t, "{\"head\":{");
        head(&t, run);
        put(&t, "}}\n{");
        column_names(&t, count_of(run->params));
        put(&t, "}\n");
        break;
    case KD_ORBIT_CSV: csv_names(&t, columns, count_of(run->params)); break;
    case KD_ORBIT_NPY: npy_head(&t, columns, count_of(run->params), run->samples, 0); break;
    }
    return t.status;
}

enum kd_status kd_orbit_answer_samples(const struct kd_orbit_params *params, enum kd_orbit_format format,
                                       const struct kd_orbit_sample *samples, size_t n, size_t first,
                                       struct kd_buffer *out)
{
    struct text t = { .out = out, .digits = (int)params->digits };
    double values[COLUMNS];
    if (format == KD_ORBIT_NDJSON)
        put(&t, "{\"rows\":[");
    for (size_t i = 0; i < n && !t.status; i++) {
        kd_pause_every(i, 64);
        columns_of(&samples[i], values);
        switch (format) {
        case KD_ORBIT_JSON: json_row(&t, &samples[i], count_of(params), !(first + i)); break;
        case KD_ORBIT_NDJSON: json_row(&t, &samples[i], count_of(params), !i); break;
        case KD_ORBIT_CSV: csv_row(&t, values, count_of(params)); break;
        case KD_ORBIT_NPY: bytes(&t, values, count_of(params)); break;
        }
    }
    if (format == KD_ORBIT_NDJSON)
        put(&t, "]}\n");
    return t.status;
}

enum kd_status kd_orbit_answer_progress(const struct kd_orbit_run *run, struct kd_buffer *out)
{
    return kd_buffer_printf(out, "{\"progress\":%.4f}\n", kd_orbit_run_fraction(run));
}

enum kd_status kd_orbit_answer_end(const struct kd_orbit_run *run, enum kd_orbit_format format, struct kd_buffer *out)
{
    struct text t = { .out = out };
    if (format == KD_ORBIT_JSON) {
        put(&t, run->samples ? "]},\"result\":{" : ",\"result\":{");
        result(&t, run);
        put(&t, "}}\n");
    } else if (format == KD_ORBIT_NDJSON) {
        put(&t, "{\"result\":{");
        result(&t, run);
        put(&t, "}}\n");
    }
    return t.status;
}

static const char *const summary_names[SUMMARY] = { "fate",
                                                    "spin",
                                                    "energy",
                                                    "angular_momentum",
                                                    "carter",
                                                    "r_min",
                                                    "r_max",
                                                    "omega_r",
                                                    "omega_theta",
                                                    "omega_phi",
                                                    "periastron_advance",
                                                    "advance_measured",
                                                    "energy_drift",
                                                    "carter_drift",
                                                    "error_estimate" };

/* Numbers of a summary. The fate is 0 for bound, 1 for plunge, 2 for escape. */
static void summary_of(const struct kd_orbit_run *run, double to[SUMMARY])
{
    const struct kd_orbit *o = &run->orbit;
    const struct kd_orbit_frequencies *f = &run->frequencies;
    bool closed = run->params->way == KD_WAY_CLOSED;
    const double all[SUMMARY] = { o->fate,
                                  o->hole.a,
                                  o->energy,
                                  o->momentum,
                                  o->carter,
                                  o->turns_in ? 1 / o->w_high : NAN,
                                  o->turns_out ? 1 / o->w_low : NAN,
                                  run->closed ? f->r : NAN,
                                  run->closed ? f->theta : NAN,
                                  run->closed ? f->phi : NAN,
                                  periastron_advance(run),
                                  kd_orbit_run_advance_measured(run),
                                  closed ? NAN : run->worst.energy,
                                  closed ? NAN : run->worst.carter,
                                  run->error_estimate };
    memcpy(to, all, sizeof all);
}

static void many_json(struct text *t, const struct kd_orbit_run *runs, size_t n, const struct kd_orbit_sample *samples)
{
    put(t, "{\"orbits\":[");
    for (size_t i = 0; i < n && !t->status; i++) {
        kd_pause_every(i, 16);
        put(t, i ? ",\n" : "\n");
        t->status = t->status ? t->status : kd_orbit_answer_begin(&runs[i], KD_ORBIT_JSON, t->out);
        if (samples && !t->status)
            t->status = kd_orbit_answer_samples(runs[i].params, KD_ORBIT_JSON, samples + i * runs[i].samples,
                                                runs[i].samples, 0, t->out);
        if (!t->status)
            t->status = kd_orbit_answer_end(&runs[i], KD_ORBIT_JSON, t->out);
        t->out->size -= !t->status; /* after a success, removes the last byte, which is a newline */
    }
    put(t, "\n]}\n");
}

enum kd_status kd_orbit_answer_many(const struct kd_orbit_run *runs, size_t n, const struct kd_orbit_sample *samples,
                                    enum kd_orbit_format format, struct kd_buffer *out)
{
    struct text t = { .out = out };
    double values[SUMMARY];
    if (format == KD_ORBIT_JSON) {
        many_json(&t, runs, n, samples);
        return t.status;
    }
    const char *const *names = samples ? columns : summary_names;
    int count = samples ? PLAIN : SUMMARY; /* orbits of a batch have no observer */
    if (format == KD_ORBIT_NPY)
        npy_head(&t, names, count, n, samples ? runs->samples : 0);
    else
        csv_names(&t, names, count);
    for (size_t i = 0; i < n && !t.status; i++) {
        kd_pause_every(i, 64);
        if (samples) {
            t.status =
                kd_orbit_answer_samples(runs[i].params, format, samples + i * runs[i].samples, runs[i].samples, 0, out);
            continue;
        }
        summary_of(&runs[i], values);
        if (format == KD_ORBIT_NPY)
            bytes(&t, values, SUMMARY);
        else
            csv_row(&t, values, SUMMARY);
    }
    return t.status;
}
