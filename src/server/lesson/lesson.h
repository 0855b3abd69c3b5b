/* A lesson: pupils follow the session of a teacher and answer the teacher's questions; the server counts pupils and
 * answers. A lesson stores only the id of the session, so it continues when the teacher opens another session. It is
 * kept in memory only. It ends when the teacher ends it, or after a while without a request of the teacher. A caller
 * holds the lock of the table as long as it uses a lesson. kd_lessons_sweep takes that lock itself. */
#ifndef KD_SERVER_LESSON_LESSON_H
#define KD_SERVER_LESSON_LESSON_H

#include "base/json.h"
#include "server/http/secret.h"
#include "server/http/shares.h"

#define KD_LESSONS 16u          /* limit of lessons */
#define KD_LESSON_IDLE_S 600u   /* a lesson ends after this time without a request of its teacher */
#define KD_LESSON_PUPILS 64u    /* limit of pupils of one lesson */
#define KD_LESSON_PRESENT_S 20u /* a pupil counts as present for this time after a request */
#define KD_LESSON_CHOICES 6u    /* largest number of choices of a question; the smallest is two */
/* Limits of texts, in characters. */
#define KD_LESSON_LINK 8000u
#define KD_LESSON_ABOUT 1000u
#define KD_LESSON_TEXT 600u
#define KD_LESSON_CHOICE 200u
#define KD_LESSON_NAME 80u
#define KD_LESSON_LANG 35u                                /* largest length of a language tag */
#define KD_LESSON_SIZE(characters) (4 * (characters) + 1) /* bytes of UTF-8, including the NUL */

struct kd_question {
    unsigned number; /* number of this question within the lesson, from 1; 0: no question has been asked */
    bool shown;      /* false: the question was withdrawn */
    bool open;       /* answers are accepted; when this ends, pupils see the tally and the right choice */
    char text[KD_LESSON_SIZE(KD_LESSON_TEXT)];
    unsigned n_choices;
    char choices[KD_LESSON_CHOICES][KD_LESSON_SIZE(KD_LESSON_CHOICE)];
    int right; /* index of the right choice; -1: none is marked */
};

struct kd_pupil {
    char key[KD_SECRET_ID]; /* key that the pupil's page has made; "": the place is free */
    char name[KD_LESSON_SIZE(KD_LESSON_NAME)];
    double seen_ms;
    unsigned answered; /* number of the question that `choice` answers; 0: none */
    unsigned choice;
};

struct kd_lesson {
    char id[KD_SECRET_ID], token[KD_SECRET_TOKEN], client[KD_CLIENT];
    double used_ms; /* time of the teacher's last request */
    char session[KD_SECRET_ID];
    char link[KD_LESSON_SIZE(KD_LESSON_LINK)];   /* the part after # in the teacher's address */
    char about[KD_LESSON_SIZE(KD_LESSON_ABOUT)]; /* description of the picture */
    char lang[KD_LESSON_LANG + 1];               /* language of description and question, a tag of BCP 47 */
    struct kd_question question;
    struct kd_pupil pupils[KD_LESSON_PUPILS];
};

struct kd_lessons;

/* client_limit: limit of the lessons of one client. Returns NULL when out of memory. */
struct kd_lessons *kd_lessons_create(unsigned client_limit);
void kd_lessons_destroy(struct kd_lessons *all); /* accepts NULL */
void kd_lessons_lock(struct kd_lessons *all);
void kd_lessons_unlock(struct kd_lessons *all);
/* Ends the lessons that are idle. The reaper calls this, so that names of pupils are erased when the lesson's time
 * is over. */
void kd_lessons_sweep(struct kd_lessons *all);

/* Opens a lesson. Returns KD_EBUSY at a limit; *quota is true if that is the limit of one client. The lesson belongs to
 * `all`; the pointer is valid until the next call of a function here. */
enum kd_status kd_lesson_open(struct kd_lessons *all, const char *client, bool *quota, struct kd_lesson **out,
                              struct kd_error *error);
/* Finds a lesson; NULL: there is none, or it has ended. */
struct kd_lesson *kd_lesson_find(struct kd_lessons *all, const char *id);
void kd_lesson_end(struct kd_lessons *all, struct kd_lesson *one);

/* Finds or adds the pupil of this key, and marks it as present. If all places are taken, a pupil that is away is
 * replaced. Pupils without an answer to the present question are replaced first, and among them the one that has
 * been away longest. Returns NULL if all are present. */
struct kd_pupil *kd_lesson_pupil(struct kd_lesson *one, const char *key);

/* Writes the lesson as JSON. teacher: include each pupil's choice, and the tally even while the question is open.
 * pupil: the pupil that sent the request, whose own choice is included; NULL: none. copies: whether the pupil may
 * open a session of its own. token: include the teacher's token. */
struct kd_lesson_view {
    bool teacher, token, copies;
    const struct kd_pupil *pupil;
};
enum kd_status kd_lesson_to_json(const struct kd_lesson *one, const struct kd_lesson_view *view, struct kd_buffer *out);

/* A change of a lesson by its teacher. A member that is absent in the document is NULL or false. */
struct kd_lesson_change {
    const char *session, *link, *about, *lang; /* point into the document */
    /* asks: the document has "question"; withdraws: the value of "question" is null */
    bool asks, withdraws;
    struct kd_question question;
    bool moves, open; /* moves: the document has "open"; open: the value of "open" */
};
/* An answer of a pupil. */
struct kd_hand {
    const char *pupil, *name; /* name NULL: the document has no name */
    bool answers;
    unsigned question, choice;
};
struct cJSON;
enum kd_status kd_lesson_read_change(const struct cJSON *tree, struct kd_lesson_change *out, struct kd_error *error);
enum kd_status kd_lesson_read_hand(const struct cJSON *tree, struct kd_hand *out, struct kd_error *error);
void kd_lesson_apply(struct kd_lesson *one, const struct kd_lesson_change *change);

#endif
