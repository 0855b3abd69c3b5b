/* A small picture of each preset is kept here, for a page that shows which there are. Each is rendered when somebody first asks for it, and kept
 * as long as the program runs.
 *
 * They are rendered one at a time, as a job's picture is: in slices of some 40 ms, between which frames of sessions go first by weight
 * (http/shares.h). Whoever asks meanwhile waits, however many they are; what they wait for is rendered once. */
#ifndef KD_SERVER_RENDER_THUMBNAILS_H
#define KD_SERVER_RENDER_THUMBNAILS_H

#include "base/error.h"
#include "server/http/service.h"

enum { KD_THUMBNAIL_WIDTH = 192, KD_THUMBNAIL_HEIGHT = 120 };

struct kd_thumbnails;

/* The server outlives them, and its queue and its etag_tail are there. */
enum kd_status kd_thumbnails_create(struct kd_server *server, struct kd_thumbnails **out, struct kd_error *error);
/* The queue is gone, and with it what it had to call. Accepts NULL. */
void kd_thumbnails_destroy(struct kd_thumbnails *thumbnails);
/* How many have been rendered. Any thread. */
unsigned kd_thumbnails_rendered(struct kd_thumbnails *thumbnails);

#endif
