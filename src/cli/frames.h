/* Storage of frames until they are combined into one file. It is a temporary file in TMPDIR, or a folder with
 * 000000.png and so on. With a folder an interrupted film can be resumed. Main thread only. */
#ifndef KD_CLI_FRAMES_H
#define KD_CLI_FRAMES_H

#include "render/output/gather.h"

struct kd_frames {
    unsigned n;
    const char *noun;               /* name of a frame in errors, such as "scene" */
    const struct kd_format *format; /* format of the frames; may be NULL if there is no folder */
    int store, folder, lock;        /* descriptors; -1: none */
    bool shared;
    uint64_t *places, *sizes, end; /* sizes: 0 if the frame is not stored */
};
#define KD_FRAMES_NONE { .store = -1, .folder = -1, .lock = -1 }

/* Opens temporary storage. Before the call, initialise *frames with KD_FRAMES_NONE and set n, noun and format. KD_EIO,
 * KD_ENOMEM; the caller must finish *frames in any case. */
enum kd_status kd_frames_open(struct kd_frames *frames, struct kd_error *error);
/* Like kd_frames_open, in a folder, which is created if needed. If `shared` is set, processes that render other frames
 * of the film may use the folder at the same time; otherwise this process locks it for itself. Returns KD_EINVAL if
 * another process has locked it. Call kd_frames_find next. */
enum kd_status kd_frames_open_folder(struct kd_frames *frames, const char *path, bool shared, struct kd_error *error);
/* Counts the frames in the folder. Removes unfinished files, unless the folder is shared. A folder or a link with
 * the name of a frame is an error. */
enum kd_status kd_frames_find(struct kd_frames *frames, unsigned *found, struct kd_error *error);
static inline bool kd_frames_has(const struct kd_frames *frames, unsigned frame) { return frames->sizes[frame] > 0; }

enum kd_status kd_frames_put(struct kd_frames *frames, unsigned frame, const struct kd_buffer *file,
                             struct kd_error *error);
/* Reads `size` bytes of a stored frame, from position `at`. Returns false on failure. */
bool kd_frames_read(void *frames, unsigned frame, uint64_t at, void *to, size_t size);

/* Combines all frames into one file. sweep: the scenes of the frames; NULL: they are not a sweep. rate: frame rate of a
 * film in 1/s. go_on is called repeatedly while another program works; if it returns false, the work stops with
 * KD_ECANCELLED. */
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
