/* Task: work that the workers do for a request (http/task_scheduler.h). Meanwhile the request is suspended. The task is
 * cancelled when the client disconnects, the server stops at once, or the task's deadline has passed. The request owns
 * the task, which is embedded in a struct of the caller.
 *
 *     static const struct kd_task_kind KIND = { "quantities", sizeof(struct mine), work, finish };
 *     struct mine *mine = kd_task_begin(request, queue, &KIND, &refused);
 *     return mine ? kd_task_submit(&mine->task) : refused;
 *
 * The handler is called again when `work` has returned KD_SLICE_LAST. */
#ifndef KD_SERVER_RENDER_TASK_H
#define KD_SERVER_RENDER_TASK_H

#include "server/http/request.h"

struct kd_task;

struct kd_task_kind {
    const char *what; /* plural noun for messages, such as "quantities" in "the server ... takes no new quantities" */
    size_t size;      /* size of the struct whose first member is the task */
    enum kd_slice_result (*work)(struct kd_task *task, double until_ms); /* runs one slice on a worker */
    void (*finish)(struct kd_task *task);                                /* frees members of the struct; may be NULL */
    void (*last)(struct kd_task *task); /* last call on a worker, after the last slice; may be NULL */
    /* Used by handlers with several kinds of tasks to answer the request; else NULL. Runs on the HTTP thread. */
    enum MHD_Result (*answer)(struct kd_request *request);
};

struct kd_task {
    struct kd_scheduler_job scheduled; /* must be the first member */
    const struct kd_task_kind *kind;
    struct kd_scheduler *queue;
    struct kd_request *request;
    size_t held; /* bytes reserved by kd_task_hold; they are released with the task */
    bool quota;  /* the limit that caused KD_EBUSY is the client's share */
    double submitted_ms, begun_ms, done_ms, deadline_ms;
    _Atomic enum kd_status status; /* KD_ECANCELLED: the handler must answer with kd_reply_cancelled */
    struct kd_error error;
};

/* Makes a task if the queue admits one; otherwise returns NULL with *refused. Members of the struct behind the task
 * are zero. HTTP thread. */
void *kd_task_begin(struct kd_request *request, struct kd_scheduler *queue, const struct kd_task_kind *kind,
                    enum MHD_Result *refused);
/* Makes a task that is not admitted yet. The caller calls kd_task_admit later, if the task turns out to take long.
 * HTTP thread. */
void *kd_task_create(struct kd_request *request, struct kd_scheduler *queue, const struct kd_task_kind *kind,
                     enum MHD_Result *refused);
void kd_task_destroy(struct kd_task *task); /* accepts NULL */

/* Records an error of the task. Only the first error counts; KD_OK is ignored. Any thread. */
void kd_task_fail(struct kd_task *task, enum kd_status status, const struct kd_error *error);

/* True if the queue admits another task. If it does not, *refused is the answer to the request. what: see
 * kd_task_kind. HTTP thread. */
bool kd_task_admit(struct kd_request *request, struct kd_scheduler *queue, const char *what, enum MHD_Result *refused);
/* Starts a task that the queue has admitted. HTTP thread. */
enum MHD_Result kd_task_submit(struct kd_task *task);

/* Returns the reason why a task must end: the client is `gone`, the server is stopping, or the deadline has passed.
 * Returns KD_OK if the task may continue. Any thread. */
enum kd_status kd_task_over(struct kd_server *server, struct kd_scheduler *queue, bool gone, double deadline_ms,
                            struct kd_error *error);
/* Reserves bytes of an answer in server->replies. The owner of *held releases them. Returns KD_EBUSY at a limit;
 * *quota is true if that limit is the client's share. Any thread. */
enum kd_status kd_task_hold(struct kd_server *server, const char *client, size_t bytes, size_t *held, bool *quota,
                            struct kd_error *error);
/* Frees the request's body. Safe on a worker, because a suspended request has no other user. */
void kd_task_drop_body(struct kd_request *request);

#endif
