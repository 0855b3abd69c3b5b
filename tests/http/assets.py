"""Tests of assets: accepted files, deletion and its rights, limits and shares, and assets after a restart. The test
makes pictures with zlib alone."""

import concurrent.futures
import hashlib
import io
import json
import math
import os
import shutil
import struct
import subprocess
import tempfile
import threading
import time
import zipfile
import zlib

import daemon

ASSETS = "/v1/assets"


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(width=8, height=4, seed=0, depth=8, colour=2, pixels=None, before=b""):
    """A picture of noise, which cannot be compressed: it takes about 3 bytes a pixel."""
    row = {0: 1, 2: 3, 3: 1, 6: 4}[colour] * width * depth // 8
    noise = (
        b"".join(hashlib.sha256(b"%d %d" % (seed, i)).digest() for i in range((row + 1) * height // 32 + 1))
        if pixels is None
        else pixels
    )
    rows = b"".join(b"\0" + noise[i * row : (i + 1) * row] for i in range(height))
    palette = chunk(b"PLTE", bytes(range(256)) * 3) if colour == 3 else b""
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, 0))
        + before
        + palette
        + chunk(b"IDAT", zlib.compress(rows, 1))
        + chunk(b"IEND", b"")
    )


def npy(kind, shape, data):
    head = f"{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}".encode()
    head += b" " * (-(len(head) + 11) % 64) + b"\n"
    return b"\x93NUMPY\1\0" + struct.pack("<H", len(head)) + head + data


def grid(spin, times=(), **header):
    """A grid of matter of three rows and columns; with times, a series."""
    units = dict(
        r="M",
        theta="rad",
        density="cm^-3",
        temperature="K",
        u_con_r="c",
        u_con_theta="c/M",
        u_cov_phi="c M",
        b_con_r="G",
        b_con_theta="G/M",
        b_cov_phi="G M",
    )
    if times:
        header["units"] = {**units, "time": "M"}
    header = json.dumps(
        dict(format="kerrd-grid", version=1, spin=spin, azimuth="boyer-lindquist", **{"units": units, **header})
    )
    members = {
        "header": npy(f"<U{len(header)}", (), header.encode("utf-32-le")),
        "r": npy("<f8", (3,), struct.pack("<3d", 2, 4, 8)),
        "theta": npy("<f8", (3,), struct.pack("<3d", 0.5236, 1.5708, 2.618)),
    }
    shape, n = ((len(times), 3, 3), 9 * len(times)) if times else ((3, 3), 9)
    members |= {name: npy("<f4", shape, struct.pack(f"<{n}f", *[1] * n)) for name in units if name not in members}
    if times:
        members["time"] = npy("<f8", (len(times),), struct.pack(f"<{len(times)}d", *times))
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as archive:
        for name, data in members.items():
            archive.writestr(zipfile.ZipInfo(name + ".npy"), data)
    return out.getvalue()


class Case(daemon.Case):
    def put(self, data, kind="image/png", server=None, **headers):
        headers = {**({"Content-Type": kind} if kind else {}), **headers}
        return (server or self.daemon).request("PUT", ASSETS, data, headers)

    def made(self, data, server=None):
        answer = self.put(data, server=server)
        self.assertEqual(answer.status, 201, answer.body)
        return answer.json()

    def delete(self, asset, token=None, server=None):
        headers = {"Authorization": f"Bearer {token or asset['token']}"}
        return (server or self.daemon).request("DELETE", f"{ASSETS}/{asset['sha256']}", headers=headers)

    def at(self, asset):
        return f"{ASSETS}/{asset['sha256']}"


