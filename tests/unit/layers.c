/* Tests of layers by name: the words of image.layers agree with the table, an invalid request is refused with the
 * field's name, and NPY files hold the numbers. */
#include "scene_support.h"

#include "image/npy.h"
#include "render/output/format.h"
#include "render/accuracy/table.h"
#include "render/emit/emitter.h"

static struct kd_scene scene_of(const char *json)
{
    struct kd_scene scene;
    struct kd_error error = { 0 };
    kd_scene_smooth(&scene);
    if (support_parse(&scene, json, &error) || kd_scene_validate(&scene, &error))
        fail_msg("%s: %s", json, error.message);
    return scene;
}

static struct kd_capacity device(void)
{
    struct kd_capacity c = { .max_binding_bytes = 128u << 20,
                             .memory_bytes = 1u << 30,
                             .accuracy = kd_accuracy_built_in() };
    for (int i = 0; i < KD_FIGURE_COUNT; i++)
        c.ns[i] = 10;
    return c;
}

static const struct kd_row *field(void) { return kd_field_find("image", "layers"); }

static void words_are_the_layers(void **state)
{
    (void)state;
    assert_int_equal(kd_word_count(field()->words), KD_LAYER_COUNT);
    for (int i = 0; i < KD_LAYER_COUNT; i++) {
        const struct kd_layer_kind *kind = &kd_layer_kinds[i];
        char name[KD_WORD_ROOM];
        bool numbered;
        kd_words_spell(field()->words, (struct kd_numbered_word) { (int16_t)i, -1 }, name);
        assert_non_null(kind->name);
        assert_string_equal(name, kind->name);
        kd_words_root(field()->words, i, &numbered);
        assert_int_equal(numbered, i != KD_LAYER_order && i != KD_LAYER_brightness_temperature &&
                                       i != KD_LAYER_specific_intensity && i != KD_LAYER_stokes_v &&
                                       i != KD_LAYER_jy_per_pixel &&
                                       (kind->of == KD_OF_CROSSING || kind->of == KD_OF_LIGHT));
        assert_non_null(kind->unit);
        assert_true(kind->of != KD_OF_CROSSING || kind->needs & KD_LENS_W);
        assert_true(kind->of != KD_OF_RAY || kind->needs);
    }
}

static void words_are_kept_in_order(void **state)
{
    (void)state;
    static const struct {
        const char *json, *text, *canonical;
    } same[] = {
        { "[\"r\"]", "r", "[\"r\"]" },
        { "[\"phi_2\",\"rgb\",\"phi\",\"phi_0\",\"order\"]", "phi_2,rgb,phi,phi_0,order",
          "[\"phi_2\",\"rgb\",\"phi\",\"phi_0\",\"order\"]" },
        { "[\"g_12\"]", "g_12", "[\"g_12\"]" },
    };
    for (size_t i = 0; i < sizeof same / sizeof *same; i++) {
        struct kd_scene a, b;
        struct kd_error error;
        char document[200];
        kd_scene_smooth(&a);
        kd_scene_smooth(&b);
        snprintf(document, sizeof document, "{\"image\":{\"layers\":%s}}", same[i].json);
        assert_int_equal(support_parse(&a, document, &error), KD_OK);
        assert_int_equal(kd_scene_set(&b, "image.layers", same[i].text, &error), KD_OK);
        assert_memory_equal(&a, &b, sizeof a);
        char *text = support_canonical(&a);
        snprintf(document, sizeof document, "\"layers\":%s,", same[i].canonical);
        assert_non_null(strstr(text, document));
        struct kd_scene back;
        kd_scene_smooth(&back);
        assert_int_equal(support_parse(&back, text, &error), KD_OK);
        assert_memory_equal(&a, &back, sizeof a);
        assert_int_equal(kd_scene_patch(&a, "{\"image\":{\"layers\":null}}", 25, &error), KD_OK);
        kd_scene_smooth(&back);
        assert_memory_equal(&a, &back, sizeof a);
        free(text);
    }
}

