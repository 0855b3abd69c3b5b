#include "image/deflate_walk.h"

#include <string.h>

enum { BITS_MAX = 15, FAST = 11, LITERALS = 288, DISTANCES = 32, LENGTHS = 19, END_OF_BLOCK = 256, BAD = -1 };

struct bits {
    const uint8_t *begin, *at, *end;
    uint64_t held; /* the next bits of the stream; the first one is the lowest */
    unsigned n;    /* number of bits in `held` */
    size_t taken;
};

/* A Huffman code (RFC 1951, 3.2.2). Codes of up to FAST bits are found in a table that is indexed by the next bits.
 * An entry of the table has the kind of the symbol, and the number of bits of the symbol including its extra bits.
 * Longer codes are searched for among the sorted symbols, as in Mark Adler's puff.c. */
enum kind { LONG, PLAIN, LENGTH, END };
struct entry { uint8_t bits, kind; };
struct code {
    struct entry fast[1 << FAST];
    uint16_t count[BITS_MAX + 1], symbols[LITERALS];
};

/* Number of extra bits of each length, from symbol 257 on, and of each distance (section 3.2.5). */
static const uint8_t length_extra[29] = { 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                          2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0 };
static const uint8_t distance_extra[30] = { 0, 0, 0, 0, 1, 1, 2, 2,  3,  3,  4,  4,  5,  5,  6,
                                            6, 7, 7, 8, 8, 9, 9, 10, 10, 11, 11, 12, 12, 13, 13 };

/* Loads bits until at least 56 are held. After the end of the stream, zeros are loaded. */
static inline void refill(struct bits *b)
{
    if (b->end - b->at >= 8) {
        uint64_t word;
        memcpy(&word, b->at, 8);
        if (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__)
            word = __builtin_bswap64(word);
        b->held |= word << b->n;
        b->at += (63 - b->n) >> 3;
        b->n |= 56;
        return;
    }
    for (; b->n <= 56 && b->at < b->end; b->n += 8)
        b->held |= (uint64_t)*b->at++ << b->n;
}

static inline bool drop(struct bits *b, unsigned n)
{
    if (n > b->n)
        return false;
    b->held >>= n;
    b->n -= n;
    b->taken += n;
    return true;
}

/* Takes n bits, 0 to 16. Returns BAD if there are not enough bits. */
static int take(struct bits *b, unsigned n)
{
    refill(b);
    const int value = (int)(b->held & ((UINT64_C(1) << n) - 1));
    return drop(b, n) ? value : BAD;
}

static struct entry entry_of(unsigned symbol, bool distances)
{
    if (distances)
        return (struct entry) { symbol < 30 ? distance_extra[symbol] : 0, PLAIN };
    if (symbol < END_OF_BLOCK)
        return (struct entry) { 0, PLAIN };
    if (symbol == END_OF_BLOCK)
        return (struct entry) { 0, END };
    return (struct entry) { symbol < 286 ? length_extra[symbol - 257] : 0, LENGTH };
}

static unsigned reversed(unsigned value, unsigned n)
{
    unsigned r = 0;
    for (; n--; value >>= 1)
        r = r << 1 | (value & 1);
    return r;
}

static bool make(struct code *code, const uint8_t *lengths, unsigned n, bool distances)
{
    unsigned next[BITS_MAX + 2] = { 0 }, place[BITS_MAX + 2] = { 0 }, all = 0;
    memset(code->count, 0, sizeof code->count);
    memset(code->fast, 0, sizeof code->fast);
    for (unsigned i = 0; i < n; i++)
        code->count[lengths[i]]++;
    code->count[0] = 0;
    for (unsigned l = 1; l <= BITS_MAX; l++) {
        all += (unsigned)code->count[l] << (BITS_MAX - l);
        next[l + 1] = (next[l] + code->count[l]) << 1;
        place[l + 1] = place[l] + code->count[l];
    }
    if (all > 1u << BITS_MAX) /* more codes than are possible */
        return false;
    for (unsigned i = 0; i < n; i++) {
        const unsigned l = lengths[i];
        if (!l)
            continue;
        code->symbols[place[l]++] = (uint16_t)i;
        struct entry e = entry_of(i, distances);
        e.bits = (uint8_t)(e.bits + l);
        for (unsigned k = reversed(next[l]++, l); l <= FAST && k < 1 << FAST; k += 1u << l)
            code->fast[k] = e;
    }
    return true;
}

/* Finds the symbol whose code comes next. *bits: length of the code. Returns BAD if there is no such symbol. */
static int find(const struct code *code, uint64_t held, unsigned *bits)
{
    int value = 0, first = 0, place = 0;
    for (unsigned l = 1; l <= BITS_MAX; l++, held >>= 1) {
        const int count = code->count[l];
        value |= (int)(held & 1);
        if (value - count < first) {
            *bits = l;
            return code->symbols[place + value - first];
        }
        place += count;
        first = (first + count) << 1;
        value <<= 1;
    }
    return BAD;
}

