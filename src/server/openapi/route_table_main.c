/* A program that prints docs/routes.md. */
#include "server/openapi/route_table.h"

#include <stdio.h>

int main(void)
{
    struct kd_buffer page = { 0 };
    enum kd_status status = kd_route_table_markdown(&page);
    int failed = status || fwrite(page.data, 1, page.size, stdout) != page.size || fflush(stdout);
    kd_buffer_finish(&page);
    return failed ? 1 : 0;
}
