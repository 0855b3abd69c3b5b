/* Fields of a request for rays, one row each. Parsing, validation, query parameters and schema follow from these
 * rows. Private to src/render/rays and its tests. Constant data and pure functions, any thread. */
#ifndef KD_RENDER_RAYS_FIELDS_H
#define KD_RENDER_RAYS_FIELDS_H

#include "render/rays/request.h"
#include "scene/table.h"

enum kd_rays_kind {
    KD_RAYS_REAL,
    KD_RAYS_REAL_OR_WORD,
    KD_RAYS_INT,
    KD_RAYS_PROFILE,
    KD_RAYS_WORD_OR_AUTO,
    KD_RAYS_WORD_OR_NONE /* 0 if the word is not given */
};
enum kd_rays_open { KD_RAYS_CLOSED, KD_RAYS_OPEN, KD_RAYS_OPEN_BELOW };

struct kd_rays_field {
    const char *section, *name, *pointer; /* section: "" for fields at the top level of the document */
    enum kd_rays_kind kind;
    double least, most;
    enum kd_rays_open open; /* which of these bounds are excluded */
    int multiple;           /* a whole number must be a multiple of this; 0: any */
    const char *word;       /* word for INFINITY; NULL: none */
    const char *allowed;    /* valid values in words; NULL: those of the scene's field of this name */
    const char *help;
    size_t offset; /* in struct kd_rays_request: double, uint32_t or int */
};

enum { KD_RAYS_FIELDS = 16 };
extern const struct kd_rays_field kd_rays_fields[KD_RAYS_FIELDS];

/* Finds a field by the last part of its name; NULL if there is none. */
const struct kd_rays_field *kd_rays_field_find(const char *name);
/* The scene's field with the same words: that of the same name in the section "accuracy", or camera.observer. */
const struct kd_field *kd_rays_field_words(const struct kd_rays_field *field);
/* Checks a value against the bounds of the field of this name; KD_EINVAL with the valid range. */
enum kd_status kd_rays_field_check(const char *name, double value, struct kd_error *error);

#endif
