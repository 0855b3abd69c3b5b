/* Jobs on disk. DIRECTORY/ID/ holds request.json as it was received, job.json, and the frames: 000000.png and so on,
 * whether pictures or not. Each file is written atomically. A folder with our job.json but without a request is the
 * rest of a deleted job. Other files, and those that cannot be read, are left alone; links are never followed. Any
 * thread, but one for each job.
 *
 * Errors name no path, because clients see them. KD_EFULL and KD_ENOMEM (also for descriptors) may pass. */
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
    double created, ended; /* seconds since 1970; ended: 0 until then */
    unsigned attempts; /* times a server has gone on with it since its latest frame and ended otherwise than by being
                          told to */
    double exposure;   /* of all frames, as it was measured; NAN: it was not, or not yet */
    unsigned traced;   /* lens maps, so far */
    unsigned frames;   /* that the request asks for; 0 in records of versions that did not say */
    const struct kd_series *series; /* that they make */
    struct kd_once once;            /* what it was asked for by */
    char preset[32];                /* that its scenes are merged over; "": none */
    char error[480];                /* of a failed job */
};

struct kd_job_store;
enum { KD_JOB_MARK = 65 };

/* state: NULL for a new folder in TMPDIR that goes with the store; else a folder that nobody else uses, made if it
 * is not there: KD_EIO says what is wrong with it, with its path. */
enum kd_status kd_job_store_open(const char *state, struct kd_job_store **out, struct kd_error *error);
void kd_job_store_close(struct kd_job_store *store); /* accepts NULL */
/* Removes the folders in TMPDIR of servers that were killed. */
void kd_job_store_tidy(void);

/* Each job that the store holds, those without attempts first, then oldest first; what cannot be read is logged. The
 * request is the callback's to keep or free. */
enum kd_status kd_job_store_load(struct kd_job_store *store,
                                 void (*found)(void *user, const struct kd_job_record *record,
                                               struct kd_buffer *request),
                                 void *user, struct kd_error *error);

enum kd_status kd_job_store_create(struct kd_job_store *store, const struct kd_job_record *record, const void *request,
                                   size_t size, struct kd_error *error);
/* Reads its request. KD_EIO, KD_ENOMEM. */
enum kd_status kd_job_store_request(const struct kd_job_store *store, const char *id, struct kd_buffer *out,
                                    struct kd_error *error);
enum kd_status kd_job_store_update(struct kd_job_store *store, const struct kd_job_record *record,
                                   struct kd_error *error);
/* Makes a job unknown after a restart; kd_job_store_remove then removes its files, at most so many, and says whether
 * all are gone. */
void kd_job_store_forget(struct kd_job_store *store, const char *id);
bool kd_job_store_remove(struct kd_job_store *store, const char *id, unsigned most);

enum kd_status kd_job_store_put(struct kd_job_store *store, const char *id, unsigned frame, const struct kd_buffer *png,
                                struct kd_error *error);
/* A file of a job, open to be read. */
struct kd_job_file {
    int fd; /* the caller's to close */
    uint64_t size;
    char mark[KD_JOB_MARK]; /* of these bytes: other ones under its name have another. Of a film it is their SHA-256 */
};
/* Opens a finished frame; false: it is not there. */
bool kd_job_store_get(const struct kd_job_store *store, const char *id, unsigned frame, struct kd_job_file *out);

/* A job's folder, for films.c, which keeps films there: a descriptor, -1 with errno. */
int kd_job_store_folder(const struct kd_job_store *store, const char *id);
/* Opens a file there; false: it is not there. */
bool kd_job_store_open_file(int folder, const char *name, struct kd_job_file *out);
/* Makes an error for a client, without a path, of what has failed with errno. */
enum kd_status kd_job_store_failed(struct kd_error *error, const char *what);

#endif
