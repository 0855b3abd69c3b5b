/* Tests of the scene document: round trips, canonical form, hash. */
#include "scene_support.h"

#include "base/pause.h"
#include "document/number.h"
#include "scene/sky_scale.h"
#include "document/tree.h"

#include <locale.h>
#include <malloc.h>
#include <math.h>
#include <time.h>

static void assert_round_trip(const struct kd_scene *scene)
{
    struct kd_scene back;
    struct kd_error error;
    char *text = support_canonical(scene);
    kd_scene_defaults(&back);
    if (support_parse(&back, text, &error))
        fail_msg("%s: %s in %s", error.pointer, error.message, text);
    for (size_t i = 0; i < KD_FIELD_COUNT; i++) {
        const struct kd_section *section = kd_section_find(kd_fields[i].object);
        assert_int_equal(kd_section_size(scene, section), kd_section_size(&back, section));
        for (size_t index = 0; index < kd_section_size(scene, section); index++) {
            double a = kd_field_get(scene, &kd_fields[i], index), b = kd_field_get(&back, &kd_fields[i], index);
            if (memcmp(&a, &b, sizeof a))
                fail_msg("%s.%zu.%s: %a became %a", kd_fields[i].object, index, kd_fields[i].name, a, b);
        }
    }
    assert_memory_equal(scene, &back, sizeof back);
    char *again = support_canonical(&back);
    assert_string_equal(text, again);
    free(text);
    free(again);
}

static void random_scenes_round_trip(void **state)
{
    (void)state;
    uint64_t seed = 20191105;
    for (int i = 0; i < 1000; i++) {
        struct kd_scene scene;
        support_scene(&scene, &seed);
        kd_scene_settle(&scene, NULL);
        assert_round_trip(&scene);
    }
}

static void empty_document_is_the_default(void **state)
{
    (void)state;
    static const char *const same[] = { "{}", " { } \n", "{\"version\":1}", "{\"camera\":{}}", "{\"version\":1.0}" };
    struct kd_scene scene, defaults;
    kd_scene_defaults(&defaults);
    for (size_t i = 0; i < sizeof same / sizeof *same; i++) {
        kd_scene_defaults(&scene);
        assert_int_equal(support_parse(&scene, same[i], NULL), KD_OK);
        assert_memory_equal(&scene, &defaults, sizeof scene);
    }
}

static void documents_merge(void **state)
{
    (void)state;
    struct kd_scene scene;
    kd_scene_defaults(&scene);
    assert_int_equal(support_parse(&scene, "{\"spacetime\":{\"spin\":0.5},\"camera\":{\"r\":30}}", NULL), KD_OK);
    assert_int_equal(support_parse(&scene, "{\"camera\":{\"inclination_deg\":1}, \"time\": -0.0}", NULL), KD_OK);
    assert_true(scene.spacetime.spin == 0.5 && scene.camera.r == 30 && scene.camera.inclination_deg == 1);
    assert_false(signbit(scene.top.time));
    assert_int_equal(support_parse(&scene, "{\"camera\":{\"r\":\"infin\\u0069ty\"}}", NULL), KD_OK);
    assert_true(isinf(scene.camera.r));
}

/* By RFC 7396 null sets a field or a section to its default. Fields that a patch does not name stay. A failing patch
 * changes nothing. */
static void patches(void **state)
{
    (void)state;
    struct kd_scene scene, before;
    struct kd_error error;
    kd_scene_defaults(&scene);
    scene.camera.inclination_deg = 10;
    scene.camera.r = 40;
    scene.disk.outer = 99;
    scene.top.time = 7;
    const char *text = "{\"camera\":{\"r\":null},\"disk\":null,\"time\":null,\"spacetime\":{\"spin\":0.25}}";
    assert_int_equal(kd_scene_patch(&scene, text, strlen(text), &error), KD_OK);
    assert_true(isinf(scene.camera.r) && scene.camera.inclination_deg == 10 && scene.disk.outer == 22 &&
                scene.top.time == 0);
    assert_true(scene.spacetime.spin == 0.25);
    before = scene;
    static const char *const wrong[] = { "{\"camera\":{\"x\":null}}", "{\"nothing\":null}",
                                         "{\"disk\":null,\"disk\":null}", "{\"time\":1,\"camera\":{\"r\":\"far\"}}",
                                         "null" };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(kd_scene_patch(&scene, wrong[i], strlen(wrong[i]), &error), KD_EINVAL);
        assert_memory_equal(&scene, &before, sizeof scene);
    }
    assert_int_equal(support_parse(&scene, "{\"time\":null}", NULL), KD_EINVAL); /* a document contains no null */
}

