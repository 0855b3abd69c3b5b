/* Fuzz target: files that kerrd keeps between runs. The first byte selects the kind: the state of a film; a table of
 * accuracy; the record of a job, a line "---" and its request; and the timeline of a session's path. */
#include "fuzz.h"

#include "base/log.h"
#include "cli/film_state.h"
#include "render/accuracy/table.h"
#include "document/document.h"
#include "scene/timeline.h"
#include "document/tree.h"
#include "server/job/store.h"

#include <math.h>
#include <sys/stat.h>

#define JOB "0123456789abcdef"

static void read_film(const struct kd_fuzz_text *text)
{
    struct kd_film_state state = { .frames = 24, .device = "llvmpipe" };
    struct kd_error error = { 0 };
    bool there = false;
    int folder;
    kd_fuzz_folder(&folder);
    memset(state.request, 'a', 64);
    kd_fuzz_file("film.json", text->at, text->size);
    const enum kd_status status = kd_film_state_read(folder, "a folder", &state, &there, &error);
    if (status)
        kd_fuzz_refused(status, &error);
    else
        CHECK(there, "the state of a film is not there");
}

static void read_accuracy(const struct kd_fuzz_text *text)
{
    struct kd_accuracy_table *table = calloc(1, sizeof *table), *back = calloc(1, sizeof *back);
    struct kd_buffer first = { 0 }, again = { 0 };
    struct kd_accuracy_choice choice;
    struct kd_error error = { 0 };
    CHECK(table && back, "out of memory");
    enum kd_status status = kd_accuracy_from_json(text->at, text->size, table, &error);
    if (status)
        kd_fuzz_refused(status, &error);
    else {
        CHECK(table->n <= KD_ACCURACY_ROWS, "a table has %u rows", table->n);
        CHECK(!kd_accuracy_to_json(table, &first) &&
                  !kd_accuracy_from_json((char *)first.data, first.size, back, &error),
              "a table that was written: %s", error.message);
        CHECK(!kd_accuracy_to_json(back, &again) && again.size == first.size &&
                  !memcmp(again.data, first.data, first.size),
              "%s became %s", (char *)first.data, (char *)again.data);
        if ((status = kd_accuracy_choose(table, 1e-4, NULL, &choice, &error)))
            kd_fuzz_refused(status, &error);
        else
            CHECK(choice.error <= 1e-4, "what holds 1e-4 is off by %g", choice.error);
    }
    kd_buffer_finish(&first);
    kd_buffer_finish(&again);
    free(table);
    free(back);
}

static void found(void *user, const struct kd_job_record *record, struct kd_buffer *request)
{
    (void)user;
    CHECK(!strcmp(record->id, JOB) && strlen(record->token) == KD_SECRET_TOKEN - 1 && record->series &&
              record->state <= KD_JOB_FAILED,
          "the record of a job is none");
    CHECK(record->frames <= KD_SWEEP_MOST, "a job has %u frames", record->frames);
    kd_buffer_finish(request);
}

static void read_job(const struct kd_fuzz_text *text)
{
    static struct kd_job_store *store; /* lives as long as the process */
    const uint8_t *data = (const uint8_t *)text->at;
    size_t size = text->size;
    struct kd_fuzz_text record = kd_fuzz_part(&data, &size);
    struct kd_error error = { 0 };
    int folder;
    if (!store) {
        kd_log_set_level(KD_LOG_ERROR);
        CHECK(!kd_job_store_open(kd_fuzz_folder(&folder), &store, &error), "%s", error.message);
        CHECK(!mkdirat(folder, "jobs/" JOB, 0700), "a folder of a job cannot be made");
    }
    kd_fuzz_file("jobs/" JOB "/job.json", record.at, record.size);
    kd_fuzz_file("jobs/" JOB "/request.json", data, size);
    const enum kd_status status = kd_job_store_load(store, found, NULL, &error);
    if (status)
        kd_fuzz_refused(status, &error);
    free(record.at);
}

static void go_along(const struct kd_timeline *path)
{
    struct kd_scene scene;
    struct kd_error error = { 0 };
    const double end = kd_timeline_end(path);
    CHECK(end >= 0 && end <= 3600, "a path ends at %g s", end);
    for (int i = 0; i <= 4; i++) {
        enum kd_status status = kd_timeline_scene(path, end * i / 4, &scene, &error);
        if (status) {
            kd_fuzz_refused(status, &error);
            continue;
        }
        kd_fuzz_fields(&scene);
        status = kd_scene_validate(&scene, &error);
        CHECK(!status, "at %g s of a path the scene is not valid: %s", end * i / 4, error.message);
    }
}

static void read_path(const struct kd_fuzz_text *text)
{
    static const struct kd_timeline_form by_second = { "at", 3600, false };
    struct asked { struct kd_timeline_items items; } asked = { { 0 } };
    static const struct kd_row rows[] = { KD_TIMELINE_ROWS(struct asked, items) };
    static const struct kd_document document = { .rows = rows, .n = sizeof rows / sizeof *rows };
    struct kd_timeline path = { 0 };
    struct kd_scene scene;
    struct kd_error error = { 0 };
    cJSON *root = NULL;
    kd_scene_defaults(&scene);
    enum kd_status status;
    KD_TRY(kd_tree_parse(text->at, text->size, KD_SCENE_JSON_MAX, KD_SCENE_JSON_MAX, &root, &error));
    KD_TRY(kd_document_read(&document, &asked, root, "", NULL, &error));
    KD_TRY(kd_timeline_read(&asked.items, &by_second, NULL, &scene, &path, &error));
    go_along(&path);
done:
    if (status)
        kd_fuzz_refused(status, &error);
    kd_timeline_finish(&path);
    cJSON_Delete(root);
}

int kd_fuzz_state(const uint8_t *data, size_t size)
{
    static void (*const read[])(const struct kd_fuzz_text *) = { read_film, read_accuracy, read_path, read_job };
    if (!size)
        return 0;
    struct kd_fuzz_text text = kd_fuzz_bare(data + 1, size - 1);
    read[*data % 4](&text);
    free(text.at);
    return 0;
}
