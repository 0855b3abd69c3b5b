#!/usr/bin/env python3
"""Debian packages at fixed versions, for scripts/image and scripts/driver.

    scripts/debs.py            choose the newest versions, and write them with their checksums to packaging/root/lock

The lock lists each package that WANTED needs (mesa-vulkan-drivers and others), for amd64 and arm64. When the lock is
written, Debian's signature of each archive's index is checked. A build checks only the checksums in the lock. The
mirror therefore need not be trusted, and every build uses the same packages. A version that is no longer on the mirror
is taken from snapshot.debian.org as of the lock's date. KERRD_MIRROR: a Debian mirror instead of deb.debian.org.
"""

import concurrent.futures
import datetime
import gzip
import hashlib
import io
import lzma
import os
import pathlib
import re
import subprocess
import sys
import tarfile
import tempfile
import urllib.error
import urllib.request

import archive

TREE = pathlib.Path(__file__).resolve().parent.parent
LOCK = TREE / "packaging/root/lock"
CACHE = TREE / "build-debs"
KEYS = "/usr/share/keyrings/debian-archive-keyring.gpg"
MIRROR = os.environ.get("KERRD_MIRROR", "http://deb.debian.org/debian")
SNAPSHOT = "http://snapshot.debian.org/archive"
SUITE = "bookworm"
ARCHIVES = {"debian": SUITE, "debian-security": f"{SUITE}-security"}
MACHINES = {"x86_64": "amd64", "aarch64": "arm64"}
# base-files is included because it has /etc/os-release, by which scanners identify the system.
WANTED = ("base-files", "libc6", "libvulkan1", "mesa-vulkan-drivers")
# Not included: packages that are used only while a package is configured, or by programs that come with a driver.
UNUSED = {"awk", "debconf", "debconf-2.0", "dpkg", "libx11-data", "python3"}


class Stale(SystemExit):
    """Raised if a package that the lock names is no longer available."""


def read(address, tries=3):
    for left in reversed(range(tries)):
        try:
            with urllib.request.urlopen(address, timeout=60) as answer:
                return answer.read()
        except urllib.error.HTTPError:
            raise
        except OSError:
            if not left:
                raise
    raise AssertionError


def base(name):
    return MIRROR if name == "debian" else re.sub(r"/debian/?$", f"/{name}", MIRROR)


def index(place, arch):
    """The packages of an archive for one architecture, and the date of the archive's signed index."""
    suite = ARCHIVES[place]
    with tempfile.NamedTemporaryFile() as signed, tempfile.NamedTemporaryFile("r+") as text:
        signed.write(read(f"{base(place)}/dists/{suite}/InRelease"))
        signed.flush()
        done = subprocess.run(
            ["gpgv", "--keyring", KEYS, "--output", text.name, signed.name], capture_output=True, text=True
        )
        if done.returncode:
            sys.exit(f"scripts/debs.py: the signature of {suite} is not Debian's:\n{done.stderr}")
        release = text.read()
    name = f"main/binary-{arch}/Packages.xz"
    wanted = re.search(rf"^ ([0-9a-f]{{64}}) +\d+ {re.escape(name)}$", release, re.M)[1]
    packed = read(f"{base(place)}/dists/{suite}/main/binary-{arch}/by-hash/SHA256/{wanted}")
    if hashlib.sha256(packed).hexdigest() != wanted:
        sys.exit(f"scripts/debs.py: {name} of {suite} has another checksum than its signed index says")
    stanzas = []
    for stanza in lzma.decompress(packed).decode().split("\n\n"):
        if stanza:
            stanzas.append(dict(re.findall(r"^([A-Za-z0-9-]+): (.*)$", stanza, re.M)))
    return stanzas, re.search(r"^Date: (.*)$", release, re.M)[1]


def newest(stanzas):
    """The newest of several versions of one package, by dpkg's order."""
    best = stanzas[0]
    for one in stanzas[1:]:
        order = ["dpkg", "--compare-versions", one["Version"], "gt", best["Version"]]
        best = one if subprocess.run(order).returncode == 0 else best
    return best


def closure(packages, provided):
    """The packages that WANTED needs, transitively. From alternatives the first existing package is taken."""
    found, todo = {}, list(WANTED)
    while todo:
        name = todo.pop()
        name = name if name in packages else next(iter(provided.get(name, [])), name)
        if name in found or name in UNUSED:
            continue
        found[name] = newest(packages[name])
        for clause in filter(
            None, (found[name].get("Pre-Depends", "") + ", " + found[name].get("Depends", "")).split(", ")
        ):
            names = [re.match(r"[a-z0-9.+-]+", one.strip())[0] for one in clause.split("|")]
            if not UNUSED & set(names):
                todo.append(next((one for one in names if one in packages or one in provided), names[0]))
    return found


