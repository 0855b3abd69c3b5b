/* Tests of a sweep's axes: values, ranges, the order of scenes, names and refusals; and of the order in which scenes
 * can share lens maps. */
#include "render/accuracy/table.h"
#include "render/output/gather.h"
#include "render/plan/plan.h"
#include "render/plan/sweep_order.h"
#include "document/number.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static struct kd_sweep *read(const char *text, struct kd_error *error)
{
    struct kd_scene base;
    struct kd_sweep *sweep = NULL;
    cJSON *axes = cJSON_Parse(text);
    assert_non_null(axes);
    kd_scene_defaults(&base);
    *error = (struct kd_error) { 0 };
    enum kd_status status = kd_sweep_read(axes, &base, NULL, &sweep, error);
    assert_int_equal(status, error->status);
    cJSON_Delete(axes);
    return sweep;
}

static struct kd_sweep *good(const char *text)
{
    struct kd_error error;
    struct kd_sweep *sweep = read(text, &error);
    if (!sweep)
        fail_msg("%s: %s", text, error.message);
    return sweep;
}

static void the_last_axis_is_the_fastest(void **state)
{
    struct kd_sweep *s = good("{\"spacetime.spin\": [0, 0.5], \"camera.inclination_deg\": \"10:80:15\", "
                              "\"disk.model\": [\"novikov-thorne\", \"particles\", \"none\"]}");
    (void)state;
    assert_int_equal(s->scenes, 2 * 5 * 3);
    for (unsigned i = 0; i < s->scenes; i++) {
        struct kd_scene scene;
        assert_int_equal(kd_sweep_scene(s, i, &scene, NULL), KD_OK);
        assert_true(scene.spacetime.spin == (i / 15 ? 0.5 : 0));
        assert_true(scene.camera.inclination_deg == 10 + 15 * (i / 3 % 5));
        const int model = i % 3 == 0 ? KD_DISK_NOVIKOV_THORNE : i % 3 == 1 ? KD_DISK_PARTICLES : KD_DISK_NONE;
        assert_int_equal(scene.disk.model, model);
    }
    assert_true(s->axes[0].numeric && s->axes[0].even && s->axes[1].even && !s->axes[2].numeric);
    assert_string_equal(s->axes[1].unit, "degrees");
    kd_sweep_free(s);
}

static bool find_grid(void *user, const char *name, struct kd_asset_found *out)
{
    (void)user;
    const bool large = !strcmp(name, "large");
    *out = (struct kd_asset_found) { .grid = { { 100, 50, large ? 60 : 1 }, .frames = large ? 1 : 3, .spin = 0.7 } };
    memset(out->hash, large ? 'b' : 'a', 64);
    return true;
}

/* Each scene is planned with the nodes of its own grid. */
static void grids_have_their_own_nodes(void **state)
{
    (void)state;
    const struct kd_assets assets = { .find = find_grid, .allowed = "small or large" };
    struct kd_error error = { 0 };
    struct kd_sweep *sweep = NULL;
    struct kd_scene base, scene;
    cJSON *axes = cJSON_Parse("{\"volume.grid\": [\"small\", \"large\"], \"time\": [0, 1]}");
    kd_scene_defaults(&base);
    base.volume.model = KD_VOLUME_GRID;
    base.spacetime.spin = 0.7;
    if (kd_sweep_read(axes, &base, &assets, &sweep, &error))
        fail_msg("%s", error.message);
    for (unsigned i = 0; i < 4; i++) {
        assert_int_equal(kd_sweep_scene(sweep, i, &scene, &error), KD_OK);
        assert_int_equal(scene.matter.nodes, i < 2 ? 15000 : 300000);
        assert_int_equal(scene.matter.frames, i < 2 ? 3 : 1);
    }
    kd_sweep_free(sweep);
    cJSON_Delete(axes);
}

/* Values as they are typed, computed by hand. */
static void ranges(void **state)
{
    static const struct {
        const char *range, *values;
    } table[] = {
        { "10:80:15", "10 25 40 55 70" },
        { "10:70:15", "10 25 40 55 70" },
        { "0:0.9:0.1", "0 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9" },
        { "80:10:-35", "80 45 10" },
        { "30:30:1", "30" },
        { "1:2/3", "1 1.5 2" },
        { "0:1/4", "0 0.333333333333333 0.666666666666667 1" },
        { ".5:1.5:.5", "0.5 1 1.5" },
        { "90:0/2", "90 0" },
        { "1e1:2e1:1e1", "10 20" },
    };
    (void)state;
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        char text[100], all[200] = "";
        snprintf(text, sizeof text, "{\"camera.inclination_deg\": \"%s\"}", table[i].range);
        struct kd_sweep *s = good(text);
        for (size_t k = 0; k < s->axes[0].n; k++)
            snprintf(all + strlen(all), sizeof all - strlen(all), "%s%s", k ? " " : "", s->axes[0].values[k].text);
        assert_string_equal(all, table[i].values);
        kd_sweep_free(s);
    }
}

