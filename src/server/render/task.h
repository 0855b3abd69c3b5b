/* A task is work that workers do for a request (http/task_scheduler.h). In the meantime the request is suspended.
 * The task is cancelled if the client disconnects, if the server stops at once, or if the task's deadline passes.
 * The request owns the task, which is embedded in a struct of the caller.
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
    void (*last)(struct kd_task *task); /* called on a worker after the last slice; may be NULL */
    /* Answers the request, for handlers with several kinds of tasks; otherwise NULL. Runs on the HTTP thread. */
    enum MHD_Result (*answer)(struct kd_request *request);
};

struct kd_task {
    struct kd_scheduler_job scheduled; /* must be first: callbacks cast its address to this struct */
    const struct kd_task_kind *kind;
    struct kd_scheduler *queue;
    struct kd_request *request;
    size_t held; /* number of bytes that kd_task_hold has reserved; they are released with the task */
    bool quota;  /* true if KD_EBUSY is due to the client's share */
    double submitted_ms, begun_ms, done_ms, deadline_ms;
    _Atomic enum kd_status status; /* for KD_ECANCELLED, the handler must answer with kd_reply_cancelled */
    struct kd_error error;
};

/* Makes a task if the queue admits one; otherwise returns NULL with *refused. All members of the struct after the
 * task are zero. HTTP thread. */
void *kd_task_begin(struct kd_request *request, struct kd_scheduler *queue, const struct kd_task_kind *kind,
                    enum MHD_Result *refused);
/* Makes a task without admission. If the task turns out to take long, the caller calls kd_task_admit later. HTTP
 * thread. */
void *kd_task_create(struct kd_request *request, struct kd_scheduler *queue, const struct kd_task_kind *kind,
                     enum MHD_Result *refused);
void kd_task_destroy(struct kd_task *task); /* accepts NULL */

/* Records an error of the task. Only the first error counts; KD_OK is ignored. Any thread. */
void kd_task_fail(struct kd_task *task, enum kd_status status, const struct kd_error *error);

/* True if the queue admits another task. If not, *refused is the result for the handler. what: see struct
 * kd_task_kind. HTTP thread. */
bool kd_task_admit(struct kd_request *request, struct kd_scheduler *queue, const char *what, enum MHD_Result *refused);
/* Starts a task that the queue has admitted. HTTP thread. */
enum MHD_Result kd_task_submit(struct kd_task *task);

/* Returns the reason why a task must end: the client is `gone`, the server is stopping, or the deadline has passed.
 * Returns KD_OK if the task may continue. Any thread. */
enum kd_status kd_task_over(struct kd_server *server, struct kd_scheduler *queue, bool gone, double deadline_ms,
                            struct kd_error *error);
/* Reserves bytes of an answer in server->replies. The owner of *held must release them. Returns KD_EBUSY at a limit;
 * *quota is then true if it is the client's share. Any thread. */
enum kd_status kd_task_hold(struct kd_server *server, const char *client, size_t bytes, size_t *held, bool *quota,
                            struct kd_error *error);
/* Frees the body of the request. This is safe on a worker, because nobody else uses a suspended request. */
void kd_task_drop_body(struct kd_request *request);

#endif
