/* Declarations shared by the handlers of playground sessions. HTTP thread. */
#ifndef KD_SERVER_PLAYGROUND_ROUTES_H
#define KD_SERVER_PLAYGROUND_ROUTES_H

#include "server/http/request.h"
#include "server/playground/plays.h"

/* The play that the path names: a reference, or NULL after a refusal. */
struct kd_play *kd_play_of(struct kd_request *request, enum MHD_Result *refused);
enum MHD_Result kd_play_ended(struct kd_request *request);
/* Nobody waits for a tick any more. */
void kd_play_abandon(struct kd_request *request);

#endif
