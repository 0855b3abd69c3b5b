/* Reads settings from a JSON file and from the environment. */
#include "base/log.h"
#include "base/spelling.h"
#include "cli/cli.h"
#include "cli/file.h"
#include "cli/settings.h"
#include "document/document.h"
#include "document/members.h"
#include "document/scan.h"
#include "document/text.h"
#include "document/tree.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define PREFIX "KERRD_"
#define FILE_MOST ((size_t)64 << 10)

/* Variables that are not settings: they are for developers of Vulkan code, and for scripts in the repository. */
static const char *const others[] = { "KERRD_VALIDATE", "KERRD_WATCH", "KERRD_WERROR" };

void kd_setting_variable(const struct kd_cli_setting *setting, char out[KD_SETTING_VARIABLE])
{
    size_t n = (size_t)snprintf(out, KD_SETTING_VARIABLE, PREFIX);
    for (const char *c = setting->name; *c && n + 1 < KD_SETTING_VARIABLE; c++)
        out[n++] = (char)(*c == '-' ? '_' : toupper((unsigned char)*c));
    out[n] = 0;
}

/* Converts a member's value to the text of a flag. Returns false if the value has the wrong type. */
static bool text_of(const struct kd_cli_setting *setting, const cJSON *item, char number[24], const char **text)
{
    *text = cJSON_IsString(item) ? item->valuestring : number;
    if (setting->kind == KD_SETTING_NUMBER && cJSON_IsNumber(item) && item->valuedouble >= 0 &&
        item->valuedouble < 1e9 && floor(item->valuedouble) == item->valuedouble)
        snprintf(number, 24, "%.0f", item->valuedouble);
    else if (setting->kind == KD_SETTING_SWITCH && cJSON_IsBool(item))
        snprintf(number, 24, cJSON_IsTrue(item) ? "yes" : "no");
    else
        return cJSON_IsString(item) && setting->kind != KD_SETTING_NUMBER && setting->kind != KD_SETTING_SWITCH;
    return true;
}

/* Stores a member's value. pointer: JSON pointer to the member. */
static enum kd_status take(struct kd_settings *settings, size_t i, const cJSON *item, const char *pointer,
                           struct kd_error *error)
{
    const struct kd_cli_setting *setting = &settings->table[i];
    char allowed[KD_ALLOWED_SIZE], number[24];
    const char *text;
    const bool typed = text_of(setting, item, number, &text);
    if (typed && kd_setting_takes(setting, text, allowed))
        return kd_settings_give(settings, i, KD_BY_FILE, text, error);
    if (setting->kind == KD_SETTING_SWITCH)
        snprintf(allowed, sizeof allowed, "true or false");
    else if (setting->kind == KD_SETTING_TEXT)
        snprintf(allowed, sizeof allowed, "a string");
    else if (!typed)
        kd_setting_takes(setting, "", allowed);
    return kd_member_refuse(item, pointer, allowed, error);
}

static enum kd_status take_list(struct kd_settings *settings, size_t i, const cJSON *item, const char *pointer,
                                struct kd_error *error)
{
    enum kd_status status = KD_OK;
    char at[sizeof error->pointer];
    size_t k = 0;
    if (!cJSON_IsArray(item))
        return kd_member_refuse(item, pointer, "an array of strings", error);
    for (const cJSON *one = item->child; one && !status; one = one->next, k++) {
        snprintf(at, sizeof at, "%.100s/%zu", pointer, k);
        status = take(settings, i, one, at, error);
    }
    return status;
}

static enum kd_status read_members(struct kd_settings *settings, const cJSON *object, struct kd_error *error)
{
    const cJSON *items[KD_SETTINGS_MOST] = { NULL };
    struct kd_row rows[KD_SETTINGS_MOST];
    struct kd_document document = { .rows = rows };
    if (!cJSON_IsObject(object))
        return kd_member_refuse(object, "", "an object whose members are options", error);
    for (size_t i = 0; i < settings->n; i++)
        if (settings->table[i].where == KD_SETTING_ANYWHERE)
            rows[document.n++] =
                (struct kd_row) { .name = settings->table[i].name, .kind = KD_KIND_JSON, .offset = i * sizeof *items };
    enum kd_status status = kd_document_read(&document, items, object, "", NULL, error);
    for (size_t i = 0; i < settings->n && !status; i++) {
        char pointer[sizeof error->pointer] = "";
        kd_text_pointer(pointer, sizeof pointer, settings->table[i].name);
        if (items[i])
            status = settings->table[i].kind == KD_SETTING_LIST ? take_list(settings, i, items[i], pointer, error)
                                                                : take(settings, i, items[i], pointer, error);
    }
    return status;
}

