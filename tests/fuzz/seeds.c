/* Writes seeds and dictionaries of the targets from kerrd's own tables with kerrd's own writers, so that they stay up
 * to date. kd_fuzz_seeds OUT writes OUT/TARGET/NAME and OUT/TARGET.dict, with the same bytes each time. Seeds that
 * cannot be made from tables are in tests/fuzz/corpus. */
#include "fuzz.h"

#include "scene/difference.h"
#include "cli/serve_settings.h"
#include "image/npy.h"
#include "image/png.h"
#include "image/zip.h"
#include "integral/request.h"
#include "orbit/fields.h"
#include "playground/json.h"
#include "quantity/quantity.h"
#include "render/accuracy/table.h"
#include "render/output/particle_list.h"
#include "render/rays/fields.h"
#include "scene/presets.h"
#include "scene/table.h"
#include "server/http/route.h"

#include <errno.h>
#include <math.h>
#include <sys/stat.h>

static const char *out;

static FILE *open_file(const char *folder, const char *name)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", out, folder);
    CHECK(!mkdir(path, 0777) || errno == EEXIST, "%s cannot be made", path);
    snprintf(path, sizeof path, "%s/%s%s%s", out, folder, *name ? "/" : ".dict", name);
    FILE *file = fopen(path, "wb");
    CHECK(file, "%s cannot be written", path);
    return file;
}

/* A seed that consists of a text and these bytes after it. */
static void put(const char *target, const char *name, const char *before, const void *data, size_t size)
{
    FILE *file = open_file(target, name);
    fputs(before, file);
    CHECK(fwrite(data, 1, size, file) == size && !fclose(file), "%s of %s cannot be written", name, target);
}

static void put_text(const char *target, const char *name, const char *text) { put(target, name, text, "", 0); }

static void word(FILE *dict, const char *text, size_t n)
{
    if (!n)
        return; /* empty words are left out, because libFuzzer rejects them */
    fputc('"', dict);
    for (size_t i = 0; i < n; i++)
        if (text[i] == '"' || text[i] == '\\' || text[i] < ' ' || text[i] > '~')
            fprintf(dict, "\\x%02x", (unsigned char)text[i]);
        else
            fputc(text[i], dict);
    fputs("\"\n", dict);
}

static void words(FILE *dict, const char *const *texts, size_t n)
{
    for (size_t i = 0; i < n; i++)
        word(dict, texts[i], strlen(texts[i]));
}
#define WORDS(dict, ...) \
    words(dict, (const char *const[]) { __VA_ARGS__ }, sizeof((const char *const[]) { __VA_ARGS__ }) / sizeof(char *))

/* "a|b|c" */
static void alternatives(FILE *dict, const char *text)
{
    for (size_t n; text && *text; text += n + (text[n] == '|')) {
        n = strcspn(text, "|");
        word(dict, text, n);
    }
}

static void json_words(FILE *dict)
{
    WORDS(dict, "null", "true", "false", "\":", "\":{", "\":[", "},\"", "],\"", "1e308", "-0.0", "1e-320", "2147483648",
          "4294967296", "\\u0000", "\\ud83d\\ude00");
}

static void scene_words(FILE *dict, bool paths)
{
    char path[KD_PATH_SIZE];
    for (size_t i = 0; i < KD_SECTION_COUNT && !paths; i++)
        word(dict, kd_section_member(&kd_sections[i]), strlen(kd_section_member(&kd_sections[i])));
    for (size_t i = 0; i < KD_OLD_NAME_COUNT; i++)
        word(dict, kd_old_names[i].name, strlen(kd_old_names[i].name));
    for (size_t i = 0; i < KD_FIELD_COUNT; i++) {
        kd_field_path(&kd_fields[i], 0, path);
        const char *name = paths ? path : kd_fields[i].name;
        word(dict, name, strlen(name));
        alternatives(dict, kd_fields[i].words);
    }
    for (size_t i = 0; i < kd_preset_count && paths; i++)
        word(dict, kd_presets[i].name, strlen(kd_presets[i].name));
}

static void row_words(FILE *dict, const struct kd_document *document)
{
    for (size_t i = 0; i < document->n; i++) {
        const struct kd_row *row = &document->rows[i];
        WORDS(dict, row->name, row->object ? row->object : row->name);
        alternatives(dict, row->words);
    }
}

