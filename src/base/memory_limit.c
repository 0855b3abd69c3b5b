#include "base/memory_limit.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

/* One version of control groups: its file system, and the names of its files and keys. */
struct version {
    /* type of file system and name of the controller, as in mountinfo; controller NULL: any */
    const char *filesystem, *controller;
    /* most: file with the limit; used: file with the use; idle: key in memory.stat of the inactive file pages */
    const char *most, *used, *idle;
    const char *by;
};
static const struct version versions[] = {
    { "cgroup2", NULL, "memory.max", "memory.current", "inactive_file", "the memory.max of a control group" },
    { "cgroup", "memory", "memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file",
      "the memory.limit_in_bytes of a control group" },
};

/* Reads the number after a key, as in "key 12" or "key: 12 kB". If key is "", the file contains only a number.
 * Returns false if there is no number, for example if the file contains "max". */
static bool number_in(const char *root, const char *path, const char *key, uint64_t *out)
{
    char name[PATH_MAX], line[256];
    size_t length = strlen(key);
    bool found = false;
    if (snprintf(name, sizeof name, "%s%s", root, path) >= (int)sizeof name)
        return false;
    FILE *file = fopen(name, "re");
    if (!file)
        return false;
    while (!found && fgets(line, sizeof line, file)) {
        char *end, *text = line + length;
        if (strncmp(line, key, length) || (length && !strchr(": \t", *text)))
            continue;
        text += strspn(text, ": \t");
        unsigned long long value = strtoull(text, &end, 10);
        found = end != text;
        *out = value << (strncmp(end, " kB", 3) ? 0 : 10);
    }
    fclose(file);
    return found;
}

static bool list_holds(char *list, const char *word)
{
    char *rest;
    for (char *one = strtok_r(list, ",\n", &rest); one; one = strtok_r(NULL, ",\n", &rest))
        if (!strcmp(one, word))
            return true;
    return false;
}

/* Reads one line of mountinfo. If the line belongs to this version's file system, gets the mounted group and its
 * mount point. */
static bool read_mount(char *line, const struct version *version, char *group, char *mount)
{
    char filesystem[32], options[256];
    char *tail = strstr(line, " - ");
    return tail && sscanf(tail, " - %31s %*s %255s", filesystem, options) == 2 &&
           !strcmp(filesystem, version->filesystem) &&
           (!version->controller || list_holds(options, version->controller)) &&
           sscanf(line, "%*s %*s %*s %1023s %1023s", group, mount) == 2;
}

/* Reads the process's group from a line of /proc/self/cgroup: "4:memory:/group" or, in version 2, "0::/group". */
static bool read_group(char *line, const struct version *version, char *group)
{
    char *list = strchr(line, ':'), *path = list ? strchr(list + 1, ':') : NULL;
    if (!path)
        return false;
    *path++ = 0;
    if (version->controller ? !list_holds(list + 1, version->controller) : list[1])
        return false;
    snprintf(group, 1024, "%.*s", (int)strcspn(path, "\n"), path);
    return true;
}

/* Opens a file of /proc. */
static FILE *open_list(const char *root, const char *path)
{
    char name[PATH_MAX];
    return snprintf(name, sizeof name, "%s%s", root, path) < (int)sizeof name ? fopen(name, "re") : NULL;
}

/* Finds the folder of the process's group, and the length of the mount point in its path. In a container the mount
 * may show only a part of the tree of groups. The path in /proc/self/cgroup is then relative to the whole tree, or
 * names a group that is not visible here. */
static bool find_group(const char *root, const struct version *version, char *folder, size_t size, size_t *mount_length)
{
    char line[4096], mounted[1024], mount[1024], group[1024];
    bool found = false;
    FILE *file = open_list(root, "/proc/self/mountinfo");
    while (file && !found && fgets(line, sizeof line, file))
        found = read_mount(line, version, mounted, mount);
    if (file)
        fclose(file);
    file = found ? open_list(root, "/proc/self/cgroup") : NULL;
    found = false;
    while (file && !found && fgets(line, sizeof line, file))
        found = read_group(line, version, group);
    if (file)
        fclose(file);
    if (!found)
        return false;
    size_t above = strcmp(mounted, "/") ? strlen(mounted) : 0;
    const char *below = strncmp(group, mounted, above) || (group[above] && group[above] != '/') || strstr(group, "/..")
                            ? ""
                            : group + above;
    *mount_length = strlen(mount);
    return snprintf(folder, size, "%s%s", mount, strcmp(below, "/") ? below : "") < (int)size;
}

/* Returns the number of bytes that the limit of one group leaves free; UINT64_MAX if the group has no limit. */
static uint64_t left_in(const char *root, const char *folder, const struct version *version)
{
    char path[PATH_MAX];
    uint64_t most, used = 0, idle = 0;
    snprintf(path, sizeof path, "%.3000s/%s", folder, version->most);
    if (!number_in(root, path, "", &most))
        return UINT64_MAX;
    snprintf(path, sizeof path, "%.3000s/%s", folder, version->used);
    number_in(root, path, "", &used);
    snprintf(path, sizeof path, "%.3000s/memory.stat", folder);
    number_in(root, path, version->idle, &idle);
    used -= idle < used ? idle : used;
    return used < most ? most - used : 0;
}

/* Every control group from the process's own up to the mount point may have a limit. Finds the one that leaves the
 * least memory free. */
static void least_of_groups(const char *root, const struct version *version, struct kd_memory_limit *least)
{
    char folder[2560];
    size_t mount_length;
    if (!find_group(root, version, folder, sizeof folder, &mount_length))
        return;
    for (;;) {
        uint64_t left = left_in(root, folder, version);
        if (left < least->left)
            *least = (struct kd_memory_limit) { .left = left, .by = version->by };
        char *last = strrchr(folder, '/');
        if (!last || (size_t)(last - folder) < mount_length)
            return;
        *last = 0;
    }
}

static uint64_t left_of(int resource, const char *used_by)
{
    struct rlimit limit;
    uint64_t used;
    if (getrlimit(resource, &limit) || limit.rlim_cur == RLIM_INFINITY ||
        !number_in("", "/proc/self/status", used_by, &used))
        return UINT64_MAX;
    return used < limit.rlim_cur ? limit.rlim_cur - used : 0;
}

uint64_t kd_address_space_left(void)
{
    const uint64_t space = left_of(RLIMIT_AS, "VmSize"), data = left_of(RLIMIT_DATA, "VmData");
    return space < data ? space : data;
}

bool kd_memory_limit_read(const char *root, struct kd_memory_limit *out)
{
    struct kd_memory_limit least = { .by = "the memory that is available" };
    uint64_t own = 0, shared = 0;
    if (!number_in(root, "/proc/meminfo", "MemAvailable", &least.left))
        return false;
    for (size_t i = 0; i < sizeof versions / sizeof *versions; i++)
        least_of_groups(root, &versions[i], &least);
    const uint64_t space = kd_address_space_left();
    if (space < least.left)
        least = (struct kd_memory_limit) { .left = space, .by = "the limit of this process's memory (ulimit)" };
    number_in(root, "/proc/self/status", "RssAnon", &own);
    number_in(root, "/proc/self/status", "RssShmem", &shared);
    *out = (struct kd_memory_limit) { least.left, own + shared, least.by };
    return true;
}
