/* Formats of a frame. Each format produces bytes of one media type. Renders, jobs, sessions and the command line
 * choose from one table, by the format's name or by what a client accepts. Any thread.
 *
 * A format is a definition of kd_format_NAME in a C file, and its name in KD_FORMATS. */
#ifndef KD_RENDER_OUTPUT_FORMAT_H
#define KD_RENDER_OUTPUT_FORMAT_H

#include "base/buffer.h"
#include "base/media.h"
#include "render/frame/frame.h"

#define KD_QUALITY 90      /* quality of lossy formats if no other is requested */
#define KD_QUALITY_MAX 100 /* largest quality; the smallest is 1 */

/* A frame and how it was made. */
struct kd_picture {
    const struct kd_frame *frame;
    const struct kd_scene *scene;
    const struct kd_plan *plan;
    const char *device; /* the text of kd_renderer_device_name */
    unsigned number;    /* number of the frame in a series, from 0 */
    unsigned lossy;     /* quality for a lossy format, 1 to 100; 0: KD_QUALITY */
    const char *hash;   /* hash of the scene, as kd_scene_hash; NULL or "": computed when needed */
};

enum kd_effort {
    /* for live views of many frames a second: 8 bits a channel, as fast as possible, without metadata */
    KD_EFFORT_LIVE,
    KD_EFFORT_QUICK, /* a file for which a client waits */
    KD_EFFORT_KEEP,  /* a file that is stored, so that small size matters more than time */
};

/* Bits for the parts that a frame must carry for a format. */
enum {
    KD_CARRIES_PICTURE = 1 /* layer "rgb" */,
    KD_CARRIES_LIGHT = 2 /* frame->light */,
    KD_CARRIES_LAYERS = 4 /* the layers named by image.layers, as numbers: linear light for the picture */
};

struct kd_format {
    const char *name;       /* "png": value of `format=` and file name extension; lower case */
    const char *media_type; /* "image/png" */
    const char *magic;      /* first bytes of each file; "": the first bytes vary */
    const char *end;        /* last bytes of each file; NULL: the last bytes vary */
    unsigned carries;
    bool live;  /* true if the format supports KD_EFFORT_LIVE */
    bool lossy; /* true if the format takes a quality */
    /* Adapts a scene so that its frame contains the data that the format needs; NULL: no change is necessary. Returns
     * KD_EINVAL at a field if the scene has no such data. */
    enum kd_status (*draws)(struct kd_scene *scene, struct kd_error *error);
    /* Memory that `encode` takes for a picture of this size besides the frame, counted in the plan's host_bytes; NULL:
     * little. */
    uint64_t (*bytes)(uint32_t width, uint32_t height);
    /* Appends a file to *out. *memory: state kept by this thread between calls, NULL at first; `forget` frees it.
     * Errors: KD_ENOMEM, or KD_EINVAL and KD_ETOOBIG for what the format cannot hold. */
    enum kd_status (*encode)(const struct kd_picture *picture, enum kd_effort effort, void **memory,
                             struct kd_buffer *out, struct kd_error *error);
    void (*forget)(void *memory); /* NULL: the format keeps no state */
    /* Reads the scene in a file of this format; *out is unchanged on error. NULL: files carry no scene. */
    enum kd_status (*scene)(const void *data, size_t size, struct kd_scene *out, struct kd_error *error);
};

#define KD_FORMATS(FORMAT) \
    FORMAT(png) FORMAT(jpg) FORMAT(webp) FORMAT(npy) FORMAT(npz) FORMAT(fits) FORMAT(exr) FORMAT(stars)
#define KD_FORMAT_DECLARE(name) extern const struct kd_format kd_format_##name;
KD_FORMATS(KD_FORMAT_DECLARE)
#undef KD_FORMAT_DECLARE

/* Format of the scenes' files that are joined to a cube. It is FITS with exactly the layers that image.layers names, so
 * that all scenes have the same layers. This format is not in the table. Defined in fits.c. */
extern const struct kd_format kd_format_cubed;

/* The first format is the default. Defined in formats.c. */
extern const struct kd_format *const kd_formats[];
extern const size_t kd_n_formats; /* number of formats, at most KD_FORMATS_MAX */
enum { KD_FORMATS_MAX = 16 };

const struct kd_format *kd_format_named(const char *name); /* returns NULL if there is no such format */
/* identifies a file by its first bytes; returns NULL if they match no format */
const struct kd_format *kd_format_of_bytes(const void *data, size_t size);
const struct kd_format *kd_format_live(void); /* the format of live views */

/* Returns KD_OK if the format can hold the scene's picture, otherwise the error that kd_format_plan would report. */
enum kd_status kd_format_holds(const struct kd_format *format, const struct kd_scene *scene, struct kd_error *error);

/* Plans a frame that carries what the format needs. Settings that neither affect the file nor are recorded in it
 * (auto exposure and layers) are removed from the scene. Errors are those of kd_plan_make and of the format's `draws`,
 * and KD_EINVAL at /image/layers if there are more layers than the format holds. */
enum kd_status kd_format_plan(const struct kd_format *format, struct kd_scene *scene,
                              const struct kd_capacity *capacity, struct kd_plan *out, struct kd_error *error);

/* Reads the scene in a picture of any format; returns KD_EINVAL if there is none. */
enum kd_status kd_format_scene(const void *data, size_t size, struct kd_scene *out, struct kd_error *error);

/* State that an encoding thread keeps between files; initialise with { 0 }. */
struct kd_encoder {
    const struct kd_format *of;
    void *memory;
};
/* Calls the format's encode. encoder: NULL for a single file. */
enum kd_status kd_encode(const struct kd_format *format, const struct kd_picture *picture, enum kd_effort effort,
                         struct kd_encoder *encoder, struct kd_buffer *out, struct kd_error *error);
void kd_encoder_finish(struct kd_encoder *encoder);

#endif
