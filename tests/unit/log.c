/* Tests of log lines: there is one line for each event, whatever its message contains, both as text and as JSON. */
#include "base/log.h"
#include "base/utf8.h"

#include <cjson/cJSON.h>
#include <fcntl.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static char text[16384];
static int before;
static FILE *file;

static void begin(void)
{
    file = tmpfile();
    before = dup(STDERR_FILENO);
    assert_non_null(file);
    dup2(fileno(file), STDERR_FILENO);
}

/* The text written since `begin`: one line, without its end. */
static const char *written(void)
{
    dup2(before, STDERR_FILENO);
    close(before);
    rewind(file);
    const size_t n = fread(text, 1, sizeof text - 1, file);
    text[n] = 0;
    fclose(file);
    assert_true(n > 0);
    assert_ptr_equal(strchr(text, '\n'), text + n - 1);
    text[n - 1] = 0;
    return text;
}

static void test_print(void **state)
{
    static const struct {
        const char *given, *printed;
    } all[] = {
        { "plain \"and\" \\", "plain \"and\" \\" },
        { "a\nb\r\tc", "a\\x0ab\\x0d\\x09c" },
        { "\x1b[31m\x7f", "\\x1b[31m\\x7f" },
        { "\xc2\x9b"
          "31m",
          "\\xc2\\x9b"
          "31m" },
        { "\xc2\xa0ü€𝄞", "\xc2\xa0ü€𝄞" },
        { "\xff\xc3(", "\\xff\\xc3(" },
        { "\xe2\x82", "\\xe2\\x82" },
        { "", "" },
    };
    char out[64];
    (void)state;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        kd_utf8_print(out, sizeof out, all[i].given);
        assert_string_equal(out, all[i].printed);
        assert_true(kd_utf8_valid(out));
    }
    for (size_t size = 1; size < 12; size++) { /* cut between characters */
        memset(out, 'x', sizeof out);
        kd_utf8_print(out, size, "aü\n€");
        assert_true(strlen(out) < size && kd_utf8_valid(out));
        assert_int_equal(strncmp(out, "aü\\x0a€", strlen(out)), 0);
        assert_int_equal(out[size], 'x');
    }
}

static void test_text(void **state)
{
    (void)state;
    kd_log_set_format(KD_LOG_TEXT);
    begin();
    kd_log(KD_LOG_ERROR, "a %s\nkerrd: error: forged", "b");
    assert_string_equal(written(), "kerrd: error: a b\\x0akerrd: error: forged");
    begin();
    kd_log(KD_LOG_INFO, "below the level");
    kd_log_event(KD_LOG_WARN, "kind", NULL, 0, "of an event");
    assert_string_equal(written(), "kerrd: warning: of an event");
}

static const char *member(const cJSON *line, const char *name)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(line, name);
    return item ? cJSON_GetStringValue(item) : NULL;
}

static void test_json(void **state)
{
    (void)state;
    kd_log_set_format(KD_LOG_JSON);
    begin();
    kd_log(KD_LOG_WARN, "a \"%s\"\n{}\x1b\xff", "b");
    cJSON *line = cJSON_Parse(written());
    assert_non_null(line);
    assert_string_equal(member(line, "level"), "warning");
    assert_string_equal(member(line, "event"), "message");
    assert_string_equal(member(line, "message"), "a \"b\"\\x0a{}\\x1b\\xff");
    assert_int_equal(strlen(member(line, "time")), strlen("2026-11-26T20:10:11.123Z"));
    cJSON_Delete(line);

    const struct kd_log_member members[] = { { "text", "x\ny", 0 }, { "number", NULL, 1.5 }, { "absent", NULL, NAN } };
    begin();
    kd_log_event(KD_LOG_ERROR, "kind", members, 3, "not told");
    line = cJSON_Parse(written());
    assert_non_null(line);
    assert_string_equal(member(line, "event"), "kind");
    assert_string_equal(member(line, "text"), "x\\x0ay");
    assert_true(cJSON_GetObjectItemCaseSensitive(line, "number")->valuedouble == 1.5);
    assert_null(cJSON_GetObjectItemCaseSensitive(line, "absent"));
    assert_null(cJSON_GetObjectItemCaseSensitive(line, "message"));
    cJSON_Delete(line);
    kd_log_set_format(KD_LOG_TEXT);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_print), cmocka_unit_test(test_text),
                                        cmocka_unit_test(test_json) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
