#include "cli/reference/settings.h"

#include "cli/serve_settings.h"

#include <string.h>

/* Writes text into a cell of a table, and escapes the bar and the bracket. */
static void write_cell(struct kd_writer *w, const char *text)
{
    for (; *text; text++)
        kd_write(w, *text == '|' || *text == '<' ? "\\%c" : "%c", *text);
}

/* Writes the values that a member of the configuration file may have. */
static void write_values(struct kd_writer *w, const struct kd_cli_setting *setting)
{
    switch (setting->kind) {
    case KD_SETTING_NUMBER: kd_write(w, "a whole number from %u to %u", setting->least, setting->most); break;
    case KD_SETTING_BYTES: kd_write(w, "`\"1536M\"`, `\"2G\"`: " KD_CLI_BYTES_ALLOWED); break;
    case KD_SETTING_SWITCH: kd_write(w, "`true`, `false`"); break;
    case KD_SETTING_LIST: kd_write(w, "an array of strings"); break;
    case KD_SETTING_TEXT: kd_write(w, "a string"); break;
    case KD_SETTING_WORDS:
        for (const char *at = setting->argument; *at;) {
            const size_t n = strcspn(at, "|");
            kd_write(w, "%s`\"%.*s\"`", at == setting->argument ? "" : ", ", (int)n, at);
            at += n + (at[n] == '|');
        }
    }
}

static void write_row(struct kd_writer *w, const struct kd_cli_setting *setting)
{
    char variable[KD_SETTING_VARIABLE];
    kd_setting_variable(setting, variable);
    kd_write(w, "| `--%s` ", setting->name);
    kd_write(w, setting->where == KD_SETTING_FLAG ? "| no variable " : "| `%s` ", variable);
    if (setting->where == KD_SETTING_ANYWHERE)
        kd_write(w, "| `%s` | ", setting->name);
    else
        kd_write(w, "| no member | ");
    if (setting->where == KD_SETTING_ANYWHERE)
        write_values(w, setting);
    kd_write(w, setting->initial ? " | `%s` | " : " | none%s | ", setting->initial ? setting->initial : "");
    write_cell(w, setting->doc);
    kd_write(w, " |\n");
}

void kd_settings_page(struct kd_writer *w)
{
    kd_write(w, "# Options of `kerrd serve`\n\nAn option is a flag, an environment variable, or a member of the object "
                "in the file that `--config` or `KERRD_CONFIG` names. A flag overrides the\nenvironment, which "
                "overrides the file, which overrides the default: [operations](operations.md). This page is generated: "
                "`build/src/cli/reference/kd_cli_reference options > docs/options.md`.\n\n| flag | environment | file "
                "| value | default | meaning |\n|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < KD_SERVE_COUNT; i++)
        write_row(w, &kd_serve_settings[i]);
}
