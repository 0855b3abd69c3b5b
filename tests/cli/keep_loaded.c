/* Preloaded under the address sanitizer: keeps libraries in memory. The Vulkan loader unloads its drivers, and leaks
 * of an unloaded driver could no longer be attributed and suppressed by name. */
int dlclose(void *library);

int dlclose(void *library)
{
    (void)library;
    return 0;
}
