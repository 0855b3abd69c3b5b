#include "image/canvas.h"

#include "image/font.h"

#include <math.h>

void kd_canvas_mix(const struct kd_canvas *canvas, uint32_t x, uint32_t y, struct kd_map_colour colour, double share)
{
    const double c[3] = { colour.r, colour.g, colour.b };
    const size_t at = 3 * ((size_t)y * canvas->width + x);
    uint16_t *deep = canvas->pixels;
    uint8_t *bytes = canvas->pixels;
    for (int i = 0; i < 3; i++) {
        if (canvas->bit_depth == 16)
            deep[at + i] = (uint16_t)lround((1 - share) * deep[at + i] + share * 65535 * c[i]);
        else
            bytes[at + i] = (uint8_t)lround((1 - share) * bytes[at + i] + share * 255 * c[i]);
    }
}

void kd_canvas_put(const struct kd_canvas *canvas, uint32_t x, uint32_t y, struct kd_map_colour colour)
{
    kd_canvas_mix(canvas, x, y, colour, 1);
}

void kd_canvas_darken(const struct kd_canvas *canvas, uint32_t x, uint32_t y)
{
    size_t at = 3 * ((size_t)y * canvas->width + x);
    for (int i = 0; i < 3; i++) {
        if (canvas->bit_depth == 16)
            ((uint16_t *)canvas->pixels)[at + i] /= 5;
        else
            ((uint8_t *)canvas->pixels)[at + i] /= 5;
    }
}

void kd_canvas_fill(const struct kd_canvas *canvas, uint32_t x, uint32_t y, uint32_t width, uint32_t height,
                    struct kd_map_colour colour)
{
    for (uint32_t j = 0; j < height; j++)
        for (uint32_t i = 0; i < width; i++)
            kd_canvas_put(canvas, x + i, y + j, colour);
}

static void write_letter(const struct kd_canvas *canvas, uint32_t x, uint32_t y, uint32_t dot, uint32_t letter)
{
    for (uint32_t j = 0; j < KD_FONT_HEIGHT * dot; j++)
        for (uint32_t i = 0; i < KD_FONT_WIDTH * dot; i++) {
            const double off = kd_font_distance(letter, (i + 0.5) / dot - 0.5, (j + 0.5) / dot - 0.5),
                         /* a stroke is one dot wide, and its edge is smoothed over one pixel */
                share = (0.5 - off) * dot + 0.5;
            if (share > 0)
                kd_canvas_mix(canvas, x + i, y + j, KD_CANVAS_INK, fmin(share, 1));
        }
}

void kd_canvas_write(const struct kd_canvas *canvas, uint32_t x, uint32_t y, uint32_t end, uint32_t dot,
                     const char *text)
{
    for (; *text && x + KD_FONT_WIDTH * dot <= end; x += KD_FONT_ADVANCE * dot)
        write_letter(canvas, x, y, dot, kd_font_next(&text));
}

uint32_t kd_canvas_text_width(uint32_t dot, const char *text)
{
    size_t n = 0;
    for (; *text; n++)
        kd_font_next(&text);
    return n ? (uint32_t)(n * KD_FONT_ADVANCE - 1) * dot : 0;
}

uint32_t kd_canvas_dot(const struct kd_canvas *canvas, uint32_t width, uint32_t height)
{
    uint32_t dot = canvas->height / (7 * height), wide = canvas->width / width;
    dot = dot < wide ? dot : wide;
    return dot ? dot : 1;
}
