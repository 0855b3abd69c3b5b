"""Helpers shared by tests of jobs. In the fake renderer's scenes, `time` is the duration of a frame in milliseconds."""

import json
import struct
import zlib

import daemon

IMAGE = {"width": 32, "height": 18}
SCENE = {"image": IMAGE, "time": 5}
SLOW = {"image": IMAGE, "time": 30000}


def size(png):
    return struct.unpack(">II", png[16:24])


def text_of(png, name):
    """An uncompressed text in a PNG, by its keyword."""
    start = png.index(b"tEXt" + name.encode() + b"\0") + 5 + len(name)
    length = struct.unpack(">I", png[start - 9 - len(name) : start - 5 - len(name)])[0]
    return png[start : start + length - len(name) - 1].decode()


def scene_of(png):
    """The scene in a picture's metadata."""
    at = 8
    while at < len(png):
        n, kind = struct.unpack(">I4s", png[at : at + 8])
        data = png[at + 8 : at + 8 + n]
        if kind == b"tEXt" and data.startswith(b"kerrd:scene\0"):
            return json.loads(data.split(b"\0", 1)[1])
        if kind == b"zTXt" and data.startswith(b"kerrd:scene\0"):
            return json.loads(zlib.decompress(data.split(b"\0", 1)[1][1:]))
        if kind == b"iTXt" and data.startswith(b"kerrd:scene\0"):
            packed, text = data[12], data[14:].split(b"\0", 2)[2]
            return json.loads(zlib.decompress(text) if packed else text)
        at += 12 + n
    raise AssertionError("a picture without a scene")


class Case(daemon.Owned):
    kind, made = "/v1/jobs", 202

    def until(self, job, state, server=None, timeout=240):
        self.assertTrue(
            daemon.eventually(lambda: self.status(job, server)["state"] == state, timeout), self.status(job, server)
        )
        return self.status(job, server)

    def frames(self, job, first=0):
        """{number: PNG} of a stream that is read to its end"""
        body = self.daemon.get(self.at(job, f"/result?format=stream&frame={first}")).body
        found = {}
        while body:
            n, number, zero, none = struct.unpack("<4I", body[:16])
            self.assertEqual((zero, none), (0, 0))
            found[number] = body[16 : 16 + n]
            body = body[16 + n :]
        return found
