/* A format is what a frame can become: bytes of a media type. One table, from which renders, jobs, sessions and the
 * command line pick: by the name of a format, by what a client accepts. Any thread.
 *
 * A format is one C file that defines kd_format_NAME, and its name in KD_FORMATS. */
#ifndef KD_RENDER_OUTPUT_FORMAT_H
#define KD_RENDER_OUTPUT_FORMAT_H

#include "base/buffer.h"
#include "render/frame/frame.h"

/* A frame and how it came about. */
struct kd_picture {
    const struct kd_frame *frame;
    const struct kd_scene *scene;
    const struct kd_plan *plan;
    const char *device; /* as kd_renderer_device_name */
    unsigned number;    /* in a series, from 0 on */
    unsigned lossy;     /* the quality of a format that loses some, 1 to 100 */
    const char *hash;   /* of the scene, as kd_scene_hash has it; NULL or "": whoever writes it makes it */
};

enum kd_effort {
    KD_EFFORT_LIVE,  /* one of many a second, of 8 bits a channel: as fast as can be, and without what is told of it
                        elsewhere */
    KD_EFFORT_QUICK, /* somebody waits for it */
    KD_EFFORT_KEEP,  /* a file that stays: smaller */
};

/* What a frame must carry for a format, bits. */
enum {
    KD_CARRIES_PICTURE = 1 /* layer "rgb" */,
    KD_CARRIES_LIGHT = 2 /* frame->light */,
    KD_CARRIES_LAYERS = 4 /* whatever image.layers names, as numbers: of the picture its linear light */
};

struct kd_format {
    const char *name;       /* "png": of `format=`, and the end of a file's name; lower case */
    const char *media_type; /* "image/png" */
    const char *magic;      /* with which every file begins; "": none has a beginning of its own */
    const char *end;        /* with which every file ends; NULL: none has an end of its own */
    unsigned carries;
    bool live; /* KD_EFFORT_LIVE is for it */
    /* Makes a scene one of which a frame carries what the format needs; NULL: any is. KD_EINVAL at a field of one
     * that has nothing to tell. */
    enum kd_status (*draws)(struct kd_scene *scene, struct kd_error *error);
    /* Append a file to *out. *memory: of this thread's earlier calls, NULL at first; `forget` frees it. Errors:
     * KD_ENOMEM, or KD_EINVAL and KD_ETOOBIG for what the format cannot hold. */
    enum kd_status (*encode)(const struct kd_picture *picture, enum kd_effort effort, void **memory,
                             struct kd_buffer *out, struct kd_error *error);
    void (*forget)(void *memory); /* NULL: it keeps none */
    /* The scene inside a file of this format, *out as it was on error; NULL: it carries none. */
    enum kd_status (*scene)(const void *data, size_t size, struct kd_scene *out, struct kd_error *error);
};

#define KD_FORMATS(FORMAT) FORMAT(png) FORMAT(npy) FORMAT(npz) FORMAT(fits) FORMAT(exr) FORMAT(stars)
#define KD_FORMAT_DECLARE(name) extern const struct kd_format kd_format_##name;
KD_FORMATS(KD_FORMAT_DECLARE)
#undef KD_FORMAT_DECLARE

/* Moving frames of those who take them, of the quality that the picture says; in no table. jpeg.c */
extern const struct kd_format kd_format_jpeg;

/* FITS files of the scenes of a cube, in no table: with the layers that image.layers names, and no others, so that all
 * scenes have the same. fits.c */
extern const struct kd_format kd_format_cubed;

/* The first is what is made where nobody says otherwise. formats.c */
extern const struct kd_format *const kd_formats[];
extern const size_t kd_n_formats;

const struct kd_format *kd_format_named(const char *name);                 /* NULL: there is none */
const struct kd_format *kd_format_of_bytes(const void *data, size_t size); /* by its beginning; NULL: none */
const struct kd_format *kd_format_live(void);                              /* what live views are made of */

/* The plan of a frame that carries what the format needs. What would show in none of it, and is in no scene that the
 * file carries, auto exposure and layers, is taken from the scene. Errors as kd_plan_make and the format's `draws`,
 * and KD_EINVAL at /image/layers for more of them than the format holds. */
enum kd_status kd_format_plan(const struct kd_format *format, struct kd_scene *scene,
                              const struct kd_capacity *capacity, struct kd_plan *out, struct kd_error *error);

/* The scene inside a picture, of whatever format; KD_EINVAL if there is none. */
enum kd_status kd_format_scene(const void *data, size_t size, struct kd_scene *out, struct kd_error *error);

/* What a thread that encodes keeps from one file to the next; { 0 } to begin with. */
struct kd_encoder {
    const struct kd_format *of;
    void *memory;
};
/* As the format's encode. encoder: NULL for a single file. */
enum kd_status kd_encode(const struct kd_format *format, const struct kd_picture *picture, enum kd_effort effort,
                         struct kd_encoder *encoder, struct kd_buffer *out, struct kd_error *error);
void kd_encoder_finish(struct kd_encoder *encoder);

#endif
