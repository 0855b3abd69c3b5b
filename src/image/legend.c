#include "image/legend.h"

#include "image/font.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Sizes in dots. */
enum {
    PADDING = 4,
    BAR_HEIGHT = 7,
    BAR_WIDTH = 112,
    TICK = 2,
    GAP = 3,
    MARGIN = 4,
    PANEL_WIDTH = BAR_WIDTH + 2 * PADDING +
        /* room at the ends of the bar, because the outermost numbers extend beyond it by half their length */
        4 * KD_FONT_ADVANCE,
    PANEL_HEIGHT = 2 * PADDING + 2 * KD_FONT_HEIGHT + BAR_HEIGHT + TICK + 2 * GAP,
};
_Static_assert(PANEL_WIDTH + 2 * MARGIN <= KD_LEGEND_LEAST_WIDTH && PANEL_HEIGHT + 2 * MARGIN <= KD_LEGEND_LEAST_HEIGHT,
               "it fits");

/* A panel on a canvas: its origin in pixels, the size of a dot in pixels, and its width in pixels. */
struct panel {
    const struct kd_canvas *canvas;
    uint32_t left, top, dot, width;
};

/* Fills a rectangle. x, y, width and height are in pixels, relative to the panel. */
static void fill(const struct panel *p, uint32_t x, uint32_t y, uint32_t width, uint32_t height,
                 struct kd_map_colour colour)
{
    kd_canvas_fill(p->canvas, p->left + x, p->top + y, width, height, colour);
}

static void write_text(const struct panel *p, uint32_t x, uint32_t y, const char *text)
{
    kd_canvas_write(p->canvas, p->left + x, p->top + y, p->left + p->width, p->dot, text);
}

/* Writes a text centred at x, shifted if necessary to stay inside the panel. */
static void write_centred(const struct panel *p, double x, uint32_t y, const char *text)
{
    double width = kd_canvas_text_width(p->dot, text), most = (double)p->width - width - p->dot;
    write_text(p, (uint32_t)fmax(fmin(x - 0.5 * width, most), p->dot), y, text);
}

/* Round numbers between the ends of a scale. On a linear scale they are multiples of a step; on a logarithmic scale
 * they are a few numbers in each decade. */
struct row {
    double step;
    const double *of_decade;
    int decades;
};

/* Writes a number with four digits. An exponent is used if it makes the text shorter by at least two characters. */
static void label(double value, char out[12])
{
    char plain[32], power[32];
    double size = value == 0 ? 0 : floor(log10(fabs(value)) + 1e-9);
    snprintf(plain, sizeof plain, "%.10g", value);
    snprintf(power, sizeof power, "%.4ge%d", value / pow(10, size), (int)size);
    snprintf(out, 12, "%.11s", strchr(plain, 'e') || strlen(power) + 2 <= strlen(plain) ? power : plain);
}

static size_t take(const struct kd_map_scale *scale, double value, struct kd_tick *out, size_t n)
{
    double place = kd_map_scale_place(scale, value);
    if (!(place >= -1e-9 && place <= 1 + 1e-9))
        return n;
    if (n < KD_LEGEND_TICKS) {
        out[n].value = value;
        label(value, out[n].label);
    }
    return n + 1;
}

static size_t numbers(const struct kd_map_scale *scale, const struct row *row, struct kd_tick out[KD_LEGEND_TICKS])
{
    double low = fmin(scale->low, scale->high), high = fmax(scale->low, scale->high);
    size_t n = 0;
    if (!row->of_decade) {
        for (double k = ceil(low / row->step - 1e-9); k * row->step <= high + 1e-9 * row->step && n <= KD_LEGEND_TICKS;
             k++)
            n = take(scale, k == 0 ? 0 : k * row->step, out, n);
        return n;
    }
    for (int e = (int)floor(log10(low)); e <= log10(high) && n <= KD_LEGEND_TICKS; e++)
        for (int i = 0; row->of_decade[i] > 0; i++)
            if (e % row->decades == 0)
                n = take(scale, row->of_decade[i] * pow(10, e), out, n);
    return n;
}

/* True if there is room for at least two characters between neighbouring numbers. */
static bool fit(const struct kd_map_scale *scale, double room, const struct kd_tick *ticks, size_t n)
{
    if (n > KD_LEGEND_TICKS)
        return false;
    for (size_t i = 1; i < n; i++) {
        double apart =
            fabs(kd_map_scale_place(scale, ticks[i].value) - kd_map_scale_place(scale, ticks[i - 1].value)) * room;
        if (apart < 0.5 * (double)(strlen(ticks[i].label) + strlen(ticks[i - 1].label)) + 1.5)
            return false;
    }
    return true;
}

static size_t logarithmic_ticks(const struct kd_map_scale *scale, double room, struct kd_tick out[KD_LEGEND_TICKS])
{
    static const double many[] = { 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 7, 8, 0 }, some[] = { 1, 1.5, 2, 3, 5, 7, 0 },
                        few[] = { 1, 2, 5, 0 }, ones[] = { 1, 0 };
    static const struct row rows[] = { { 0, many, 1 }, { 0, some, 1 }, { 0, few, 1 },  { 0, ones, 1 },
                                       { 0, ones, 2 }, { 0, ones, 3 }, { 0, ones, 5 }, { 0, ones, 10 } };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        size_t n = numbers(scale, &rows[i], out);
        if (fit(scale, room, out, n))
            return n;
    }
    return 0;
}