enum kd_status kd_settings_read_file(struct kd_settings *settings, const char *path, struct kd_error *error)
{
    struct kd_buffer text = { 0 };
    cJSON *tree = NULL;
    enum kd_status status;
    if (path[0] == '-' && path[1] && access(++path, F_OK) && errno == ENOENT)
        return KD_OK;
    /* the message of kd_file_read already contains the name of the file */
    KD_TRY(kd_file_read(path, FILE_MOST, &text, error));
    status = kd_tree_parse((const char *)text.data, text.size, FILE_MOST, KD_SCAN_FEW, &tree, error);
    if (!status)
        status = read_members(settings, tree, error);
    if (status)
        kd_cli_prefix(error, path);
    else if (!(settings->file = strdup(path)))
        status = kd_error_set(error, KD_ENOMEM, "out of memory");
done:
    cJSON_Delete(tree);
    kd_buffer_finish(&text);
    return status;
}

/* True if Kubernetes has set this variable for a Service, as it does unless enableServiceLinks is false. Example:
 * for a Service named kerrd the variable is KERRD_PORT=tcp://10.0.0.1:8080. */
static bool is_link(const char *name, const char *value)
{
    const char *port = strstr(name, "_PORT_");
    return strstr(name, "_SERVICE_HOST") || strstr(name, "_SERVICE_PORT") || !strncmp(value, "tcp://", 6) ||
           !strncmp(value, "udp://", 6) || (port && isdigit((unsigned char)port[6]));
}

/* Finds the setting that belongs to an environment variable, and returns n if there is none. *value: the text after
 * the variable's name. */
static size_t find_variable(const struct kd_settings *settings, const char *variable, const char **value)
{
    const size_t n = strcspn(variable, "=");
    *value = variable + n + (variable[n] == '=');
    for (size_t i = 0; i < settings->n; i++) {
        char own[KD_SETTING_VARIABLE];
        kd_setting_variable(&settings->table[i], own);
        if (settings->table[i].where != KD_SETTING_FLAG && strlen(own) == n && !memcmp(own, variable, n))
            return i;
    }
    return settings->n;
}

static enum kd_status give_variable(struct kd_settings *settings, size_t i, const char *value, struct kd_error *error)
{
    char own[KD_SETTING_VARIABLE], shown[120], allowed[KD_ALLOWED_SIZE], *rest, *copy = strdup(value);
    const bool list = settings->table[i].kind == KD_SETTING_LIST;
    enum kd_status status = copy ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory");
    kd_setting_variable(&settings->table[i], own);
    kd_text_clip(shown, sizeof shown, value);
    for (char *text = status ? NULL
                      : list ? strtok_r(copy, ",", &rest)
                             : copy;
         text && !status; text = list ? strtok_r(NULL, ",", &rest) : NULL) {
        if (!kd_setting_takes(&settings->table[i], text, allowed))
            status =
                kd_error_set(error, KD_EINVAL, "the environment: %s is \"%s\"; it must be %s", own, shown, allowed);
        else
            status = kd_settings_give(settings, i, KD_BY_ENVIRONMENT, text, error);
    }
    free(copy);
    return status;
}

enum kd_status kd_settings_read_environment(struct kd_settings *settings, char *const *environment,
                                            struct kd_error *error)
{
    enum kd_status status = KD_OK;
    for (; *environment && !status; environment++) {
        const char *value;
        const size_t i = find_variable(settings, *environment, &value);
        if (i < settings->n && *value && !is_link(*environment, value))
            status = give_variable(settings, i, value, error);
    }
    return status;
}

static bool is_other(const char *name)
{
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (!strcmp(name, others[i]))
            return true;
    return false;
}

static void warn_of(const struct kd_settings *settings, const char *name)
{
    struct kd_spelling_best best = { 0 };
    char lower[60] = "", own[KD_SETTING_VARIABLE] = "";
    for (size_t k = 0; name[sizeof PREFIX - 1 + k] && k + 1 < sizeof lower; k++)
        lower[k] =
            (char)(name[sizeof PREFIX - 1 + k] == '_' ? '-' : tolower((unsigned char)name[sizeof PREFIX - 1 + k]));
    for (size_t i = 0; i < settings->n; i++)
        if (settings->table[i].where != KD_SETTING_FLAG)
            kd_spelling_offer(&best, lower, settings->table[i].name);
    for (size_t i = 0; best.name && i < settings->n; i++)
        if (best.name == settings->table[i].name)
            kd_setting_variable(&settings->table[i], own);
    kd_log(KD_LOG_WARN, "the environment: %s is no option of kerrd serve%s%s%s", name, *own ? "; did you mean " : "",
           own, *own ? "?" : "");
}

void kd_settings_warn(const struct kd_settings *settings, char *const *environment)
{
    for (; *environment; environment++) {
        const char *value;
        char name[120];
        if (strncmp(*environment, PREFIX, sizeof PREFIX - 1))
            continue;
        const size_t i = find_variable(settings, *environment, &value);
        snprintf(name, sizeof name, "%.*s", (int)strcspn(*environment, "="), *environment);
        if (is_link(name, value))
            kd_log(KD_LOG_INFO, "the environment: %s is ignored, because it describes a Service of Kubernetes", name);
        else if (i == settings->n && !is_other(name))
            warn_of(settings, name);
    }
}
