/* These make of a PNG file what a terminal shows as a picture: kitty's graphics, or sixel. Any thread.
 *
 * https://sw.kovidgoyal.net/kitty/graphics-protocol/ and the DEC VT330/VT340 programmer reference manual, chapter
 * 14. */
#ifndef KD_CLI_SHOW_H
#define KD_CLI_SHOW_H

#include "base/buffer.h"
#include "base/error.h"

/* Appends the file as it is, as base64 in pieces of 4096 characters. columns: so many characters wide is it shown;
 * 0: as wide as it is. Inside tmux it reaches no terminal. KD_ENOMEM. */
enum kd_status kd_show_kitty(const struct kd_buffer *png, uint32_t columns, struct kd_buffer *out,
                             struct kd_error *error);

/* Appends the picture in 256 colours of its own, by libsixel, at this size. KD_ENOMEM, and what is wrong with the
 * file. */
enum kd_status kd_show_sixel(const struct kd_buffer *png, uint32_t width, uint32_t height, struct kd_buffer *out,
                             struct kd_error *error);

#endif
