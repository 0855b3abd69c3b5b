/* Fills in the head of an accuracy table: version, date, machine and device. */
#include "render/selftest/accuracy_measure.h"
#include "render/device/device_internal.h"
#include "base/cores.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>
#include <time.h>

/* lavapipe starts one thread for each core, or as many threads as LP_NUM_THREADS says. If it says 0, only the
 * submitting thread computes. */
static uint32_t lavapipe_cores(void)
{
    const char *given = getenv("LP_NUM_THREADS");
    uint32_t cores = kd_cores();
    if (!given || !*given)
        return cores;
    long threads = strtol(given, NULL, 10);
    return threads < 1 ? 1 : threads < (long)cores ? (uint32_t)threads : cores;
}

static void processor(char *out, size_t size)
{
    char line[256];
    snprintf(out, size, "unknown processor");
    FILE *file = fopen("/proc/cpuinfo", "re");
    while (file && fgets(line, sizeof line, file)) {
        char *colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) || !colon)
            continue;
        snprintf(out, size, "%.*s", (int)strcspn(colon + 2, "\n"), colon + 2);
        break;
    }
    if (file)
        fclose(file);
}

void kd_accuracy_head(struct kd_renderer *renderer, const struct kd_accuracy_params *params,
                      struct kd_accuracy_table *out)
{
    const struct kd_vk_info *info = kd_vk_info(renderer->vk);
    char name[128];
    struct utsname system;
    time_t now = time(NULL);
    struct tm utc;
    processor(name, sizeof name);
    uname(&system);
    snprintf(out->machine, sizeof out->machine, "%s, %u cores, %.30s %.60s", name, kd_cores(), system.sysname,
             system.machine);
    snprintf(out->device, sizeof out->device, "%s", kd_renderer_device_name(renderer));
    snprintf(out->version, sizeof out->version, "%s", KD_VERSION);
    snprintf(out->command, sizeof out->command, "%s", params->command ? params->command : "");
    strftime(out->date, sizeof out->date, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&now, &utc));
    if (!info->float64)
        snprintf(out->skipped, sizeof out->skipped, "f64: %s has no double precision", info->name);
    out->cores = info->type == KD_VK_CPU ? lavapipe_cores() : 0;
    out->device_clock = info->timestamps;
    out->quick = params->quick;
    out->seconds = params->seconds > 0 ? params->seconds : params->quick ? 0.02 : 0.5;
}
