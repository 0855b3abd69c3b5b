/* Asks the terminal what pictures it can show, and how large it is. Main thread only. */
#ifndef KD_CLI_TERMINAL_H
#define KD_CLI_TERMINAL_H

#include <stdbool.h>
#include <stdint.h>

struct kd_terminal {
    bool is;                /* standard output is one */
    bool kitty, sixel;      /* it shows pictures so; asked for and answered */
    uint32_t width, height; /* of its text, in pixels; 0: it does not tell */
    uint32_t columns, rows; /* the same in characters */
};

/* Asks by escape sequences on /dev/tty, at most KD_TERMINAL_WAIT_MS for the answer: kitty's query of graphics, the
 * pixels of its text where the system does not know them, and the primary device attributes, which any terminal
 * tells and which come last. Its settings are as before afterwards. A terminal that does not answer can show
 * nothing. */
enum { KD_TERMINAL_WAIT_MS = 2000 };
struct kd_terminal kd_terminal_ask(void);

/* The largest size of the same shape that fits into the terminal with `lines` lines of text below it, not larger
 * than it is unless `enlarge`; as it is where the terminal's size is not known. At least one pixel. */
void kd_terminal_fit(const struct kd_terminal *terminal, uint32_t lines, bool enlarge, uint32_t *width,
                     uint32_t *height);

#endif
