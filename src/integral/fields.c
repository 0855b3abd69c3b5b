/* The table of request fields, and their JSON Schema. */
#include "base/schema.h"
#include "integral/apart.h"
#include "integral/request.h"
#include "integral/sets.h"
#include "physics/disk/disk_image.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define AT(member) offsetof(struct kd_integral_request, member)
#define LINE (1u << KD_INTEGRAL_LINE)
#define TRANSFER (1u << KD_INTEGRAL_TRANSFER)
#define SPECTRUM (1u << KD_INTEGRAL_SPECTRUM)
#define VOLUME (1u << KD_INTEGRAL_VOLUME)
#define VISIBILITY (1u << KD_INTEGRAL_VISIBILITY)
#define COMPARE (1u << KD_INTEGRAL_COMPARE | 1u << KD_INTEGRAL_SETS)
#define OBSERVE (1u << KD_INTEGRAL_OBSERVE)
#define ALL (LINE | TRANSFER | SPECTRUM)
#define REAL(name, unit, least, most, of, help) \
    { #name, unit, help, KD_INTEGRAL_REAL, AT(name), least, most, false, NULL, of, false }
#define OR_WORD(name, unit, least, most, word, of, help) \
    { #name, unit, help, KD_INTEGRAL_REAL, AT(name), least, most, false, word, of, false }
#define WORD(name, member, words, of, help) \
    { #name, "", help, KD_INTEGRAL_WORD, AT(member), 0, 0, false, words, of, false }
#define INT(name, least, most, of, help) \
    { #name, "", help, KD_INTEGRAL_INT, AT(name), least, most, false, NULL, of, false }
#define WORDS(name, words, least, of, help) \
    { #name, "", help, KD_INTEGRAL_WORDS, AT(name), least, 0, false, words, of, false }
#define MEMBER(name, member, unit, least, most, of, help) \
    { #name, unit, help, KD_INTEGRAL_REAL, AT(member), least, most, false, NULL, of, false }
#define NUMBERS(name, unit, least, most, of, help) \
    { #name, unit, help, KD_INTEGRAL_NUMBERS, AT(name), least, most, false, NULL, of, false }

const struct kd_integral_field kd_integral_fields[] = {
    { "spin", "M", "spin of the hole; below 0 the disk rotates against the hole", KD_INTEGRAL_REAL, AT(spin), -1, 1,
      true, NULL, ALL, false },
    REAL(inclination_deg, "deg", 0, 180, ALL,
         "angle between the axis and the observer, who is at infinity; not 87 to 93"),
    OR_WORD(inner, "M", 1, 1e6, "isco", ALL, "inner edge of the disk, the ISCO or beyond"),
    REAL(outer, "M", 1, 1e6, ALL, "outer edge of the disk"),
    WORD(emissivity, emissivity, "power|broken|lamppost", LINE, "emissivity of the line as a function of radius"),
    REAL(index, "", -10, 20, LINE, "power and broken: the light per area falls as r^-index"),
    REAL(outer_index, "", -10, 20, LINE, "broken: index beyond break_r"),
    REAL(break_r, "M", 1, 1e6, LINE, "broken: radius at which the index changes"),
    REAL(height, "M", 1, 1e4, LINE, "lamppost: height of the source on the axis"),
    REAL(photon_index, "", 0, 10, LINE, "lamppost: photon index of the source's power law"),
    WORD(limb, limb, "isotropic|laor|haardt|scattering", LINE | SPECTRUM,
         "dependence of the light on mu, the cosine of the angle from the disk's normal: none, 1 + 2.06 mu, ln(1 + "
         "1/mu), or that of a deep atmosphere of free electrons"),
    REAL(tolerance, "", 0, 0.1, LINE,
         "accepted error of the cumulative share: sums are refined until they meet it, or to the finest level; 0: "
         "always to the finest level"),
    WORD(counts, energy, "photons|energy", LINE, "quantity that a bin counts"),
    REAL(rest_energy, "", 1e-9, 1e9, LINE,
         "energy of the line in the gas's frame, in any unit; edges have the same unit"),
    REAL(energy_min, "", 0, 1e9, LINE, "first edge of bins of equal width"),
    OR_WORD(energy_max, "", 0, 1e9, "auto", LINE, "last edge; auto: 1.7 times rest_energy"),
    INT(bins, 1, KD_INTEGRAL_ROWS, LINE, "number of bins of equal width"),
    NUMBERS(edges, "", 0, 1e9, LINE,
            "edges of the bins in ascending order, instead of energy_min, energy_max and bins"),
    INT(rings, 1, 1000, TRANSFER, "number of radii, from inner to outer at equal ratios"),
    NUMBERS(radii, "M", 1, 1e6, TRANSFER, "radii, instead of rings; between inner and outer"),
    INT(g_stars, 1, 1000, TRANSFER, "number of values of g* at each radius: the centres of equal parts of 0 to 1"),
    { "g_star", "",
      "values of g* instead of g_stars, each between 0 (the reddest light of the ring) and 1 (the bluest)",
      KD_INTEGRAL_NUMBERS, AT(g_star), 0, 1, true, NULL, TRANSFER, false },
    REAL(mass_msun, "solar masses", 1e-5, 1e12, SPECTRUM, "mass of the hole"),
    REAL(distance_pc, "pc", 1e-3, 1e12, SPECTRUM, "distance of the hole"),
    REAL(mdot_edd, "Eddington rates", 1e-12, 1e3, SPECTRUM,
         "accretion rate as luminosity over the Eddington luminosity, with the efficiency of this spin"),
    REAL(colour_correction, "", 1, 10, SPECTRUM, "colour temperature over effective temperature"),
    OR_WORD(frequency_min_hz, "Hz", 1e-3, 1e25, "auto", SPECTRUM | VOLUME,
            "first frequency; auto: 0.001 k/h times the hottest ring's colour temperature; for a volume 1/30 of "
            "volume.frequency_ghz"),
    OR_WORD(frequency_max_hz, "Hz", 1e-3, 1e25, "auto", SPECTRUM | VOLUME,
            "last frequency; auto: 30 k/h times the hottest ring's colour temperature; for a volume 30 times "
            "volume.frequency_ghz"),
    INT(frequencies, 2, KD_INTEGRAL_FREQUENCIES, SPECTRUM | VOLUME,
        "number of frequencies, at equal ratios; default 200, for a volume 13 and at most 200"),
    NUMBERS(frequencies_hz, "Hz", 1e-3, 1e25, SPECTRUM | VOLUME,
            "frequencies, instead of frequency_min_hz, frequency_max_hz and frequencies"),
    { "u", "Gl", "eastward components of the baselines, in units of 1e9 wavelengths; as many as v", KD_INTEGRAL_NUMBERS,
      AT(u), -1e15, 1e15, false, NULL, VISIBILITY, false },
    { "v", "Gl", "northward components of the baselines", KD_INTEGRAL_NUMBERS, AT(v), -1e15, 1e15, false, NULL,
      VISIBILITY, false },
    NUMBERS(lengths, "Gl", 0, 1e15, VISIBILITY,
            "lengths of baselines, instead of u and v; each length is combined with each of angles_deg"),
    { "length_max", "Gl",
      "longest baseline, for lengths from 0 to it instead of lengths; auto: half of the longest baseline that the "
      "map's pixels resolve",
      KD_INTEGRAL_REAL, AT(length_max), 1e-9, 1e15, false, "auto", VISIBILITY, true },
    INT(baselines, 2, KD_INTEGRAL_ROWS, VISIBILITY, "number of lengths from 0 to length_max"),
    { "angles_deg", "deg", "position angles of the baselines given by lengths, from north to east; default 0 and 90",
      KD_INTEGRAL_NUMBERS, AT(angles_deg), -360, 360, false, NULL, VISIBILITY, false },
    INT(orders, 0, KD_INTEGRAL_ORDERS, VISIBILITY,
        "number of image orders, from order 0, whose visibilities are also given separately"),
    WORDS(products, "amplitude|closure_phase|log_closure_amplitude|visibility", 1, COMPARE,
          "quantities that are compared; visibility: real and imaginary parts, which need calibrated phases"),
    REAL(average_s, "s", 0, 86400, COMPARE,
         "length in seconds of the bins in which visibilities are averaged, counted from 1960-01-01; 0: no averaging"),
    REAL(uv_min_gl, "Gl", 0, 1e6, COMPARE,
         "shortest baseline that is compared, in units of 1e9 wavelengths; shorter ones, within one site, see light "
         "from outside the map"),
    REAL(snr_cut, "", 0, 1e6, COMPARE, "lowest signal-to-noise ratio of amplitudes and closures that are compared"),
    MEMBER(systematic.visibility, systematic_visibility, "", 0, 1, COMPARE,
           "share of each visibility's amplitude that is added to its error in quadrature, before all other steps"),
    MEMBER(systematic.amplitude, systematic_amplitude, "", 0, 1, COMPARE,
           "relative error of a station; sqrt(2) times it is added to an amplitude's error in quadrature"),
    MEMBER(systematic.closure_phase_deg, systematic_closure_phase_deg, "deg", 0, 180, COMPARE,
           "systematic error that is added to the error of a closure phase in quadrature"),
    WORD(debias, measured, "yes|no", COMPARE,
         "yes: amplitudes are sqrt(|V|^2 - sigma^2), also in closures; no: as measured"),
    WORD(closures, maximal, "minimal|maximal", COMPARE,
         "minimal: independent triangles and quadrangles with the first station; maximal: all"),
    WORD(pulse, pulse, "triangle|rectangle|point", COMPARE | OBSERVE, "shape of a pixel's light"),
    WORD(scattering, scattering, "none|sgra", COMPARE | OBSERVE,
         "interstellar scattering of the model: sgra: the average kernel towards Sagittarius A* at the observation's "
         "frequency"),
    { "flux_jy", "Jy",
      "flux to which the whole map is scaled; auto: the scene's flux; if its light has no frequency, a comparison "
      "takes "
      "the best fit to the amplitudes",
      KD_INTEGRAL_REAL, AT(flux_jy), 1e-12, 1e12, false, "auto", COMPARE | OBSERVE, true },
    WORDS(solve, "flux|size|position_angle|shift", 0, COMPARE,
          "quantities that are fitted for the smallest chi^2 of all data: flux, angular size, position angle, and the "
          "position, which needs the product visibility"),
    WORD(noise, noiseless, "yes|no", OBSERVE, "yes: Gaussian noise with the errors of the observation; no: none"),
    INT(seed, 0, 4294967295, OBSERVE, "seed of the noise"),
    INT(pixels, 16, 2048, VOLUME | VISIBILITY | COMPARE | OBSERVE,
        "pixels along the longer side of a picture; default 128 for a spectrum, 256 otherwise"),
    WORD(check, unchecked, "finer|none", VOLUME | VISIBILITY | COMPARE | OBSERVE,
         "estimate of the error: from the same picture with 1.5 times as many pixels along each side, or none"),
};
_Static_assert(sizeof kd_integral_fields / sizeof *kd_integral_fields <= 64, "a request has a bit for each field");
const size_t kd_n_integral_fields = sizeof kd_integral_fields / sizeof *kd_integral_fields;

const char *kd_integral_name(enum kd_integral what)
{
    static const char *const names[KD_INTEGRALS] = { "line",       "transfer-function", "spectrum", "spectrum",
                                                     "visibility", "compare",           "compare",  "observe" };
    return names[what];
}

enum kd_integral kd_integral_of_route(const char *path)
{
    int i = 0;
    while (i + 1 < KD_INTEGRALS && strcmp(path + strlen("/v1/"), kd_integral_name((enum kd_integral)i)))
        i++;
    return (enum kd_integral)i;
}

void kd_integral_request_init(struct kd_integral_request *request, enum kd_integral what)
{
    *request = (struct kd_integral_request) {
        .what = what,
        .inclination_deg = 30,
        .inner = NAN,
        .outer = 400,
        .index = 3,
        .outer_index = 3,
        .break_r = 10,
        .height = 10,
        .photon_index = 2,
        .tolerance = 1e-3,
        .rest_energy = 1,
        .energy_max = NAN,
        .bins = 500,
        .rings = 10,
        .g_stars = 20,
        .mass_msun = 10,
        .distance_pc = 1e4,
        .mdot_edd = 0.1,
        .colour_correction = 1.7,
        .frequency_min_hz = NAN,
        .frequency_max_hz = NAN,
        .frequencies = what == KD_INTEGRAL_VOLUME ? 13 : 200,
        .length_max = NAN,
        .baselines = 200,
        .products = (1u << KD_PRODUCT_VISIBILITY) - 1,
        .uv_min_gl = 0.1,
        .flux_jy = NAN,
    };
}

/* The i-th word of "a|b|c", its length in *n; NULL beyond the last. */
static const char *word_at(const char *words, int i, size_t *n)
{
    for (; *words; words += *n + (words[*n] == '|')) {
        *n = strcspn(words, "|");
        if (i-- == 0)
            return words;
    }
    return NULL;
}

static void write_word(struct kd_json *json, const char *name, const char *words, int i)
{
    size_t n = 0;
    char text[40];
    const char *word = word_at(words, i, &n);
    snprintf(text, sizeof text, "%.*s", (int)n, word ? word : "");
    kd_json_string(json, name, text);
}

static void write_words(struct kd_json *json, const char *name, const char *words, uint32_t set)
{
    size_t n;
    kd_json_array(json, name);
    for (int i = 0; word_at(words, i, &n); i++)
        if (set & 1u << i)
            write_word(json, NULL, words, i);
    kd_json_end(json);
}

void kd_integral_field_write(struct kd_json *json, const struct kd_integral_request *request,
                             const struct kd_integral_field *field)
{
    const char *at = (const char *)request + field->offset;
    const char *dot = strchr(field->name, '.'), *own = dot ? dot + 1 : field->name;
    int word;
    switch (field->kind) {
    case KD_INTEGRAL_REAL: kd_json_number(json, own, *(const double *)(const void *)at); break;
    case KD_INTEGRAL_INT: kd_json_number(json, field->name, *(const uint32_t *)(const void *)at); break;
    case KD_INTEGRAL_WORD:
        memcpy(&word, at, sizeof word);
        write_word(json, field->name, field->words, word);
        break;
    case KD_INTEGRAL_WORDS: write_words(json, own, field->words, *(const uint32_t *)(const void *)at); break;
    case KD_INTEGRAL_NUMBERS: break;
    }
}

static void add_range(struct kd_json *json, const struct kd_integral_field *f)
{
    kd_json_string(json, "type", f->kind == KD_INTEGRAL_INT ? "integer" : "number");
    kd_json_number(json, f->open ? "exclusiveMinimum" : "minimum", f->least);
    kd_json_number(json, f->open ? "exclusiveMaximum" : "maximum", f->most);
}

/* Inclinations are off the axis and not too near edge-on; for a transfer function also not face-on. check.c refuses
 * the same. */
static void add_inclination(struct kd_json *json, enum kd_integral what)
{
    const double least = what == KD_INTEGRAL_TRANSFER ? KD_INTEGRAL_FACE_ON : 0,
                 ends[2][2] = { { least, 90 - KD_DISK_IMAGE_EDGE_ON }, { 90 + KD_DISK_IMAGE_EDGE_ON, 180 - least } };
    kd_json_array(json, "anyOf");
    for (int i = 0; i < 2; i++) {
        kd_json_object(json, NULL);
        kd_json_string(json, "type", "number");
        kd_json_number(json, "minimum", ends[i][0]);
        kd_json_number(json, "maximum", ends[i][1]);
        kd_json_end(json);
    }
    kd_json_end(json);
}

static void add_words(struct kd_json *json, const char *words)
{
    size_t n;
    kd_json_array(json, "enum");
    for (int i = 0; word_at(words, i, &n); i++)
        write_word(json, NULL, words, i);
    kd_json_end(json);
}

static void add_number_or_word(struct kd_json *json, const struct kd_integral_field *f)
{
    kd_json_array(json, "anyOf");
    kd_schema_word(json, NULL, f->words);
    kd_json_object(json, NULL);
    add_range(json, f);
    kd_json_end(json);
    kd_json_end(json);
}

static void add_list(struct kd_json *json, const struct kd_integral_field *f)
{
    kd_json_string(json, "type", "array");
    kd_json_number(json, "minItems", strcmp(f->name, "edges") ? 1 : 2); /* a bin has two edges */
    kd_json_number(json, "maxItems", KD_INTEGRAL_LIST);
    kd_json_object(json, "items");
    add_range(json, f);
    kd_json_end(json);
}

static void add_set(struct kd_json *json, const struct kd_integral_field *f)
{
    kd_json_string(json, "type", "array");
    kd_json_number(json, "minItems", f->least);
    kd_json_bool(json, "uniqueItems", true);
    kd_json_object(json, "items");
    add_words(json, f->words);
    kd_json_end(json);
}

static void add_field(struct kd_json *json, const struct kd_integral_field *f, enum kd_integral what)
{
    char help[240];
    snprintf(help, sizeof help, "%s%s%s%s", f->help, *f->unit ? " [" : "", f->unit, *f->unit ? "]" : "");
    kd_json_object(json, strchr(f->name, '.') ? strchr(f->name, '.') + 1 : f->name);
    kd_json_string(json, "description", help);
    if (f->kind == KD_INTEGRAL_WORDS)
        add_set(json, f);
    else if (f->kind == KD_INTEGRAL_WORD)
        add_words(json, f->words);
    else if (!strcmp(f->name, "inclination_deg"))
        add_inclination(json, what);
    else if (f->kind == KD_INTEGRAL_NUMBERS)
        add_list(json, f);
    else if (f->words)
        add_number_or_word(json, f);
    else
        add_range(json, f);
    kd_json_end(json);
}

#define SETS_SCHEMA \
    "{\"type\":\"array\",\"minItems\":1,\"maxItems\":" KD_SCHEMA_DIGITS( \
        KD_INTEGRAL_SETS_MOST) ",\"description\":\"" \
                               "parameter sets, each compared for its own chi^2: fields of the scene by their paths, " \
                               "such as spacetime.spin, and " \
                               "flux_jy, size and " \
                               "position_angle_deg\",\"items\":{\"type\":\"object\",\"additionalProperties\":{" \
                               "\"type\":[" \
                               "\"number\",\"string\",\"boolean\"]}}}"

static const char *preset_name(size_t i) { return i < kd_scene_preset_count() ? kd_scene_preset_name(i) : NULL; }

static void add_presets(struct kd_json *json)
{
    kd_json_object(json, "preset");
    kd_json_string(json, "type", "string");
    kd_json_string(json, "description", "preset to which the scene is merged");
    kd_schema_words_of(json, preset_name);
    kd_json_end(json);
}

static void begin_object(struct kd_json *json, const char *name)
{
    char object[40];
    snprintf(object, sizeof object, "%.*s", (int)strcspn(name, "."), name);
    kd_json_object(json, object);
    kd_json_string(json, "type", "object");
    kd_json_bool(json, "additionalProperties", false);
    kd_json_object(json, "properties");
}

static void end_object(struct kd_json *json)
{
    kd_json_end(json);
    kd_json_end(json);
}

/* The schema of a spectrum covers both a disk and a scene. */
void kd_integral_request_schema(struct kd_json *json, const char *name, enum kd_integral what)
{
    const unsigned of = what == KD_INTEGRAL_SPECTRUM ? SPECTRUM | VOLUME : 1u << what;
    static const char scene[] = "{\"$ref\":\"#/components/schemas/Scene\"}";
    kd_json_object(json, name);
    kd_json_string(json, "type", "object");
    kd_json_bool(json, "additionalProperties", false);
    kd_json_object(json, "properties");
    if (of & (VOLUME | VISIBILITY | COMPARE | OBSERVE)) {
        add_presets(json);
        kd_json_raw(json, "scene", scene, sizeof scene - 1);
    }
    if (of & (COMPARE | OBSERVE))
        kd_schema_text(json, "observation",
                       "{\"type\":\"string\",\"minLength\":1,\"maxLength\":64,\"description\":\"SHA-256 of an asset "
                       "of the server: uvfits, or the EHT's CSV\"}");
    if (what == KD_INTEGRAL_COMPARE)
        kd_schema_text(json, "sets", SETS_SCHEMA);
    bool inside = false; /* whether the object of fields with dotted names is open; such fields are adjacent */
    for (size_t i = 0; i < kd_n_integral_fields; i++) {
        const struct kd_integral_field *f = &kd_integral_fields[i];
        if (!(f->of & of))
            continue;
        if (!strchr(f->name, '.') != !inside)
            inside = !inside, inside ? begin_object(json, f->name) : end_object(json);
        add_field(json, f, what);
    }
    kd_json_end(json);
    if (kd_integral_apart(what))
        kd_schema_text(json, "not", kd_integral_apart(what));
    if (of & (COMPARE | OBSERVE))
        kd_schema_text(json, "required", "[\"observation\"]");
    kd_json_end(json);
}
