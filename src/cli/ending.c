#include "cli/ending.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* maximum length of an extension; mktemp's names have ten random letters after a dot, which are no extension */
enum { LETTERS_MAX = 9 };

/* Other extensions that stand for one of kerrd's formats. */
static const struct {
    const char *ending, *format;
} synonyms[] = {
    { "fit", "fits" },     { "fts", "fits" }, { "txt", "text" },    { "jpeg", "jpg" },
    { "jsonl", "ndjson" }, { "wave", "wav" }, { "markdown", "md" },
};

static const char *const unfinished[] = {
    "tmp", "part", "new", "old",
    "bak", NULL
    /* extensions of temporary and backup files; they are accepted for all formats, because such a file was or will be
     * renamed */
};

static const char *find(const char *const words[], const char *word)
{
    while (*words && strcasecmp(*words, word))
        words++;
    return *words;
}

/* Copies the extension without its dot; "" if there is none. An extension begins with a letter. */
static void ending_of(const char *path, char out[LETTERS_MAX + 1])
{
    const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
    size_t n = dot ? strlen(dot + 1) : 0;
    bool counts = n && n <= LETTERS_MAX && isalpha((unsigned char)dot[1]);
    for (size_t i = 0; i < n && counts; i++)
        counts = isalnum((unsigned char)dot[1 + i]);
    snprintf(out, LETTERS_MAX + 1, "%s", counts ? dot + 1 : "");
}

_Noreturn static void refuse(const struct argp_state *state, const char *option, const char *path,
                             const char *const known[])
{
    char list[200] = "";
    for (size_t used = 0, i = 0; known[i] && used < sizeof list; i++)
        used += (size_t)snprintf(list + used, sizeof list - used, "%s.%s",
                                 !i             ? ""
                                 : known[i + 1] ? ", "
                                                : " or ",
                                 strcmp(known[i], "text") ? known[i] : "txt");
    argp_error(state, "%s is \"%s\"; the name must end in %s", option, path, list);
    exit(argp_err_exit_status); /* not reached, because argp_error exits */
}

const char *kd_cli_ending(const struct argp_state *state, const char *option, const char *path,
                          const char *const known[])
{
    char ending[LETTERS_MAX + 1];
    if (!path)
        return "";
    ending_of(path, ending);
    const char *format = ending;
    for (size_t i = 0; i < sizeof synonyms / sizeof *synonyms; i++)
        if (!strcasecmp(synonyms[i].ending, ending))
            format = synonyms[i].format;
    if (!*ending || find(unfinished, ending))
        return "";
    const char *found = find(known, format);
    if (!found)
        refuse(state, option, path, known);
    return found;
}

const char *kd_cli_ending_required(const struct argp_state *state, const char *option, const char *path,
                                   const char *const known[])
{
    const char *format = kd_cli_ending(state, option, path, known);
    if (!*format)
        refuse(state, option, path, known);
    return format;
}
