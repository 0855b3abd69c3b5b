/* Preloaded under the address sanitizer: keeps libraries in memory. The Vulkan loader unloads its drivers. Leaks of an
 * unloaded driver have no library name, and could not be suppressed by name. */
int dlclose(void *library);

int dlclose(void *library)
{
    (void)library;
    return 0;
}
