#include "cli/code.h"

#include <qrencode.h>
#include <stdbool.h>
#include <string.h>

/* True if the module at this place is dark. A light quiet zone surrounds the code. It is two modules wide, which is
 * enough for scanners. ISO/IEC 18004 requires four modules, but small terminals have no room for them. */
static bool dark(const QRcode *code, int x, int y)
{
    return x >= 0 && y >= 0 && x < code->width && y < code->width && code->data[y * code->width + x] & 1;
}

enum { QUIET = 2 };

enum kd_status kd_cli_code(FILE *to, const char *text)
{
    static const char *const halves[2][2] = { { " ", "▄" },
                                              /* first index: 1 if the upper module is dark; second index: 1 if the
                                               * lower one is */
                                              { "▀", "█" } };
    QRcode *code = QRcode_encodeString8bit(text, 0, QR_ECLEVEL_M);
    if (!code)
        return KD_ENOMEM;
    for (int y = -QUIET; y < code->width + QUIET; y += 2) {
        fputs("\033[30;107m", to); /* black on white, as scanners require, whatever the terminal's colours are */
        for (int x = -QUIET; x < code->width + QUIET; x++)
            fputs(halves[dark(code, x, y)][dark(code, x, y + 1)], to);
        fputs("\033[0m\n", to);
    }
    QRcode_free(code);
    return KD_OK;
}

/* Ranks an address by its private network (RFC 1918). 172.16.0.0/12 comes last, because usually the machine's own
 * containers and virtual machines use it. */
static int likelihood(const char *name)
{
    static const char *const networks[] = { "192.168.", "10.", "172." };
    for (int i = 0; i < 3; i++)
        if (!strncmp(name, networks[i], strlen(networks[i])))
            return 4 - i;
    /* true for an address; addresses come before names, because a telephone may not be able to resolve a name */
    return strspn(name, "0123456789.") == strlen(name);
}

const char *kd_cli_code_of(const char *const *names)
{
    const char *best = NULL;
    for (; names && *names; names++)
        if (strncmp(*names, "127.", 4) && strcmp(*names, "[::1]") && (!best || likelihood(*names) > likelihood(best)))
            best = *names;
    return best;
}
