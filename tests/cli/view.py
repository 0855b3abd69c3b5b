"""Tests of kerrd view in a simulated terminal. The terminal answers like kitty, like a terminal with sixel, like a
terminal without either, or not at all. The pictures that it receives are decoded."""

import base64
import fcntl
import json
import os
import pty
import re
import signal
import struct
import subprocess
import termios
import threading
import time
import zlib

from support import KERRD, SMALL, Case, main

KITTY, SIXEL, NEITHER = b"\x1b_Gi=31;OK\x1b\\\x1b[?62;c", b"\x1b[?62;4;22c", b"\x1b[?6c"


class Terminal:
    """Runs kerrd in a pseudo-terminal. The terminal answers all queries at once, after the last one has arrived."""

    def __init__(self, *args, answer=b"", columns=80, rows=24, pixels=(640, 384), env=None, cwd=None, keys=b""):
        master, slave = pty.openpty()
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, *pixels))
        settings = termios.tcgetattr(slave)
        self.got, self.answer, self.keys = b"", answer, keys

        def own():
            os.setsid()
            fcntl.ioctl(slave, termios.TIOCSCTTY, 0)

        begun = time.monotonic()
        program = subprocess.Popen(
            [KERRD, "view", *args],
            stdin=slave,
            stdout=slave,
            stderr=subprocess.PIPE,
            preexec_fn=own,
            env=env or os.environ,
            cwd=cwd,
        )
        reader = threading.Thread(target=self.talk, args=(master,))
        reader.start()
        self.stderr = program.communicate(timeout=120)[1].decode()
        self.code, self.seconds = program.returncode, time.monotonic() - begun
        self.kept = termios.tcgetattr(slave) == settings
        os.close(slave)
        reader.join()
        os.close(master)
        self.queries, _, self.sent = self.got.partition(b"\x1b[c")
        self.sent = self.sent.replace(b"\r\n", b"\n")  # the terminal's driver converts \n to \r\n

    def talk(self, master):
        answered = False
        try:
            while data := os.read(master, 65536):
                self.got += data
                if b"\x1b[c" in self.got and not answered:
                    answered = True
                    for piece in (self.keys, self.answer[:5], self.answer[5:]):  # sent in several parts
                        time.sleep(0.02)
                        os.write(master, piece) if piece else None
        except OSError:
            pass  # ignored: the other end of the terminal is closed


def kitty(sent):
    """Returns the control keys of the first command, the bytes of the picture, and the output outside the commands."""
    commands = re.findall(rb"\x1b_G([^;]*);([^\x1b]*)\x1b\\", sent)
    for i, (controls, text) in enumerate(commands):
        last = i + 1 == len(commands)
        assert controls.endswith(b"m=0" if last else b"m=1"), controls
        assert len(text) == 4096 or last and 0 < len(text) <= 4096
    return (
        commands[0][0],
        base64.b64decode(b"".join(text for _, text in commands), validate=True),
        re.sub(rb"\x1b_G[^\x1b]*\x1b\\", b"", sent),
    )


def sixel(sent):
    """Decodes a sixel picture. Returns width, height, rows of (r, g, b) from 0 to 255, and the output after the
    picture."""
    body, _, rest = sent.partition(b"\x1bP")[2].partition(b"q")[2].partition(b"\x1b\\")
    head = re.match(rb'"1;1;(\d+);(\d+)', body)
    width, height = int(head[1]), int(head[2])
    rows, colours, now, x, y = [[None] * width for _ in range(height + 6)], {}, None, 0, 0
    for define, n, red, green, blue, select, many, what, back, down in re.findall(
        rb"(#(\d+);2;(\d+);(\d+);(\d+))|#(\d+)|(?:!(\d+))?([?-~])|(\$)|(-)", body[head.end() :]
    ):
        if define:
            now = int(n)
            colours[now] = tuple(round(int(part) * 2.55) for part in (red, green, blue))
        elif select:
            now = int(select)
        elif what:
            for i in range(int(many or 1)):
                for bit in range(6):
                    if what[0] - 63 >> bit & 1:
                        rows[y + bit][x + i] = colours[now]
            x += int(many or 1)
        else:
            x, y = 0, y + (6 if down else 0)
    return width, height, rows[:height], rest


