/* A request that the workers answer (http/turns.h). It is suspended meanwhile, and cancelled when its client leaves,
 * the server stops at once, or its time is up. It belongs to its request and is freed with it; embed it in a struct.
 *
 *     static const struct kd_task_kind KIND = { "quantities", sizeof(struct mine), work, finish };
 *     struct mine *mine = kd_task_begin(request, queue, &KIND, &refused);
 *     return mine ? kd_task_submit(&mine->task) : refused;
 *     the handler is called again when `work` has returned KD_TURN_LAST */
#ifndef KD_SERVER_RENDER_TASK_H
#define KD_SERVER_RENDER_TASK_H

#include "server/http/request.h"

struct kd_task;

struct kd_task_kind {
    const char *what; /* in the plural: "the server ... takes no new <what>" */
    size_t size;      /* of what embeds the task as its first member */
    enum kd_turn_end (*work)(struct kd_task *task, double until_ms); /* a piece, on a worker */
    void (*finish)(struct kd_task *task);                            /* frees what its members hold; may be NULL */
    void (*last)(struct kd_task *task);                    /* may be NULL; on a worker, after the last piece */
    enum MHD_Result (*answer)(struct kd_request *request); /* for a handler that has tasks of several kinds: NULL
                                                              without; on the HTTP thread */
};

struct kd_task {
    struct kd_turns_job turns; /* first */
    const struct kd_task_kind *kind;
    struct kd_turns *queue;
    struct kd_request *request;
    size_t held; /* of kd_task_hold, given back with the task */
    bool quota;  /* KD_EBUSY because its client has its share */
    double submitted_ms, begun_ms, done_ms, deadline_ms;
    _Atomic enum kd_status status; /* KD_ECANCELLED: kd_reply_cancelled */
    struct kd_error error;
};

/* One that the queue admits; NULL: the client has been told why not, *refused. What follows the task is zero. HTTP
 * thread. */
void *kd_task_begin(struct kd_request *request, struct kd_turns *queue, const struct kd_task_kind *kind,
                    enum MHD_Result *refused);
/* One that need not be admitted, unless it turns out to be long: kd_task_admit. HTTP thread. */
void *kd_task_create(struct kd_request *request, struct kd_turns *queue, const struct kd_task_kind *kind,
                     enum MHD_Result *refused);
void kd_task_destroy(struct kd_task *task); /* accepts NULL */

/* The first one counts; status KD_OK does not. Any thread. */
void kd_task_fail(struct kd_task *task, enum kd_status status, const struct kd_error *error);

/* Whether one more may begin; else the client has been told why not. what: as in kd_task_kind. HTTP thread. */
bool kd_task_admit(struct kd_request *request, struct kd_turns *queue, const char *what, enum MHD_Result *refused);
/* HTTP thread, once it is admitted. */
enum MHD_Result kd_task_submit(struct kd_task *task);

/* Why one must end now whose client may have gone, and which may go on until then; KD_OK: it need not. Any thread. */
enum kd_status kd_task_over(struct kd_server *server, struct kd_turns *queue, bool gone, double deadline_ms,
                            struct kd_error *error);
/* Count bytes of an answer as held, to be given back to server->replies by whoever holds them; KD_EBUSY: too many
 * are, with *quota of this client. Any thread. */
enum kd_status kd_task_hold(struct kd_server *server, const char *client, size_t bytes, size_t *held, bool *quota,
                            struct kd_error *error);
/* The body is not needed any more. While the request is suspended it is nobody else's. */
void kd_task_drop_body(struct kd_request *request);

#endif
