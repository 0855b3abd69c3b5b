/* Tests of the code for scenes with another table of fields (table/scene/fields.h). Lists of this table must be treated
 * as spots are. Assets are names until they are resolved. */
#include "cli/asset_options.h"
#include "cli/cli.h"
#include "image/png.h"
#include "scene/asset.h"
#include "scene/control.h"
#include "scene/presets.h"
#include "scene/rules.h"
#include "scene/sha256.h"
#include "scene/sky_scale.h"

#include "scene_support.h"

#include <cjson/cJSON.h>

/* This scene has no volumes. */
enum kd_status kd_asset_check_grid(const struct kd_asset_grid *grid, const struct kd_scene *scene,
                                   struct kd_error *error)
{
    return (void)grid, (void)scene, (void)error, KD_OK;
}
/* This scene has no widths in two units. */
void kd_scene_settle(struct kd_scene *scene, const uint64_t *given) { (void)scene, (void)given; }
/* This scene has no rules and no presets. */
const struct kd_rule kd_rules[1];
const size_t kd_rule_count = 0;
const struct kd_preset kd_presets[1];
const size_t kd_preset_count = 0;

#define ABC "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad" /* FIPS 180-2, B.1 */

static struct kd_scene of(const char *text)
{
    struct kd_scene scene;
    struct kd_error error = { 0 };
    kd_scene_defaults(&scene);
    if (support_parse(&scene, text, &error))
        fail_msg("%s: %s %s", text, error.pointer, error.message);
    return scene;
}

static void expect_text(const struct kd_scene *scene, const char *wanted)
{
    char *text = support_canonical(scene);
    assert_string_equal(text, wanted);
    free(text);
}

#define BODY "{\"dark\":true,\"shape\":\"disk\",\"texture\":null,\"moons\":3,\"r\":\"far\"}"
#define REST "\"time\":0,\"film\":null}"

static void canonical_form(void **state)
{
    (void)state;
    struct kd_scene scene = of("{}");
    expect_text(&scene, "{\"version\":1,\"bodies\":[],\"place\":{\"width\":2,\"map\":null},\"stops\":[]," REST);
    scene = of("{\"bodies\":[{},{\"r\":4,\"shape\":\"ring\",\"moons\":0,\"dark\":false,\"texture\":\"" ABC
               "\"}],\"finish\":{\"time\":1},\"film\":null}");
    expect_text(
        &scene,
        "{\"version\":1,\"bodies\":[" BODY ",{\"dark\":false,\"shape\":\"ring\",\"texture\":\"" ABC
        "\",\"moons\":0,\"r\":4}],"
        "\"place\":{\"width\":2,\"map\":null},\"stops\":[{\"time\":0.5,\"sound\":null},{\"time\":0.5,\"sound\":null},"
        "{\"time\":1,\"sound\":null}]," REST);
    char *text = support_canonical(&scene);
    struct kd_scene back = of(text);
    assert_memory_equal(&back, &scene, sizeof scene);
    free(text);
}