def pixels(png):
    """The pixels of an 8-bit RGB file, and its size."""
    at, data = 8, b""
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at : at + 8])
        if kind == b"IHDR":
            width, height = struct.unpack(">II", png[at + 8 : at + 16])
        data += png[at + 8 : at + 8 + length] if kind == b"IDAT" else b""
        at += 12 + length
    data, rows, above = zlib.decompress(data), [], bytes(3 * width)
    for y in range(height):
        kind, row = data[y * (3 * width + 1)], bytearray(data[y * (3 * width + 1) + 1 : (y + 1) * (3 * width + 1)])
        for i in range(3 * width):
            a, b, c = row[i - 3] if i > 2 else 0, above[i], above[i - 3] if i > 2 else 0
            near = min((a, b, c), key=lambda value: abs(a + b - c - value))
            row[i] = row[i] + (0, a, b, (a + b) // 2, near)[kind] & 255
        rows.append([tuple(row[i : i + 3]) for i in range(0, 3 * width, 3)])
        above = row
    return width, height, rows


def block_means(rows, size=6):
    """Means over blocks of pixels, which remove dithering."""
    for y in range(0, len(rows) - size + 1, size):
        for x in range(0, len(rows[0]) - size + 1, size):
            block = [rows[y + j][x + i] for j in range(size) for i in range(size)]
            yield tuple(sum(pixel[channel] for pixel in block) / len(block) for channel in range(3))


class View(Case):
    def rendered(self, *args):
        self.good("render", *args, "-o", self.path("same.png"))
        return self.read("same.png")

    def test_kitty(self):
        shown = Terminal(*SMALL, answer=KITTY)
        self.assertEqual((shown.code, shown.stderr), (0, ""))
        controls, png, rest = kitty(shown.sent)
        self.assertEqual((controls[:12], rest), (b"a=T,f=100,q=", b"\n"))
        self.assertEqual(png, self.rendered(*SMALL))
        self.assertTrue(shown.kept)

    def test_kitty_before_sixel(self):
        self.assertEqual(kitty(Terminal(*SMALL, answer=KITTY[:12] + SIXEL).sent)[1], self.rendered(*SMALL))
        # kitty's answer comes after the answer about sixel, and is ignored because it is late
        shown = Terminal(*SMALL, answer=SIXEL + KITTY[:12])
        self.assertIn(b"\x1bP", shown.sent)

    def test_sixel(self):
        shown = Terminal("--size", "192x108", answer=SIXEL)
        self.assertEqual((shown.code, shown.stderr), (0, ""))
        width, height, rows, rest = sixel(shown.sent)
        self.assertEqual((width, height, rest), (192, 108, b"\n"))
        _, _, wanted = pixels(self.rendered("--size", "192x108"))
        self.assertNotIn(None, [pixel for row in rows for pixel in row])
        # Allowed error: that of this picture with a dithered palette of 256 colours whose components are multiples of
        # 1/100. The multiples contribute 2.55/2, the palette the rest.
        errors = [abs(a - b) for mean, want in zip(block_means(rows), block_means(wanted)) for a, b in zip(mean, want)]
        self.assertLess(max(errors), 12)
        self.assertLess(sum(errors) / len(errors), 2)

    def test_neither(self):
        for answer, seconds in (
            (NEITHER, 0),
            (b"", 2),
            (b"\x1b[?6", 2),
            (b"\x1b_Gi=31;ENOTSUPPORTED\x1b\\" + NEITHER, 0),
        ):
            shown = Terminal(*SMALL, answer=answer)
            self.assertEqual((shown.code, shown.sent), (1, b""), answer)
            self.assertIn(
                "this terminal supports neither kitty's graphics nor sixel: `kerrd render -o FILE.png`", shown.stderr
            )
            self.assertEqual(shown.stderr.count("\n"), 1)
            self.assertTrue(shown.kept)
            self.assertGreaterEqual(shown.seconds, seconds)
        self.assertIn(
            "or the tmux in front of it",
            Terminal(*SMALL, answer=NEITHER, env={**os.environ, "TMUX": "/tmp/x,1,0"}).stderr,
        )
        # a list with "44" and "64" does not contain the attribute 4, which means sixel
        self.assertNotEqual(Terminal(*SMALL, answer=NEITHER.replace(b"6", b"44;64")).code, 0)

    def test_typed_meanwhile(self):
        self.assertEqual(Terminal(*SMALL, answer=KITTY, keys=b"ls").code, 0)
        shown = Terminal(*SMALL, answer=b"", keys=b"\x03")
        self.assertEqual((shown.code, shown.kept), (-signal.SIGINT, True))

    def test_no_terminal(self):
        self.bad(1, "standard output is not a terminal", "view", *SMALL)
        self.bad(2, "(at /image/width)", "view", "--set", "image.width=0")  # the size of the terminal is checked first
        self.bad(2, "kitty or sixel", "view", "--protocol", "iterm")
        _, png, rest = kitty(self.good("view", *SMALL, "--protocol", "kitty"))
        self.assertEqual((png, rest), (self.rendered(*SMALL), b"\n"))
        self.assertEqual(sixel(self.good("view", *SMALL, "--protocol", "sixel"))[:2], (64, 36))

    def test_protocol_goes_before_the_answer(self):
        self.assertEqual(sixel(Terminal(*SMALL, "--protocol", "sixel", answer=KITTY).sent)[:2], (64, 36))
        self.assertEqual(kitty(Terminal(*SMALL, "--protocol=kitty", answer=NEITHER).sent)[1], self.rendered(*SMALL))

    def size(self, *args, **kwargs):
        return struct.unpack(">II", kitty(Terminal(*args, **kwargs).sent)[1][16:24])

    def test_size(self):
        wide = ["--size", "320x180"]
        self.assertEqual(self.size(*wide, answer=KITTY), (320, 180))  # the terminal is large enough
        self.assertEqual(self.size(*wide, answer=KITTY, pixels=(160, 384)), (160, 90))
        self.assertEqual(
            self.size(*wide, answer=KITTY, pixels=(640, 96)), (163, 92)
        )  # the picture leaves one of the 24 lines free for the next output
        self.assertEqual(self.size(*wide, answer=KITTY, pixels=(640, 384), columns=0, rows=0), (320, 180))
        self.assertEqual(self.size(*SMALL, "--enlarge", answer=KITTY, pixels=(128, 384)), (128, 72))
        self.assertEqual(self.size("--size", "100x1", answer=KITTY, pixels=(20, 384)), (20, 1))
        shown = Terminal(
            *wide, answer=b"\x1b[4;384;80t" + NEITHER, pixels=(0, 0)
        )  # the system does not know the size, so the terminal is queried
        self.assertIn(b"\x1b[14t", shown.queries)
        self.assertEqual(self.size(*wide, answer=KITTY[:12] + b"\x1b[4;384;80t" + NEITHER, pixels=(0, 0)), (80, 45))
        self.assertEqual(self.size(*wide, answer=KITTY, pixels=(0, 0)), (320, 180))
        self.assertNotIn(b"\x1b[14t", Terminal(*SMALL, answer=KITTY).queries)

    def test_picture(self):
        given = [
            "--preset",
            "gargantua",
            "--size",
            "96x54",
            "--set",
            "camera.roll_deg=20",
            "--set",
            "spots.0.r=9",
            "--set",
            "spots.1.brightness=1",
        ]
        png = self.rendered(*given)
        shown = Terminal(
            "same.png", answer=KITTY, cwd=self.folder, env={**os.environ, "VK_DRIVER_FILES": "/dev/null"}
        )  # needs no device
        self.assertEqual((shown.code, shown.stderr), (0, ""))
        controls, sent, rest = kitty(shown.sent)
        self.assertEqual(sent, png)
        self.assertNotIn(b"c=", controls)
        said = re.fullmatch(r"\nsame\.png, 96 x 54: (.*)\n", rest.decode())[1]
        self.assertIn("camera.roll_deg=20", said)
        again = [word for pair in said.split() for word in ("--set", pair)]
        self.assertEqual(self.good("scene", "--hash", *again), self.good("scene", "--hash", *given))
        self.assertEqual(
            self.good("view", self.path("same.png"), "--protocol", "kitty").partition(b"\n")[2].decode(),
            f"{self.folder}/same.png, 96 x 54: {said}\n",
        )

    def test_picture_does_not_fit(self):
        self.rendered(*SMALL)
        small = {"answer": KITTY, "cwd": self.folder, "pixels": (32, 384), "columns": 8}
        self.assertIn(b",c=8,", kitty(Terminal("same.png", **small).sent)[0])
        self.assertEqual(sixel(Terminal("same.png", **{**small, "answer": SIXEL}).sent)[:2], (32, 18))
        self.assertIn(
            b",c=78,", kitty(Terminal("same.png", "--enlarge", answer=KITTY, cwd=self.folder).sent)[0]
        )  # height of 22 of the 24 lines

    def test_bits(self):
        """A picture of 16 bits a channel gives the same sixel picture, except for rounding."""
        low, high = (
            sixel(self.good("view", *SMALL, "--set", f"image.bit_depth={bits}", "--protocol", "sixel"))[2]
            for bits in (8, 16)
        )
        errors = [abs(a - b) for one, other in zip(block_means(low), block_means(high)) for a, b in zip(one, other)]
        self.assertLess(sum(errors) / len(errors), 2)

    def test_bad_pictures(self):
        png = self.rendered(*SMALL)
        self.bad(2, "give it with --from", "view", self.path("same.png"), "--set", "camera.r=30", "--protocol", "kitty")
        chunk = lambda kind, data: (
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        )
        plain = (
            b"\x89PNG\r\n\x1a\n"
            + chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(bytes(4)))
            + chunk(b"IEND", b"")
        )
        self.bad(2, "plain.png: ", "view", self.write("plain.png", plain), "--protocol", "kitty")
        self.bad(2, "cut.png: ", "view", self.write("cut.png", png[:-20]), "--protocol", "kitty")
        self.bad(2, "No such file", "view", self.path("none.png"), "--protocol", "kitty")
        self.good(
            "view", self.write("scene.json", json.dumps({"image": {"width": 16, "height": 9}})), "--protocol", "kitty"
        )

    def test_default_scene_is_said(self):
        self.rendered()
        self.assertTrue(
            self.good("view", self.path("same.png"), "--protocol", "kitty").endswith(b"1280 x 720: the default scene\n")
        )


if __name__ == "__main__":
    main(needs_device=True)
