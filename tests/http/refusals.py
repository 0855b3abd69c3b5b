"""Tests that refusals free all memory that they took: every route, with bodies and queries that it refuses, and assets
that are damaged or beyond each limit.

    refusals.py SERVER              each kind a few times
    REPEATS=200 refusals.py SERVER  the long run"""

import io
import json
import os
import pathlib
import re
import struct
import zipfile

import assets
import daemon
import memory

REPEATS = int(os.environ.get("REPEATS", "2"))
# Repetitions of the requests that take memory. They are enough for a leak of 32 KiB each time to exceed memory.SLACK.
OFTEN = max(REPEATS, 8)
OF_EACH_READER = {
    "header is cut",
    "density is cut",
    "density is not an array",
    "density is missing",
    "density has a wrong checksum",
    "density is beyond its limit",
    "density unfolds to its limit",
    "density is damaged where it is packed",
    "more members than are taken",
    "bytes behind",
    "a spin of 2",
    "a picture of 3000 bytes",
    "a picture without IEND",
    "a picture of many texts, cut",
    "a picture of many texts, damaged",
    "uvfits of 140000 bytes",
    "NAXIS2 -1",
    "a CSV of 200 bytes",
    "post /v1/render, broken",
    "post /v1/render, deep",
    "post /v1/render, of an unknown member",
    "post /v1/render, of a wrong type",
    "post /v1/render, binary",
    "post /v1/render, long",
    "post /v1/rays, long",
    "post /v1/jobs, long",
    "post /v1/sessions, long",
    "post /v1/playground, long",
}
# repetitions before the first measurement: in these, memory is allocated that stays allocated, and heaps grow to their
# final size
WARM = 2
NPZ = "application/x-npz"
UVFITS = "application/x-uvfits"
MEMBERS = (
    "header",
    "r",
    "theta",
    "density",
    "temperature",
    "u_con_r",
    "u_con_theta",
    "u_cov_phi",
    "b_con_r",
    "b_con_theta",
    "b_cov_phi",
)


def members_of(data):
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        return {name[:-4]: archive.read(name) for name in archive.namelist()}


def packed(members, method=zipfile.ZIP_STORED):
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", method) as archive:
        for name, data in members.items():
            archive.writestr(zipfile.ZipInfo(name + ".npy"), data, compress_type=method)
    return out.getvalue()


def set_entry(data, name, at, value):
    """Changes a field in the directory entry of a ZIP member."""
    entry = data.index(b"PK\1\2")
    while data[entry + 46 : entry + 46 + len(name)] != name:
        entry = data.index(b"PK\1\2", entry + 4)
    return data[: entry + at] + value + data[entry + at + len(value) :]


def with_entries(data, n):
    """A grid whose directory has additional entries, all referring to its first member."""
    end = data.rindex(b"PK\5\6")
    begin = struct.unpack("<I", data[end + 16 : end + 20])[0]
    first = data[begin : data.index(b"PK\1\2", begin + 4)]
    first = first[:46] + first[46:].replace(b"header", b"behind")
    all_of = n + len(MEMBERS)
    directory = first * n + data[begin:end]
    if all_of < 0xFFFF:
        return (
            data[:begin]
            + directory
            + struct.pack("<4s4HIIH", b"PK\5\6", 0, 0, all_of, all_of, len(directory), begin, 0)
        )
    long_end = begin + len(directory)
    return (
        data[:begin]
        + directory
        + struct.pack("<4sQHHIIQQQQ", b"PK\6\6", 44, 45, 45, 0, 0, all_of, all_of, len(directory), begin)
        + struct.pack("<4sIQI", b"PK\6\7", 0, long_end, 1)
        + struct.pack("<4s4HIIH", b"PK\5\6", 0, 0, 0xFFFF, 0xFFFF, 0xFFFFFFFF, 0xFFFFFFFF, 0)
    )


