/* Jobs on disk. DIRECTORY/ID/ contains request.json (as it was received), job.json (the record), and the frames as
 * 000000.png and so on, whatever their format. Each file is written atomically. A folder with job.json but without
 * request.json belongs to a deleted job. Files with other names and unreadable files are left alone. Links are never
 * followed. Any thread, but only one at a time for each job.
 *
 * Errors contain no path, because clients see them. KD_EFULL and KD_ENOMEM (also if descriptors run out) may be
 * temporary. */
#ifndef KD_SERVER_JOB_STORE_H
#define KD_SERVER_JOB_STORE_H

#include "base/buffer.h"
#include "render/output/series.h"
#include "server/http/once.h"
#include "server/http/secret.h"

#include <stdbool.h>
#include <stdint.h>

enum kd_job_state { KD_JOB_ACTIVE, KD_JOB_DONE, KD_JOB_FAILED };

struct kd_job_record {
    char id[KD_SECRET_ID], token[KD_SECRET_TOKEN];
    enum kd_job_state state;
    double created, ended; /* times in seconds since 1970; ended is 0 while the job is active */
    /* number of servers that have crashed after beginning work on the job, since its latest new frame; an ordinary
     * shutdown does not count */
    unsigned attempts;
    /* measured common exposure of the frames, in stops; NAN: there is none, or it is not measured yet */
    double exposure;
    unsigned traced;                /* number of lens maps that were traced */
    unsigned frames;                /* number of frames that the request has; 0 in records of older versions */
    const struct kd_series *series; /* kind of result */
    struct kd_once once;            /* hashes of the job's Idempotency-Key and request */
    char preset[32];                /* the preset onto which the job's scenes are merged; "" if there is none */
    char error[480];                /* the message, if the job has failed */
};

struct kd_job_store;
enum { KD_JOB_MARK = 65 };

/* Opens a store. If `state` is NULL, the store is a temporary folder in TMPDIR, which is deleted with the store.
 * Otherwise `state` is a folder, which is created if needed; no other server may use it. Returns KD_EIO with a
 * message that contains the folder's path. */
enum kd_status kd_job_store_open(const char *state, struct kd_job_store **out, struct kd_error *error);
void kd_job_store_close(struct kd_job_store *store); /* accepts NULL */
/* Removes the temporary folders that killed servers have left in TMPDIR. */
void kd_job_store_tidy(void);

/* Calls `found` for each job, sorted by the number of attempts, fewest first; jobs with the same number are sorted
 * by age, oldest first. Unreadable jobs are logged. The callback becomes the owner of the request. */
enum kd_status kd_job_store_load(struct kd_job_store *store,
                                 void (*found)(void *user, const struct kd_job_record *record,
                                               struct kd_buffer *request),
                                 void *user, struct kd_error *error);

enum kd_status kd_job_store_create(struct kd_job_store *store, const struct kd_job_record *record, const void *request,
                                   size_t size, struct kd_error *error);
/* Reads a job's request. Errors: KD_EIO, KD_ENOMEM. */
enum kd_status kd_job_store_request(const struct kd_job_store *store, const char *id, struct kd_buffer *out,
                                    struct kd_error *error);
enum kd_status kd_job_store_update(struct kd_job_store *store, const struct kd_job_record *record,
                                   struct kd_error *error);
/* kd_job_store_forget removes the request of a job, so that the job is not found after a restart.
 * kd_job_store_remove then deletes at most `most` of the job's files, and returns true when all are deleted. */
void kd_job_store_forget(struct kd_job_store *store, const char *id);
bool kd_job_store_remove(struct kd_job_store *store, const char *id, unsigned most);

enum kd_status kd_job_store_put(struct kd_job_store *store, const char *id, unsigned frame, const struct kd_buffer *png,
                                struct kd_error *error);
/* A file of a job, opened for reading. */
struct kd_job_file {
    int fd; /* a descriptor that the caller closes */
    uint64_t size;
    /* a text that changes whenever the bytes change; for a film, the SHA-256 of the bytes */
    char mark[KD_JOB_MARK];
};
/* Opens the file of a finished frame. Returns false if the file does not exist. */
bool kd_job_store_get(const struct kd_job_store *store, const char *id, unsigned frame, struct kd_job_file *out);

/* Opens a job's folder for films.c. Returns a descriptor, or -1 with errno. */
int kd_job_store_folder(const struct kd_job_store *store, const char *id);
/* Opens a file in a job's folder. Returns false if the file does not exist. */
bool kd_job_store_open_file(int folder, const char *name, struct kd_job_file *out);
/* Makes an error for clients from errno. Its message contains no path. */
enum kd_status kd_job_store_failed(struct kd_error *error, const char *what);

#endif
