/* Tests of shortest decimals, compared with printf and strtod, which are independent. */
#include "base/decimal.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void known_values(void **state)
{
    (void)state;
    static const struct {
        double value;
        const char *text;
    } table[] = {
        { 0, "0" },
        { -0.0, "-0" },
        { 1, "1" },
        { -2.5, "-2.5" },
        { 0.1, "0.1" },
        { 100, "100" },
        { 0.00001, "0.00001" },
        { 1e-6, "1e-6" },
        { 0.000012345, "0.000012345" },
        { 1e16, "10000000000000000" },
        { 1e17, "1e17" },
        { 1.5e300, "1.5e300" },
        { 1e22, "1e22" },
        { 1e23, "1e23" },
        { 5e-324, "5e-324" },
        { 2.2250738585072014e-308, "2.2250738585072014e-308" },
        { 1.7976931348623157e308, "1.7976931348623157e308" },
        { -1.7976931348623157e-300, "-1.7976931348623157e-300" },
        { 9007199254740993.0, "9007199254740992" },
        { 2e-44, "2e-44" },
        { 0.3, "0.3" },
        { 1.0 / 3, "0.3333333333333333" },
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        char out[KD_DECIMAL_SIZE];
        assert_int_equal(kd_decimal_print(out, table[i].value), strlen(table[i].text));
        assert_string_equal(out, table[i].text);
    }
}

static uint64_t next(uint64_t *seed)
{
    *seed ^= *seed << 13;
    *seed ^= *seed >> 7;
    return *seed ^= *seed << 17;
}

static int digits_of(const char *text)
{
    int n = 0, zeros = 0;
    for (; *text && *text != 'e'; text++) {
        if (*text < '0' || *text > '9' || (!n && *text == '0'))
            continue;
        n++;
        zeros = *text == '0' ? zeros + 1 : 0;
    }
    return n - zeros; /* trailing zeros of whole numbers are not significant digits */
}

/* The decimal reads back as the same value. No text with one digit fewer reads back as this value, and no text with as
 * many digits is closer to it. */
static void check(double value)
{
    char out[KD_DECIMAL_SIZE], fewer[40], same[40];
    size_t length = kd_decimal_print(out, value);
    if (length != strlen(out) || length >= KD_DECIMAL_SIZE || strtod(out, NULL) != value)
        fail_msg("%s does not read back as %.17g", out, value);
    int n = digits_of(out);
    snprintf(fewer, sizeof fewer, "%.*e", n > 1 ? n - 2 : 0, value);
    if (n > 1 && strtod(fewer, NULL) == value)
        fail_msg("%s is longer than %s", out, fewer);
    snprintf(same, sizeof same, "%.*e", n ? n - 1 : 0, value);
    if (strtod(same, NULL) == value && strtold(same, NULL) != strtold(out, NULL))
        fail_msg("%s is not as near to %.25g as %s", out, value, same);
}

static void every_power_of_two(void **state)
{
    (void)state;
    for (int e = -1074; e < 1024; e++) {
        double power = ldexp(1, e);
        check(power);
        check(nextafter(power, INFINITY));
        check(nextafter(power, 0) > 0 ? nextafter(power, 0) : power);
    }
}

static void any_bits(void **state)
{
    (void)state;
    uint64_t seed = 88172645463325252u;
    for (int i = 0; i < 200000; i++) {
        uint64_t bits = next(&seed);
        double value;
        memcpy(&value, &bits, sizeof value);
        if (isfinite(value) && value != 0)
            check(value);
        check(ldexp((double)(int64_t)next(&seed), -60)); /* results of physics */
        check((double)(next(&seed) % 1000000) / 1000);   /* typed numbers */
    }
}

/* The result equals that of printf and strtod, unless two candidates are equally close within rounding. */
static void rounded(void **state)
{
    (void)state;
    uint64_t seed = 362436069362436069u;
    for (int i = 0; i < 400000; i++) {
        const double value = i % 2 ? ldexp((double)(int64_t)next(&seed), -(int)(next(&seed) % 240))
                                   : 1e-3 * (double)(int64_t)(next(&seed) % 2000001) - 1000;
        const int digits = 1 + (int)(next(&seed) % 17);
        char text[64], shown[KD_DECIMAL_SIZE];
        snprintf(text, sizeof text, "%.*e", digits - 1, value);
        const double got = kd_decimal_round(value, digits), want = digits > 15 ? value : strtod(text, NULL);
        kd_decimal_print(shown, got);
        if (digits < 16 && digits_of(shown) > digits)
            fail_msg("%.17g in %d digits is %s", value, digits, shown);
        if (got != want && fabs(fabs(got - value) - fabs(want - value)) > 4e-16 * fabs(value))
            fail_msg("%.17g in %d digits is %.17g, not %.17g", value, digits, got, want);
    }
    assert_true(isnan(kd_decimal_round(NAN, 3)) && isinf(kd_decimal_round(INFINITY, 3)) && kd_decimal_round(0, 3) == 0);
    assert_true(kd_decimal_round(9.9996, 4) == 10 && kd_decimal_round(-0.00012345678, 3) == -0.000123 &&
                kd_decimal_round(1.23456e-200, 2) == 1.2e-200);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_values),
        cmocka_unit_test(every_power_of_two),
        cmocka_unit_test(any_bits),
        cmocka_unit_test(rounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
