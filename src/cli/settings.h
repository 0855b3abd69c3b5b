/* Settings of a server program, from flags, the environment and a configuration file. One table is used to check all
 * three. A flag overrides the environment, the environment overrides the file, and the file overrides the default.
 * Main thread only.
 * The option `client-share` is the flag --client-share, the member "client-share" of the file's object, and the
 * environment variable KERRD_CLIENT_SHARE. */
#ifndef KD_CLI_SETTINGS_H
#define KD_CLI_SETTINGS_H

#include "base/error.h"
#include "document/value.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Kinds of settings. In the file, a NUMBER is a number, a SWITCH is true or false, a LIST is an array of strings,
 * and all other kinds are strings. In the environment, the texts of a LIST are separated by commas, and a SWITCH is
 * yes, no, true, false, 1 or 0. */
enum kd_setting_kind {
    KD_SETTING_TEXT,
    KD_SETTING_NUMBER, /* a whole number in the range least to most */
    KD_SETTING_BYTES,  /* a size, such as 1536M or 2G */
    KD_SETTING_SWITCH,
    KD_SETTING_WORDS, /* one of the words that `argument` lists as "a|b|c" */
    KD_SETTING_LIST,  /* several texts; the flag may be repeated */
};
enum kd_setting_where { KD_SETTING_ANYWHERE, KD_SETTING_NOT_IN_FILE, KD_SETTING_FLAG };

enum { KD_SETTINGS_MOST = 64 }; /* maximum number of settings in a table */
struct kd_cli_setting {
    const char *name, *argument;
    enum kd_setting_kind kind;
    unsigned least, most;
    const char *initial; /* default value as text; NULL if there is none */
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
    struct kd_setting_values *values; /* KD_SETTING_SOURCES consecutive entries for each setting */
    char *file;                       /* the configuration file that was read; NULL if none */
};

/* Room for the name of a variable. The longest is KERRD_ALLOW_CROSS_SITE. */
#define KD_SETTING_VARIABLE 48

enum kd_status kd_settings_init(struct kd_settings *settings, const struct kd_cli_setting *table, size_t n,
                                struct kd_error *error);
void kd_settings_finish(struct kd_settings *settings);

/* True if the setting accepts the value. If it does not, `allowed` gets a description of the accepted values. */
bool kd_setting_takes(const struct kd_cli_setting *setting, const char *text, char allowed[KD_ALLOWED_SIZE]);
/* Stores an accepted value. The value replaces an earlier one from the same source; in a LIST it is appended.
 * KD_ENOMEM. */
enum kd_status kd_settings_give(struct kd_settings *settings, size_t i, enum kd_setting_source source, const char *text,
                                struct kd_error *error);

/* The next three functions are in settings_read.c. Their error is KD_EINVAL with a message that contains the file or
 * variable, the option, the value and the accepted values. */
/* Reads a configuration file, which is a JSON object. A path "-FILE" means: read FILE only if it exists. */
enum kd_status kd_settings_read_file(struct kd_settings *settings, const char *path, struct kd_error *error);
/* Reads the environment variables KERRD_...; empty variables are ignored. */
enum kd_status kd_settings_read_environment(struct kd_settings *settings, char *const *environment,
                                            struct kd_error *error);
/* Logs a warning for each unknown environment variable KERRD_... */
void kd_settings_warn(const struct kd_settings *settings, char *const *environment);
/* Makes the name of a setting's environment variable, such as "KERRD_CLIENT_SHARE". */
void kd_setting_variable(const struct kd_cli_setting *setting, char out[KD_SETTING_VARIABLE]);

/* Value of setting i that is in effect. If the setting was not given and has no default, the result is NULL, 0 or
 * false. */
const char *kd_settings_text(const struct kd_settings *settings, size_t i);
unsigned kd_settings_number(const struct kd_settings *settings, size_t i);
uint64_t kd_settings_bytes(const struct kd_settings *settings, size_t i);
bool kd_settings_switch(const struct kd_settings *settings, size_t i);
const char *const *kd_settings_list(const struct kd_settings *settings, size_t i);

/* Writes all settings to standard output, one per line, each with its value and source. Returns an exit code. No
 * value is a secret: for secrets, only the names of files are shown. */
int kd_settings_show(const struct kd_settings *settings);

#endif
