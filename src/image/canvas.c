#include "image/canvas.h"

#include "image/font.h"

#include <math.h>
#include <string.h>

void kd_canvas_put(const struct kd_canvas *canvas, uint32_t x, uint32_t y, struct kd_map_colour colour)
{
    const double c[3] = { colour.r, colour.g, colour.b };
    size_t at = 3 * ((size_t)y * canvas->width + x);
    for (int i = 0; i < 3; i++) {
        if (canvas->bit_depth == 16)
            ((uint16_t *)canvas->pixels)[at + i] = (uint16_t)lround(65535 * c[i]);
        else
            ((uint8_t *)canvas->pixels)[at + i] = (uint8_t)lround(255 * c[i]);
    }
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

void kd_canvas_write(const struct kd_canvas *canvas, uint32_t x, uint32_t y, uint32_t end, uint32_t dot,
                     const char *text)
{
    for (; *text && x + KD_FONT_WIDTH * dot <= end; text++, x += KD_FONT_ADVANCE * dot)
        for (int j = 0; j < KD_FONT_HEIGHT; j++)
            for (int i = 0; i < KD_FONT_WIDTH; i++)
                if (kd_font_dot(*text, i, j))
                    kd_canvas_fill(canvas, x + (uint32_t)i * dot, y + (uint32_t)j * dot, dot, dot, KD_CANVAS_INK);
}

uint32_t kd_canvas_text_width(uint32_t dot, const char *text)
{
    size_t n = strlen(text);
    return n ? (uint32_t)(n * KD_FONT_ADVANCE - 1) * dot : 0;
}

uint32_t kd_canvas_dot(const struct kd_canvas *canvas, uint32_t width, uint32_t height)
{
    uint32_t dot = canvas->height / (7 * height), wide = canvas->width / width;
    dot = dot < wide ? dot : wide;
    return dot ? dot : 1;
}