def choose():
    """Writes the lock."""
    rows, dates = [], {}
    for arch in MACHINES.values():
        packages, provided = {}, {}
        for place in ARCHIVES:
            stanzas, dates[place] = index(place, arch)
            for one in stanzas:
                one["archive"] = place
                packages.setdefault(one["Package"], []).append(one)
                for name in re.findall(r"(?:^|, )([a-z0-9.+-]+)", one.get("Provides", "")):
                    provided.setdefault(name, []).append(one["Package"])
        for name, one in sorted(closure(packages, provided).items()):
            rows.append(f"{arch} {name} {one['Version']} {one['SHA256']} {one['archive']}/{one['Filename']}")
    latest = max(
        datetime.datetime.strptime(date, "%a, %d %b %Y %H:%M:%S UTC").replace(tzinfo=datetime.UTC)
        for date in dates.values()
    )
    LOCK.write_text(
        "# Written by scripts/debs.py: machine, package, version, SHA-256, archive and path.\n"
        f"date {latest:%Y%m%dT%H%M%SZ}\n" + "\n".join(rows) + "\n"
    )
    return len(rows)


def locked(arch):
    """The date of the lock; and (name, version, checksum, path) of each package for one architecture."""
    lines = [line.split() for line in LOCK.read_text().splitlines() if not line.startswith("#")]
    (date,) = (words[1] for words in lines if words[0] == "date")
    return date, [tuple(words[1:]) for words in lines if words[0] == arch]


def fetch(digest, path, date):
    """The file of a package, from the cache, the mirror or the snapshot. The checksum is checked for each of these
    sources."""
    file = CACHE / f"{digest}.deb"
    if file.exists() and hashlib.sha256(file.read_bytes()).hexdigest() == digest:
        return file
    CACHE.mkdir(exist_ok=True)
    place, rest = path.split("/", 1)
    failed = []
    for address in (f"{base(place)}/{rest}", f"{SNAPSHOT}/{place}/{date}/{rest}"):
        try:
            data = read(address)
        except OSError as error:
            failed.append(f"{address}: {error}")
            continue
        if hashlib.sha256(data).hexdigest() != digest:
            raise Stale(f"scripts/debs.py: {address} has not the checksum of packaging/root/lock")
        part = file.with_suffix(".part")
        part.write_bytes(data)
        part.rename(file)
        return file
    raise Stale("scripts/debs.py: " + "; ".join(failed) + "; scripts/debs.py without arguments renews the lock")


def members(file):
    """The control text and the data archive of a package. A package is an ar archive that contains a tar for each of
    these (deb(5))."""
    data, at, out = file.read_bytes(), 8, {}
    while at < len(data):
        name, size = data[at : at + 16].decode().strip().rstrip("/"), int(data[at + 48 : at + 58])
        out[name.split(".tar")[0]] = (name, data[at + 60 : at + 60 + size])
        at += 60 + size + size % 2
    return {name: unpack(*one) for name, one in out.items() if name in ("control", "data")}


def unpack(name, data):
    if name.endswith(".xz"):
        data = lzma.decompress(data)
    elif name.endswith(".gz"):
        data = gzip.decompress(data)
    elif name.endswith(".zst"):
        data = subprocess.run(["zstd", "-dc"], input=data, capture_output=True, check=True).stdout
    return tarfile.open(fileobj=io.BytesIO(data))


# Not included: manuals, translations, and /usr/share/doc except for the licences.
LEFT_OUT = re.compile(r"usr/share/(man|locale|lintian|bug|info|doc-base|gdb)/|usr/share/doc/[^/]+/(?!copyright$)")
MERGED = re.compile(r"(bin|sbin|lib|lib32|lib64|libx32)(/|$)")


def merged(name):
    """The name of a file in a system whose /bin and /lib are links into /usr."""
    name = name.removeprefix("./").rstrip("/")
    return f"usr/{name}" if MERGED.match(name) else name


def tree(arch):
    """The files of all locked packages for one architecture: (tarfile.TarInfo, bytes, package) by name. The packages
    are not configured, so there is no status file of dpkg. Scanners of images find a file for each package in
    var/lib/dpkg/status.d instead."""
    date, rows = locked(arch)
    files = {}

    for name in ("bin", "sbin", "lib", "lib64"):
        files[name] = (archive.info(name, type=tarfile.SYMTYPE, linkname=f"usr/{name}", mode=0o777), b"", "base-files")
    with concurrent.futures.ThreadPoolExecutor(8) as pool:
        debs = list(pool.map(lambda row: fetch(row[2], row[3], date), rows))
    for (package, *_), deb in zip(rows, debs):
        parts = members(deb)
        control = next(one for one in parts["control"] if one.name.removeprefix("./") == "control")
        name = f"var/lib/dpkg/status.d/{package}"
        files[name] = (archive.info(name), parts["control"].extractfile(control).read(), package)
        for one in parts["data"]:
            name = merged(one.name)
            if not name or one.isdir() or LEFT_OUT.match(name):
                continue
            if one.islnk():
                raise Stale(f"scripts/debs.py: {package} has a hard link, {name}, which is not supported")
            one.name = name
            files[name] = (one, parts["data"].extractfile(one).read() if one.isreg() else b"", package)
    return files


if __name__ == "__main__":
    print(f"{LOCK.relative_to(TREE)}: {choose()} packages")
