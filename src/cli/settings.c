#include "cli/settings.h"

#include "base/buffer.h"
#include "base/utf8.h"
#include "cli/cli.h"
#include "document/document.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum kd_status kd_settings_init(struct kd_settings *settings, const struct kd_cli_setting *table, size_t n,
                                struct kd_error *error)
{
    *settings = (struct kd_settings) { .table = table,
                                       .n = n,
                                       .values = calloc(n * KD_SETTING_SOURCES, sizeof *settings->values) };
    return settings->values ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory");
}

static void drop(struct kd_setting_values *values)
{
    for (size_t i = 0; i < values->n; i++)
        free((void *)values->texts[i]);
    free(values->texts);
    *values = (struct kd_setting_values) { 0 };
}

void kd_settings_finish(struct kd_settings *settings)
{
    for (size_t i = 0; settings->values && i < settings->n * KD_SETTING_SOURCES; i++)
        drop(&settings->values[i]);
    free(settings->values);
    free(settings->file);
    *settings = (struct kd_settings) { 0 };
}

/* Returns 1 for on, 0 for off, and -1 for any other text. */
static int switch_of(const char *text)
{
    static const char *const words[] = { "no", "yes", "false", "true", "0", "1" };
    for (int i = 0; i < 6; i++)
        if (!strcmp(text, words[i]))
            return i % 2;
    return -1;
}

bool kd_setting_takes(const struct kd_cli_setting *setting, const char *text, char allowed[KD_ALLOWED_SIZE])
{
    const struct kd_row row = { .kind = setting->kind == KD_SETTING_WORDS ? KD_KIND_WORD : KD_KIND_INT,
                                .least = setting->least,
                                .most = setting->most,
                                .words = setting->kind == KD_SETTING_WORDS ? setting->argument : NULL };
    unsigned number;
    uint64_t bytes;
    switch (setting->kind) {
    case KD_SETTING_NUMBER:
        kd_row_allowed(&row, allowed);
        return kd_cli_read_number(text, setting->least, setting->most, &number);
    case KD_SETTING_BYTES:
        snprintf(allowed, KD_ALLOWED_SIZE, KD_CLI_BYTES_ALLOWED);
        return kd_cli_read_bytes(text, &bytes);
    case KD_SETTING_SWITCH:
        snprintf(allowed, KD_ALLOWED_SIZE, "yes, no, true, false, 1 or 0");
        return switch_of(text) >= 0;
    case KD_SETTING_WORDS: kd_row_allowed(&row, allowed); return kd_word_index(setting->argument, text) >= 0;
    case KD_SETTING_LIST: snprintf(allowed, KD_ALLOWED_SIZE, "an array of texts that are not empty"); return *text;
    case KD_SETTING_TEXT: break;
    }
    return true;
}

static struct kd_setting_values *values_of(const struct kd_settings *settings, size_t i, enum kd_setting_source source)
{
    return &settings->values[i * KD_SETTING_SOURCES + source];
}

enum kd_status kd_settings_give(struct kd_settings *settings, size_t i, enum kd_setting_source source, const char *text,
                                struct kd_error *error)
{
    struct kd_setting_values *values = values_of(settings, i, source);
    if (settings->table[i].kind != KD_SETTING_LIST)
        drop(values);
    const char **texts = realloc(values->texts, (values->n + 2) * sizeof *texts);
    if (texts)
        values->texts = texts;
    if (!texts || !(texts[values->n] = strdup(text)))
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    texts[++values->n] = NULL;
    return KD_OK;
}

/* The values of a setting that are in effect; NULL if none was given. */
static const struct kd_setting_values *found(const struct kd_settings *settings, size_t i)
{
    for (int source = KD_SETTING_SOURCES - 1; source >= 0; source--)
        if (values_of(settings, i, (enum kd_setting_source)source)->n)
            return values_of(settings, i, (enum kd_setting_source)source);
    return NULL;
}

const char *kd_settings_text(const struct kd_settings *settings, size_t i)
{
    const struct kd_setting_values *values = found(settings, i);
    return values ? values->texts[0] : settings->table[i].initial;
}

unsigned kd_settings_number(const struct kd_settings *settings, size_t i)
{
    const char *text = kd_settings_text(settings, i);
    unsigned number = 0;
    if (text)
        kd_cli_read_number(text, settings->table[i].least, settings->table[i].most, &number);
    return number;
}

uint64_t kd_settings_bytes(const struct kd_settings *settings, size_t i)
{
    const char *text = kd_settings_text(settings, i);
    uint64_t bytes = 0;
    if (text)
        kd_cli_read_bytes(text, &bytes);
    return bytes;
}

bool kd_settings_switch(const struct kd_settings *settings, size_t i)
{
    const char *text = kd_settings_text(settings, i);
    return text && switch_of(text) > 0;
}

const char *const *kd_settings_list(const struct kd_settings *settings, size_t i)
{
    const struct kd_setting_values *values = found(settings, i);
    return values ? values->texts : NULL;
}

static enum kd_status add_value(const struct kd_settings *settings, size_t i, struct kd_buffer *line)
{
    const struct kd_setting_values *values = found(settings, i);
    enum kd_status status = KD_OK;
    char shown[1024];
    for (size_t k = 0; values && k < values->n && !status; k++) {
        kd_utf8_print(shown, sizeof shown, values->texts[k]);
        status = kd_buffer_printf(line, "%s%s", k ? "," : "", shown);
    }
    if (!values)
        status = kd_buffer_printf(line, "%s", settings->table[i].initial ? settings->table[i].initial : "-");
    return status;
}

static void source_of(const struct kd_settings *settings, size_t i, char *out, size_t size)
{
    char variable[KD_SETTING_VARIABLE];
    kd_setting_variable(&settings->table[i], variable);
    if (values_of(settings, i, KD_BY_FLAG)->n)
        snprintf(out, size, "flag");
    else if (values_of(settings, i, KD_BY_ENVIRONMENT)->n)
        snprintf(out, size, "environment %s", variable);
    else if (values_of(settings, i, KD_BY_FILE)->n)
        snprintf(out, size, "file %s", settings->file);
    else
        snprintf(out, size, "default");
}

int kd_settings_show(const struct kd_settings *settings)
{
    struct kd_buffer text = { 0 }, value = { 0 };
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < settings->n; i++) {
        char source[600];
        if (settings->table[i].where == KD_SETTING_FLAG)
            continue;
        value.size = 0;
        source_of(settings, i, source, sizeof source);
        KD_TRY(add_value(settings, i, &value));
        KD_TRY(kd_buffer_printf(&text, "%-16s  %-24s  %s\n", settings->table[i].name,
                                value.size ? (const char *)value.data : "", source));
    }
done:
    if (status)
        fprintf(stderr, "kerrd: out of memory\n");
    const int code = status ? KD_EXIT_FAILURE : kd_cli_print(text.data, text.size);
    kd_buffer_finish(&text);
    kd_buffer_finish(&value);
    return code;
}
