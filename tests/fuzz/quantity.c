/* Fuzz target: requests for a quantity, orbits, rays or particles by name. The first line is the kind, and each further
 * line is NAME=VALUE. Cheap quantities are also computed. */
#include "fuzz.h"

#include "orbit/request.h"
#include "quantity/quantity.h"
#include "render/output/particle_list.h"
#include "render/rays/request.h"

enum { POINTS = 20 };
#define LONGEST_MS 2

static void evaluate(const struct kd_quantity_request *request)
{
    struct kd_quantity_answer answer = { 0 };
    struct kd_buffer text = { 0 };
    struct kd_error error = { 0 };
    if (kd_quantity_points(request) > POINTS || kd_quantity_cost_ms(request) > LONGEST_MS)
        return;
    const enum kd_status status = kd_quantity_evaluate(request, &answer, &error);
    if (status) {
        kd_fuzz_refused(status, &error);
        return;
    }
    CHECK(!kd_quantity_json(&answer, &text), "an answer cannot be written");
    kd_fuzz_json(&text);
    text.size = 0;
    CHECK(!kd_quantity_csv(&answer, &text), "an answer cannot be written as CSV");
    size_t lines = 0;
    for (size_t i = 0; i < text.size; i++)
        lines += text.data[i] == '\n';
    CHECK(lines == answer.points + 1, "%zu points have %zu lines", answer.points, lines);
    kd_buffer_finish(&text);
    kd_quantity_answer_finish(&answer);
}

/* Takes the next NAME=VALUE. *value points into it. Returns false if no input is left. */
static bool next(const uint8_t **data, size_t *size, struct kd_fuzz_text *line, char **value)
{
    static char none[] = "";
    if (!kd_fuzz_next(data, size, line))
        return false;
    *value = strchr(line->at, '=');
    if (*value)
        *(*value)++ = 0;
    else
        *value = none;
    return true;
}

static void ask_quantity(const struct kd_quantity *quantity, const uint8_t *data, size_t size)
{
    struct kd_quantity_request request;
    struct kd_error error = { 0 };
    struct kd_fuzz_text line;
    enum kd_status status = KD_OK;
    char *value;
    kd_quantity_request_init(&request, quantity);
    while (!status && next(&data, &size, &line, &value)) {
        status = kd_quantity_request_set(&request, line.at, value, &error);
        free(line.at);
    }
    if (status)
        kd_fuzz_refused(status, &error);
    else
        evaluate(&request);
}

static void ask_orbit(const uint8_t *data, size_t size)
{
    struct kd_orbit_request request;
    struct kd_error error = { 0 };
    struct kd_fuzz_text line;
    enum kd_status status = KD_OK;
    char *value;
    kd_orbit_request_init(&request);
    while (!status && next(&data, &size, &line, &value)) {
        status = kd_orbit_request_set(&request, line.at, value, &error);
        free(line.at);
    }
    if (!status)
        status = kd_orbit_request_check(&request, &error);
    if (status)
        kd_fuzz_refused(status, &error);
    kd_orbit_request_finish(&request);
}

static void ask_rays(const uint8_t *data, size_t size)
{
    struct kd_rays_request request;
    struct kd_error error = { 0 };
    struct kd_fuzz_text line;
    enum kd_status status = KD_OK;
    char *value;
    kd_rays_request_init(&request);
    while (!status && next(&data, &size, &line, &value)) {
        status = kd_rays_request_set(&request, line.at, value, &error);
        free(line.at);
    }
    if (!status)
        status = kd_rays_request_check(&request, &error);
    if (status)
        kd_fuzz_refused(status, &error);
    kd_rays_request_finish(&request);
}

static void ask_particles(const uint8_t *data, size_t size)
{
    struct kd_particle_list list;
    struct kd_scene scene;
    struct kd_error error = { 0 };
    struct kd_fuzz_text line;
    char *value;
    kd_scene_defaults(&scene);
    CHECK(!kd_scene_set(&scene, "disk.model", "particles", &error) &&
              !kd_scene_set(&scene, "disk.particles", "1000", &error),
          "%s", error.message);
    enum kd_status status = kd_particle_list_init(&list, &scene, &error);
    CHECK(!status, "a scene of particles has none: %s", error.message);
    while (!status && next(&data, &size, &line, &value)) {
        status = kd_particle_list_set(&list, line.at, value, &error);
        free(line.at);
    }
    if (!status)
        status = kd_particle_list_settle(&list, 1 << 20, &error);
    if (status)
        kd_fuzz_refused(status, &error);
    else
        CHECK(list.n && list.n_columns && list.n * kd_particle_list_row(&list) <= 1 << 20,
              "a list has %zu rows of %zu bytes", list.n, kd_particle_list_row(&list));
}

int kd_fuzz_quantity(const uint8_t *data, size_t size)
{
    struct kd_fuzz_text name;
    if (!kd_fuzz_next(&data, &size, &name))
        return 0;
    const struct kd_quantity *quantity = kd_quantity_find(name.at);
    if (quantity)
        ask_quantity(quantity, data, size);
    else if (*name.at == 'o')
        ask_orbit(data, size);
    else if (*name.at == 'r')
        ask_rays(data, size);
    else
        ask_particles(data, size);
    free(name.at);
    return 0;
}
