/* Tests that the table of emitters is complete: plan, approximations, motion and numbers cover every emitter. */
#include "render/emit/emitter.h"
#include "render/emit/motion.h"
#include "render/emit/describe.h"
#include "render/output/notes.h"
#include "render/plan/plan.h"
#include "render/rays/answer.h"
#include "scene/table.h"
#include "scene/dynamic_bodies.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void all_are_there(void **state)
{
    (void)state;
    for (int i = 0; i < KD_EMITTER_COUNT; i++) {
        assert_non_null(kd_emitters[i]);
        assert_non_null(kd_emitters[i]->name);
        assert_non_null(kd_emitters[i]->title);
        assert_non_null(kd_emitters[i]->present);
        assert_true(kd_emitters[i]->n_sentences > 0); /* each has approximations */
        assert_true(!kd_emitters[i]->fill ||
                    kd_emitters[i]->depends[0].size); /* without dependencies, the numbers would be filled only once */
    }
}

/* A plan has room for all sentences, so that none is dropped without notice. */
static void sentences_have_room(void **state)
{
    (void)state;
    assert_true(kd_emit_sentence_count() + kd_plan_sentence_count() <= KD_PLAN_MAX_APPROXIMATIONS);
    assert_true(kd_emit_sentence_count() > 20);
}

/* A header lists the approximations of a scene, separated by commas, and proxies limit all headers together to 4096
 * bytes. No scene has all approximations; tests/http/headers.py renders the scene with the longest headers. */
