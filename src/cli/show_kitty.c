/* Converts a picture to kitty's graphics protocol. */
#include "cli/show.h"

#include "playground/base64.h"

#include <stdio.h>

enum { PIECE = 4096, PIECE_BYTES = PIECE / 4 * 3 };

enum kd_status kd_show_kitty(const struct kd_buffer *png, uint32_t columns, struct kd_buffer *out,
                             struct kd_error *error)
{
    enum kd_status status;
    char text[PIECE + 1], width[20] = "";
    if (columns)
        snprintf(width, sizeof width, ",c=%u", columns);
    for (size_t at = 0; at < png->size; at += PIECE_BYTES) {
        const size_t left = png->size - at, n = left < PIECE_BYTES ? left : PIECE_BYTES;
        const int more = left > n;
        kd_base64_write(text, png->data + at, n);
        if (at)
            status = kd_buffer_printf(out, "\033_Gm=%d;%s\033\\", more, text);
        else /* a=T: show the picture at once; f=100: the format is PNG; q=2: the terminal sends no answer */
            status = kd_buffer_printf(out, "\033_Ga=T,f=100,q=2%s,m=%d;%s\033\\", width, more, text);
        if (status)
            return kd_error_set(error, status, "out of memory for the picture");
    }
    return KD_OK;
}
