/* Films of a job's frames, cached in the job's folder. Each film is encoded once and deleted with the job. Its size
 * counts towards the limit of the frames. Any thread.
 *
 * A request first tries to open the film. If it does not exist yet, one request claims the job, encodes the film,
 * and releases the claim, even on failure. All other requests retry a little later. */
#ifndef KD_SERVER_JOB_FILMS_H
#define KD_SERVER_JOB_FILMS_H

#include "base/replace.h"
#include "server/job/folder.h"
#include "server/job/store.h"

#include <nettle/sha2.h>

struct kd_job;

enum { KD_JOB_FILMS = 4 }; /* maximum number of films of a job; another film replaces the oldest */
struct kd_job_stored_film {
    struct kd_job_film_name name;
    uint64_t bytes;
};

/* Opens the film with this format and frame rate (in 1/s). out->mark: SHA-256 of the film. Returns false if there is
 * no such film. */
bool kd_job_film_open(struct kd_job *job, const char *format, unsigned rate, struct kd_job_file *out);

/* A film that is being written. */
struct kd_job_film_writer {
    struct kd_job *job;
    bool claimed, begun;
    int folder;
    struct kd_replacing file;
    struct sha256_ctx hash;
    struct kd_job_stored_film film;
};
/* Claims a job for encoding a film. Returns false if the film exists, or if another film of the job is being
 * written. */
bool kd_job_film_claim(struct kd_job_film_writer *w, struct kd_job *job, const char *format, unsigned rate);
enum kd_status kd_job_film_append(struct kd_job_film_writer *w, const void *data, size_t size, struct kd_error *error);
/* Publishes the film, so that requests can open it. Returns KD_EFULL if the files of all jobs would exceed their
 * limit. */
enum kd_status kd_job_film_keep(struct kd_job_film_writer *w, struct kd_error *error);
/* Deletes a film that was not published, and releases the claim. Does nothing if there is neither such a film nor a
 * claim. */
void kd_job_film_end(struct kd_job_film_writer *w);

/* Finds films that were made before a restart. Call this before any other thread uses the job. */
void kd_job_films_find(struct kd_job *job);

#endif
