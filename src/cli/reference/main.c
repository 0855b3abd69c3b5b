/* A program that prints completions, manual pages and docs/options.md from the option tables. */
#include "cli/file.h"
#include "cli/reference/completions.h"
#include "cli/reference/manual.h"
#include "cli/reference/settings.h"

#include <stdio.h>
#include <string.h>

static const char usage[] =
    "kd_cli_reference bash|zsh|fish FILE   completions for that shell: tables, and the functions of FILE\n"
    "kd_cli_reference man [COMMAND]        the manual page of kerrd, or of one of its commands\n"
    "kd_cli_reference options              docs/options.md\n";
static const struct {
    const char *name;
    void (*write)(struct kd_writer *w);
} shells[] = { { "bash", kd_completions_bash }, { "zsh", kd_completions_zsh }, { "fish", kd_completions_fish } };

static bool write_shell(struct kd_writer *w, const char *name, const char *functions)
{
    struct kd_error error = { 0 };
    for (size_t i = 0; i < sizeof shells / sizeof *shells; i++) {
        if (strcmp(name, shells[i].name))
            continue;
        shells[i].write(w);
        if (!w->status && (w->status = kd_file_read(functions, (size_t)1 << 20, w->out, &error)))
            fprintf(stderr, "%s\n", error.message);
        return true;
    }
    return false;
}

int main(int argc, char **argv)
{
    struct kd_buffer page = { 0 };
    struct kd_writer writer = { .out = &page };
    const char *what = argc > 1 ? argv[1] : "";
    const bool options = !strcmp(what, "options") && argc == 2;
    if (options)
        kd_settings_page(&writer);
    const bool known = options                ? true
                       : !strcmp(what, "man") ? argc < 4 && kd_manual_page(&writer, argv[2])
                                              : argc == 3 && write_shell(&writer, what, argv[2]);
    if (!known)
        fputs(usage, stderr);
    int failed = !known || writer.status || fwrite(page.data, 1, page.size, stdout) != page.size || fflush(stdout);
    kd_buffer_finish(&page);
    return failed ? 1 : 0;
}
