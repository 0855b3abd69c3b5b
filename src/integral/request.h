/* This reads what is asked of the integrals over a thin disk, or over pictures of a scene: a JSON document, or
 * fields by name. The table of fields (fields.c) is the source of the reader, the options of the command line and
 * the schemas of openapi.json. Any thread.
 *
 *     {"spin": 0.9, "inclination_deg": 60, "emissivity": "power", "index": 3, "energy_min": 0.1, "energy_max": 1.5,
 *       "bins": 500}
 * / */
#ifndef KD_INTEGRAL_REQUEST_H
#define KD_INTEGRAL_REQUEST_H

#include "base/error.h"
#include "base/json.h"
#include "physics/line_profile.h"
#include "scene/asset.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define KD_INTEGRAL_BODY_MAX ((size_t)1 << 20) /* bytes of a document */
#define KD_INTEGRAL_ROWS 20000u                /* of an answer */
#define KD_INTEGRAL_LIST 20001u                /* numbers of a list */
#define KD_INTEGRAL_TRANSFERS 5000u            /* rows of a transfer function: 0.1 ms each */
#define KD_INTEGRAL_FREQUENCIES 1000u
#define KD_INTEGRAL_PICTURES 200u /* frequencies of a spectrum that is made of pictures, */
#define KD_INTEGRAL_LEAST_HZ 1e3  /* from here ... */
#define KD_INTEGRAL_MOST_HZ 1e21  /* ... to here, as volume.frequency_ghz */
#define KD_INTEGRAL_FACE_ON 0.1   /* degrees off the axis, within which no ring has a transfer function */
#define KD_INTEGRAL_ORDERS 8u     /* image orders that are told apart */

/* VOLUME is what SPECTRUM becomes when a scene is given. These last two are made of pictures (integral/run.h). */
enum kd_integral {
    KD_INTEGRAL_LINE,
    KD_INTEGRAL_TRANSFER,
    KD_INTEGRAL_SPECTRUM,
    KD_INTEGRAL_VOLUME,
    KD_INTEGRAL_VISIBILITY,
    KD_INTEGRALS
};

struct kd_integral_list {
    double *at; /* malloc'd */
    size_t n;
};

struct kd_integral_request {
    enum kd_integral what;
    double spin, inclination_deg, inner, outer; /* inner: NaN: the ISCO */
    enum kd_line_emissivity emissivity;
    double index, outer_index, break_r, height, photon_index, tolerance;
    enum kd_line_limb limb;
    int energy;                                 /* 0: photons, 1: energy */
    double rest_energy, energy_min, energy_max; /* energy_max: NaN: 1.7 rest_energy */
    uint32_t bins;
    struct kd_integral_list edges;
    struct kd_integral_list radii, g_star; /* of a transfer function */
    uint32_t rings, g_stars;
    double mass_msun, distance_pc, mdot_edd, colour_correction; /* of a spectrum */
    double frequency_min_hz, frequency_max_hz;                  /* NaN: by the hottest ring */
    uint32_t frequencies;
    struct kd_integral_list frequencies_hz;
    struct kd_scene *scene;         /* malloc'd; NULL: none is given */
    const struct kd_assets *assets; /* by which its names of assets are resolved as it is read; NULL: whoever reads it
                                       resolves and validates it */
    uint32_t pixels;                /* of the longer side of a picture; 0: as many as are usual */
    int unchecked;                  /* 0: finer pictures tell the error */
    struct kd_integral_list u, v, lengths,
        angles_deg;    /* of a visibility, Gl: a list of baselines, or lengths by angles, which become one */
    double length_max; /* NaN: half of what the pixels resolve */
    uint32_t baselines, orders;
    uint64_t seen; /* which fields were given, a bit each */
};

/* Whether it is made of pictures. */
static inline bool kd_integral_is_pictured(enum kd_integral what) { return what >= KD_INTEGRAL_VOLUME; }

void kd_integral_request_init(struct kd_integral_request *request, enum kd_integral what);
void kd_integral_request_finish(struct kd_integral_request *request);

/* What a document says, over what is there. KD_EINVAL without a pointer: this is no JSON document. */
enum kd_status kd_integral_request_read(struct kd_integral_request *request, const char *text, size_t length,
                                        struct kd_error *error);
/* The same, and kd_integral_request_check. */
enum kd_status kd_integral_request_json(struct kd_integral_request *request, const char *text, size_t length,
                                        struct kd_error *error);

/* One field by its name; lists as numbers with commas between them. */
enum kd_status kd_integral_request_set(struct kd_integral_request *request, const char *name, const char *text,
                                       struct kd_error *error);
/* After the last of them: fills in what follows from others, and checks what ties them together. */
enum kd_status kd_integral_request_check(struct kd_integral_request *request, struct kd_error *error);

/* Fields for whoever lists them. */
enum kd_integral_kind { KD_INTEGRAL_REAL, KD_INTEGRAL_WHOLE, KD_INTEGRAL_WORD, KD_INTEGRAL_NUMBERS };
struct kd_integral_field {
    const char *name, *unit, *help;
    enum kd_integral_kind kind;
    size_t offset;
    double least, most;
    bool open;         /* neither end is allowed */
    const char *words; /* "a|b": WORD; REAL: a word that stands for NaN */
    unsigned of;       /* a bit for each integral that has it */
    bool lacks;        /* a request that has been checked may have no number for it */
};
extern const struct kd_integral_field kd_integral_fields[];
extern const size_t kd_n_integral_fields;

/* The name as in /v1/NAME, and what such a path stands for. */
const char *kd_integral_name(enum kd_integral what);
enum kd_integral kd_integral_of_route(const char *path);

/* Rows of the answer to a request that has been checked. */
size_t kd_integral_rows(const struct kd_integral_request *request);

/* Writes the value of a field that is no list. */
void kd_integral_field_write(struct kd_json *json, const struct kd_integral_request *request,
                             const struct kd_integral_field *field);

/* The schema of a request's document, as the member `name`. */
void kd_integral_request_schema(struct kd_json *json, const char *name, enum kd_integral what);

#endif