static void other_words_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *json, *text;
    } bad[] = {
        { "[]", "" },
        { "[\"G\"]", "G" },
        { "[\"g\",\"g\"]", "g,g" },
        { "[\"g_\"]", "g_" },
        { "[\"g_01\"]", "g_01" },
        { "[\"g_100\"]", "g_100" },
        { "[\"g_-1\"]", "g_-1" },
        { "[\"order_1\"]", "order_1" },
        { "[\"rgb_0\"]", "rgb_0" },
        { "[\"g,r\"]", "g,,r" },
        { "[\"\"]", ",g" },
        { "[1]", "1" },
        { "\"g\"", "g," },
        { "{\"0\":\"g\"}", "[g]" },
        { "[[\"g\"]]", "g r" },
        { "[\"g\",\"r\",\"phi\",\"g_0\",\"g_1\",\"g_2\",\"r_0\",\"r_1\",\"r_2\",\"phi_0\",\"phi_1\",\"phi_2\",\"rgb\","
          "\"fate\",\"order\",\"g_3\",\"g_4\"]",
          "g,r,phi,g_0,g_1,g_2,r_0,r_1,r_2,phi_0,phi_1,phi_2,rgb,fate,order,g_3,g_4" },
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        for (int way = 0; way < 2; way++) {
            struct kd_scene scene, before;
            struct kd_error error = { 0 };
            char document[300];
            kd_scene_smooth(&scene);
            before = scene;
            snprintf(document, sizeof document, "{\"image\":{\"layers\":%s}}", bad[i].json);
            enum kd_status status = way ? kd_scene_set(&scene, "image.layers", bad[i].text, &error)
                                        : support_parse(&scene, document, &error);
            if (status != KD_EINVAL)
                fail_msg("%s is taken", way ? bad[i].text : bad[i].json);
            assert_string_equal(error.pointer, "/image/layers");
            assert_non_null(strstr(error.message, "1 to 16 of rgb, "));
            assert_memory_equal(&scene, &before, sizeof scene);
        }
}

static void by_hand_they_are_checked_again(void **state)
{
    (void)state;
    static const struct kd_words bad[] = {
        { 0 },
        { -1, { { 0, -1 } } },
        { 17, { { 0, -1 } } },
        { 1, { { -7, -1 } } },
        { 1, { { KD_LAYER_COUNT, -1 } } },
        { 1, { { 0, 0 } } },
        { 1, { { KD_LAYER_g, -2 } } },
        { 1, { { KD_LAYER_g, 100 } } },
        { 2, { { KD_LAYER_g, 1 }, { KD_LAYER_g, 1 } } },
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        struct kd_scene scene = scene_of("{}");
        struct kd_error error = { 0 };
        struct kd_buffer text = { 0 };
        scene.image.layers = bad[i];
        assert_int_equal(kd_scene_validate(&scene, &error), KD_EINVAL);
        assert_string_equal(error.pointer, "/image/layers");
        assert_int_equal(kd_scene_to_json(&scene, &text), KD_EINVAL);
        kd_buffer_finish(&text);
    }
}

static void what_cannot_be_is_refused(void **state)
{
    (void)state;
    static const struct {
        const char *json, *pointer, *says;
    } bad[] = {
        { "{\"image\":{\"layers\":[\"r_3\"]}}", "/image/layers", "below accuracy.orders, 3" },
        { "{\"image\":{\"layers\":[\"r\",\"intensity_1\"]},\"accuracy\":{\"orders\":1}}", "/image/layers",
          "has intensity_1" },
        { "{\"image\":{\"layers\":[\"temperature\"]},\"disk\":{\"model\":\"none\"}}", "/image/layers",
          "needs matter with a temperature" },
        { "{\"image\":{\"layers\":[\"r\"],\"layer_min\":5,\"layer_max\":5}}", "/image/layer_min",
          "less than image.layer_max" },
        { "{\"image\":{\"layers\":[\"g\"],\"layer_min\":0}}", "/image/layer_min", "logarithmic" },
        { "{\"image\":{\"layers\":[\"g\"],\"layer_max\":-1}}", "/image/layer_max", "logarithmic" },
    };
    const struct kd_capacity c = device();
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        struct kd_scene scene = scene_of(bad[i].json);
        struct kd_plan plan;
        struct kd_error error = { 0 };
        assert_int_equal(kd_plan_make(&scene, &c, &plan, &error), KD_EINVAL);
        assert_string_equal(error.pointer, bad[i].pointer);
        if (!strstr(error.message, bad[i].says))
            fail_msg("\"%s\" does not say \"%s\"", error.message, bad[i].says);
        assert_int_equal(kd_plan_check(&scene, &c, &error), KD_EINVAL);
    }
}

/* A picture format accepts one layer, and NPY accepts all. A table of rows accepts none, so that its plan has no
 * layers. */
