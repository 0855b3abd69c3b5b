/* The files of many frames, kept until they become one: in a file of TMPDIR that nobody else sees, or, to go on with
 * after whatever end, in a folder as 000000.png and so on. Main thread only. */
#ifndef KD_CLI_FRAMES_H
#define KD_CLI_FRAMES_H

#include "render/output/gather.h"

struct kd_frames {
    unsigned n;
    const char *noun;               /* "scene": what one is called in errors */
    const struct kd_format *format; /* what they are; may be NULL where there is no folder */
    int store, folder, lock;        /* descriptors, -1: there is none */
    bool shared;
    uint64_t *places, *sizes, end; /* sizes: 0, it is not there */
};
#define KD_FRAMES_NONE { .store = -1, .folder = -1, .lock = -1 }

/* n, noun and format are the caller's to set, in one that begins as KD_FRAMES_NONE. KD_EIO, KD_ENOMEM; finish it in
 * any case. */
enum kd_status kd_frames_open(struct kd_frames *frames, struct kd_error *error);
/* The same in a folder, which is made if need be and is then this process's alone, or shared with others that put
 * other frames there. KD_EINVAL: another has it otherwise. Which frames are there already says kd_frames_find. */
enum kd_status kd_frames_open_folder(struct kd_frames *frames, const char *path, bool shared, struct kd_error *error);
/* Counts those that a folder has already, and removes halves that a process left there, unless the folder is shared.
 * What a frame's file is called there that is no frame's (a folder, a link) is an error. */
enum kd_status kd_frames_find(struct kd_frames *frames, unsigned *found, struct kd_error *error);
static inline bool kd_frames_has(const struct kd_frames *frames, unsigned frame) { return frames->sizes[frame] > 0; }

enum kd_status kd_frames_put(struct kd_frames *frames, unsigned frame, const struct kd_buffer *file,
                             struct kd_error *error);
/* All of these bytes of one that is there, or false. */
bool kd_frames_read(void *frames, unsigned frame, uint64_t at, void *to, size_t size);

/* Writes what all of them become. sweep: whose scenes they are, NULL: of none; rate: of a film. go_on is asked while
 * another program works on it, and ends it by false: KD_ECANCELLED. */
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
