"""Writes wheels and tars. The same input always gives the same bytes."""

import base64
import hashlib
import io
import tarfile
import zipfile

DATE = (2020, 2, 2, 0, 0, 0)  # date that every file in an archive gets, as in hatchling
SECONDS = 1580601600  # the same


def write_wheel(path, members):
    """Writes a wheel with these files, given as (bytes, mode) by name, and with the list RECORD that PEP 427
    requires."""
    record = next(name for name in members if name.endswith(".dist-info/RECORD"))
    rows = []
    for name, (data, _) in members.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        rows.append(f"{name},," if name == record else f"{name},sha256={digest},{len(data)}")
    members = {**members, record: (("\n".join(rows) + "\n").encode(), 0o644)}
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        # RECORD is the last file, as PEP 427 advises
        for name in sorted(members, key=lambda name: (".dist-info/" in name, name)):
            data, mode = members[name]
            entry = zipfile.ZipInfo(name, DATE)
            entry.external_attr = (0o100000 | mode) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, data)


def info(name, **more):
    """An entry of a tar. By default it is a file that everybody may read; the arguments change this."""
    entry = tarfile.TarInfo(name)
    entry.mode = 0o644
    for key, value in more.items():
        setattr(entry, key, value)
    return entry


def write_tar(members):
    """The bytes of a tar with these entries and the folders that contain them. entries: (tarfile.TarInfo, bytes) by
    name. Owners other than root keep their numbers."""
    out = io.BytesIO()
    folders = {name.rsplit("/", depth)[0] for name in members for depth in range(1, name.count("/") + 1)}
    folders = {name: (info(name, type=tarfile.DIRTYPE, mode=0o755), b"") for name in folders if name not in members}
    with tarfile.open(fileobj=out, mode="w", format=tarfile.PAX_FORMAT) as archive:
        for name, (entry, data) in sorted({**folders, **members}.items()):
            entry.size, entry.mtime, entry.uname, entry.gname, entry.pax_headers = len(data), SECONDS, "", "", {}
            archive.addfile(entry, io.BytesIO(data))
    return out.getvalue()
