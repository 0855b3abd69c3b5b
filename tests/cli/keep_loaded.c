/* Preloaded under the address sanitizer. Keeps libraries in memory, because the Vulkan loader unloads its drivers:
 * leaks of an unloaded driver would be reported without a library's name, and could not be suppressed by name. */
int dlclose(void *library);

int dlclose(void *library)
{
    (void)library;
    return 0;
}
