"""A decoder of baseline JPEG, written from ITU T.81 and JFIF alone, so that it is independent of the library that
encodes. It is slow and meant for small pictures."""

import math
import struct

ZIGZAG = [
    0,
    1,
    8,
    16,
    9,
    2,
    3,
    10,
    17,
    24,
    32,
    25,
    18,
    11,
    4,
    5,
    12,
    19,
    26,
    33,
    40,
    48,
    41,
    34,
    27,
    20,
    13,
    6,
    7,
    14,
    21,
    28,
    35,
    42,
    49,
    56,
    57,
    50,
    43,
    36,
    29,
    22,
    15,
    23,
    30,
    37,
    44,
    51,
    58,
    59,
    52,
    45,
    38,
    31,
    39,
    46,
    53,
    60,
    61,
    54,
    47,
    55,
    62,
    63,
]
COSINES = [
    [(math.sqrt(0.5) if u == 0 else 1) / 2 * math.cos((2 * x + 1) * u * math.pi / 16) for u in range(8)]
    for x in range(8)
]


class Bits:
    def __init__(self, data):
        self.data, self.at, self.held, self.count = data.replace(b"\xff\x00", b"\xff"), 0, 0, 0

    def take(self, n):
        while self.count < n:
            self.held = self.held << 8 | (self.data[self.at] if self.at < len(self.data) else 0)
            self.at += 1
            self.count += 8
        self.count -= n
        value = self.held >> self.count
        self.held &= (1 << self.count) - 1
        return value

    def symbol(self, codes):
        code = length = 0
        while (length, code) not in codes:
            code, length = code << 1 | self.take(1), length + 1
            assert length <= 16, "no code of the table"
        return codes[length, code]

    def signed(self, n):
        value = self.take(n) if n else 0
        return value if not n or value >> (n - 1) else value - (1 << n) + 1


def huffman(lengths, values):
    codes, code, values = {}, 0, iter(values)
    for length, count in enumerate(lengths, 1):
        for _ in range(count):
            codes[length, code] = next(values)
            code += 1
        code <<= 1
    return codes


def block(bits, dc, ac, table, before):
    """The samples of one block of 8 x 8, row by row, and its constant coefficient."""
    out = [0] * 64
    before += bits.signed(bits.symbol(dc))
    out[0], k = before * table[0], 1
    while k < 64:
        run, size = divmod(bits.symbol(ac), 16)
        if not size and run < 15:
            break
        k += run
        out[ZIGZAG[k]] = bits.signed(size) * table[k]
        k += 1
    rows = [[sum(COSINES[x][u] * out[8 * v + u] for u in range(8)) for x in range(8)] for v in range(8)]
    return [128 + sum(COSINES[y][v] * rows[v][x] for v in range(8)) for y in range(8) for x in range(8)], before


def segments(data):
    assert data[:2] == b"\xff\xd8" and data[-2:] == b"\xff\xd9", "begins and ends as a JPEG does"
    at = 2
    while True:
        marker, size = struct.unpack(">HH", data[at : at + 4])
        yield marker & 255, data[at + 4 : at + 2 + size]
        at += 2 + size
        if marker == 0xFFDA:
            yield None, data[at:-2]
            return


def decode(data):
    """Decodes a file. Returns (width, height, bytes of RGB, the number of pixels in each direction that share a sample
    of colour)."""
    tables, codes, parts = {}, {}, []
    for marker, body in segments(data):
        if marker == 0xDB:
            for i in range(0, len(body), 65):
                assert body[i] < 4, "8 bits"
                tables[body[i]] = body[i + 1 : i + 65]
        elif marker == 0xC4:
            while body:
                n = sum(body[1:17])
                codes[body[0]] = huffman(body[1:17], body[17 : 17 + n])
                body = body[17 + n :]
        elif marker == 0xC0:
            bits, height, width, n = struct.unpack(">BHHB", body[:6])
            assert (bits, n) == (8, 3)
            parts = [
                dict(h=body[7 + 3 * i] >> 4, v=body[7 + 3 * i] & 15, table=body[8 + 3 * i], dc=0, samples={})
                for i in range(3)
            ]
        elif marker == 0xDA:
            for i, part in enumerate(parts):
                part["codes"] = codes[body[2 + 2 * i] >> 4], codes[16 | body[2 + 2 * i] & 15]
        elif marker is None:
            scan(Bits(body), parts, tables, width, height)
        else:
            assert marker in (0xE0,), hex(marker)
    most = [max(p[side] for p in parts) for side in "hv"]
    out = bytearray()
    for y in range(height):
        for x in range(width):
            luma, blue, red = (p["samples"][y * p["v"] // most[1], x * p["h"] // most[0]] for p in parts)
            blue, red = blue - 128, red - 128
            out += bytes(
                min(max(round(c), 0), 255)
                for c in (luma + 1.402 * red, luma - 0.344136 * blue - 0.714136 * red, luma + 1.772 * blue)
            )
    return width, height, bytes(out), tuple(most)


def scan(bits, parts, tables, width, height):
    most = [max(p[side] for p in parts) for side in "hv"]
    for row in range(-(-height // (8 * most[1]))):
        for column in range(-(-width // (8 * most[0]))):
            for part in parts:
                for j in range(part["v"]):
                    for i in range(part["h"]):
                        samples, part["dc"] = block(bits, *part["codes"], tables[part["table"]], part["dc"])
                        top, left = 8 * (row * part["v"] + j), 8 * (column * part["h"] + i)
                        part["samples"].update({(top + k // 8, left + k % 8): value for k, value in enumerate(samples)})
