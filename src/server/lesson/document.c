/* Reads the documents that change a lesson. */
#include "base/utf8.h"
#include "document/document.h"
#include "document/text.h"
#include "document/tree.h"
#include "server/lesson/lesson.h"

#include <stdio.h>
#include <string.h>

/* The struct into which a document is read. Each reader sets one member. */
struct target {
    struct kd_lesson_change *change;
    struct kd_hand *hand;
    unsigned given; /* one bit for each member that was given, in the order of the members' table */
};
typedef enum kd_status reader(struct target *to, const cJSON *item, const char *pointer, struct kd_error *error);
struct member {
    const char *name;
    reader *read;
};
enum { MEMBERS = 8 }; /* maximum number of members of an object */

/* Converts a JSON pointer to a name for messages: /question/choices/1 becomes question.choices.1. */
static void field_name(char *name, size_t size, const char *pointer)
{
    snprintf(name, size, "%s", pointer + 1);
    for (char *at = name; (at = strchr(at, '/'));)
        *at++ = '.';
}

static enum kd_status refuse(const cJSON *item, const char *pointer, const char *must, struct kd_error *error)
{
    char given[KD_VALUE_SIZE];
    const struct kd_value value = kd_tree_value(item);
    kd_value_describe(&value, given);
    char name[sizeof error->pointer];
    field_name(name, sizeof name, pointer);
    return kd_error_field(error, pointer, "%s is %s; it must be %s", name, given, must);
}

/* Reads a text of 1 to `most` characters (0 to `most` if `empty` is true) without control characters. */
static enum kd_status read_text(const cJSON *item, const char *pointer, size_t most, bool empty, const char **out,
                                struct kd_error *error)
{
    const char *text = cJSON_IsString(item) ? item->valuestring : NULL;
    const size_t length = text ? strlen(text) : 0;
    char must[80];
    snprintf(must, sizeof must, "a text of %d to %zu characters without control characters", !empty, most);
    bool good = text && (length || empty) && kd_utf8_valid(text);
    size_t characters = 0;
    for (size_t i = 0, n; good && i < length; i += n) {
        n = kd_utf8_sequence(text + i, length - i);
        good = n && !kd_utf8_is_control(text + i, n) && ++characters <= most;
    }
    *out = text;
    return good ? KD_OK : refuse(item, pointer, must, error);
}

static enum kd_status copy_text(const cJSON *item, const char *pointer, size_t size, char *out, struct kd_error *error)
{
    const char *text;
    const enum kd_status status = read_text(item, pointer, (size - 1) / 4, false, &text, error);
    if (!status)
        snprintf(out, size, "%s", text);
    return status;
}

static enum kd_status read_whole(const cJSON *item, const char *pointer, double least, double most, unsigned *out,
                                 struct kd_error *error)
{
    char must[60];
    snprintf(must, sizeof must, "a whole number from %.0f to %.0f", least, most);
    if (!cJSON_IsNumber(item) || !(item->valuedouble >= least && item->valuedouble <= most) ||
        item->valuedouble != (double)(unsigned)item->valuedouble)
        return refuse(item, pointer, must, error);
    *out = (unsigned)item->valuedouble;
    return KD_OK;
}

/* Reads an id of 16 hexadecimal digits. */
static enum kd_status read_id(const cJSON *item, const char *pointer, const char **out, struct kd_error *error)
{
    *out = cJSON_IsString(item) ? item->valuestring : NULL;
    return *out && strlen(*out) == KD_SECRET_ID - 1 && strspn(*out, "0123456789abcdef") == KD_SECRET_ID - 1
               ? KD_OK
               : refuse(item, pointer, "16 hexadecimal digits", error);
}

