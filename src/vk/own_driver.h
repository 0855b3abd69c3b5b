/* The software driver that may be installed with the program (scripts/driver): ../lib/kerrd-driver or kerrd-driver, as
 * seen from the program's folder. It is for systems without a device of Vulkan 1.2.
 *
 * The driver's libraries need glibc 2.36. For older systems the folder also has that C library with its dynamic
 * linker. The linker can start the program, which then runs within that C library. */
#ifndef KD_VK_OWN_DRIVER_H
#define KD_VK_OWN_DRIVER_H

#include <stdbool.h>

#define KD_VK_PATH 4096

/* Finds the folder of the driver. Returns false if there is none, or if the environment names the drivers to use. */
bool kd_vk_own_driver(char path[KD_VK_PATH]);
/* True if the program runs within the driver's C library. */
bool kd_vk_own_entered(void);
/* Names in the driver's folder. KD_VK_OWN_LINKER: dynamic linker of the driver's C library, glibc 2.36;
 * KD_VK_OWN_FILE: the driver. */
#define KD_VK_OWN_GLIBC "2.36" /* as in scripts/driver */
#define KD_VK_OWN_LINKER "/glibc-" KD_VK_OWN_GLIBC "/ld.so"
#define KD_VK_OWN_FILE "/libvulkan_lvp.so"
/* The absolute path of the running program. If the dynamic linker was started by name, this is the linker's path. */
bool kd_vk_running(char path[KD_VK_PATH]);
/* Removes `end` from the end of the path. Returns false if the path has another end. */
bool kd_vk_cut(char *path, const char *end);

#endif
