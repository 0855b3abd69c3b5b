/* Declarations that the handlers of playground sessions share. HTTP thread. */
#ifndef KD_SERVER_PLAYGROUND_ROUTES_H
#define KD_SERVER_PLAYGROUND_ROUTES_H

#include "server/http/request.h"
#include "server/playground/sessions.h"

/* Finds the session that the path names. Returns a reference, or NULL with *refused. */
struct kd_playground_session *kd_playground_session_of(struct kd_request *request, enum MHD_Result *refused);
enum MHD_Result kd_playground_session_ended(struct kd_request *request);
/* Stops waiting for a tick, because the request is closed. */
void kd_playground_session_abandon(struct kd_request *request);

#endif
