"""Tests of pictures from the command line, on a real device."""

import ast
import glob
import hashlib
import json
import math
import os
import pty
import resource
import shutil
import signal
import socket
import stat
import struct
import subprocess
import threading
import time
import unittest
import urllib.request
import xml.etree.ElementTree
import zlib

from support import KERRD, SMALL, Case, main, run


def chunks(png):
    """The chunks of a PNG file as (type, body). Checks their checksums."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    at, found = 8, []
    while at < len(png):
        (length,) = struct.unpack(">I", png[at : at + 4])
        kind, body = png[at + 4 : at + 8], png[at + 8 : at + 8 + length]
        assert struct.unpack(">I", png[at + 8 + length : at + 12 + length])[0] == zlib.crc32(kind + body)
        found.append((kind, body))
        at += 12 + length
    return found


def text(png):
    return dict(body.split(b"\0", 1) for kind, body in chunks(png) if kind == b"tEXt")


NOTES, GPANO = "{urn:x-kerrd:notes#}", "{http://ns.google.com/photos/1.0/panorama/}"


def xmp(file):
    """The properties in a file's XMP packet, by their names with namespace."""
    packet = file[file.index(b"<x:xmpmeta") : file.index(b"</x:xmpmeta>") + len(b"</x:xmpmeta>")]
    found = {}
    for one in xml.etree.ElementTree.fromstring(packet).iter(
        "{http://www.w3.org/1999/02/22-rdf-syntax-ns#}Description"
    ):
        found |= one.attrib
        found |= {child.tag: child.text for child in one}
    return found


