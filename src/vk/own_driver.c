#include "vk/own_driver.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool is_set(const char *variable)
{
    const char *value = getenv(variable);
    return value && *value;
}

bool kd_vk_running(char path[KD_VK_PATH])
{
    const ssize_t n = readlink("/proc/self/exe", path, KD_VK_PATH - 64);
    if (n <= 0 || n == KD_VK_PATH - 64)
        return false;
    path[n] = 0;
    return true;
}

bool kd_vk_cut(char *path, const char *end)
{
    const size_t length = strlen(path), n = strlen(end);
    if (length < n || strcmp(path + length - n, end))
        return false;
    path[length - n] = 0;
    return true;
}

bool kd_vk_own_entered(void)
{
    char path[KD_VK_PATH];
    return kd_vk_running(path) && kd_vk_cut(path, KD_VK_OWN_LINKER);
}

bool kd_vk_own_driver(char path[KD_VK_PATH])
{
    static const char *const places[] = { "../lib/kerrd-driver", "kerrd-driver" };
    char program[KD_VK_PATH];
    if (is_set("VK_DRIVER_FILES") || is_set("VK_ICD_FILENAMES") || !kd_vk_running(program))
        return false;
    if (kd_vk_cut(program, KD_VK_OWN_LINKER)) {
        snprintf(path, KD_VK_PATH, "%.*s" KD_VK_OWN_FILE, KD_VK_PATH - 64, program);
        return !access(path, R_OK);
    }
    *strrchr(program, '/') = 0;
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        snprintf(path, KD_VK_PATH, "%.*s/%s" KD_VK_OWN_FILE, KD_VK_PATH - 64, program, places[i]);
        if (!access(path, R_OK))
            return true;
    }
    return false;
}