class LongDirectories(Case):
    """Grids whose ZIP has a directory of hundreds of thousands of members."""

    options = ("--client-share", 100)
    MANY = 700000  # number of entries; at 46 bytes each they take 31 MiB

    def directory(self):
        size = 46 * self.MANY
        ends = b"PK\6\6" + bytes(20) + struct.pack("<4Q", self.MANY, self.MANY, size, 30)  # APPNOTE 4.3.14
        ends += b"PK\6\7" + bytes(4) + struct.pack("<QI", 30 + size, 1)
        ends += b"PK\5\6" + bytes(4) + struct.pack("<HHIIH", 0xFFFF, 0xFFFF, 0xFFFFFFFF, 0, 0)
        return b"PK\3\4" + bytes(26) + (b"PK\1\2" + bytes(42)) * self.MANY + ends  # the file begins with a member

    def put_when_there_is_room(self, data):
        """A client may send two such bodies at once; further ones wait."""
        while (answer := self.put(data, "application/x-npz")).status in (429, 503):
            time.sleep(0.1)
        return answer

    def cost(self, data, words):
        """Processor time of the server for five such files at once, while another client requests a picture."""
        before = self.daemon.processor_s()
        with concurrent.futures.ThreadPoolExecutor(5) as pool:
            puts = [pool.submit(self.put_when_there_is_room, data) for _ in range(5)]
            picture = self.daemon.get("/v1/render?image.width=320&image.height=180", **{"X-Forwarded-For": "192.0.2.7"})
            refused = [self.assertProblem(put.result(), 422, "invalid-asset")["detail"] for put in puts]
        self.assertEqual(picture.status, 200, picture.body)
        for detail in refused:
            self.assertIn(words, detail)
        return self.daemon.processor_s() - before

    def test_they_cost_no_more_than_their_bytes(self):
        many = self.directory()
        # work that a server does only once does not count as cost
        self.daemon.get("/v1/render?image.width=320&image.height=180")
        plain = self.cost(bytes(len(many)), "not a")  # this body is refused because of its first bytes
        # 50 ticks of the clock, which are 0.5 s
        self.assertLess(self.cost(many, "at most 1024 members; it has 700000"), 2 * plain + 0.5)


