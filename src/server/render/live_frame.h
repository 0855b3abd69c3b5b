/* One encoded frame of a session, with its metadata. All viewers share it by reference count. A frame is immutable
 * except for its pixels, which are kept for a while so that the frame can be encoded in further formats. */
#ifndef KD_SERVER_RENDER_LIVE_FRAME_H
#define KD_SERVER_RENDER_LIVE_FRAME_H

#include "base/buffer.h"
#include "render/output/notes.h"
#include "server/render/queue.h"

#include <stdatomic.h>
#include <stdint.h>

/* A frame in one encoding: either lossless, or lossy with a certain quality. */
struct kd_live_file {
    const struct kd_format *format;
    unsigned lossy; /* quality, 1 to 100; 0: lossless */
    struct kd_buffer bytes;
    double encode_ms;
};
#define KD_LIVE_FILES 6 /* maximum number of encodings: one lossless encoding and several lossy ones */

struct kd_live_frame {
    _Atomic unsigned references;
    /* number of the frame in the session; numbers increase, but some are skipped */
    uint64_t number;
    unsigned revision;  /* revision of the session's scene */
    double time;        /* time of the scene in this frame, in M */
    double azimuth_deg; /* azimuth of the camera in this frame */
    bool final;         /* true if no refinement of this revision follows */
    /* true if no other frame follows; the first encoding of such a frame is lossless */
    bool last;
    struct kd_live_file files[KD_LIVE_FILES]; /* the encodings that exist; an entry never changes */
    unsigned n_files;                         /* number of encodings, which increases under the lock of sessions */
    /* pixels of the frame; empty if they were not kept, or after they were freed */
    struct kd_frame picture;
    struct kd_buffer approximations; /* value of the header Kerrd-Approximations */
    /* hash of the approximations; the text is not sent to a client that already has it */
    uint32_t sentences;
    struct kd_buffer event; /* data of the event that announces the frame: JSON on one line */
    char accuracy[KD_ACCURACY_TEXT], timing[400], quality[200], clock[KD_CLOCK_TEXT], flux[KD_FLUX_TEXT];
};

/* Values that describe a frame. */
struct kd_live_note {
    uint64_t number;
    unsigned revision;
    bool final, last; /* final: true if no refinement of this revision follows; last: true if no other frame follows */
    double fps;       /* recent frame rate */
};

/* Makes a frame from a finished job. Takes over the job's file, and also the picture if the job keeps its layers.
 * Returns a reference, or NULL when out of memory. */
struct kd_live_frame *kd_live_frame_make(struct kd_render_job *job, const struct kd_live_note *note);
struct kd_live_frame *kd_live_frame_share(struct kd_live_frame *frame);
void kd_live_frame_release(struct kd_live_frame *frame); /* accepts NULL */

#endif
