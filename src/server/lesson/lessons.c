/* The table of lessons, and the JSON form of a lesson. */
#include "base/clock.h"
#include "server/lesson/lesson.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct kd_lessons {
    pthread_mutex_t lock;
    unsigned client_limit;
    struct kd_lesson *list[KD_LESSONS]; /* NULL marks a free entry */
};

/* Frees a lesson and overwrites it, because names of pupils must not stay in freed memory. Accepts NULL. */
static void erase(struct kd_lesson *one)
{
    if (one)
        explicit_bzero(one, sizeof *one);
    free(one);
}

struct kd_lessons *kd_lessons_create(unsigned client_limit)
{
    struct kd_lessons *all = calloc(1, sizeof *all);
    if (!all)
        return NULL;
    all->client_limit = client_limit;
    pthread_mutex_init(&all->lock, NULL);
    return all;
}

void kd_lessons_destroy(struct kd_lessons *all)
{
    if (!all)
        return;
    for (size_t i = 0; i < KD_LESSONS; i++)
        erase(all->list[i]);
    pthread_mutex_destroy(&all->lock);
    free(all);
}

void kd_lessons_lock(struct kd_lessons *all) { pthread_mutex_lock(&all->lock); }
void kd_lessons_unlock(struct kd_lessons *all) { pthread_mutex_unlock(&all->lock); }

static void end_idle(struct kd_lessons *all)
{
    const double now = kd_clock_ms();
    for (size_t i = 0; i < KD_LESSONS; i++)
        if (all->list[i] && now - all->list[i]->used_ms > 1e3 * KD_LESSON_IDLE_S)
            kd_lesson_end(all, all->list[i]);
}

void kd_lessons_sweep(struct kd_lessons *all)
{
    kd_lessons_lock(all);
    end_idle(all);
    kd_lessons_unlock(all);
}

enum kd_status kd_lesson_open(struct kd_lessons *all, const char *client, bool *quota, struct kd_lesson **out,
                              struct kd_error *error)
{
    unsigned own = 0, n = 0;
    size_t place = KD_LESSONS;
    end_idle(all);
    for (size_t i = 0; i < KD_LESSONS; i++) {
        if (!all->list[i])
            place = i;
        n += all->list[i] != NULL;
        own += all->list[i] && !strcmp(all->list[i]->client, client);
    }
    *quota = n < KD_LESSONS && own >= all->client_limit;
    if (*quota)
        return kd_error_set(error, KD_EBUSY, "you have too many open lessons (limit %u for one client)", own);
    if (n == KD_LESSONS)
        return kd_error_set(error, KD_EBUSY, "too many open lessons (limit %u)", n);
    struct kd_lesson *one = calloc(1, sizeof *one);
    if (!one || !kd_secret_make(one->id, sizeof one->id) || !kd_secret_make(one->token, sizeof one->token)) {
        free(one);
        return kd_error_set(error, KD_ENOMEM, "no memory or no random numbers for a lesson");
    }
    snprintf(one->client, sizeof one->client, "%s", client);
    snprintf(one->lang, sizeof one->lang, "en");
    one->used_ms = kd_clock_ms();
    *out = all->list[place] = one;
    return KD_OK;
}

struct kd_lesson *kd_lesson_find(struct kd_lessons *all, const char *id)
{
    end_idle(all);
    for (size_t i = 0; i < KD_LESSONS; i++)
        if (all->list[i] && !strcmp(all->list[i]->id, id))
            return all->list[i];
    return NULL;
}

void kd_lesson_end(struct kd_lessons *all, struct kd_lesson *one)
{
    for (size_t i = 0; i < KD_LESSONS; i++)
        if (all->list[i] == one)
            all->list[i] = NULL;
    erase(one);
}

static bool is_present(const struct kd_pupil *pupil, double now)
{
    return *pupil->key && now - pupil->seen_ms <= 1e3 * KD_LESSON_PRESENT_S;
}

static bool has_answered(const struct kd_lesson *one, const struct kd_pupil *pupil)
{
    return *pupil->key && pupil->answered && pupil->answered == one->question.number;
}

/* True if a new pupil should get the entry a rather than the entry b. Each of the two is free or belongs to an
 * absent pupil. */
