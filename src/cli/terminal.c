#include "cli/terminal.h"

#include "base/clock.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#define ESC "\033"
/* queries support by sending a picture of one pixel, which the terminal does not store */
#define KITTY_QUERY ESC "_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA" ESC "\\"
#define KITTY_ANSWER ESC "_Gi=31;OK" ESC "\\"
#define PIXELS_QUERY ESC "[14t" /* the terminal answers with the size of its text area: ESC [ 4 ; HEIGHT ; WIDTH t */
/* the terminal answers with its attributes, for example ESC [ ? 62 ; 4 ; 22 c, where 4 means sixel */
#define ATTRIBUTES_QUERY ESC "[c"
enum { ANSWER_SIZE = 1024, CTRL_C = 3 };

/* Finds the answer to ATTRIBUTES_QUERY. Returns NULL if it has not arrived yet. */
static const char *attributes_in(const char *answer)
{
    for (const char *at = answer; (at = strstr(at, ESC "[?")); at++) {
        const char *text = at + 3;
        if (text[strspn(text, "0123456789;")] == 'c')
            return text;
    }
    return NULL;
}

static bool has_attribute(const char *attributes, long wanted)
{
    while (*attributes != 'c') {
        char *end;
        if (strtol(attributes, &end, 10) == wanted && end > attributes)
            return true;
        attributes = *end == ';' ? end + 1 : end;
    }
    return false;
}

/* Reads until the answer to ATTRIBUTES_QUERY has arrived, or the time is over. Returns true if Ctrl-C was typed. */
static bool listen(int fd, char answer[ANSWER_SIZE])
{
    const double end = kd_clock_ms() + KD_TERMINAL_WAIT_MS;
    size_t used = 0;
    *answer = 0;
    while (used + 1 < ANSWER_SIZE && !attributes_in(answer)) {
        struct pollfd ready = { .fd = fd, .events = POLLIN };
        const double left = end - kd_clock_ms();
        const int n = left > 0 ? poll(&ready, 1, (int)ceil(left)) : 0;
        if (n < 0 && errno == EINTR)
            continue;
        const ssize_t got = n > 0 ? read(fd, answer + used, ANSWER_SIZE - 1 - used) : 0;
        if (got <= 0)
            return false;
        if (memchr(answer + used, CTRL_C, (size_t)got))
            return true;
        used += (size_t)got;
        answer[used] = 0;
    }
    return false;
}

/* Sends `query` and reads the answer; "" if there is none. During this, echo is off, and so are the keys that send
 * signals, because a signal could leave the terminal in raw mode. */
static void ask(int fd, const char *query, char answer[ANSWER_SIZE])
{
    struct termios before, raw;
    *answer = 0;
    if (tcgetattr(fd, &before))
        return;
    raw = before;
    raw.c_lflag &= ~(tcflag_t)(ICANON | ECHO | ISIG);
    raw.c_cc[VMIN] = 1;
    raw.c_cc[VTIME] = 0;
    if (tcsetattr(fd, TCSADRAIN, &raw))
        return;
    bool stop = false;
    if (write(fd, query, strlen(query)) == (ssize_t)strlen(query))
        stop = listen(fd, answer);
    tcsetattr(fd, TCSADRAIN, &before);
    if (stop)
        raise(SIGINT);
}

static void read_size(int fd, struct kd_terminal *t)
{
    struct winsize size;
    if (ioctl(fd, TIOCGWINSZ, &size))
        return;
    t->columns = size.ws_col;
    t->rows = size.ws_row;
    t->width = size.ws_xpixel;
    t->height = size.ws_ypixel;
}

static void read_answer(const char *answer, struct kd_terminal *t)
{
    const char *attributes = attributes_in(answer), *kitty = strstr(answer, KITTY_ANSWER);
    unsigned width, height;
    t->kitty = kitty && attributes && kitty < attributes;
    t->sixel = attributes && has_attribute(attributes, 4);
    for (const char *at = answer; (!t->width || !t->height) && (at = strstr(at, ESC "[4;")); at++)
        if (sscanf(at, ESC "[4;%5u;%5ut", &height, &width) == 2)
            t->width = width, t->height = height;
}

struct kd_terminal kd_terminal_ask(void)
{
    struct kd_terminal t = { .is = isatty(STDOUT_FILENO) };
    char answer[ANSWER_SIZE];
    const int fd = t.is ? open("/dev/tty", O_RDWR | O_NOCTTY | O_CLOEXEC) : -1;
    if (fd < 0)
        return t;
    read_size(fd, &t);
    ask(fd, t.width && t.height ? KITTY_QUERY ATTRIBUTES_QUERY : KITTY_QUERY PIXELS_QUERY ATTRIBUTES_QUERY, answer);
    read_answer(answer, &t);
    close(fd);
    return t;
}

void kd_terminal_fit(const struct kd_terminal *t, uint32_t lines, bool enlarge, uint32_t *width, uint32_t *height)
{
    if (!t->width || !t->height)
        return;
    const double line = t->rows ? (double)t->height / t->rows : 0, room = fmax(t->height - lines * line, line);
    double scale = fmin((double)t->width / *width, room / *height);
    if (scale > 1 && !enlarge)
        scale = 1;
    *width = (uint32_t)fmax(*width * scale + 1e-9, 1);
    *height = (uint32_t)fmax(*height * scale + 1e-9, 1);
}
