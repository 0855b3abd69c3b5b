/* Preloaded: makes the program believe that the C library is that of Debian 11 (tests/cli/render.py). */
const char *gnu_get_libc_version(void);

const char *gnu_get_libc_version(void) { return "2.31"; }
