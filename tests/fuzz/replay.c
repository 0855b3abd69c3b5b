/* Runs a target twice on each file of some folders, in the order of the files' names: kd_fuzz_replay TARGET FOLDER...
 * Prints the number of files. Fails if there are no files, or if more memory is allocated after the second run of a
 * file than after the first. */
#include "fuzz.h"

#include "../held.h"

#include <dirent.h>

static const struct {
    const char *name;
    int (*run)(const uint8_t *, size_t);
} targets[] = {
#define TARGET(name) { #name, kd_fuzz_##name },
    KD_FUZZ_TARGETS(TARGET)
#undef TARGET
};

static int no_dots(const struct dirent *entry) { return entry->d_name[0] != '.'; }

static unsigned run_file(int (*run)(const uint8_t *, size_t), const char *path)
{
    FILE *file = fopen(path, "rb");
    struct kd_buffer bytes = { 0 };
    uint8_t part[4096];
    CHECK(file, "%s cannot be read", path);
    for (size_t n; (n = fread(part, 1, sizeof part, file)) > 0;)
        CHECK(!kd_buffer_append(&bytes, part, n), "out of memory");
    fclose(file);
    fprintf(stderr, "%s\n", path); /* printed before the run, because the process may end there */
    run(bytes.data, bytes.size);
    const size_t before = kd_held();
    run(bytes.data, bytes.size);
    const size_t after = kd_held();
    CHECK(after <= before, "%s: holds %zu bytes more than before", path, after - before);
    kd_buffer_finish(&bytes);
    return 1;
}

static unsigned run_folder(int (*run)(const uint8_t *, size_t), const char *folder)
{
    struct dirent **entries;
    unsigned all = 0;
    const int n = scandir(folder, &entries, no_dots, alphasort);
    for (int i = 0; i < n; i++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/%s", folder, entries[i]->d_name);
        all += run_file(run, path);
        free(entries[i]);
    }
    if (n >= 0)
        free(entries);
    return all;
}

int main(int argc, char **argv)
{
    unsigned n = 0;
    kd_held_begin(argv);
    for (size_t i = 0; argc > 1 && i < sizeof targets / sizeof *targets; i++)
        for (int k = 2; k < argc && !strcmp(targets[i].name, argv[1]); k++)
            n += run_folder(targets[i].run, argv[k]);
    printf("%u inputs\n", n);
    return n ? 0 : 1;
}