static void write_scene_dictionaries(void)
{
    static const char *const documents[] = { "scene", "patch", "job", "pictures", "playground", "state", "integrals" },
                             *const texts[] = { "query", "line", "link" };
    for (size_t i = 0; i < sizeof documents / sizeof *documents + sizeof texts / sizeof *texts; i++) {
        const bool paths = i >= sizeof documents / sizeof *documents;
        const char *name = paths ? texts[i - sizeof documents / sizeof *documents] : documents[i];
        FILE *dict = open_file(name, "");
        json_words(dict);
        WORDS(dict, "\n---\n", "version");
        scene_words(dict, paths);
        if (!strcmp(name, "query"))
            WORDS(dict, "/v1/render?", "preset=", "&", "%20", "%00", "format=png");
        if (!strcmp(name, "line"))
            WORDS(dict, "axis ", "=", "+", "x", ":", "/", "spots.0.on=true");
        if (!strcmp(name, "job") || !strcmp(name, "state"))
            WORDS(dict, "scenes", "keyframes", "frame", "frames", "scene", "axes", "output", "playground", "every",
                  "exposure", "one", "each", "motion_blur", "samples", "shutter", "interpolation", "smooth",
                  "catmull-rom", "linear", "distances", "geometric", "angles", "shorter", "ease", "in-out", "look_at",
                  "hole", "free", "theta_deg", "phi_deg", "proper_time", "horizon", "end", "at", "light-curve",
                  "format", "request", "device", "version", "rows", "sets", "engine", "precision");
        if (!strcmp(name, "playground") || !strcmp(name, "job")) {
            row_words(dict, &kd_playground_settings);
            row_words(dict, &kd_playground_body_fields);
            for (size_t k = 0; k < kd_playground_n_presets; k++)
                word(dict, kd_playground_presets[k].name, strlen(kd_playground_presets[k].name));
            WORDS(dict, "preset", "bodies", "state", "position", "velocity", "name", "id", "add", "change", "remove",
                  "by");
        }
        for (size_t k = 0; k < kd_n_integral_fields && !strcmp(name, "integrals"); k++) {
            if (kd_integral_fields[k].object)
                WORDS(dict, kd_integral_fields[k].object);
            WORDS(dict, kd_integral_fields[k].name);
            alternatives(dict, kd_integral_fields[k].words);
        }
        fclose(dict);
    }
}

static void write_other_dictionaries(void)
{
    FILE *dict = open_file("orbits", "");
    json_words(dict);
    row_words(dict, &kd_orbit_request_document);
    row_words(dict, &kd_orbit_document);
    WORDS(dict, "orbit", "orbits", "series", "spin");
    fclose(dict);

    dict = open_file("rays", "");
    json_words(dict);
    row_words(dict, &kd_rays_document);
    WORDS(dict, "rays", "closed", "high", "auto", "'descr': '<f8'", "'fortran_order': False", "'shape': (1, 2)");
    fclose(dict);

    dict = open_file("quantity", "");
    for (size_t i = 0; i < kd_quantity_count; i++) {
        WORDS(dict, kd_quantities[i]->name);
        for (size_t k = 0; k < kd_quantities[i]->n_parameters; k++) {
            WORDS(dict, kd_quantities[i]->parameters[k].name, kd_quantities[i]->parameters[k].typed);
            alternatives(dict, kd_quantities[i]->parameters[k].words);
        }
    }
    for (int i = 0; i < KD_PARTICLE_N_COLUMNS; i++)
        WORDS(dict, kd_particle_column_name((enum kd_particle_column)i));
    row_words(dict, &kd_orbit_request_document);
    row_words(dict, &kd_orbit_document);
    WORDS(dict, "digits", "fields=", "first=", "stride=", "count=", "time=", "0:1:3", "orbit\n", "rays\n",
          "particles\n");
    fclose(dict);

    dict = open_file("http", "");
    for (size_t i = 0; i < kd_n_routes; i++)
        WORDS(dict, kd_routes[i].path);
    WORDS(dict, "/healthz", "?order=1", "&since=", "%2e", "%c3%a9", "image/png", "image/*", "*/*", ";q=0.5", ", ",
          "gzip", "W/\"", "localhost:8080", "[::1]:80", "application/json; charset=utf-8");
    fclose(dict);

    dict = open_file("files", "");
    WORDS(dict, "\x93NUMPY\x01", "'descr': '<f8'", "'|u1'", "'<U12'", "[('a', '<f4', (3,))]", "'fortran_order': False",
          "'shape': (2, 3)", "SIMPLE  =                    T", "CONTINUE  '", "NAXIS   =", "END", "PK\x05\x06",
          "PK\x01\x02", "SCENE");
    fclose(dict);

    dict = open_file("assets", "");
    WORDS(dict, "IHDR", "IDAT", "IEND", "tEXt", "iTXt", "zTXt", "PLTE", "tRNS", "\x89PNG\r\n\x1a\n",
          "{\"format\":\"kerrd-grid\",\"version\":1,\"spin\":", "\"charge\":", "boyer-lindquist", "kerr-schild",
          "units", "'<f4'", "'shape': (2, 3)");
    fclose(dict);

    dict = open_file("access", "");
    WORDS(dict, " view ", " render ", "\n", "#", "\t", "0123456789abcdef");
    fclose(dict);
}