static void what_is_refused(void **state)
{
    static const struct {
        const char *axes, *pointer, *words;
    } table[] = {
        { "{}", "/axes", "" },
        { "[1]", "/axes", "" },
        { "{\"spacetime.spin\": 0.5}", "/axes/spacetime.spin", "a list of values, or a range" },
        { "{\"spacetime.spin\": []}", "/axes/spacetime.spin", "an empty list" },
        { "{\"spacetime.spin\": [0, 2]}", "/axes/spacetime.spin/1", "spacetime.spin is 2; it must be" },
        { "{\"spacetime.spin\": [\"0.5\"]}", "/axes/spacetime.spin/0", "it must be" },
        { "{\"spacetime.spin\": [0, 0.5, 0]}", "/axes/spacetime.spin", "holds 0 twice" },
        { "{\"spacetime.spin\": [null]}", "/axes/spacetime.spin/0", "null" },
        { "{\"spacetime.spni\": [0]}", "/axes/spacetime.spni", "there is no field" },
        { "{\"spacetime\": [0]}", "/axes/spacetime", "is a section" },
        { "{\"disk.model\": [\"thin\"]}", "/axes/disk.model/0", "\"novikov-thorne\"" },
        { "{\"camera.inclination_deg\": \"10:80\"}", "/axes/camera.inclination_deg", "start:stop:step" },
        { "{\"camera.inclination_deg\": \"10:80:0\"}", "/axes/camera.inclination_deg", "lead from start to stop" },
        { "{\"camera.inclination_deg\": \"80:10:5\"}", "/axes/camera.inclination_deg", "lead from start to stop" },
        { "{\"camera.inclination_deg\": \"10:80/1\"}", "/axes/camera.inclination_deg", "lead from start to stop" },
        { "{\"camera.inclination_deg\": \"10:80/2.5\"}", "/axes/camera.inclination_deg", "lead from start to stop" },
        { "{\"camera.inclination_deg\": \"0:180:1e-9\"}", "/axes/camera.inclination_deg",
          "1.8e+11 scenes; they must make at most 100000" },
        { "{\"camera.inclination_deg\": \"100:200:50\"}", "/axes/camera.inclination_deg", "is 200" },
        { "{\"accuracy.orders\": \"1:2:0.5\"}", "/axes/accuracy.orders", "1.5" },
        { "{\"spots.1.r\": [10]}", "/axes/spots.1.r/0", "spots" },
        { "{\"spot1.r\": [10, 11], \"spots.0.r\": [10, 12]}", "/axes/spots.0.r", "given twice" },
        { "{\"camera.inclination_deg\": \"0:179:1\", \"camera.azimuth_deg\": \"0:359:0.5\"}",
          "/axes/camera.azimuth_deg", "129420 scenes" },
        { "{\"image.layers\": [[\"g\", \"nix\"]]}", "/axes/image.layers/0", "nix" },
    };
    (void)state;
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        struct kd_error error;
        struct kd_sweep *s = read(table[i].axes, &error);
        if (s || error.status != KD_EINVAL || strcmp(error.pointer, table[i].pointer) ||
            !strstr(error.message, table[i].words))
            fail_msg("%s: %d at %s: %s", table[i].axes, error.status, error.pointer, error.message);
    }
}

/* Each value may be valid while their combination is not. A style is set before the fields that it sets. An axis
 * creates the list element that it belongs to. */
