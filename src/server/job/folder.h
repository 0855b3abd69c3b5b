/* Names and removes the files of a job, and no others; never follows a link. Private to store.c.
 *
 * The folder of jobs has one folder for each job, named by its ID, and `lock`. While a job is being written its folder
 * is called ID.new. */
#ifndef KD_SERVER_JOB_FOLDER_H
#define KD_SERVER_JOB_FOLDER_H

#include "server/http/secret.h"

#include <stdbool.h>

enum { KD_JOB_NAME = KD_SECRET_ID + 4 }; /* of a job's folder, with ".new" */

bool kd_job_folder_is_id(const char *name);
bool kd_job_folder_is_new(const char *name); /* ID.new */

void kd_job_folder_frame(unsigned frame, char name[20]); /* "000000.png" */

/* A film of a job: "film-024-HASH.mp4" with its frames a second and the SHA-256 of its bytes. */
enum { KD_JOB_FILM_NAME = 5 + 3 + 1 + 64 + 1 + 4 + 1 };
struct kd_job_film_name {
    unsigned rate;
    char hash[65], format[5];
};
void kd_job_folder_film(const struct kd_job_film_name *film, char name[KD_JOB_FILM_NAME]);
bool kd_job_folder_read_film(const char *name, struct kd_job_film_name *out); /* false: it is the name of none */
/* What it is called until its hash is known, "film-024.mp4". */
void kd_job_folder_new_film(const char *format, unsigned rate, char name[KD_JOB_FILM_NAME]);

/* A descriptor; -1 with errno, ELOOP or ENOTDIR where it is no folder. */
int kd_job_folder_open(int jobs, const char *name);

/* Removes at most so many of a job's files, job.json last: it says whose the rest is; then the folder, unless it
 * holds what is not a job's. True when there is nothing left that may be removed. */
bool kd_job_folder_remove(int jobs, const char *name, unsigned most);

/* Removes what a server that was killed has left half written of a job's files; nothing else, whatever its name
 * begins with. */
void kd_job_folder_tidy(int folder);
/* Removes all jobs in a folder, and then its lock. */
void kd_job_folder_empty(int jobs);

#endif