/* Reads the members of an object. */
static enum kd_status read_members(const cJSON *object, const char *pointer, const struct member *members, size_t n,
                                   struct target *to, struct kd_error *error)
{
    const cJSON *items[MEMBERS] = { NULL };
    struct kd_row rows[MEMBERS];
    uint64_t given = 0;
    for (size_t i = 0; i < n; i++)
        rows[i] = (struct kd_row) { .name = members[i].name, .kind = KD_KIND_JSON, .offset = i * sizeof *items };
    const struct kd_document document = { .rows = rows, .n = n };
    enum kd_status status = kd_document_read(&document, items, object, pointer, &given, error);
    to->given = (unsigned)given;
    for (size_t i = 0; i < n && !status; i++) {
        char at[sizeof error->pointer];
        snprintf(at, sizeof at, "%.80s/%s", pointer, members[i].name);
        if (items[i])
            status = members[i].read(to, items[i], at, error);
    }
    return status;
}

static enum kd_status read_session(struct target *to, const cJSON *item, const char *pointer, struct kd_error *error)
{
    return read_id(item, pointer, &to->change->session, error);
}

static enum kd_status read_link(struct target *to, const cJSON *item, const char *pointer, struct kd_error *error)
{
    return read_text(item, pointer, KD_LESSON_LINK, true, &to->change->link, error);
}

static enum kd_status read_about(struct target *to, const cJSON *item, const char *pointer, struct kd_error *error)
{
    return read_text(item, pointer, KD_LESSON_ABOUT, true, &to->change->about, error);
}

/* Reads a language tag as in BCP 47. Its parts are separated by hyphens, and have up to 8 letters and digits. The
 * first part has letters only. */
static enum kd_status read_lang(struct target *to, const cJSON *item, const char *pointer, struct kd_error *error)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
    const char *text = cJSON_IsString(item) ? item->valuestring : "";
    size_t n = strspn(text, letters), part = n;
    bool good = n >= 2 && n <= 8 && strlen(text) <= KD_LESSON_LANG;
    for (; good && text[n] == '-'; n += part) {
        part = strspn(text + ++n, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789");
        good = part >= 1 && part <= 8;
    }
    to->change->lang = text;
    return good && !text[n] ? KD_OK : refuse(item, pointer, "a language tag, such as en or pt-BR", error);
}

static enum kd_status read_open(struct target *to, const cJSON *item, const char *pointer, struct kd_error *error)
{
    to->change->moves = true;
    to->change->open = cJSON_IsTrue(item);
    return cJSON_IsBool(item) ? KD_OK : refuse(item, pointer, "true or false", error);
}

static enum kd_status read_words(struct target *to, const cJSON *item, const char *pointer, struct kd_error *error)
{
    return copy_text(item, pointer, sizeof to->change->question.text, to->change->question.text, error);
}

static enum kd_status read_choices(struct target *to, const cJSON *item, const char *pointer, struct kd_error *error)
{
    struct kd_question *question = &to->change->question;
    const int n = cJSON_IsArray(item) ? cJSON_GetArraySize(item) : 0;
    if (n < 2 || n > (int)KD_LESSON_CHOICES)
        return refuse(item, pointer, "a list of 2 to 6 choices", error);
    question->n_choices = (unsigned)n;
    for (int i = 0; i < n; i++) {
        char at[sizeof error->pointer], index[12];
        snprintf(at, sizeof at, "%s", pointer);
        snprintf(index, sizeof index, "%d", i);
        kd_text_pointer(at, sizeof at, index);
        const enum kd_status status =
            copy_text(cJSON_GetArrayItem(item, i), at, sizeof question->choices[i], question->choices[i], error);
        if (status)
            return status;
    }
    return KD_OK;
}

static enum kd_status read_right(struct target *to, const cJSON *item, const char *pointer, struct kd_error *error)
{
    unsigned right = 0;
    if (cJSON_IsNull(item))
        return KD_OK;
    const enum kd_status status = read_whole(item, pointer, 0, KD_LESSON_CHOICES - 1, &right, error);
    if (!status)
        to->change->question.right = (int)right;
    return status;
}

