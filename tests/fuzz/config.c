/* Fuzz target: the options of `kerrd serve`. The input is the document of a --config file, a line "---" and environment
 * variables, one a line. Values that are read must be valid by the table. The environment must override the file. A
 * file that is written from the effective settings must read back the same. The list of --cors-origin is also parsed as
 * origins. */
#include "fuzz.h"

#include "base/utf8.h"
#include "cli/serve_settings.h"
#include "server/http/cors.h"

#include <cjson/cJSON.h>

enum { VARIABLES = 32 };

/* Checks the effective value of an option against its kind. The check uses only the text of the value. */
static void check_value(const struct kd_cli_setting *setting, const char *text)
{
    char *end;
    if (setting->kind == KD_SETTING_NUMBER) {
        const unsigned long long number = strtoull(text, &end, 10);
        CHECK(*text >= '0' && *text <= '9' && !*end && number >= setting->least && number <= setting->most,
              "%s is \"%s\"", setting->name, text);
    } else if (setting->kind == KD_SETTING_SWITCH)
        CHECK(strstr(" no yes false true 0 1 ", text) && *text && !strchr(text, ' '), "%s is \"%s\"", setting->name,
              text);
    else if (setting->kind == KD_SETTING_WORDS) {
        const char *found = strstr(setting->argument, text);
        CHECK(found && *text && !strchr(text, '|'), "%s is \"%s\"", setting->name, text);
    } else if (setting->kind == KD_SETTING_BYTES)
        CHECK(*text >= '0' && *text <= '9', "%s is \"%s\"", setting->name, text);
    else if (setting->kind == KD_SETTING_LIST)
        CHECK(*text, "%s has an empty text", setting->name);
}

static void check_origins(const char *const *texts)
{
    struct kd_cors *cors = NULL;
    struct kd_error error = { 0 };
    const enum kd_status status = texts ? kd_cors_create(texts, NULL, &cors, &error) : KD_OK;
    if (status)
        kd_fuzz_refused(status, &error);
    CHECK(!status == (cors || !texts), "origins are %s", cors ? "refused, and there" : "taken, and not there");
    kd_cors_destroy(cors);
}

static void check_values(const struct kd_settings *settings)
{
    for (size_t i = 0; i < settings->n; i++) {
        const struct kd_setting_values *values = &settings->values[i * KD_SETTING_SOURCES],
                                       *from = values[KD_BY_ENVIRONMENT].n ? &values[KD_BY_ENVIRONMENT]
                                                                           : &values[KD_BY_FILE];
        CHECK(!values[KD_BY_FLAG].n, "there are no flags, and %s has one", settings->table[i].name);
        for (size_t k = 0; k < values[KD_BY_FILE].n; k++)
            check_value(&settings->table[i], values[KD_BY_FILE].texts[k]);
        for (size_t k = 0; k < values[KD_BY_ENVIRONMENT].n; k++)
            check_value(&settings->table[i], values[KD_BY_ENVIRONMENT].texts[k]);
        CHECK(!from->n || kd_settings_text(settings, i) == from->texts[0],
              "the file counts before the environment, for %s", settings->table[i].name);
    }
    check_origins(kd_settings_list(settings, KD_SERVE_CORS_ORIGIN));
}

static cJSON *item_of(const struct kd_cli_setting *setting, const char *text)
{
    if (setting->kind == KD_SETTING_NUMBER)
        return cJSON_CreateNumber(strtod(text, NULL));
    return setting->kind == KD_SETTING_SWITCH ? cJSON_CreateBool(strchr("yt1", *text) != NULL)
                                              : cJSON_CreateString(text);
}

/* The settings as the text of a file, allocated by malloc. */
static char *write_file(const struct kd_settings *settings)
{
    cJSON *object = cJSON_CreateObject();
    for (size_t i = 0; i < settings->n; i++) {
        const struct kd_cli_setting *setting = &settings->table[i];
        const char *const *list = kd_settings_list(settings, i);
        cJSON *item = !list ? NULL : setting->kind == KD_SETTING_LIST ? cJSON_CreateArray() : item_of(setting, list[0]);
        for (size_t k = 0; list && list[k] && setting->kind == KD_SETTING_LIST; k++)
            cJSON_AddItemToArray(item, cJSON_CreateString(list[k]));
        CHECK(!list || setting->where == KD_SETTING_ANYWHERE || cJSON_IsString(item), "%s stands in a file",
              setting->name);
        if (item && setting->where != KD_SETTING_ANYWHERE)
            cJSON_Delete(item);
        else if (item)
            cJSON_AddItemToObject(object, setting->name, item);
    }
    char *text = cJSON_PrintUnformatted(object);
    CHECK(text, "out of memory");
    cJSON_Delete(object);
    return text;
}

static enum kd_status read_file(struct kd_settings *settings, const char *text, size_t size, struct kd_error *error)
{
    char path[64];
    kd_fuzz_file("config", text, size);
    snprintf(path, sizeof path, "%s/config", kd_fuzz_folder(NULL));
    CHECK(!kd_settings_init(settings, kd_serve_settings, KD_SERVE_COUNT, error), "out of memory");
    return kd_settings_read_file(settings, path, error);
}

/* Environment variables may hold any bytes, as file names do. A JSON document must be UTF-8. */
static bool is_utf8(const struct kd_settings *settings)
{
    bool valid = true;
    for (size_t i = 0; i < settings->n; i++) {
        const char *const *list = kd_settings_list(settings, i);
        for (size_t k = 0; list && list[k]; k++)
            valid &= kd_utf8_valid(list[k]);
    }
    return valid;
}

static void read_again(const struct kd_settings *settings)
{
    struct kd_settings back;
    struct kd_error error = { 0 };
    char *text = write_file(settings);
    CHECK(!read_file(&back, text, strlen(text), &error), "%s, of %s", error.message, text);
    for (size_t i = 0; i < settings->n; i++) {
        const char *one = kd_settings_text(settings, i), *other = kd_settings_text(&back, i);
        const bool in_file = settings->table[i].where == KD_SETTING_ANYWHERE;
        if (settings->table[i].kind == KD_SETTING_NUMBER && in_file)
            CHECK(kd_settings_number(settings, i) == kd_settings_number(&back, i), "%s became %s in %s",
                  settings->table[i].name, other, text);
        else if (settings->table[i].kind == KD_SETTING_SWITCH && in_file)
            CHECK(kd_settings_switch(settings, i) == kd_settings_switch(&back, i), "%s became %s in %s",
                  settings->table[i].name, other, text);
        else if (in_file)
            CHECK(!one == !other && (!one || !strcmp(one, other)), "%s became %s in %s", settings->table[i].name, other,
                  text);
    }
    kd_settings_finish(&back);
    free(text);
}

int kd_fuzz_config(const uint8_t *data, size_t size)
{
    struct kd_fuzz_text document = kd_fuzz_part(&data, &size), lines[VARIABLES];
    char *environment[VARIABLES + 1] = { 0 };
    struct kd_settings settings;
    struct kd_error error = { 0 };
    size_t n = 0;
    enum kd_status status = read_file(&settings, document.at, document.size, &error);
    for (; n < VARIABLES && kd_fuzz_next(&data, &size, &lines[n]); n++)
        environment[n] = lines[n].at;
    if (!status)
        status = kd_settings_read_environment(&settings, environment, &error);
    if (status)
        kd_fuzz_refused(status, &error);
    else {
        check_values(&settings);
        if (is_utf8(&settings))
            read_again(&settings);
    }
    kd_settings_finish(&settings);
    while (n)
        free(lines[--n].at);
    free(document.at);
    return 0;
}
