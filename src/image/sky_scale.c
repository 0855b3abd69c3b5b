#include "image/sky_scale.h"

#include "image/font.h"
#include "image/legend.h"

#include <math.h>
#include <stdio.h>

enum { MARGIN = 6, GAP = 3, TICK = 3 }; /* in dots */

double kd_sky_scale_bar(const struct kd_sky_scale *scale, uint32_t width)
{
    const double most = 0.25 * width * scale->pixel_uas, decade = pow(10, floor(log10(most)));
    return most >= 5 * decade ? 5 * decade : most >= 2 * decade ? 2 * decade : decade;
}

struct bar {
    char text[24];
    uint32_t length, wide; /* in pixels: length of the line, and width of the text */
};

static struct bar bar_of(const struct kd_sky_scale *scale, uint32_t width, uint32_t dot)
{
    struct bar bar;
    const double uas = kd_sky_scale_bar(scale, width);
    snprintf(bar.text, sizeof bar.text, "%.6g µas", uas);
    bar.length = (uint32_t)fmax(lround(uas / scale->pixel_uas), 1);
    bar.wide = kd_canvas_text_width(dot, bar.text);
    return bar;
}

/* Draws a line with ticks at its ends and its length below. right: the line's right end. top: its upper edge.
 * Returns the lower edge of the drawing. */
static uint32_t draw_bar(const struct kd_canvas *c, const struct bar *bar, uint32_t dot, uint32_t right, uint32_t top)
{
    const uint32_t line = dot > 1 ? dot / 2 : 1, tick = TICK * dot, text = top + tick + GAP * dot;
    const uint32_t left = right - bar->length, middle = left + bar->length / 2, half = bar->wide / 2;
    kd_canvas_fill(c, left, top + tick / 2, bar->length, line, KD_CANVAS_INK);
    kd_canvas_fill(c, left, top, line, tick, KD_CANVAS_INK);
    kd_canvas_fill(c, right - line, top, line, tick, KD_CANVAS_INK);
    kd_canvas_write(c, middle + half > right ? right - bar->wide : middle - half, text, c->width, dot, bar->text);
    return text + KD_FONT_HEIGHT * dot;
}

/* Draws a grey disk round (x0, y0) with an edge in the colour of the lines, so that it is visible on any background. */
static void draw_beam(const struct kd_canvas *c, double radius, double line, double x0, double y0)
{
    static const struct kd_map_colour grey = { 0.45, 0.45, 0.45 };
    for (uint32_t y = (uint32_t)fmax(floor(y0 - radius), 0); y < c->height && y < y0 + radius; y++)
        for (uint32_t x = (uint32_t)fmax(floor(x0 - radius), 0); x < c->width && x < x0 + radius; x++) {
            const double r = hypot(x + 0.5 - x0, y + 0.5 - y0), inside = fmin(fmax(radius - r + 0.5, 0), 1);
            kd_canvas_mix(c, x, y, grey, inside);
            kd_canvas_mix(c, x, y, KD_CANVAS_INK, inside * fmin(fmax(r - radius + line + 0.5, 0), 1));
        }
}

bool kd_sky_scale_draw(const struct kd_canvas *canvas, const struct kd_sky_scale *scale)
{
    if (canvas->width < KD_LEGEND_LEAST_WIDTH || canvas->height < KD_LEGEND_LEAST_HEIGHT)
        return false;
    const uint32_t dot = kd_legend_dot(canvas), right = canvas->width - MARGIN * dot;
    const struct bar bar = bar_of(scale, canvas->width, dot);
    const uint32_t bottom = draw_bar(canvas, &bar, dot, right, MARGIN * dot);
    const double radius = 0.5 * scale->beam_uas / scale->pixel_uas;
    if (radius >= 1 && radius <= 0.125 * fmin(canvas->width, canvas->height))
        draw_beam(canvas, radius, fmax(0.5 * dot, 1), right - radius, bottom + GAP * dot + radius);
    return true;
}
