/* Writes the files of many frames as one file, piece by piece; the whole is never held in memory. One thread each.
 *
 *     kd_gather_open(&kd_gather_zip, &source, &gather, &error);
 *     for (bool over = false; !over && !status;)
 *         status = kd_gather_next(gather, &out, &over, &error);      and take what it has put into out
 *     kd_gather_close(gather);
 *
 * The same frames give the same bytes, whoever keeps them and whenever they were made. */
#ifndef KD_RENDER_OUTPUT_GATHER_H
#define KD_RENDER_OUTPUT_GATHER_H

#include "render/output/format.h"
#include "scene/sweep.h"

#define KD_GATHER_PIECE (256u << 10) /* bytes that one call gives, about */

/* The frames' files, all of which are there. It lives as long as what is made of them. */
struct kd_gather_source {
    void *user;
    const struct kd_sweep *sweep;  /* whose scenes they are; NULL: of none, for a ZIP alone */
    const struct kd_format *frame; /* what they are */
    unsigned n;
    unsigned rate;     /* frames a second, of a film */
    uint64_t *counted; /* what `counts` counts bytes of frames in, instead of giving them; NULL: it gives them */
    bool (*size)(void *user, unsigned frame, uint64_t *out);
    bool (*read)(void *user, unsigned frame, uint64_t at, void *to, size_t size); /* all of these bytes, or false */
};

/* What they become. */
struct kd_gather_format {
    const char *name, *media_type;
    const struct kd_format *of;                             /* of frames of this format; NULL: of any */
    size_t (*holds)(const struct kd_gather_source *source); /* bytes held while it is made, much of which is done before
                                                               its first piece; NULL: it is made as it is taken */
    bool counts; /* it can say how long it will be: what it gives, and source->counted, together */
    bool waits;  /* where it gives nothing it waits for another program: to be asked again some milliseconds later */
    enum kd_status (*open)(const struct kd_gather_source *source, void **state, struct kd_error *error);
    enum kd_status (*next)(void *state, struct kd_buffer *out, bool *over, struct kd_error *error);
    void (*close)(void *state);
};

/* "000012.png" ... of a sequence; of a sweep names that tell values, behind index.json with the scene, the axes and
 * these names. */
extern const struct kd_gather_format kd_gather_zip;
/* Cubes: an array of each layer, of all scenes of a sweep, with an array of the values of each axis (cube.h). */
extern const struct kd_gather_format kd_gather_fits, kd_gather_npz;
/* Films of frames that are PNG, all of one size, encoded by the program ffmpeg, with the scene of frame 0 as
 * `comment`. KD_EABSENT where there is no ffmpeg. */
extern const struct kd_gather_format kd_gather_mp4, kd_gather_webm;
#define KD_FILM_RATE 24u /* frames a second where nobody says otherwise */
#define KD_FILM_RATE_MAX 120u

/* Whether the scenes of a sweep make a cube: all of them are of the same size and have the same layers. KD_EINVAL at
 * the axis that makes them differ. */
enum kd_status kd_cube_check(const struct kd_sweep *sweep, struct kd_error *error);
/* The same of one scene and its plan beside what scene 0 has, which the call for it sets: what an axis changes that
 * says nothing of it. KD_EINVAL at /axes, naming the scene. */
struct kd_cube_shape {
    unsigned width, height;
    struct kd_words layers;
};
enum kd_status kd_cube_compare(struct kd_cube_shape *shape, unsigned number, const struct kd_scene *scene,
                               const struct kd_plan *plan, struct kd_error *error);
size_t kd_cube_holds(const struct kd_gather_source *source); /* of a cube */

struct kd_gather {
    const struct kd_gather_format *format;
    void *state;
};
enum kd_status kd_gather_open(const struct kd_gather_format *format, const struct kd_gather_source *source,
                              struct kd_gather *out, struct kd_error *error);
/* Appends more; it may append nothing now and then. *over: that was all. KD_ENOMEM, and KD_EIO where a frame's file
 * is not what it was. */
enum kd_status kd_gather_next(struct kd_gather *gather, struct kd_buffer *out, bool *over, struct kd_error *error);
void kd_gather_close(struct kd_gather *gather); /* one that was never opened too */

#endif