static void formats_take_what_they_hold(void **state)
{
    (void)state;
    const struct kd_capacity c = device();
    struct kd_scene two = scene_of("{\"image\":{\"layers\":[\"rgb\",\"r_1\"]}}"),
                    one = scene_of("{\"image\":{\"layers\":[\"r_1\"]}}");
    struct kd_plan plan;
    struct kd_error error = { 0 };
    assert_int_equal(kd_format_plan(&kd_format_png, &two, &c, &plan, &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/image/layers");
    assert_int_equal(kd_format_plan(&kd_format_png, &one, &c, &plan, &error), KD_OK);
    assert_true(kd_plan_is_map(&plan.picture) && !plan.picture.radiance && plan.picture.n_layers == 1 &&
                plan.picture.layers[0].order == 1);
    assert_int_equal(kd_format_plan(&kd_format_npy, &two, &c, &plan, &error), KD_OK);
    assert_true(!kd_plan_is_map(&plan.picture) && plan.picture.radiance && plan.picture.n_layers == 1);
    struct kd_format rows = kd_format_npy;
    rows.carries = KD_CARRIES_LIGHT;
    assert_int_equal(kd_format_plan(&rows, &two, &c, &plan, &error), KD_OK);
    assert_true(plan.picture.n_layers == 0 && plan.picture.rgb && !plan.picture.radiance);
}

/* Layers that are not requested are not in the plan. Requested layers are included in its bytes and quantities. */
static void plans_have_what_is_asked_for(void **state)
{
    (void)state;
    const struct kd_capacity c = device();
    struct kd_scene none = scene_of("{}"),
                    some = scene_of("{\"image\":{\"layers\":[\"phi\",\"sky_theta\",\"footprint_2\"]}}");
    struct kd_plan plan, more;
    assert_int_equal(kd_plan_make(&none, &c, &plan, NULL), KD_OK);
    assert_int_equal(kd_plan_make(&some, &c, &more, NULL), KD_OK);
    assert_int_equal(plan.lens.quantities, KD_LENS_W);
    assert_int_equal(more.lens.quantities, KD_LENS_W | KD_LENS_PHI | KD_LENS_SKY | KD_LENS_FOOTPRINT);
    assert_int_equal(plan.picture.n_layers, 0);
    assert_int_equal(more.picture.n_layers, 3);
    assert_int_equal(more.cost.host_bytes - plan.cost.host_bytes, 3 * 4 * 1280 * 720);
    struct kd_scene empty = scene_of("{\"image\":{\"layers\":[\"r\"]},\"disk\":{\"model\":\"none\"}}");
    assert_int_equal(kd_plan_make(&empty, &c, &plan, NULL), KD_OK);
    assert_int_equal(plan.lens.orders, 3); /* rays are traced although the scene has no light */
}

/* A synthetic frame gives records in the order of the words, with each number in the right field. */
static void npy_has_the_numbers(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of("{\"image\":{\"layers\":[\"r_1\",\"rgb\",\"g\"],\"width\":3,\"height\":2}}");
    struct kd_frame frame = { .width = 3, .height = 2 };
    struct kd_error error = { 0 };
    static const char *const names[] = { "rgb", "radiance", "g", "r_1" };
    for (int i = 0; i < 4; i++)
        assert_int_equal(kd_frame_add_layer(&frame, names[i], i < 2 ? 3 : 1, i ? KD_LAYER_F32 : KD_LAYER_U8, &error),
                         KD_OK);
    for (int i = 1; i < 4; i++)
        for (uint32_t k = 0; k < 6 * frame.layers[i].channels; k++)
            ((float *)frame.layers[i].data)[k] = i == 2 && k == 4 ? NAN : (float)(100 * i + (int)k);
    const struct kd_picture picture = { .frame = &frame, .scene = &scene };
    struct kd_buffer file = { 0 };
    assert_int_equal(kd_encode(&kd_format_npy, &picture, KD_EFFORT_KEEP, NULL, &file, &error), KD_OK);
    assert_ptr_equal(kd_format_of_bytes(file.data, file.size), &kd_format_npy);
    struct kd_npy array;
    assert_int_equal(kd_npy_read(file.data, file.size, &array, &error), KD_OK);
    assert_int_equal(array.n_dimensions, 2);
    assert_true(array.shape[0] == 2 && array.shape[1] == 3 && array.n_fields == 3 && array.item_size == 20);
    assert_string_equal(array.fields[0].name, "r_1");
    assert_string_equal(array.fields[1].name, "rgb");
    assert_int_equal(array.fields[1].count, 3);
    assert_string_equal(array.fields[2].name, "g");
    for (int k = 0; k < 6; k++) {
        float record[5];
        memcpy(record, file.data + array.header_size + 20 * (size_t)k, sizeof record);
        assert_true(record[0] == 300 + k && record[1] == 100 + 3 * k && record[2] == 101 + 3 * k &&
                    record[3] == 102 + 3 * k);
        assert_true(k == 4 ? isnan(record[4]) : record[4] == 200 + k);
    }
    kd_buffer_finish(&file);
    scene.image.layers.at[0].number = 2; /* a layer that the frame does not have */
    assert_int_equal(kd_encode(&kd_format_npy, &picture, KD_EFFORT_KEEP, NULL, &file, &error), KD_EINVAL);
    kd_buffer_finish(&file);
    kd_frame_finish(&frame);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(words_are_the_layers),         cmocka_unit_test(words_are_kept_in_order),
        cmocka_unit_test(other_words_are_refused),      cmocka_unit_test(by_hand_they_are_checked_again),
        cmocka_unit_test(what_cannot_be_is_refused),    cmocka_unit_test(formats_take_what_they_hold),
        cmocka_unit_test(plans_have_what_is_asked_for), cmocka_unit_test(npy_has_the_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