static struct kd_scene of(const char *text)
{
    struct kd_scene scene;
    struct kd_error error = { 0 };
    kd_scene_defaults(&scene);
    if (support_parse(&scene, text, &error))
        fail_msg("%s: %s %s", text, error.pointer, error.message);
    return scene;
}

static void patched(struct kd_scene *scene, const char *text)
{
    struct kd_error error = { 0 };
    if (kd_scene_patch(scene, text, strlen(text), &error))
        fail_msg("%s: %s %s", text, error.pointer, error.message);
}

static void expect_spots(const struct kd_scene *scene, size_t count, const double *radii)
{
    assert_int_equal(scene->spots.count, count);
    for (size_t i = 0; i < count; i++)
        assert_true(scene->spots.at[i].r == radii[i]);
    for (size_t i = count; i < KD_SPOTS; i++) /* nothing of the former content is left beyond the end of the list */
        assert_true(scene->spots.at[i].r == 9 && scene->spots.at[i].brightness == 0);
}

/* An array replaces the whole list, with defaults for fields that its objects do not name. An object names elements by
 * their index. */
static void lists_merge(void **state)
{
    (void)state;
    struct kd_scene scene = of("{\"spots\":[{\"r\":10,\"brightness\":1},{\"r\":11},{}]}");
    expect_spots(&scene, 3, (double[]) { 10, 11, 9 });
    assert_int_equal(support_parse(&scene, "{\"spots\":{\"3\":{\"r\":13},\"1\":{\"size\":2},\"4\":{\"r\":14}}}", NULL),
                     KD_OK);
    expect_spots(&scene, 5, (double[]) { 10, 11, 9, 13, 14 });
    assert_true(scene.spots.at[0].brightness == 1 && scene.spots.at[1].size == 2);
    assert_int_equal(support_parse(&scene, "{\"spots\":{}}", NULL), KD_OK);
    assert_int_equal(scene.spots.count, 5);
    assert_int_equal(support_parse(&scene, "{\"spots\":[{\"size\":3},{\"r\":20}]}", NULL), KD_OK);
    expect_spots(&scene, 2, (double[]) { 9, 20 });
    assert_true(scene.spots.at[0].brightness == 0 && scene.spots.at[0].size == 3 && scene.spots.at[1].size == 1);
    patched(&scene, "{\"spots\":{\"0\":{\"size\":null,\"r\":12},\"1\":null,\"2\":null}}");
    expect_spots(&scene, 2, (double[]) { 12, 9 });
    assert_true(scene.spots.at[0].size == 1);
    patched(&scene, "{\"spots\":[{\"r\":30}]}");
    expect_spots(&scene, 1, (double[]) { 30 });
    patched(&scene, "{\"spots\":null}");
    expect_spots(&scene, 0, NULL);
    struct kd_scene full = of("{\"spots\":[{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{\"r\":40}]}");
    assert_true(full.spots.count == 16 && full.spots.at[15].r == 40);
}

/* The preset hot-spot as it was stored in pictures when spots still had names. */
static const char hot_spot[] =
    "{\"version\":1,\"spacetime\":{\"spin\":0.5,\"mass_msun\":4300000},\"camera\":{\"r\":\"infinity\",\"inclination_"
    "deg\":155,"
    "\"azimuth_deg\":0,\"observer\":\"static\",\"projection\":\"auto\",\"field_m\":50,\"fov_deg\":50,\"centre_alpha\":"
    "0,"
    "\"centre_beta\":0,\"yaw_deg\":0,\"pitch_deg\":0,\"roll_deg\":0,\"ring_decades_max\":0,\"ring_decades_min\":-10},"
    "\"disk\":{\"model\":\"novikov-thorne\",\"inner\":\"isco\",\"outer\":16,\"taper\":0.7,\"opacity\":0.3,\"colour\":"
    "\"peak\","
    "\"peak_temperature_k\":4500,\"mdot_edd\":0.1,\"hardening\":1,\"band\":\"bolometric\",\"doppler\":true,"
    "\"redshift\":true,"
    "\"particles\":300000,\"seed\":1,\"density_index\":2,\"plunging\":0.02,\"plunging_temperature\":0.7,\"epicycles\":"
    "0.02,"
    "\"slow_light\":false},\"spot1\":{\"brightness\":4,\"r\":9,\"phase_deg\":0,\"size\":1.2,\"index\":1,\"temperature_"
    "k\":9000},"
    "\"spot2\":{\"brightness\":0,\"r\":9,\"phase_deg\":0,\"size\":1,\"index\":1,\"temperature_k\":9000},\"spot3\":{"
    "\"brightness\":0,"
    "\"r\":9,\"phase_deg\":0,\"size\":1,\"index\":1,\"temperature_k\":9000},\"sky\":{\"model\":\"none\",\"brightness\":"
    "0.2,"
    "\"grid_deg\":15},\"image\":{\"width\":1280,\"height\":720,\"samples\":1,\"critical_factor\":4,\"bit_depth\":8},"
    "\"style\":{\"name\":\"none\",\"exposure\":-0.5,\"tone_map\":\"aces\",\"bloom\":0,\"dither\":true,\"ringdown\":0,"
    "\"ringdown_time\":0},"
    "\"motion\":{\"azimuth_rate_deg\":0,\"time_rate\":10},\"accuracy\":{\"profile\":\"balanced\",\"tolerance\":"
    "\"profile\","
    "\"engine\":\"auto\",\"precision\":\"auto\",\"steps\":0,\"orders\":3},\"time\":0}";

