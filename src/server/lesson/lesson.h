/* A lesson: pupils follow the session of a teacher and answer the teacher's questions; the server counts pupils and
 * answers. A lesson stores only the id of the session, so that it can continue with another session of the teacher.
 * Lessons exist in memory only. A lesson ends when the teacher ends it, or after some time without a request of the
 * teacher. A caller must hold the lock of the table while it uses a lesson. kd_lessons_sweep takes that lock itself. */
#ifndef KD_SERVER_LESSON_LESSON_H
#define KD_SERVER_LESSON_LESSON_H

#include "base/json.h"
#include "server/http/secret.h"
#include "server/http/shares.h"

#define KD_LESSONS 16u          /* limit of lessons */
#define KD_LESSON_IDLE_S 600u   /* seconds without a request of the teacher after which a lesson ends */
#define KD_LESSON_PUPILS 64u    /* maximum number of pupils of a lesson */
#define KD_LESSON_PRESENT_S 20u /* seconds after a request for which a pupil counts as present */
#define KD_LESSON_CHOICES 6u    /* maximum number of choices of a question; the minimum is two */
/* Maximum lengths of texts, in characters. */
#define KD_LESSON_LINK 8000u
#define KD_LESSON_ABOUT 1000u
#define KD_LESSON_TEXT 600u
#define KD_LESSON_CHOICE 200u
#define KD_LESSON_NAME 80u
#define KD_LESSON_LANG 35u /* maximum length of a language tag */
/* size in bytes of a UTF-8 text with this number of characters, including the NUL */
#define KD_LESSON_SIZE(characters) (4 * (characters) + 1)

struct kd_question {
    unsigned number; /* number of this question in the lesson, from 1 on; 0: there was no question yet */
    bool shown;      /* false if the question was withdrawn */
    bool open;       /* true while answers are accepted; afterwards pupils see the tally and the right choice */
    char text[KD_LESSON_SIZE(KD_LESSON_TEXT)];
    unsigned n_choices;
    char choices[KD_LESSON_CHOICES][KD_LESSON_SIZE(KD_LESSON_CHOICE)];
    int right; /* index of the right choice; -1: no choice is marked as right */
};

struct kd_pupil {
    char key[KD_SECRET_ID]; /* the key that the pupil's page has made; "": the entry is free */
    char name[KD_LESSON_SIZE(KD_LESSON_NAME)];
    double seen_ms;
    unsigned answered; /* number of the question that the pupil has answered with `choice`; 0: none */
    unsigned choice;
};

struct kd_lesson {
    char id[KD_SECRET_ID], token[KD_SECRET_TOKEN], client[KD_CLIENT];
    double used_ms; /* time of the teacher's last request */
    char session[KD_SECRET_ID];
    char link[KD_LESSON_SIZE(KD_LESSON_LINK)];   /* the part after # of the teacher's address */
    char about[KD_LESSON_SIZE(KD_LESSON_ABOUT)]; /* description of the picture */
    char lang[KD_LESSON_LANG + 1];               /* language tag (BCP 47) of the description and the question */
    struct kd_question question;
    struct kd_pupil pupils[KD_LESSON_PUPILS];
};

struct kd_lessons;

/* client_limit: maximum number of lessons of one client. Returns NULL when out of memory. */
struct kd_lessons *kd_lessons_create(unsigned client_limit);
void kd_lessons_destroy(struct kd_lessons *all); /* accepts NULL */
void kd_lessons_lock(struct kd_lessons *all);
void kd_lessons_unlock(struct kd_lessons *all);
/* Ends idle lessons. The reaper calls this, so that the names of pupils are erased when the time of a lesson is
 * over. */
void kd_lessons_sweep(struct kd_lessons *all);

/* Opens a lesson. Returns KD_EBUSY at a limit; *quota is then true if it is the limit of one client. The table `all`
 * owns the lesson; the pointer is valid until the next call of a function of this file. */
enum kd_status kd_lesson_open(struct kd_lessons *all, const char *client, bool *quota, struct kd_lesson **out,
                              struct kd_error *error);
/* Finds a lesson. Returns NULL if there is none, or if it has ended. */
struct kd_lesson *kd_lesson_find(struct kd_lessons *all, const char *id);
void kd_lesson_end(struct kd_lessons *all, struct kd_lesson *one);

/* Finds the pupil with this key, or adds one, and marks the pupil as present. If all entries are taken, a pupil who
 * is absent is replaced: first those without an answer to the present question, and of these the one who was absent
 * longest. Returns NULL if all are present. */
struct kd_pupil *kd_lesson_pupil(struct kd_lesson *one, const char *key);

/* Options for writing a lesson as JSON. teacher: each pupil's choice is included, and so is the tally, even while the
 * question is open. pupil: the pupil who has sent the request and whose own choice is included; NULL: none. copies:
 * true if the pupil may open a session of his or her own. token: the teacher's token is included. */
struct kd_lesson_view {
    bool teacher, token, copies;
    const struct kd_pupil *pupil;
};
enum kd_status kd_lesson_to_json(const struct kd_lesson *one, const struct kd_lesson_view *view, struct kd_buffer *out);

/* A change to a lesson by its teacher. A member that the document lacks is NULL or false. */
struct kd_lesson_change {
    const char *session, *link, *about, *lang; /* pointers into the document */
    /* asks: true if the document has "question"; withdraws: true if its value is null */
    bool asks, withdraws;
    struct kd_question question;
    bool moves, open; /* moves: true if the document has "open"; open: the value of "open" */
};
/* A pupil's answer. */
struct kd_hand {
    const char *pupil, *name; /* name is NULL if the document has no name */
    bool answers;
    unsigned question, choice;
};
struct cJSON;
enum kd_status kd_lesson_read_change(const struct cJSON *tree, struct kd_lesson_change *out, struct kd_error *error);
enum kd_status kd_lesson_read_hand(const struct cJSON *tree, struct kd_hand *out, struct kd_error *error);
void kd_lesson_apply(struct kd_lesson *one, const struct kd_lesson_change *change);

#endif
