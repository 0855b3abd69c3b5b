/* Fuzz target: a document of a table with a field of each kind; read as JSON, and line by line as NAME=VALUE. */
#include "fuzz.h"

#include "../document_example.h"
#include "document/tree.h"

/* A row that accepts a range must also accept the numbers of the range. */
static void check_range(const char *name, const char *text)
{
    const struct kd_row *row = kd_document_find(&tea_document, name);
    struct kd_range range;
    struct kd_error error = { 0 };
    if (!row || row->kind > KD_KIND_INT)
        return;
    const enum kd_status status = kd_row_range(row, text, "/x", &range, &error);
    if (status) {
        kd_fuzz_refused(status, &error);
        return;
    }
    CHECK(range.count >= 1 && range.count <= KD_RANGE_MOST, "%zu numbers", range.count);
    for (size_t i = 0; i < range.count; i += 1 + range.count / 7) {
        const double x = kd_range_at(&range, i);
        CHECK(row->words && isinf(x) ? range.count == 1 : kd_row_holds(row, x) || row->above_0 > 0, "%s has %g", name,
              x);
        CHECK(row->kind != KD_KIND_INT || x == floor(x), "%s has %g", name, x);
    }
}

static void check(struct tea *tea, enum kd_status status, const struct kd_error *error)
{
    if (status) {
        kd_fuzz_refused(status, error);
        return;
    }
    CHECK(kd_row_holds(&tea_rows[0], tea->minutes) && kd_row_holds(&tea_rows[1], tea->sugar_g) &&
              (isinf(tea->heat) || kd_row_holds(&tea_rows[2], tea->heat)),
          "%g minutes, %g g, %g degrees", tea->minutes, tea->sugar_g, tea->heat);
    CHECK(tea->cups >= 1 && tea->cups <= 8 && tea->leaf >= 0 && tea->leaf <= 2 && tea->pot >= -1 && tea->pot <= 1 &&
              tea->with && tea->with < 8 && tea->times.n <= 4 && strnlen(tea->name, sizeof tea->name) < 8,
          "%u cups, leaf %d, pot %d, with %u, %zu times", tea->cups, tea->leaf, tea->pot, tea->with, tea->times.n);
    for (size_t i = 0; i < tea->times.n + 3; i++)
        CHECK(i < 3 ? fabs(tea->place[i]) <= 9 : tea->times.at[i - 3] >= 0 && tea->times.at[i - 3] <= 24,
              "number %zu of the lists", i);
    struct kd_buffer out = { 0 };
    struct kd_json json = kd_json_begin(&out);
    kd_json_object(&json, NULL);
    kd_document_write(&json, &tea_document, tea);
    kd_json_end(&json);
    CHECK(!kd_json_finish(&json), "the document cannot be written");
    kd_fuzz_json(&out);
    /* The written text must read back as the same values. */
    struct tea again;
    cJSON *tree = NULL;
    struct kd_error why = { 0 };
    kd_document_defaults(&tea_document, &again);
    CHECK(!kd_tree_parse((const char *)out.data, out.size, 4096, 64, &tree, &why), "%s", why.message);
    CHECK(!kd_document_read(&tea_document, &again, tree, "", NULL, &why), "%s", why.message);
    CHECK(again.minutes == tea->minutes && again.heat == tea->heat && again.with == tea->with &&
              again.pot == tea->pot && !strcmp(again.name, tea->name),
          "%s", (const char *)out.data);
    kd_tree_free(tree);
    kd_buffer_finish(&out);
}

int kd_fuzz_document(const uint8_t *data, size_t size)
{
    struct tea tea;
    struct kd_error error = { 0 };
    struct kd_fuzz_text line;
    enum kd_status status = KD_OK;
    cJSON *tree = NULL;
    kd_document_defaults(&tea_document, &tea);
    if (size && *data != '{') {
        while (!status && kd_fuzz_next(&data, &size, &line)) {
            char *value = strchr(line.at, '=');
            if (value) {
                *value++ = 0;
                check_range(line.at, value);
                status = kd_document_set(&tea_document, &tea, line.at, value, NULL, &error);
            }
            free(line.at);
        }
    } else {
        line = kd_fuzz_bare(data, size);
        status = kd_tree_parse(line.at, line.size, 4096, 64, &tree, &error);
        if (!status)
            status = kd_document_read(&tea_document, &tea, tree, "", NULL, &error);
        kd_tree_free(tree);
        free(line.at);
    }
    check(&tea, status, &error);
    free(tea.times.at);
    return 0;
}
