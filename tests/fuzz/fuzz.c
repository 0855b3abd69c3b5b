#include "fuzz.h"

#include "base/utf8.h"
#include "render/accuracy/table.h"
#include "scene/table.h"

#include <cjson/cJSON.h>
#include <fcntl.h>
#include <ftw.h>
#include <math.h>
#include <stdarg.h>
#include <sys/stat.h>
#include <unistd.h>

_Noreturn void kd_fuzz_fail(const char *file, int line, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fprintf(stderr, "%s:%d: ", file, line);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    abort();
}

struct kd_fuzz_text kd_fuzz_bare(const uint8_t *data, size_t size)
{
    char *at = malloc(size ? size : 1);
    CHECK(at, "out of memory for an input");
    if (size)
        memcpy(at, data, size);
    return (struct kd_fuzz_text) { at, size };
}

struct kd_fuzz_text kd_fuzz_copy(const uint8_t *data, size_t size)
{
    char *at = malloc(size + 1);
    CHECK(at, "out of memory for an input");
    if (size)
        memcpy(at, data, size);
    at[size] = 0;
    return (struct kd_fuzz_text) { at, size };
}

struct kd_fuzz_text kd_fuzz_part(const uint8_t **data, size_t *size)
{
    static const char line[] = "\n---\n";
    const uint8_t *start = *data, *end = *size ? memmem(*data, *size, line, sizeof line - 1) : NULL;
    const size_t n = end ? (size_t)(end - start) : *size, gone = end ? n + sizeof line - 1 : n;
    *data += gone;
    *size -= gone;
    return kd_fuzz_copy(start, n);
}

bool kd_fuzz_next(const uint8_t **data, size_t *size, struct kd_fuzz_text *out)
{
    size_t n = 0;
    while (n < *size && (*data)[n] && (*data)[n] != '\n')
        n++;
    if (!*size)
        return false;
    *out = kd_fuzz_copy(*data, n);
    n += n < *size;
    *data += n;
    *size -= n;
    return true;
}

void kd_fuzz_shown(const char *text)
{
    CHECK(kd_utf8_valid(text), "this is not UTF-8: %s", text);
    for (const char *c = text; *c; c++)
        CHECK(((unsigned char)*c >= 32 && *c != 127) || *c == '\n', "this holds a control character, %d: %s", *c, text);
}

void kd_fuzz_refused(enum kd_status status, const struct kd_error *error)
{
    CHECK(status == error->status, "the status is %s, that of the error %s: %s", kd_status_name(status),
          kd_status_name(error->status), error->message);
    CHECK(strlen(error->message) >= 8, "a refusal says no more than \"%s\"", error->message);
    CHECK(!strchr(error->message, '\n'), "a refusal has two lines: %s", error->message);
    CHECK(!*error->pointer || *error->pointer == '/', "\"%s\" is no JSON pointer: %s", error->pointer, error->message);
    CHECK(kd_utf8_valid(error->pointer), "the pointer is not UTF-8: %s", error->message);
    kd_fuzz_shown(error->message);
    for (const char *c = error->pointer; *c; c++)
        CHECK(*c != '~' || c[1] == '0' || c[1] == '1', "\"%s\" has a ~ that escapes nothing", error->pointer);
}

void kd_fuzz_json(const struct kd_buffer *text)
{
    cJSON *root = cJSON_ParseWithLength((const char *)text->data, text->size);
    CHECK(root, "this is no JSON: %.*s", (int)text->size, (const char *)text->data);
    cJSON_Delete(root);
}

/* Does the check of kd_row_holds, which is under test, in another way, from the row in scene/table.h. */
static bool allows(const struct kd_row *field, double value)
{
    double most = field->most;
    if (isinf(value))
        return (field->kind == KD_KIND_REAL || field->kind == KD_KIND_INT) && field->words && value > 0;
    if (field->kind == KD_KIND_WORD) {
        most = 0;
        for (const char *bar = field->words; (bar = strchr(bar, '|')); bar++)
            most++;
    }
    const double least = field->kind == KD_KIND_WORD ? 0 : field->least;
    return !isnan(value) && !(value < least) && !(value > most) && (field->kind == KD_KIND_REAL || fmod(value, 1) == 0);
}

