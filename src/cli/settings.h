/* The options of a program that serves may stand in a file, in the environment and among its flags. One table says
 * which there are; here each is checked, wherever it comes from, and kept by where it comes from: what counts is the
 * flag, else the environment, else the file, else the default. Main thread only.
 *
 * The option `client-share` is the flag --client-share, the member "client-share" of the file's object and the
 * variable KERRD_CLIENT_SHARE. */
#ifndef KD_CLI_SETTINGS_H
#define KD_CLI_SETTINGS_H

#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Kinds: in the file a NUMBER is a number, a SWITCH true or false, a LIST an array of strings, all else a string. In
 * the environment a LIST has commas between, a SWITCH is yes, no, true, false, 1 or 0. */
enum kd_setting_kind {
    KD_SETTING_TEXT,
    KD_SETTING_NUMBER, /* whole, from least to most */
    KD_SETTING_BYTES,  /* as 1536M or 2G */
    KD_SETTING_SWITCH,
    KD_SETTING_WORDS, /* one of "a|b|c": the argument's name */
    KD_SETTING_LIST,  /* texts; a flag may be repeated */
};
enum kd_setting_where { KD_SETTING_ANYWHERE, KD_SETTING_NOT_IN_FILE, KD_SETTING_FLAG };

struct kd_cli_setting {
    const char *name, *argument;
    enum kd_setting_kind kind;
    unsigned least, most;
    const char *initial; /* the default as text; NULL: none */
    enum kd_setting_where where;
    const char *doc;
};

enum kd_setting_source { KD_BY_FILE, KD_BY_ENVIRONMENT, KD_BY_FLAG, KD_SETTING_SOURCES };

struct kd_setting_values {
    const char **texts; /* NULL-terminated, each malloc'd */
    size_t n;
};
struct kd_settings {
    const struct kd_cli_setting *table;
    size_t n;
    struct kd_setting_values *values; /* KD_SETTING_SOURCES of each */
    char *file;                       /* that was read; NULL: none */
};

#define KD_SETTING_VARIABLE 48 /* room for the name of a variable, of which the longest is KERRD_ALLOW_CROSS_SITE */

enum kd_status kd_settings_init(struct kd_settings *settings, const struct kd_cli_setting *table, size_t n,
                                struct kd_error *error);
void kd_settings_finish(struct kd_settings *settings);

/* Whether an option may have a value, as text; if not, *allowed says what it may have (in room of 80 characters). */
bool kd_setting_takes(const struct kd_cli_setting *setting, const char *text, char allowed[80]);
/* Gives an option a value that it takes. A second one of the same source takes the first's place, but for a LIST's,
 * which has both. KD_ENOMEM. */
enum kd_status kd_settings_give(struct kd_settings *settings, size_t i, enum kd_setting_source source, const char *text,
                                struct kd_error *error);

/* settings_read.c. Errors are KD_EINVAL and name file or variable, option, value and what is allowed. */
/* Reads a JSON object; "-FILE" is FILE if it is there. */
enum kd_status kd_settings_read_file(struct kd_settings *settings, const char *path, struct kd_error *error);
/* Reads KERRD_... of the environment, of which an empty one is none. */
enum kd_status kd_settings_read_environment(struct kd_settings *settings, char *const *environment,
                                            struct kd_error *error);
/* Warns in the log of each KERRD_... that is none of these, nor one that kerrd knows otherwise. */
void kd_settings_warn(const struct kd_settings *settings, char *const *environment);
/* "KERRD_CLIENT_SHARE" */
void kd_setting_variable(const struct kd_cli_setting *setting, char out[KD_SETTING_VARIABLE]);

/* What counts of option i; NULL, 0, false: neither given nor has it a default. */
const char *kd_settings_text(const struct kd_settings *settings, size_t i);
unsigned kd_settings_number(const struct kd_settings *settings, size_t i);
uint64_t kd_settings_bytes(const struct kd_settings *settings, size_t i);
bool kd_settings_switch(const struct kd_settings *settings, size_t i);
const char *const *kd_settings_list(const struct kd_settings *settings, size_t i);

/* Writes to standard output, a line each, every option with its value and where that comes from. Returns an exit
 * code. Options name files of secrets and hold none. */
int kd_settings_show(const struct kd_settings *settings);

#endif
