/* Tests that docs/approximations.md lists every approximation that a plan may state. */
#include "render/explain/approximations.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void reference_is_current(void **state)
{
    (void)state;
    struct kd_buffer page = { 0 };
    assert_int_equal(kd_approximations_page(&page), KD_OK);
    FILE *file = fopen(KD_REFERENCE, "rb");
    if (!file)
        fail_msg("cannot open " KD_REFERENCE);
    char *text = calloc(1, page.size + 2);
    assert_non_null(text);
    size_t size = fread(text, 1, page.size + 1, file);
    fclose(file);
    if (size != page.size || memcmp(text, page.data, size))
        fail_msg("docs/approximations.md is not what emitters and plans say; update it with\n"
                 "    BUILD/src/render/kd_approximations > docs/approximations.md");
    free(text);
    kd_buffer_finish(&page);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(reference_is_current) };
    return cmocka_run_group_tests_name("approximations", tests, NULL, NULL);
}
