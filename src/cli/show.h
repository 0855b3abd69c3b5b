/* Converts a PNG file for terminals, to kitty's graphics protocol or to sixel. Any thread.
 *
 * https://sw.kovidgoyal.net/kitty/graphics-protocol/ and the DEC VT330/VT340 programmer reference manual, chapter
 * 14. */
#ifndef KD_CLI_SHOW_H
#define KD_CLI_SHOW_H

#include "base/buffer.h"
#include "base/error.h"

/* Appends the file as base64, in pieces of 4096 characters. columns: width of the picture in characters; 0: the
 * picture has its own size. tmux does not forward the picture to the terminal. KD_ENOMEM. */
enum kd_status kd_show_kitty(const struct kd_buffer *png, uint32_t columns, struct kd_buffer *out,
                             struct kd_error *error);

/* Appends the picture, scaled to this size, in up to 256 colours that libsixel chooses. KD_ENOMEM, or the error of a
 * damaged file. */
enum kd_status kd_show_sixel(const struct kd_buffer *png, uint32_t width, uint32_t height, struct kd_buffer *out,
                             struct kd_error *error);

#endif
