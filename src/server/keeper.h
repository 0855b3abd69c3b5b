/* The housekeeping thread: deadlines, clients that have left, and the shutdown. */
#ifndef KD_SERVER_KEEPER_H
#define KD_SERVER_KEEPER_H

#include "server/http/service.h"

/* pthread_create's argument: the struct kd_server. Returns when the server has stopped. */
void *kd_keeper_main(void *server);

#endif
