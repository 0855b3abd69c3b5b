/* XMP: metadata of a JPEG or WebP, and of a panorama in any picture. The packet has the notes of the picture,
 * including the scene, in kerrd's own namespace. For a 360-degree picture it also has the properties of GPano, by
 * which viewers recognise a panorama (https://developers.google.com/streetview/spherical-metadata). Any thread. */
#ifndef KD_RENDER_OUTPUT_XMP_H
#define KD_RENDER_OUTPUT_XMP_H

#include "render/output/notes.h"

/* Appends a packet. With n_notes 0, only the properties of GPano are written, and nothing if the picture is not a
 * panorama. The only error is KD_ENOMEM. */
enum kd_status kd_xmp_put(const struct kd_picture *picture, const struct kd_note *notes, size_t n_notes,
                          struct kd_buffer *out);

/* Reads the scene in a packet that kerrd wrote; *out is unchanged on error. Returns KD_EINVAL if there is none. */
enum kd_status kd_xmp_scene(const void *xmp, size_t size, struct kd_scene *out, struct kd_error *error);

#endif
