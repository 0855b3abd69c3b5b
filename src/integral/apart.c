#include "integral/apart.h"

#include "base/schema.h"
#include "physics/spacetime/parameters.h"

#define HAS(name) "{\"required\":[\"" name "\"]}"
#define BOTH(one, other) "{\"required\":[\"" one "\",\"" other "\"]}"
#define ALONE(name) "{\"required\":[\"" name "\"],\"not\":{\"anyOf\":["
/* Schema of a member that must be absent, because it does not belong to the given emissivity. */
#define NOT_OF(name, words) \
    "{\"required\":[\"" name "\",\"emissivity\"],\"properties\":{\"emissivity\":{\"enum\":[" words "]}}}"
#define CORONAE "\"ring\",\"disk\",\"slab\""
#define SOURCES "\"lamppost\"," CORONAE
#define OF_NO_OTHER_THAN(name, words) \
    "{\"required\":[\"" name \
    "\"],\"not\":{\"required\":[\"emissivity\"],\"properties\":{\"emissivity\":{\"enum\":[" words "]}}}}"
/* Schema of a request with a scene: fields of pictures need a scene, and fields of a disk exclude one. */
#define OF_A_SCENE "\"anyOf\":[" HAS("scene") "," HAS("preset") "]"
#define OF_RETURNING HAS("returning") "," HAS("polarization")
#define OF_A_HOLE_(x, name, ...) "," HAS(#name)
#define OF_A_DISK \
    HAS("spin") \
    KD_HOLE_MORE(OF_A_HOLE_, ) \
    "," HAS("inclination_deg") "," HAS("inner") "," HAS("outer") "," HAS("limb") "," HAS("mass_msun") "," HAS( \
        "distance_pc") "," HAS("mdot_edd") "," HAS("colour_correction") "," OF_RETURNING
#define OF_A_VOLUME \
    "{\"minimum\":" KD_SCHEMA_DIGITS(KD_INTEGRAL_LEAST_HZ) ",\"maximum\":" KD_SCHEMA_DIGITS(KD_INTEGRAL_MOST_HZ) "}"

#define SOLVES(what) "\"solve\":{\"type\":\"array\",\"contains\":{\"const\":\"" what "\"}}"

/* clang-format off */
static const char line[] = "{\"anyOf\":["
    BOTH("edges", "energy_min") "," BOTH("edges", "energy_max") "," BOTH("edges", "bins") ","
    NOT_OF("index", "\"lamppost\",\"ring\",\"disk\",\"slab\"") "," OF_NO_OTHER_THAN("outer_index", "\"broken\"") ","
    OF_NO_OTHER_THAN("break_r", "\"broken\"") "," OF_NO_OTHER_THAN("height", SOURCES) ","
    OF_NO_OTHER_THAN("photon_index", SOURCES) "," OF_NO_OTHER_THAN("corona_radius", CORONAE) ","
    OF_NO_OTHER_THAN("motion", CORONAE) "," OF_NO_OTHER_THAN("corona_inner", "\"disk\",\"slab\"") ","
    OF_NO_OTHER_THAN("corona_top", "\"slab\"") "]}";
#define ECHO \
    BOTH("edges", "energy_min") "," BOTH("edges", "energy_max") "," BOTH("edges", "bins") "," \
    OF_NO_OTHER_THAN("corona_radius", "\"ring\"") "," OF_NO_OTHER_THAN("motion", "\"ring\"")
#define A_NUMBER(name) "{\"required\":[\"" name "\"],\"properties\":{\"" name "\":{\"type\":\"number\"}}}"
static const char impulse[] = "{\"anyOf\":[" ECHO "]}";
static const char lags[] = "{\"anyOf\":[" ECHO ","
    BOTH("frequencies_m", "frequency_min") "," BOTH("frequencies_m", "frequency_max") ","
    BOTH("frequencies_m", "frequencies") ","
    "{\"allOf\":[" A_NUMBER("reference_min") ",{\"not\":" A_NUMBER("reference_max") "}]},"
    "{\"allOf\":[" A_NUMBER("reference_max") ",{\"not\":" A_NUMBER("reference_min") "}]},"
    "{\"required\":[\"energy_min\"],\"properties\":{\"energy_min\":{\"maximum\":0}}}]}";
static const char transfer[] = "{\"anyOf\":[" BOTH("radii", "rings") "," BOTH("g_star", "g_stars") "]}";
static const char spectrum[] = "{\"anyOf\":["
    BOTH("frequencies_hz", "frequency_min_hz") "," BOTH("frequencies_hz", "frequency_max_hz") ","
    BOTH("frequencies_hz", "frequencies") ","
    "{\"allOf\":[{" OF_A_SCENE "},{\"anyOf\":[" OF_A_DISK "]}]},"
    "{" OF_A_SCENE ",\"not\":{\"properties\":{\"frequencies\":{\"maximum\":200},"
        "\"frequencies_hz\":{\"maxItems\":200,\"items\":" OF_A_VOLUME "},"
        "\"frequency_min_hz\":" OF_A_VOLUME ",\"frequency_max_hz\":" OF_A_VOLUME "}}},"
    "{\"not\":{" OF_A_SCENE "},\"anyOf\":[" HAS("pixels") "," HAS("check") "]},"
    "{\"not\":{" OF_A_SCENE "},\"required\":[\"frequencies_hz\"],"
        "\"properties\":{\"frequencies_hz\":{\"type\":\"array\",\"minItems\":1001}}}]}";
static const char visibility[] = "{\"anyOf\":["
    BOTH("lengths", "length_max") "," BOTH("lengths", "baselines") ","
    ALONE("u") HAS("v") "]}}," ALONE("v") HAS("u") "]}},"
    "{\"required\":[\"u\"],\"anyOf\":[" HAS("lengths") "," HAS("length_max") ","
        HAS("baselines") "," HAS("angles_deg") "]}]}";
static const char compare[] = "{\"anyOf\":["
    "{\"required\":[\"solve\",\"flux_jy\"],\"properties\":{" SOLVES("flux") ",\"flux_jy\":{\"type\":\"number\"}}},"
    "{\"required\":[\"solve\",\"products\"],\"properties\":{" SOLVES("flux") ",\"products\":{\"type\":\"array\","
        "\"not\":{\"contains\":{\"enum\":[\"amplitude\",\"visibility\"]}}}}},"
    "{\"required\":[\"solve\"],\"properties\":{" SOLVES("shift") "},\"not\":{\"required\":[\"products\"],"
        "\"properties\":{\"products\":{\"contains\":{\"const\":\"visibility\"}}}}}]}";
/* clang-format on */

const char *kd_integral_apart(enum kd_integral what)
{
    _Static_assert(KD_INTEGRAL_PICTURES == 200 && KD_INTEGRAL_FREQUENCIES == 1000, "the schema of a spectrum says so");
    static const char *const schemas[KD_INTEGRALS] = { [KD_INTEGRAL_LINE] = line,
                                                       [KD_INTEGRAL_TRANSFER] = transfer,
                                                       [KD_INTEGRAL_SPECTRUM] = spectrum,
                                                       [KD_INTEGRAL_IMPULSE] = impulse,
                                                       [KD_INTEGRAL_LAGS] = lags,
                                                       [KD_INTEGRAL_VOLUME] = spectrum,
                                                       [KD_INTEGRAL_VISIBILITY] = visibility,
                                                       [KD_INTEGRAL_COMPARE] = compare };
    return schemas[what];
}
