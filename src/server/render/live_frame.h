/* A live frame is one encoded frame of a session and what is said of it; all who watch share it, and the last frees it. Constant once made. */
#ifndef KD_SERVER_RENDER_LIVE_FRAME_H
#define KD_SERVER_RENDER_LIVE_FRAME_H

#include "base/buffer.h"
#include "render/output/notes.h"
#include "server/render/queue.h"

#include <stdatomic.h>
#include <stdint.h>

struct kd_live_frame {
    _Atomic unsigned references;
    uint64_t number;   /* of the session's frames, growing, not without gaps */
    unsigned revision; /* of the scene that it shows */
    double time;       /* of the scene as it shows it, M */
    double azimuth_deg; /* likewise of its camera */
    const struct kd_format *format;
    struct kd_buffer file;           /* of it */
    struct kd_buffer approximations; /* as the header has them */
    struct kd_buffer event;          /* the data of its event: JSON in one line */
    char accuracy[KD_ACCURACY_TEXT], timing[400], quality[160], clock[KD_CLOCK_TEXT], flux[KD_FLUX_TEXT];
};

/* What the frame was asked with, for its description. */
struct kd_live_note {
    uint64_t number;
    unsigned revision;
    bool final; /* nothing finer will follow for this revision */
    double fps; /* of late */
};

/* Takes the job's file over. NULL: out of memory. One reference. */
struct kd_live_frame *kd_live_frame_make(struct kd_render_job *job, const struct kd_live_note *note);
struct kd_live_frame *kd_live_frame_share(struct kd_live_frame *frame);
void kd_live_frame_release(struct kd_live_frame *frame); /* accepts NULL */

#endif
