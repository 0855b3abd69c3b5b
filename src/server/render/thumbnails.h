/* Thumbnails of presets. Each is rendered when it is first requested (painter.h). After that the thumbnail is kept
 * in memory, and on disk for later runs. Requests that arrive while a thumbnail is being rendered wait for its
 * completion. */
#ifndef KD_SERVER_RENDER_THUMBNAILS_H
#define KD_SERVER_RENDER_THUMBNAILS_H

#include "base/error.h"
#include "render/device/renderer.h"
#include "server/http/service.h"

enum { KD_THUMBNAIL_WIDTH = 192, KD_THUMBNAIL_HEIGHT = 120 };

struct kd_thumbnails;

/* The thumbnails use the server, its queue and its etag_tail, which must exist before and must outlive them.
 * renderer: parameters of the queue's device. */
enum kd_status kd_thumbnails_create(struct kd_server *server, const struct kd_renderer_params *renderer,
                                    struct kd_thumbnails **out, struct kd_error *error);
/* For shutdown: stops rendering and resumes the waiting requests, which their handler then refuses. Any thread. */
void kd_thumbnails_cancel(struct kd_thumbnails *thumbnails);
/* Calls kd_painter_hangs. Any thread. */
bool kd_thumbnails_hang(struct kd_thumbnails *thumbnails);
/* Accepts NULL. */
void kd_thumbnails_destroy(struct kd_thumbnails *thumbnails);
/* Number of thumbnails that were rendered; those read from files do not count. Any thread. */
unsigned kd_thumbnails_rendered(struct kd_thumbnails *thumbnails);

#endif
