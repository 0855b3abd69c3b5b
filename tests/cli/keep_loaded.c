/* Preloaded under the address sanitizer: keeps libraries in memory. The Vulkan loader unloads its drivers, and leaks of
 * an unloaded driver have no library name by which they could be suppressed. */
int dlclose(void *library);

int dlclose(void *library)
{
    (void)library;
    return 0;
}