class Assets(Case):
    def test_life(self):
        picture = png(20, 10, depth=16, colour=6)
        answer = self.put(picture)
        asset = answer.json()
        self.assertEqual(
            (answer.status, answer.location(), answer.header("Cache-Control")), (201, self.at(asset), "no-store")
        )
        token = asset.pop("token")
        created = asset.pop("created")
        self.assertEqual(
            asset,
            {
                "sha256": hashlib.sha256(picture).hexdigest(),
                "type": "image/png",
                "width": 20,
                "height": 10,
                "bit_depth": 16,
                "channels": 4,
                "bytes": len(picture),
            },
        )
        again = self.put(picture)
        self.assertEqual((again.status, again.json()), (200, {**asset, "created": created}), "and no token")
        got = self.daemon.get(self.at(asset))
        self.assertEqual(
            (got.status, got.body, got.header("Content-Type"), got.header("ETag")),
            (200, picture, "image/png", f'"{asset["sha256"]}"'),
        )
        self.assertIn("immutable", got.header("Cache-Control"))
        self.assertEqual(got.header("X-Content-Type-Options"), "nosniff")
        head = self.daemon.request("HEAD", self.at(asset))
        self.assertEqual((head.status, head.body, head.header("Content-Length")), (200, b"", str(len(picture))))
        same = self.daemon.get(self.at(asset), If_None_Match=got.header("ETag"))
        self.assertEqual((same.status, same.body), (304, b""))
        for wrong in ("0" * 32, token[:-1], token.upper() if token.upper() != token else "x"):
            self.assertProblem(self.delete(asset, wrong), 403, "forbidden")
        self.assertProblem(self.daemon.request("DELETE", self.at(asset)), 403, "forbidden")
        self.assertEqual(self.delete(asset, token).status, 204)
        self.assertProblem(self.delete(asset, token), 404, "not-found")
        self.assertProblem(self.daemon.get(self.at(asset)), 404, "not-found")
        other = self.made(picture)
        self.assertNotEqual(other["token"], token)
        self.assertEqual(self.delete(other).status, 204)

    def test_what_there_is(self):
        told = lambda: self.daemon.get(ASSETS).json()
        before = told()
        self.assertIsNone(before["sky"])
        self.assertEqual(before["types"], ["image/png", "application/x-npz", "application/x-uvfits", "text/csv"])
        self.assertEqual(
            before["limits"], {"assets": 64, "bytes": 256 << 20, "asset_bytes": 32 << 20, "asset_pixels": 1 << 28}
        )
        asset = self.made(png(seed=5))
        after = told()
        self.assertEqual((after["assets"], after["bytes"]), (before["assets"] + 1, before["bytes"] + asset["bytes"]))
        self.assertNotIn(asset["sha256"], json.dumps(after), "who knows a hash may have the bytes")
        metrics = self.daemon.metrics()
        self.assertEqual((metrics["kerrd_assets"], metrics["kerrd_asset_bytes"]), (after["assets"], after["bytes"]))
        self.delete(asset)
        self.assertEqual(told(), before)

    def test_pictures_of_every_kind(self):
        for colour, depth, channels in ((0, 8, 1), (0, 1, 1), (0, 16, 1), (2, 8, 3), (2, 16, 3), (3, 8, 1), (6, 8, 4)):
            asset = self.made(png(16, 4, depth=depth, colour=colour))
            self.assertEqual((asset["bit_depth"], asset["channels"]), (depth, channels))
            self.delete(asset)

    def test_what_is_not_taken(self):
        good = png(64, 64)
        header = chunk(b"IHDR", struct.pack(">IIBBBBB", 64, 64, 8, 2, 0, 0, 0))
        huge = lambda w, h: (
            b"\x89PNG\r\n\x1a\n"
            + chunk(b"IHDR", struct.pack(">IIBBBBB", w, h, 8, 0, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(b"\0" * 100))
            + chunk(b"IEND", b"")
        )
        for data, words in (
            (b"", "not a PNG file"),
            (b"GIF89a" + bytes(40), "not a PNG file"),
            (b'<svg xmlns="http://www.w3.org/2000/svg"/>', "not a PNG"),
            (good[:20], "ends inside its header"),
            (good[:-12], "its end is missing"),
            (good[:-1], "ends past the file"),
            (good[:3000], "ends past"),
            (good + b"PK\3\4 and an archive", "bytes follow its end"),
            (good.replace(header, header[:-1] + b"?"), "damaged PNG file"),
            (good.replace(b"IHDR", b"JHDR"), "damaged PNG file"),
            (good.replace(b"IDAT", b"IDBT"), "damaged PNG file"),
            (huge(32769, 1), "each side must be 1 to 32768"),
            (huge(0, 5), "each side must be"),
            (huge(30000, 30000), "too short for its width and height"),
            (png(depth=8, before=chunk(b"ABCD", b"x")), "damaged PNG file"),
        ):
            with self.subTest(words, data=data[:40]):
                problem = self.assertProblem(self.put(data), 422, "invalid-asset")
                self.assertIn(words, problem["detail"])
        # the largest picture that deflate can compress to a few bytes; it has more pixels than are accepted
        flat = png(30000, 9000, colour=0, pixels=bytes(9000 * 30000))
        self.assertIn("30000 x 9000", self.assertProblem(self.put(flat), 422, "invalid-asset")["detail"])
        for kind in (
            "application/json",
            "image/jpeg",
            "application/octet-stream",
            "image/pngx",
            "application/zip",
            None,
        ):
            self.assertIn(
                "image/png", self.assertProblem(self.put(good, kind), 415, "unsupported-media-type")["offered"]
            )
        self.assertEqual(self.daemon.get(ASSETS).json()["assets"], 0)

    def test_a_series_of_grids(self):
        """Time changes the picture of a series of grids, and does not change the picture of a single grid."""
        for times, more, moves in (
            ((), {}, ["moves_with_azimuth"]),
            ((-5, 0, 5), {"frames": 3, "times": [-5, 5]}, ["moves_with_time", "moves_with_azimuth"]),
        ):
            answer = self.put(grid(0.5, times), "application/x-npz")
            self.assertEqual(answer.status, 201, answer.body)
            asset = answer.json()
            self.assertEqual({k: asset[k] for k in ("frames", "times") if k in asset}, more)
            scene = {
                "spacetime": {"spin": 0.5},
                "disk": {"model": "none"},
                "sky": {"model": "none"},
                "volume": {"model": "grid", "grid": asset["sha256"], "slow_light": True},
            }
            session = self.daemon.post("/v1/sessions", scene).json()
            at = "/v1/sessions/" + session["id"]
            self.assertEqual(self.daemon.get(at).json()["varies"], moves)
            owner = {"Authorization": "Bearer " + session["token"]}
            self.assertEqual(self.daemon.request("DELETE", at, headers=owner).status, 204)
            self.delete(asset)

    def test_a_grid_of_matter(self):
        data = grid(0.5)
        answer = self.put(data, "application/x-npz")
        self.assertEqual(answer.status, 201, answer.body)
        asset = answer.json()
        self.assertEqual(
            {k: asset[k] for k in asset if k not in ("token", "created")},
            {
                "sha256": hashlib.sha256(data).hexdigest(),
                "type": "application/x-npz",
                "nodes": [3, 3, 1],
                "spin": 0.5,
                "charge": 0,
                "bytes": len(data),
            },
        )
        got = self.daemon.get(self.at(asset))
        self.assertEqual((got.status, got.body, got.header("Content-Type")), (200, data, "application/x-npz"))
        self.assertIn(".npz", got.header("Content-Disposition"))
        scene = {"spacetime": {"spin": 0.5}, "volume": {"model": "grid", "grid": asset["sha256"]}}
        self.assertEqual(self.daemon.post("/v1/plan", scene).status, 200)
        scene["spacetime"]["spin"] = 0.6
        self.assertIn(
            "of spin 0.5; spacetime.spin is 0.6",
            self.assertProblem(self.daemon.post("/v1/plan", scene), 422, pointer="/volume/grid")["detail"],
        )
        self.assertIn(
            "it must be a picture of the whole sky",
            self.assertProblem(
                self.daemon.post("/v1/plan", {"sky": {"model": "image", "image": asset["sha256"]}}),
                422,
                pointer="/sky/image",
            )["detail"],
        )
        scene["spacetime"] = {"spin": 0.5, "charge": 0.25}
        self.assertIn(
            "of charge 0; spacetime.charge is 0.25",
            self.assertProblem(self.daemon.post("/v1/plan", scene), 422, pointer="/volume/grid")["detail"],
        )
        charged = self.put(grid(0.5, charge=0.25), "application/x-npz").json()
        self.assertEqual((charged["spin"], charged["charge"]), (0.5, 0.25))
        scene["volume"]["grid"] = charged["sha256"]
        self.assertEqual(self.daemon.post("/v1/plan", scene).status, 200)
        scene["spacetime"]["charge"] = 0
        self.assertIn(
            "of charge 0.25; spacetime.charge is 0",
            self.assertProblem(self.daemon.post("/v1/plan", scene), 422, pointer="/volume/grid")["detail"],
        )
        self.delete(charged)
        picture = self.made(png(64, 32))
        scene["volume"]["grid"] = picture["sha256"]
        self.assertIn(
            "it must be a grid of matter",
            self.assertProblem(self.daemon.post("/v1/plan", scene), 422, pointer="/volume/grid")["detail"],
        )
        self.delete(picture)
        self.assertIn(
            "its bytes are those of a ZIP",
            self.assertProblem(self.put(grid(0.25), "image/png"), 422, "invalid-asset")["detail"],
        )
        self.assertIn(
            "its bytes are those of a PNG",
            self.assertProblem(self.put(png(8, 4), "application/x-npz"), 422, "invalid-asset")["detail"],
        )
        self.assertIn(
            "header.charge is not a number from 0 to below 0.866025404, as spin 0.5 requires",
            self.assertProblem(self.put(grid(0.5, charge=0.87), "application/x-npz"), 422, "invalid-asset")["detail"],
        )
        self.assertIn(
            "header.spin is not a number",
            self.assertProblem(self.put(grid(2), "application/x-npz"), 422, "invalid-asset")["detail"],
        )
        self.assertIn(
            "the file ends before the end of its directory",
            self.assertProblem(self.put(data[:-40], "application/x-npz"), 422, "invalid-asset")["detail"],
        )
        elsewhere = (
            data[:-18] + b"\1\0" + data[-16:]
            # this directory states that it is on another disk; without it, members could only be found by inflating the
            # file from the start
        )
        self.assertIn(
            "it is split over several disks",
            self.assertProblem(self.put(elsewhere, "application/x-npz"), 422, "invalid-asset")["detail"],
        )
        self.assertEqual(self.delete(asset).status, 204)

    def test_too_long(self):
        big = (32 << 20) + 1
        answer = self.daemon.raw(
            b"PUT /v1/assets HTTP/1.1\r\nHost: localhost\r\nContent-Type: image/png\r\nContent-Length: %d\r\n\r\n" % big
        )
        self.assertIn("33554432", self.assertProblem(answer, 413, "body-too-large")["detail"])
        chunked = b"PUT /v1/assets HTTP/1.1\r\nHost: localhost\r\nContent-Type: image/png\r\nTransfer-Encoding: chunked\r\n\r\n"
        self.assertProblem(self.daemon.raw(chunked + b"%x\r\n" % big + bytes(big)), 413, "body-too-large")

    def test_other_methods_and_addresses(self):
        for method, target, allow in (
            ("POST", ASSETS, "GET, HEAD, PUT"),
            ("DELETE", ASSETS, "GET, HEAD, PUT"),
            ("PUT", ASSETS + "/" + "0" * 64, "GET, HEAD, DELETE"),
            ("PUT", "/v1/render", "GET, HEAD, POST"),
        ):
            answer = self.daemon.request(method, target)
            self.assertProblem(answer, 405, "method-not-allowed")
            self.assertEqual(answer.header("Allow"), allow + ", OPTIONS")
        for name in ("0" * 64, "x", "..", "%2e%2e%2fjobs", "F" * 64, "0" * 63):
            self.assertProblem(self.daemon.get(f"{ASSETS}/{name}"), 404, "not-found")
        self.assertProblem(self.daemon.get(ASSETS + "?name=sky"), 422, "invalid-parameters")
        self.assertProblem(self.put(png(), **{"Sec-Fetch-Site": "cross-site"}), 403, "cross-site")

    def test_many_at_once(self):
        """A client that uploads the same bytes as others at the same time gets 201 for the first upload. For another
        upload it waits, or gets 200 if the bytes exist already."""
        picture, answers = png(300, 300, seed=9), []
        threads = [threading.Thread(target=lambda: answers.append(self.put(picture))) for _ in range(6)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(sorted(a.status for a in answers if a.status != 503).count(201), 1)
        self.assertLessEqual({a.status for a in answers}, {200, 201, 503})
        asset = next(a.json() for a in answers if a.status == 201)
        self.assertEqual(self.daemon.get(self.at(asset)).body, picture)
        self.assertEqual(self.delete(asset).status, 204)

    def test_a_reader_keeps_what_is_deleted(self):
        picture = png(1200, 1200, seed=3)  # 4 MB: larger than the kernel's buffer for a client that does not read
        asset = self.made(picture)
        with self.daemon.connect() as s:
            s.sendall(f"GET {self.at(asset)} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n".encode())
            first = s.recv(1000)
            self.assertEqual(self.delete(asset).status, 204)
            self.assertProblem(self.daemon.get(self.at(asset)), 404, "not-found")
            rest = first
            while more := s.recv(1 << 20):
                rest += more
        self.assertEqual(rest.split(b"\r\n\r\n", 1)[1], picture)


class Limits(Case):
    options = ("--assets", 3, "--assets-kib", 40, "--asset-keep-s", 100)

    def test_number_and_bytes(self):
        kept = [self.made(png(seed=i)) for i in range(3)]
        problem = self.assertProblem(self.put(png(seed=3)), 429, "quota")
        self.assertIn("you have stored too many assets", problem["detail"])
        self.assertEqual(self.put(png(seed=1)).status, 200, "an existing asset is reported")
        self.delete(kept.pop())
        self.assertProblem(self.put(png(200, 100)), 429, "quota")  # 60 kB
        kept.append(self.made(png(100, 100)))
        for asset in kept:
            self.delete(asset)


class Shares(Case):
    """A client can use its share of the space, but not more. The rest is available to others."""

    options = ("--assets", 4, "--client-share", 50)

    def test_shares(self):
        mine = [self.made(png(seed=i)) for i in range(2)]
        self.assertProblem(self.put(png(seed=2)), 429, "quota")
        self.assertEqual(self.from_other(png(seed=2)).split()[1], b"201")
        self.assertEqual(self.from_other(png(seed=0)).split()[1], b"200", "somebody else has put it here")
        self.assertEqual(self.from_other(png(seed=4)).split()[1], b"201")
        self.delete(mine.pop())
        self.assertEqual(self.put(png(seed=5)).status, 201)
        answer = self.from_other(png(seed=6), "127.0.0.3")
        self.assertEqual(answer.split()[1], b"507")
        self.assertIn(b"assets-full", answer)

    def from_other(self, data, source="127.0.0.2"):
        with self.daemon.connect(source=source) as s:
            s.sendall(
                f"PUT {ASSETS} HTTP/1.1\r\nHost: localhost\r\nContent-Type: image/png\r\nConnection: close\r\nContent-Length: {len(data)}\r\n\r\n".encode()
                + data
            )
            got = b""
            while more := s.recv(65536):
                got += more
            return got


class Sky(Case):
    """The operator's photograph of the sky (--sky)."""

    def serve(self, data, *options):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = os.path.join(folder.name, "sky.png")
        if data is not None:
            with open(path, "wb") as file:
                file.write(data)
        return path, ["--drain-ms", 10, "--sky", path, *options]

    def test_it_is_announced_and_stays(self):
        sky = png(64, 32)
        _, options = self.serve(sky, "--assets", 2, "--asset-keep-s", 1)
        server = daemon.Daemon(*options)
        self.addCleanup(server.process.kill)
        told = server.get(ASSETS).json()
        self.assertEqual((told["sky"], told["assets"]), (hashlib.sha256(sky).hexdigest(), 1))
        self.assertEqual(server.get(f"{ASSETS}/{told['sky']}").body, sky)
        scene = {"image": {"width": 32, "height": 18}, "sky": {"model": "image", "image": told["sky"]}}
        self.assertEqual(server.post("/v1/render", scene).status, 200)
        again = self.put(sky, server=server)
        self.assertEqual((again.status, "token" in again.json()), (200, False), "nobody can delete it")
        # Other assets are evicted to make room for new ones a second after their last use. The photograph is not
        # evicted.
        for seed in range(3):
            self.assertTrue(daemon.eventually(lambda seed=seed: self.put(png(seed=seed), server=server).status == 201))
        self.assertEqual(server.get(ASSETS).json()["sky"], told["sky"])
        self.assertEqual(server.get(f"{ASSETS}/{told['sky']}").status, 200)
        self.assertEqual(server.stop(), 0)

    def test_a_store_that_is_full(self):
        """After a restart all assets count as just used. Even so, one of them is evicted to make room."""
        with tempfile.TemporaryDirectory() as state:
            server = daemon.Daemon("--drain-ms", 10, "--assets", 2, "--state", state)
            self.addCleanup(server.process.kill)
            kept = [self.made(png(seed=seed), server=server) for seed in range(2)]
            self.assertEqual(server.stop(), 0)
            sky = png(64, 32)
            _, options = self.serve(sky, "--assets", 2, "--state", state)
            server = daemon.Daemon(*options)
            self.addCleanup(server.process.kill)
            self.assertEqual(server.get(ASSETS).json()["sky"], hashlib.sha256(sky).hexdigest())
            self.assertEqual(sorted(server.get(self.at(asset)).status for asset in kept), [200, 404])
            self.assertEqual(server.stop(), 0)

    def test_an_asset_of_a_client_stays(self):
        """A client stores a file that is not a photograph of the sky. Then the operator names this file as the sky. It
        is refused, and not removed."""
        with tempfile.TemporaryDirectory() as state:
            server = daemon.Daemon("--drain-ms", 10, "--state", state)
            self.addCleanup(server.process.kill)
            wrong = png(64, 33)
            asset = self.made(wrong, server=server)
            self.assertEqual(server.stop(), 0)
            _, options = self.serve(wrong, "--state", state)
            command = [*daemon.COMMAND, "--port", "0", *map(str, options)]
            self.assertTrue(subprocess.run(command, capture_output=True, timeout=600).returncode)
            server = daemon.Daemon("--drain-ms", 10, "--state", state)
            self.addCleanup(server.process.kill)
            self.assertEqual(server.get(self.at(asset)).body, wrong)
            self.assertEqual(server.stop(), 0)

    def test_what_is_no_photograph_of_the_sky(self):
        for data, words in (
            (None, "which cannot be read: No such file or directory"),
            (png(64, 33), "it must be a PNG picture of the whole sky, twice as wide as high, with 16 to 4096 rows"),
            (grid(0.5), "it must be a PNG picture of the whole sky"),
            (b"a text", "PNG"),
            (b"", "PNG"),
        ):
            path, options = self.serve(data)
            done = subprocess.run(
                [*daemon.COMMAND, "--port", "0", *map(str, options)], capture_output=True, text=True, timeout=600
            )
            self.assertEqual(done.stderr.count("\n"), 1, done)
            self.assertIn(f"--sky is {path}", done.stderr)
            self.assertIn(words, done.stderr)
            self.assertTrue(done.returncode)


class State(Case):
    @classmethod
    def setUpClass(cls):
        pass

    @classmethod
    def tearDownClass(cls):
        pass

    def tearDown(self):
        pass

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.assets = os.path.join(self.folder, "state", "assets")

    def start(self, *options):
        server = daemon.Daemon("--drain-ms", 10, "--state", os.path.dirname(self.assets), *options)
        self.addCleanup(lambda: server.process.poll() is None and (server.process.kill(), server.wait()))
        return server

    def test_a_restart_finds_them(self):
        server = self.start()
        pictures = [png(seed=i) for i in range(3)]
        kept = [self.made(p, server) for p in pictures]
        self.assertEqual(self.delete(kept[1], server=server).status, 204)
        self.assertEqual(
            sorted(os.listdir(self.assets)),
            sorted(f"{k['sha256']}.{kind}" for k in (kept[0], kept[2]) for kind in ("json", "png")),
        )
        for name in os.listdir(self.assets):
            self.assertEqual(os.stat(os.path.join(self.assets, name)).st_mode & 0o077, 0, "nobody else may read it")
        server.process.kill()
        server.wait()
        server = self.start()
        for asset, picture in zip(kept, pictures):
            got = server.get(self.at(asset))
            self.assertEqual((got.status, got.body == picture), (404, False) if asset is kept[1] else (200, True))
        again = self.put(pictures[0], server=server)
        self.assertEqual((again.status, again.json()["created"]), (200, kept[0]["created"]))
        self.assertEqual(self.delete(kept[0], server=server).status, 204, "its token outlives the server")
        self.assertEqual(server.stop(), 0)
        server = self.start()
        self.assertEqual(server.get(ASSETS).json()["assets"], 1)
        self.assertEqual(server.stop(), 0)

    def test_what_is_damaged_is_left_alone(self):
        server = self.start()
        kept = [self.made(png(seed=i), server) for i in range(7)]
        self.assertEqual(server.stop(), 0)
        path = lambda i, kind: os.path.join(self.assets, f"{kept[i]['sha256']}.{kind}")

        def write(i, kind, data):
            with open(path(i, kind), "wb") as f:
                f.write(data)

        write(0, "png", png(seed=9))  # the file's bytes do not have the hash that is its name
        write(1, "png", b"")
        write(2, "json", b'{"format":2}')
        write(3, "json", b'{"format":1,"token":"0","created":1}')
        os.remove(path(4, "json"))  # the server was killed between writing the two files
        os.remove(path(5, "png"))
        os.symlink(path(6, "png"), path(5, "png"))
        left = path(6, "png") + ".kerrd-aB3dE6"
        others = [
            os.path.join(self.assets, n)
            for n in (
                "notes.txt",
                os.path.basename(path(6, "png")) + ".backup",
                "0" * 63 + ".png",
                "0" * 64 + ".gif",
                "x" * 64 + ".png",
            )
        ]
        for name in (left, *others):
            with open(name, "wb") as f:
                f.write(b"something")
        server = self.start()
        self.assertEqual([server.get(self.at(k)).status for k in kept], [404] * 6 + [200])
        self.assertEqual(
            [os.path.exists(n) for n in (path(4, "png"), left)], [False, False], "what a killed server has left"
        )
        self.assertTrue(all(os.path.exists(n) for n in (*others, path(0, "png"), path(2, "png"), path(3, "json"))))
        self.assertEqual(self.made(png(seed=0), server)["sha256"], kept[0]["sha256"], "written anew")
        self.assertEqual(server.stop(), 0)
        server = self.start()
        self.assertEqual([server.get(self.at(k)).status for k in (kept[0], kept[1], kept[6])], [200, 404, 200])
        self.assertEqual(server.stop(), 0)

    def test_the_oldest_gives_way(self):
        server = self.start("--assets", 3, "--asset-keep-s", 1)
        kept = [self.made(png(seed=i), server) for i in range(3)]
        self.assertProblem(self.put(png(seed=3), server=server), 429, "quota")
        self.assertEqual(server.stop(), 0)
        server = self.start("--assets", 3, "--asset-keep-s", 1)  # no owner of the assets is known to this server
        self.assertProblem(self.put(png(seed=3), server=server), 507, "assets-full")
        threading.Event().wait(1.2)
        self.assertEqual(server.get(self.at(kept[0])).status, 200)
        self.made(png(seed=3), server)
        found = [server.get(self.at(k)).status for k in kept]
        self.assertEqual((found[0], sorted(found)), (200, [200, 200, 404]), "what was asked for stays")
        self.assertEqual(len(os.listdir(self.assets)), 6)
        self.assertEqual(server.stop(), 0)

    def test_nothing_gives_way_to_what_is_no_grid(self):
        """An invalid grid evicts nothing. Its arrays would take 84 MB, more than may be kept here, and one of them is
        missing."""
        options = ("--assets-kib", 40, "--asset-keep-s", 1)
        server = self.start(*options)
        kept = self.made(png(), server)
        self.assertEqual(server.stop(), 0)
        server = self.start(*options)
        threading.Event().wait(1.2)  # after this time the picture may be evicted
        row = lambda numbers: npy("<f8", (len(numbers),), struct.pack(f"<{len(numbers)}d", *numbers))
        with zipfile.ZipFile(io.BytesIO(grid(0.5))) as archive:
            header = archive.read("header.npy")
        out = io.BytesIO()
        with zipfile.ZipFile(out, "w") as archive:
            for name, data in (
                ("header", header),
                ("r", row([2 * 1.02**i for i in range(256)])),
                ("theta", row([math.pi * (i + 0.5) / 128 for i in range(128)])),
                ("phi", row([math.tau * i / 64 for i in range(64)])),
            ):
                archive.writestr(zipfile.ZipInfo(name + ".npy"), data)
        told = self.assertProblem(self.put(out.getvalue(), "application/x-npz", server), 422, "invalid-asset")["detail"]
        self.assertRegex(told, "is missing")
        self.assertEqual(server.get(self.at(kept)).status, 200)
        self.assertEqual(server.stop(), 0)

    def test_a_folder_that_cannot_be(self):
        os.makedirs(os.path.dirname(self.assets))
        with open(self.assets, "wb"):
            pass
        with self.assertRaises(RuntimeError):
            self.start()
        os.remove(self.assets)
        os.symlink(self.folder, self.assets)
        with self.assertRaises(RuntimeError):
            self.start()


class Scenes(Case):
    """Tests scenes that refer to an asset, in every kind of request that contains a scene."""

    def scene(self, image):
        return {"image": {"width": 32, "height": 18}, "sky": {"model": "image", "image": image}}

    def answers(self, image):
        """Yields the answer to each kind of request, and the JSON pointer of the field in the request."""
        scene, at = self.scene(image), "/sky/image"
        yield self.daemon.get(f"/v1/render?image.width=32&image.height=18&sky.model=image&sky.image={image}"), at
        yield self.daemon.post("/v1/render", scene), at
        yield self.daemon.post("/v1/plan", scene), at
        yield self.daemon.post("/v1/sessions", scene), at
        yield self.daemon.post("/v1/jobs", {"scene": scene}), "/scene" + at
        yield self.daemon.post("/v1/jobs", {"scenes": [{}, scene]}), "/scenes/1" + at
        yield (
            self.daemon.post("/v1/jobs", {"scene": {}, "keyframes": [{"frame": 1, "scene": scene}]}),
            "/keyframes/0/scene" + at,
        )
        session = self.daemon.post("/v1/sessions", {}).json()
        yield (
            self.daemon.request(
                "PATCH",
                f"/v1/sessions/{session['id']}",
                json.dumps({"sky": {"image": image}}),
                {"Content-Type": "application/merge-patch+json", "Authorization": f"Bearer {session['token']}"},
            ),
            at,
        )
        self.daemon.request(
            "DELETE", f"/v1/sessions/{session['id']}", headers={"Authorization": f"Bearer {session['token']}"}
        )

    def end(self, answer):
        """Deletes the created resources, because few sessions and jobs are allowed."""
        if answer.status in (201, 202):
            self.daemon.request(
                "DELETE", answer.location(), headers={"Authorization": f"Bearer {answer.json()['token']}"}
            )

    def test_one_that_is_here(self):
        asset = self.made(png(64, 32))
        for answer, _ in self.answers(asset["sha256"]):
            self.assertIn(answer.status, (200, 201, 202), answer.body)
            self.end(answer)
        self.delete(asset)

    def test_others_go_on_while_one_is_read(self):
        """The asset is read until a picture without an asset has been rendered. If the reading blocked the device, this
        picture would never be rendered."""
        scene, answers = self.scene(self.made(png(64, 32, 9))["sha256"]), []
        scene["sky"]["seed"] = 4711
        server = daemon.Daemon("--drain-ms", 10)
        self.addCleanup(lambda: server.process.poll() is None and (server.process.kill(), server.wait()))
        self.assertEqual(self.put(png(64, 32, 9), server=server).status, 201)
        waits = threading.Thread(target=lambda: answers.append(server.post("/v1/render", scene)))
        waits.start()
        while not server.metrics()["kerrd_renders_unfinished"] and not answers:
            time.sleep(0.01)
        self.assertEqual(server.get("/v1/render?image.width=32&image.height=18").status, 200)
        waits.join()
        self.assertEqual(answers[0].status, 200, answers[0].body)

    def test_one_that_is_not(self):
        for image in ("0" * 64, "milky-way"):
            for answer, at in self.answers(image):
                problem = self.assertProblem(answer, 422, pointer=at)
                self.assertIn(
                    f'sky.image is "{image}", which is not a known asset; it must be null, or the SHA-256 of an asset that PUT /v1/assets has stored',
                    problem["detail"],
                )

    def test_one_that_is_no_panorama(self):
        asset = self.made(png(64, 36))
        for answer, at in self.answers(asset["sha256"]):
            problem = self.assertProblem(answer, 422, pointer=at)
            self.assertIn(
                "sky.image is a picture of 64 x 36 pixels; it must be one of the whole sky: twice as wide as it is high, of 16 to 4096 rows",
                problem["detail"],
            )
        self.delete(asset)

    def test_the_hash_of_a_scene_is_that_of_what_it_shows(self):
        one, other = self.made(png(64, 32, seed=1)), self.made(png(64, 32, seed=2))
        tag = lambda image: self.daemon.post("/v1/render", self.scene(image)).header("ETag")
        tags = [tag(one["sha256"]), tag(other["sha256"]), tag(None)]
        self.assertEqual(len(set(tags)), 3)
        self.assertEqual(tag(one["sha256"]), tags[0])
        self.delete(one)
        self.assertProblem(self.daemon.post("/v1/render", self.scene(one["sha256"])), 422, pointer="/sky/image")
        self.delete(other)


if __name__ == "__main__":
    daemon.main()
