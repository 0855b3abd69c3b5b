/* The table of request fields, and their JSON Schema. */
#include "base/decimal.h"
#include "base/schema.h"
#include "integral/apart.h"
#include "integral/request.h"
#include "integral/sets.h"
#include "observe/embedded.h"
#include "physics/disk/disk_image.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define AT(member) offsetof(struct kd_integral_request, member)
#define LINE (1u << KD_INTEGRAL_LINE)
#define TRANSFER (1u << KD_INTEGRAL_TRANSFER)
#define SPECTRUM (1u << KD_INTEGRAL_SPECTRUM)
#define IMPULSE (1u << KD_INTEGRAL_IMPULSE)
#define LAGS (1u << KD_INTEGRAL_LAGS)
#define ECHO (IMPULSE | LAGS)
#define VOLUME (1u << KD_INTEGRAL_VOLUME)
#define VISIBILITY (1u << KD_INTEGRAL_VISIBILITY)
#define COMPARE (1u << KD_INTEGRAL_COMPARE | 1u << KD_INTEGRAL_SETS)
#define OBSERVE (1u << KD_INTEGRAL_OBSERVE)
#define ALL (LINE | TRANSFER | SPECTRUM | ECHO)
#define REAL(n, u, low, high, kinds, h) \
    { .name = #n, .kind = KD_KIND_REAL, .offset = AT(n), .least = low, .most = high, .unit = u, .of = kinds, .help = h }
#define OR_WORD(n, u, low, high, word, kinds, h) \
    { .name = #n, \
      .kind = KD_KIND_REAL, \
      .offset = AT(n), \
      .least = low, \
      .most = high, \
      .unit = u, \
      .of = kinds, \
      .help = h, \
      .words = word, \
      .stands = NAN }
#define WORD(n, member, w, kinds, h) \
    { .name = #n, .kind = KD_KIND_WORD, .offset = AT(member), .words = w, .of = kinds, .help = h }
#define INT(n, low, high, kinds, h) \
    { .name = #n, .kind = KD_KIND_INT, .offset = AT(n), .least = low, .most = high, .of = kinds, .help = h }
#define WORDS(n, w, fewest, kinds, h) \
    { .name = #n, .kind = KD_KIND_WORDS, .offset = AT(n), .least = fewest, .words = w, .of = kinds, .help = h }
#define MEMBER(o, n, u, low, high, kinds, h) \
    { .object = #o, \
      .name = #n, \
      .kind = KD_KIND_REAL, \
      .offset = AT(o##_##n), \
      .least = low, \
      .most = high, \
      .unit = u, \
      .of = kinds, \
      .help = h }
#define NUMBERS(n, u, low, high, kinds, h, ...) \
    { .name = #n, \
      .kind = KD_KIND_LIST, \
      .offset = AT(n), \
      .least = low, \
      .most = high, \
      .room = KD_INTEGRAL_LIST, \
      .unit = u, \
      .of = kinds, \
      .help = h, \
      __VA_ARGS__ }
#define INCLINATION(kinds, ...) \
    { .name = "inclination_deg", \
      .kind = KD_KIND_REAL, \
      .offset = AT(inclination_deg), \
      .most = 180, \
      .unit = "deg", \
      .of = kinds, \
      __VA_ARGS__ }
/* Two ranges of inclinations, one on either side of edge-on. check.c refuses the others. */
#define BESIDE(low, below, above, high) \
    .help = "angle between the axis and the observer, who is at infinity; not " below " to " above, \
    .schema = "\"anyOf\":[{\"type\":\"number\",\"minimum\":" low ",\"maximum\":" below "},{\"type\":\"number\"," \
              "\"minimum\":" above ",\"maximum\":" high "}]"
_Static_assert((int)KD_DISK_IMAGE_EDGE_ON == 3, "the ranges from 87 to 93 in the schemas assume 3 degrees");

const struct kd_row kd_integral_fields[] = {
    { .name = "spin",
      .kind = KD_KIND_REAL,
      .offset = AT(spin),
      .least = -1,
      .most = 1,
      .open = KD_OPEN,
      .unit = "M",
      .of = ALL,
      .help = "spin of the hole; below 0 the disk rotates against the hole" },
#define MORE(x, name_, member, least_, most_, shown, unit_, card, what, bound, ...) \
    { .name = #name_, \
      .kind = KD_KIND_REAL, \
      .offset = AT(name_), \
      .least = -1, \
      .most = 1, \
      .open = KD_OPEN, \
      .unit = unit_, \
      .of = ALL, \
      .help = what "; the gas is neutral; " bound },
    KD_HOLE_MORE(MORE, )
#undef MORE
        INCLINATION(LINE | SPECTRUM, .help = "angle between the axis and the observer, who is at infinity"),
    INCLINATION(ECHO, BESIDE("0", "87", "93", "180")),
    INCLINATION(TRANSFER, BESIDE("0.1", "89.99", "90.01", "179.9")),
    OR_WORD(inner, "M", 1, 1e6, "isco", ALL, "radius of the disk's inner edge, at least that of the ISCO"),
    REAL(outer, "M", 1, 1e6, ALL, "outer edge of the disk"),
    WORD(emissivity, emissivity, "power|broken|lamppost|ring|disk|slab", LINE,
         "dependence of the line's emissivity on radius. power, broken: powers of r; lamppost, ring, disk, slab: in "
         "proportion to the light that the disk receives from a point on the axis, or from a ring, a flat layer or a "
         "slab above it"),
    { .name = "emissivity",
      .kind = KD_KIND_WORD,
      .offset = AT(emissivity),
      .words = "lamppost|ring",
      .first = KD_LINE_LAMPPOST,
      .of = ECHO,
      .help = "source of the light that the disk receives: a point on the axis, or a ring about it" },
    REAL(index, "", -10, 20, LINE, "power and broken: the light per area falls as r^-index"),
    REAL(outer_index, "", -10, 20, LINE, "broken: index beyond break_r"),
    REAL(break_r, "M", 1, 1e6, LINE, "broken: radius at which the index changes"),
    REAL(height, "M", 0.1, 1e4, LINE | ECHO,
         "lamppost, ring, disk, slab: height of the source above the plane, r cos(theta); for a slab, height of its "
         "lower side"),
    REAL(corona_radius, "M", 1e-3, 1e4, LINE | ECHO,
         "ring: distance from the axis, r sin(theta); disk, slab: outer radius of the source"),
    REAL(corona_inner, "M", 0, 1e4, LINE, "disk, slab: inner radius of the source"),
    REAL(corona_top, "M", 0.1, 1e4, LINE, "slab: height of its upper side"),
    WORD(motion, motion, "static|zamo|corotating", LINE | ECHO,
         "ring, disk, slab: motion of the source: at rest, with zero angular momentum, or with the angular velocity of "
         "the disk's gas at the same distance from the axis (within the ISCO, that of the ISCO)"),
    REAL(photon_index, "", 0, 10, LINE | ECHO, "lamppost, ring, disk, slab: photon index of the source's power law"),
    WORD(limb, limb, "isotropic|laor|haardt|scattering", LINE | SPECTRUM | ECHO,
         "dependence of the light on mu, the cosine of the angle from the disk's normal: none, 1 + 2.06 mu, ln(1 + "
         "1/mu), or that of a deep atmosphere of free electrons"),
    REAL(tolerance, "", 0, 0.1, LINE,
         "accepted error of the cumulative share: sums are refined until they meet it, or to the finest level; 0: "
         "always to the finest level"),
    WORD(counts, energy, "photons|energy", LINE, "quantity that a bin counts"),
    REAL(rest_energy, "", 1e-9, 1e9, LINE | ECHO,
         "energy of the line in the gas's frame, in any unit; edges have the same unit"),
    REAL(energy_min, "", 0, 1e9, LINE | ECHO, "first edge of bins of equal width"),
    OR_WORD(energy_max, "", 0, 1e9, "auto", LINE | ECHO, "last edge; auto: 1.7 times rest_energy"),
    INT(bins, 1, KD_INTEGRAL_ROWS, LINE | ECHO, "number of bins of equal width"),
    NUMBERS(edges, "", 0, 1e9, LINE | ECHO,
            "edges of the bins in ascending order, instead of energy_min, energy_max and bins", .fewest = 2),
    REAL(time_min, "M", -1e6, 1e6, IMPULSE, "first edge of the bins of time, after the direct light's mean arrival"),
    REAL(time_max, "M", -1e6, 1e6, IMPULSE, "last edge of the bins of time"),
    INT(times, 1, KD_INTEGRAL_TIMES, IMPULSE, "number of bins of time, of equal width"),
    REAL(frequency_min, "c^3/GM", 1e-9, 10, LAGS, "first Fourier frequency"),
    REAL(frequency_max, "c^3/GM", 1e-9, 10, LAGS, "last Fourier frequency"),
    { .name = "frequencies",
      .kind = KD_KIND_INT,
      .offset = AT(frequencies),
      .least = 1,
      .most = KD_INTEGRAL_LAG_FREQUENCIES,
      .of = LAGS,
      .help = "number of Fourier frequencies, at equal ratios" },
    { .name = "frequencies_m",
      .kind = KD_KIND_LIST,
      .offset = AT(frequencies_m),
      .least = 1e-9,
      .most = 10,
      .room = KD_INTEGRAL_LAG_FREQUENCIES,
      .unit = "c^3/GM",
      .of = LAGS,
      .help = "Fourier frequencies, instead of frequency_min, frequency_max and frequencies" },
    REAL(reflection, "", 0, 1e6, LAGS,
         "ratio of the line's photons at all energies to the continuum's photons between the first and the last edge, "
         "both at the observer"),
    OR_WORD(reference_min, "", 1e-9, 1e9, "continuum", LAGS,
            "lower end of the band that lags are measured against, in the unit of rest_energy; continuum: the direct "
            "light alone"),
    OR_WORD(reference_max, "", 1e-9, 1e9, "continuum", LAGS,
            "upper end of the band that lags are measured against; continuum: the direct light alone"),
    INT(rings, 1, 1000, TRANSFER, "number of radii, from inner to outer at equal ratios"),
    NUMBERS(radii, "M", 1, 1e6, TRANSFER, "radii, instead of rings; between inner and outer"),
    INT(g_stars, 1, 1000, TRANSFER,
        "number of values of g* at each radius: the midpoints of equal parts of the range 0 to 1"),
    NUMBERS(g_star, "", 0, 1, TRANSFER,
            "values of g* instead of g_stars, each between 0 (the reddest light of the ring) and 1 (the bluest)",
            .open = KD_OPEN),
    REAL(mass_msun, "solar masses", 1e-5, 1e12, SPECTRUM | ECHO, "mass of the hole"),
    REAL(distance_pc, "pc", 1e-3, 1e12, SPECTRUM, "distance of the hole"),
    REAL(mdot_edd, "Eddington rates", 1e-12, 1e3, SPECTRUM,
         "accretion rate as luminosity over the Eddington luminosity, with the efficiency of this spin"),
    REAL(colour_correction, "", 1, 10, SPECTRUM, "colour temperature over effective temperature"),
    WORD(
        returning, returning, "no|yes|scattered", SPECTRUM,
        "yes: the disk absorbs the light that returns to it, and radiates it again as a black body; scattered: its "
        "atmosphere of free electrons reflects the light that returns for the first time; inner must then be the ISCO"),
    WORD(polarization, polarized, "no|yes", SPECTRUM,
         "yes: degree and angle of the polarisation of a deep atmosphere of free electrons, for which limb must be "
         "\"scattering\""),
    OR_WORD(frequency_min_hz, "Hz", 1e-3, 1e25, "auto", SPECTRUM | VOLUME,
            "first frequency; auto: 0.001 k/h times the hottest ring's colour temperature; for a scene 1/30 of "
            "its frequency"),
    OR_WORD(frequency_max_hz, "Hz", 1e-3, 1e25, "auto", SPECTRUM | VOLUME,
            "last frequency; auto: 30 k/h times the hottest ring's colour temperature; for a scene 30 times "
            "its frequency, for a disk at most 64 k/h times its largest colour temperature"),
    INT(frequencies, 2, KD_INTEGRAL_FREQUENCIES, SPECTRUM | VOLUME,
        "number of frequencies, spaced by equal ratios; default 200; for a scene the default is 13 and the most is "
        "200"),
    NUMBERS(frequencies_hz, "Hz", 1e-3, 1e25, SPECTRUM | VOLUME,
            "frequencies, instead of frequency_min_hz, frequency_max_hz and frequencies"),
    NUMBERS(u, "Gl", -1e15, 1e15, VISIBILITY,
            "eastward components of the baselines, in units of 1e9 wavelengths; as many numbers as v has"),
    NUMBERS(v, "Gl", -1e15, 1e15, VISIBILITY, "northward components of the baselines"),
    NUMBERS(lengths, "Gl", 0, 1e15, VISIBILITY,
            "lengths of baselines, instead of u and v; each length is combined with each of angles_deg"),
    OR_WORD(
        length_max, "Gl", 1e-9, 1e15, "auto", VISIBILITY,
        "longest baseline, for lengths from 0 to it instead of lengths; auto: half of the longest baseline that the "
        "map's pixels resolve"),
    INT(baselines, 2, KD_INTEGRAL_ROWS, VISIBILITY, "number of lengths from 0 to length_max"),
    NUMBERS(angles_deg, "deg", -360, 360, VISIBILITY,
            "position angles of the baselines given by lengths, from north to east; default 0 and 90"),
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
    MEMBER(systematic, visibility, "", 0, 1, COMPARE,
           "share of each visibility's amplitude that is added to its error in quadrature, before all other steps"),
    MEMBER(systematic, amplitude, "", 0, 1, COMPARE,
           "relative error of a station; sqrt(2) times it is added to an amplitude's error in quadrature"),
    MEMBER(systematic, closure_phase_deg, "deg", 0, 180, COMPARE,
           "systematic error that is added to the error of a closure phase in quadrature"),
    WORD(debias, measured, "yes|no", COMPARE,
         "yes: amplitudes are sqrt(|V|^2 - sigma^2), also in closures; no: as measured"),
    WORD(closures, maximal, "minimal|maximal", COMPARE,
         "minimal: independent triangles and quadrangles with the first station; maximal: all"),
    WORD(pulse, pulse, "triangle|rectangle|point", COMPARE | OBSERVE, "shape of a pixel's light"),
    WORD(scattering, scattering, "none|sgra", COMPARE | OBSERVE,
         "interstellar scattering of the model: sgra: the average kernel towards Sagittarius A* at the observation's "
         "frequency"),
    OR_WORD(flux_jy, "Jy", 1e-12, 1e12, "auto", COMPARE | OBSERVE,
            "flux to which the whole map is scaled; auto: the scene's flux; if its light has no frequency, a "
            "comparison takes the best fit to the amplitudes"),
    WORDS(solve, "flux|size|position_angle|shift", 0, COMPARE,
          "quantities that are fitted for the smallest chi^2 of all data: flux, angular size, position angle, and the "
          "position, which needs the product visibility"),
    WORD(noise, noiseless, "yes|no", OBSERVE, "yes: Gaussian noise with the errors of the observation; no: none"),
    INT(seed, 0, 4294967295, OBSERVE, "seed of the noise"),
    INT(pixels, 16, 2048, VOLUME | VISIBILITY | COMPARE | OBSERVE,
        "pixels along the longer side of a picture; default 128 for a spectrum, 256 otherwise"),
    WORD(check, unchecked, "finer|none", VOLUME | VISIBILITY | COMPARE | OBSERVE,
         "estimate of the error: from the same picture with 1.5 times as many pixels along each side, or none"),
    INT(digits, 1, KD_DECIMAL_DIGITS, VISIBILITY | COMPARE, "significant digits of the columns as text"),
};
_Static_assert(sizeof kd_integral_fields / sizeof *kd_integral_fields <= 128, "a request has a bit for each field");
const size_t kd_n_integral_fields = sizeof kd_integral_fields / sizeof *kd_integral_fields;

const char *kd_integral_name(enum kd_integral what)
{
    static const char *const names[KD_INTEGRALS] = {
        "line",     "transfer-function", "spectrum", "impulse", "lags",
        "spectrum", "visibility",        "compare",  "compare", "observe"
    };
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
        .emissivity = 1u << what & ECHO ? KD_LINE_LAMPPOST : KD_LINE_POWER,
        .index = 3,
        .outer_index = 3,
        .break_r = 10,
        .height = 10,
        .photon_index = 2,
        .tolerance = 1e-3,
        .rest_energy = 1,
        .energy_min = what == KD_INTEGRAL_LAGS ? 0.3 : 0,
        .energy_max = NAN,
        .bins = what == KD_INTEGRAL_IMPULSE ? 100
                : what == KD_INTEGRAL_LAGS  ? 16
                                            : 500,
        .corona_radius = 10,
        .corona_top = 15,
        .time_max = 200,
        .times = 100,
        .reflection = 1,
        .reference_min = NAN,
        .reference_max = NAN,
        .frequency_min = 1e-4,
        .frequency_max = 0.1,
        .rings = 10,
        .g_stars = 20,
        .mass_msun = 10,
        .distance_pc = 1e4,
        .mdot_edd = 0.1,
        .colour_correction = 1.7,
        .frequency_min_hz = NAN,
        .frequency_max_hz = NAN,
        .frequencies = what == KD_INTEGRAL_VOLUME ? 13
                       : what == KD_INTEGRAL_LAGS ? 31
                                                  : 200,
        .length_max = NAN,
        .baselines = 200,
        .digits = KD_DECIMAL_DIGITS,
        .products = (1u << KD_PRODUCT_VISIBILITY) - 1,
        .uv_min_gl = 0.1,
        .flux_jy = NAN,
    };
}

#define SETS_SCHEMA \
    "{\"type\":\"array\",\"minItems\":1,\"maxItems\":" KD_SCHEMA_DIGITS( \
        KD_INTEGRAL_SETS_MOST) ",\"description\":\"" \
                               "parameter sets; chi^2 is computed for each. A set may have fields of the scene, " \
                               "named by " \
                               "their paths (such as spacetime.spin), and flux_jy, size and " \
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

/* Writes the schema of a request. The schema of a spectrum covers both a disk and a scene. */
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
                       "of the server: uvfits, or the EHT's CSV; or the name of an observation that the server "
                       "has: " KD_EMBEDDED_OBSERVATIONS "\"}");
    if (what == KD_INTEGRAL_COMPARE)
        kd_schema_text(json, "sets", SETS_SCHEMA);
    struct kd_document document = kd_integral_document(what);
    document.of = of;
    kd_document_properties(json, &document);
    kd_json_end(json);
    if (kd_integral_apart(what))
        kd_schema_text(json, "not", kd_integral_apart(what));
    if (of & (COMPARE | OBSERVE))
        kd_schema_text(json, "required", "[\"observation\"]");
    kd_json_end(json);
}
