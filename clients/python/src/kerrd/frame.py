"""A rendered picture, and the headers and numbers that came with it."""

from __future__ import annotations

import io
import json
import os
import re
import struct
import zlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from PIL.PngImagePlugin import PngImageFile, PngInfo

from .errors import KerrdError
from .names import checked

HEADER = 33  # length of a PNG's signature and IHDR chunk


def items(header: str | None) -> list[str]:
    """The names in a header whose value is a list, such as Kerrd-Approximations."""
    return [name for name in map(str.strip, (header or "").split(",")) if name]


def figures(header: str | None) -> dict[str, float | str]:
    """The name=value pairs of a header such as Kerrd-Accuracy; numbers become floats."""
    out: dict[str, float | str] = {}
    for pair in (header or "").split():
        name, _, value = pair.partition("=")
        try:
            out[name] = float(value)
        except ValueError:
            out[name] = value
    return out


def passes(header: str | None) -> dict[str, float]:
    """The header Server-Timing: milliseconds of each pass, of `total` and of `encode`."""
    return {name: float(ms) for name, ms in re.findall(r"(\w+)(?:;desc=\"[^\"]*\")?;dur=([\d.]+)", header or "")}


def _with_text(png: bytes, name: str, text: str) -> bytes:
    """The bytes of the PNG with an additional text, as an iTXt chunk (PNG 1.2, section 4.2.3)."""
    body = b"iTXt" + name.encode("latin-1") + b"\0\0\0\0\0" + text.encode()
    return png[:HEADER] + struct.pack(">I", len(body) - 4) + body + struct.pack(">I", zlib.crc32(body)) + png[HEADER:]


class Picture(PngImageFile):
    """A Pillow image. When it is saved as a PNG again, the texts of the original PNG, among them the scene, are
    kept."""

    def __init__(self, data: bytes) -> None:
        super().__init__(io.BytesIO(data))
        self.load()

    def save(
        self,
        fp: str | bytes | os.PathLike[str] | os.PathLike[bytes] | IO[bytes],
        format: str | None = None,
        **params: Any,
    ) -> None:
        path = os.fspath(fp) if isinstance(fp, (str, bytes, os.PathLike)) else getattr(fp, "name", "")
        ending = os.path.splitext(os.fsdecode(path) if isinstance(path, (str, bytes)) else "")[1].lower()
        if "pnginfo" not in params and (format or Image.registered_extensions().get(ending, "")).upper() == "PNG":
            params["pnginfo"] = PngInfo()
            for name, text in self.text.items():
                params["pnginfo"].add_itxt(name, str(text))
        super().save(fp, format, **params)


@dataclass(frozen=True, repr=False)
class Frame:
    """A picture, with its headers and numbers.

    data: bytes of the file; kind: its media type. layers: the layers that were requested, by name, float32 of shape
    (height, width), "rgb" of shape (height, width, 3). shows: for a session's frame, its scene, because the frame's
    file does not contain it; None for other pictures. accuracy: numbers of the header Kerrd-Accuracy. timing:
    milliseconds of each pass. quality, number and revision: set for frames of a session only.
    """

    data: bytes
    kind: str
    headers: Mapping[str, str]
    layers: dict[str, NDArray[np.float32]] = field(default_factory=dict)
    # sentences of all approximations that the server knows, by name
    sentences: dict[str, str] = field(default_factory=dict, repr=False)
    shows: Mapping[str, Any] | None = None

    def __repr__(self) -> str:
        width, height = Image.open(io.BytesIO(self.data)).size
        told = [f"{self.kind}", f"{width}x{height}", f"{len(self.data)} bytes"]
        told += [f"layers {', '.join(self.layers)}"] if self.layers else []
        told += [f"frame {self.number}"] if self.number else []
        return f"<kerrd.Frame {', '.join(told)}>"

    @property
    def png(self) -> bytes:
        """The bytes of the PNG including its scene, so that `kerrd render --from` can render it again. Raises
        ValueError if the picture is a JPEG, as frames of a moving scene may be."""
        if self.kind != "image/png":
            raise ValueError(f"this picture came as {self.kind}; only the last one of a scene that rests is a PNG")
        return self.data if self.shows is None else _with_text(self.data, "kerrd:scene", json.dumps(self.shows))

    @cached_property
    def image(self) -> Image.Image:
        """The picture as a Pillow image. If it is a PNG, image.save() keeps the scene in it."""
        if self.kind == "image/png":
            return Picture(self.png)
        image = Image.open(io.BytesIO(self.data))
        image.load()
        return image

    @cached_property
    def array(self) -> NDArray[np.uint8]:
        """The pixels as shown, uint8 of shape (height, width, 3). For physical quantities see `layers`."""
        return np.asarray(self.image.convert("RGB"), dtype=np.uint8)

    @cached_property
    def scene(self) -> dict[str, Any]:
        """The whole scene with every field. ValueError if the picture does not hold it."""
        if self.shows is not None:
            return dict(self.shows)
        text = getattr(self.image, "text", {}).get("kerrd:scene")
        if text is None:
            raise ValueError(f"a picture of the type {self.kind} carries no scene")
        scene: dict[str, Any] = json.loads(text)
        return scene

    @property
    def accuracy(self) -> dict[str, float | str]:
        """Errors of the picture, from the header Kerrd-Accuracy."""
        return figures(self.headers.get("kerrd-accuracy"))

    @property
    def approximations(self) -> list[str]:
        """What the picture omits or approximates, in sentences."""
        return [self.sentences[name] for name in items(self.headers.get("kerrd-approximations"))]

    @property
    def timing(self) -> dict[str, float]:
        """Milliseconds of each pass, of `total` and of `encode`."""
        return passes(self.headers.get("server-timing"))

    @property
    def etag(self) -> str:
        """The header ETag, or "" if there is none."""
        return self.headers.get("etag", "")

    @property
    def quality(self) -> dict[str, float | str]:
        """The header Kerrd-Quality of a session's frame; empty for other frames."""
        return figures(self.headers.get("kerrd-quality"))

    @property
    def number(self) -> int:
        """The number of a session's frame; 0 for other frames."""
        return int(self.headers.get("kerrd-frame", 0))

    @property
    def revision(self) -> int:
        """The revision of the scene that a session's frame shows; 0 for other frames."""
        return int(self.headers.get("kerrd-revision", 0))

    @property
    def final(self) -> bool:
        """True if no finer frame of this scene will follow."""
        return not self.quality or self.quality.get("final") == 1

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the file in its own format, PNG (with the scene) or JPEG; the ending of path must match, otherwise
        KerrdError is raised. For other picture formats use `image` and Pillow. For files of numbers use `kerrd
        render`."""
        kinds = {"image/png": ("png",), "image/jpeg": ("jpg", "jpeg")}
        if self.kind not in kinds:
            raise KerrdError(f"a picture of the type {self.kind} cannot be saved by its name")
        name = checked(path, *kinds[self.kind])
        with open(name, "wb") as file:
            file.write(self.png if self.kind == "image/png" else self.data)

    def _repr_png_(self) -> bytes | None:
        return self.png if self.kind == "image/png" else None

    def _repr_jpeg_(self) -> bytes | None:
        return self.data if self.kind == "image/jpeg" else None
