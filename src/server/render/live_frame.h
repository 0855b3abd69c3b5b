/* One encoded frame of a session and its metadata. All viewers share the frame by reference count. A frame is
 * immutable except for its pixels. They are kept for a while, so that the frame can be encoded in further formats. */
#ifndef KD_SERVER_RENDER_LIVE_FRAME_H
#define KD_SERVER_RENDER_LIVE_FRAME_H

#include "base/buffer.h"
#include "render/output/notes.h"
#include "server/render/queue.h"

#include <stdatomic.h>
#include <stdint.h>

/* A frame in one encoding: lossless, or lossy at a quality. */
struct kd_live_file {
    const struct kd_format *format;
    unsigned lossy; /* quality, 1 to 100; 0: lossless */
    struct kd_buffer bytes;
    double encode_ms;
};
#define KD_LIVE_FILES 6 /* one lossless encoding; all others are lossy */

struct kd_live_frame {
    _Atomic unsigned references;
    uint64_t number;                          /* number within the session; numbers increase, with gaps */
    unsigned revision;                        /* revision of the session's scene */
    double time;                              /* time of the scene, in M */
    double azimuth_deg;                       /* azimuth of the camera at the time of the frame */
    bool final;                               /* no refinement follows for this revision */
    bool last;                                /* no other frame follows; the last frame is lossless only */
    struct kd_live_file files[KD_LIVE_FILES]; /* entries that exist do not change */
    unsigned n_files;                         /* increases, under the lock of sessions */
    struct kd_frame picture;                  /* pixels of the frame; empty if it is the last frame */
    struct kd_buffer approximations;          /* text of the header Kerrd-Approximations */
    /* hash of the approximations; the text is not sent again to a client that has it */
    uint32_t sentences;
    struct kd_buffer event; /* data of the frame's event: JSON on one line */
    char accuracy[KD_ACCURACY_TEXT], timing[400], quality[200], clock[KD_CLOCK_TEXT], flux[KD_FLUX_TEXT];
};

/* Values that describe a frame. */
struct kd_live_note {
    uint64_t number;
    unsigned revision;
    bool final, last; /* final: no refinement follows for this revision; last: no other frame follows */
    double fps;       /* recent frame rate */
};

/* Makes a frame of a finished job. Takes over the job's file, and also the picture if the job keeps its layers.
 * Returns one reference, or NULL when out of memory. */
struct kd_live_frame *kd_live_frame_make(struct kd_render_job *job, const struct kd_live_note *note);
struct kd_live_frame *kd_live_frame_share(struct kd_live_frame *frame);
void kd_live_frame_release(struct kd_live_frame *frame); /* accepts NULL */

#endif