static void write_scenes(void)
{
    for (size_t i = 0; i < kd_preset_count; i++) {
        struct kd_scene scene;
        struct kd_buffer text = { 0 };
        char query[100];
        const char *name = kd_presets[i].name, *json = kd_presets[i].json;
        CHECK(!kd_scene_preset(&scene, name, NULL), "%s is no preset", name);
        put_text("scene", name, json);
        put("patch", name, i % 2 ? "{\"camera\":{\"r\":60},\"spots\":[{\"on\":true}]}\n---\n" : "{}\n---\n", json,
            strlen(json));
        put("pictures", name, (const char *const[]) { "", "!", "%", "&" }[i % 4], json, strlen(json));
        snprintf(query, sizeof query, "/v1/render?preset=%s&image.width=64", name);
        put_text("query", name, query);
        snprintf(query, sizeof query, "=preset=%s&camera.r=60", name);
        put_text("link", name, query);
        CHECK(!kd_scene_line(&scene, &text), "out of memory");
        for (size_t k = 0; k < text.size; k++)
            text.data[k] = text.data[k] == ' ' ? '\n' : text.data[k];
        put("line", name, "", text.data, text.size);
        kd_buffer_finish(&text);
    }
    struct kd_scene scene;
    struct kd_buffer text = { 0 };
    kd_scene_defaults(&scene);
    CHECK(!kd_scene_to_json(&scene, &text), "out of memory");
    put("scene", "whole", "", text.data, text.size);
    put("query", "post", "/v1/render?preset=smooth\n---\n", text.data, text.size);
    kd_buffer_finish(&text);
}

static void write_playgrounds(void)
{
    for (size_t i = 0; i < kd_playground_n_presets; i++) {
        struct kd_playground *p = NULL;
        struct kd_playground_progress progress;
        struct kd_buffer text = { 0 };
        char document[120];
        snprintf(document, sizeof document, "{\"preset\":\"%s\",\"debris_capacity\":64,\"debris_per_body\":16}",
                 kd_playground_presets[i].name);
        put("playground", kd_playground_presets[i].name, document, "\n---\n{}\n---\n{\"by\":10}", 22);
        CHECK(!kd_playground_read(document, strlen(document), &p, NULL), "%s is no playground", document);
        if (p->n <= 8) {
            kd_playground_advance(p, 20, &progress);
            CHECK(!kd_playground_write(p, true, &text), "out of memory");
            snprintf(document, sizeof document, "%s-snapshot", kd_playground_presets[i].name);
            put("playground", document, "", text.data, text.size);
        }
        kd_playground_destroy(p);
        kd_buffer_finish(&text);
    }
}

static void write_quantities(void)
{
    for (size_t i = 0; i < kd_quantity_count; i++) {
        struct kd_buffer text = { 0 };
        CHECK(!kd_buffer_printf(&text, "%s\n", kd_quantities[i]->name), "out of memory");
        for (size_t k = 0; k < kd_quantities[i]->n_parameters; k++)
            CHECK(!kd_buffer_printf(&text, "%s=%s\n", kd_quantities[i]->parameters[k].name,
                                    kd_quantities[i]->parameters[k].typed),
                  "out of memory");
        put("quantity", kd_quantities[i]->name, "", text.data, text.size);
        kd_buffer_finish(&text);
    }
}

static void add_array(struct kd_zip *zip, struct kd_buffer *records, unsigned number, const char *name,
                      const uint64_t *shape, size_t dimensions, const double *data)
{
    struct kd_npy array = { .fields = { { "", KD_NPY_F8, 0 } }, .n_fields = 1, .n_dimensions = dimensions };
    struct kd_buffer bytes = { 0 };
    char file[40];
    size_t n = 1;
    for (size_t i = 0; i < dimensions; i++)
        n *= array.shape[i] = shape[i];
    snprintf(file, sizeof file, "%s.npy", name);
    CHECK(!kd_npy_write_header(&array, &bytes) && !kd_buffer_append(&bytes, data, 8 * n) &&
              !kd_zip_add(zip, file, bytes.data, bytes.size),
          "out of memory");
    const uint8_t head[3] = { (uint8_t)number, (uint8_t)bytes.size, (uint8_t)(bytes.size >> 8) };
    CHECK(!kd_buffer_append(records, head, 3) && !kd_buffer_append(records, bytes.data, bytes.size), "out of memory");
    kd_buffer_finish(&bytes);
}

