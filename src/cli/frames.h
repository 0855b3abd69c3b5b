/* Storage of frames until they are combined into one file: in a temporary file in TMPDIR, or in a folder as 000000.png
 * and so on, so that an interrupted film can be resumed. Main thread only. */
#ifndef KD_CLI_FRAMES_H
#define KD_CLI_FRAMES_H

#include "render/output/gather.h"

struct kd_frames {
    unsigned n;
    const char *noun;               /* what a frame is called in errors, such as "scene" */
    const struct kd_format *format; /* format of the frames; may be NULL without a folder */
    int store, folder, lock;        /* descriptors, -1: none */
    bool shared;
    uint64_t *places, *sizes, end; /* sizes: 0: not stored */
};
#define KD_FRAMES_NONE { .store = -1, .folder = -1, .lock = -1 }

/* Opens temporary storage. Initialise with KD_FRAMES_NONE and set n, noun and format before. KD_EIO, KD_ENOMEM; finish
 * it in any case. */
enum kd_status kd_frames_open(struct kd_frames *frames, struct kd_error *error);
/* The same in a folder, which is created if needed. It is locked for this process, or for all processes that share it
 * and render other frames. Returns KD_EINVAL if another process has locked it otherwise. Call kd_frames_find next. */
enum kd_status kd_frames_open_folder(struct kd_frames *frames, const char *path, bool shared, struct kd_error *error);
/* Counts the frames in the folder, and removes unfinished files unless the folder is shared. A folder or link under a
 * frame's name is an error. */
enum kd_status kd_frames_find(struct kd_frames *frames, unsigned *found, struct kd_error *error);
static inline bool kd_frames_has(const struct kd_frames *frames, unsigned frame) { return frames->sizes[frame] > 0; }

enum kd_status kd_frames_put(struct kd_frames *frames, unsigned frame, const struct kd_buffer *file,
                             struct kd_error *error);
/* Reads `size` bytes of a stored frame from `at` on. False on failure. */
bool kd_frames_read(void *frames, unsigned frame, uint64_t at, void *to, size_t size);

/* Combines all frames into one file. sweep: their scenes, NULL: none; rate: frame rate of a film in 1/s. go_on is
 * polled while another program works; false stops it with KD_ECANCELLED. */
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
