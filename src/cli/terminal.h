/* Queries the terminal for its graphics protocols and its size. Main thread only. */
#ifndef KD_CLI_TERMINAL_H
#define KD_CLI_TERMINAL_H

#include <stdbool.h>
#include <stdint.h>

struct kd_terminal {
    bool is;                /* true if standard output is a terminal */
    bool kitty, sixel;      /* true for each protocol that the terminal has confirmed */
    uint32_t width, height; /* size of the text area in pixels; 0: unknown */
    uint32_t columns, rows; /* size of the text area in characters */
};

/* Sends queries as escape sequences to /dev/tty, and waits at most KD_TERMINAL_WAIT_MS for the answers. There are up
 * to three queries: kitty's graphics query; the size of the text area in pixels, if the system does not report it;
 * and last the primary device attributes, which every terminal answers. Afterwards the terminal's settings are
 * restored. A terminal that does not answer counts as having no graphics protocol. */
enum { KD_TERMINAL_WAIT_MS = 2000 };
struct kd_terminal kd_terminal_ask(void);

/* Computes the largest size that fits into the terminal above `lines` lines of text. The size has the same aspect
 * ratio and is at least one pixel. If `enlarge` is false, it does not exceed the given size. If the terminal's size
 * is unknown, the given size is kept. */
void kd_terminal_fit(const struct kd_terminal *terminal, uint32_t lines, bool enlarge, uint32_t *width,
                     uint32_t *height);

#endif