size_t kd_legend_ticks(const struct kd_map_scale *scale, double room, struct kd_tick out[KD_LEGEND_TICKS])
{
    double length = fabs(scale->high - scale->low), step = length > 0 ? pow(10, floor(log10(length)) - 1) : 1;
    if (!(length > 0) || !isfinite(length) || (scale->logarithmic && !(fmin(scale->low, scale->high) > 0)))
        return take(scale, scale->low, out, 0); /* the scale is not valid: one number or none */
    size_t n = scale->logarithmic ? logarithmic_ticks(scale, room, out) : 0;
    if (n > 1 || (n && fmax(scale->low, scale->high) > 10 * fmin(scale->low, scale->high)))
        return n;
    /* The steps that are tried are 1, 2, 5, 10, ... and 500 times the power of ten that lies between a hundredth and
     * a tenth of the bar's range. The finest step that fits is used. A logarithmic scale within one decade uses such
     * steps too. */
    static const double factors[] = { 1, 2, 5 };
    for (int i = 0; i < 9; i++) {
        const struct row row = { .step = step * factors[i % 3] * pow(10, i / 3) };
        n = numbers(scale, &row, out);
        if (n && fit(scale, room, out, n))
            return n;
    }
    /* numbers with many digits may not fit next to each other; then there is only one */
    return take(scale, scale->low, out, 0);
}

static void draw_bar(const struct panel *p, const struct kd_legend *legend, uint32_t x, uint32_t y)
{
    uint32_t width = BAR_WIDTH * p->dot, height = BAR_HEIGHT * p->dot, below = y + height + TICK * p->dot;
    struct kd_tick ticks[KD_LEGEND_TICKS];
    size_t n = kd_legend_ticks(&legend->scale, (double)BAR_WIDTH / KD_FONT_ADVANCE, ticks);
    for (uint32_t i = 0; i < width; i++)
        fill(p, x + i, y, 1, height, kd_colour_map_at(legend->map, i / (double)(width - 1)));
    for (size_t i = 0; i < n; i++) {
        double at = x + kd_map_scale_place(&legend->scale, ticks[i].value) * (width - 1);
        fill(p, (uint32_t)lround(at), y + height, p->dot > 1 ? p->dot / 2 : 1, TICK * p->dot, KD_CANVAS_INK);
        write_centred(p, at + 0.5, below + p->dot, ticks[i].label);
    }
}

/* Draws a box for each class, as many as fit into the panel. */
static void draw_classes(const struct panel *p, const struct kd_legend *legend, uint32_t x, uint32_t y)
{
    uint32_t n = legend->classes < 12 ? legend->classes : 12, each = BAR_WIDTH * p->dot / (n ? n : 1);
    for (uint32_t i = 0; i < n; i++) {
        char number[12];
        snprintf(number, sizeof number, "%u", i);
        fill(p, x + i * each, y, each - p->dot, BAR_HEIGHT * p->dot, kd_colour_map_at(KD_MAP_CATEGORICAL, i));
        write_centred(p, x + (i + 0.5) * each, y + (BAR_HEIGHT + TICK) * p->dot,
                      legend->names ? legend->names[i] : number);
    }
}

uint32_t kd_legend_dot(const struct kd_canvas *canvas)
{
    return kd_canvas_dot(canvas, PANEL_WIDTH + 2 * MARGIN, PANEL_HEIGHT);
}

/* Width of the panel: that of the bar or that of the title (which ends at `title_end`), limited by the picture's
 * width. */
static uint32_t panel_width(const struct kd_canvas *canvas, uint32_t dot, uint32_t title_end)
{
    const uint32_t least = PANEL_WIDTH * dot, most = canvas->width - 2 * MARGIN * dot,
                   wanted = title_end + PADDING * dot;
    return wanted < least ? least : wanted < most ? wanted : most;
}

bool kd_legend_draw(const struct kd_canvas *canvas, const struct kd_legend *legend)
{
    if (canvas->width < KD_LEGEND_LEAST_WIDTH || canvas->height < KD_LEGEND_LEAST_HEIGHT)
        return false;
    const uint32_t dot = kd_legend_dot(canvas);
    const uint32_t left = (PANEL_WIDTH - BAR_WIDTH) / 2 * dot, bar = (PADDING + KD_FONT_HEIGHT + GAP) * dot;
    const struct panel p = { canvas, MARGIN * dot, canvas->height - (PANEL_HEIGHT + MARGIN) * dot, dot,
                             panel_width(canvas, dot, left + kd_canvas_text_width(dot, legend->title)) };
    for (uint32_t y = 0; y < PANEL_HEIGHT * dot; y++)
        for (uint32_t x = 0; x < p.width; x++)
            kd_canvas_darken(canvas, p.left + x, p.top + y);
    write_text(&p, left, PADDING * dot, legend->title);
    (legend->map == KD_MAP_CATEGORICAL ? draw_classes : draw_bar)(&p, legend, left, bar);
    return true;
}