/* The smallest grid of matter, or the smallest series of three grids, as an NPZ file and as records of the target
 * `assets`. */
static void write_grid(bool series)
{
    static const char header[] =
        "{\"format\":\"kerrd-grid\",\"version\":1,\"spin\":0.5,\"charge\":0.25,\"azimuth\":\"kerr-schild\","
        "\"time\":\"boyer-lindquist\",\"units\":{\"time\":\"M\",\"r\":\"M\",\"theta\":\"rad\",\"density\":\"cm^-3\","
        "\"temperature\":\"K\","
        "\"u_con_r\":\"c\",\"u_con_theta\":\"c/M\",\"u_cov_phi\":\"c "
        "M\",\"b_con_r\":\"G\",\"b_con_theta\":\"G/M\",\"b_cov_phi\":\"G M\"}}";
    static const char *const kinds[] = { "density", "temperature", "u_con_r",     "u_con_theta", "u_cov_phi",
                                         "",        "b_con_r",     "b_con_theta", "b_cov_phi" };
    const double r[2] = { 6, 20 }, theta[3] = { M_PI / 6, M_PI / 2, 5 * M_PI / 6 }, none[18] = { 0 },
                 some[18] = { 1e6, 2e6, 1e6, 0, 2e6, 1e6, 1e6, 1e6, 1e6, 0, 1e6, 1e6, 2e6, 2e6, 1e6, 0, 1e6, 2e6 },
                 times[3] = { -5, 0, 5 };
    const uint64_t shape[3] = { 3, 2, 3 };
    const struct kd_npy text = {
        .fields = { { "", KD_NPY_U1, 0 } }, .n_fields = 1, .shape = { sizeof header - 1 }, .n_dimensions = 1
    };
    struct kd_buffer file = { 0 }, records = { 0 }, bytes = { 0 };
    struct kd_zip *zip;
    CHECK(!kd_zip_create(&file, false, &zip) && !kd_npy_write_header(&text, &bytes) &&
              !kd_buffer_append(&bytes, header, sizeof header - 1) &&
              !kd_zip_add(zip, "header.npy", bytes.data, bytes.size),
          "out of memory");
    const uint8_t head[3] = { 0, (uint8_t)(sizeof header - 1), (uint8_t)((sizeof header - 1) >> 8) };
    CHECK(!kd_buffer_append(&records, head, 3) && !kd_buffer_append(&records, header, sizeof header - 1),
          "out of memory");
    add_array(zip, &records, 1, "r", (const uint64_t[]) { 2 }, 1, r);
    add_array(zip, &records, 2, "theta", (const uint64_t[]) { 3 }, 1, theta);
    for (unsigned i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (*kinds[i])
            add_array(zip, &records, 4 + i, kinds[i], shape + !series, series ? 3 : 2, i < 2 ? some : none);
    if (series)
        add_array(zip, &records, 13, "time", shape, 1, times);
    CHECK(!kd_zip_close(zip), "out of memory");
    kd_zip_destroy(zip);
    put("assets", series ? "series.npz" : "grid.npz", "", file.data, file.size);
    put("assets", series ? "series" : "grid", "grid", records.data, records.size);
    for (uint8_t way = 1; way < 8 && !series; way++) { /* a value of `ways` in assets.c, applied to the array r */
        const size_t at = (size_t)(3 + sizeof header - 1);
        char name[16];
        records.data[at] = (uint8_t)(1 + 14 * way);
        snprintf(name, sizeof name, "grid-%d", way);
        put("assets", name, "grid", records.data, records.size);
    }
    if (!series) {
        put("files", "members", "1", file.data, file.size);
        put("pictures", "grid.npz", "", file.data, file.size);
    }
    kd_buffer_finish(&file);
    kd_buffer_finish(&records);
    kd_buffer_finish(&bytes);
}

static void write_pictures(void)
{
    const struct kd_png_text texts[] = { { "kerrd:scene", "{\"camera\":{\"r\":40}}" },
                                         { "Copyright", "\xc3\xa9 ESA" } };
    uint16_t pixels[32 * 16 * 3];
    for (size_t i = 0; i < sizeof pixels / sizeof *pixels; i++)
        pixels[i] = (uint16_t)(i * 2654435761u >> 8);
    for (int depth = 8; depth <= 16; depth += 8) {
        const struct kd_png_params params = { 32, 16, depth, 1, pixels, texts, 2 };
        struct kd_buffer file = { 0 };
        CHECK(!kd_png_encode(&params, &file, NULL), "out of memory");
        put("assets", depth == 8 ? "8.png" : "16.png", "", file.data, file.size);
        put("pictures", depth == 8 ? "8.png" : "16.png", "", file.data, file.size);
        kd_buffer_finish(&file);
    }
}

static void write_arrays(void)
{
    const double rays[] = { -5, 0, 2.5, 1e-3 };
    const struct kd_npy array = {
        .fields = { { "", KD_NPY_F8, 0 } }, .n_fields = 1, .shape = { 2, 2 }, .n_dimensions = 2
    };
    struct kd_buffer bytes = { 0 };
    CHECK(!kd_npy_write_header(&array, &bytes) && !kd_buffer_append(&bytes, rays, sizeof rays), "out of memory");
    put("rays", "list.npy", "", bytes.data, bytes.size);
    put("files", "array", "0", bytes.data, bytes.size);
    kd_buffer_finish(&bytes);
}

static void write_accuracy(void)
{
    struct kd_accuracy_table *table = malloc(sizeof *table);
    struct kd_buffer text = { 0 };
    CHECK(table, "out of memory");
    *table = *kd_accuracy_built_in();
    table->n = 1;
    CHECK(!kd_accuracy_to_json(table, &text), "out of memory");
    put("state", "accuracy", "1", text.data, text.size);
    kd_buffer_finish(&text);
    free(table);
}

/* A file with every option that has a default, and the same options as environment variables. */
static void write_settings(void)
{
    FILE *dict = open_file("config", ""), *file = open_file("config", "defaults"),
         *variables = open_file("config", "variables");
    bool first = true;
    json_words(dict);
    WORDS(dict, "\n---\n", "KERRD_", "=", ",", "yes", "https://example.org", "http://[::1]:8080", "1536M", "2G");
    fputs("{}\n---", variables);
    for (size_t i = 0; i < KD_SERVE_COUNT; i++) {
        const struct kd_cli_setting *s = &kd_serve_settings[i];
        char name[KD_SETTING_VARIABLE];
        kd_setting_variable(s, name);
        WORDS(dict, s->name, name);
        alternatives(dict, s->kind == KD_SETTING_WORDS ? s->argument : NULL);
        if (!s->initial || s->where != KD_SETTING_ANYWHERE)
            continue;
        const char *quote = s->kind == KD_SETTING_NUMBER || s->kind == KD_SETTING_SWITCH ? "" : "\"";
        fprintf(file, "%c\"%s\":%s%s%s", first ? '{' : ',', s->name, quote,
                s->kind != KD_SETTING_SWITCH ? s->initial
                : !strcmp(s->initial, "yes") ? "true"
                                             : "false",
                quote);
        fprintf(variables, "\n%s=%s", name, s->initial);
        first = false;
    }
    fputs("}", file);
    fclose(dict);
    fclose(file);
    fclose(variables);
    put_text("config", "lists",
             "{\"host\":[\"a.example\",\"b.example\"],\"cors-origin\":[\"https://example.org,http://"
             "localhost:8888\",\"null\"],\"memory\":\"2G\"}\n---\nKERRD_HOST=c.example");
}

static void write_targets(void)
{
    for (size_t i = 0; i < kd_n_routes; i++) {
        char name[40], head[400];
        snprintf(name, sizeof name, "route-%02zu", i);
        snprintf(head, sizeof head,
                 "/some/prefix%s?order=1&since=%%31\n/some/prefix\n%s, image/*;q=0.5, */*;q=0.1\ngzip;q=0.5, "
                 "*\nW/\"abc-1\", *\napplication/json; charset=utf-8\nlocalhost:8080\nabc-1.2\n17",
                 kd_routes[i].path, kd_routes[i].answer ? kd_routes[i].answer : "image/png");
        put_text("http", name, head);
    }
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fputs("kd_fuzz_seeds OUT: writes seeds and dictionaries into this folder, which is there\n", stderr);
        return 2;
    }
    out = argv[1];
    write_scene_dictionaries();
    write_other_dictionaries();
    write_scenes();
    write_playgrounds();
    write_quantities();
    write_grid(false);
    write_grid(true);
    write_pictures();
    write_arrays();
    write_accuracy();
    write_settings();
    write_targets();
    return 0;
}