static inline struct entry next_entry(const struct code *code, uint64_t held, bool distances)
{
    struct entry e = code->fast[held & ((1 << FAST) - 1)];
    unsigned bits;
    int symbol;
    if (e.kind != LONG)
        return e;
    symbol = find(code, held, &bits);
    if (symbol == BAD)
        return e;
    e = entry_of((unsigned)symbol, distances);
    e.bits = (uint8_t)(e.bits + bits);
    return e;
}

/* One refill is enough for a length and a distance, which take up to 20 and 28 bits. */
static bool symbols(struct bits *b, const struct code *literals, const struct code *distances)
{
    for (;;) {
        refill(b);
        const struct entry e = next_entry(literals, b->held, false);
        if (e.kind == LONG || !drop(b, e.bits))
            return false;
        if (e.kind == END)
            return true;
        if (e.kind == PLAIN)
            continue;
        const struct entry d = next_entry(distances, b->held, true);
        if (d.kind == LONG || !drop(b, d.bits))
            return false;
    }
}

static bool stored(struct bits *b)
{
    if (take(b, (unsigned)(-b->taken & 7)) == BAD)
        return false;
    const int size = take(b, 16), inverted = take(b, 16);
    const size_t first = b->taken / 8, left = (size_t)(b->end - b->begin) - first;
    if (size == BAD || inverted == BAD || (size ^ inverted) != 0xffff || (size_t)size > left)
        return false;
    b->at = b->begin + first + size;
    b->taken += 8 * (size_t)size;
    b->held = b->n = 0;
    return true;
}

/* Reads the code lengths of both Huffman codes, which are stored as runs (section 3.2.7). */
static bool read_lengths(struct bits *b, const struct code *runs, uint8_t *lengths, unsigned n)
{
    for (unsigned i = 0; i < n;) {
        unsigned bits;
        refill(b);
        const int symbol = find(runs, b->held, &bits);
        if (symbol == BAD || !drop(b, bits) || (symbol == 16 && !i))
            return false;
        const int extra = symbol < 16 ? 0 : take(b, symbol == 16 ? 2 : symbol == 17 ? 3 : 7);
        const unsigned times = symbol < 16 ? 1 : (unsigned)extra + (symbol == 18 ? 11 : 3);
        if (extra == BAD || times > n - i)
            return false;
        memset(lengths + i, symbol < 16 ? symbol : symbol == 16 ? lengths[i - 1] : 0, times);
        i += times;
    }
    return true;
}

static bool make_dynamic(struct bits *b, struct code *literals, struct code *distances)
{
    static const uint8_t order[LENGTHS] = { 16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15 };
    uint8_t lengths[LITERALS + DISTANCES] = { 0 };
    const int n_literals = take(b, 5), n_distances = take(b, 5), n = take(b, 4);
    for (int i = 0; i < n + 4 && n != BAD; i++) {
        const int length = take(b, 3);
        if (length == BAD)
            return false;
        lengths[order[i]] = (uint8_t)length;
    }
    if (n == BAD || n_literals > 29 || n_distances > 29 || !make(literals, lengths, LENGTHS, false))
        return false;
    memset(lengths, 0, sizeof lengths);
    const unsigned first = (unsigned)n_literals + 257, second = (unsigned)n_distances + 1;
    return read_lengths(b, literals, lengths, first + second) && make(literals, lengths, first, false) &&
           make(distances, lengths + first, second, true);
}

static bool make_fixed(struct code *literals, struct code *distances)
{
    uint8_t lengths[LITERALS];
    for (int i = 0; i < LITERALS; i++)
        lengths[i] = i < 144 || i > 279 ? 8 : i < 256 ? 9 : 7;
    if (!make(literals, lengths, LITERALS, false))
        return false;
    memset(lengths, 5, 30);
    return make(distances, lengths, 30, true);
}

bool kd_deflate_walk(const uint8_t *stream, size_t size, struct kd_deflate_walk *out)
{
    struct bits b = { .begin = stream, .at = stream, .end = stream + size };
    struct code literals, distances;
    for (int last = 0; !last;) {
        out->last = b.taken;
        last = take(&b, 1);
        const int kind = take(&b, 2);
        if (kind == BAD || kind == 3)
            return false;
        const bool made = kind == 0   ? true
                          : kind == 1 ? make_fixed(&literals, &distances)
                                      : make_dynamic(&b, &literals, &distances);
        if (!made || !(kind ? symbols(&b, &literals, &distances) : stored(&b)))
            return false;
    }
    out->end = b.taken;
    return out->end <= 8 * size;
}