static void lists_of_any_kind(void **state)
{
    (void)state;
    struct kd_scene scene =
        of("{\"bodies\":{\"1\":{\"moons\":5},\"0\":{\"dark\":false}},\"stops\":[{\"time\":-1},{}]}");
    struct kd_error error;
    assert_true(scene.bodies.count == 2 && scene.stops.count == 2 && scene.bodies.at[1].moons == 5 &&
                !scene.bodies.at[0].dark);
    assert_true(scene.bodies.at[1].dark && scene.bodies.at[1].shape == 1 && isinf(scene.bodies.at[1].r) &&
                scene.stops.at[1].time == 0.5);
    assert_int_equal(kd_scene_set(&scene, "bodies.2.shape", "ball", &error), KD_OK);
    assert_int_equal(kd_scene_set(&scene, "stops.2.time", "0.25", &error), KD_OK);
    assert_int_equal(kd_scene_set(&scene, "stops.3.time", "0.25", &error), KD_EINVAL);
    assert_string_equal(error.message, "there is no stops.3: stops is a list with elements from stops.0 to stops.2");
    assert_int_equal(kd_scene_set(&scene, "start.time", "0.75", &error), KD_OK);
    assert_true(scene.bodies.count == 3 && scene.bodies.at[2].shape == 0 && scene.stops.at[2].time == 0.25 &&
                scene.stops.at[0].time == 0.75);
    assert_int_equal(support_parse(&scene, "{\"bodies\":{\"19\":{}}}", &error), KD_EINVAL);
    assert_string_equal(error.message, "there is no bodies.19: the list has 3 elements, and the next free index is 3");
    assert_int_equal(support_parse(&scene, "{\"stops\":[{},{},{},{}]}", &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/stops/3");
    assert_int_equal(support_parse(&scene, "{\"stops\":[],\"start\":{}}", &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/start");
    assert_int_equal(support_parse(&scene, "{\"bodies\":[{},{\"shape\":\"cube\"}]}", &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/bodies/1/shape");
    const char *patch = "{\"bodies\":null,\"stops\":{\"0\":null}}";
    assert_int_equal(kd_scene_patch(&scene, patch, strlen(patch), &error), KD_OK);
    assert_true(scene.bodies.count == 0 && scene.stops.count == 3 && scene.stops.at[0].time == 0.5);
    uint64_t seed = 7;
    for (int i = 0; i < 300; i++) {
        support_scene(&scene, &seed);
        for (size_t k = 0; k < scene.bodies.count; k++)
            strcpy(scene.bodies.at[k].texture, k % 2 ? ABC : "");
        *scene.place.map = *scene.top.film = 0;
        char *text = support_canonical(&scene);
        struct kd_scene back = of(text);
        assert_memory_equal(&back, &scene, sizeof scene);
        free(text);
    }
}

/* The store of assets: "sky" is ABC, and no other name exists. */
static bool find(void *user, const char *name, struct kd_asset_found *out)
{
    (*(int *)user)++;
    if (strcmp(name, "sky") && strcmp(name, ABC))
        return false;
    strcpy(out->hash, ABC);
    return true;
}

static void assets_are_resolved(void **state)
{
    (void)state;
    struct kd_scene scene = of("{\"place\":{\"map\":\"sky\"},\"bodies\":[{},{\"texture\":\"sky\"},{\"texture\":\"" ABC
                               "\"}],\"film\":\"sky\"}");
    struct kd_scene same = of("{\"place\":{\"map\":\"" ABC "\"},\"bodies\":[{},{\"texture\":\"" ABC
                              "\"},{\"texture\":\"" ABC "\"}],\"film\":\"" ABC "\"}");
    struct kd_buffer text = { 0 };
    struct kd_error error;
    char hashes[2][65];
    int asked = 0;
    const struct kd_assets assets = { .find = find, .allowed = "null and sky", .user = &asked };
    assert_int_equal(kd_scene_to_json(&scene, &text), KD_EINVAL); /* a name alone does not identify the content */
    kd_buffer_finish(&text);
    assert_int_equal(kd_scene_hash(&scene, hashes[0]), KD_EINVAL);
    assert_int_equal(kd_scene_validate(&scene, &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/bodies/1/texture");
    assert_string_equal(error.message,
                        "bodies.1.texture is \"sky\"; it must be a SHA-256, or the name of a known asset");
    assert_int_equal(kd_scene_resolve(&scene, &assets, &error), KD_OK);
    assert_int_equal(asked, 4);
    assert_memory_equal(&scene, &same, sizeof scene);
    assert_int_equal(kd_scene_validate(&scene, &error), KD_OK);
    assert_int_equal(kd_scene_hash(&scene, hashes[0]), KD_OK);
    assert_int_equal(kd_scene_hash(&same, hashes[1]), KD_OK);
    assert_string_equal(hashes[0], hashes[1]);

    assert_int_equal(kd_scene_set(&scene, "bodies.0.texture", "ground", &error), KD_OK);
    same = scene;
    assert_int_equal(kd_scene_resolve(&scene, &assets, &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/bodies/0/texture");
    assert_string_equal(error.message,
                        "bodies.0.texture is \"ground\", which is not a known asset; it must be null and sky");
    assert_memory_equal(&scene, &same, sizeof scene);
    assert_int_equal(kd_scene_set(&scene, "bodies.0.texture", "", &error), KD_OK); /* none */
    assert_int_equal(kd_scene_resolve(&scene, &assets, &error), KD_OK);
    const char *patch = "{\"film\":null,\"place\":null,\"bodies\":[]}";
    assert_int_equal(kd_scene_patch(&scene, patch, strlen(patch), &error), KD_OK);
    same = of("{}");
    assert_memory_equal(&scene, &same, sizeof scene);
}

/* The rest of src/cli is compiled for kerrd's own scene. */
enum kd_status kd_cli_prefix(struct kd_error *error, const char *name) { return (void)name, error->status; }
void kd_cli_stdout_failed(int number) { (void)number; }

static void write_file(const char *path, const struct kd_buffer *bytes)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes->data, 1, bytes->size, file), bytes->size);
    fclose(file);
}

/* --asset NAME=FILE */
static void assets_on_a_command_line(void **state)
{
    (void)state;
    char path[] = "/tmp/kerrd-asset-XXXXXX", texts[3][64], hash[65];
    const uint8_t pixels[3 * 4] = { 1, 2, 3 };
    struct kd_buffer png = { 0 };
    struct kd_asset_options options = { 0 };
    struct kd_error error;
    int fd = mkstemp(path);
    assert_true(fd >= 0);
    fclose(fdopen(fd, "wb"));
    assert_int_equal(
        kd_png_encode(&(struct kd_png_params) { .width = 2, .height = 2, .bit_depth = 8, .pixels = pixels }, &png,
                      &error),
        KD_OK);
    write_file(path, &png);
    kd_sha256(png.data, png.size, hash);
    snprintf(texts[0], sizeof texts[0], "sky=%s", path);
    snprintf(texts[1], sizeof texts[1], "ground=%s", path);
    assert_int_equal(kd_asset_options_add(&options, texts[0], &error), KD_OK);
    struct kd_scene scene = of("{\"place\":{\"map\":\"sky\"},\"bodies\":[{},{\"texture\":\"sky\"}]}");
    assert_int_equal(kd_asset_options_resolve(&options, &scene, &error), KD_OK);
    assert_string_equal(scene.place.map, hash);
    assert_string_equal(scene.bodies.at[1].texture, hash);
    assert_string_equal(scene.bodies.at[0].texture, "");
    /* the asset may be named by its hash */
    assert_int_equal(kd_asset_options_resolve(&options, &scene, &error), KD_OK);
    assert_int_equal(kd_asset_options_add(&options, texts[1], &error), KD_OK);
    scene = of("{\"film\":\"sky\"}");
    assert_int_equal(kd_asset_options_resolve(&options, &scene, &error), KD_EINVAL);
    assert_string_equal(error.message,
                        "--asset ground cannot be used, because no field of the scene refers to this name");
    scene = of("{\"film\":\"sky\",\"stops\":[{\"sound\":\"wind\"}]}");
    assert_int_equal(kd_asset_options_resolve(&options, &scene, &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/stops/0/sound");
    png.data[20] ^= 1;
    write_file(path, &png);
    scene = of("{\"film\":\"sky\"}");
    assert_int_equal(kd_asset_options_resolve(&options, &scene, &error), KD_EINVAL);
    assert_string_equal(scene.top.film, "sky");
    remove(path);
    assert_int_equal(kd_asset_options_resolve(&options, &scene, &error), KD_EINVAL);
    assert_non_null(strstr(error.message, "No such file"));
    kd_asset_options_finish(&options);
    kd_buffer_finish(&png);
}

static void assets_have_names(void **state)
{
    (void)state;
    static const struct {
        const char *json;
        bool good;
    } cases[] = {
        { "null", true },
        { "\"sky\"", true },
        { "\"Sky.2-b_c\"", true },
        { "\"" ABC "\"", true },
        { "\"abcdefghijabcdefghijabcdefghijabcdefghijabcdefghijabcdefghijabc\"", true }, /* 63 */
        /* 64 characters that are not a hash */
        { "\"abcdefghijabcdefghijabcdefghijabcdefghijabcdefghijabcdefghijabcg\"", false },
        { "\"BA7816BF8F01CFEA414140DE5DAE2223B00361A396177A9CB410FF61F20015AD\"", false },
        { "\"" ABC "0\"", false },
        { "\"2sky\"", false },
        { "\".sky\"", false },
        { "\"a/b\"", false },
        { "\"a b\"", false },
        { "\"\xc3\xa9\"", false },
        { "1", false },
        { "true", false },
        { "{}", false },
        { "[]", false },
        { "\"http://a/b.png\"", false },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct kd_scene scene;
        struct kd_error error = { 0 };
        char document[160];
        kd_scene_defaults(&scene);
        snprintf(document, sizeof document, "{\"stops\":[{\"sound\":%s}]}", cases[i].json);
        if (support_parse(&scene, document, &error) != (cases[i].good ? KD_OK : KD_EINVAL))
            fail_msg("%s: %s", cases[i].json, error.message);
        if (cases[i].good)
            continue;
        assert_string_equal(error.pointer, "/stops/0/sound");
        assert_non_null(strstr(
            error.message, "it must be null, the SHA-256 of an asset as 64 hexadecimal digits, or a name: a letter"));
    }
}

/* The string in `object` under the name `key`. */
static const char *word_of(const cJSON *object, const char *key)
{
    return cJSON_GetObjectItemCaseSensitive(object, key)->valuestring;
}

static void schema_has_natures_places_and_groups(void **state)
{
    (void)state;
    struct kd_buffer text = { 0 };
    assert_int_equal(kd_scene_schema(&text), KD_OK);
    cJSON *schema = cJSON_Parse((const char *)text.data);
    const cJSON *all = cJSON_GetObjectItemCaseSensitive(schema, "properties");
    const cJSON *bodies = cJSON_GetObjectItemCaseSensitive(all, "bodies"),
                *film = cJSON_GetObjectItemCaseSensitive(all, "film");
    const cJSON *rows =
        cJSON_GetObjectItemCaseSensitive(cJSON_GetObjectItemCaseSensitive(bodies, "items"), "properties");
    const char *natures[][2] = {
        { "dark", "look" }, { "shape", "model" }, { "texture", "look" }, { "moons", "physics" }, { "r", "model" }
    };
    for (size_t i = 0; i < sizeof natures / sizeof *natures; i++) {
        const cJSON *row = cJSON_GetObjectItemCaseSensitive(rows, natures[i][0]);
        assert_string_equal(word_of(row, "x-nature"), natures[i][1]);
        assert_int_equal(cJSON_HasObjectItem(row, "x-front"), i < 2);
        assert_false(cJSON_HasObjectItem(row, "x-group")); /* absent, because its section has the group */
    }
    assert_string_equal(word_of(bodies, "x-group"), "gas");
    assert_string_equal(word_of(cJSON_GetObjectItemCaseSensitive(all, "stops"), "x-group"), "hole");
    assert_string_equal(word_of(cJSON_GetObjectItemCaseSensitive(all, "place"), "x-group"), "camera");
    assert_string_equal(word_of(film, "x-group"), "more");
    assert_string_equal(word_of(film, "x-nature"), "look");
    const cJSON *meanings = cJSON_GetObjectItemCaseSensitive(schema, "x-natures");
    assert_string_equal(word_of(meanings, "look"),
                        "a choice of presentation, which changes the picture but not the physics");
    assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItemCaseSensitive(schema, "x-groups")), 5);
    cJSON_Delete(schema);
    text.size = 0;
    assert_int_equal(kd_scene_reference(&text), KD_OK);
    assert_non_null(strstr((const char *)text.data, "| `bodies.N.moons` | physics | whole number |"));
    kd_buffer_finish(&text);
}

/* The schema of each field, also in lists, has what the page needs for its controls. */
static void schema_has_controls(void **state)
{
    (void)state;
    static const char *const all[] = { "time",           "bodies.r",       "bodies.dark", "bodies.moons",
                                       "bodies.texture", "bodies.texture", "stops.time",  "bodies.shape" };
    struct kd_buffer text = { 0 };
    assert_int_equal(kd_scene_schema(&text), KD_OK);
    const char *json = (const char *)text.data;
    assert_non_null(strstr(json, ",\"x-nature\":\"physics\",\"x-front\":true,\"x-span\":[-1,2]"));
    assert_non_null(strstr(json, ",\"x-first\":7"));
    assert_non_null(strstr(json, ",\"x-front\":true,\"x-switch\":true"));
    assert_non_null(strstr(json, ",\"x-with\":{\"shape\":\"ring\"}"));
    assert_non_null(strstr(json, ",\"x-with\":{\"shape\":[\"ball\",\"disk\"]}"));
    assert_non_null(strstr(json, ",\"x-varies\":[\"here\",\"there\"]"));
    assert_non_null(strstr(json, ",\"x-button\":{\"title\":\"A ball\",\"value\":\"ball\"}"));
    assert_int_equal(kd_control_count, sizeof all / sizeof *all);
    for (size_t i = 0; i < kd_control_count; i++)
        assert_string_equal(kd_controls[i].path, all[i]);
    kd_buffer_finish(&text);
}

static void schema_and_reference(void **state)
{
    (void)state;
    struct kd_buffer text = { 0 };
    assert_int_equal(kd_scene_schema(&text), KD_OK);
    cJSON *schema = cJSON_Parse((const char *)text.data);
    const cJSON *all = cJSON_GetObjectItemCaseSensitive(schema, "properties");
    const cJSON *bodies = cJSON_GetObjectItemCaseSensitive(all, "bodies"),
                *stops = cJSON_GetObjectItemCaseSensitive(all, "stops");
    assert_int_equal(cJSON_GetObjectItemCaseSensitive(bodies, "maxItems")->valuedouble, 20);
    assert_int_equal(cJSON_GetObjectItemCaseSensitive(stops, "maxItems")->valuedouble, 3);
    const cJSON *rows =
        cJSON_GetObjectItemCaseSensitive(cJSON_GetObjectItemCaseSensitive(stops, "items"), "properties");
    const cJSON *sound = cJSON_GetObjectItemCaseSensitive(rows, "sound"),
                *kinds = cJSON_GetObjectItemCaseSensitive(sound, "anyOf");
    assert_true(cJSON_IsNull(cJSON_GetObjectItemCaseSensitive(sound, "default")));
    assert_string_equal(cJSON_GetObjectItemCaseSensitive(cJSON_GetArrayItem(kinds, 0), "type")->valuestring, "null");
    assert_non_null(
        strstr(cJSON_GetObjectItemCaseSensitive(cJSON_GetArrayItem(kinds, 1), "pattern")->valuestring, "[0-9a-f]{64}"));
    assert_non_null(cJSON_GetObjectItemCaseSensitive(all, "finish"));
    cJSON_Delete(schema);
    text.size = 0;
    assert_int_equal(kd_scene_reference(&text), KD_OK);
    const char *page = (const char *)text.data;
    assert_non_null(strstr(page, "A list of at most 20 elements, by default `[]`; N counts from 0.\n"));
    assert_non_null(strstr(page, "Old names are still read: `finish` is `stops.2`, `start` is `stops.0`.\n"));
    assert_non_null(strstr(page, "| `stops.N.sound` | look | asset | `null` |"));
    kd_buffer_finish(&text);
}

static void sha256(void **state)
{
    (void)state;
    char hash[65];
    kd_sha256("abc", 3, hash);
    assert_string_equal(hash, ABC);
    kd_sha256(NULL, 0, hash);
    assert_string_equal(hash, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(canonical_form),
        cmocka_unit_test(lists_of_any_kind),
        cmocka_unit_test(assets_are_resolved),
        cmocka_unit_test(assets_on_a_command_line),
        cmocka_unit_test(assets_have_names),
        cmocka_unit_test(schema_and_reference),
        cmocka_unit_test(schema_has_natures_places_and_groups),
        cmocka_unit_test(schema_has_controls),
        cmocka_unit_test(sha256),
    };
    return cmocka_run_group_tests_name("scene table", tests, NULL, NULL);
}
