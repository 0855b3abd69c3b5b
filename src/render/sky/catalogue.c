/* Embeds the catalogue data/hipparcos.stars in the program, byte by byte. */
#include "render/sky/star.h"

#include <math.h>
#include <stdint.h>

enum { ROW = 12 };

__asm__(".pushsection .rodata\n"
        ".global kd_hipparcos\n"
        ".hidden kd_hipparcos\n"
        "kd_hipparcos:\n"
        ".incbin \"" KD_HIPPARCOS "\"\n"
        ".global kd_hipparcos_end\n"
        ".hidden kd_hipparcos_end\n"
        "kd_hipparcos_end:\n"
        ".byte 0\n"
        ".popsection\n");
extern const uint8_t kd_hipparcos[];

static uint32_t word(const uint8_t *p)
{
    return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}
static double thousandths(const uint8_t *p) { return (int16_t)(p[0] | p[1] << 8) / 1000.0; }

struct kd_catalogue_star kd_catalogue_star(size_t k)
{
    const uint8_t *row = kd_hipparcos + ROW * k;
    const double turn = 2 * M_PI / 4294967296.0;
    return (struct kd_catalogue_star) { turn * word(row), turn * (int32_t)word(row + 4), thousandths(row + 8),
                                        thousandths(row + 10) };
}