/* Old documents that name spot1, spot2, ... instead of a list are still read: saved pictures, links and scripts hold
 * such documents. */
static void old_names_are_read(void **state)
{
    (void)state;
    static const struct {
        const char *old, *now;
    } same[] = {
        { "{\"spot1\":{\"brightness\":1}}", "{\"spots\":[{\"brightness\":1}]}" },
        { "{\"spot2\":{\"brightness\":1,\"r\":12},\"spot1\":{\"size\":2}}",
          "{\"spots\":[{\"size\":2},{\"brightness\":1,\"r\":12}]}" },
        { "{\"spot3\":{\"index\":2}}", "{\"spots\":[{},{},{\"index\":2}]}" },
        /* documents as they were written before lists: without spots, and with only the second spot */
        { "{\"spot1\":{\"brightness\":0,\"r\":9,\"phase_deg\":0,\"size\":1,\"index\":1,\"temperature_k\":9000},"
          "\"spot2\":{},\"spot3\":{}}",
          "{}" },
        { "{\"spot1\":{\"brightness\":0},\"spot2\":{\"r\":7},\"spot3\":{\"size\":1}}", "{\"spots\":[{},{\"r\":7}]}" },
    };
    for (size_t i = 0; i < sizeof same / sizeof *same; i++) {
        struct kd_scene old = of(same[i].old), now = of(same[i].now);
        char hashes[2][65];
        assert_int_equal(kd_scene_hash(&old, hashes[0]), KD_OK);
        assert_int_equal(kd_scene_hash(&now, hashes[1]), KD_OK);
        assert_string_equal(hashes[0], hashes[1]);
        assert_memory_equal(&old, &now, sizeof old);
    }
    struct kd_scene preset, picture;
    kd_scene_smooth(&picture); /* the default scene, over which a picture's document is read */
    assert_int_equal(support_parse(&picture, hot_spot, NULL), KD_OK);
    assert_int_equal(kd_scene_preset(&preset, "hot-spot", NULL), KD_OK);
    picture.spacetime.distance_pc = preset.spacetime.distance_pc; /* documents of that time lack the distance */
    picture.sky.brightness = preset.sky.brightness;               /* and the brightness of the sky */
    picture.source = preset.source;                               /* and the source */
    assert_memory_equal(&picture, &preset, sizeof picture);
    struct kd_scene scene = of("{\"spots\":[{\"r\":10},{\"r\":11},{\"r\":12},{\"r\":13}]}");
    patched(&scene, "{\"spot2\":{\"r\":20},\"spot3\":null,\"spot1\":{\"size\":2}}");
    expect_spots(&scene, 4, (double[]) { 10, 20, 9, 13 });
    patched(&scene, "{\"spots\":null}");
    patched(&scene, "{\"spot1\":null,\"spot2\":{\"brightness\":null}}");
    expect_spots(&scene, 0, NULL);
}