static void combinations(void **state)
{
    struct kd_scene scene;
    struct kd_error error = { 0 };
    struct kd_sweep *s = good("{\"spacetime.spin\": [0.998, 0], \"disk.inner\": [2, \"isco\"]}");
    (void)state;
    assert_false(s->axes[1].numeric);
    assert_int_equal(kd_sweep_scene(s, 0, &scene, &error), KD_OK);
    assert_int_equal(kd_sweep_scene(s, 2, &scene, &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/axes");
    assert_non_null(strstr(error.message, "with spacetime.spin 0 and disk.inner 2: disk.inner is 2 M"));
    kd_sweep_free(s);
    s = good("{\"style.exposure\": [0.25], \"style.name\": [\"film\", \"starless\"], \"spots.0.r\": [9, 10], "
             "\"disk.doppler\": [false, true]}");
    for (unsigned i = 0; i < 8; i++) {
        assert_int_equal(kd_sweep_scene(s, i, &scene, NULL), KD_OK);
        assert_true(scene.style.exposure == 0.25);
        assert_int_equal(scene.spots.count, 1);
        assert_true(scene.spots.at[0].r == 9 + i / 2 % 2 && scene.disk.doppler == i % 2);
    }
    kd_sweep_free(s);
}

static void names_and_documents(void **state)
{
    char name[KD_SWEEP_NAME];
    struct kd_buffer text = { 0 };
    struct kd_error error = { 0 };
    struct kd_scene base;
    struct kd_sweep *typed = NULL, *s = good("{\"spacetime.spin\": \"0:0.5:0.25\", \"image.layers\": [[\"rgb\", "
                                             "\"g\"], [\"r_1\"]], \"disk.doppler\": [true]}");
    (void)state;
    kd_sweep_name(s, 4, name);
    assert_string_equal(name, "000004 spin=0.5 layers=rgb_g doppler=true");
    struct kd_json json = kd_json_begin(&text);
    kd_sweep_axes_json(s, &json, NULL);
    assert_int_equal(kd_json_finish(&json), KD_OK);
    assert_string_equal(
        (const char *)text.data,
        "{\"spacetime.spin\":[0,0.25,0.5],\"image.layers\":[\"rgb,g\",\"r_1\"],\"disk.doppler\":[true]}");
    kd_scene_defaults(&base);
    const char *const axes[] = { "spacetime.spin=0:0.5:0.25", "disk.model=none,novikov-thorne" };
    assert_int_equal(kd_sweep_typed(axes, 2, &base, NULL, &typed, &error), KD_OK);
    assert_int_equal(typed->scenes, 6);
    assert_string_equal(typed->axes[1].values[1].text, "novikov-thorne");
    kd_sweep_free(typed);
    assert_int_equal(kd_sweep_typed(&(const char *) { "spin" }, 1, &base, NULL, &typed, &error), KD_EINVAL);
    kd_sweep_free(s);
    kd_buffer_finish(&text);
}

/* Scenes with the same lens map follow one another, in a sweep whose outermost axes do not change it. */
static void those_that_share_a_lens_map_follow_one_another(void **state)
{
    struct kd_sweep *s = good("{\"style.exposure\": [0, 1], \"camera.inclination_deg\": [10, 20, 30], "
                              "\"camera.azimuth_deg\": [0, 40], \"spacetime.spin\": [0, 0.5]}");
    struct kd_sweep_order order = { 0 };
    unsigned changes = 0;
    char seen[24] = "";
    (void)state;
    /* the deadline has already passed, so only one piece is done */
    assert_int_equal(kd_sweep_order_go_on(&order, s, 0), KD_OK);
    assert_null(order.frames);
    assert_int_equal(kd_sweep_order_go_on(&order, s, INFINITY), KD_OK);
    assert_non_null(order.frames);
    for (unsigned i = 0; i < s->scenes; i++) {
        unsigned frame = order.frames[i], before = i ? order.frames[i - 1] : 0;
        assert_int_equal(seen[frame]++, 0);
        /* the inclination or the spin has changed */
        changes += !i || frame / 4 % 3 != before / 4 % 3 || frame % 2 != before % 2;
    }
    assert_int_equal(changes, 6);
    assert_int_equal(order.frames[0], 0);
    kd_sweep_order_finish(&order);
    kd_sweep_free(s);
}

/* The cost of a shared lens map is counted once. */
static void what_is_shared(void **state)
{
    struct kd_sweep_order order = { 0 };
    double shared;
    (void)state;
    for (unsigned i = 0; i < 9; i++)
        assert_int_equal(kd_sweep_order_add(&order, i % 3, 5), KD_OK);
    assert_int_equal(kd_sweep_order_end(&order, &shared), KD_OK);
    assert_true(shared == 30);
    const unsigned expected[] = { 0, 3, 6, 1, 4, 7, 2, 5, 8 };
    assert_memory_equal(order.frames, expected, sizeof expected);
    kd_sweep_order_finish(&order);
}

/* For the plans of scenes: equal groups have equal lens maps, and a change that affects the map changes the group. */
static void groups_are_those_of_lens_maps(void **state)
{
    static const char *const changes[][2] = {
        { "style.exposure", "1" },          { "camera.azimuth_deg", "50" }, { "disk.outer", "30" },
        { "camera.inclination_deg", "50" }, { "spacetime.spin", "0.3" },    { "image.width", "80" },
        { "image.samples", "2" },           { "disk.model", "particles" },  { "image.layers", "r,delay" },
        { "accuracy.orders", "1" },         { "camera.roll_deg", "3" },     { "sky.model", "grid" },
        { "accuracy.profile", "high" },     { "disk.gas.seed", "7" },       { "time", "30" },
        { "image.critical_factor", "1" },
    };
    struct kd_capacity capacity = {
        .max_binding_bytes = 128u << 20, .memory_bytes = 1u << 30, .float64 = true, .accuracy = kd_accuracy_built_in()
    };
    struct kd_scene base, scene;
    struct kd_plan first, plan;
    uint64_t one, other;
    unsigned same = 0;
    (void)state;
    kd_scene_defaults(&base);
    base.image.width = 64, base.image.height = 36;
    assert_int_equal(kd_plan_make(&base, &capacity, &first, NULL), KD_OK);
    assert_int_equal(kd_plan_lens_group(&base, &one), KD_OK);
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        struct kd_error error = { 0 };
        scene = base;
        if (kd_scene_set(&scene, changes[i][0], changes[i][1], &error) ||
            kd_plan_make(&scene, &capacity, &plan, &error))
            fail_msg("%s: %s", changes[i][0], error.message);
        assert_int_equal(kd_plan_lens_group(&scene, &other), KD_OK);
        const bool key = !strcmp(plan.lens.key, first.lens.key);
        same += key;
        if (one == other && !key)
            fail_msg("%s = %s changes the lens map, and not the group", changes[i][0], changes[i][1]);
        if (one != other && key && strncmp(changes[i][0], "accuracy.", 9))
            fail_msg("%s = %s changes the group, and not the lens map", changes[i][0], changes[i][1]);
    }
    assert_true(same >= 4 && same < sizeof changes / sizeof *changes - 4);
}

/* Scenes of one cube must agree in everything that is not an axis. A plan of another size and a scene with other layers
 * are refused. */
static void a_cube_has_one_shape(void **state)
{
    struct kd_cube_shape shape;
    struct kd_error error = { 0 };
    struct kd_scene scene, other;
    struct kd_plan plan = { .picture.width = 64, .picture.height = 36 }, pair = plan, wide = plan;
    pair.picture.eyes = 2;
    wide.picture.width = 65;
    (void)state;
    kd_scene_defaults(&scene);
    other = scene;
    assert_int_equal(kd_scene_set(&other, "image.layers", "rgb,r", &error), KD_OK);
    assert_int_equal(kd_cube_compare(&shape, 0, &scene, &plan.picture, &error), KD_OK);
    assert_int_equal(kd_cube_compare(&shape, 1, &scene, &plan.picture, &error), KD_OK);
    assert_int_equal(kd_cube_compare(&shape, 2, &scene, &wide.picture, &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/axes");
    assert_non_null(strstr(error.message, "scene 2 has 65 x 36 pixels and scene 0 has 64 x 36"));
    assert_int_equal(kd_cube_compare(&shape, 3, &scene, &pair.picture, &error), KD_EINVAL);
    assert_non_null(strstr(error.message, "scene 3 has 128 x 36 pixels"));
    assert_int_equal(kd_cube_compare(&shape, 4, &other, &plan.picture, &error), KD_EINVAL);
    assert_non_null(strstr(error.message, "scene 4 has other layers"));
    assert_int_equal(kd_cube_compare(&shape, 0, &other, &plan.picture, &error), KD_OK); /* another sweep */
    assert_int_equal(kd_cube_compare(&shape, 1, &scene, &plan.picture, &error), KD_EINVAL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_last_axis_is_the_fastest),
        cmocka_unit_test(grids_have_their_own_nodes),
        cmocka_unit_test(ranges),
        cmocka_unit_test(what_is_refused),
        cmocka_unit_test(combinations),
        cmocka_unit_test(names_and_documents),
        cmocka_unit_test(those_that_share_a_lens_map_follow_one_another),
        cmocka_unit_test(what_is_shared),
        cmocka_unit_test(groups_are_those_of_lens_maps),
        cmocka_unit_test(a_cube_has_one_shape),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