class Pictures(Case):
    def test_file(self):
        self.assertEqual(self.good("render", *SMALL, "-o", self.path("a.png")), b"")
        png = self.read("a.png")
        self.assertEqual(struct.unpack(">IIBB", chunks(png)[0][1][:10]), (64, 36, 8, 2))
        self.assertIn(b"sRGB", [kind for kind, _ in chunks(png)])
        self.assertEqual(text(png)[b"kerrd:scene"] + b"\n", self.good("scene", *SMALL))
        self.assertEqual(text(png)[b"kerrd:hash"] + b"\n", self.good("scene", "--hash", *SMALL))
        pixels = zlib.decompress(b"".join(body for kind, body in chunks(png) if kind == b"IDAT"))
        self.assertGreater(len(set(pixels)), 20)  # the picture is not black
        self.assertEqual(os.listdir(self.folder), ["a.png"])
        mask = os.umask(0)
        os.umask(mask)
        self.assertEqual(stat.S_IMODE(os.stat(self.path("a.png")).st_mode), 0o666 & ~mask)

    def test_lossy_pictures(self):
        """JPEG and WebP files are larger for a higher quality, and contain the scene. Pillow reads them, and an XML
        parser their metadata."""
        self.good("render", *SMALL, "-o", self.path("a.png"))
        for name in ("a.jpg", "a.JPEG", "a.webp"):
            sizes = []
            for quality in ((), ("--quality", "30"), ("--quality", "90")):
                self.good("render", *SMALL, *quality, "-o", self.path(name))
                sizes.append(len(self.read(name)))
            self.assertEqual(sizes[0], sizes[2])
            self.assertLess(sizes[1], sizes[2])
            self.good("render", "--from", self.path(name), "-o", self.path("b.png"))
            self.assertEqual(self.read("b.png"), self.read("a.png"), name)
            properties = xmp(self.read(name))
            self.assertEqual(properties[f"{NOTES}scene"].encode() + b"\n", self.good("scene", *SMALL))
            self.assertEqual(properties[f"{NOTES}hash"].encode() + b"\n", self.good("scene", "--hash", *SMALL))
            self.assertFalse([one for one in properties if one.startswith(GPANO)])
            for key, told in text(self.read("a.png")).items():
                if key.startswith(b"kerrd:") and key != b"kerrd:accuracy":
                    self.assertEqual(properties[NOTES + key[6:].decode()], told.decode("latin-1"), key)
        self.bad(2, "--quality is for .jpg and .webp", "render", "--quality", "30", "-o", self.path("c.png"))
        self.bad(2, "--quality", "render", "--quality", "101", "-o", self.path("c.jpg"))
        self.bad(
            2,
            "for a file of the format jpg it must be 8",
            "render",
            *SMALL,
            "--set",
            "image.bit_depth=16",
            "-o",
            self.path("c.jpg"),
        )
        self.bad(
            2, "each side must be at most 16383", "render", "--set", "image.width=16384", "-o", self.path("c.webp")
        )
        self.assertFalse(os.path.exists(self.path("c.jpg")) or os.path.exists(self.path("c.webp")))

    def test_panoramas(self):
        """Each kind of file has the metadata by which photo viewers recognise a panorama."""
        scene = (
            "--set",
            "camera.r=20",
            "--set",
            "camera.projection=equirectangular",
            "--set",
            "style.exposure=0",
            "--set",
            "style.bloom=0",
            "--size=64x32",
        )
        tiled = [f"--set=image.tile.{one}" for one in ("left=16", "top=8", "width=24", "height=10")]
        for name in ("a.png", "a.jpg", "a.webp"):
            for tile, area in ((), (64, 32, 0, 0)), (tiled, (24, 10, 16, 8)):
                self.good("render", *scene, *tile, "-o", self.path(name))
                found = xmp(self.read(name))
                self.assertEqual(found[f"{GPANO}ProjectionType"], "equirectangular")
                names = "FullPanoWidthPixels", "FullPanoHeightPixels"
                self.assertEqual([int(found[GPANO + one]) for one in names], [64, 32])
                names = [f"CroppedArea{one}Pixels" for one in ("ImageWidth", "ImageHeight", "Left", "Top")]
                self.assertEqual(tuple(int(found[GPANO + one]) for one in names), area, name)

    def test_the_eht_style(self):
        """False colours, with scales where there is room. Options given after the style override the style."""
        eht = "--preset", "m87", "--set", "style.name=eht", "--set", "image.samples=1"
        self.good("render", *eht, "--size=320x180", "-o", self.path("a.png"))
        style = json.loads(text(self.read("a.png"))[b"kerrd:scene"])["style"]
        self.assertEqual(
            [style[name] for name in ("name", "beam_uas", "palette", "colour_bar", "tone_map", "bloom")],
            ["eht", 20, "heat", True, "srgb", 0],
        )
        bare = self.good(
            "render", *eht, "--size=320x180", "--set", "style.colour_bar=false", "--set", "style.beam_uas=15", "-o", "-"
        )
        self.assertEqual(json.loads(text(bare)[b"kerrd:scene"])["style"]["beam_uas"], 15)
        self.assertIn(b"Gaussian beam", text(bare)[b"kerrd:approximations"])
        self.bad(
            2,
            "at /style/beam_uas",
            "render",
            *SMALL,
            "--set",
            "style.name=eht",
            "--set",
            "camera.projection=ring",
            "-o",
            self.path("b.png"),
        )
        self.bad(
            2,
            "at /style/colour_bar",
            "render",
            *SMALL,
            "--set",
            "style.name=eht",
            "--set",
            "style.palette=colour",
            "-o",
            self.path("b.png"),
        )

    def test_a_picture_of_the_sky(self):
        chunk = lambda kind, data: (
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        )

        def sky(name, width, height):
            rows = b"".join(b"\0" + bytes([255, 128, y % 256] * width) for y in range(height))
            data = (
                b"\x89PNG\r\n\x1a\n"
                + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
                + chunk(b"tEXt", b"Copyright\0A. Body")
                + chunk(b"IDAT", zlib.compress(rows))
                + chunk(b"IEND", b"")
            )
            with open(self.path(name), "wb") as file:
                file.write(data)
            return hashlib.sha256(data).hexdigest()

        one = sky("one.png", 64, 32)
        sky("other.png", 64, 30)
        named = *SMALL, "--set", "sky.model=image", "--set", "sky.image=orion"
        self.good("render", *named, "--asset", "orion=" + self.path("one.png"), "-o", self.path("a.png"))
        self.assertEqual(json.loads(text(self.read("a.png"))[b"kerrd:scene"])["sky"]["image"], one)
        self.assertEqual(text(self.read("a.png"))[b"Copyright"], b"sky: A. Body")
        self.assertIn(
            b"sky: the light between the stars is a photograph", text(self.read("a.png"))[b"kerrd:approximations"]
        )
        again = self.good(
            "render", "--from", self.path("a.png"), "--asset", "whatever=" + self.path("one.png"), "-o", "-"
        )
        self.assertEqual(again, self.read("a.png"))
        self.bad(
            2,
            'sky.image is "orion", which is not a known asset; it must be null, or the NAME of an --asset NAME=FILE',
            "render",
            *named,
            "-o",
            "-",
        )
        self.bad(
            2, f'sky.image is "{one}", which is not a known asset', "render", "--from", self.path("a.png"), "-o", "-"
        )
        self.bad(
            2,
            "sky.image is a picture of 64 x 30 pixels",
            "render",
            *named,
            "--asset",
            "orion=" + self.path("other.png"),
            "-o",
            "-",
        )
        self.bad(
            2,
            "--asset ground cannot be used, because no field of the scene refers to this name",
            "render",
            *named,
            "--asset",
            "orion=" + self.path("one.png"),
            "--asset",
            "ground=" + self.path("one.png").replace("one", "other"),
            "-o",
            "-",
        )
        alone = self.good("render", *SMALL, "--set", "sky.model=image", "-o", "-")
        self.assertEqual(
            self.good("render", *named, "--set", "sky.image=null", "-o", "-"), alone
        )  # the later of two options applies
        self.bad(
            2, "image.width is null where a number is needed", "render", *SMALL, "--set", "image.width=null", "-o", "-"
        )
        self.assertIn(b"the generated Milky Way is shown", text(alone)[b"kerrd:approximations"])
        self.assertNotIn(b"Copyright", text(alone))

    def test_pipes_give_the_bytes_of_a_file(self):
        scene = b'{"image":{"width":64,"height":36},"spacetime":{"spin":0.5}}'
        self.good("render", self.write("scene.json", scene), "-o", self.path("a.png"))
        self.assertEqual(self.good("render", "-", "-o", "-", stdin=scene), self.read("a.png"))

    def test_a_fits_file_by_any_of_its_names(self):
        for name in "a.fits", "a.fit", "a.fts", "a.FIT":
            self.good("render", *SMALL, "--set", "image.layers=intensity", "-o", self.path(name))
            self.assertTrue(self.read(name).startswith(b"SIMPLE  =                    T"), name)
            self.assertEqual(self.read(name), self.read("a.fits"), name)

    def test_a_limit_of_the_size_of_a_file(self):
        """A file larger than `ulimit -f` allows gives an error, not a signal, and leaves no partial file. A driver that
        keeps its memory in a file fails earlier, and the error names the limit."""

        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))

        for name in "a.png", "a.npy", "a.fits":
            said = run("render", *SMALL, "--set", "image.layers=intensity", "-o", self.path(name), preexec_fn=limit)
            self.assertEqual((said.returncode, said.stdout), (1, b""), said)
            self.assertRegex(said.stderr, b"File too large|lacks files as large as its memory .ulimit -f allows 4096")
        self.assertEqual(os.listdir(self.folder), [])

    def test_a_picture_renders_itself_again(self):
        for depth in "8", "16":
            self.good(
                "render", *SMALL, "--preset", "gargantua", "--set", "image.bit_depth=" + depth, "-o", self.path("a.png")
            )
            self.good("render", "--from", self.path("a.png"), "-o", self.path("b.png"))
            self.assertEqual(self.read("a.png"), self.read("b.png"))
        self.assertEqual(self.good("render", "--from", "-", "-o", "-", stdin=self.read("a.png")), self.read("a.png"))
        other = self.good("render", "--from", self.path("a.png"), "--set", "spacetime.spin=0.1", "-o", "-")
        self.assertIn(b'"spin":0.1,', text(other)[b"kerrd:scene"])

    def test_layers_are_numbers(self):
        """Reads NumPy's header and records with code of this test. Values are NaN where there is no disk. The picture's
        light equals that of the layer."""
        self.good("render", *SMALL, "--set", "image.layers=r,rgb,intensity", "-o", self.path("a.npy"))
        file = self.read("a.npy")
        (length,) = struct.unpack("<H", file[8:10])
        header = ast.literal_eval(file[10 : 10 + length].decode())
        self.assertEqual((file[:8], header["shape"], header["fortran_order"]), (b"\x93NUMPY\x01\x00", (36, 64), False))
        self.assertEqual(header["descr"], [("r", "<f4"), ("rgb", "<f4", (3,)), ("intensity", "<f4")])
        rows = list(struct.iter_unpack("<5f", file[10 + length :]))
        self.assertEqual(len(rows), 36 * 64)
        on = [row for row in rows if not math.isnan(row[0])]
        self.assertTrue(len(rows) / 5 < len(on) < len(rows) * 0.9 and all(1 < r < 22.001 for r, *_ in on))
        most = max(row[4] for row in rows)
        self.assertTrue(
            most > 0.5 and all(abs(0.2126 * r + 0.7152 * g + 0.0722 * b - i) < 1e-5 * most for _, r, g, b, i in rows)
        )

    def test_a_picture_of_a_layer(self):
        self.good("render", *SMALL, "--set", "image.layers=r", "-o", self.path("a.png"))
        self.good("render", *SMALL, "--set", "image.layers=g", "-o", self.path("b.png"))
        self.assertNotEqual(self.read("a.png"), self.read("b.png"))
        self.assertIn(b'"layers":["r"]', text(self.read("a.png"))[b"kerrd:scene"])
        self.bad(
            2,
            "image.layers has 2 layers; for a file of the format png it must have one",
            "render",
            *SMALL,
            "--set",
            "image.layers=g,r",
            "-o",
            self.path("c.png"),
        )

    def test_no_picture_under_a_false_name(self):
        self.bad(
            2,
            "the name must end in .png, .jpg, .webp, .npy, .npz, .fits, .exr or .stars",
            "render",
            *SMALL,
            "-o",
            self.path("a.GIF"),
        )
        self.bad(
            2,
            "the name must end in .png, .jpg, .webp, .npy, .npz, .fits, .exr or .stars",
            "render",
            *SMALL,
            "-o",
            self.path("a.hdr"),
        )
        self.assertEqual(os.listdir(self.folder), [])

    def test_damaged_pictures(self):
        self.good("render", *SMALL, "-o", self.path("a.png"))
        png = self.read("a.png")
        self.bad(2, "damaged", "scene", "--from", self.write("b.png", png[: len(png) // 2]))
        self.bad(2, "damaged", "scene", "--from", self.write("b.png", png.replace(b"kerrd:scene", b"kerrd:acene")))
        bare = png[:8] + b"".join(
            struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
            for kind, body in chunks(png)
            if kind != b"tEXt"
        )
        self.bad(2, "contains no scene", "scene", "--from", self.write("b.png", bare))

    def test_stats(self):
        done = run("render", *SMALL, "--stats", "-o", self.path("a.png"))
        self.assertEqual(done.returncode, 0, done.stderr)
        stats = json.loads(done.stderr)
        self.assertEqual(stats["rays"], 64 * 36)
        self.assertEqual(stats["bytes"], len(self.read("a.png")))
        self.assertIn("trace", stats["device_ms"])
        self.assertEqual(stats["accuracy"]["profile"], "balanced")
        self.assertTrue(stats["approximations"])

    def test_rays_that_differ_from_their_audit_are_said_in_words(self):
        coarse = [option for value in ("engine=ks-euler", "steps=60") for option in ("--set", "accuracy." + value)]
        size = ["--set", "image.width=160", "--set", "image.height=90"]
        words = "rays: a sample of this picture's rays was traced again in 64 bits"
        for options, said in (coarse, True), ([], False):
            done = run("render", *size, *options, "--stats", "-o", self.path("a.png"))
            stats = json.loads(done.stderr)
            self.assertEqual(stats["accuracy"]["differ"] > 0, said, stats["accuracy"])
            self.assertEqual(any(line.startswith(words) for line in stats["approximations"]), said)
            self.assertEqual(words.encode() in text(self.read("a.png"))[b"kerrd:approximations"], said)

    def test_stats_of_pixels_that_have_as_many_rays_as_they_need(self):
        done = run(
            "render",
            "-p",
            "smooth",
            "--size=320x180",
            "--set",
            "image.samples=auto",
            "--stats",
            "-o",
            self.path("a.png"),
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stderr)
        self.assertEqual(found["rays"], 320 * 180)
        self.assertIn("refine", found["device_ms"])
        accuracy = found["accuracy"]
        self.assertGreater(accuracy["refined"], 0)
        self.assertGreater(accuracy["followed"], accuracy["refined"])
        self.assertGreater(accuracy["pixel_sampled"], 96)
        self.assertLess(accuracy["pixel_error"], 0.005)
        finer = run(
            "render",
            "--from",
            self.path("a.png"),
            "--set",
            "image.pixel_error=0.001",
            "--stats",
            "-o",
            self.path("b.png"),
        )
        self.assertGreater(json.loads(finer.stderr)["accuracy"]["between"], accuracy["between"])
        self.bad(2, "image.samples", "render", "--set", "image.samples=autos", "-o", self.path("c.png"))

    def test_stats_of_light_through_volumes(self):
        done = run("render", "-p", "thick-disk", "--size=96x54", "--stats", "-o", self.path("a.png"))
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stderr)
        accuracy = found["accuracy"]
        self.assertIn("march_error", found["device_ms"])
        self.assertGreater(accuracy["volume_sampled"], 10)
        self.assertTrue(0 < accuracy["volume_error"] <= accuracy["volume_error_worst"] < 1, accuracy)
        self.assertIn(f"volume_error={accuracy['volume_error']:.1e}".encode(), self.read("a.png"))
        self.good("render", *SMALL, "-o", self.path("b.png"))
        self.assertNotIn(b"volume_", self.read("b.png"))
        self.bad(
            2,
            "accuracy.tolerance is 1e-06; for light through volumes, in 32 bits, it must be at least 5e-05",
            "render",
            "-p",
            "thick-disk",
            "--set",
            "accuracy.tolerance=1e-6",
            "-o",
            self.path("c.png"),
        )

    def test_plan(self):
        plan = json.loads(self.good("plan", *SMALL, "--set", "image.samples=2"))
        self.assertEqual(plan["rays"], 4 * 64 * 36)

    def test_memory(self):
        for size in (
            "",
            "2",
            "63M",
            "2000T",
            "-1G",
            "1G ",
            "1.5G",
            "1GiB",
            "G",
            "99999999999999999999T",
            "18446744073709551615K",
        ):
            self.bad(2, "a size from 64M to 1024T", "serve", "--memory", size)
        self.bad(2, "a size from 64M to 1024T", "render", *SMALL, "-M", "0", "-o", self.path("a.png"))
        self.good("render", *SMALL, "--memory", "64M", "-o", self.path("a.png"))
        self.bad(
            2,
            "--memory): lower image.width",
            "render",
            "--memory",
            "64M",
            "--set",
            "image.width=4096",
            "--set",
            "image.height=4096",
            "-o",
            self.path("a.png"),
        )

    def test_every_preset(self):
        """Each preset is found by its name, and differs from the others. tests/http/kerrd.py and the reference pictures
        test that each preset can be rendered."""
        names = [line.split()[0] for line in self.good("presets").decode().splitlines()]
        plans = {self.good("plan", *SMALL, "--preset", name) for name in names}
        self.assertGreater(len(names), 10)
        # presets that differ only in their light sources have the same plan
        self.assertGreater(len(plans), len(names) / 2)
        self.assertTrue(all(json.loads(plan)["rays"] > 0 for plan in plans))
        self.good("render", *SMALL, "--preset", "luminet1979", "-o", self.path("a.png"))


class Outputs(Case):
    def test_unwritable(self):
        self.bad(1, "No such file", "render", *SMALL, "-o", self.path("absent/a.png"))
        self.bad(2, "is a directory", "render", *SMALL, "-o", self.folder)
        with open("/dev/full", "wb") as full:
            self.bad(1, "No space left", "render", *SMALL, "-o", "-", stdout=full)
        self.bad(1, "Not a directory", "render", *SMALL, "-o", self.write("file", "") + "/a.png")
        self.assertEqual(os.listdir(self.folder), ["file"])

    @unittest.skipIf(os.geteuid() == 0, "root writes anywhere")
    def test_forbidden(self):
        os.chmod(self.folder, 0o500)
        self.bad(1, "Permission denied", "render", *SMALL, "-o", self.path("a.png"))
        os.chmod(self.folder, 0o700)

    def test_a_bad_scene_leaves_the_old_picture(self):
        self.write("a.png", "old")
        self.bad(2, "there is no field", "render", "--set", "no.such=1", "-o", self.path("a.png"))
        self.assertEqual(self.read("a.png"), b"old")

    def test_links_stay(self):
        self.write("a.png", "old")
        os.symlink("a.png", self.path("link.png"))
        self.good("render", *SMALL, "-o", self.path("link.png"))
        self.assertTrue(os.path.islink(self.path("link.png")))
        self.assertEqual(self.read("a.png")[:4], b"\x89PNG")

    def test_pipes_stay(self):
        # a pipe instead of /dev/null: if this test failed as root, it would remove the machine's /dev/null
        os.mkfifo(self.path("pipe"))
        read = threading.Thread(target=lambda: self.assertEqual(self.read("pipe")[:4], b"\x89PNG"), daemon=True)
        read.start()
        self.good("render", *SMALL, "-o", self.path("pipe"))
        read.join(timeout=600)
        self.assertFalse(read.is_alive())
        self.assertTrue(stat.S_ISFIFO(os.stat(self.path("pipe")).st_mode))

    def test_terminal(self):
        master, slave = pty.openpty()
        self.bad(2, "terminal", "render", *SMALL, "-o", "-", stdout=slave)
        os.close(slave)
        os.close(master)

    def test_a_reader_that_leaves(self):
        reader, writer = os.pipe()
        os.close(reader)
        done = run("render", *SMALL, "-o", "-", stdout=writer)
        # ends by SIGPIPE, as cat and similar tools do
        self.assertEqual((done.returncode, done.stderr), (-signal.SIGPIPE, b""))
        os.close(writer)

    def test_nowhere_to_write(self):
        for command in ["doctor"], ["plan", *SMALL], ["rays", "--ray", "5,1"], ["render", *SMALL, "-o", "-"]:
            with open("/dev/full", "wb") as full:
                done = run(*command, stdout=full)
            self.assertEqual(done.returncode, 1, command)
            self.assertIn(b"cannot write to standard output", done.stderr)
            reader, writer = os.pipe()
            os.close(reader)
            done = run(*command, stdout=writer)
            os.close(writer)
            self.assertEqual((done.returncode, done.stderr), (-signal.SIGPIPE, b""), command)

    def test_names_end_where_they_end(self):
        self.assertNotRegex(self.good("doctor"), rb"[ \t]\n")

    def test_interrupt(self):
        big = ["--set", "image.width=8000", "--set", "image.height=6000", "--set", "image.samples=2"]
        process = subprocess.Popen([KERRD, "render", *big, "-o", self.path("a.png")], stderr=subprocess.PIPE)

        def handled():
            with open(f"/proc/{process.pid}/status", encoding="utf-8") as status:
                caught = next(line for line in status if line.startswith("SigCgt:"))
            return int(caught.split()[1], 16) >> (signal.SIGINT - 1) & 1

        while not handled():
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=600)
        self.assertEqual(process.returncode, -signal.SIGINT, errors)
        self.assertIn(b"cancelled", errors)
        self.assertEqual(os.listdir(self.folder), [])


class Devices(Case):
    def test_unknown_device(self):
        self.bad(2, "nonesuch", "render", *SMALL, "--device", "nonesuch", "-o", self.path("a.png"))
        environment = dict(os.environ, KERRD_DEVICE="nonesuch")
        self.bad(2, "nonesuch", "plan", env=environment)
        self.good("plan", "--device", "auto", env=environment)  # the option overrides the environment
        self.bad(2, "there is no device", "plan", "--device", "99")
        self.assertEqual(os.listdir(self.folder), [])

    def test_no_device(self):
        nowhere = dict(os.environ, VK_ICD_FILENAMES="/nonexistent", VK_DRIVER_FILES="/nonexistent")
        self.bad(1, "no Vulkan device", "render", *SMALL, "-o", self.path("a.png"), env=nowhere)
        doctor = run("doctor", env=nowhere)
        self.assertEqual(doctor.returncode, 1)
        self.assertIn(b"apt install mesa-vulkan-drivers", doctor.stdout)

    def own_driver(self):
        """Returns a copy of the program, the path of lavapipe, and an environment in which the system has no Vulkan
        driver."""
        manifest = next(iter(glob.glob("/usr/share/vulkan/icd.d/lvp_icd*.json")), None)
        if not manifest:
            self.skipTest("lavapipe is not installed")
        with open(manifest) as file:
            lavapipe = json.load(file)["ICD"]["library_path"]
        if "/" not in lavapipe:  # a driver by a name without a path, which the dynamic linker looks up, as in Debian 13
            lavapipe = glob.glob(f"/usr/lib/*/{lavapipe}")[0]
        os.makedirs(self.path("bin"))
        program = self.path("bin/kerrd")
        shutil.copy(KERRD, program)
        none = {**os.environ, "VK_LOADER_DRIVERS_DISABLE": "*"}
        for name in ("VK_DRIVER_FILES", "VK_ICD_FILENAMES", "KERRD_VALIDATE"):
            none.pop(name, None)
        without = subprocess.run(
            [program, "render", *SMALL, "-o", self.path("none.png")], env=none, capture_output=True
        )
        if not without.returncode:
            self.skipTest("this Vulkan loader is older than VK_LOADER_DRIVERS_DISABLE")
        self.assertIn(b"install mesa-vulkan-drivers", without.stderr)
        self.good("render", *SMALL, "-o", self.path("here.png"), env={**os.environ, "VK_DRIVER_FILES": manifest})
        return program, lavapipe, manifest, none

    def assert_drawn(self, done, name):
        """Checks that lavapipe has rendered the pixels of this file."""
        self.assertEqual(done.returncode, 0, done.stderr)
        pixels = [[body for kind, body in chunks(self.read(file)) if kind == b"IDAT"] for file in (name, "here.png")]
        self.assertEqual(*pixels)

    def test_own_driver(self):
        """If the system has no Vulkan driver, kerrd uses the driver beside the program. If the environment names
        drivers, it uses those instead."""
        program, lavapipe, manifest, none = self.own_driver()

        def draw(**more):
            words = [program, "render", *SMALL, "-o", self.path("own.png")]
            return subprocess.run(words, env={**none, **more}, capture_output=True)

        here = self.good("doctor", env={**os.environ, "VK_DRIVER_FILES": manifest})
        self.assertNotIn(b"this driver is part of kerrd", here)
        for place in ("lib/kerrd-driver", "bin/kerrd-driver"):
            os.makedirs(self.path(place))
            link = self.path(f"{place}/libvulkan_lvp.so")
            os.symlink(lavapipe, link)
            self.assert_drawn(draw(), "own.png")
            doctor = subprocess.run([program, "doctor"], env=none, capture_output=True).stdout
            self.assertIn(b"this driver is part of kerrd, because the system has no driver of Vulkan 1.2", doctor)
            self.assertEqual(draw(VK_DRIVER_FILES="/nonexistent").returncode, 1)
            os.remove(link)
            with open(link, "w") as file:
                file.write("no library")
            done = draw()
            self.assertEqual(done.returncode, 1)
            self.assertIn(b"kerrd's own driver cannot be used: ", done.stderr)
            os.remove(link)

    def test_own_c_library(self):
        """If the system's C library is too old for this driver, the program restarts itself with the driver's C
        library."""
        if "OLD_LIBRARY" not in os.environ:
            self.skipTest("a sanitizer must be the first library")
        program, lavapipe, manifest, none = self.own_driver()
        folder = self.path("lib/kerrd-driver")
        linker = f"{folder}/glibc-2.36/ld.so"
        os.makedirs(os.path.dirname(linker))
        os.symlink(lavapipe, f"{folder}/libvulkan_lvp.so")
        old = {"LD_PRELOAD": os.environ["OLD_LIBRARY"]}
        with open(linker, "w") as file:
            file.write(f"#!/bin/sh\nprintf '%s\\n' \"$@\" > {self.path('words')}\n")
        os.chmod(linker, 0o755)
        words = [program, "render", *SMALL, "-o", self.path("own.png")]

        def entered(command, env):
            done = subprocess.run(command, env=env, capture_output=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            return os.path.exists(self.path("words"))

        self.assertFalse(entered(words, none))
        chosen = {"VK_LOADER_DRIVERS_DISABLE": "", "VK_DRIVER_FILES": manifest}
        self.assertFalse(entered(words, {**none, **old, **chosen}))
        self.assertFalse(entered(words, {**none, **old, "VK_LOADER_DRIVERS_DISABLE": ""}))
        os.chmod(linker, 0o644)
        self.assertFalse(entered(words, {**none, **old}))
        os.chmod(linker, 0o755)
        self.assertTrue(entered(words, {**none, **old}))
        path = f"{self.path('bin')}/../lib/kerrd-driver"
        ours = [f"{path}/glibc-2.36:{path}", "--argv0", program, os.path.realpath(program)]
        self.assertEqual(self.read("words").decode().split("\n")[:-1], ["--library-path", *ours, *words[1:]])

        shutil.copy(next(iter(glob.glob("/lib64/ld-linux*.so.*") + glob.glob("/lib/ld-linux*.so.*"))), linker)
        self.assert_drawn(subprocess.run(words, env={**none, **old}, capture_output=True), "own.png")
        server = subprocess.Popen([program, "serve", "--port", "0"], env={**none, **old}, stdout=subprocess.PIPE)
        with server:
            server.stdout.readline()
            within = os.readlink(f"/proc/{server.pid}/exe")
            with open(f"/proc/{server.pid}/comm") as file:
                called = file.read()
            server.terminate()
        self.assertEqual((within, called), (linker, "kerrd\n"))

    def test_doctor(self):
        report = self.good("doctor").decode()
        for words in [
            "device 0:",
            "Vulkan 1.",
            "choice:",
            "kernel cache:",
            "validation layer:",
            "render: 64 x 36",
            "verdict: usable",
        ]:
            self.assertIn(words, report)


class Serve(Case):
    def start(self, *args, **env):
        process = subprocess.Popen(
            [KERRD, "serve", "--port", "0", *args],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            env={**os.environ, **env},
        )
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.kill)
        line = process.stdout.readline().decode()
        self.assertTrue(line.startswith("kerrd: listening on http://127.0.0.1:"), line)
        return process, line.split()[-1]

    def test_signals_end_it_with_0(self):
        for number in signal.SIGTERM, signal.SIGINT:
            process, url = self.start()
            with urllib.request.urlopen(url + "healthz", timeout=600) as answer:
                self.assertEqual(answer.status, 200)
            process.send_signal(number)
            self.assertEqual(process.wait(timeout=600), 0, process.stderr.read())

    def test_a_base_path_by_option_or_environment(self):
        for args, env in (
            (("--base-path", "/some/prefix"), {}),
            ((), {"KERRD_BASE_PATH": "/some/prefix"}),
            (("--base-path", "/some/prefix"), {"KERRD_BASE_PATH": "/other"}),
        ):
            process, url = self.start(*args, **env)
            self.assertTrue(url.endswith("/some/prefix/"), url)
            with urllib.request.urlopen(url + "v1/device", timeout=600) as answer:
                self.assertEqual(answer.status, 200)

    def test_the_same_picture_as_render(self):
        process, url = self.start()
        scene = self.good("scene", *SMALL)
        request = urllib.request.Request(url + "v1/render", data=scene, headers={"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=600) as answer:
            served = answer.read()
        self.assertEqual(text(served)[b"kerrd:scene"] + b"\n", scene)
        process.terminate()
        self.assertEqual(process.wait(timeout=600), 0)

    def test_cannot_listen(self):
        with socket.create_server(("127.0.0.1", 0)) as taken:
            self.bad(1, "", "serve", "--port", str(taken.getsockname()[1]))


if __name__ == "__main__":
    main(needs_device=True)