static enum kd_status read_question(struct target *to, const cJSON *item, const char *pointer, struct kd_error *error)
{
    static const struct member members[] = { { "text", read_words },
                                             { "choices", read_choices },
                                             { "right", read_right } };
    struct kd_lesson_change *change = to->change;
    const unsigned given = to->given;
    enum kd_status status;
    change->withdraws = cJSON_IsNull(item);
    if (change->withdraws)
        return KD_OK;
    if (!cJSON_IsObject(item))
        return refuse(item, pointer, "an object with text and choices, or null", error);
    change->asks = true;
    change->question = (struct kd_question) { .right = -1 };
    KD_TRY(read_members(item, pointer, members, sizeof members / sizeof *members, to, error));
    if ((to->given & 3) != 3)
        KD_TRY(to->given & 1
                   ? kd_error_field(error, pointer, "question.choices is missing; it must be a list of 2 to 6 choices")
                   : kd_error_field(error, pointer, "question.text is missing; it must be a text"));
    if (change->question.right >= (int)change->question.n_choices)
        KD_TRY(kd_error_field(error, "/question/right",
                              "question.right is %d; it must be 0 to %u, the number of a choice",
                              change->question.right, change->question.n_choices - 1));
    to->given = given;
done:
    return status;
}

enum kd_status kd_lesson_read_change(const cJSON *tree, struct kd_lesson_change *out, struct kd_error *error)
{
    static const struct member members[] = { { "session", read_session },   { "link", read_link },
                                             { "about", read_about },       { "lang", read_lang },
                                             { "question", read_question }, { "open", read_open } };
    struct target to = { .change = out };
    *out = (struct kd_lesson_change) { 0 };
    return read_members(tree, "", members, sizeof members / sizeof *members, &to, error);
}

void kd_lesson_apply(struct kd_lesson *one, const struct kd_lesson_change *change)
{
    if (change->session)
        snprintf(one->session, sizeof one->session, "%s", change->session);
    if (change->link)
        snprintf(one->link, sizeof one->link, "%s", change->link);
    if (change->about)
        snprintf(one->about, sizeof one->about, "%s", change->about);
    if (change->lang)
        snprintf(one->lang, sizeof one->lang, "%s", change->lang);
    if (change->withdraws)
        one->question.shown = one->question.open = false;
    if (change->asks) {
        const unsigned number = one->question.number + 1;
        one->question = change->question;
        one->question.number = number;
        one->question.shown = one->question.open = true;
    }
    if (change->moves)
        one->question.open = change->open && one->question.shown;
}

static enum kd_status read_pupil(struct target *to, const cJSON *item, const char *pointer, struct kd_error *error)
{
    return read_id(item, pointer, &to->hand->pupil, error);
}

static enum kd_status read_name(struct target *to, const cJSON *item, const char *pointer, struct kd_error *error)
{
    return read_text(item, pointer, KD_LESSON_NAME, true, &to->hand->name, error);
}

static enum kd_status read_number(struct target *to, const cJSON *item, const char *pointer, struct kd_error *error)
{
    return read_whole(item, pointer, 1, 1e9, &to->hand->question, error);
}

static enum kd_status read_choice(struct target *to, const cJSON *item, const char *pointer, struct kd_error *error)
{
    return read_whole(item, pointer, 0, KD_LESSON_CHOICES - 1, &to->hand->choice, error);
}

enum kd_status kd_lesson_read_hand(const cJSON *tree, struct kd_hand *out, struct kd_error *error)
{
    static const struct member members[] = {
        { "pupil", read_pupil }, { "name", read_name }, { "question", read_number }, { "choice", read_choice }
    };
    struct target to = { .hand = out };
    enum kd_status status;
    *out = (struct kd_hand) { 0 };
    KD_TRY(read_members(tree, "", members, sizeof members / sizeof *members, &to, error));
    if (!(to.given & 1))
        KD_TRY(kd_error_field(error, "/pupil", "pupil is missing; it must be 16 hexadecimal digits"));
    out->answers = to.given & 8;
    if (!(to.given & 4) != !(to.given & 8))
        KD_TRY(kd_error_field(error, to.given & 8 ? "/question" : "/choice",
                              "question and choice must be given together"));
done:
    return status;
}
