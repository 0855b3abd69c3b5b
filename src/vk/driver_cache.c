/* Finds where lavapipe stores compiled kernels. The rules are those of Mesa's src/util/disk_cache_os.c
 * (disk_cache_generate_cache_dir, disk_cache_enabled) in versions 22 to 25. */
#include "base/hash.h"
#include "vk/device.h"

#include <fcntl.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#define DIR_BYTES 4096

static bool is_set(const char *name)
{
    const char *value = getenv(name);
    return value && (!strcmp(value, "1") || !strcasecmp(value, "true") || !strcasecmp(value, "yes") ||
                     !strcasecmp(value, "y") || !strcasecmp(value, "t"));
}

/* Finds the folder in which Mesa makes its own folder. */
static void find_folder(char dir[DIR_BYTES])
{
    const char *own = getenv("MESA_SHADER_CACHE_DIR"), *older = getenv("MESA_GLSL_CACHE_DIR"),
               *xdg = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    own = own ? own : older ? older : xdg;
    const int n = own ? snprintf(dir, DIR_BYTES, "%s", own) : home ? snprintf(dir, DIR_BYTES, "%s/.cache", home) : 0;
    if (n <= 0 || n >= DIR_BYTES)
        *dir = 0;
}

/* True if files can be created in the folder. If it does not exist, its nearest existing parent counts, because Mesa
 * makes the missing folders. */
static bool is_writable(const char *dir)
{
    char path[DIR_BYTES];
    snprintf(path, sizeof path, "%s", dir);
    while (*path && access(path, F_OK)) {
        char *slash = strrchr(path, '/');
        if (!slash)
            return false;
        slash[slash == path] = 0;
    }
    return *path && !access(path, W_OK | X_OK);
}

enum kd_vk_compiling kd_vk_compiling(const struct kd_vk *vk, char dir[DIR_BYTES])
{
    *dir = 0;
    if (strcmp(vk->core.physical.info.driver, "llvmpipe"))
        return KD_VK_COMPILES_EARLY;
    find_folder(dir);
    const bool off = is_set("MESA_SHADER_CACHE_DISABLE") || is_set("MESA_GLSL_CACHE_DISABLE") || getuid() != geteuid();
    return !off && is_writable(dir) ? KD_VK_COMPILES_LATE : KD_VK_COMPILES_LATE_KEEPS_NOTHING;
}

uint64_t kd_vk_compiled_id(const struct kd_vk *vk)
{
    static const char *const names[] = { "mesa_shader_cache", "mesa_shader_cache_db", "mesa_shader_cache_sf" };
    char dir[DIR_BYTES], path[DIR_BYTES + 32];
    uint64_t id = 0;
    if (kd_vk_compiling(vk, dir) != KD_VK_COMPILES_LATE)
        return 0;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        struct statx found;
        snprintf(path, sizeof path, "%s/%s", dir, names[i]);
        if (statx(AT_FDCWD, path, 0, STATX_INO | STATX_BTIME, &found))
            continue;
        const uint64_t own[] = { found.stx_ino, (uint64_t)found.stx_btime.tv_sec, found.stx_btime.tv_nsec };
        id = kd_hash(id ? id : KD_HASH_BEGIN, own, sizeof own);
    }
    return id;
}