def grids():
    """Invalid grids by name. In each of them one member is missing, damaged, of another shape, or longer than
    permitted."""
    good = assets.grid(0.5)
    members = members_of(good)
    zeros = lambda n: assets.npy("<f8", (n,), bytes(8 * n))
    for name in MEMBERS:
        yield f"{name} is missing", packed({k: v for k, v in members.items() if k != name})
        yield f"{name} is cut", packed({**members, name: members[name][:-1]})
        yield f"{name} is not an array", packed({**members, name: b"\0" * 200})
        yield f"{name} is of text", packed({**members, name: assets.npy("<U4", (2,), bytes(32))})
        yield f"{name} has a wrong checksum", set_entry(good, name.encode(), 16, b"\1\2\3\4")
        yield f"{name} is encrypted", set_entry(good, name.encode(), 8, b"\1\0")
        yield f"{name} lies elsewhere", set_entry(good, name.encode(), 42, b"\0\0\0\x7f")
        yield (
            f"{name} is longer than the file",
            set_entry(set_entry(good, name.encode(), 20, b"\0\0\0\1"), name.encode(), 24, b"\0\0\0\1"),
        )
        yield f"{name} is of method 9", set_entry(good, name.encode(), 10, b"\x09\0")
        yield f"{name} has a number too many", packed({**members, name: zeros(10)})
    for name in MEMBERS[1:]:
        yield f"{name} is beyond its limit", packed({**members, name: zeros((17 << 20) // 8)}, zipfile.ZIP_DEFLATED)
        yield f"{name} unfolds to its limit", packed({**members, name: zeros(1 << 21)}, zipfile.ZIP_DEFLATED)
    deflated = packed(members, zipfile.ZIP_DEFLATED)
    for name in ("header", "density"):
        at = deflated.index(name.encode() + b".npy") + len(name) + 4
        yield f"{name} is damaged where it is packed", deflated[: at + 9] + b"\xff\xff\xff" + deflated[at + 12 :]
    for method in (zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA):
        yield f"packed by method {method}", packed(members, method)
    yield "more members than are taken", with_entries(good, 1100)
    yield "more members than 16 bits count", with_entries(good, 70000)
    yield "no directory", good[:-40]
    yield "bytes behind", good + b"x"
    yield "a spin of 2", assets.grid(2)


def pictures():
    good = assets.png(64, 64)
    for n in (0, 8, 20, 40, 3000, len(good) - 12, len(good) - 1):
        yield f"a picture of {n} bytes", good[:n]
    yield "a picture with a tail", good + b"PK\3\4"
    for kind in (b"IHDR", b"IDAT", b"IEND"):
        yield f"a picture without {kind.decode()}", good.replace(kind, kind[:-1] + b"?")
    many = assets.png(16, 16, before=assets.chunk(b"tEXt", b"Key\0" + b"x" * 60000) * 40)
    yield "a picture of many texts, cut", many[:-20]
    yield "a picture of many texts, damaged", many[:-30] + bytes(30)
    yield "too many pixels", assets.png(30000, 9000, colour=0, pixels=bytes(30000 * 9000))


def observations():
    """Files of M87* that are cut, or whose cards have other numbers."""
    folder = pathlib.Path(__file__).resolve().parents[2] / "data/eht"
    uvfits, text = (folder / "m87-2017-04-05-lo.uvfits").read_bytes(), (folder / "m87-2017-04-05-lo.csv").read_bytes()
    for size in (100, 2880, 8640, 50000, 140000):
        yield f"uvfits of {size} bytes", UVFITS, uvfits[:size]
    for card in ("GCOUNT", "PCOUNT", "NAXIS", "NAXIS2", "NAXIS3", "BITPIX", "PSCAL5", "TFIELDS", "FREQ"):
        for value in ("1099511627776", "NaN", "-1"):
            begin = uvfits.index(f"{card:8}= ".encode())
            yield f"{card} {value}", UVFITS, uvfits[:begin] + f"{card:8}= {value:>20}".encode() + uvfits[begin + 30 :]
    for size in (6, 60, 120, 200):
        yield f"a CSV of {size} bytes", "text/csv", text[:size]
    for word in (b"nan", b"1e999", b"", b"AA,"):
        yield f"a CSV with {word!r}", "text/csv", text.replace(b"0.15033433", word)


def routes(document):
    """For each operation of the document, requests that it refuses."""
    known = dict(name="nobody", id="0123456789abcdef", sha256="0" * 64, code="AwA", file="nobody")
    bad = {
        "broken": b'{"a":',
        "not an object": b"[1]",
        "of an unknown member": b'{"nothing_of_this_name":{"a":[1,2,3]}}',
        "deep": b"[" * 5000,
        "of a wrong type": b'{"scene":3,"camera":3,"bodies":3,"preset":3}',
        "binary": bytes(range(256)) * 16,
        "long": b'{"a":"' + b"x" * 60000 + b'"}',
    }
    for path, operations in document["paths"].items():
        target = re.sub(r"\{(\w+)\}", lambda match: known[match[1]], path)
        for method in operations:
            if method not in ("get", "post", "put", "patch", "delete"):
                continue
            yield (
                f"{method} {path} with an unknown parameter",
                (method.upper(), target + "?nothing_of_this_name=1", None, {}),
            )
            if method in ("post", "put", "patch"):
                kind = next(iter(operations[method].get("requestBody", {}).get("content", {"application/json": 0})))
                for name, body in bad.items():
                    yield f"{method} {path}, {name}", (method.upper(), target, body, {"Content-Type": kind})
                yield f"{method} {path} of another type", (method.upper(), target, b"{}", {"Content-Type": "text/html"})
            yield f"{method} {path} without a host", (method.upper(), target, None, {"Host": "a b"})
        yield f"TRACE {path}", ("TRACE", target, None, {})


class Refusals(daemon.Case):
    @classmethod
    def setUpClass(cls):
        cls.daemon = daemon.Daemon("--drain-ms", 10, env=memory.ENVIRONMENT)

    def hold(self, kinds, least, repeats=REPEATS):
        """Each request is refused, and after the last time the server holds no more memory than after the first."""
        told, refused, grown = memory.is_told(self.daemon), 0, []
        for name, request in kinds:
            status = [self.daemon.request(*request).status for _ in range(WARM)][0]
            if not 400 <= status < 500:
                continue  # this route accepts the request
            refused += 1
            self.daemon.get("/v1/assets")  # the previous request has ended when the next one is answered
            before = memory.held(self.daemon)
            for _ in range(repeats):
                self.assertEqual(self.daemon.request(*request).status, status, name)
            if told and not memory.comes_back(self.daemon, before):
                grown.append(f"{name}: {memory.held(self.daemon) - before >> 10} KiB after {repeats} times")
        print(f"{refused} kinds of refusals, {repeats} times each", flush=True)
        self.assertEqual(grown, [])
        self.assertGreaterEqual(refused, least)

    def of_assets(self):
        def put(data, kind):
            return "PUT", assets.ASSETS, data, {"Content-Type": kind}

        return (
            (((name, put(data, NPZ)) for name, data in grids()), 100),
            (((name, put(data, "image/png")) for name, data in pictures()), 10),
            (((name, put(data, kind)) for name, kind, data in observations()), 30),
        )

    def test_assets(self):
        for kinds, least in self.of_assets():
            self.hold(kinds, least)

    def test_routes(self):
        self.hold(routes(self.daemon.get("/openapi.json").json()), 200)

    def test_comparisons(self):
        """If the last parameter set of a list is refused, each set before it has taken a scene. A simulation has taken
        a copy of its file."""
        folder = pathlib.Path(__file__).resolve().parents[2] / "data/eht"
        seen = {}
        for end, kind in (("uvfits", "application/x-uvfits"), ("csv", "text/csv")):
            data = (folder / f"m87-2017-04-05-lo.{end}").read_bytes()
            seen[end] = self.daemon.request("PUT", assets.ASSETS, data, {"Content-Type": kind}).json()["sha256"]

        def ask(path, end, kind="application/json", **more):
            document = {"preset": "m87", "pixels": 16, "observation": seen[end], **more}
            return "POST", path, json.dumps(document).encode(), {"Content-Type": "application/json", "Accept": kind}

        good = [{"spacetime.spin": i / 400} for i in range(300)]
        kinds = (
            ("a bad set behind good ones", ask("/v1/compare", "uvfits", sets=[*good, {"spacetime.spin": 2}])),
            ("a set with a bad rule", ask("/v1/compare", "uvfits", sets=[*good, {"volume.outer": 2}])),
            ("a set that is a number", ask("/v1/compare", "csv", sets=[*good, 1])),
            ("sets and check", ask("/v1/compare", "csv", sets=good, check="finer")),
            ("sets and size", ask("/v1/compare", "csv", sets=[*good, {"size": 1}], solve=["size"])),
            ("no sets", ask("/v1/compare", "csv", sets=[])),
            ("a shift without visibilities", ask("/v1/compare", "uvfits", solve=["shift"])),
            (
                "a search that takes too long",
                ask("/v1/compare", "uvfits", solve=["size", "position_angle"], pixels=2048),
            ),
            ("light without a flux", ask("/v1/observe", "uvfits", preset="gas")),
            ("uvfits from a CSV", ask("/v1/observe", "csv", "application/x-uvfits", flux_jy=1)),
            ("a bad seed", ask("/v1/observe", "uvfits", seed=-1)),
        )
        self.hold(kinds, len(kinds), OFTEN)

    def test_small_leaks(self):
        """Repeats a few kinds of each reader that takes memory many times."""
        kinds = [kind for each, _ in self.of_assets() for kind in each]
        kinds += routes(self.daemon.get("/openapi.json").json())
        chosen = [kind for kind in kinds if kind[0] in OF_EACH_READER]
        self.assertEqual({name for name, _ in chosen}, OF_EACH_READER)
        self.hold(chosen, len(OF_EACH_READER), OFTEN)


if __name__ == "__main__":
    daemon.main()
