/* Stores frames until they are combined into one file. The store is a temporary file in TMPDIR, or a folder with
 * files 000000.png and so on. With a folder, an interrupted film can be resumed. Main thread only. */
#ifndef KD_CLI_FRAMES_H
#define KD_CLI_FRAMES_H

#include "render/output/gather.h"

struct kd_frames {
    unsigned n;
    const char *noun;               /* word for a frame in error messages, such as "scene" */
    const struct kd_format *format; /* format of the frames; may be NULL if frames are not stored in a folder */
    int store, folder, lock;        /* descriptors; -1: none */
    bool shared;
    /* places: offset of each frame in the temporary file; sizes: bytes of each frame, 0 if it is not stored */
    uint64_t *places, *sizes, end;
};
#define KD_FRAMES_NONE { .store = -1, .folder = -1, .lock = -1 }

/* Opens a temporary store. Before the call, initialise *frames with KD_FRAMES_NONE and set n, noun and format.
 * KD_EIO, KD_ENOMEM. The caller must finish *frames in any case. */
enum kd_status kd_frames_open(struct kd_frames *frames, struct kd_error *error);
/* Like kd_frames_open, but stores the frames in a folder, which is created if necessary. If `shared` is set,
 * processes that render other frames of the film may use the folder at the same time. Otherwise this process locks
 * the folder; KD_EINVAL if another process has locked it. Call kd_frames_find next. */
enum kd_status kd_frames_open_folder(struct kd_frames *frames, const char *path, bool shared, struct kd_error *error);
/* Counts the frames in the folder. Removes unfinished files, unless the folder is shared. It is an error if a
 * frame's name belongs to a folder or a link. */
enum kd_status kd_frames_find(struct kd_frames *frames, unsigned *found, struct kd_error *error);
static inline bool kd_frames_has(const struct kd_frames *frames, unsigned frame) { return frames->sizes[frame] > 0; }

enum kd_status kd_frames_put(struct kd_frames *frames, unsigned frame, const struct kd_buffer *file,
                             struct kd_error *error);
/* Reads `size` bytes of a stored frame, from position `at`. Returns false on failure. */
bool kd_frames_read(void *frames, unsigned frame, uint64_t at, void *to, size_t size);

/* Combines all frames into one file. sweep: the scenes of the frames; NULL if the frames are not a sweep. rate:
 * frames per second of a film. go_on is called repeatedly while another program works; if it returns false, the work
 * stops with KD_ECANCELLED. */
struct kd_frames_whole {
    const struct kd_gather_format *format;
    const struct kd_sweep *sweep;
    unsigned rate;
    bool (*go_on)(void *user);
    void *user;
};
enum kd_status kd_frames_save(struct kd_frames *frames, const struct kd_frames_whole *whole, const char *path,
                              struct kd_error *error);

void kd_frames_finish(struct kd_frames *frames);

#endif
