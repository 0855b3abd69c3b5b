/* Preloaded by tests/cli/render.py: reports the C library's version as that of Debian 11. */
const char *gnu_get_libc_version(void);

const char *gnu_get_libc_version(void) { return "2.31"; }
