#include "base/decimal.h"

#include <math.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Giulietti's g(k): the 128 leading bits of 10^k, rounded up unless they are exact. k is K_MIN to K_MAX. */
#define K_MIN (-292)
#define K_MAX 324
/* number of 32-bit words: enough for 10^324 (1077 bits), and for 2^1152, whose quotient by 10^292 keeps 183 bits */
#define WORDS 38

struct g { uint64_t high, low; };
static struct g powers[K_MAX - K_MIN + 1];

struct big { uint32_t word[WORDS]; /* the least significant word is word[0] */ };

static void multiply_by_ten(struct big *n)
{
    uint64_t carry = 0;
    for (int i = 0; i < WORDS; i++) {
        carry += (uint64_t)n->word[i] * 10;
        n->word[i] = (uint32_t)carry;
        carry >>= 32;
    }
}

static void divide_by_ten(struct big *n)
{
    uint64_t rest = 0;
    for (int i = WORDS - 1; i >= 0; i--) {
        rest = rest << 32 | n->word[i];
        n->word[i] = (uint32_t)(rest / 10);
        rest %= 10;
    }
}

static uint32_t bit(const struct big *n, int at) { return at < 0 ? 0 : n->word[at / 32] >> (at % 32) & 1; }

static struct g leading_bits(const struct big *n, int exact)
{
    int top = WORDS * 32 - 1;
    struct g g = { 0, 0 };
    while (!bit(n, top))
        top--;
    for (int i = 0; i < 128; i++) {
        g.high = g.high << 1 | g.low >> 63;
        g.low = g.low << 1 | bit(n, top - i);
    }
    for (int i = top - 128; i >= 0 && exact; i--)
        exact = !bit(n, i);
    if (!exact && !++g.low)
        g.high++;
    return g;
}

static void make_powers(void)
{
    struct big up = { { 1 } }, down = { { 0 } };
    for (int k = 0; k <= K_MAX; k++) {
        powers[k - K_MIN] = leading_bits(&up, 1);
        if (k < K_MAX)
            multiply_by_ten(&up);
    }
    /* rounding down after each division gives the same result as one division by the product */
    down.word[WORDS - 2] = 1;
    for (int k = -1; k >= K_MIN; k--) {
        divide_by_ten(&down);
        powers[k - K_MIN] = leading_bits(&down, 0);
    }
}

__extension__ typedef unsigned __int128 wide;

/* Returns the leading 64 bits of g n / 2^127, rounded to odd: the last bit is also set if any lower bit of the
 * number is set. */
static uint64_t round_to_odd(struct g g, uint64_t n)
{
    wide x = (wide)g.low * n, y = (wide)g.high * n + (uint64_t)(x >> 64);
    return (uint64_t)(y >> 64) | ((uint64_t)y > 1);
}

struct decimal {
    uint64_t digits;
    int exponent;
};

/* Finds the shortest decimal that reads back as c 2^q. The names are those of the paper. */
static struct decimal shortest(uint64_t c, int q, int lower_is_closer)
{
    uint64_t odd = c & 1;
    int k = (q * 1262611 - (lower_is_closer ? 524031 : 0)) >> 22; /* floor of the log10 of the interval's length */
    int h = q + (-k * 1741647 >> 19) + 1;
    struct g g = powers[-k - K_MIN];
    uint64_t lower = round_to_odd(g, (4 * c - 2 + (uint64_t)lower_is_closer) << h) + odd;
    uint64_t middle = round_to_odd(g, 4 * c << h);
    uint64_t upper = round_to_odd(g, (4 * c + 2) << h) - odd;
    uint64_t s = middle / 4;

    if (s >= 10) {
        uint64_t tens = s / 10;
        int below = lower <= 40 * tens, above = 40 * tens + 40 <= upper;
        if (below != above)
            return (struct decimal) { tens + (uint64_t)above, k + 1 };
    }
    int below = lower <= 4 * s, above = 4 * s + 4 <= upper;
    if (below != above)
        return (struct decimal) { s + (uint64_t)above, k };
    uint64_t half = 4 * s + 2;
    return (struct decimal) { s + (middle > half || (middle == half && (s & 1))), k };
}

static struct decimal take_apart(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    uint64_t fraction = bits & ((1ull << 52) - 1);
    int exponent = (int)(bits >> 52 & 0x7ff);
    struct decimal d = exponent ? shortest(fraction | 1ull << 52, exponent - 1075, !fraction && exponent > 1)
                                : shortest(fraction, -1074, 0);
    while (d.digits % 10 == 0) {
        d.digits /= 10;
        d.exponent++;
    }
    return d;
}

static size_t write_digits(char *out, uint64_t digits)
{
    char reversed[20];
    size_t n = 0;
    for (; digits; digits /= 10)
        reversed[n++] = (char)('0' + digits % 10);
    for (size_t i = 0; i < n; i++)
        out[i] = reversed[n - 1 - i];
    return n;
}

/* Writes a number far from 1 in scientific form, as in 1.234e-7. */
static size_t write_scientific(char *out, const char *digits, size_t n, int exponent)
{
    size_t used = 0;
    out[used++] = digits[0];
    if (n > 1) {
        out[used++] = '.';
        memcpy(out + used, digits + 1, n - 1);
        used += n - 1;
    }
    out[used++] = 'e';
    if (exponent < 0)
        out[used++] = '-';
    return used + write_digits(out + used, (uint64_t)(exponent < 0 ? -exponent : exponent));
}

static size_t write_plain(char *out, const char *digits, size_t n, int exponent)
{
    size_t used = 0, whole = exponent < 0 ? 0 : (size_t)exponent + 1;
    if (!whole) {
        memcpy(out, "0.0000", 6);
        used = 1 + (size_t)-exponent;
        memcpy(out + used, digits, n);
        return used + n;
    }
    for (; used < whole; used++)
        out[used] = used < n ? digits[used] : '0';
    if (n > whole) {
        out[used++] = '.';
        memcpy(out + used, digits + whole, n - whole);
        used += n - whole;
    }
    return used;
}

size_t kd_decimal_print(char out[KD_DECIMAL_SIZE], double value)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    char digits[20] = { 0 };
    size_t used = 0;

    pthread_once(&once, make_powers);
    if (signbit(value))
        out[used++] = '-';
    if (value == 0) {
        memcpy(out + used, "0", 2);
        return used + 1;
    }
    struct decimal d = take_apart(fabs(value));
    size_t n = write_digits(digits, d.digits);
    int exponent = d.exponent + (int)n - 1; /* exponent of the first digit, to base 10 */
    used += exponent < -5 || exponent > 16 ? write_scientific(out + used, digits, n, exponent)
                                           : write_plain(out + used, digits, n, exponent);
    out[used] = 0;
    return used;
}

double kd_decimal_round(double value, int digits)
{
    /* Powers of ten up to 10^22 and integers up to 10^15 are exact as doubles. A product or quotient of two of them
     * is therefore rounded only once. */
    static const double exact[] = { 1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22 };
    const int most = sizeof exact / sizeof *exact - 1;
    if (!isfinite(value) || value == 0 || digits > 15)
        return value;
    int power = digits - 1 - (int)floor(log10(fabs(value)));
    if (power >= 0 && power <= most)
        return nearbyint(value * exact[power]) / exact[power];
    if (power < 0 && -power <= most)
        return nearbyint(value / exact[-power]) * exact[-power];
    char text[KD_DECIMAL_SIZE];
    snprintf(text, sizeof text, "%.*e", digits - 1, value);
    return strtod(text, NULL);
}
