/* One encoded frame of a session and its metadata. All viewers share it by reference count. It is immutable, except
 * that a frame that is still being refined keeps its pixels, so that it can be encoded in further formats. */
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
#define KD_LIVE_FILES 6 /* one lossless and the others lossy */

struct kd_live_frame {
    _Atomic unsigned references;
    uint64_t number;                          /* number in the session: increasing, with gaps */
    unsigned revision;                        /* of its scene */
    double time;                              /* time of the scene, M */
    double azimuth_deg;                       /* of the camera at that time */
    bool final;                               /* no refinement will follow for this revision */
    bool last;                                /* nor any other frame; then it is lossless only */
    struct kd_live_file files[KD_LIVE_FILES]; /* existing entries do not change */
    unsigned n_files;                         /* grows under the lock of the sessions */
    struct kd_frame picture;                  /* pixels of a frame that is not the last */
    struct kd_buffer approximations;          /* as in the header */
    uint32_t sentences;                       /* hash of these: they are not sent to clients that have them */
    struct kd_buffer event;                   /* data of its event: JSON on one line */
    char accuracy[KD_ACCURACY_TEXT], timing[400], quality[160], clock[KD_CLOCK_TEXT], flux[KD_FLUX_TEXT];
};

/* Values for the frame's description. */
struct kd_live_note {
    uint64_t number;
    unsigned revision;
    bool final, last; /* no refinement will follow for this revision; nor any other frame */
    double fps;       /* recent frame rate */
};

/* Makes a frame of a finished job and takes over its file, and its picture if the job keeps the layers. Returns one
 * reference, or NULL when out of memory. */
struct kd_live_frame *kd_live_frame_make(struct kd_render_job *job, const struct kd_live_note *note);
struct kd_live_frame *kd_live_frame_share(struct kd_live_frame *frame);
void kd_live_frame_release(struct kd_live_frame *frame); /* accepts NULL */

#endif
