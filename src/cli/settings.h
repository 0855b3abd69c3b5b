/* Settings of a server program from flags, environment and a configuration file, checked by one table. A flag overrides
 * the environment, which overrides the file, which overrides the default. Main thread only.
 *
 * The option `client-share` is the flag --client-share, the member "client-share" of the file's object, and the
 * variable KERRD_CLIENT_SHARE. */
#ifndef KD_CLI_SETTINGS_H
#define KD_CLI_SETTINGS_H

#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Kinds. In the file a NUMBER is a number, a SWITCH true or false, a LIST an array of strings, others a string. In the
 * environment a LIST is separated by commas, a SWITCH is yes, no, true, false, 1 or 0. */
enum kd_setting_kind {
    KD_SETTING_TEXT,
    KD_SETTING_NUMBER, /* whole, from least to most */
    KD_SETTING_BYTES,  /* such as 1536M or 2G */
    KD_SETTING_SWITCH,
    KD_SETTING_WORDS, /* one of the words "a|b|c" in `argument` */
    KD_SETTING_LIST,  /* texts; the flag may be repeated */
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
    struct kd_setting_values *values; /* KD_SETTING_SOURCES entries for each setting */
    char *file;                       /* configuration file that was read; NULL: none */
};

#define KD_SETTING_VARIABLE 48 /* size of the longest variable name, KERRD_ALLOW_CROSS_SITE, with some reserve */

enum kd_status kd_settings_init(struct kd_settings *settings, const struct kd_cli_setting *table, size_t n,
                                struct kd_error *error);
void kd_settings_finish(struct kd_settings *settings);

/* Whether a setting accepts a value; if not, `allowed` receives what it accepts (80 characters). */
bool kd_setting_takes(const struct kd_cli_setting *setting, const char *text, char allowed[80]);
/* Stores an accepted value. A second value of the same source replaces the first, but is appended to a LIST.
 * KD_ENOMEM. */
enum kd_status kd_settings_give(struct kd_settings *settings, size_t i, enum kd_setting_source source, const char *text,
                                struct kd_error *error);

/* Functions of settings_read.c. Errors are KD_EINVAL and name the file or variable, the option, the value and what is
 * accepted. */
/* Reads a JSON object; "-FILE" reads FILE if it exists. */
enum kd_status kd_settings_read_file(struct kd_settings *settings, const char *path, struct kd_error *error);
/* Reads the variables KERRD_...; empty ones are ignored. */
enum kd_status kd_settings_read_environment(struct kd_settings *settings, char *const *environment,
                                            struct kd_error *error);
/* Logs a warning for each variable KERRD_... that is unknown. */
void kd_settings_warn(const struct kd_settings *settings, char *const *environment);
/* Name of the environment variable, such as "KERRD_CLIENT_SHARE". */
void kd_setting_variable(const struct kd_cli_setting *setting, char out[KD_SETTING_VARIABLE]);

/* Effective value of setting i; NULL, 0 or false if it is neither given nor has a default. */
const char *kd_settings_text(const struct kd_settings *settings, size_t i);
unsigned kd_settings_number(const struct kd_settings *settings, size_t i);
uint64_t kd_settings_bytes(const struct kd_settings *settings, size_t i);
bool kd_settings_switch(const struct kd_settings *settings, size_t i);
const char *const *kd_settings_list(const struct kd_settings *settings, size_t i);

/* Writes every setting with its value and source to standard output, one on each line. Returns an exit code. Values
 * contain no secrets, only names of files that hold them. */
int kd_settings_show(const struct kd_settings *settings);

#endif
