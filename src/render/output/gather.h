/* Writes the files of many frames as one file, piece by piece; the whole is never held in memory. Each gather belongs
 * to one thread.
 *
 *     kd_gather_open(&kd_gather_zip, &source, &gather, &error);
 *     for (bool over = false; !over && !status;)
 *         status = kd_gather_next(gather, &out, &over, &error);      and consume the contents of out
 *     kd_gather_close(gather);
 *
 * The same frames give the same bytes, independent of where they are stored and when they were made. */
#ifndef KD_RENDER_OUTPUT_GATHER_H
#define KD_RENDER_OUTPUT_GATHER_H

#include "render/output/format.h"
#include "scene/sweep.h"

#define KD_GATHER_PIECE (256u << 10) /* approximate number of bytes that one call produces */

/* The frames' files, all of which must exist. The struct must outlive the gather. */
struct kd_gather_source {
    void *user;
    const struct kd_sweep *sweep;  /* sweep of the frames' scenes; NULL: no sweep, permitted for a ZIP only */
    const struct kd_format *frame; /* format of the files */
    unsigned n;
    unsigned rate; /* frames a second of a film */
    /* If not NULL, a format with `counts` adds the number of the frames' bytes to *counted instead of producing these
     * bytes. */
    uint64_t *counted;
    bool (*size)(void *user, unsigned frame, uint64_t *out);
    /* reads exactly `size` bytes, or returns false */
    bool (*read)(void *user, unsigned frame, uint64_t at, void *to, size_t size);
};

/* A format of the gathered file. */
struct kd_gather_format {
    const char *name, *media_type;
    const struct kd_format *of; /* format that the frames must have; NULL: any */
    /* bytes of memory held while the file is made, for formats that do much work before their first piece; NULL:
     * none */
    size_t (*holds)(const struct kd_gather_source *source);
    bool counts; /* true if the size of the gathered file can be computed: produced bytes plus *source->counted */
    /* true if `next` may produce nothing because it waits for another program; call it again some milliseconds later */
    bool waits;
    enum kd_status (*open)(const struct kd_gather_source *source, void **state, struct kd_error *error);
    enum kd_status (*next)(void *state, struct kd_buffer *out, bool *over, struct kd_error *error);
    void (*close)(void *state);
};

/* A ZIP of the frames' files. Files of a sequence are named "000000.png", "000001.png" and so on. For a sweep the names
 * contain values, and index.json comes first, with the scene, the axes and these names. */
extern const struct kd_gather_format kd_gather_zip;
/* Cubes: one array for each layer over all scenes of a sweep, and one for the values of each axis (cube.h). */
extern const struct kd_gather_format kd_gather_fits, kd_gather_npz;
/* Films of PNG frames, all of one size, encoded by the program ffmpeg, with the scene of frame 0 as `comment`. Returns
 * KD_EABSENT if there is no ffmpeg. */
extern const struct kd_gather_format kd_gather_mp4, kd_gather_webm;
#define KD_FILM_RATE 24u /* default of `rate`, frames a second */
#define KD_FILM_RATE_MAX 120u

/* Checks whether the scenes of a sweep can form a cube: all have the same size and layers. If not, returns KD_EINVAL at
 * the axis along which they differ. */
enum kd_status kd_cube_check(const struct kd_sweep *sweep, struct kd_error *error);
/* The call for scene 0 sets the shape; the calls for other scenes compare their scene and plan with it. This finds
 * differences that no single axis shows. Returns KD_EINVAL at /axes, naming the scene. */
struct kd_cube_shape {
    unsigned width, height;
    struct kd_words layers;
};
enum kd_status kd_cube_compare(struct kd_cube_shape *shape, unsigned number, const struct kd_scene *scene,
                               const struct kd_plan_picture *picture, struct kd_error *error);
size_t kd_cube_holds(const struct kd_gather_source *source); /* memory needed to make a cube */

struct kd_gather {
    const struct kd_gather_format *format;
    void *state;
};
enum kd_status kd_gather_open(const struct kd_gather_format *format, const struct kd_gather_source *source,
                              struct kd_gather *out, struct kd_error *error);
/* Appends more bytes, sometimes none. *over: true if everything was produced. Errors: KD_ENOMEM, and KD_EIO if a
 * frame's file has changed. */
enum kd_status kd_gather_next(struct kd_gather *gather, struct kd_buffer *out, bool *over, struct kd_error *error);
void kd_gather_close(struct kd_gather *gather); /* may be called for a gather that was never opened */

#endif