void kd_fuzz_fields(const struct kd_scene *scene)
{
    for (size_t i = 0; i < KD_SECTION_COUNT; i++) {
        const struct kd_section *section = &kd_sections[i];
        const size_t n = kd_section_size(scene, section);
        CHECK(n <= (section->most ? section->most : 1), "%s has %zu elements", section->name, n);
        for (size_t index = 0; index < n; index++)
            for (size_t k = section->first; k < section->first + section->count; k++) {
                const double value = kd_field_get(scene, &kd_fields[k], index);
                CHECK(kd_fields[k].kind == KD_KIND_ASSET || kd_fields[k].kind == KD_KIND_SERIES ||
                          allows(&kd_fields[k], value),
                      "%s.%s holds %g, which its row does not allow", section->name, kd_fields[k].name, value);
            }
    }
}

struct kd_capacity kd_fuzz_device(void)
{
    return (struct kd_capacity) { .max_binding_bytes = 128u << 20,
                                  .memory_bytes = 1u << 30,
                                  .float64 = true,
                                  .cores = 2,
                                  .accuracy = kd_accuracy_built_in() };
}

/* The scene itself. If it has unresolved names of assets, a copy without these, because unresolved names have no
 * identity. */
static struct kd_scene without_names(const struct kd_scene *scene)
{
    struct kd_scene known = *scene;
    for (size_t k = 0; k < KD_FIELD_COUNT; k++)
        if (kd_fields[k].kind == KD_KIND_ASSET)
            kd_field_put(&known, &kd_fields[k], 0, 0);
    return known;
}

static void check_text(const struct kd_scene *scene)
{
    struct kd_buffer text = { 0 }, again = { 0 };
    struct kd_error error = { 0 };
    struct kd_scene back;
    char hash[65], hash_again[65];
    CHECK(!kd_scene_to_json(scene, &text), "a scene that was read has no document");
    kd_scene_defaults(&back);
    CHECK(!kd_scene_from_json(&back, (const char *)text.data, text.size, &error), "%s: %s, in its own document %s",
          error.pointer, error.message, (char *)text.data);
    CHECK(!kd_scene_to_json(&back, &again) && again.size == text.size && !memcmp(again.data, text.data, text.size),
          "%s became %s", (char *)text.data, (char *)again.data);
    CHECK(!memcmp(scene, &back, sizeof back), "a scene that was read back is another one: %s", (char *)text.data);
    CHECK(!kd_scene_hash(scene, hash) && !kd_scene_hash(&back, hash_again) && !strcmp(hash, hash_again),
          "the hash of one scene is %s and %s", hash, hash_again);
    kd_buffer_finish(&text);
    kd_buffer_finish(&again);
}

void kd_fuzz_sound(const struct kd_scene *scene)
{
    const struct kd_scene known = without_names(scene);
    const struct kd_capacity capacity = kd_fuzz_device();
    struct kd_error error = { 0 };
    kd_fuzz_fields(scene);
    check_text(&known);
    enum kd_status status = kd_scene_validate(&known, &error);
    if (!status)
        status = kd_plan_check(&known, &capacity, &error);
    if (status)
        kd_fuzz_refused(status, &error);
}

static char folder[] = "/tmp/kerrd-fuzz-XXXXXX";
static int descriptor = -1;

static int remove_one(const char *path, const struct stat *about, int kind, struct FTW *where)
{
    (void)about, (void)kind, (void)where;
    return remove(path);
}

static void remove_folder(void) { nftw(folder, remove_one, 8, FTW_DEPTH | FTW_PHYS); }

const char *kd_fuzz_folder(int *out)
{
    if (descriptor < 0) {
        CHECK(mkdtemp(folder), "a folder in /tmp cannot be made");
        descriptor = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        CHECK(descriptor >= 0, "%s cannot be opened", folder);
        atexit(remove_folder);
    }
    if (out)
        *out = descriptor;
    return folder;
}

void kd_fuzz_file(const char *name, const void *data, size_t size)
{
    static struct {
        char name[40];
        int fd;
    } open_files[4]; /* kept open, because creating a file takes longer than reading it */
    size_t i = 0;
    int fd;
    kd_fuzz_folder(&fd);
    while (i < 4 && *open_files[i].name && strcmp(open_files[i].name, name))
        i++;
    CHECK(i < 4, "%s is one file too many", name);
    if (!*open_files[i].name) {
        snprintf(open_files[i].name, sizeof open_files[i].name, "%s", name);
        open_files[i].fd = openat(fd, name, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    }
    fd = open_files[i].fd;
    CHECK(fd >= 0 && !ftruncate(fd, (off_t)size) && pwrite(fd, data, size, 0) == (ssize_t)size, "%s cannot be written",
          name);
}
