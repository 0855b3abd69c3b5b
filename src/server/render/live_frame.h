/* One encoded frame of a session, and its metadata. All viewers share it by reference count. It is immutable, except
 * that the frame of a scene that is still being refined keeps its pixels, so that it can be encoded in further
 * formats. */
#ifndef KD_SERVER_RENDER_LIVE_FRAME_H
#define KD_SERVER_RENDER_LIVE_FRAME_H

#include "base/buffer.h"
#include "render/output/notes.h"
#include "server/render/queue.h"

#include <stdatomic.h>
#include <stdint.h>

/* A frame in one kind: exact, or of a lossy format at a quality. */
struct kd_live_file {
    const struct kd_format *format;
    unsigned lossy; /* its quality, 1 to 100; 0: none is lost */
    struct kd_buffer bytes;
    double encode_ms;
};
#define KD_LIVE_FILES 6 /* one that is exact, and others */

struct kd_live_frame {
    _Atomic unsigned references;
    uint64_t number;                          /* of the session's frames, growing, not without gaps */
    unsigned revision;                        /* of the scene that it shows */
    double time;                              /* of the scene as it shows it, M */
    double azimuth_deg;                       /* likewise of its camera */
    bool final;                               /* nothing finer will follow for this revision; */
    bool last;                                /* nor any other: it is exact, and nothing else */
    struct kd_live_file files[KD_LIVE_FILES]; /* those that are there stay as they are; */
    unsigned n_files;                         /* more may come, under the lock of the sessions */
    struct kd_frame picture;                  /* of one that is not the last: its pixels */
    struct kd_buffer approximations;          /* as the header has them, */
    uint32_t sentences;                       /* and their hash: who knows them is not told again */
    struct kd_buffer event;                   /* the data of its event: JSON in one line */
    char accuracy[KD_ACCURACY_TEXT], timing[400], quality[160], clock[KD_CLOCK_TEXT], flux[KD_FLUX_TEXT];
};

/* What the frame was asked with, for its description. */
struct kd_live_note {
    uint64_t number;
    unsigned revision;
    bool final, last; /* nothing finer will follow for this revision; nor any other */
    double fps;       /* of late */
};

/* Takes the job's file over, and its picture where that keeps its layers. NULL: out of memory. One reference. */
struct kd_live_frame *kd_live_frame_make(struct kd_render_job *job, const struct kd_live_note *note);
struct kd_live_frame *kd_live_frame_share(struct kd_live_frame *frame);
void kd_live_frame_release(struct kd_live_frame *frame); /* accepts NULL */

#endif
