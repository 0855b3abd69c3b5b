/* One HTTP request from its first line to its last byte. HTTP thread only. */
#ifndef KD_SERVER_REQUEST_H
#define KD_SERVER_REQUEST_H

#include "server/client.h"
#include "server/guard.h"
#include "server/routes.h"
#include "server/service.h"
#include "server/target.h"

#define KD_NPY_TYPE "application/x-npy"
#define KD_PATCH_TYPE "application/merge-patch+json"

struct kd_request {
    struct kd_server *server;
    struct MHD_Connection *mhd;
    struct kd_connection *connection;
    char client[KD_CLIENT]; /* who it is from */
    char *raw; /* the target as received */
    struct kd_target target;
    struct kd_header header;
    const struct kd_route *route;
    const char *method, *rest; /* rest: of the path, behind a route that ends in "/" */
    bool head, begun, body_announced, close;
    struct kd_buffer body;
    size_t body_mark; /* how much of it there was when its time was last set */
    struct kd_render_job *job; /* of a render under way; owned */
    struct kd_orbits_job *orbits; /* of a request for orbits under way; held */
    struct kd_particles_job *particles; /* of particles being listed; owned */
    struct kd_task *task;      /* of what workers compute; owned */
    struct kd_viewer *viewer;  /* of a request that waits for a session's next frame; owned */
    char etag[96];
    char file[96]; /* Content-Disposition of an answer of 200, by kd_reply_file */
    size_t reply_bytes; /* of a large reply, for its deadline */
    double start_ms;
    unsigned status; /* of the reply, for the log */
};

void kd_particles_job_destroy(struct kd_particles_job *job); /* session_particles.c; accepts NULL */

void kd_live_abandon(struct kd_request *request);  /* live.c: nobody waits for a frame any more */
/* session_routes.c: a reference to the session that the path names, or NULL after a refusal. */
struct kd_session *kd_session_of(struct kd_request *request, enum MHD_Result *refused);
/* The token that comes with a request, in its header or query; NULL: none. */
const char *kd_token_of(struct kd_request *request);

/* The four callbacks libmicrohttpd is started with; cls is the struct kd_server. */
void *kd_request_open(void *cls, const char *uri, struct MHD_Connection *mhd);
enum MHD_Result kd_request_handle(void *cls, struct MHD_Connection *mhd, const char *url, const char *method,
                                  const char *version, const char *data, size_t *size, void **state);
void kd_request_close(void *cls, struct MHD_Connection *mhd, void **state,
                      enum MHD_RequestTerminationCode why);
void kd_request_connection(void *cls, struct MHD_Connection *mhd, void **socket_context,
                           enum MHD_ConnectionNotificationCode what);

#endif