enum { ALL_NAMES = 2400 };
static void check_name(const char *name, char all[ALL_NAMES])
{
    char listed[40];
    assert_int_equal(name[strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789-.")], 0);
    assert_in_range(snprintf(listed, sizeof listed, ",%s,", name), 6, 24);
    if (strstr(all, listed))
        fail_msg("two approximations have the name %s", name);
    strcat(all, listed + 1);
    assert_true(strlen(all) < ALL_NAMES - sizeof listed);
}

static void names_are_short_and_differ(void **state)
{
    (void)state;
    char all[ALL_NAMES] = ",";
    struct kd_approximation one;
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        for (size_t k = 0; k < kd_emitters[i]->n_sentences; k++)
            check_name(kd_emitters[i]->sentences[k].name, all);
    for (size_t i = 0; i < kd_plan_sentence_count(); i++)
        check_name(kd_plan_sentence(i).name, all);
    for (size_t i = 0; kd_measured_approximation(NULL, i, &one); i++)
        check_name(one.name, all);
    for (size_t i = 0; kd_rays_approximation(NULL, i, &one); i++)
        check_name(one.name, all);
}

/* A report lists the approximations of the plan first. Then come approximations that only a rendered picture can have.
 */
static void what_a_report_counts_is_said(void **state)
{
    (void)state;
    static struct kd_plan plan;
    struct kd_accuracy_report report = { .sampled = 768 };
    struct kd_approximation one;
    plan.report.approximations[plan.report.n_approximations++] = kd_plan_sentence(0);
    assert_true(kd_picture_approximation(&plan.report, &report, 0, &one));
    assert_string_equal(one.name, kd_plan_sentence(0).name);
    assert_false(kd_picture_approximation(&plan.report, &report, 1, &one));
    report.lost = 1;
    assert_true(kd_picture_approximation(&plan.report, &report, 1, &one));
    assert_string_equal(one.name, "light.lost");
    report.undecided = report.differ = 2;
    static const char *const names[] = { "rays.undecided", "rays.differ", "light.lost" };
    for (size_t i = 0; i < 3; i++) {
        assert_true(kd_picture_approximation(&plan.report, &report, 1 + i, &one));
        assert_string_equal(one.name, names[i]);
    }
    assert_false(kd_picture_approximation(&plan.report, &report, 4, &one));
}

struct said {
    size_t n;
    const char *text[64];
};
static void take(void *user, struct kd_approximation approximation)
{
    struct said *said = user;
    said->text[said->n++] = approximation.text;
}
static bool says(const struct kd_scene *scene, const char *start)
{
    const struct kd_setting rays = { 0 };
    struct said said = { 0 };
    kd_emit_sentences(scene, &rays, take, &said);
    for (size_t i = 0; i < said.n; i++)
        if (!strncmp(said.text[i], start, strlen(start)))
            return true;
    return false;
}

static void what_is_off_says_and_needs_nothing(void **state)
{
    (void)state;
    struct kd_scene scene;
    uint32_t traits[KD_EMITTER_COUNT];
    kd_scene_smooth(&scene);
    assert_int_equal(kd_emit_needs(&scene), KD_LENS_W);
    assert_true(says(&scene, "disk: it is geometrically thin") && !says(&scene, "particles:") && !says(&scene, "sky:"));
    scene.disk.model = KD_DISK_PARTICLES;
    assert_true(says(&scene, "disk: it is geometrically thin") &&
                says(&scene, "particles: the whole disk is shown at one"));
    kd_emit_traits(&scene, traits);
    assert_true(!traits[KD_EMITTER_disk] && traits[KD_EMITTER_particles] && traits[KD_EMITTER_plunge]);
    assert_int_equal(kd_emit_needs(&scene), KD_LENS_W | KD_LENS_PHI | KD_LENS_SLOPE);
    scene.disk.model = KD_DISK_NONE;
    assert_int_equal(kd_emit_needs(&scene), 0);
    scene.sky.model = KD_SKY_GRID;
    assert_int_equal(kd_emit_needs(&scene), KD_LENS_SKY);
    kd_emit_traits(&scene, traits);
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        assert_int_equal(traits[i] != 0, i == KD_EMITTER_sky);
}

#define SAME(number, name) \
    if (traits[number]) \
        assert_memory_equal(&one->data.emission.name, &fresh->data.emission.name, sizeof one->data.emission.name);

static const char BASE[] =
    "{\"disk\": {\"model\": \"particles\", \"slow_light\": true, \"band\": \"visible\"}, \"sky\": {\"model\": "
    "\"grid\"}, "
    "\"spots\": [{\"brightness\": 1}], \"style\": {\"ringdown\": 0.5}, \"time\": 7, \"camera\": {\"r\": 40}}";

static const char STARS[] = "{\"disk\": {\"model\": \"none\"}, \"sky\": {\"model\": \"stars\", \"orientation\": "
                            "\"sgra\", \"turn_deg\": 3, \"tilt_deg\": 4}, "
                            "\"camera\": {\"r\": 40}}";

static const char GAS[] =
    "{\"disk\": {\"slow_light\": true, \"emission_opacity\": 10, \"gas\": {\"amplitude\": 1}}, \"time\": 7, "
    "\"camera\": {\"r\": 40}}";

static const char FLASH[] = "{\"flash\": {\"brightness\": 1, \"period\": 100}, \"disk\": {\"slow_light\": true, "
                            "\"atmosphere\": \"laor\"}, \"time\": 7, \"camera\": {\"r\": 40}}";

/* Numbers depend only on the current scene. They do not depend on the order of scenes, or on numbers that were filled
 * before. */
static void numbers_follow_the_scene(void **state)
{
    (void)state;
    struct kd_emit_state *one = calloc(1, sizeof *one), *fresh = calloc(1, sizeof *fresh);
    struct kd_scene scenes[5];
    assert_true(one && fresh);
    for (int k = 0; k < 5; k++)
        kd_scene_smooth(&scenes[k]);
    scenes[1].spacetime.spin = 0.3;
    scenes[2].disk.peak_temperature_k = 9000;
    scenes[3].disk.model = KD_DISK_PARTICLES;
    scenes[3].accuracy.orders = 5;
    scenes[4].sky.model = KD_SKY_GRID;
    scenes[4].style.ringdown = 0.5;
    scenes[4].top.time = 7;
    for (int k = 0; k < 25; k++) {
        const struct kd_scene *scene = &scenes[k * 7 % 5];
        uint32_t traits[KD_EMITTER_COUNT];
        kd_emit_update(one, scene, 100);
        memset(fresh, 0, sizeof *fresh);
        kd_emit_update(fresh, scene, 100);
        kd_emit_traits(scene, traits);
        KD_EMITTERS(SAME, SAME, SAME, SAME, SAME, SAME)
        assert_memory_equal(&one->data.emission.disk, &fresh->data.emission.disk, sizeof one->data.emission.disk);
        assert_memory_equal(one->data.tables.disk, fresh->data.tables.disk, sizeof one->data.tables.disk);
        assert_memory_equal(one->data.tables.colour, fresh->data.tables.colour, sizeof one->data.tables.colour);
    }
    free(one);
    free(fresh);
}

/* After the change of any field, the emitters' cached data equals new data. */
static int follow_each_field(const char *document)
{
    struct kd_emit_state *one = calloc(1, sizeof *one), *fresh = calloc(1, sizeof *fresh);
    struct kd_scene base, scene;
    struct kd_error error;
    int tried = 0;
    assert_true(one && fresh);
    kd_scene_smooth(&base);
    assert_int_equal(kd_scene_from_json(&base, document, strlen(document), &error), KD_OK);
    assert_int_equal(kd_scene_validate(&base, &error), KD_OK);
    for (int i = 0; i < KD_FIELD_COUNT; i++) {
        const struct kd_row *f = &kd_fields[i];
        double was = kd_field_get(&base, f, 0);
        const double others[] = { was * 1.1 + 0.01, was + 1, was - 1, f->least, f->most, was * 0.9 };
        for (size_t k = 0; k < sizeof others / sizeof *others; k++) {
            scene = base;
            if (others[k] == was || !kd_row_holds(f, others[k]))
                continue;
            kd_field_put(&scene, f, 0, others[k]);
            if (kd_scene_validate(&scene, &error))
                continue;
            kd_emit_update(one, &base, 100);
            kd_emit_update(one, &scene, 100);
            memset(fresh, 0, sizeof *fresh);
            fresh->colours = one->colours; /* computing these takes 15 ms, and they do not depend on the scene */
            fresh->luminous = one->luminous;
            kd_emit_update(fresh, &scene, 100);
            uint32_t traits[KD_EMITTER_COUNT];
            kd_emit_traits(&scene, traits);
            KD_EMITTERS(SAME, SAME, SAME, SAME, SAME, SAME)
            if (traits[KD_EMITTER_particles])
                assert_memory_equal(one->data.tables.disk, fresh->data.tables.disk, sizeof one->data.tables.disk);
            if (traits[KD_EMITTER_gas])
                assert_memory_equal(one->data.tables.gas, fresh->data.tables.gas, sizeof one->data.tables.gas);
            if (traits[KD_EMITTER_flash])
                assert_memory_equal(one->data.tables.lamp, fresh->data.tables.lamp, sizeof one->data.tables.lamp);
            if (traits[KD_EMITTER_plunge])
                assert_memory_equal(one->data.tables.plunge, fresh->data.tables.plunge, sizeof one->data.tables.plunge);
            tried++;
            break;
        }
    }
    free(one);
    free(fresh);
    return tried;
}

#define VOLUME(rest) "{\"disk\": {\"model\": \"none\"}, \"volume\": {\"model\": " rest "}}"
static const char *const volumes[] = {
    VOLUME("\"uniform\""),
    VOLUME("\"gold\", \"gold_momentum\": 0.5, \"gold_flattening\": 2"),
    VOLUME("\"riaf\""),
    VOLUME("\"torus\", \"inner\": 6, \"outer\": 90, \"electrons\": \"kappa\""),
    "{\"disk\": {\"model\": \"none\"}, \"volume\": {\"model\": \"riaf\"}, \"polarization\": {\"model\": "
    "\"transfer\"}}",
    "{\"jets\": {\"brightness\": 1}, \"bodies\": [{\"radius\": 1}]}",
};

static void numbers_follow_each_field(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof volumes / sizeof *volumes; k++)
        assert_true(follow_each_field(volumes[k]) > 30);
    assert_true(follow_each_field(BASE) > 40); /* skipped: the other fields are words, or depend on a third field */
    assert_true(follow_each_field(GAS) > 40);
    assert_true(follow_each_field(STARS) > 40);
    assert_true(follow_each_field(FLASH) > 40);
}

/* Gas replaces the smooth disk. Features that are switched off are not evaluated. */
static void gas_replaces_the_disk(void **state)
{
    (void)state;
    struct kd_scene scene;
    uint32_t traits[KD_EMITTER_COUNT];
    kd_scene_smooth(&scene);
    scene.gas.octaves = 3;
    scene.gas.seed = 7;
    kd_emit_traits(&scene, traits);
    assert_true(traits[KD_EMITTER_disk] && !traits[KD_EMITTER_gas] && !says(&scene, "gas:"));
    scene.disk.emission_opacity = 10;
    kd_emit_traits(&scene, traits);
    assert_true(!traits[KD_EMITTER_disk] && traits[KD_EMITTER_gas] && kd_emit_at_crossings(&scene));
    assert_int_equal(kd_emit_needs(&scene), KD_LENS_W);
    assert_true(says(&scene, "gas: the disk's optical depth") && says(&scene, "disk: it is geometrically thin") &&
                !says(&scene, "gas: turbulence"));
    scene.motion.time_rate = 1;
    assert_false(kd_emit_moves(&scene));
    scene.gas.amplitude = 0.5;
    assert_int_equal(kd_emit_needs(&scene), KD_LENS_W | KD_LENS_PHI | KD_LENS_SHAPE);
    assert_true(says(&scene, "gas: turbulence") && says(&scene, "gas: the gas is shown at one") &&
                kd_emit_moves(&scene));
    scene.disk.slow_light = true;
    assert_int_equal(kd_emit_needs(&scene), KD_LENS_W | KD_LENS_PHI | KD_LENS_SHAPE | KD_LENS_DELAY);
    assert_true(!says(&scene, "gas: the gas is shown at one") && !kd_emit_slow_along(&scene));
    scene.disk.height = 0.1; /* no delay plane, because the march computes delays itself */
    assert_int_equal(kd_emit_needs(&scene), KD_LENS_W | KD_LENS_PHI | KD_LENS_SHAPE);
    assert_true(!says(&scene, "gas: the gas is shown at one") && kd_emit_slow_along(&scene));
    scene.gas.amplitude = 0; /* nothing moves */
    assert_false(kd_emit_slow_along(&scene));
    scene.gas.amplitude = 0.5;
    scene.disk.height = 0;
    scene.disk.model = KD_DISK_PARTICLES;
    kd_emit_traits(&scene, traits);
    assert_true(!traits[KD_EMITTER_gas] && traits[KD_EMITTER_particles]);
    scene.disk.model = KD_DISK_NONE;
    assert_false(kd_emit_at_crossings(&scene));
    assert_int_equal(kd_emit_needs(&scene), 0);
}

/* Kernels have code for an atmosphere only if the scene's disk has one. For rays of a ring projection, which are on no
 * grid, the angle of emission then needs the slope of the ray. */
static void atmospheres_are_a_variant(void **state)
{
    (void)state;
    static const int models[] = { KD_DISK_NOVIKOV_THORNE, KD_DISK_SHAKURA_SUNYAEV, KD_DISK_PARTICLES };
    for (size_t k = 0; k < 2 * sizeof models / sizeof *models; k++) {
        const enum kd_emitter_number number = k / 2 == 2 ? KD_EMITTER_particles
                                              : k % 2    ? KD_EMITTER_gas
                                                         : KD_EMITTER_disk;
        struct kd_scene scene;
        uint32_t traits[KD_EMITTER_COUNT];
        kd_scene_smooth(&scene);
        scene.disk.model = models[k / 2];
        scene.disk.emission_opacity = k % 2 ? 5 : 0;
        kd_emit_traits(&scene, traits);
        assert_true(traits[number] && !(traits[number] & KD_TRAIT_LIMB));
        assert_true(says(&scene, "disk: each element shines as an isotropic") && !says(&scene, "disk: the limb"));
        scene.disk.atmosphere = KD_ATMOSPHERE_SCATTERING;
        kd_emit_traits(&scene, traits);
        assert_true(traits[number] & KD_TRAIT_LIMB);
        assert_true(!says(&scene, "disk: each element shines as an isotropic") && says(&scene, "disk: the limb"));
        const uint32_t before = kd_emit_needs(&scene);
        scene.camera.projection = KD_PROJECTION_RING;
        assert_int_equal(kd_emit_needs(&scene), before | KD_LENS_SLOPE);
    }
}

/* A flash needs a delay only with slow light, and its kernel has an atmosphere only if the disk has one. */
static void a_flash_is_off_by_default(void **state)
{
    (void)state;
    struct kd_scene scene;
    uint32_t traits[KD_EMITTER_COUNT];
    kd_scene_smooth(&scene);
    scene.disk.model = KD_DISK_NONE;
    scene.flash.brightness = 1;
    kd_emit_traits(&scene, traits);
    assert_true(traits[KD_EMITTER_flash] && traits[KD_EMITTER_lamp] && !(traits[KD_EMITTER_flash] & KD_TRAIT_LIMB));
    assert_int_equal(kd_emit_needs(&scene), KD_LENS_W);
    assert_true(says(&scene, "flash: the echo is shown at one") && says(&scene, "flash: the lit gas shines iso") &&
                says(&scene, "lamp:"));
    assert_int_equal(kd_emit_varies(&scene) & ~KD_MOVES_BY_FALL, KD_MOVES_WITH_TIME);
    scene.disk.slow_light = true;
    scene.disk.atmosphere = KD_ATMOSPHERE_LAOR;
    kd_emit_traits(&scene, traits);
    assert_true(traits[KD_EMITTER_flash] & KD_TRAIT_LIMB && traits[KD_EMITTER_flash] & KD_TRAIT_SLOW);
    assert_int_equal(kd_emit_needs(&scene), KD_LENS_W | KD_LENS_DELAY);
    assert_true(!says(&scene, "flash: the echo is shown at one") && !says(&scene, "flash: the lit gas shines iso"));
    scene.flash.brightness = 0;
    kd_emit_traits(&scene, traits);
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        assert_int_equal(traits[i], 0);
    assert_int_equal(kd_emit_needs(&scene), 0);
}

/* Light of one frequency is a variant of the disk. The picture has a flux only if there is no other light than the
 * disk's. */
static void a_frequency_is_a_variant(void **state)
{
    (void)state;
    struct kd_scene scene;
    uint32_t traits[KD_EMITTER_COUNT];
    kd_scene_smooth(&scene);
    scene.sky.model = KD_SKY_NONE;
    kd_emit_traits(&scene, traits);
    assert_true(!(traits[KD_EMITTER_disk] & KD_TRAIT_FREQUENCY) && !kd_scene_is_radio_alone(&scene));
    scene.disk.band = KD_BAND_FREQUENCY;
    kd_emit_traits(&scene, traits);
    assert_true(traits[KD_EMITTER_disk] & KD_TRAIT_FREQUENCY && kd_scene_is_radio_alone(&scene));
    assert_true(says(&scene, "disk: brightness is the specific intensity") && !says(&scene, "disk: brightness is bol"));
    assert_false(says(&scene, "disk: light of one frequency is shown beside"));
    scene.sky.model = KD_SKY_GRID;
    assert_true(says(&scene, "disk: light of one frequency is shown beside") && !kd_scene_is_radio_alone(&scene));
    scene.sky.model = KD_SKY_NONE;
    scene.volume.model = KD_VOLUME_RIAF;
    assert_false(kd_scene_is_radio_alone(&scene));
    scene.disk.model = KD_DISK_NONE;
    assert_true(kd_scene_is_radio_alone(&scene));
}

/* Kernels have code for reflected light only if the scene's disk reflects. Light that is absorbed and radiated again
 * only changes a table. */
static void reflection_is_a_variant(void **state)
{
    (void)state;
    static const char *const told[] = { "disk: light that the hole bends back", "disk: returning light",
                                        "disk: reflected light has" };
    for (int returning = KD_RETURNS_NONE; returning <= KD_RETURNS_REFLECTED; returning++)
        for (int albedo = 0; albedo < 2; albedo++) {
            struct kd_scene scene;
            uint32_t traits[KD_EMITTER_COUNT];
            const bool reflects = returning == KD_RETURNS_REFLECTED && albedo;
            kd_scene_smooth(&scene);
            scene.disk.returning = returning;
            scene.disk.albedo = albedo;
            kd_emit_traits(&scene, traits);
            assert_int_equal(!!(traits[KD_EMITTER_disk] & KD_TRAIT_REFLECTED), reflects);
            assert_int_equal(says(&scene, told[0]), !returning);
            assert_int_equal(says(&scene, told[1]), !!returning);
            assert_int_equal(says(&scene, told[2]), reflects);
        }
}

/* An emitter has only those variants that its GLSL lists. They do not overlap; a compile-time check ensures that. */
#define LISTED(trait) | KD_TRAIT_##trait
#define WORD(number, name) [number] = KD_TRAIT_PRESENT KD_TRAITS_##name(LISTED),
static void traits_are_listed(void **state)
{
    (void)state;
    static const uint32_t listed[KD_EMITTER_COUNT] = { KD_EMITTERS(WORD, WORD, WORD, WORD, WORD, WORD) };
    static const char *const documents[] = {
        "{}", BASE, GAS, "{\"disk\": {\"atmosphere\": \"scattering\", \"returning\": \"reflected\"}}",
        "{\"disk\": {\"doppler\": false, \"gas\": {\"amplitude\": 1, \"octaves\": 8}}}"
    };
    for (size_t k = 0; k < sizeof documents / sizeof *documents; k++) {
        struct kd_scene scene;
        struct kd_error error;
        uint32_t traits[KD_EMITTER_COUNT];
        kd_scene_smooth(&scene);
        assert_int_equal(kd_scene_from_json(&scene, documents[k], strlen(documents[k]), &error), KD_OK);
        kd_emit_traits(&scene, traits);
        for (int i = 0; i < KD_EMITTER_COUNT; i++)
            if (traits[i] & ~listed[i])
                fail_msg("%s has 0x%x, and lists 0x%x", kd_emitters[i]->name, traits[i], listed[i]);
    }
}

static void what_shines_is_told(void **state)
{
    (void)state;
    struct kd_scene scene;
    struct kd_error error;
    struct kd_buffer json = { 0 };
    kd_scene_smooth(&scene);
    assert_int_equal(kd_scene_from_json(&scene, BASE, strlen(BASE), &error), KD_OK);
    scene.disk.inner = 8;
    scene.disk.plunging = 0;
    assert_int_equal(kd_emit_to_json(&scene, &json), KD_OK);
    assert_int_equal(kd_buffer_printf(&json, "%c", 0), KD_OK);
    assert_string_equal((const char *)json.data,
                        "[{\"name\":\"particles\",\"title\":\"particles\",\"at\":\"crossing\",\"apart\":false,"
                        "\"sentence\":\"A disk of 300000 particles from 8 M to 22 M.\"},"
                        "{\"name\":\"spots\",\"title\":\"spots\",\"at\":\"crossing\",\"apart\":true,"
                        "\"sentence\":\"Hot spots going round at 9 M.\"},"
                        "{\"name\":\"ringdown\",\"title\":\"ringdown\",\"at\":\"\",\"apart\":false},"
                        "{\"name\":\"sky\",\"title\":\"sky\",\"at\":\"end\",\"apart\":false,\"sentence\":\"A celestial "
                        "grid behind.\"}]");
    kd_buffer_finish(&json);
}

/* Stars have a pass of their own; diffuse light has none. Without stars and diffuse light the sky is black. */
static void skies(void **state)
{
    (void)state;
    struct kd_scene scene;
    uint32_t traits[KD_EMITTER_COUNT];
    kd_scene_smooth(&scene);
    assert_false(kd_emit_points(&scene));
    scene.sky.model = KD_SKY_GRID;
    assert_true(!kd_emit_points(&scene) && !kd_emit_device_bytes(&scene) && says(&scene, "sky: it is a drawn") &&
                !says(&scene, "sky: the light between"));
    scene.sky.model = KD_SKY_STARS;
    assert_true(kd_emit_points(&scene) && kd_emit_needs(&scene) == (KD_LENS_W | KD_LENS_SKY | KD_LENS_SKY_FOOTPRINT));
    assert_true(says(&scene, "sky: stars are generated") &&
                says(&scene, "sky: the light between the stars is a generated Milky Way") &&
                !says(&scene, "sky: it is a drawn"));
    assert_false(says(&scene, "sky: the light between the stars is shifted"));
    scene.camera.r = 40;
    assert_true(says(&scene, "sky: the light between the stars is shifted"));
    uint64_t bytes = kd_emit_device_bytes(&scene);
    scene.sky.milky_way = 0;
    scene.sky.model = KD_SKY_CATALOGUE;
    assert_true(says(&scene, "sky: the stars are those of the Hipparcos") && !says(&scene, "sky: the light between") &&
                /* 2048 x 1024 words, and a third of that for smaller levels */
                kd_emit_device_bytes(&scene) < bytes - 11000000);
    kd_emit_traits(&scene, traits);
    uint32_t bolometric = traits[KD_EMITTER_sky];
    scene.disk.band = KD_BAND_VISIBLE;
    kd_emit_traits(&scene, traits);
    assert_true(traits[KD_EMITTER_sky] != bolometric);
    scene.sky.brightness = 0;
    assert_true(!kd_emit_points(&scene) && !kd_emit_device_bytes(&scene));
}

static void told(int model, double milky_way, const char *image, const char *sentence)
{
    struct kd_scene scene;
    struct kd_buffer json = { 0 };
    kd_scene_smooth(&scene);
    scene.sky.model = model;
    scene.sky.milky_way = milky_way;
    snprintf(scene.sky.image, sizeof scene.sky.image, "%s", image);
    assert_int_equal(kd_emit_to_json(&scene, &json), KD_OK);
    if (!strstr((const char *)json.data, sentence))
        fail_msg("%s", (const char *)json.data);
    kd_buffer_finish(&json);
}

/* A panorama alone, a panorama under stars, and a missing panorama each have a sentence. The last one is an
 * approximation. */
static void pictures_of_the_sky(void **state)
{
    (void)state;
    static const char hash[] = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
    told(KD_SKY_STARS, 1, "", "\"Stars and a Milky Way behind.\"");
    told(KD_SKY_STARS, 0, hash, "\"Stars behind.\"");
    told(KD_SKY_STARS, 1, hash, "\"Stars over a picture of the sky behind.\"");
    told(KD_SKY_CATALOGUE, 0, "", "\"The stars of the Hipparcos catalogue behind.\"");
    told(KD_SKY_CATALOGUE, 1, hash, "\"The stars of the Hipparcos catalogue over a picture of the sky behind.\"");
    told(KD_SKY_IMAGE, 1, hash, "\"A picture of the sky behind.\"");
    told(KD_SKY_IMAGE, 1, "", "\"A Milky Way behind.\"");
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.sky.model = KD_SKY_IMAGE;
    scene.camera.r = 40;
    assert_true(!kd_emit_points(&scene) && kd_emit_needs(&scene) == (KD_LENS_W | KD_LENS_SKY | KD_LENS_SKY_FOOTPRINT));
    assert_true(says(&scene, "sky: the generated Milky Way is shown") &&
                says(&scene, "sky: the light between the stars is a generated Milky Way"));
    uint64_t stands_in = kd_emit_device_bytes(&scene);
    strcpy(scene.sky.image, hash);
    assert_true(!says(&scene, "sky: the generated Milky Way is shown") &&
                !says(&scene, "sky: the light between the stars is a generated Milky Way"));
    assert_true(says(&scene, "sky: the light between the stars is a photograph") &&
                says(&scene, "sky: a picture of three colours has no spectrum"));
    assert_true(kd_emit_device_bytes(&scene) > 3 * stands_in);
    scene.sky.milky_way = 0; /* now the sky has no light at all */
    assert_true(!says(&scene, "sky:") && kd_emit_needs(&scene) == KD_LENS_W && !kd_emit_device_bytes(&scene));
}

/* "auto": 0.2 for the grid and for a sky alone, 0.01 for stars behind other light. */
static void brightness_of_skies(void **state)
{
    (void)state;
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    assert_true(isinf(scene.sky.brightness));
    scene.sky.model = KD_SKY_GRID;
    assert_true(kd_scene_sky_brightness(&scene) == 0.2);
    for (int model = KD_SKY_STARS; model <= KD_SKY_IMAGE; model++) {
        kd_scene_smooth(&scene);
        scene.sky.model = model;
        assert_true(kd_scene_sky_brightness(&scene) == 0.01);
        scene.disk.model = KD_DISK_NONE;
        assert_true(kd_scene_sky_brightness(&scene) == 0.2);
        scene.spots.count = 1;
        assert_true(kd_scene_sky_brightness(&scene) == 0.2); /* the spot is off */
        scene.spots.at[0].brightness = 1;
        assert_true(kd_scene_sky_brightness(&scene) == 0.01);
        scene.sky.brightness = 3;
        assert_true(kd_scene_sky_brightness(&scene) == 3);
    }
}

/* If the number of falling particles rounds to 0, none fall. */
static void none_of_a_thousand(void **state)
{
    (void)state;
    struct kd_scene scene;
    uint32_t traits[KD_EMITTER_COUNT];
    kd_scene_smooth(&scene);
    scene.disk.model = KD_DISK_PARTICLES;
    scene.disk.particles = 1000;
    scene.disk.plunging = 0.0004;
    kd_emit_traits(&scene, traits);
    assert_true(traits[KD_EMITTER_particles] && !traits[KD_EMITTER_plunge]);
    assert_int_equal(kd_emit_needs(&scene), KD_LENS_W | KD_LENS_PHI);
    scene.disk.plunging = 0.0006;
    kd_emit_traits(&scene, traits);
    assert_true(traits[KD_EMITTER_plunge]);
}

static bool alike(const struct kd_scene *scene, const struct kd_work *work)
{
    const struct kd_work own = kd_emit_work(scene);
    return kd_work_alike(&own, work);
}

/* kd_emit_work differs between scenes of different cost: for each emitter, for each variant, and for twice as many
 * elements of an emitter that has its own pass or buffers. Positions, time and brightness do not change it. */
static void work_follows_emitters(void **state)
{
    (void)state;
    struct kd_scene smooth, scene;
    kd_scene_smooth(&smooth);
    const struct kd_work work = kd_emit_work(&smooth);
#define OTHER(member, value) \
    do { \
        scene = smooth; \
        scene.member = value; \
        assert_false(alike(&scene, &work)); \
    } while (0)
    OTHER(sky.model, KD_SKY_STARS);
    OTHER(sky.model, KD_SKY_GRID);
    OTHER(disk.model, KD_DISK_PARTICLES);
    OTHER(disk.height, 0.1);
    OTHER(disk.atmosphere, true);
    OTHER(disk.returning, KD_RETURNS_REFLECTED);
    OTHER(disk.emission_opacity, 1);
    OTHER(gas.amplitude, 0.5);
    OTHER(volume.model, KD_VOLUME_UNIFORM);
    OTHER(volume.model, KD_VOLUME_RIAF);
    OTHER(style.ringdown, 1);
#define ALIKE(member, value) \
    do { \
        scene = smooth; \
        scene.member = value; \
        assert_true(alike(&scene, &work)); \
    } while (0)
    ALIKE(disk.model, KD_DISK_SHAKURA_SUNYAEV);
    ALIKE(disk.returning, KD_RETURNS_THERMALISED);
    ALIKE(disk.slow_light, true); /* slow light of a disk that does not move */
    ALIKE(disk.outer, 30);
    ALIKE(spacetime.spin, 0.3);
    ALIKE(camera.azimuth_deg, 20);
    ALIKE(top.time, 7);
    ALIKE(image.width, 64);
    ALIKE(style.exposure, 2);

    scene = smooth;
    scene.disk.model = KD_DISK_PARTICLES;
    scene.disk.particles = 100000;
    const struct kd_work particles = kd_emit_work(&scene);
    scene.disk.particles = 101000;
    assert_true(alike(&scene, &particles));
    scene.disk.particles = 220000;
    assert_false(alike(&scene, &particles));
    scene.disk.particles = 100000;
    scene.disk.slow_light = true;
    assert_false(alike(&scene, &particles));

    scene = smooth;
    scene.gas.amplitude = 0.5;
    scene.gas.octaves = 3;
    const struct kd_work gas = kd_emit_work(&scene);
    scene.gas.octaves = 5;
    assert_false(alike(&scene, &gas));

    struct kd_work bodies[4];
    for (uint32_t n = 0; n < 3; n++) { /* tests 0, 1 and 7 bodies */
        scene = smooth;
        scene.bodies.count = (uint32_t[]) { 0, 1, 7 }[n];
        for (uint32_t i = 0; i < scene.bodies.count; i++)
            scene.bodies.at[i].r = 10 + i, scene.bodies.at[i].radius = 1;
        bodies[n] = kd_emit_work(&scene);
        assert_true(kd_work_alike(&bodies[n], n ? &bodies[n - 1] : &work) == !n);
    }

    /* debris, and the number of bodies of a playground: 4 bodies have the same cost as 5, but another cost than 100
     * bodies or debris */
    struct kd_dynamic_bodies *shown[4];
    struct kd_error error;
    for (int n = 0; n < 4; n++) {
        assert_false(kd_dynamic_bodies_create(n == 1   ? 5
                                              : n == 2 ? 100
                                                       : 4,
                                              n == 3 ? 8 : 0, n == 3 ? 8 : 0, &shown[n], &error));
        shown[n]->debris.turn = 64;
        shown[n]->debris.depth = 1;
        for (size_t i = 0; i < shown[n]->n; i++)
            shown[n]->bodies[i] = (struct kd_seen_body) { .r = 10 + (double)i, .s = 1, .radius = 1, .brightness = 1 };
        scene = smooth;
        kd_scene_show(&scene, shown[n]);
        bodies[n] = kd_emit_work(&scene);
    }
    assert_false(kd_work_alike(&bodies[0], &work));
    assert_true(kd_work_alike(&bodies[0], &bodies[1]));
    assert_false(kd_work_alike(&bodies[0], &bodies[2]));
    assert_false(kd_work_alike(&bodies[0], &bodies[3]));
    for (int n = 0; n < 4; n++)
        kd_dynamic_bodies_release(shown[n]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(work_follows_emitters),        cmocka_unit_test(all_are_there),
        cmocka_unit_test(sentences_have_room),          cmocka_unit_test(names_are_short_and_differ),
        cmocka_unit_test(what_a_report_counts_is_said), cmocka_unit_test(what_is_off_says_and_needs_nothing),
        cmocka_unit_test(numbers_follow_the_scene),     cmocka_unit_test(numbers_follow_each_field),
        cmocka_unit_test(gas_replaces_the_disk),        cmocka_unit_test(skies),
        cmocka_unit_test(pictures_of_the_sky),          cmocka_unit_test(brightness_of_skies),
        cmocka_unit_test(none_of_a_thousand),           cmocka_unit_test(atmospheres_are_a_variant),
        cmocka_unit_test(a_frequency_is_a_variant),     cmocka_unit_test(a_flash_is_off_by_default),
        cmocka_unit_test(reflection_is_a_variant),      cmocka_unit_test(traits_are_listed),
        cmocka_unit_test(what_shines_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