static bool goes_before(const struct kd_lesson *one, const struct kd_pupil *a, const struct kd_pupil *b)
{
    const bool a_counts = has_answered(one, a), b_counts = has_answered(one, b);
    return a_counts == b_counts ? a->seen_ms < b->seen_ms /* seen_ms of a free entry is 0 */ : b_counts;
}

struct kd_pupil *kd_lesson_pupil(struct kd_lesson *one, const char *key)
{
    const double now = kd_clock_ms();
    struct kd_pupil *at = NULL;
    for (size_t i = 0; i < KD_LESSON_PUPILS; i++) {
        struct kd_pupil *pupil = &one->pupils[i];
        if (!strcmp(pupil->key, key)) {
            pupil->seen_ms = now;
            return pupil;
        }
        if (!is_present(pupil, now) && (!at || goes_before(one, pupil, at)))
            at = pupil;
    }
    if (!at)
        return NULL;
    *at = (struct kd_pupil) { .seen_ms = now };
    snprintf(at->key, sizeof at->key, "%s", key);
    return at;
}

static void add_question(struct kd_json *json, const struct kd_lesson *one, bool teacher)
{
    const struct kd_question *question = &one->question;
    unsigned tally[KD_LESSON_CHOICES] = { 0 }, answered = 0;
    for (size_t i = 0; i < KD_LESSON_PUPILS; i++)
        if (has_answered(one, &one->pupils[i]))
            answered++, tally[one->pupils[i].choice]++;
    kd_json_object(json, "question");
    kd_json_number(json, "number", question->number);
    kd_json_string(json, "text", question->text);
    kd_json_array(json, "choices");
    for (unsigned i = 0; i < question->n_choices; i++)
        kd_json_string(json, NULL, question->choices[i]);
    kd_json_end(json);
    kd_json_bool(json, "open", question->open);
    kd_json_number(json, "answered", answered);
    if (teacher || !question->open) {
        if (question->right < 0)
            kd_json_null(json, "right");
        else
            kd_json_number(json, "right", question->right);
        kd_json_array(json, "tally");
        for (unsigned i = 0; i < question->n_choices; i++)
            kd_json_number(json, NULL, tally[i]);
        kd_json_end(json);
    }
    kd_json_end(json);
}

static void add_choice(struct kd_json *json, const struct kd_lesson *one, const struct kd_pupil *pupil)
{
    if (one->question.shown && has_answered(one, pupil))
        kd_json_number(json, "choice", pupil->choice);
    else
        kd_json_null(json, "choice");
}

/* Writes the pupils who are present, or have answered the question. */
static void add_hands(struct kd_json *json, const struct kd_lesson *one, double now)
{
    kd_json_array(json, "hands");
    for (size_t i = 0; i < KD_LESSON_PUPILS; i++) {
        const struct kd_pupil *pupil = &one->pupils[i];
        if (!is_present(pupil, now) && !has_answered(one, pupil))
            continue;
        kd_json_object(json, NULL);
        kd_json_string(json, "name", pupil->name);
        add_choice(json, one, pupil);
        kd_json_end(json);
    }
    kd_json_end(json);
}

enum kd_status kd_lesson_to_json(const struct kd_lesson *one, const struct kd_lesson_view *view, struct kd_buffer *out)
{
    const double now = kd_clock_ms();
    unsigned present = 0;
    for (size_t i = 0; i < KD_LESSON_PUPILS; i++)
        present += is_present(&one->pupils[i], now);
    struct kd_json json = kd_json_begin(out);
    kd_json_object(&json, NULL);
    kd_json_string(&json, "id", one->id);
    if (view->token)
        kd_json_string(&json, "token", one->token);
    kd_json_string(&json, "session", one->session);
    kd_json_string(&json, "link", one->link);
    kd_json_string(&json, "about", one->about);
    kd_json_string(&json, "lang", one->lang);
    kd_json_number(&json, "pupils", present);
    if (one->question.shown)
        add_question(&json, one, view->teacher);
    else
        kd_json_null(&json, "question");
    if (view->pupil) {
        add_choice(&json, one, view->pupil);
        kd_json_bool(&json, "copies", view->copies);
    }
    if (view->teacher)
        add_hands(&json, one, now);
    kd_json_end(&json);
    return kd_json_finish_line(&json);
}
