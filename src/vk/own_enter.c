#include "vk/own_enter.h"

#include "vk/instance.h"
#include "vk/own_driver.h"

#include <gnu/libc-version.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <unistd.h>

static bool system_has_device(void)
{
    struct kd_vk_instance instance;
    struct kd_error error = { 0 };
    const bool has = !kd_vk_instance_init_system(&instance, &error) && kd_vk_instance_has_device(&instance);
    kd_vk_instance_finish(&instance);
    return has;
}

void kd_vk_own_enter(int argc, char **argv)
{
    char folder[KD_VK_PATH], program[KD_VK_PATH], linker[KD_VK_PATH], libraries[2 * KD_VK_PATH + 16];
    if (kd_vk_own_entered()) {
        prctl(PR_SET_NAME, "kerrd"); /* not the linker's */
        return;
    }
    if (strverscmp(gnu_get_libc_version(), KD_VK_OWN_GLIBC) >= 0 || !kd_vk_own_driver(folder) ||
        !kd_vk_running(program))
        return;
    kd_vk_cut(folder, KD_VK_OWN_FILE);
    snprintf(linker, sizeof linker, "%.*s" KD_VK_OWN_LINKER, KD_VK_PATH - 64, folder);
    /* The linker separates folders by the first two of these signs, and replaces words after the third. */
    if (access(linker, X_OK) || strpbrk(folder, ":;$") || system_has_device())
        return;
    snprintf(libraries, sizeof libraries, "%s/glibc-" KD_VK_OWN_GLIBC ":%s", folder, folder);
    char **words = calloc((size_t)argc + 6, sizeof *words);
    if (!words)
        return;
    char *const first[] = { linker, "--library-path", libraries, "--argv0", argv[0], program };
    memcpy(words, first, sizeof first);
    memcpy(words + 6, argv + 1, (size_t)argc * sizeof *argv); /* copies the arguments and the NULL that ends them */
    execv(linker, words);
    free(words); /* the driver will not be opened; a later message says why */
}