/* List elements can also be set on a command line or in a link. */
static void elements_are_set(void **state)
{
    (void)state;
    struct kd_scene scene, before;
    struct kd_error error;
    kd_scene_defaults(&scene);
    assert_int_equal(kd_scene_set(&scene, "spots.0.r", "10", &error), KD_OK);
    assert_int_equal(kd_scene_set(&scene, "spots.1.size", "2", &error), KD_OK);
    assert_int_equal(kd_scene_set(&scene, "spots.0.brightness", "3", &error), KD_OK);
    expect_spots(&scene, 2, (double[]) { 10, 9 });
    before = scene;
    assert_int_equal(kd_scene_set(&scene, "spots.5.r", "9", &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/spots/5");
    assert_string_equal(error.message, "there is no spots.5: the list has 2 elements, and the next free index is 2");
    assert_int_equal(kd_scene_set(&scene, "spots.2.r", "0.5", &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/spots/2/r");
    assert_memory_equal(&scene, &before, sizeof scene);
    /* setting an element creates it */
    assert_int_equal(kd_scene_set(&scene, "spots.2.brightness", "0", &error), KD_OK);
    assert_int_equal(scene.spots.count, 3);
    kd_scene_defaults(&scene);
    assert_int_equal(kd_scene_set(&scene, "spot3.r", "12", &error), KD_OK);
    expect_spots(&scene, 3, (double[]) { 9, 9, 12 });
    assert_int_equal(kd_scene_set(&scene, "spot1.r", "8", &error), KD_OK);
    expect_spots(&scene, 3, (double[]) { 8, 9, 12 });
    kd_scene_defaults(&scene);
    /* this is already the default of the field */
    assert_int_equal(kd_scene_set(&scene, "spot2.brightness", "0", &error), KD_OK);
    assert_int_equal(scene.spots.count, 0);
    assert_true(kd_scene_same_path("spot2.r", "spots.1.r") && kd_scene_same_path("spots.0.r", "spot1.r") &&
                kd_scene_same_path("time", "time"));
    assert_false(kd_scene_same_path("spot2.r", "spots.0.r") || kd_scene_same_path("spot2.r", "spots.1.size") ||
                 kd_scene_same_path("spot2", "spots.1"));
}

/* A section nested in another is a member of it, in documents, in patches, in paths, and in written documents. */
static void sections_stand_in_sections(void **state)
{
    (void)state;
    struct kd_scene scene, defaults;
    struct kd_error error;
    kd_scene_defaults(&scene);
    kd_scene_defaults(&defaults);
    patched(&scene, "{\"disk\":{\"gas\":{\"amplitude\":0.5,\"seed\":7},\"outer\":30}}");
    assert_true(scene.gas.amplitude == 0.5 && scene.gas.seed == 7 && scene.disk.outer == 30);
    assert_int_equal(kd_scene_set(&scene, "disk.gas.octaves", "3", &error), KD_OK);
    assert_int_equal(scene.gas.octaves, 3);
    char *text = support_canonical(&scene);
    const char *disk = strstr(text, "\"disk\":{"), *gas = strstr(text, ",\"gas\":{\"amplitude\":0.5,\"octaves\":3,"),
               *next = strstr(text, "\"spots\":");
    assert_true(disk && gas && next && disk < gas && gas < next && next[-2] == '}' && next[-3] == '}');
    free(text);
    patched(&scene, "{\"disk\":{\"gas\":{\"seed\":null}}}");
    assert_true(scene.gas.seed == defaults.gas.seed && scene.gas.octaves == 3);
    patched(&scene, "{\"disk\":{\"gas\":null}}");
    assert_true(!memcmp(&scene.gas, &defaults.gas, sizeof scene.gas) && scene.disk.outer == 30);
    scene.gas.amplitude = 1;
    patched(&scene, "{\"disk\":null}");
    assert_memory_equal(&scene, &defaults, sizeof scene);

    static const struct {
        const char *text, *pointer, *says;
    } bad[] = {
        { "{\"gas\":{}}", "/gas", "did you mean disk.gas?" },
        { "{\"disk.gas\":{}}", "/disk.gas", "there is no field disk.gas" },
        { "{\"disk\":{\"gas\":3}}", "/disk/gas", "disk.gas is 3; it must be an object" },
        { "{\"disk\":{\"gas\":{\"sed\":3}}}", "/disk/gas/sed", "did you mean disk.gas.seed?" },
        { "{\"disk\":{\"gas\":{\"seed\":0.5}}}", "/disk/gas/seed", "disk.gas.seed is 0.5" },
        { "{\"disk\":{\"gas\":{},\"gas\":{}}}", "/disk/gas", "disk.gas is given twice" },
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(support_parse(&scene, bad[i].text, &error), KD_EINVAL);
        assert_string_equal(error.pointer, bad[i].pointer);
        assert_non_null(strstr(error.message, bad[i].says));
        assert_memory_equal(&scene, &defaults, sizeof scene);
    }
    assert_int_equal(kd_scene_set(&scene, "disk.gas", "1", &error), KD_EINVAL);
    assert_non_null(strstr(error.message, "disk.gas is a section; name one of its fields, as in disk.gas.amplitude"));
    assert_string_equal(error.pointer, "/disk/gas");
    assert_int_equal(kd_scene_set(&scene, "disk.gas.sed", "1", &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/disk/gas/sed");
}

/* One width may be given in two units. M is 3.8189932 uas at m87's mass and distance. */
static void a_field_in_microarcseconds(void **state)
{
    (void)state;
    struct kd_scene scene = of("{\"camera\":{\"field_uas\":200,\"field_m\":30},\"spacetime\":{\"mass_msun\":6.5e9,"
                               "\"distance_pc\":16.8e6}}"),
                    again, in_m;
    struct kd_error error;
    assert_true(scene.camera.field_uas == 200 && fabs(scene.camera.field_m / 52.3698228 - 1) < 1e-7);
    assert_int_equal(kd_scene_validate(&scene, NULL), KD_OK);
    assert_true(fabs(kd_scene_width_uas(&scene) / 200 - 1) < 1e-15);

    /* a scene read back equals the scene written, and has the same width as one that gives it in M */
    char *text = support_canonical(&scene);
    again = of(text);
    assert_memory_equal(&again, &scene, sizeof scene);
    free(text);
    in_m = scene;
    in_m.camera.field_uas = INFINITY;
    assert_true(in_m.camera.field_m == scene.camera.field_m);

    /* the width in M follows the hole's mass and distance, in whatever order they are given */
    patched(&scene, "{\"spacetime\":{\"mass_msun\":3.25e9}}");
    assert_true(fabs(scene.camera.field_m / 104.7396457 - 1) < 1e-7);
    assert_int_equal(kd_scene_set(&scene, "spacetime.distance_pc", "33.6e6", &error), KD_OK);
    assert_true(fabs(scene.camera.field_m / 209.4792913 - 1) < 1e-7 && scene.camera.field_uas == 200);

    /* the unit given last determines the width */
    again = scene;
    patched(&again, "{\"camera\":{\"field_m\":40}}");
    assert_true(again.camera.field_m == 40 && isinf(again.camera.field_uas));
    again = scene;
    assert_int_equal(kd_scene_set(&again, "camera.field_m", "41", &error), KD_OK);
    assert_true(again.camera.field_m == 41 && isinf(again.camera.field_uas));
    assert_int_equal(kd_scene_set(&again, "camera.field_uas", "100", &error), KD_OK);
    assert_true(fabs(again.camera.field_m / 104.7396457 - 1) < 1e-7);
    patched(&again, "{\"camera\":{\"field_uas\":null}}"); /* null of the width in uas leaves the width as it is */
    assert_true(fabs(again.camera.field_m / 104.7396457 - 1) < 1e-7 && isinf(again.camera.field_uas));
    patched(&scene, "{\"camera\":null}");
    assert_true(scene.camera.field_m == 46 && isinf(scene.camera.field_uas));

    /* The width is outside the range of the field in M: the message is about the field that was given */
    patched(&scene, "{\"camera\":{\"field_uas\":1e10}}");
    assert_int_equal(kd_scene_validate(&scene, &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/camera/field_uas");
    assert_non_null(strstr(error.message, "camera.field_uas is 10000000000 microarcseconds; it must be "));
    assert_non_null(strstr(error.message, "camera.field_m 1e-6 to 10000000, at this spacetime.mass_msun"));
    assert_int_equal(support_parse(&scene, "{\"camera\":{\"field_uas\":0}}", &error), KD_EINVAL);
    assert_non_null(strstr(error.message, "camera.field_uas is 0; it must be 1e-12 to 1000000000000 "
                                          "microarcseconds, or \"none\""));
}

static void canonical_form_is_stable(void **state)
{
    (void)state;
    struct kd_scene scene;
    kd_scene_defaults(&scene);
    scene.camera.azimuth_deg = -1e-7;
    scene.top.time = 0.1 + 0.2;
    char *text = support_canonical(&scene);
    const char *start =
        "{\"version\":1,\"spacetime\":{\"spin\":0.7,\"charge\":0,\"mass_msun\":100000000,\"distance_pc\":260000},"
        "\"camera\":{\"r\":\"infinity\",\"inclination_deg\":82,\"azimuth_deg\":-1e-7,";
    const char *middle =
        ",\"spots\":[{\"brightness\":0,\"r\":10,\"phase_deg\":0,\"size\":1,\"index\":1,\"temperature_k\":9000},"
        "{\"brightness\":0,\"r\":9,\"phase_deg\":0,\"size\":1,\"index\":1,\"temperature_k\":9000}],\"flash\":{";
    const char *end = "\"accuracy\":{\"profile\":\"balanced\",\"tolerance\":\"profile\",\"engine\":\"auto\","
                      "\"precision\":\"auto\",\"steps\":0,\"orders\":3},\"time\":0.30000000000000004}";
    assert_memory_equal(text, start, strlen(start));
    assert_true(strlen(text) > strlen(end));
    assert_string_equal(text + strlen(text) - strlen(end), end);
    assert_non_null(strstr(text, ",\"spots\":[],\"flash\":{\"brightness\":0,"));
    assert_non_null(strstr(text, "},\"bodies\":[],\"volume\":{"));
    free(text);
    scene.spots.count = 2;
    scene.spots.at[0].r = 10;
    text = support_canonical(&scene);
    assert_non_null(strstr(text, middle));
    free(text);
}

static void numbers_are_short(void **state)
{
    (void)state;
    static const struct {
        double value;
        const char *text;
    } cases[] = {
        { 0.1, "0.1" },
        { 1.0 / 3, "0.3333333333333333" },
        { 0.1 + 0.2, "0.30000000000000004" },
        { 1e-6, "1e-6" },
        { 1e22, "1e22" },
        { 5e-324, "4.94065645841247e-324" },
        { -0.999999999999, "-0.999999999999" },
        { 1e100, "1e100" },
        { 2.5e-10, "2.5e-10" },
        { 1e7, "10000000" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[KD_NUMBER_SIZE];
        kd_number_format(text, cases[i].value);
        assert_string_equal(text, cases[i].text);
        assert_true(kd_number_parse(text) == cases[i].value);
        assert_int_equal(kd_number_span(text, strlen(text)), strlen(text));
    }
}

static void invalid_scenes_have_no_text(void **state)
{
    (void)state;
    struct kd_scene scene;
    struct kd_buffer text = { 0 };
    char hash[65];
    kd_scene_defaults(&scene);
    scene.spacetime.spin = NAN;
    assert_int_equal(kd_scene_to_json(&scene, &text), KD_EINVAL);
    assert_int_equal(kd_scene_hash(&scene, hash), KD_EINVAL);
    assert_string_equal(hash, "");
    kd_scene_defaults(&scene);
    scene.spots.count = KD_SPOTS + 1;
    assert_int_equal(kd_scene_to_json(&scene, &text), KD_EINVAL);
    scene.spots.count = 0;
    scene.disk.model = 99;
    assert_int_equal(kd_scene_to_json(&scene, &text), KD_EINVAL);
    kd_buffer_finish(&text);
}

static void hash_feels_each_field(void **state)
{
    (void)state;
    struct kd_scene defaults;
    char original[65], hash[65], seen[KD_FIELD_COUNT][65];
    kd_scene_defaults(&defaults);
    assert_int_equal(kd_scene_hash(&defaults, hash), KD_OK);
    /* fills every list, so that its elements have fields to change; this itself changes the hash */
    for (size_t i = 0; i < KD_SECTION_COUNT; i++)
        if (kd_sections[i].most)
            kd_section_resize(&defaults, &kd_sections[i], kd_sections[i].most);
    assert_int_equal(kd_scene_hash(&defaults, original), KD_OK);
    assert_string_not_equal(hash, original);
    assert_int_equal(strspn(original, "0123456789abcdef"), 64);
    for (size_t i = 0; i < KD_FIELD_COUNT; i++) {
        const struct kd_row *field = &kd_fields[i];
        struct kd_scene scene = defaults;
        size_t last = kd_section_size(&scene, kd_section_find(field->object)) - 1;
        double value = kd_field_get(&scene, field, last);
        switch (field->kind) {
        case KD_KIND_REAL:
            value = field->words ? field->least : nextafter(value, value < field->most ? INFINITY : -INFINITY);
            break;
        default: value = kd_row_holds(field, value + 1) ? value + 1 : value - 1;
        }
        if (field->kind == KD_KIND_ASSET)
            assert_int_equal(kd_field_store(&scene, field, last, /* any value serves as the hash */
                                            &(struct kd_value) { KD_VALUE_STRING, 0, original }, NULL),
                             KD_OK);
        else
            kd_field_put(&scene, field, last, value);
        assert_int_equal(kd_scene_hash(&scene, seen[i]), KD_OK);
        assert_string_not_equal(seen[i], original);
        for (size_t j = 0; j < i; j++)
            assert_string_not_equal(seen[i], seen[j]);
    }
    assert_int_equal(kd_scene_hash(&defaults, hash), KD_OK);
    assert_string_equal(hash, original);
}

/* The digest computed by another program. */
static void hash_is_sha256(void **state)
{
    (void)state;
    struct kd_scene scene;
    char hash[65], other[65] = "", path[] = "/tmp/kerrd-scene-XXXXXX", command[96];
    kd_scene_defaults(&scene);
    assert_int_equal(kd_scene_hash(&scene, hash), KD_OK);
    char *text = support_canonical(&scene);
    int fd = mkstemp(path);
    FILE *file = fd < 0 ? NULL : fdopen(fd, "wb");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    free(text);
    snprintf(command, sizeof command, "sha256sum %s", path);
    FILE *pipe = popen(command, "r");
    bool read = pipe && fread(other, 1, 64, pipe) == 64;
    if (pipe)
        pclose(pipe);
    remove(path);
    if (!read) {
        print_message("sha256sum is not there to compare with\n");
        skip();
    }
    assert_string_equal(hash, other);
}

static void locale_does_not_matter(void **state)
{
    (void)state;
    static const char *const commas[] = { "de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "cs_CZ.UTF-8", "ru_RU.UTF-8" };
    const char *found = NULL;
    for (size_t i = 0; i < sizeof commas / sizeof *commas && !found; i++)
        found = setlocale(LC_ALL, commas[i]);
    if (!found) {
        print_message("no locale with a decimal comma is installed\n");
        skip();
    }
    struct kd_scene scene;
    kd_scene_defaults(&scene);
    enum kd_status parsed = support_parse(&scene, "{\"spacetime\":{\"spin\":0.25}}", NULL);
    enum kd_status set = kd_scene_set(&scene, "time", "1.5", NULL);
    char *text = support_canonical(&scene);
    setlocale(LC_ALL, "C");
    assert_int_equal(parsed, KD_OK);
    assert_int_equal(set, KD_OK);
    assert_true(scene.spacetime.spin == 0.25 && scene.top.time == 1.5);
    assert_non_null(strstr(text, "\"spin\":0.25,"));
    free(text);
}

/* Counts how often the reader of a large document yields to other work while it reads and frees the document. A high
 * number shows that its pieces are short. Also measures the fraction of the thread's time that the longest piece
 * took. */
static unsigned pauses;
static double last_s, longest_s, longest_share;
static double thread_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}
static bool count_pause(void)
{
    const double now = thread_s();
    longest_s = fmax(longest_s, now - last_s);
    last_s = now;
    pauses++;
    return false;
}

static cJSON *read_large(const char *text, size_t length, struct kd_error *error)
{
    cJSON *root = NULL;
    const double begun = last_s = thread_s();
    pauses = 0;
    longest_s = 0;
    kd_pause_hook = count_pause;
    kd_tree_parse(text, length, length, 1u << 20, &root, error);
    count_pause();
    kd_pause_hook = NULL;
    longest_share = longest_s / (last_s - begun);
    return root;
}

static void many_values_are_read_in_pieces(void **state)
{
    (void)state;
    enum { VALUES = 400000 };
    char *text = malloc(2 * VALUES + 2);
    for (size_t i = 0; i < VALUES; i++)
        memcpy(text + 2 * i, i ? ",7" : "[7", 2);
    memcpy(text + 2 * VALUES, "]", 2);
    struct kd_error error = { 0 };
    cJSON *root = read_large(text, 2 * VALUES + 1, &error);
    assert_int_equal(cJSON_GetArraySize(root), VALUES);
    assert_true(pauses > VALUES / 1000);
    pauses = 0;
    kd_pause_hook = count_pause;
    kd_tree_free(root);
    kd_pause_hook = NULL;
    assert_true(pauses > VALUES / 1000);
    free(text);
}

/* {"a":1,"long":"xx...","b":["xx..."],KEY:"xx...\"..."} */
static void long_strings_are_read_in_pieces(void **state)
{
    (void)state;
    const size_t n = (size_t)5 << 20, all = 4 * n + 100;
    char *text = malloc(all), *x = malloc(n + 1);
    memset(x, 'x', n);
    x[n] = 0;
    snprintf(text, all, "{\"a\":1,\"long\":\"%s\",\"b\":[\"%s\",2],\"%s\":\"\\\"%s\"}", x, x, x, x);
    struct kd_error error = { 0 };
    cJSON *root = read_large(text, strlen(text), &error);
    assert_true(pauses >= 2 * 4 * n >> 20); /* the reader pauses both when it scans a piece and when it copies it */
    const cJSON *b = cJSON_GetObjectItemCaseSensitive(root, "b"), *last = b->next;
    assert_string_equal(cJSON_GetObjectItemCaseSensitive(root, "long")->valuestring, x);
    assert_string_equal(cJSON_GetArrayItem(b, 0)->valuestring, x);
    assert_int_equal(cJSON_GetArrayItem(b, 1)->valueint, 2);
    assert_string_equal(last->string, x);
    assert_int_equal(*last->valuestring, '"');
    assert_string_equal(last->valuestring + 1, x);
    cJSON_Delete(root);
    /* no string of the document is mistaken for the placeholder of a long string, whatever its escapes are */
    snprintf(text, all, "{\"\\u0001\":\"\\u0001\",\"\\u00ff\":\"\\u00ff\",\"long\":\"%s\"}", x);
    root = read_large(text, strlen(text), &error);
    assert_string_equal(root->child->string, "\x01");
    assert_string_equal(root->child->valuestring, "\x01");
    assert_string_equal(root->child->next->string, "\xc3\xbf");
    assert_string_equal(root->child->next->valuestring, "\xc3\xbf");
    assert_string_equal(cJSON_GetObjectItemCaseSensitive(root, "long")->valuestring, x);
    cJSON_Delete(root);
    assert_null(read_large("{\"a\":\"\xff\"}", 9, &error));
    /* the place of an error is given relative to the whole document */
    static const char wrong[] = "{\"long\":\"%s\",\"b\":{]}";
    size_t of_short = 0, of_long = 0;
    for (int i = 0; i < 2; i++) {
        snprintf(text, all, wrong, i ? x : "x");
        assert_null(read_large(text, strlen(text), &error));
        assert_int_equal(
            sscanf(error.message, "the document is not valid JSON near byte %zu", i ? &of_long : &of_short), 1);
    }
    assert_int_equal(of_long, of_short + n - 1);
    free(text);
    free(x);
}

/* Escapes of every kind, at every distance from the border of a piece, are decoded as cJSON decodes them in a short
 * string. However many there are, the reader yields to other work in between. */
static void long_strings_with_escapes_are_read_in_pieces(void **state)
{
    (void)state;
    static const char escapes[] = "\\n\\\"\\\\\\/\\b\\f\\r\\t\\u0001\\u007f\\u0080\\u07FF\\u0800\\uffff\\uD83D\\uDE00"
                                  "\\udbff\\udfff\\ud800\\udc00\xc3\xa9x";
    const size_t n = strlen(escapes), times = ((size_t)5 << 20) / n + 1;
    char *text = malloc(n * (times + 1) + 100), *end = text + sprintf(text, "{\"short\":\"%s\",\"long\":\"", escapes);
    for (size_t i = 0; i < times; i++, end += n)
        memcpy(end, escapes, n);
    strcpy(end, "\"}");
    struct kd_error error = { 0 };
    cJSON *root = read_large(text, strlen(text), &error);
    assert_non_null(root);
    assert_true(pauses >= 5);
    const char *one = cJSON_GetObjectItemCaseSensitive(root, "short")->valuestring,
               *all = cJSON_GetObjectItemCaseSensitive(root, "long")->valuestring;
    const size_t length = strlen(one);
    assert_int_equal(strlen(all), length * times);
    for (size_t i = 0; i < times; i++)
        assert_memory_equal(all + length * i, one, length);
    cJSON_Delete(root);
    free(text);
    /* M_PERTURB is switched off: otherwise glibc would fill the memory in one long piece, which is not the reader's
     * work */
    mallopt(M_PERTURB, 0);
    const size_t many = (size_t)12 << 20;
    text = malloc(2 * many + 10);
    for (size_t shift = 0; shift < 2; shift++) { /* only escapes, which begin at an even and at an odd place */
        end = text + sprintf(text, "%s[\"", shift ? " " : "");
        for (size_t i = 0; i < many; i++, end += 2)
            memcpy(end, "\\n", 2);
        strcpy(end, "\"]");
        /* the best of several tries counts, because on a busy machine the kernel's memory management may delay one
         * piece */
        double share = 1;
        for (int attempt = 0; attempt < 10 && share >= 0.15; attempt++) {
            root = read_large(text, strlen(text), &error);
            assert_int_equal(strlen(root->child->valuestring), many);
            print_message("the longest of %u pieces took %.3f of the time\n", pauses, longest_share);
            share = longest_share < share ? longest_share : share;
            cJSON_Delete(root);
        }
        assert_true(share < 0.15); /* cJSON alone would spend a fifth of the time on the string */
    }
    memcpy(end - 12, "\\ud83d\\u0041", 12);
    assert_null(read_large(text, strlen(text), &error));
    assert_non_null(strstr(error.message, "half of a surrogate pair"));
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_scenes_round_trip),
        cmocka_unit_test(empty_document_is_the_default),
        cmocka_unit_test(documents_merge),
        cmocka_unit_test(patches),
        cmocka_unit_test(lists_merge),
        cmocka_unit_test(old_names_are_read),
        cmocka_unit_test(sections_stand_in_sections),
        cmocka_unit_test(elements_are_set),
        cmocka_unit_test(a_field_in_microarcseconds),
        cmocka_unit_test(canonical_form_is_stable),
        cmocka_unit_test(numbers_are_short),
        cmocka_unit_test(invalid_scenes_have_no_text),
        cmocka_unit_test(hash_feels_each_field),
        cmocka_unit_test(hash_is_sha256),
        cmocka_unit_test(locale_does_not_matter),
        cmocka_unit_test(many_values_are_read_in_pieces),
        cmocka_unit_test(long_strings_are_read_in_pieces),
        cmocka_unit_test(long_strings_with_escapes_are_read_in_pieces),
    };
    return cmocka_run_group_tests_name("scene documents", tests, NULL, NULL);
}
