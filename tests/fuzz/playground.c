/* Fuzz target: a document of a playground, a line "---", a patch of it, another line "---" and the body of a step.
 * The snapshots before and after the step must read back unchanged to the bit. */
#include "fuzz.h"

#include "playground/json.h"
#include "playground/show.h"
#include "server/playground/document.h"

#include <math.h>

enum { PIECES = 3000, BODIES = 12, STEPS = 8 };

static void check_snapshot(struct kd_playground *p)
{
    struct kd_buffer text = { 0 }, again = { 0 };
    struct kd_playground *back = NULL;
    struct kd_error error = { 0 };
    CHECK(!kd_playground_write(p, true, &text), "a playground cannot be written");
    CHECK(!kd_playground_read((const char *)text.data, text.size, &back, &error), "%s: %s, in its own snapshot %.*s",
          error.pointer, error.message, (int)text.size, (char *)text.data);
    CHECK(!kd_playground_write(back, true, &again), "a playground cannot be written again");
    CHECK(again.size == text.size && !memcmp(again.data, text.data, text.size), "%s became %s", (char *)text.data,
          (char *)again.data);
    kd_playground_destroy(back);
    kd_buffer_finish(&text);
    kd_buffer_finish(&again);
}

static void check_status(struct kd_playground *p)
{
    struct kd_buffer text = { 0 };
    struct kd_json json = kd_json_begin(&text);
    kd_json_object(&json, NULL);
    kd_playground_status_json(p, &json);
    kd_json_end(&json);
    CHECK(!kd_json_finish(&json), "how a playground stands cannot be written");
    kd_fuzz_json(&text);
    kd_buffer_finish(&text);
}

static bool is_small(const struct kd_playground *p)
{
    return p->n <= BODIES && p->debris.capacity <= PIECES && p->params.debris_per_body <= PIECES;
}

static void check(struct kd_playground *p)
{
    struct kd_dynamic_bodies *dynamic = NULL;
    struct kd_error error = { 0 };
    for (size_t i = 0; i < p->n; i++)
        for (int k = 0; k < 3; k++)
            CHECK(isfinite(p->bodies[i].x[k]) && isfinite(p->bodies[i].v[k]), "body %zu is at %g, with %g", i,
                  p->bodies[i].x[k], p->bodies[i].v[k]);
    if (!is_small(p))
        return;
    check_status(p);
    check_snapshot(p);
    const enum kd_status status = kd_playground_show(p, &dynamic, &error);
    if (status)
        kd_fuzz_refused(status, &error);
    kd_dynamic_bodies_release(dynamic);
}

static void change(struct kd_playground **p, const struct kd_fuzz_text *patch)
{
    struct kd_error error = { 0 };
    struct kd_playground *before = *p;
    const enum kd_status status = kd_playground_patch(p, patch->at, patch->size, &error);
    if (!status)
        return;
    kd_fuzz_refused(status, &error);
    CHECK(*p == before, "a patch was refused, and the playground is another one");
}

static void step(struct kd_playground *p, const struct kd_fuzz_text *text)
{
    struct kd_error error = { 0 };
    struct kd_playground_run run;
    double by = 0;
    const enum kd_status status = kd_playground_session_read_step(text->at, text->size, &by, &error);
    if (status) {
        kd_fuzz_refused(status, &error);
        return;
    }
    CHECK(by > 0 && isfinite(by), "a step is by %g", by);
    if (!is_small(p))
        return;
    kd_playground_begin(p, by, &run);
    run.left = run.left < STEPS ? run.left : STEPS;
    while (kd_playground_go_on(p, &run, STEPS)) {
    }
}

int kd_fuzz_playground(const uint8_t *data, size_t size)
{
    struct kd_fuzz_text document = kd_fuzz_part(&data, &size), patch = kd_fuzz_part(&data, &size),
                        by = kd_fuzz_copy(data, size);
    struct kd_playground *p = NULL;
    struct kd_error error = { 0 };
    const enum kd_status status = kd_playground_read(document.at, document.size, &p, &error);
    if (status)
        kd_fuzz_refused(status, &error);
    else {
        check(p);
        if (patch.size && is_small(p))
            change(&p, &patch);
        if (by.size)
            step(p, &by);
        check(p);
    }
    kd_playground_destroy(p);
    free(document.at);
    free(patch.at);
    free(by.at);
    return 0;
}
