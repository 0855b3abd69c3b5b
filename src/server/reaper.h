/* The housekeeping thread. It handles deadlines, clients that have disconnected, and the shutdown. */
#ifndef KD_SERVER_REAPER_H
#define KD_SERVER_REAPER_H

#include "server/http/service.h"

/* Main function of the thread, for pthread_create. The argument is the struct kd_server. Returns when the server has
 * stopped. */
void *kd_reaper_main(void *server);

#endif
