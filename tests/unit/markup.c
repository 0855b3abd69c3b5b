/* Tests of text in HTML and XML: escaped text reads back unchanged. */
#include "base/markup.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

static void escaped(const char *text, const char *characters, const char *expected)
{
    struct kd_buffer out = { 0 };
    assert_int_equal(kd_markup_escape(text, characters, &out), KD_OK);
    assert_string_equal((const char *)out.data, expected);
    kd_markup_unescape(&out);
    assert_string_equal((const char *)out.data, text);
    kd_buffer_finish(&out);
}

static void there_and_back(void **state)
{
    (void)state;
    escaped("", KD_MARKUP_CONTENT, "");
    escaped("{\"a\":1}", KD_MARKUP_CONTENT, "{\"a\":1}");
    escaped("<a> & ]]> \"b\" 'c'", KD_MARKUP_CONTENT, "&lt;a&gt; &amp; ]]&gt; \"b\" 'c'");
    escaped("<a> & \"b\" 'c'", KD_MARKUP_ATTRIBUTE, "&lt;a&gt; &amp; &quot;b&quot; &#39;c&#39;");
    escaped("&lt; &amp;amp; &", KD_MARKUP_CONTENT, "&amp;lt; &amp;amp;amp; &amp;");
}

/* Other references, and pieces of known ones, stay as they are. */
static void what_is_no_reference(void **state)
{
    struct kd_buffer text = { 0 };
    (void)state;
    assert_int_equal(kd_buffer_printf(&text, "&nbsp; &am &gt&gt; &"), KD_OK);
    kd_markup_unescape(&text);
    assert_string_equal((const char *)text.data, "&nbsp; &am &gt> &");
    kd_buffer_finish(&text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(there_and_back),
        cmocka_unit_test(what_is_no_reference),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
