/* Embeds data/hipparcos.names in the program, byte by byte. */
#include "render/sky/star_names.h"

#include <stdlib.h>
#include <string.h>

__asm__(".pushsection .rodata\n"
        ".global kd_hipparcos_names\n"
        ".hidden kd_hipparcos_names\n"
        "kd_hipparcos_names:\n"
        ".incbin \"" KD_HIPPARCOS_NAMES "\"\n"
        ".byte 0\n"
        ".popsection\n");
extern const char kd_hipparcos_names[];

/* Copies the text up to `end` and returns the place after it. */
static const char *take(const char *from, char end, char out[KD_STAR_NAME])
{
    size_t n = strcspn(from, (const char[]) { end, 0 }), most = n < KD_STAR_NAME ? n : KD_STAR_NAME - 1;
    memcpy(out, from, most);
    out[most] = 0;
    return from + n + 1;
}

void kd_star_name_next(const char **text, struct kd_star_name *out)
{
    char *digits;
    const char *p = *text ? *text : kd_hipparcos_names;
    if (!*p) {
        *text = NULL;
        return;
    }
    out->place = strtoul(p, &digits, 10);
    p = take(digits + 1, '\t', out->name);
    *text = take(p, '\n', out->designation);
}
